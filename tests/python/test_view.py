"""The live view, without a browser: its camera, pictures, renders, paths and examples."""

import re
import signal
import subprocess
import sys
import time
import urllib.request
from pathlib import Path
from types import SimpleNamespace

import numpy as np
import pytest
import tiny
from command_line import PYMLT

import pymlt as mlt
from pymlt.cli import main, make_parser
from pymlt.cli.view import given_token
from pymlt.pictures.tonemapping import CURVES, encode_srgb, tonemap

viser = pytest.importorskip("viser", reason="the view needs viser (pip install viser)")
rich = pytest.importorskip("rich")
console = pytest.importorskip("rich.console")

from pymlt.viewing import (  # noqa: E402
    formula,
    labels,
    lecture_chains,
    lecture_examples,
    lecture_mixing,
    lecture_products,
    path_tables,
    shown,
    walk,
    world,
)
from pymlt.viewing.camera import Pose, SceneCamera  # noqa: E402
from pymlt.viewing.frame import Frame  # noqa: E402
from pymlt.viewing.live import Algorithm, LiveRender  # noqa: E402
from pymlt.viewing.pixel_paths import brightness, paths_through  # noqa: E402

BUILT_IN = mlt.scenes.names()


def built_in(name: str, **more):
    return mlt.load_dict(getattr(mlt.scenes, name)(), **more)


def test_bad_arguments_are_one_line(capsys, tmp_path):
    with pytest.raises(mlt.SceneError, match="path"):
        mlt.view(tiny.scene(), "pat")
    assert main(["view", "ring", "--host", "0.0.0.0"]) == 2
    assert "token" in capsys.readouterr().err
    assert main(["view", "no-such-scene"]) == 2
    assert main(["view", "ring", "--port", "many"]) == 2
    assert main(["view"]) == 2
    assert "--lecture for the examples" in capsys.readouterr().err
    for more in (["ring"], ["--size", "8x8"], ["--sensor", "0"], ["-p", "max_depth=3"]):
        assert main(["view", "--lecture", *more]) == 2


def test_nothing_is_printed_in_a_notebook(monkeypatch):
    """There rich, by which viser prints, displays what it has to say."""
    said = []
    monkeypatch.setattr("rich.jupyter.display", lambda *what: said.append(what))
    monkeypatch.setattr("rich._console", console.Console(force_jupyter=True))
    mlt.view(tiny.scene()).stop()
    assert said == []
    rich.print("later")
    assert len(said) == 1


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        (["--token", "sesame"], "--token-file FILE, or into the environment variable"),
        (["--token=sesame"], "--token-file FILE, or into the environment variable"),
        (["--token-file", "no-such-file"], "no-such-file: cannot read the token"),
        (["--token-file", "/"], "/: cannot read the token"),
        (["--token-file", "blank"], "the token is blank"),
        (["--token", "--open"], "--open would show the token"),
    ],
)
def test_a_token_that_others_could_read_or_guess_is_refused(
    arguments, message, capsys, tmp_path, monkeypatch
):
    monkeypatch.chdir(tmp_path)
    Path("blank").write_text(" \n")
    assert main(["view", "ring", *arguments]) == 2
    said = capsys.readouterr().err
    assert message in said
    assert said.count("\n") == 1


def test_a_token_comes_from_a_file_or_the_environment(tmp_path, monkeypatch):
    word = tmp_path / "word"
    word.write_text("sesame\n")
    parser = make_parser()
    assert given_token(parser.parse_args(["view", "ring"])) is None
    assert given_token(parser.parse_args(["view", "ring", "--token-file", str(word)])) == "sesame"
    monkeypatch.setenv("PYMLT_VIEW_TOKEN", "another")
    assert given_token(parser.parse_args(["view", "ring"])) == "another"
    assert given_token(parser.parse_args(["view", "ring", "--token-file", str(word)])) == "sesame"


def test_without_the_extra_one_line_says_how_to_install_it(monkeypatch):
    monkeypatch.setitem(sys.modules, "viser", None)
    with pytest.raises(mlt.UsageError, match="pip install 'viser>="):
        mlt.view(tiny.scene())


