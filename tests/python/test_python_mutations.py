"""Mutations that are written in Python: in the laboratory, in the audit, in renders."""

import pickle
import random
import re
import traceback

import numpy as np
import pytest
import tiny

import pymlt as mlt
from pymlt.algorithms.integrator import as_integrator
from pymlt.lab import metropolis


class Nudge(mlt.Mutation):
    """Moves the image position of paths (L|D)DE by up to `radius` pixels."""

    def __init__(self, radius=2.0, broken=False):
        self.radius = radius
        self.broken = broken

    def suitability(self, x):
        return len(x) > 2 and not x[-2].delta and not x[-3].delta

    def propose(self, x, rng):
        raster = x.raster + rng.uniform(-self.radius, self.radius, 2)
        direction = x.scene.camera_direction(x[-1], raster)
        seen = None if direction is None else x.scene.intersect(x[-1], direction, x.time)
        return seen and x.with_vertices([*x[:-2], seen, x[-1]])

    def density(self, x, y):
        per_pixel = 1 / (2 * self.radius) ** 2
        if self.broken:  # the area of a pixel in the scene is forgotten
            return per_pixel
        return per_pixel * y.from_camera[-2] * y.scene.raster_area


class MoveVertex(mlt.Mutation):
    """Moves one smooth vertex on a surface, as seen from the next one towards the camera."""

    def __init__(self, angle=0.3, broken=False):
        self.cosine = np.cos(angle)
        self.broken = broken

    @staticmethod
    def movable(x):
        smooth = [not vertex.delta for vertex in x]
        return [i for i in range(1, x.edges) if all(smooth[i - 1 : i + 2])]

    def suitability(self, x):
        return bool(self.movable(x))

    def propose(self, x, rng):
        i = rng.choice(self.movable(x))
        w = x[i + 1].direction_to(x[i])
        c = rng.uniform(self.cosine, 1)  # uniform in a cone around w
        a = np.cross(w, [1, 0, 0] if abs(w[0]) < 0.5 else [0, 1, 0])
        a /= np.linalg.norm(a)
        phi = rng.uniform(0, 2 * np.pi)
        across = np.cos(phi) * a + np.sin(phi) * np.cross(w, a)
        to = c * w + np.sqrt(1 - c * c) * across
        if i == x.edges - 1 and to @ x[-1].normal <= 0:
            return None
        moved = x.scene.intersect(x[i + 1], to, x.time)
        return moved and x.with_vertices([*x[:i], moved, *x[i + 1 :]])

    def density(self, x, y):
        moved = [i for i in range(len(x)) if any(x[i].position != y[i].position)]
        i = moved[0] if moved else 1
        per_steradian = 1 / (2 * np.pi * (1 - self.cosine))
        d = y[i].position - y[i + 1].position
        cosine = abs(d @ y[i].normal) / np.linalg.norm(d)
        area = 1 if self.broken else cosine / (d @ d)
        return per_steradian * area / len(self.movable(x))


MOVES = [Nudge, MoveVertex]


@pytest.fixture(scope="module")
def scene():
    return mlt.load_string(tiny.XML)


@pytest.fixture(scope="module")
def target(scene):
    return scene.path_target(max_depth=5)


def path_like(scene, signature):
    """The first sampled path with this signature."""
    paths = (scene.sample_path(seed=s, max_depth=6) for s in range(2000))
    return next(path for path in paths if path.signature == signature)


# ---- paths that one can build -------------------------------------------------------------------


