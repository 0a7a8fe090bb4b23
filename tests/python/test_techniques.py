"""The table of strategies: an image for each technique (s, t), raw and weighted."""

from pathlib import Path

import numpy as np
import pytest
import tiny
from test_cli import PYMLT, mlt_render, run

import pymlt as mlt


@pytest.fixture(scope="module")
def result():
    return mlt.start(tiny.scene(), mlt.BDPT(max_depth=3, techniques=True), spp=16).result()


def test_there_is_an_image_for_each_technique(result):
    expected = {(s, k + 1 - s) for k in (1, 2, 3) for s in range(k + 2)}
    assert set(result.techniques) == expected
    for technique in result.techniques.values():
        assert technique.raw.shape == technique.weighted.shape == result.image.shape
        assert (technique.weighted <= technique.raw + 1e-6).all()


def test_weighted_images_add_up_to_the_render(result):
    total = sum(technique.weighted for technique in result.techniques.values())
    assert total == pytest.approx(result.image, rel=1e-3, abs=1e-4)


def test_a_technique_alone_finds_what_it_can(result):
    raw = {key: technique.raw.sum() for key, technique in result.techniques.items()}
    assert all(raw[s, t] == 0 for s, t in raw if t == 0)  # a pinhole cannot be hit
    assert raw[1, 2] > 0
    assert raw[2, 1] > 0


def test_a_render_without_techniques_has_none():
    assert mlt.start(tiny.scene(), "bdpt", spp=1).result().techniques == {}


def test_an_exr_holds_them_as_layers(result, tmp_path):
    result.write(tmp_path / "a.exr")
    assert np.array_equal(mlt.read_image(tmp_path / "a.exr"), result.image)
    for (s, t), technique in result.techniques.items():
        for kind in "raw", "weighted":
            layer = mlt.read_image(tmp_path / "a.exr", f"{kind}.s{s}.t{t}")
            assert np.array_equal(layer, getattr(technique, kind))


def test_a_png_has_the_pyramid_beside_it(result, tmp_path):
    result.write(tmp_path / "a.png", exposure=1)
    assert sorted(p.name for p in tmp_path.iterdir()) == ["a.png", "a.techniques.png"]
    pyramid = mlt.read_image(tmp_path / "a.techniques.png")
    assert pyramid.shape[0] > 2 * 3 * 12  # two blocks of three rows
    assert pyramid[0, 0] == pytest.approx(1)  # on white
    other = tmp_path / "b"
    other.mkdir()
    result.write(other / "a.png")
    assert mlt.read_image(other / "a.techniques.png").mean() < pyramid.mean()


def test_an_ordinary_png_is_alone(tmp_path):
    mlt.start(tiny.scene(), "bdpt", spp=1).result().write(tmp_path / "a.png")
    assert [p.name for p in tmp_path.iterdir()] == ["a.png"]


def test_both_programs_write_the_same_techniques(tmp_path, monkeypatch):
    binary = mlt_render() or pytest.skip("mlt-render is not installed beside this Python")
    monkeypatch.chdir(tmp_path)
    Path("scene.xml").write_text(tiny.XML)
    flags = ["scene.xml", "--integrator", "bdpt", "-p", "techniques=true", "-p", "max_depth=3"]
    for name, command in {"a": [*PYMLT, "render"], "b": binary}.items():
        done = run(command, *flags, "--spp", 4, "-o", f"{name}.exr", "-o", f"{name}.png")
        assert done.returncode == 0, done.stderr
    for suffix in ".exr", ".png", ".techniques.png":
        assert Path(f"a{suffix}").read_bytes() == Path(f"b{suffix}").read_bytes()
    assert mlt.read_image("b.exr", "weighted.s1.t2").max() > 0
