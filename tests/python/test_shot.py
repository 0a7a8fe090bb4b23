"""Shots: which frames are rendered, when, to which files, and how much they flicker."""

import json
import warnings
from itertools import pairwise

import numpy as np
import pytest
import tiny
from command_line import PYMLT, run, the_error

import pymlt as mlt
from pymlt.pictures.luminance import target_luminance
from pymlt.rendering.frames import (
    check_pattern,
    file_of,
    parse_frames,
    runs,
    scene_at,
    timing,
    told,
)
from pymlt.rendering.windows import windows


def moving(last: float = 1, begin: float = 0) -> dict:
    """The ball moves to the right from one time to another."""
    scene = tiny.scene()
    there = mlt.Transform().translate(1, 0, 0)
    scene["ball"]["to_world"] = {
        "type": "animation",
        str(begin): mlt.Transform(),
        str(last): there,
    }
    return scene


@pytest.mark.parametrize(
    ("frames", "numbers"),
    [
        ("1:4", [1, 2, 3, 4]),
        ("1:2,25:26", [1, 2, 25, 26]),
        ("7", [7]),
        (7, [7]),
        (range(3), [0, 1, 2]),
    ],
)
def test_frames_are_told_by_their_numbers(frames, numbers):
    assert parse_frames(frames) == numbers


@pytest.mark.parametrize(
    ("frames", "right"),
    [
        ("4:1", "write 1:4"),
        ("", "as in 1:24"),
        ("a:b", "as in 1:24"),
        ("-1:3", "as in 1:24"),
        ([], "give some"),
        ([1.5], "an integer"),
        ("1:4,3", "frame 3 twice"),
    ],
)
def test_what_is_no_frames_is_refused(frames, right):
    with pytest.raises(mlt.UsageError, match=right):
        parse_frames(frames)


def test_frames_are_told_as_they_are_given():
    assert told([1, 2, 3, 9, 12, 13]) == "1:3,9,12:13"


def test_files_have_the_number_of_the_frame():
    assert file_of("a.##/x.exr", 7) == "a.07/x.exr"
    assert file_of("x.%04d.exr", 7) == "x.0007.exr"
    assert file_of("x%d.exr", 12) == "x12.exr"
    assert file_of("x.#.exr", 12) == "x.12.exr"


@pytest.mark.parametrize("pattern", ["shot.exr", "shot.##.%d.exr"])
def test_a_name_without_one_place_is_refused(pattern):
    with pytest.raises(mlt.UsageError, match=r"write shot.####.exr"):
        check_pattern(pattern)


@pytest.mark.parametrize(
    ("fps", "shutter"), [(0, 0.5), (-24, 0.5), (24, 1.5), (24, -0.1), ("a", 0)]
)
def test_times_that_make_no_sense_are_refused(fps, shutter):
    with pytest.raises(mlt.UsageError, match="should be"):
        timing(fps, shutter)


def test_a_frame_is_the_scene_while_its_shutter_is_open(tmp_path):
    """Frame 3 of 10 per second: from .3 to .35 s."""
    given = moving()
    given["sensor"] |= {"shutter_open": 0.3, "shutter_close": 0.35}
    expected = mlt.render(given, spp=4, seed=2)
    shot = mlt.render_shot(moving(), frames=3, output=tmp_path / "x.###.exr", fps=10, spp=4, seed=2)
    assert np.array_equal(mlt.read_image(tmp_path / "x.003.exr"), expected)
    assert [frame.number for frame in shot.frames] == [3]
    assert shot.flicker is None


def test_each_frame_has_another_time():
    scene = mlt.load_dict(moving())
    frames = [scene_at(scene, timing(4, 0.5), [f]) for f in (0, 2)]
    first, second = (mlt.render(frame, spp=64, seed=1) for frame in frames)
    assert np.abs(first - second).max() > 0.1