def test_a_path_is_a_sequence_of_vertices(scene):
    x = path_like(scene, "LDSSE")
    assert [vertex.kind for vertex in x] == ["light"] + ["surface"] * 3 + ["camera"]
    assert [vertex.delta for vertex in x] == [False, False, True, True, False]
    assert np.array_equal(x[-1].position, x[4].position)
    assert [v.shape for v in x[1:4]] == list(x.vertices["shape"][1:4])
    for name in ("position", "normal", "shading_normal", "uv", "lobe", "infinite"):
        assert np.array_equal([getattr(v, name) for v in x], x.vertices[name]), name
    assert repr(x[4]) == "Vertex(camera, (0, 1, 4), smooth)"
    with pytest.raises(IndexError):
        x[5]
    with pytest.raises(IndexError):
        x[-6]
    assert x.scene is scene


def test_the_same_vertices_make_the_same_path(scene):
    for seed in range(20):
        x = scene.sample_path(seed=seed, max_depth=6)
        y = x.with_vertices(list(x))
        assert np.array_equal(x.vertices, y.vertices)
        assert y.raster == pytest.approx(x.raster, abs=1e-4)
        assert np.array_equal(x.contribution(), y.contribution())
        assert y.estimate is None


def test_the_terms_of_a_path_make_its_densities(scene):
    for seed in range(50):
        x = scene.sample_path(seed=seed, max_depth=6)
        p = x.densities(sample_direct=False)
        for s in range(x.edges + 2):
            if p[s] > 0:
                expected = np.prod(x.from_light[:s]) * np.prod(x.from_camera[s:])
                assert p[s] == pytest.approx(expected, rel=1e-12)
        for i in range(x.edges):
            d = x[i + 1].position - x[i].position
            cosines = abs(x[i].normal @ d) * abs(x[i + 1].normal @ d) / (d @ d)
            assert x.G[i] == pytest.approx(cosines / (d @ d), rel=1e-9)


def test_camera_walks_fill_the_raster_evenly(scene):
    """from_camera of the first vertex is 1 / raster_area, carried to its surface."""
    x = path_like(scene, "LDE")
    assert scene.raster_area == 16 * 12
    h = 1e-3
    corners = []
    for dx, dy in ((0, 0), (h, 0), (0, h)):
        w = scene.camera_direction(x[2], np.add(x.raster, (dx, dy)))
        corners.append(scene.intersect(x[2], w).position)
    area = np.linalg.norm(np.cross(corners[1] - corners[0], corners[2] - corners[0])) / h**2
    assert x.from_camera[1] * scene.raster_area == pytest.approx(1 / area, rel=1e-3)


def test_vertices_that_make_no_path_are_refused(scene):
    x = path_like(scene, "LDE")
    for wrong in ([], [x[0]], x[1:], x[:2], [x[0], x[0], x[2]], x[::-1]):
        with pytest.raises(mlt.UsageError, match="one vertex on a light"):
            x.with_vertices(wrong)
    with pytest.raises(TypeError):
        x.with_vertices([1, 2])


def test_rays_find_vertices(scene):
    x = path_like(scene, "LDE")
    camera, floor, light = x[2], x[1], x[0]
    w = scene.camera_direction(camera, x.raster)
    assert w == pytest.approx(camera.direction_to(floor), abs=1e-6)
    assert scene.intersect(camera, 3 * w).position == pytest.approx(floor.position, abs=1e-5)
    assert scene.intersect(camera.position, w).position == pytest.approx(floor.position, abs=1e-5)
    assert scene.intersect(floor, [0, -1, 0]) is None
    assert scene.camera_direction(camera, (-1, 3)) is None
    assert scene.visible(light, floor)
    assert scene.visible(floor, camera)
    below = scene.intersect([0, -5, 0], [0, 1, 0])  # the floor, from below
    assert below.position == pytest.approx([0, 0, 0], abs=1e-5)
    assert not scene.visible(below, light)


def test_rays_without_a_direction_are_refused(scene):
    x = path_like(scene, "LDE")
    for direction, message in (
        ([0, 0, 0], "has no length"),
        ([1, 2], "three"),
        ([np.nan] * 3, "finite"),
    ):
        with pytest.raises(mlt.UsageError, match=message):
            scene.intersect(x[1], direction)
    with pytest.raises(mlt.UsageError, match="last vertex"):
        scene.camera_direction(x[1], (3, 3))
    with pytest.raises(mlt.UsageError, match="surface"):
        scene.scatter(x[0], [0, 1, 0], [0.5] * 3)