def test_import_does_not_load_viser():
    code = "import sys, pymlt, pymlt.cli; print('viser' in sys.modules, 'numpy' in sys.modules)"
    said = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert said.stdout.split() == ["False", "False"]


# ---- cameras and frames


@pytest.mark.parametrize("name", BUILT_IN)
def test_the_browsers_camera_is_that_of_the_scene(name):
    """A scene that is seen from the pose that its own camera has gives the same image."""
    size = (48, 27) if built_in(name).width != built_in(name).height else (32, 32)
    scene = built_in(name, size=size)
    camera = SceneCamera(scene)
    moved = camera.scene(camera.pose)
    middle = np.array([[size[0] / 2 + 5.0, size[1] / 2 - 3.0], [0.0, 0.0]])
    for one, other in zip(scene.camera_rays(middle), moved.camera_rays(middle), strict=True):
        np.testing.assert_allclose(one, other, atol=1e-6)
    assert camera.scene(None) is scene
    assert (camera.scene(None, 4).width, camera.scene(None, 4).height) == (
        -(-size[0] // 4),
        -(-size[1] // 4),
    )
    assert camera.pose.is_near(camera.pose, camera.radius)
    assert abs(np.dot(camera.up, camera.target - camera.position)) < np.linalg.norm(
        camera.target - camera.position
    )


def test_a_camera_and_its_film_may_have_names_of_their_own():
    d = tiny.scene()
    d["eye"] = d.pop("sensor")
    film = d["eye"].pop("film")
    d["eye"]["frame"] = film | {"id": "frame"}
    camera = SceneCamera(mlt.load_dict(d))
    moved = camera.scene(Pose((0.0, 2.0, 5.0), camera.pose.wxyz), 2)
    assert moved.width == 8
    starts, _ = moved.camera_rays(np.zeros((1, 2)))
    np.testing.assert_allclose(starts[0], [0, 2, 5])


def test_fov_is_that_of_the_image_from_top_to_bottom():
    d = tiny.scene()
    d["sensor"]["film"] |= {"width": 40, "height": 20}
    d["sensor"] |= {"fov": 60, "fov_axis": "y"}
    camera = SceneCamera(mlt.load_dict(d))
    assert np.degrees(camera.fov) == pytest.approx(60)


@pytest.mark.parametrize("sensor", [{"type": "spherical"}, {"type": "fisheye", "fov": 360}])
def test_a_camera_that_sees_all_around_has_a_pose_of_its_own(sensor):
    d = tiny.scene()
    placed = mlt.Transform.look_at([1, 2, 3], [0, 1, 0], [0, 1, 0])
    d["sensor"] = sensor | {"to_world": placed, "film": d["sensor"]["film"] | {"width": 48}}
    scene = mlt.load_dict(d)
    camera = SceneCamera(scene)
    assert camera.fov == 0.7
    rasters = np.array([[24.0, 3.0], [26.0, 9.0]])
    moved = camera.scene(camera.pose)
    for one, other in zip(scene.camera_rays(rasters), moved.camera_rays(rasters), strict=True):
        np.testing.assert_allclose(one, other, atol=1e-6)


def test_a_meter_stays_on_its_shape():
    d = tiny.scene()
    film = {"type": "hdrfilm", "width": 1, "height": 1, "rfilter": {"type": "box"}}
    del d["sensor"]
    d["plate"] = {"type": "rectangle", "meter": {"type": "irradiancemeter", "film": film}}
    camera = SceneCamera(mlt.load_dict(d))
    assert camera.scene(camera.pose, 2).width == 1


def test_a_pose_is_kept_by_the_way_to_the_scene_and_back():
    from viser.transforms import SO3

    rotation = SO3.from_rpy_radians(0.3, -1.1, 2.0)
    pose = Pose((1.0, 2.0, 3.0), tuple(rotation.wxyz))
    matrix = pose.to_world()
    np.testing.assert_allclose(np.linalg.det(matrix[:3, :3]), 1)
    np.testing.assert_allclose(matrix[:3, 2], rotation.as_matrix()[:, 2])  # both look along +z
    np.testing.assert_allclose(matrix[:3, 1], -rotation.as_matrix()[:, 1])  # y is up, not down


@pytest.mark.parametrize("window", [0.4, 1.0, 16 / 9, 3.0])
def test_an_image_fits_the_window(window):
    frame = Frame(16 / 9, window)
    picture = np.full((36, 64, 3), 200, np.uint8)
    filled = frame.fill(picture)
    assert filled.shape[1] / filled.shape[0] == pytest.approx(window, rel=0.03)
    rows, columns = np.nonzero(filled[..., 0] == 200)
    assert (np.ptp(rows) + 1, np.ptp(columns) + 1) == (36, 64)
    h, w = filled.shape[:2]
    x, y = frame.place((columns.min() + 0.5) / w, (rows.min() + 0.5) / h)
    assert (int(x * 64), int(y * 36)) == (0, 0)
    assert frame.place(0.5, 0.5) == (0.5, 0.5)
    if window > 16 / 9:
        assert frame.place(0.01, 0.5) is None
    # The window's angle shows the image's: the top of the image is where the frame says.
    assert np.tan(frame.fov(0.8) / 2) * frame.height == pytest.approx(np.tan(0.4))


# ---- pictures


@pytest.mark.parametrize("curve", CURVES)
@pytest.mark.parametrize("exposure", [0, 2.5, -4])
def test_the_quick_picture_is_that_of_tonemap(curve, exposure):
    rng = np.random.default_rng(1)
    image = np.exp(rng.normal(-1, 3, (20, 30, 3))).astype(np.float32)
    image[0, :3] = [[np.nan, 0, 1], [np.inf, 0, 0], [-1, 0.5, 1e9]]
    exact = np.floor(255 * encode_srgb(tonemap(image, curve, exposure=exposure)) + 0.5)
    quick = shown.picture(image, exposure, curve).astype(int)
    sane = np.isfinite(image).all(axis=2)
    assert abs(quick - exact)[sane].max() <= 1


@pytest.mark.parametrize("layer", shown.AOVS)
def test_layers_have_a_picture(layer):
    scene = tiny.scene()
    scene["sensor"]["medium"] = {"type": "homogeneous", "sigma_t": 0.3}
    result = mlt.start(scene, "direct", spp=1, aovs=layer).result()
    picture = shown.layer_picture(layer, result.layers[layer])
    assert picture.dtype == np.uint8
    assert picture.shape == result.image.shape
    assert np.ptp(picture) > 20


def test_two_pictures_share_the_width():
    left, right = np.zeros((4, 10, 3), np.uint8), np.full((4, 10, 3), 100, np.uint8)
    both = shown.split(left, right, 0.6)
    assert both[0, :, 0].tolist() == [0] * 5 + [255, 255] + [100] * 3
    assert (shown.split(left, right, 0)[:, 1:] == 100).all()
    assert (shown.split(left, right, 1)[:, :-1] == 0).all()


def test_a_small_picture_is_enlarged_by_whole_pixels():
    small = np.arange(6, dtype=np.uint8).reshape(2, 3, 1)
    large = shown.enlarged(small, (7, 4))
    assert large.shape == (4, 7, 1)
    assert (large[:2, :3] == 0).all()
    assert large[-1, -1] == 5


@pytest.mark.parametrize("scale", [0.1, 0.6, 1.5])
@pytest.mark.parametrize("pixel", [(20, 30), (0, 0), (63, 47)])
def test_the_mark_leaves_its_pixel_free(pixel, scale):
    grey = np.full((48, 64, 3), 128, np.uint8)
    picture = shown.marked(grey, pixel, scale)
    x, y = pixel
    changed = (picture != grey).any(axis=2)
    rows, columns = np.nonzero(changed)
    assert not changed[max(0, y - 1) : y + 2, max(0, x - 1) : x + 2].any()
    assert set(np.unique(picture[changed])) == {0, 255}
    most = max(35 * scale, 6) + 3
    assert abs(rows - y).max() <= most
    assert abs(columns - x).max() <= most
    assert (grey == 128).all()


def test_the_error_map_is_relative():
    image = np.ones((2, 2, 3))
    picture = shown.error_picture(image, np.array([[0.0, 0.5], [2.0, 9.0]])[..., None] * image)
    brightness = picture.astype(int).sum(axis=2)
    assert brightness[0, 0] < brightness[0, 1] < brightness[1, 0] == brightness[1, 1]


# ---- renders


def run_live(live: LiveRender, until, seconds=60) -> None:
    end = time.monotonic() + seconds
    while not until():
        live.advance(0.02)
        assert time.monotonic() < end
        time.sleep(0.005)


def test_small_pictures_come_first_and_then_the_render_refines():
    camera = SceneCamera(built_in("cornell_box", size=(128, 128)))
    live = LiveRender(2)
    live.start(lambda d: camera.scene(None, d), [Algorithm("path", "max_depth=4")], 60)
    sizes = []
    while live.is_early:
        if live.advance(0.02) and live.small is not None:
            sizes.append(live.small.shape[0])
    assert sizes == [32, 64]
    run_live(live, lambda: live.image() is not None)
    first = live.jobs[0].samples
    run_live(live, lambda: live.jobs[0].samples > first + 2)
    assert live.image().shape == (128, 128, 3)
    live.stop()
    run_live(live, lambda: not live.running)
    stopped = live.jobs[0].samples
    assert live.resume(30)
    run_live(live, lambda: live.jobs[0].samples > stopped + 1)
    live.discard()
    assert live.image() is None


def test_two_renders_have_equal_shares_of_the_processors():
    camera = SceneCamera(mlt.load_dict(tiny.scene()))
    live = LiveRender(4)
    algorithms = [Algorithm("path"), Algorithm("direct")]
    live.start(lambda d: camera.scene(None, d), algorithms, 1)
    run_live(live, lambda: live.jobs and not live.running)
    live.check()
    assert [job.stats["integrator"] for job in live.jobs] == ["path", "direct"]
    assert all(job.stats["ended_by"] == "time" for job in live.jobs)


@pytest.mark.parametrize(
    ("name", "parameters", "message"),
    [
        ("path", "max_depht=4", "max_depth"),
        ("path", "max_depth", "NAME=VALUE"),
        ("path", "max_depth=many", "max_depth"),
        ("path", "=3", "NAME=VALUE"),
        ("no_such", "", "no_such"),
    ],
)
def test_bad_parameters_leave_the_render_as_it_is(name, parameters, message):
    camera = SceneCamera(mlt.load_dict(tiny.scene()))
    live = LiveRender(1)
    live.start(lambda d: camera.scene(None, d), [Algorithm("path")], 60)
    run_live(live, lambda: bool(live.jobs))
    job = live.jobs[0]
    with pytest.raises(mlt.Error, match=message):
        live.start(lambda d: camera.scene(None, d), [Algorithm(name, parameters)], 60)
    assert live.jobs == [job]
    assert not job.ended
    live.discard()


# ---- paths


def box_scene(**more):
    d = mlt.scenes.glass_ball()
    d["sensor"]["film"]["rfilter"] = {"type": "box"}
    return mlt.load_dict(d | more, size=(12, 12))


@pytest.fixture(scope="module")
def found():
    return paths_through(box_scene(), (6, 8), 2000, 6)


def test_the_paths_of_a_pixel_add_up_to_its_light(found):
    """All but what techniques with t = 1 find, which other samples splat here."""
    result = mlt.start(
        box_scene(), mlt.BDPT(max_depth=6, techniques=True), spp=2000, seed=1
    ).result()
    techniques = result.techniques
    here = {key: float(both.weighted[8, 6].mean()) for key, both in techniques.items()}
    total = sum(here.values())
    expected = sum(value for (_, t), value in here.items() if t >= 2)
    assert sum(map(brightness, found.paths)) / found.samples == pytest.approx(expected, rel=0.06)
    assert sum(found.shares.values()) == pytest.approx(1)
    for key, value in here.items():
        assert found.shares.get(key, 0) == pytest.approx(value / total, abs=0.03), key


def test_signatures_and_the_paths_to_look_at(found):
    signatures = found.signatures()
    assert sum(count for count, _ in signatures.values()) == len(found.paths)
    assert sum(share for _, share in signatures.values()) == pytest.approx(1)
    for signature, (count, _) in signatures.items():
        assert [path.signature for path in found.of(signature)] == [signature] * count
    some = found.some(len(signatures))
    assert [path.signature for path in some] == list(signatures)
    assert len(found.some(10_000)) == len(found.paths)


def test_tables_name_every_technique_and_vertex(found):
    path = next(p for p in found.paths if p.edges == 3)
    text = path_tables.path_text(path)
    assert [f"s={s}, t={4 - s}" in text for s in range(5)] == [True] * 5
    assert text.count("found it") == 1
    assert all(f">x{i}<" in text for i in range(4))
    assert "area⁻¹" in text
    assert "area<sup>-4</sup>" in text
    assert "light vertex<br>" in text
    assert "diffuse vertex<br>" in text
    assert path.signature in path_tables.signature_table(found)
    assert "t=0" in path_tables.strategy_table(found)


@pytest.fixture(scope="module")
def dispersed():
    """A path through the prism, and one that is not dispersed."""
    scene = mlt.load(tiny.of_cpp("prism"))
    paths = [scene.sample_path(seed=seed, max_depth=6) for seed in range(400)]
    return tuple(next(path for path in paths if path.dispersed == how) for how in (True, False))


def test_the_wavelengths_of_a_path_are_told(dispersed):
    alone, four = dispersed
    assert f"> {alone.wavelengths[0]:.0f} nm" in path_tables.path_text(alone)
    first, _, _, last = np.sort(four.wavelengths)
    for text in (path_tables.path_text(four), path_tables.place_table(four)):
        assert f"> {first:.0f}, " in text
        assert f", {last:.0f} nm" in text
    rgb = box_scene().sample_path(seed=3)
    assert " nm" not in path_tables.path_text(rgb)
    assert " nm" not in path_tables.place_table(rgb)


def test_a_path_has_the_colour_of_its_wavelengths(dispersed):
    assert path_tables.colour(box_scene().sample_path(seed=3)) == path_tables.WHITE
    scene = dispersed[0].scene
    paths = [scene.sample_path(seed=seed, max_depth=6) for seed in range(400)]
    alone = [path for path in paths if path.dispersed]
    shown = {path.wavelengths[0]: path_tables.colour(path) for path in alone}
    assert all(max(colour) == 255 for colour in shown.values())
    red = [np.argmax(colour) == 0 for nm, colour in shown.items() if nm > 600]
    green = [np.argmax(colour) == 1 for nm, colour in shown.items() if 510 < nm < 550]
    blue = [np.argmax(colour) == 2 for nm, colour in shown.items() if 430 < nm < 480]
    for right in (red, green, blue):
        assert right
        assert all(right)


def test_a_walk_is_the_chain_that_renders():
    scene = box_scene()
    start = scene.sample_path(seed=3, max_depth=6)
    stepper = walk.Walk(scene, start, 6, seed=4)
    steps = [stepper.step() for _ in range(200)]
    from pymlt.algorithms.mutations import built_in as mutations

    moves = [(m(), 1.0) for m in mutations]
    run = mlt.lab.metropolis.run(scene.path_target(max_depth=6), moves, start, 200, seed=5)
    assert [s.accepted for s in steps] == run.accepted.tolist()
    np.testing.assert_array_equal(stepper.path.vertices, run.states[-1].vertices)
    assert sum(count[0] for count in stepper.counts.values()) == 200
    for step in steps:
        assert step.outcome in ("accepted", "rejected", "found no path")
        assert not step.accepted or step.proposal is not None


def test_mutations_can_be_chosen_by_hand():
    scene = box_scene()
    stepper = walk.Walk(scene, scene.sample_path(seed=3, max_depth=6), 6)
    for _ in range(20):
        assert stepper.step("Lens").mutation in ("Lens", "")
    before = stepper.path
    stepper.step("Bidirectional")
    assert before.scene is stepper.path.scene
    assert set(walk.names()) >= {"the mixture", "Lens", "Bidirectional"}


# ---- shapes


def test_shapes_become_triangles():
    d = tiny.scene() | {
        "ball": {"type": "sphere", "center": [1, 2, 3], "radius": 0.5},
        "group": {"type": "shapegroup", "id": "g", "one": {"type": "cube"}},
        "copy": {
            "type": "instance",
            "to_world": mlt.Transform.translate([10, 0, 0]),
            "group": {"type": "ref", "id": "g"},
        },
    }
    shapes = mlt.load_dict(d).triangles()
    ball = next(s for s in shapes if abs(s["positions"].mean(axis=0) - [1, 2, 3]).max() < 0.05)
    distances = np.linalg.norm(ball["positions"] - [1, 2, 3], axis=1)
    np.testing.assert_allclose(distances, 0.5, rtol=1e-4)
    copy = next(s for s in shapes if s["positions"].mean(axis=0)[0] > 5)
    np.testing.assert_allclose(copy["positions"].min(axis=0), [9, -1, -1], atol=1e-6)
    assert len(copy["faces"]) == 12
    assert not any(np.abs(s["positions"]).max() == 1 and len(s["faces"]) == 12 for s in shapes)
    assert any(s["emits"] for s in shapes)
    assert all(s["faces"].max() < len(s["positions"]) for s in shapes)


def test_labels_that_would_lie_on_each_other_are_one():
    places = np.array([[0, 0, 5], [0.1, 0, 6], [2, 0, 5], [0, 0, 9.0], [0, 0.3, 5], [0, 0, -1]])
    camera = SimpleNamespace(position=(0, 0, 0), wxyz=(1, 0, 0, 0), image_height=800, fov=1.2)
    at = labels.seen_at(places, camera)
    scale = 400 / np.tan(0.6)
    np.testing.assert_allclose(at[[1, 4]], [(0.1 / 6 * scale, 0), (0, 0.3 / 5 * scale)])
    assert labels.overlapping(at) == [[0, 1, 3], [2], [4], [5]]
    camera.position, camera.wxyz = (-5, 0, 5), np.array([1, 0, 1, 0]) / np.sqrt(2)  # to the right
    assert labels.overlapping(labels.seen_at(places, camera)) == [[0, 2], [1], [3], [4], [5]]


def test_large_meshes_are_simplified():
    shapes = built_in("ring").triangles()
    ring = max(shapes, key=lambda s: len(s["faces"]))
    points, faces = world.simplified(ring["positions"], ring["faces"], 1000)
    assert 200 < len(faces) <= 1000
    assert faces.max() < len(points)
    size = np.ptp(ring["positions"], axis=0)
    np.testing.assert_allclose(
        points.min(axis=0), ring["positions"].min(axis=0), atol=0.1 * size.max()
    )
    same = world.simplified(ring["positions"], ring["faces"], 10**6)
    assert same[1] is ring["faces"]


# ---- the lecture


@pytest.mark.parametrize("example", lecture_examples.EXAMPLES, ids=lambda e: e.name)
def test_examples_run_with_every_end_of_their_sliders(example):
    usual = [slider.value for slider in example.sliders]
    for i, slider in enumerate(example.sliders):
        for value in (slider.low, slider.high):
            values = [*usual[:i], value, *usual[i + 1 :]]
            shown_ = example.run(*values)
            assert shown_.text
            for chart in shown_.charts:
                for curve in chart.curves:
                    assert curve.y.shape == chart.x.shape
                    assert np.isfinite(curve.y).all()


def test_formulas_become_html():
    assert formula.as_html("min(1, {f(y)}/{p_{i}^{−d}})") == (
        'min(1, <span class="over"><span><i>f</i>(<i>y</i>)</span>'
        "<span><i>p</i><sub><i>i</i></sub><sup>−<i>d</i></sup></span></span>)"
    )
    assert formula.as_html("a < b\nΣ") == "<i>a</i> &lt; <i>b</i><br>Σ"


@pytest.mark.parametrize("example", lecture_examples.EXAMPLES, ids=lambda e: e.name)
def test_every_formula_is_read_to_its_end_and_has_a_source(example):
    assert example.formula
    assert not set("{}_^") & set(formula.as_html(example.formula) + example.source)
    assert re.search(r"(19|20)\d\d", example.source)


def test_examples_say_what_the_lecture_says():
    two = lecture_chains.two_states(9, 0.5).charts[0]
    exact, chains = (
        next(c.y for c in two.curves if c.name == f"from b, {n}") for n in ("exact", "chains")
    )
    np.testing.assert_allclose(chains, exact, atol=5 * 0.5 / np.sqrt(4000))
    assert exact[-1] == pytest.approx(0.9, abs=0.01)
    assert "0.0 % of the samples" in lecture_chains.parabola(0.1, 0.9).text
    histogram, truth = (c.y for c in lecture_chains.mixture(0.5, 0.1, 0.9).charts[0].curves)
    assert abs(histogram - truth).max() < 0.5
    start = lecture_chains.start_up(0.9, 0.1).charts[0].curves
    assert abs(start[1].y - 0.5).max() < 5 * 0.39 / np.sqrt(4000)  # from the bootstrap
    assert start[0].y[5] > 0.7
    peak, truth = (c.y for c in lecture_mixing.adaptivity(0, 0.3).charts[0].curves)
    assert peak[-1] > truth[-1] + 0.04
    assert "0 % of the samples are on the right" in lecture_mixing.ergodicity(0.3, 0, 0).text
    for uniform, bridge in ((0.05, 0), (0, 0.3)):
        assert "has crossed 0 times" not in lecture_mixing.ergodicity(0.3, uniform, bridge).text
    basic, extended = (c.y for c in lecture_chains.recording(3).charts[0].curves)
    assert extended[0] < basic[0] - np.log10(2)
    assert extended[-1] == pytest.approx(basic[-1], abs=0.1)
    histogram, truth = (c.y for c in lecture_chains.tours(4, 0.1).charts[0].curves)
    assert abs(histogram - truth).max() < 0.5


@pytest.mark.parametrize("example", [lecture_products.blur, lecture_products.reflection])
def test_one_chain_estimates_many_integrals(example):
    """A hundred times as many steps divide the error by about ten."""

    def error(log_steps: float) -> float:
        exact, found = (c.y for c in example(log_steps, 5).charts[-1].curves[-2:])
        return float(np.sqrt(np.mean((found / exact - 1) ** 2)))

    assert error(4.5) < 0.05
    assert error(4.5) < 0.5 * error(2.5)


def test_the_charts_show_the_island_that_no_sample_is_on():
    by_step, histogram = lecture_mixing.ergodicity(0.3, 0, 0).charts
    assert by_step.span == (0, 1)
    assert by_step.curves[0].y.max() < 0.26
    found, truth = (curve.y for curve in histogram.curves)
    there = histogram.x > 0.55
    assert not found[there].any()
    assert truth[there] == pytest.approx(1 / 0.7)


# ---- the command


@pytest.mark.parametrize("number", [signal.SIGINT, signal.SIGTERM])
def test_a_signal_ends_the_command_soon(number):
    command = [*PYMLT, "view", "cornell-box", "--size", "32x32", "--port", "0", "-p", "max_depth=4"]
    with subprocess.Popen(
        command, stderr=subprocess.PIPE, stdout=subprocess.PIPE, text=True
    ) as run:
        line = run.stderr.readline()
        assert "http://localhost:" in line
        url = next(word for word in line.split() if word.startswith("http")).rstrip(";")
        with urllib.request.urlopen(url) as answer:
            assert answer.status == 200
        run.send_signal(number)
        start = time.monotonic()
        out, err = run.communicate(timeout=60)
        assert time.monotonic() - start < 10
        assert (out, err) == ("", "")
    assert run.returncode == 128 + number
