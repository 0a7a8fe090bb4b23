"""Checkpoints: a render that is resumed ends with the pixels of one that never stopped."""

import json
import os
import random
import shutil
import signal
import struct
import subprocess
import sys
import time
import zlib
from pathlib import Path

import numpy as np
import pytest
import tiny
from command_line import PYMLT, mlt_render, run, the_error

import pymlt as mlt

INTEGRATORS = {
    **{name: {"type": name} for name in mlt.available("integrator")},
    "bdpt with techniques": {"type": "bdpt", "techniques": True, "max_depth": 3},
    "mlt, two stages": {"type": "mlt", "two_stage": True, "luminance_samples": 2000},
    "mlt, separate direct light": {"type": "mlt", "direct_samples": 9, "adaptive": False},
}


@pytest.fixture(scope="module")
def small():
    return mlt.load_string(tiny.XML, res=24)


def same(a: mlt.Result, b: mlt.Result) -> bool:
    """The images, with all their layers, bit for bit."""
    return np.array_equal(a.image, b.image) and all(
        np.array_equal(layer, b.layers[name]) for name, layer in a.layers.items()
    )


@pytest.mark.parametrize("integrator", INTEGRATORS.values(), ids=INTEGRATORS.keys())
def test_a_resumed_render_ends_with_the_same_pixels(small, integrator, tmp_path):
    whole = mlt.start(small, integrator, spp=24, seed=5).result()
    job = mlt.start(small, integrator, spp=24, seed=5, threads=2)
    for cut in range(3):  # where it stands is left to chance; it must not matter
        path = tmp_path / f"{cut}.mlt"
        job.checkpoint(path)
        job.cancel()
        job = mlt.resume(path, threads=1 + cut % 2)
    again = job.result()
    assert same(again, whole)
    assert again.stats["spp_done"] == whole.stats["spp_done"]
    assert again.stats["rays"] == whole.stats["rays"]
    assert again.stats["mutations"] == whole.stats["mutations"]
    assert again.integrator == whole.integrator


@pytest.mark.parametrize("integrator", ["path", "mlt"])
def test_a_finished_render_can_be_extended(small, integrator, tmp_path):
    path = tmp_path / "a.mlt"
    whole = mlt.start(small, integrator, spp=24, seed=5).result()
    job = mlt.start(small, integrator, spp=7, seed=5, checkpoint=path)
    job.wait()
    assert mlt.resume(path).result().stats["spp_done"] == job.stats["spp_done"]  # nothing to do
    assert same(mlt.resume(path, spp=24).result(), whole)
    job.extend(spp=24)
    assert same(job.result(), whole)
    assert same(mlt.resume(path).result(), whole)  # both have renewed the file


def test_saving_does_not_disturb_a_render(small, tmp_path):
    whole = mlt.start(small, "pssmlt", spp=200, seed=5).result()
    job = mlt.start(
        small, "pssmlt", spp=200, seed=5, threads=2, checkpoint=tmp_path / "auto", every=1e-3
    )
    saved = 0
    while not job.ended:
        job.checkpoint(tmp_path / "by hand")
        saved += 1
    assert saved > 3
    assert same(job.result(), whole)


def test_seconds_count_over_interruptions(tmp_path):
    big = mlt.load_string(tiny.XML, size=(320, 240))
    path = tmp_path / "a.mlt"
    mlt.start(big, time=0.6, checkpoint=path).wait()
    for _ in range(2):
        job = mlt.resume(path, time=1.2)
        job.wait()
        seconds = job.stats["seconds"]
        assert 1.2 <= seconds["bootstrap"] + seconds["render"] < 3
        assert job.stats["ended_by"] == "time"