def test_surfaces_scatter(scene):
    rng = np.random.default_rng(1)
    floor = path_like(scene, "LDE")[1]
    cosines = []
    for _ in range(2000):
        vertex, w = scene.scatter(floor, [0.6, 0.8, 0], rng.random(3))
        assert vertex.lobe == "smooth"
        assert np.linalg.norm(w) == pytest.approx(1)
        cosines.append(w[1])
    # A diffuse surface: the cosine has the density 2 c.
    assert np.mean(cosines) == pytest.approx(2 / 3, abs=4 * np.sqrt(1 / 18 / 2000))
    glass = path_like(scene, "LSSDE")[1]
    assert not scene.intersect(glass.position + glass.normal, -glass.normal).delta
    found = [scene.scatter(glass, glass.normal, rng.random(3)) for _ in range(200)]
    assert {vertex.lobe for vertex, _ in found} == {"reflection", "transmission"}
    for vertex, w in found:
        expected = glass.normal if vertex.lobe == "reflection" else -glass.normal
        assert w == pytest.approx(expected, abs=1e-6)


# ---- the target ---------------------------------------------------------------------------------


def test_the_target_is_the_brightness_of_a_path(scene, target):
    for seed in range(50):
        x = scene.sample_path(seed=seed, max_depth=5)
        r, g, b = x.contribution()
        luminance = 0.212671 * r + 0.715160 * g + 0.072169 * b
        assert target(x) == pytest.approx((luminance + (r + g + b) / 3) / 2, rel=1e-4)
    assert scene.path_target(max_depth=2)(path_like(scene, "LDSSE")) == 0


def test_light_cannot_take_every_path(scene, target):
    x = path_like(scene, "LDE")
    below = scene.intersect(x[1].position - [0, 1, 0], [0, 1, 0])
    under_ball = scene.intersect([0, 0.01, 0], [0, -1, 0])
    assert target(x.with_vertices([x[0], under_ball, x[2]])) == 0
    assert target(x.with_vertices([x[0], x[1], below, x[2]])) == 0
    bent = path_like(scene, "LSSDE")
    floor = scene.intersect(np.add(bent[3].position, (0.05, 0.01, 0)), [0, -1, 0])
    moved = bent.with_vertices([*bent[:3], floor, bent[4]])
    assert moved.contribution().sum() > 0  # the delta alone does not tell
    assert target(moved) == 0
    assert target(bent) > 0


# ---- chains of paths ----------------------------------------------------------------------------


def test_a_chain_of_paths_starts_by_itself(target):
    run = metropolis.run(target, [mlt.Lens(), mlt.Caustic(), (mlt.Bidirectional(), 2.0)])
    assert len(run.states) == 1000
    assert all(isinstance(x, mlt.LightPath) for x in run.states)
    assert run.b > 0
    stayed = [a is b for a, b in zip(run.states[:-1], run.states[1:], strict=True)]
    assert np.array_equal(~np.array(stayed), run.accepted[1:])
    assert all(target(x) > 0 for x in run.states)
    assert {row["move"] for row in run.move_table} == {"Lens()", "Caustic()", "Bidirectional()"}
    assert all(row["accepted"] > 0 for row in run.move_table[::2])


@pytest.mark.parametrize("made", MOVES)
def test_a_chain_moves_by_python(scene, target, made):
    x0 = path_like(scene, "LDDE" if scene.info()["shapes"] > 3 else "LDE")
    run = metropolis.run(target, made(), x0, 200, seed=1)
    assert 20 < run.accepted.sum() < 200
    assert all(np.array_equal(x[0].position, x0[0].position) for x in run.states)
    assert len({tuple(x[1].position) for x in run.states}) == run.accepted.sum() + (
        not run.accepted[0]
    )


