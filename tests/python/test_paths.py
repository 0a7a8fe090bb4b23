"""Looking at single paths: their terms, where they come from, and samples that are repeated."""

import numpy as np
import pytest
import tiny

import pymlt as mlt

HEURISTICS = ["balance", "power", "maximum"]


@pytest.fixture(scope="module")
def scene():
    return mlt.load_string(tiny.XML)


@pytest.fixture(scope="module")
def sampled(scene):
    """Paths of all kinds of techniques."""
    return [scene.sample_path(seed=seed, max_depth=6) for seed in range(200)]


@pytest.fixture(scope="module")
def traced(scene):
    """Paths that path tracing finds, in every fourth pixel of the lower half."""
    pixels = [(x, y) for x in range(0, 16, 4) for y in range(6, 12)]
    return [scene.trace_path(pixel=p, seed=s, max_depth=6) for p in pixels for s in range(4)]


# ---- paths as values ----------------------------------------------------------------------------


def test_a_path_tells_what_it_is(sampled):
    for path in sampled:
        x = path.vertices
        assert len(path) == len(x) == path.edges + 1
        assert list(x["kind"]) == ["light"] + ["surface"] * (path.edges - 1) + ["camera"]
        letters = ["D" if lobe == "smooth" else "S" for lobe in x["lobe"][1:-1]]
        assert path.signature == "L" + "".join(letters) + "E"
        assert (x["emitter"] >= 0).tolist() == [True] + [False] * path.edges
        assert x["position"][-1] == pytest.approx([0, 1, 4])
        assert np.linalg.norm(x["normal"][1:-1], axis=1) == pytest.approx(1)
        assert repr(path).startswith(f"LightPath('{path.signature}', raster=(")
        assert sum(path.technique) == path.edges + 1
    assert {"LDE", "LDSSE", "LSSDE"} <= {path.signature for path in sampled}


def test_the_ball_is_the_only_specular_shape(sampled):
    shapes = np.concatenate([path.vertices for path in sampled])
    specular = shapes[shapes["lobe"] != "smooth"]
    assert len(specular) > 20
    assert len(set(specular["shape"])) == 1
    assert set(shapes["shape"]) == {-1, 0, 1, 2}  # -1: the lens
    assert {"reflection", "transmission"} <= set(specular["lobe"])


def test_a_path_depends_on_the_seed_alone(scene):
    paths = [scene.sample_path(seed=s) for s in (1, 1, 2)]
    assert np.array_equal(paths[0].vertices, paths[1].vertices)
    assert not np.array_equal(paths[0].vertices["position"], paths[2].vertices["position"])


def test_a_traced_path_meets_its_pixel(scene):
    for pixel in (3, 9), (15, 11):
        path = scene.trace_path(pixel=pixel)
        assert tuple(int(c) for c in path.raster) == pixel
        assert path.technique[0] in (0, 1)


def test_max_depth_bounds_paths(scene):
    assert {scene.sample_path(seed=s, max_depth=2).edges for s in range(30)} <= {1, 2}
    assert scene.sample_path(max_depth=-1).edges >= 1
    with pytest.raises(mlt.UsageError, match="max_depth"):
        scene.sample_path(max_depth=0)


def test_where_it_is_dark_no_path_is_found(scene):
    with pytest.raises(mlt.RenderError, match=r"no light path found through pixel \(0, 0\)"):
        scene.trace_path(pixel=(0, 0), max_depth=1)
    with pytest.raises(mlt.UsageError, match=r"pixel \(16, 0\) is outside .* 16 x 12"):
        scene.trace_path(pixel=(16, 0))


# ---- terms --------------------------------------------------------------------------------------


@pytest.mark.parametrize("heuristic", HEURISTICS)
def test_weights_sum_to_one(sampled, traced, heuristic):
    for path in sampled + traced:
        weights = path.weights(heuristic)
        assert weights.shape == (path.edges + 2,)
        assert weights.sum() == pytest.approx(1, rel=1e-12)
        assert ((weights > 0) <= (path.densities() > 0)).all()


def test_weights_are_functions_of_the_densities(sampled):
    for path in sampled:
        p = path.densities() / path.densities().max()
        assert path.weights("balance") == pytest.approx(p / p.sum(), rel=1e-9)
        assert path.weights("power") == pytest.approx(p**2 / (p**2).sum(), rel=1e-9)
        assert path.weights("maximum").argmax() == p.argmax()


def test_an_unknown_heuristic_is_refused(sampled):
    with pytest.raises(mlt.UsageError, match="did you mean 'balance'"):
        sampled[0].weights("balanse")


def test_a_sampled_path_brings_its_weighted_contribution_over_its_density(sampled):
    for path in sampled:
        s = path.technique[0]
        expected = path.contribution() / path.densities()[s] * path.weights()[s]
        assert path.estimate == pytest.approx(expected, rel=1e-9)