@pytest.mark.parametrize("other", [0, 100])
def test_flicker_is_the_error_of_the_change(other):
    """The spread of 16 changes is what is claimed, with one seed for both frames and with two; 0.15
    is five standard deviations of their ratio."""
    scene = moving()
    scene["ball"]["bsdf"] = {"type": "ref", "id": "clay"}
    scene = mlt.load_dict(scene)
    before, after = (scene_at(scene, timing(10, 0.5), [f]) for f in (1, 2))
    light = target_luminance(mlt.render(after, "bdpt", spp=1024, seed=99))
    found, claimed = [], []
    for seed in range(16):
        jobs = [
            mlt.start(before, "bdpt", spp=64, seed=seed),
            mlt.start(after, "bdpt", spp=64, seed=seed + other),
        ]
        for job in jobs:
            job.wait()
        found.append(target_luminance(jobs[1].image - jobs[0].image))
        claimed.append(jobs[1].flicker(jobs[0]))
    spread = np.var(found, axis=0, ddof=1) / (light**2 + 0.01 * light.mean() ** 2)
    assert np.sqrt(np.mean(np.square(claimed)) / spread.mean()) == pytest.approx(1, abs=0.15)


def test_still_frames_of_one_seed_do_not_flicker(tmp_path):
    with pytest.warns(UserWarning, match="nothing in the scene has an animation"):
        shot = mlt.render_shot(tiny.scene(), frames="1:3", output=tmp_path / "#.exr", spp=64)
    images = [mlt.read_image(tmp_path / f"{n}.exr") for n in (1, 2, 3)]
    assert all(np.array_equal(a, b) for a, b in pairwise(images))
    assert [frame.flicker for frame in shot.frames] == [None, 0, 0]


def test_a_shot_after_the_last_key_is_warned_of(tmp_path):
    with pytest.warns(UserWarning, match="nothing moves from 1 to 1.5 s.*from 0 to 0.5 s"):
        mlt.render_shot(moving(0.5), frames=1, output=tmp_path / "#.exr", fps=1, spp=1)
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        mlt.render_shot(moving(0.5), frames=0, output=tmp_path / "#.exr", fps=1, spp=1)


def test_frames_whose_files_exist_are_skipped_if_asked(tmp_path):
    arguments = {"frames": "0:3", "output": tmp_path / "#.exr", "fps": 4, "spp": 64}
    (tmp_path / "1.exr").write_bytes(b"")
    shot = mlt.render_shot(moving(), skip_existing=True, **arguments)
    assert (tmp_path / "1.exr").read_bytes() == b""
    assert shot.skipped == [1]
    assert [frame.number for frame in shot.frames] == [0, 2, 3]
    assert [frame.flicker is None for frame in shot.frames] == [True, True, False]
    again = mlt.render_shot(moving(), **arguments)
    assert again.skipped == []
    assert mlt.read_image(tmp_path / "1.exr").shape == (12, 16, 3)


# ---- frames that one render has


def test_runs_end_at_cuts():
    scene = mlt.load_dict(moving())
    found = runs(scene, timing(100, 0.5), [1, 2, 3, 9, 10])
    assert found == [[[1], [2], [3]], [[9], [10]]]


def test_frames_that_show_the_same_are_one_moment():
    """Up to 0.5 s the ball moves, from frame 2 on to frame 6 of 12 per second; it stands in 6."""
    scene = mlt.load_dict(moving(0.5, begin=0.2))
    assert runs(scene, timing(12, 0.5), list(range(10))) == [
        [[0, 1], [2], [3], [4], [5], [6, 7, 8, 9]]
    ]