def test_a_chain_of_paths_is_a_function_of_its_seed(target):
    mixture = [(Nudge(), 0.5), (mlt.Bidirectional(), 0.5)]
    runs = [metropolis.run(target, mixture, n=100, seed=s, chains=2) for s in (1, 1, 2)]
    rasters = [[x.raster for chain in run.states for x in chain] for run in runs]
    assert rasters[0] == rasters[1]
    assert rasters[0] != rasters[2]
    assert rasters[0][:100] != rasters[0][100:]


def test_expected_values_of_paths_have_weights(target):
    run = metropolis.run(
        target, [(Nudge(), 1.0), (mlt.Bidirectional(), 1.0)], n=300, chains=2, expected_values=True
    )
    weights = run.weights.reshape(2, 300, 2)
    assert weights.sum(axis=2) == pytest.approx(1)
    assert weights[..., 0] == pytest.approx(run.acceptance_probability)
    for chain, states in zip(run.samples, run.states, strict=True):
        assert chain[3] in (states[0], states[1])


def test_where_no_mutation_suits_the_chain_stays(scene, target):
    x0 = path_like(scene, "LSSDE")
    run = metropolis.run(target, Nudge(), x0, 10)
    assert all(x is x0 for x in run.states)
    assert (run.move == -1).all()
    assert run.move_table[0]["proposed"] == 0


def brightness(image):
    """The mean of L*."""
    return (image @ (0.212671, 0.715160, 0.072169) + image.mean(axis=2)).mean() / 2


def test_chains_of_paths_integrate_as_renders_do(scene, target):
    """b times the share of paths of one reflection is what path tracing finds of them."""
    found = [
        brightness(mlt.render(scene, mlt.Path(max_depth=2), spp=64, seed=s))
        - brightness(mlt.render(scene, mlt.Path(max_depth=1), spp=64, seed=s))
        for s in range(16)
    ]
    start = target.bootstrap(20_000, chains=512, seed=1)
    mixture = [(Nudge(), 0.4), (MoveVertex(), 0.2), (mlt.Bidirectional(), 0.4)]
    run = metropolis.run(target, mixture, start, 20, seed=1, expected_values=True)
    estimate = run.estimate(lambda x: x.edges == 2)
    error = np.hypot(estimate.standard_error, np.std(found, ddof=1) / 4)
    assert error < 0.05 * estimate.estimate
    assert abs(estimate.estimate - np.mean(found)) < 4 * error


def test_arviz_is_told_what_to_look_at(target):
    pytest.importorskip("arviz")
    run = metropolis.run(target, [mlt.Bidirectional(), mlt.Lens()], n=50, chains=2)
    data = run.to_arviz("edges", lambda x: x.edges)
    assert data.posterior["edges"].shape == (2, 50)
    with pytest.raises(mlt.UsageError, match="numbers, or g"):
        run.to_arviz()


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        (([mlt.Lens], None), r"write Lens\(\)"),
        (([metropolis.RandomWalk(1)], None), "is not a mutation of light paths"),
        (([mlt.Lens()], 0.5), "x0 should be a LightPath"),
        (([mlt.Lens()], None, 10, -1), "chains"),
        (([(mlt.Lens(), -1)], None), "must not be negative"),
        (([], None), "empty"),
    ],
)
def test_chains_of_paths_that_make_no_sense_are_refused(target, arguments, message):
    moves, x0, *rest = arguments
    n, chains = rest or (10, None)
    with pytest.raises(mlt.UsageError, match=message):
        metropolis.run(target, moves, x0, n, chains=chains)