def test_a_traced_path_brings_it_with_weights_of_two_techniques(traced):
    for path in traced:
        s = path.technique[0]
        p = path.densities()
        weight = 1 if path.edges == 1 else p[s] ** 2 / (p[0] ** 2 + p[1] ** 2)
        # The tracer has used the directions of its rays, the terms those between rounded positions.
        assert path.estimate == pytest.approx(path.contribution() / p[s] * weight, rel=1e-5)


# ---- replay -------------------------------------------------------------------------------------


def box_image(scene, replays):
    """What a box filter makes of all paths of the replays, one for each pixel."""
    image = np.zeros((scene.height, scene.width, 3))
    for replay in replays:
        for path in replay.paths:
            x, y = (int(c) for c in path.raster)
            image[y, x] += path.estimate
    return image


@pytest.mark.parametrize(
    "integrator",
    [
        mlt.Path(max_depth=6),
        mlt.BDPT(max_depth=6),
        mlt.BDPT(max_depth=4, light_image=False, heuristic="balance"),
        mlt.BDPT(max_depth=4, sample_direct=False, techniques=True),
        mlt.PTracer(max_depth=6),
        mlt.Direct(),
        mlt.Direct(emitter_samples=3, bsdf_samples=2),
    ],
    ids=repr,
)
def test_replays_of_all_pixels_are_the_render(scene, integrator):
    job = mlt.start(scene, integrator, spp=1, seed=4)
    image = job.result().image
    pixels = [(x, y) for y in range(scene.height) for x in range(scene.width)]
    replays = [job.replay(pixel) for pixel in pixels]
    assert box_image(scene, replays) == pytest.approx(image, rel=1e-5, abs=1e-7)
    assert repr(replays[0]).startswith("Replay((0.")
    if integrator.name == "path":
        # A render computes diffuse vertices in single precision, a replay in double.
        seen = np.reshape([r.radiance for r in replays], image.shape)
        assert seen == pytest.approx(image, rel=1e-5)
    for replay in replays:
        of_sample = [p.estimate for p in replay.paths if p.technique[1] >= 2]
        assert sum(of_sample, np.zeros(3)) == pytest.approx(replay.radiance, rel=1e-9)
    layers = job.result().techniques
    again = mlt.start(scene, integrator, spp=1, seed=4).result().techniques
    assert all(np.array_equal(layers[key].raw, again[key].raw) for key in layers)


def test_later_samples_are_replayed_too(scene):
    spp, pixel = 19, (7, 9)  # more than the groups that samples are dealt to
    integrator = mlt.Path(max_depth=4)
    image = mlt.render(scene, integrator, spp=spp, seed=2)
    replays = [mlt.replay(scene, integrator, pixel=pixel, sample=i, seed=2) for i in range(spp)]
    assert len({r.raster for r in replays}) == spp
    assert np.mean([r.radiance for r in replays], axis=0) == pytest.approx(image[9, 7], rel=1e-5)


def test_what_cannot_be_replayed_is_refused(scene):
    with pytest.raises(mlt.UsageError, match="no samples of single pixels"):
        mlt.replay(scene, "mlt", pixel=(0, 0))
    with pytest.raises(mlt.UsageError, match="outside of the image"):
        mlt.replay(scene, "path", pixel=(0, 10**6))
    with pytest.raises(mlt.UsageError, match="a coordinate of pixel is -1"):
        mlt.replay(scene, "path", pixel=(0, -1))
    with pytest.raises(mlt.UsageError, match="sample is -1"):
        mlt.replay(scene, "path", pixel=(0, 0), sample=-1)


# ---- proposals ----------------------------------------------------------------------------------


def path_like(scene, signature):
    """The first sampled path with this signature."""
    paths = (scene.sample_path(seed=s, max_depth=6) for s in range(2000))
    return next(path for path in paths if path.signature == signature)


def test_proposals_of_the_lens_perturbation_keep_the_light_side(scene):
    x = path_like(scene, "LDE")
    proposals = scene.propose(x, mlt.Lens(), count=200, seed=1)
    assert len(proposals) > 20
    assert all(0 <= y.acceptance <= 1 for y in proposals)
    assert max(y.acceptance for y in proposals) > 0.5
    for y in proposals:
        assert np.array_equal(y.vertices[0]["position"], x.vertices[0]["position"])
        assert not np.array_equal(y.vertices[1]["position"], x.vertices[1]["position"])
        assert y.raster != x.raster
    assert repr(proposals[0]).endswith(f"acceptance={proposals[0].acceptance:.3g})")


def test_a_mutation_that_does_not_suit_is_refused(scene):
    x = path_like(scene, "LDSSE")
    with pytest.raises(mlt.UsageError, match="caustic mutation does not act on a path LDSSE"):
        scene.propose(x, mlt.Caustic())
    with pytest.raises(mlt.UsageError, match="did you mean 'caustic'"):
        scene.propose(x, "caustik")
    with pytest.raises(mlt.UsageError, match="another scene"):
        mlt.load_string(tiny.XML).propose(x, mlt.Lens())
