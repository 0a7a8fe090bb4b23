"""Shots that are interrupted: they end with the pixels of a shot that never stopped."""

import json
import os
import signal

import numpy as np
import pytest
from test_shot import SCENE, shining

import pymlt as mlt
import pymlt.rendering.shot as rendering_shot
from pymlt.cli import main
from pymlt.images import read_with_layers
from pymlt.rendering import shot_checkpoint
from pymlt.rendering.windows import WindowRender

#: Three windows; those that follow each other share a frame.
MLT = {"type": "mlt", "luminance_samples": 2000}
WINDOWS = {"integrator": MLT, "frames": "1:8", "together": 4, "spp": 32}
#: Each frame by a render of its own, with a cut, and two that stand still at the end.
ALONE = {"integrator": "path", "frames": "1:3,6:9", "together": 1, "spp": 32}


def shot(folder, settings: dict, **more) -> mlt.Shot:
    folder.mkdir(exist_ok=True)
    settings = {"fps": 8, "every": 1e-3, "output": folder / "#.exr", **settings, **more}
    return mlt.render_shot(shining(), **settings)


def told_of(shot: mlt.Shot) -> list:
    """What a shot tells about its frames, but for times."""
    names = ("error", "spp_done", "rays", "mutations", "warnings")
    return [(f.number, f.flicker, *(f.stats.get(n) for n in names)) for f in shot.frames]


def layers(shot: mlt.Shot) -> list[np.ndarray]:
    """The images and all their layers."""
    found = []
    for frame in shot.frames:
        image, others = read_with_layers(frame.files[0])
        found += [image, *(others[name] for name in sorted(others))]
    return found


def same(a: mlt.Shot, b: mlt.Shot) -> bool:
    pairs = zip(layers(a), layers(b), strict=True)
    return told_of(a) == told_of(b) and all(np.array_equal(*pair) for pair in pairs)


@pytest.fixture(scope="module")
def uninterrupted(tmp_path_factory) -> dict:
    folder = tmp_path_factory.mktemp("whole")
    return {
        "windows": shot(folder / "windows", WINDOWS),
        "alone": shot(folder / "alone", ALONE),
    }


class Interruption:
    """Ctrl-C at the `count`-th call, from 0, of what takes its place."""

    def __init__(self, count: int):
        self.to_come = count

    def now(self) -> bool:
        self.to_come -= 1
        return self.to_come == -1


def before_a_render(monkeypatch, count: int) -> None:
    interruption, start = Interruption(count), WindowRender.start

    def instead(self, options, **more):
        if interruption.now():
            raise KeyboardInterrupt
        return start(self, options, **more)

    monkeypatch.setattr(WindowRender, "start", instead)


def within_a_render(monkeypatch, count: int) -> None:
    """When the first samples are there; where exactly must not matter."""
    interruption, finish = Interruption(count), rendering_shot.finish

    def instead(job, wait):
        if not interruption.now():
            return finish(job, wait)
        while job.samples == 0 and not job.ended:
            pass
        job.cancel()
        job.wait()
        raise KeyboardInterrupt

    monkeypatch.setattr(rendering_shot, "finish", instead)


def before_a_file(monkeypatch, count: int) -> None:
    interruption, write = Interruption(count), mlt.Result.write

    def instead(self, path, *arguments, **more):
        if interruption.now():
            raise KeyboardInterrupt
        write(self, path, *arguments, **more)

    monkeypatch.setattr(mlt.Result, "write", instead)


def note_renders(monkeypatch) -> list[tuple[int, bool]]:
    """The first frame of each render from now on, and whether it goes on from a checkpoint."""
    begun, start = [], WindowRender.start

    def noted(self, options, *, goes_on=False):
        begun.append((self.window.frames[0], goes_on))
        return start(self, options, goes_on=goes_on)

    monkeypatch.setattr(WindowRender, "start", noted)
    return begun


def interrupted(interrupt, count: int, folder, settings: dict, **more) -> None:
    more = more or {"checkpoint": folder / "shot.mlt"}
    with pytest.MonkeyPatch.context() as patched:
        interrupt(patched, count)
        with pytest.raises(KeyboardInterrupt):
            shot(folder, settings, **more)