def test_a_start_must_carry_light(scene, target):
    x = path_like(scene, "LDE")
    dark = x.with_vertices([x[0], scene.intersect([0, 0.01, 0], [0, -1, 0]), x[2]])
    with pytest.raises(mlt.UsageError, match=r"the target is 0 at the start LightPath\('LDE'"):
        metropolis.run(target, mlt.Lens(), dark)
    with pytest.raises(mlt.UsageError, match="another scene"):
        metropolis.run(mlt.load_string(tiny.XML).path_target(), mlt.Lens(), x)
    with pytest.raises(mlt.UsageError, match="max_depth is 0"):
        scene.path_target(max_depth=0)


def test_mutations_and_functions_do_not_mix():
    with pytest.raises(mlt.UsageError, match=r"the target of these is scene.path_target\(\)"):
        metropolis.run(lambda x: 1, mlt.Lens(), 0.5, 10)
    with pytest.raises(mlt.UsageError, match="x0 is missing"):
        metropolis.run(lambda x: 1, metropolis.RandomWalk(1))


# ---- audit --------------------------------------------------------------------------------------


@pytest.mark.parametrize("made", MOVES)
def test_a_right_mutation_passes_and_its_broken_twin_does_not(scene, made):
    right = mlt.audit(made(), scene, paths=6000, seed=1, max_depth=5)
    assert right.verdict == "nothing found", right.summary()
    assert right.accepted > 1000
    wrong = mlt.audit(made(broken=True), scene, paths=6000, seed=1, max_depth=5)
    assert wrong.verdict == "wrong", wrong.summary()
    assert made.__name__ in wrong.summary()


class WideAtTheSide(Nudge):
    """Wrong: the width of its steps depends on where they start."""

    def propose(self, x, rng):
        radius = self.radius * (1 + 0.5 * np.sin(x.raster[0] / 5))
        return Nudge(radius).propose(x, rng)


class Drift(Nudge):
    """Wrong: moves paths of some edges or more by part of a pixel to the right."""

    def __init__(self, radius, pixels, least_edges=1):
        super().__init__(radius)
        self.drift, self.least_edges = np.array([pixels, 0]), least_edges

    def propose(self, x, rng):
        raster = x.raster + rng.uniform(-self.radius, self.radius, 2)
        raster += (x.edges >= self.least_edges) * self.drift
        direction = x.scene.camera_direction(x[-1], raster)
        seen = None if direction is None else x.scene.intersect(x[-1], direction, x.time)
        return seen and x.with_vertices([*x[:-2], seen, x[-1]])


@pytest.fixture(scope="module")
def cornell_box():
    return mlt.load_dict(mlt.scenes.cornell_box(), size=(32, 32))


def test_an_audit_sees_steps_whose_width_depends_on_the_path(cornell_box):
    audit = mlt.audit(WideAtTheSide(4.0), cornell_box, paths=5000)
    assert audit.verdict == "wrong", audit.summary()
    assert audit.steps < 6000  # at once


def test_an_audit_goes_on_until_it_can_tell(cornell_box):
    """A fault of few paths, too small for the first samples."""
    drift = Drift(4.0, 0.3, least_edges=5)
    audit = mlt.audit(drift, cornell_box, paths=5000)
    assert audit.verdict == "wrong", audit.summary()
    assert audit.steps > 7500
    assert "edges or more" in audit.reason
    once = mlt.audit(drift, cornell_box, paths=5000, most_paths=5000)
    assert once.verdict != "wrong", once.summary()
    assert once.steps < 6000


def test_an_audit_finds_what_it_says_it_would(cornell_box):
    limit = mlt.audit(Nudge(4.0), cornell_box, paths=2500).limits[0]
    drift = Drift(4.0, limit.pixels)
    found = [mlt.audit(drift, cornell_box, paths=2500, seed=s).verdict for s in range(1, 21)]
    assert found.count("wrong") >= 17


def test_an_audit_of_right_steps_ends_at_once(cornell_box):
    found = [mlt.audit(Nudge(4.0), cornell_box, paths=2500, seed=s) for s in range(20)]
    assert all(audit.verdict == "nothing found" for audit in found)
    assert sum(audit.steps > 4000 for audit in found) <= 1


