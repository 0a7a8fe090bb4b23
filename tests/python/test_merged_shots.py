"""Shots that are merged frame by frame, and what their files say that merging needs."""

import numpy as np
import pytest
from test_shot import shining

import pymlt as mlt
from pymlt.cli import main
from pymlt.images import read_with_layers

#: Windows of the frames 1 to 3, 3 to 5 and 5 to 8, whose seeds are 1, 3 and 5 more.
SHOT = {"frames": "1:8", "together": 4, "fps": 8}


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    """The shots a and b, of which b has twice as many samples."""
    folder = tmp_path_factory.mktemp("shots")
    for name, spp, seed in (("a", 32, 0), ("b", 64, 100)):
        output = folder / f"{name}.##.exr"
        mlt.render_shot(shining(), "bdpt", output=output, spp=spp, seed=seed, **SHOT)
    return folder


def test_files_tell_the_frame_and_what_it_is_made_of(folder):
    known = [mlt.read_metadata(folder / f"a.{frame:02}.exr") for frame in range(1, 9)]
    assert [told["frame"] for told in known] == [str(frame) for frame in range(1, 9)]
    assert [told["seed"] for told in known] == ["1", "1", "1 3", "3", "3 5", "5", "5", "5"]
    assert [float(told["spp"]) for told in known] == pytest.approx([32] * 8, rel=0.1)
    assert not any("light_groups" in told for told in known)


def test_frames_are_merged_one_by_one(folder, tmp_path):
    numbers = mlt.merge_shots([folder / "a.##.exr", folder / "b.##.exr"], tmp_path / "c.#.exr")
    assert numbers == list(range(1, 9))
    for frame in numbers:
        files = [folder / f"{name}.{frame:02}.exr" for name in "ab"]
        spp = [float(mlt.read_metadata(file)["spp"]) for file in files]
        weights = np.array(spp) / sum(spp)
        (image, layers), *parts = map(read_with_layers, [tmp_path / f"c.{frame}.exr", *files])
        expected = np.average([part for part, _ in parts], axis=0, weights=weights)
        np.testing.assert_allclose(image, expected, rtol=1e-5, atol=1e-7)
        errors = [w * part["error"] for w, (_, part) in zip(weights, parts, strict=True)]
        np.testing.assert_allclose(layers["error"], np.hypot(*errors), rtol=1e-5, atol=1e-7)
        assert mlt.read_metadata(tmp_path / f"c.{frame}.exr")["frame"] == str(frame)


def test_different_frames_are_not_merged(folder):
    """They are of one render each, of the same scene."""
    files = [folder / "a.01.exr", folder / "b.02.exr"]
    with pytest.raises(mlt.UsageError, match="are frames 1 and 2 of a shot; --force"):
        mlt.merge(files)
    assert mlt.merge(files, force=True).stats["renders"] == 2


def test_frames_that_have_a_window_s_seed_in_common_are_not_merged(folder, tmp_path):
    """Frame 3 has the seeds 1 and 3 in the one shot, 3 and 5 in the other one."""
    mlt.render_shot(shining(), "bdpt", output=tmp_path / "#.exr", spp=1, seed=2, **SHOT)
    with pytest.raises(mlt.UsageError, match="have the same seed 3"):
        mlt.merge([folder / "a.03.exr", tmp_path / "3.exr"])


@pytest.fixture
def gap(folder, tmp_path, monkeypatch):
    """The files of both shots, but the third frame of b."""
    for file in folder.iterdir():
        if file.name != "b.03.exr":
            (tmp_path / file.name).symlink_to(file)
    monkeypatch.chdir(tmp_path)


def test_frames_that_a_shot_does_not_have_are_told(gap):
    with pytest.warns(UserWarning, match=r"^b\.##\.exr has no frame 3; the others are merged$"):
        numbers = mlt.merge_shots(["a.##.exr", "b.##.exr"], "c.#.exr")
    assert numbers == [1, 2, 4, 5, 6, 7, 8]
    assert mlt.merge_shots(["a.##.exr", "b.##.exr"], "d.#.exr", frames="4:5") == [4, 5]
    with pytest.raises(mlt.UsageError, match=r"b\.##\.exr has no frame 3$"):
        mlt.merge_shots(["a.##.exr", "b.##.exr"], "e.#.exr", frames="2:4")
    with pytest.raises(mlt.UsageError, match="have no frame in common"):
        mlt.merge_shots(["a.##.exr", "x.##.exr"], "e.#.exr")


def test_the_command_line_merges_shots(gap, tmp_path, capsys):
    assert main(["merge", "a.##.exr", "b.##.exr", "-o", "c.#.exr"]) == 0
    said = capsys.readouterr().err
    assert "warning: b.##.exr has no frame 3; the others are merged" in said
    assert said.count("2 renders of 16 x 12") == 7
    assert main(["merge", "a.##.exr", "b.##.exr", "-o", "d.#.exr", "--frames", "5"]) == 0
    assert [path.name for path in tmp_path.glob("d.*")] == ["d.5.exr"]
    assert np.array_equal(mlt.read_image("d.5.exr"), mlt.read_image("c.5.exr"))


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        (["a.01.exr", "b.01.exr", "-o", "c.#.exr"], "write a.01.####.exr"),
        (["a.##.exr", "b.##.exr", "-o", "c.exr", "--frames", "1"], "write c.####.exr"),
        (["a.##.exr", "b.##.exr", "-o", "c.#.exr", "--frames", "3:1"], "write 1:3"),
    ],
)
def test_what_is_no_shot_is_refused(gap, arguments, message, capsys):
    assert main(["merge", *arguments]) == 2
    assert message in capsys.readouterr().err