#: How a shot is interrupted, and which renders are to come: their first frames, and the first of
#: them that begins anew.
CASES = {
    "before the first window": (WINDOWS, before_a_render, 0, [1, 3, 5], 1),
    "between windows": (WINDOWS, before_a_render, 1, [3, 5], 3),
    "within the first window": (WINDOWS, within_a_render, 0, [1, 3, 5], 3),
    "within the second window": (WINDOWS, within_a_render, 1, [3, 5], 5),
    "between files of a window": (WINDOWS, before_a_file, 3, [3, 5], 5),
    "before the last file": (WINDOWS, before_a_file, 7, [5], None),
    "between frames": (ALONE, before_a_render, 2, [2, 3, 6, 7, 8], 3),
    "within a frame": (ALONE, within_a_render, 1, [1, 2, 3, 6, 7, 8], 3),
    "within a frame after a cut": (ALONE, within_a_render, 3, [6, 7, 8], 7),
    "before the file of one that stands still": (ALONE, before_a_file, 6, [7, 8], None),
}


@pytest.mark.parametrize("case", CASES.values(), ids=CASES.keys())
def test_an_interrupted_shot_ends_with_the_same_pixels(uninterrupted, case, tmp_path, monkeypatch):
    settings, interrupt, count, to_come, anew = case
    interrupted(interrupt, count, tmp_path, settings)
    begun = note_renders(monkeypatch)
    again = shot(tmp_path, settings, resume=tmp_path / "shot.mlt")
    assert [first for first, _ in begun] == to_come
    assert next((first for first, goes_on in begun if not goes_on), None) == anew
    assert same(again, uninterrupted["windows" if settings is WINDOWS else "alone"])
    assert [path.name for path in tmp_path.glob("*.mlt*")] == ["shot.mlt"]


def test_a_shot_that_is_interrupted_twice_ends_with_the_same_pixels(uninterrupted, tmp_path):
    interrupted(within_a_render, 0, tmp_path, WINDOWS)
    interrupted(within_a_render, 1, tmp_path, WINDOWS, resume=tmp_path / "shot.mlt")
    again = shot(tmp_path, WINDOWS, resume=tmp_path / "shot.mlt")
    assert same(again, uninterrupted["windows"])


def test_nothing_is_left_of_a_shot_that_has_ended(tmp_path, monkeypatch):
    file = tmp_path / "shot.mlt"
    whole = shot(tmp_path, ALONE, checkpoint=file)
    begun = note_renders(monkeypatch)
    assert same(shot(tmp_path, ALONE, resume=file, checkpoint=file), whole)
    assert begun == []


def test_frames_that_were_skipped_stay_so(tmp_path):
    (tmp_path / "2.exr").write_bytes(b"")
    settings = {**ALONE, "skip_existing": True}
    interrupted(before_a_file, 3, tmp_path, settings)
    again = shot(tmp_path, settings, resume=tmp_path / "shot.mlt")
    assert again.skipped == [2]
    assert [frame.number for frame in again.frames] == [1, 3, 6, 7, 8, 9]


@pytest.mark.parametrize(
    ("change", "said"),
    [
        ({"frames": "1:3,6:8"}, "frames is 1:3,6:8 here and 1:3,6:9 in the checkpoint"),
        ({"fps": 12}, "fps is 12.0 here and 8.0 in"),
        ({"shutter": 0.25}, "shutter is 0.25 here and 0.5 in"),
        ({"together": None}, "together is not given here and 1 in"),
        ({"spp": 64}, "spp is 64.0 here and 32.0 in"),
        ({"seed": 1}, "seed is 1 here and 0 in"),
        ({"aovs": "albedo"}, "aovs is albedo here and not given in"),
        ({"integrator": "bdpt"}, "the integrator's type is bdpt here and path in"),
        ({"sensor": 0, "spectral": True}, "the scene's hash"),
        ({"output": "x.#.exr"}, "output is x.#.exr here and"),
    ],
    ids=str,
)
def test_the_checkpoint_of_another_shot_is_refused(tmp_path, change, said):
    interrupted(before_a_render, 0, tmp_path, ALONE)
    with pytest.raises(mlt.UsageError) as error:
        shot(tmp_path, ALONE, resume=tmp_path / "shot.mlt", **change)
    assert said in str(error.value)


def test_a_shot_goes_on_in_its_own_file(tmp_path):
    interrupted(before_a_render, 0, tmp_path, ALONE)
    with pytest.raises(mlt.UsageError, match="leave out checkpoint"):
        shot(tmp_path, ALONE, resume=tmp_path / "shot.mlt", checkpoint=tmp_path / "other")