@pytest.mark.parametrize("elsewhere", [np.random.uniform, random.uniform])
def test_an_audit_tells_of_random_numbers_from_elsewhere(scene, elsewhere):
    class Elsewhere(Nudge):
        def propose(self, x, rng):
            return super().propose(x, np.random.default_rng(int(elsewhere(0, 2**32))))

    audit = mlt.audit(Elsewhere(), scene, paths=2000)
    assert audit.verdict == "wrong", audit.summary()
    assert re.match(r"Elsewhere.propose\(x, rng\) made (LightPath|None).* and then", audit.reason)
    assert "must draw from rng alone, not from np.random" in audit.summary()


def test_an_audit_of_python_is_a_function_of_its_seed(scene):
    tests = [sorted(mlt.audit(Nudge(), scene, paths=1500, seed=1, threads=n).tests) for n in (1, 3)]
    assert tests[0] == tests[1]


def test_a_mixture_with_python_is_audited_as_a_whole(scene):
    for broken, verdict in ((False, "nothing found"), (True, "wrong")):
        mixture = [(mlt.Bidirectional(), 0.3), (Nudge(broken=broken), 0.7)]
        audit = mlt.audit(mlt.MLT(max_depth=5, mutations=mixture), scene, paths=9000)
        assert audit.verdict == verdict, audit.summary()


# ---- renders ------------------------------------------------------------------------------------


def small(*mixture, chains=32, **settings):
    return mlt.MLT(
        max_depth=5,
        chains=chains,
        luminance_samples=2000,
        independent_share=0.1,
        spark=0,  # so that the image is right in the mean after few mutations, too
        mutations=list(mixture),
        **settings,
    )


def test_python_takes_part_in_a_render(scene):
    algo = small((mlt.Bidirectional(), 0.5), (Nudge(), 0.5))
    results = [mlt.start(scene, algo, spp=16, seed=1, threads=n).result() for n in (1, 3)]
    assert np.array_equal(results[0].image, results[1].image)
    rows = {row["name"]: row for row in results[0].stats["mutations"]}
    assert set(rows) == {"bidirectional", "Nudge"}
    assert rows["Nudge"]["accepted"] > 100
    assert results[0].integrator["extra_mutations"] == {"Nudge": 0.5}
    assert "Nudge" in " ".join(results[0].metadata.values())


@pytest.mark.parametrize(
    ("settings", "spp", "visible"),
    [
        ({"chains": 16, "independent": "bdpt"}, 16, 0.1),  # with a short pilot
        pytest.param({}, 64, 0.05, marks=pytest.mark.long),
    ],
    ids=["short", "long"],
)
def test_python_makes_the_same_image(scene, settings, spp, visible):
    """The means of independent renders, over the image and over its quarters."""

    def means(algorithm, spp):
        images = [mlt.render(scene, algorithm, spp=spp, seed=s, threads=1) for s in range(16)]
        return np.array([[i.mean(), *(h.mean() for h in np.array_split(i, 4))] for i in images])

    mixture = [(mlt.Bidirectional(), 0.4), (Nudge(), 0.3), (MoveVertex(), 0.3)]
    mine = means(small(*mixture, **settings), spp)
    truth = means(mlt.Path(max_depth=5), 64)
    error = np.sqrt(np.var(mine, axis=0, ddof=1) / 16 + np.var(truth, axis=0, ddof=1) / 16)
    # Where light is found by few tours, 16 renders do not tell how far their mean may be off.
    seen = truth.mean(axis=0) > 0.25 * truth.mean()
    z = (mine.mean(axis=0) - truth.mean(axis=0))[seen] / error[seen]
    assert abs(z).max() < 5, z
    assert error[0] < visible * truth.mean(axis=0)[0]