def test_what_is_resumed_is_the_scene_as_it_was(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    Path("scene.xml").write_text(tiny.XML)
    mlt.start(mlt.load_file("scene.xml", res=20), spp=2, checkpoint="a.mlt").wait()
    image = mlt.render(mlt.load_file("scene.xml", res=20), spp=3)
    os.mkdir("elsewhere")
    monkeypatch.chdir("elsewhere")
    assert np.array_equal(mlt.resume("../a.mlt", spp=3, checkpoint="b").result().image, image)

    shutil.move("../scene.xml", "moved.xml")
    with pytest.raises(mlt.FileError, match=r"scene\.xml"):
        mlt.resume("b")
    assert np.array_equal(mlt.resume("b", scene="moved.xml").result().image, image)
    Path("moved.xml").write_text(tiny.XML.replace("0.7, 0.4, 0.2", "0.7, 0.4, 0.3"))
    with pytest.raises(mlt.SceneError, match="has changed"):
        mlt.resume("b", scene="moved.xml")


def test_a_scene_from_python_must_be_given_again(tmp_path):
    path = tmp_path / "a.mlt"
    mlt.start(tiny.scene(), spp=2, checkpoint=path).wait()
    with pytest.raises(mlt.UsageError, match="Python"):
        mlt.resume(path)
    other = tiny.scene()
    other["sensor"]["fov"] = 41.0
    with pytest.raises(mlt.SceneError, match="has changed"):
        mlt.resume(path, scene=other)
    resumed = mlt.resume(path, scene=tiny.scene(), spp=3).result()
    assert np.array_equal(resumed.image, mlt.render(tiny.scene(), spp=3))


def test_a_checkpoint_that_cannot_be_written_is_a_warning(small, tmp_path):
    folder = tmp_path / "folder"
    folder.mkdir()
    job = mlt.start(small, spp=1e7, checkpoint=folder / "a.mlt", every=0.01)
    while not (folder / "a.mlt").exists():
        time.sleep(0.01)
    shutil.rmtree(folder, ignore_errors=True)
    while folder.exists():
        shutil.rmtree(folder, ignore_errors=True)
    while not job.stats["warnings"]:
        time.sleep(0.01)
    job.cancel()
    warnings = job.result().stats["warnings"]
    assert sum("checkpoint could not be written" in warning for warning in warnings) == 1


# ---- files that are no good ----------------------------------------------------------------------


@pytest.fixture(scope="module")
def good(small, tmp_path_factory) -> bytes:
    path = tmp_path_factory.mktemp("checkpoint") / "a.mlt"
    mlt.start(small, mlt.MLT(chains=32), spp=2, seed=1, checkpoint=path).wait()
    return path.read_bytes()


def sealed(body: bytes) -> bytes:
    """A file whose checksum is right, whatever is in it."""
    size, checksum = len(body), zlib.crc32(body)
    return b"pymlt checkpoint" + size.to_bytes(8, "little") + checksum.to_bytes(4, "little") + body


def refusal(path: Path, content: bytes) -> str:
    path.write_bytes(content)
    with pytest.raises(mlt.FileError) as caught:
        mlt.resume(path)
    assert path.read_bytes() == content
    assert str(caught.value).startswith(f"{path}: ")
    return str(caught.value)


def test_a_whole_file_is_taken(good, tmp_path):
    (tmp_path / "a.mlt").write_bytes(good)
    assert sealed(good[28:]) == good
    mlt.resume(tmp_path / "a.mlt").wait()


def test_a_truncated_file_is_refused(good, tmp_path):
    draw = random.Random(1)
    for size in [*range(60), *(draw.randrange(len(good)) for _ in range(60)), len(good) - 1]:
        reason = refusal(tmp_path / "a.mlt", good[:size])
        assert ("truncated" if size else "is no checkpoint") in reason


def test_a_damaged_file_is_refused(good, tmp_path):
    draw = random.Random(2)
    for place in [*range(40), *(draw.randrange(len(good)) for _ in range(80))]:
        damaged = bytearray(good)
        damaged[place] ^= 1 << draw.randrange(8)
        reason = refusal(tmp_path / "a.mlt", bytes(damaged))
        assert ("is no checkpoint" if place < 16 else "the checkpoint is") in reason
    assert "follows its end" in refusal(tmp_path / "a.mlt", good + b"\0")


def test_a_foreign_file_is_refused(good, tmp_path):
    path = tmp_path / "a.mlt"
    assert "is no checkpoint" in refusal(path, tiny.XML.encode())
    version = mlt.__version__.encode()
    other = good[28:].replace(version, b"9.9.9"[: len(version)], 1)
    assert "was written by pymlt 9.9.9" in refusal(path, sealed(other))


def test_a_state_that_does_not_fit_is_refused(good, tmp_path):
    """A right checksum is no excuse: a state is either whole or refused."""
    draw = random.Random(3)
    body = good[28:]
    for size in [*range(100), *(draw.randrange(len(body)) for _ in range(60)), len(body) - 1]:
        reason = refusal(tmp_path / "a.mlt", sealed(body[:size]))
        assert "damaged" in reason or "was written by" in reason
    assert "damaged" in refusal(tmp_path / "a.mlt", sealed(body + b"\0"))


def state_of(body: bytes) -> bytes:
    """The render's own part, which ends the body: its size in eight bytes, then its bytes."""
    for at in range(len(body) - 8):
        if struct.unpack_from("<Q", body, at)[0] == len(body) - at - 8:
            return body[at + 8 :]
    raise AssertionError("the body does not end with a text")


@pytest.mark.parametrize("integrator", ["path", "mlt"])
def test_numbers_that_are_none_are_refused_or_do_no_harm(small, integrator, tmp_path):
    mlt.start(small, integrator, spp=2, seed=1, checkpoint=tmp_path / "a.mlt").wait()
    body = (tmp_path / "a.mlt").read_bytes()[28:]
    size = len(state_of(body))
    draw = random.Random(4)
    anywhere = [draw.choice([draw.randrange(size // 4), draw.randrange(500)]) for _ in range(60)]
    refused = 0
    for word in [*range(20), *anywhere]:  # what every render has comes first
        value = draw.choice([float("nan"), float("inf"), -float("inf")])
        forged = struct.pack(*draw.choice([("<f", value), ("<d", value), ("<I", 2**32 - 1)]))
        place = len(body) - size + 4 * word
        damaged = body[:place] + forged + body[place + len(forged) :]
        (tmp_path / "a.mlt").write_bytes(sealed(damaged))
        try:
            result = mlt.resume(tmp_path / "a.mlt").result()
        except (mlt.FileError, mlt.SceneError, mlt.UsageError):
            refused += 1
        else:
            assert np.isfinite(result.image).all()
            assert result.stats["spp_done"] > 0
    assert refused > 0


# ---- the command lines ---------------------------------------------------------------------------

FLAGS = ["--size", "96x72", "--seed", 7, "--quiet"]


def test_the_command_line_resumes(program, scene):
    run(program, scene, *FLAGS, "--spp", 9, "-o", "whole.exr")
    run(program, scene, *FLAGS, "--spp", 4, "-o", "a.exr", "--checkpoint", "a.mlt")
    shutil.copy("a.mlt", "b.mlt")
    done = run(program, "--resume", "a.mlt", "--spp", 9, "-o", "a.exr")
    assert done.returncode == 0, done.stderr
    assert Path("a.exr").read_bytes() == Path("whole.exr").read_bytes()
    done = run(program, "--resume", "a.mlt", "-o", "b.exr")  # it was renewed
    assert Path("b.exr").read_bytes() == Path("whole.exr").read_bytes()
    os.rename(scene, "moved.xml")
    assert "scene.xml" in the_error(run(program, "--resume", "b.mlt", "-o", "c.exr"))
    done = run(program, "moved.xml", "--resume", "b.mlt", "--spp", 9, "-o", "c.exr")
    assert done.returncode == 0, done.stderr
    assert Path("c.exr").read_bytes() == Path("whole.exr").read_bytes()


def test_both_programs_resume_the_checkpoints_of_each_other(scene):
    binary = mlt_render() or pytest.skip("mlt-render is not installed beside this Python")
    python = [*PYMLT, "render"]
    run(python, scene, *FLAGS, "--spp", 9, "-o", "whole.exr")
    for first, second in (python, binary), (binary, python):
        run(first, scene, *FLAGS, "--spp", 4, "-o", "a.exr", "--checkpoint", "a.mlt")
        assert run(second, "--resume", "a.mlt", "--spp", 9, "-o", "a.exr").returncode == 0
        assert Path("a.exr").read_bytes() == Path("whole.exr").read_bytes()


def test_a_built_in_scene_is_resumed_by_its_name(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    flags = ["furnace", "--size", "24x24", "-o", "a.exr"]
    assert run(PYMLT, "render", *flags, "--spp", 2, "--checkpoint", "a.mlt").returncode == 0
    assert run(PYMLT, "render", "--resume", "a.mlt", "--spp", 4, "-o", "b.exr").returncode == 0
    run(PYMLT, "render", *flags, "--spp", 4)
    assert Path("a.exr").read_bytes() == Path("b.exr").read_bytes()
    if binary := mlt_render():
        assert "Python" in the_error(run(binary, "--resume", "a.mlt", "-o", "b.exr"))


@pytest.mark.parametrize(("number", "code"), [(signal.SIGINT, 130), (signal.SIGTERM, 143)])
def test_a_signal_leaves_a_checkpoint(program, scene, number, code):
    flags = ["--size", "96x72", "--seed", 7, "--spp", 4000, "--checkpoint", "a.mlt", "--every", 1e4]
    process = subprocess.Popen(
        [*program, scene, *map(str, flags), "-o", "a.exr", "--stats", "a.json"]
    )
    wait_for(Path("a.mlt"))
    first = Path("a.mlt").stat().st_mtime_ns
    time.sleep(0.3)
    process.send_signal(number)
    assert process.wait(timeout=20) == code
    assert Path("a.mlt").stat().st_mtime_ns > first
    spp = json.loads(Path("a.json").read_text())["spp_done"]
    assert 0 < spp < 4000
    run(program, "--resume", "a.mlt", "--spp", 1, "-o", "b.exr", "--stats", "b.json")
    assert json.loads(Path("b.json").read_text())["spp_done"] == spp
    assert np.array_equal(mlt.read_image("a.exr"), mlt.read_image("b.exr"))


OTHERS = {
    "scene": ["-D", "depth=3"],
    "seed": ["--seed", 8],
    "integrator": ["--integrator", "direct"],
}


@pytest.mark.parametrize(("what", "other"), OTHERS.items(), ids=OTHERS)
def test_the_checkpoint_of_another_render_is_kept(program, scene, what, other):
    flags = [scene, "--size", "16x12", "--spp", 2, "-o", "a.exr", "--checkpoint", "a.mlt"]
    run(program, *flags)
    before = Path("a.mlt").read_bytes()
    error = the_error(run(program, *flags, *other))
    assert f"a.mlt: is the checkpoint of another render, with another {what};" in error
    assert "--overwrite" in error
    assert Path("a.mlt").read_bytes() == before
    assert run(program, *flags, *other, "--overwrite").returncode == 0
    assert Path("a.mlt").read_bytes() != before


def test_what_cannot_be_read_is_replaced_only_when_asked_to(program, scene):
    flags = [scene, "--size", "16x12", "--spp", 2, "-o", "a.exr", "--checkpoint", "a.mlt"]
    run(program, *flags)
    whole = Path("a.mlt").read_bytes()
    Path("a.mlt").write_bytes(whole[:-9])
    error = the_error(run(program, *flags))
    assert "truncated" in error
    assert "--overwrite" in error
    assert run(program, *flags, "--overwrite").returncode == 0
    assert len(Path("a.mlt").read_bytes()) == len(whole)


def test_a_forgotten_resume_costs_no_sample(program, scene):
    flags = [scene, "--size", "16x12", "-o", "a.exr", "--checkpoint", "a.mlt"]
    run(program, *flags, "--spp", 9)
    before = Path("a.mlt").read_bytes()
    assert run(program, *flags, "--spp", 4).returncode == 0
    assert Path("a.mlt").read_bytes() == before
    assert run(program, *flags, "--spp", 11).returncode == 0
    assert Path("a.mlt").read_bytes() != before


def test_python_keeps_the_checkpoint_of_another_render(small, tmp_path):
    path = tmp_path / "a.mlt"
    job = mlt.start(small, spp=2, checkpoint=path)
    job.wait()
    for other in (
        lambda **options: mlt.start(small, spp=2, seed=1, checkpoint=path, **options),
        lambda **options: mlt.start(small, "direct", spp=2).checkpoint(path, **options),
    ):
        with pytest.raises(mlt.FileError, match="is the checkpoint of another render"):
            other()
        other(overwrite=True)
        job.checkpoint(path, overwrite=True)


def test_two_processes_do_not_share_a_checkpoint(program, scene, small):
    flags = [scene, "--size", "64x48", "--spp", "1e7", "--quiet", "-o", "a.exr"]
    first = subprocess.Popen([*program, *flags, "--checkpoint", "a.mlt"])
    wait_for(Path("a.mlt"))
    for second in [*flags, "--checkpoint", "a.mlt"], ["--resume", "a.mlt", "-o", "b.exr"]:
        assert "a.mlt: another render keeps its state there" in the_error(run(program, *second))
    with pytest.raises(mlt.FileError, match="another render keeps its state there"):
        mlt.start(small, spp=1).checkpoint("a.mlt")
    first.kill()
    first.wait()
    assert Path("a.mlt.lock").exists()
    done = run(program, "--resume", "a.mlt", "--spp", 1, "-o", "b.exr")
    assert done.returncode == 0, done.stderr
    assert not Path("a.mlt.lock").exists()


@pytest.mark.parametrize("content", ["", "mine\n"])
def test_a_file_of_the_name_of_the_lock_is_kept(small, tmp_path, content):
    mine = tmp_path / "poetry.lock"
    mine.write_text(content)
    mlt.start(small, spp=1, checkpoint=tmp_path / "poetry").wait()
    mlt.start(small, spp=1).checkpoint(tmp_path / "poetry")
    assert mine.read_text() == content


def test_a_link_of_the_name_of_the_lock_is_not_followed(small, tmp_path):
    (tmp_path / "a.mlt.lock").symlink_to(tmp_path / "elsewhere")
    with pytest.raises(mlt.FileError, match="cannot lock it"):
        mlt.start(small, spp=1, checkpoint=tmp_path / "a.mlt")
    assert os.listdir(tmp_path) == ["a.mlt.lock"]


def wait_for(path: Path) -> None:
    deadline = time.monotonic() + 30
    while not path.exists():
        assert time.monotonic() < deadline
        time.sleep(0.005)


def killed_and_resumed(program, scene, integrator, kills, spp):
    """Kill a render at random moments, resume it, and compare it with one that never stopped."""
    draw = random.Random(4)
    flags = ["--integrator", integrator, *FLAGS, "--spp", spp]

    def finish(*arguments):
        subprocess.run([*program, *map(str, arguments)], check=True, timeout=600)

    finish(scene, *flags, "-o", "whole.exr")
    keep = ["--checkpoint", "a.mlt", "--every", "0.02", "-o", "a.exr"]
    source = [scene, *flags]
    for _ in range(kills):
        process = subprocess.Popen([*program, *map(str, source), *keep])
        wait_for(Path("a.mlt"))
        time.sleep(draw.uniform(0, 0.5) if "--resume" in source else 0)
        process.send_signal(signal.SIGKILL)
        process.wait()
        assert "--resume" in source or process.returncode == -signal.SIGKILL
        source = ["--resume", "a.mlt", "--quiet"]
    finish(*source, *keep)
    assert Path("a.exr").read_bytes() == Path("whole.exr").read_bytes()


def test_kill_9_costs_no_pixel(scene):
    binary = mlt_render() or pytest.skip("mlt-render is not installed beside this Python")
    killed_and_resumed(binary, scene, "pssmlt", kills=3, spp=150)


@pytest.mark.long
@pytest.mark.parametrize("integrator", mlt.available("integrator"))
def test_kill_9_at_twenty_moments_costs_no_pixel(scene, integrator):
    binary = mlt_render() or pytest.skip("mlt-render is not installed beside this Python")
    spp = {"path": 3000, "direct": 3000, "ptracer": 3000}.get(integrator, 800)  # some seconds
    killed_and_resumed(binary, scene, integrator, kills=20, spp=spp)


def test_leaving_python_keeps_the_checkpoint(tmp_path):
    path = tmp_path / "a.mlt"
    code = f"""
import sys
sys.path.insert(0, {str(Path(tiny.__file__).parent)!r})
import pymlt as mlt, tiny
job = mlt.start(tiny.scene(), spp=1e7, checkpoint={str(path)!r}, every=1e4)
while job.stats["spp_done"] < 20: pass
"""
    subprocess.run([sys.executable, "-c", code], check=True, timeout=30)
    resumed = mlt.resume(path, scene=tiny.scene(), spp=20)
    assert resumed.result().stats["spp_done"] >= 20
