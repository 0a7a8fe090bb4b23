"""The table of strategies: an image for each technique (s, t), raw and weighted."""

import sys
from pathlib import Path

import numpy as np
import pytest
import tiny
from test_cli import PYMLT, mlt_render, run

import pymlt as mlt
from pymlt.pictures.techniques import technique_figure


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


@pytest.mark.parametrize("write", [mlt.Result.write, mlt.Result.save], ids=["write", "save"])
def test_a_png_has_the_table_beside_it(result, tmp_path, write):
    pytest.importorskip("matplotlib")
    write(result, tmp_path / "a.png", exposure=1)
    assert sorted(p.name for p in tmp_path.iterdir()) == ["a.png", "a.techniques.png"]
    table = mlt.read_image(tmp_path / "a.techniques.png")
    assert table[0, 0] == pytest.approx(1)  # on white
    other = tmp_path / "b"
    other.mkdir()
    write(result, other / "a.png")
    assert mlt.read_image(other / "a.techniques.png").mean() < table.mean()


def test_the_table_has_light_vertices_down_and_camera_vertices_across(result):
    pytest.importorskip("matplotlib")
    for axes in technique_figure(result.techniques, 0).axes:
        places = {tuple(np.mean(np.reshape(a.get_extent(), (2, 2)), axis=1)) for a in axes.images}
        # No light walk hits a pinhole, which is t = 0, j = -1.
        assert places == {(t - 1, s - 1) for s, t in result.techniques if t > 0}
        assert (axes.get_xlabel(), axes.get_ylabel()) == ("camera vertex j", "light vertex i")
        assert axes.get_xticks().tolist() == [0, 1, 2, 3]
        assert axes.get_yticks().tolist() == [-1, 0, 1, 2]
        assert axes.yaxis_inverted()
    hit = result.techniques | {(2, 0): mlt.Technique(result.image, result.image)}
    assert technique_figure(hit, 0).axes[0].get_xticks()[0] == -1


def test_the_images_are_the_right_way_up(result):
    pytest.importorskip("matplotlib")
    raw, _ = technique_figure(result.techniques, 1).axes
    (shown,) = [a for a in raw.images if np.mean(a.get_extent()[:2]) == 1
                and np.mean(a.get_extent()[2:]) == 0]  # fmt: skip
    light = np.clip(2 * result.techniques[1, 2].raw, 0, 1)
    assert np.argmax(shown.get_array().sum(axis=(1, 2))) == np.argmax(light.sum(axis=(1, 2)))
    assert shown.get_extent()[2] > shown.get_extent()[3]  # row 0 on top
    assert raw.get_aspect() == pytest.approx(light.shape[0] / light.shape[1])


def test_without_matplotlib_the_image_is_written_and_the_table_is_missed(
    result, tmp_path, monkeypatch
):
    monkeypatch.setitem(sys.modules, "matplotlib.figure", None)
    where, problem = result._save(tmp_path / "a.png")
    assert Path(where).exists()
    assert "the picture of the techniques needs `pip install 'matplotlib" in problem
    with pytest.raises(mlt.UsageError, match="pip install 'matplotlib"):
        result.write(tmp_path / "b.png")
    assert (tmp_path / "b.png").exists()


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
    for suffix in ".exr", ".png":
        assert Path(f"a{suffix}").read_bytes() == Path(f"b{suffix}").read_bytes()
    assert mlt.read_image("b.exr", "weighted.s1.t2").max() > 0