def test_the_checkpoint_of_a_shot_is_replaced_only_if_asked(uninterrupted, tmp_path):
    interrupted(within_a_render, 2, tmp_path, ALONE)
    file = tmp_path / "shot.mlt"
    with pytest.raises(mlt.FileError, match="go on with a shot by --resume"):
        shot(tmp_path, ALONE, checkpoint=file, seed=3)
    shot(tmp_path, ALONE, checkpoint=file, seed=3, overwrite=True)
    assert [path.name for path in tmp_path.glob("*.mlt*")] == ["shot.mlt"]


def test_a_checkpoint_that_cannot_be_written_is_a_warning(uninterrupted, tmp_path, monkeypatch):
    full, write = Interruption(1), shot_checkpoint.write_shot

    def instead(path, state):
        if full.now():
            raise mlt.FileError("no space is left")
        write(path, state)

    monkeypatch.setattr(shot_checkpoint, "write_shot", instead)
    with pytest.warns(UserWarning, match="checkpoint could not be written: no space is left"):
        whole = shot(tmp_path, ALONE, checkpoint=tmp_path / "shot.mlt")
    assert same(whole, uninterrupted["alone"])
    assert [path.name for path in tmp_path.glob("*.mlt*")] == ["shot.mlt"]


@pytest.mark.parametrize("kind", ["text", "render", "truncated", "damaged", "empty"])
def test_files_that_are_no_checkpoint_of_a_shot_are_refused(tmp_path, kind):
    interrupted(before_a_render, 2, tmp_path, WINDOWS)
    file = tmp_path / "shot.mlt"
    good = file.read_bytes()
    middle = len(good) // 2
    if kind == "render":
        file.unlink()
        mlt.start(shining(), "path", spp=1, checkpoint=file).wait()
    bad = {
        "text": b"my diary",
        "truncated": good[:middle],
        "damaged": good[:middle] + bytes([good[middle] ^ 1]) + good[middle + 1 :],
        "empty": b"",
    }.get(kind, file.read_bytes())
    file.write_bytes(bad)
    with pytest.raises(mlt.FileError, match="no checkpoint of a shot"):
        shot(tmp_path, WINDOWS, resume=file)
    if kind != "empty":
        with pytest.raises(mlt.FileError, match="no checkpoint of a shot"):
            shot(tmp_path, WINDOWS, checkpoint=file, overwrite=True)
    assert file.read_bytes() == bad


# ---- the command line


@pytest.fixture
def command(tmp_path, monkeypatch) -> list[str]:
    monkeypatch.chdir(tmp_path)
    (tmp_path / "scene.xml").write_text(SCENE)
    flags = "--frames 1:6 --together 4 --integrator bdpt --fps 8 --spp 32 --quiet"
    return ["render", "scene.xml", *flags.split(), "--stats", "stats.json", "-o"]


def test_the_command_line_goes_on_with_a_shot(command, tmp_path):
    def stats() -> dict:
        return json.loads((tmp_path / "stats.json").read_text())

    assert main([*command, "a.#.exr"]) == 0
    whole = stats()
    start = WindowRender.start

    def with_a_signal(self, *arguments, **more):
        if self.window.frames[0] > 1:
            os.kill(os.getpid(), signal.SIGINT)
        return start(self, *arguments, **more)

    with pytest.MonkeyPatch.context() as patched:
        patched.setattr(WindowRender, "start", with_a_signal)
        assert main([*command, "b.#.exr", "--checkpoint", "shot.mlt", "--every", "10"]) == 130
    assert len(stats()["frames"]) == 2
    assert main([*command, "b.#.exr", "--resume", "shot.mlt", "--every", "10"]) == 0
    assert stats()["flicker"] == whole["flicker"]
    assert stats()["error"] == whole["error"]
    for frame in range(1, 7):
        assert np.array_equal(*(mlt.read_image(f"{x}.{frame}.exr") for x in "ab"))


def test_the_checkpoint_of_a_shot_needs_its_frames(command, capsys):
    assert main([*command, "b.#.exr", "--checkpoint", "shot.mlt"]) == 0
    assert main(["render", "--resume", "shot.mlt", "-o", "b.exr"]) == 2
    assert "shot.mlt is the checkpoint of a shot" in capsys.readouterr().err