@pytest.mark.parametrize("most", [2, 3, 4, 5, 16, 64])
def test_windows_share_frames_whose_weights_add_up(most):
    for count in range(1, 100):
        run = list(range(7, 7 + count))
        total = dict.fromkeys(run, 0.0)
        for window in windows(run, most):
            assert len(window.frames) <= most
            assert len(window.frames) >= (most // 2 if count > most else 1)
            for frame, weight in zip(window.frames, window.weights, strict=True):
                total[frame] += weight
        assert list(total) == run
        assert list(total.values()) == pytest.approx([1.0] * count)


def test_errors_of_windows_that_fade_are_claimed(tmp_path):
    """As the spread of 16 seeds, of each frame and of each change. Frame 3 is shared."""
    scene = moving()
    scene["ball"]["bsdf"] = {"type": "ref", "id": "clay"}
    settings = {"frames": "1:6", "output": tmp_path / "#.exr", "fps": 10, "together": 4, "spp": 64}
    seen, errors, flickers = [], [], []
    for seed in range(16):
        shot = mlt.render_shot(scene, mlt.Path(max_depth=2), seed=100 * seed, **settings)
        seen.append([target_luminance(mlt.read_image(f.files[0])) for f in shot.frames])
        errors.append([f.stats["error"] for f in shot.frames])
        flickers.append([f.flicker for f in shot.frames[1:]])
    light = np.mean(seen, axis=0)
    floor = 0.01 * light.mean(axis=(1, 2), keepdims=True) ** 2

    def relative(images, light) -> np.ndarray:
        spread = np.var(images, axis=0, ddof=1) / (light**2 + floor[-len(light) :])
        return np.sqrt(spread.mean(axis=(1, 2)))

    assert np.sqrt(np.mean(np.square(errors), axis=0)) == pytest.approx(
        relative(seen, light), rel=0.15
    )
    assert np.sqrt(np.mean(np.square(flickers), axis=0)) == pytest.approx(
        relative(np.diff(seen, axis=1), light[1:]), rel=0.15
    )


def shining() -> dict:
    """The ball is of glass, and its caustic moves."""
    scene = moving()
    scene["ball"]["bsdf"] = {"type": "dielectric"}
    return scene


def images(tmp_path, name: str, frames: str, **settings) -> tuple[np.ndarray, mlt.Shot]:
    settings = {"output": tmp_path / f"{name}.#.exr", "fps": 8, **settings}
    shot = mlt.render_shot(shining(), "mlt", frames=frames, **settings)
    return np.array([mlt.read_image(frame.files[0]) for frame in shot.frames]), shot


def test_frames_together_have_the_mean_of_frames_alone(tmp_path):
    """By 16 seeds each: the mean of each frame, and those of blocks of 4 x 4 pixels."""

    def means(together: int) -> np.ndarray:
        return np.array(
            [
                images(tmp_path, "a", "1:3", together=together, spp=64, seed=seed, threads=1)[0]
                .reshape(3, 3, 4, 4, 4, 3)
                .mean(axis=(2, 4, 5))
                for seed in range(16)
            ]
        )

    both = means(3), means(1)
    variance = sum(m.var(axis=0, ddof=1) for m in both) / 16
    lit = variance > 0
    z = (both[0].mean(axis=0) - both[1].mean(axis=0))[lit] / np.sqrt(variance[lit])
    assert lit.sum() > 30
    assert np.sqrt(np.mean(z**2)) < 1.6
    whole = [m.mean(axis=(2, 3)) for m in both]
    error = np.sqrt(sum(w.var(axis=0, ddof=1) for w in whole) / 16)
    assert np.all(np.abs(whole[0].mean(axis=0) - whole[1].mean(axis=0)) < 4 * error)


def test_frames_together_flicker_less(tmp_path):
    """Where little moves from frame to frame."""
    together, shot = images(tmp_path, "a", "1:4", together=4, spp=256, fps=100)
    alone, apart = images(tmp_path, "b", "1:4", together=1, spp=256, fps=100)
    assert together.shape == alone.shape
    assert [frame.stats.get("exposures") for frame in shot.frames] == [4] * 4
    assert len({frame.stats["seconds"]["render"] for frame in shot.frames}) == 1
    assert shot.frames[0].stats["spp_done"] == pytest.approx(256, rel=0.01)
    assert shot.flicker < 0.75 * apart.flicker
    assert 0.3 < shot.error / apart.error < 1.1


def test_a_window_of_one_frame_is_a_render_of_its_own(tmp_path):
    scene = scene_at(mlt.load_dict(shining()), timing(8, 0.5), [2])
    expected = mlt.render(scene, "mlt", spp=8, seed=5)
    alone, _ = images(tmp_path, "a", "2", spp=8, seed=5)
    assert np.array_equal(alone[0], expected)


def test_frames_together_do_not_change_with_the_number_of_threads(tmp_path):
    one, _ = images(tmp_path, "a", "1:3", spp=16, threads=1)
    two, _ = images(tmp_path, "b", "1:3", spp=16, threads=2)
    assert np.array_equal(one, two)


def test_what_frames_together_do_not_have_is_refused(tmp_path):
    with pytest.raises(mlt.UsageError, match="rendered together have no aovs"):
        images(tmp_path, "a", "1:3", together=3, spp=1, aovs="albedo")
    _, shot = images(tmp_path, "a", "1:2", spp=1, aovs="albedo")
    assert "exposures" not in shot.frames[0].stats


SCENE = tiny.XML.replace(
    '<point name="center" x="0" y="0.6" z="0"/>',
    '<animation name="to_world"><transform time="0"/><transform time="1">'
    '<translate x="1"/></transform></animation>',
)


@pytest.fixture
def scene(tmp_path):
    (tmp_path / "scene.xml").write_text(SCENE)
    return tmp_path / "scene.xml"


def test_the_command_line_renders_the_frames_of_python(scene, tmp_path):
    stats = tmp_path / "stats.json"
    flags = ["--frames", "1:2", "--fps", "10", "--shutter", "0.25", "--seed", "3", "--spp", "64"]
    done = run(PYMLT, "render", scene, *flags, "-o", tmp_path / "a.##.exr", "--stats", stats)
    assert done.returncode == 0, done.stderr
    assert "frame 2: path, 16 x 12" in done.stderr
    assert "2 of 2 frames, error" in done.stderr
    shot = mlt.render_shot(
        scene, frames="1:2", output=tmp_path / "b.##.exr", fps=10, shutter=0.25, seed=3, spp=64
    )
    told = json.loads(stats.read_text())
    assert told["flicker"] == shot.flicker
    assert [frame["frame"] for frame in told["frames"]] == [1, 2]
    for name in ("01.exr", "02.exr"):
        assert np.array_equal(*(mlt.read_image(tmp_path / f"{x}.{name}") for x in "ab"))
    again = run(PYMLT, "render", scene, *flags, "-o", tmp_path / "a.##.exr", "--skip-existing")
    assert "0 of 2 frames, 2 skipped" in again.stderr


def test_the_command_line_makes_a_film(scene, tmp_path):
    pytest.importorskip("imageio_ffmpeg", reason="the extra video is not installed")
    flags = ["--frames", "1:3", "--fps", "10", "--spp", "4", "-o", tmp_path / "a.#.exr"]
    done = run(PYMLT, "render", scene, *flags, "-o", tmp_path / "a.mp4")
    assert done.returncode == 0, done.stderr
    assert (tmp_path / "a.mp4").read_bytes()[4:8] == b"ftyp"


@pytest.mark.parametrize(
    ("flags", "message"),
    [
        (["--frames", "3:1", "-o", "#.exr"], "write 1:3"),
        (["--frames", "1:3", "-o", "a.exr"], "write a.####.exr"),
        (["--fps", "24", "-o", "a.exr"], "--fps needs --frames"),
        (["--skip-existing", "-o", "a.exr"], "--skip-existing needs --frames"),
        (["--frames", "1:3", "-o", "#.exr", "--every", "9"], "--every needs --checkpoint"),
        (["--frames", "1:3", "-o", "#.exr", "--fps", "0"], "should be a number above 0"),
        (["--frames", "1:3", "-o", "a.mp4"], "add -o shot.####.exr"),
    ],
)
def test_flags_that_make_no_sense_are_refused(scene, flags, message):
    assert message in the_error(run(PYMLT, "render", scene, *flags))
