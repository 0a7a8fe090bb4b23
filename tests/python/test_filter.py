"""Another reconstruction filter than the scene's own, by `filter=` and --filter."""

import pickle
from pathlib import Path

import numpy as np
import pytest
import tiny
from command_line import PYMLT, run

import pymlt as mlt

BOX = '<rfilter type="box"/>'
FILMS = {
    "with a filter": tiny.XML,
    "without": tiny.XML.replace(BOX, ""),
    "with a reference": tiny.XML.replace(BOX, '<ref id="sharp"/>').replace(
        "<integrator", '<rfilter type="box" id="sharp"/>\n<integrator', 1
    ),
}


def pixels(scene) -> np.ndarray:
    return mlt.render(scene, "path", spp=4, seed=1)


@pytest.fixture(scope="module")
def tent() -> np.ndarray:
    return pixels(mlt.load_string(tiny.XML.replace(BOX, '<rfilter type="tent"/>')))


@pytest.mark.parametrize("film", FILMS)
def test_it_replaces_that_of_the_film(tent, film):
    scene = mlt.load_string(FILMS[film], filter="tent")
    assert scene.info()["filter"] == "tent"
    assert np.array_equal(pixels(scene), tent)
    for same in pickle.loads(pickle.dumps(scene)), scene.with_sensor(0):
        assert np.array_equal(pixels(same), tent)
    assert mlt.load_string(FILMS[film]).hash != scene.hash


def test_every_way_to_load_takes_it(tent, tmp_path):
    path = tmp_path / "scene.xml"
    path.write_text(tiny.XML)
    for scene in (
        mlt.load(path, filter="tent"),
        mlt.load_file(path, filter="tent"),
        mlt.load_dict(tiny.scene(), filter="tent"),
    ):
        assert np.array_equal(pixels(scene), tent)


def test_a_sensor_without_a_film_gets_one():
    scene = tiny.scene()
    del scene["sensor"]["film"]
    loaded = mlt.load_dict(scene, filter="tent", size=(16, 12))
    assert loaded.info()["filter"] == "tent"


@pytest.mark.parametrize(("name", "reason"), [("bxo", "did you mean 'box'"), (3, "filter is 3")])
def test_other_names_are_refused(name, reason):
    with pytest.raises(mlt.Error, match=reason):
        mlt.load_dict(tiny.scene(), filter=name)


def test_a_resumed_render_keeps_it(program, scene):
    flags = ["--filter", "tent", "--integrator", "path", "--seed", 1]
    run(program, scene, *flags, "--spp", 2, "--checkpoint", "a.mlt", "-o", "a.exr")
    assert run(program, "--resume", "a.mlt", "--spp", 4, "-o", "a.exr").returncode == 0
    whole = pixels(mlt.load(scene, filter="tent"))
    assert np.array_equal(mlt.read_image("a.exr"), whole)


def test_a_resumed_built_in_scene_keeps_it(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    flags = ["furnace", "--size", "16x12", "--filter", "tent", "-o", "a.exr"]
    run(PYMLT, "render", *flags, "--spp", 2, "--checkpoint", "a.mlt")
    done = run(PYMLT, "render", "--resume", "a.mlt", "--spp", 4, "-o", "b.exr")
    assert done.returncode == 0, done.stderr
    run(PYMLT, "render", *flags, "--spp", 4)
    assert Path("a.exr").read_bytes() == Path("b.exr").read_bytes()