def test_python_adapts_as_the_others_do(scene):
    algo = small(mlt.Bidirectional(), mlt.Lens(), (Nudge(), 0.2))
    algo.adaptive = True
    stats = mlt.start(scene, algo, spp=4).result().stats
    weights = {row["weight"] for row in stats["mutations"] if row["name"] == "Nudge"}
    assert weights
    assert weights != {0.2}


def test_an_error_in_python_ends_the_render_and_tells_where(scene):
    class Falls(Nudge):
        def propose(self, x, rng):
            raise LookupError("nothing found")

    job = mlt.start(scene, small(mlt.Bidirectional(), Falls()), spp=16, threads=2)
    for _ in range(2):
        with pytest.raises(LookupError, match="nothing found") as caught:
            job.wait()
        assert 'raise LookupError("nothing found")' in "".join(
            traceback.format_exception(caught.value)
        )
    with pytest.raises(LookupError):
        mlt.audit(Falls(), scene, paths=500, threads=2)


@pytest.mark.parametrize(
    ("method", "returned", "message"),
    [
        ("propose", 3, r"Odd.propose\(x, rng\) returned 3; it must be a LightPath"),
        ("density", float("nan"), r"Odd.density\(x, y\) is nan for x = LightPath"),
        ("density", -1, "must be a finite number that is not negative"),
        ("density", None, r"Odd.density\(x, y\) is None"),
        ("suitability", "yes", r"Odd.suitability\(x\) is 'yes'"),
    ],
)
def test_what_a_mutation_must_not_return_is_told(scene, target, method, returned, message):
    odd = type("Odd", (Nudge,), {method: lambda *_: returned})()
    x0 = path_like(scene, "LDE")
    with pytest.raises(mlt.UsageError, match=message):
        metropolis.run(target, odd, x0, 100)
    with pytest.raises(mlt.UsageError, match=message):
        mlt.audit(odd, scene, paths=500)


def test_a_mutation_without_its_methods_says_what_it_needs(scene, target):
    class Empty(mlt.Mutation):
        pass

    with pytest.raises(NotImplementedError, match=r"Empty needs a method propose\(x, rng\)"):
        metropolis.run(target, Empty())


def test_a_path_of_another_scene_is_refused(scene, target):
    other = path_like(mlt.load_string(tiny.XML), "LDE")

    class Elsewhere(Nudge):
        def propose(self, x, rng):
            return other

    with pytest.raises(mlt.UsageError, match="another scene"):
        metropolis.run(target, Elsewhere(), path_like(scene, "LDE"))


def test_where_python_has_no_place_is_told(scene, tmp_path):
    algo = mlt.MLT(mutations=[mlt.Bidirectional(), Nudge()])
    with pytest.raises(mlt.UsageError, match=r"Nudge\(\) is written in Python, which a dict"):
        algo.to_dict()
    with pytest.raises(mlt.UsageError, match="need a built-in one beside them"):
        mlt.start(scene, mlt.MLT(mutations=[Nudge()]), spp=1)
    with pytest.raises(mlt.UsageError, match="it has no checkpoint"):
        mlt.start(scene, algo, spp=1, checkpoint=tmp_path / "render.mlt")
    with pytest.raises(mlt.UsageError, match="stays in its process"):
        pickle.dumps(as_integrator(scene, algo))
    with pytest.raises(mlt.UsageError, match="must not be negative"):
        mlt.start(scene, mlt.MLT(mutations=[mlt.Lens(), (Nudge(), -1)]), spp=1)


def test_scene_propose_takes_python_too(scene):
    x = path_like(scene, "LDE")
    proposals = scene.propose(x, Nudge(), count=50, seed=1)
    assert len(proposals) > 20
    assert all(abs(np.subtract(y.raster, x.raster)).max() <= 2.001 for y in proposals)
    assert max(y.acceptance for y in proposals) > 0.8
