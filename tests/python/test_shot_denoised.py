"""Shots whose frames are denoised: rendered together or alone, with their neighbours."""

from pathlib import Path

import numpy as np
import pytest
from command_line import PYMLT, run
from test_denoise import relative_error
from test_shot import SCENE, moving, shining

import pymlt as mlt
from pymlt.rendering.denoised import GUIDES
from pymlt.rendering.first_seen import first_seen
from pymlt.rendering.frames import scene_at, timing
from pymlt.rendering.options import RenderOptions
from pymlt.rendering.windows import WindowRender, whole

pytest.importorskip("pyoidn", reason="needs pymlt[denoise]")

SIZE = {"width": 64, "height": 48}


def shot(folder: Path, scene=None, integrator="mlt", **settings):
    """The shot, and the images, the noisy ones among them."""
    given = scene or shining()
    given["sensor"]["film"] |= SIZE
    made = {"frames": "1:4", "fps": 20, "spp": 64, "denoise": True, "threads": 1, **settings}
    found = mlt.render_shot(given, integrator, output=folder / "#.exr", **made)
    files = [frame.files[0] for frame in found.frames]
    noisy = [mlt.read_image(f, "noisy") for f in files] if made["denoise"] else None
    return found, [mlt.read_image(f) for f in files], noisy


def world() -> mlt.Scene:
    given = shining()
    given["sensor"]["film"] |= SIZE
    return mlt.load_dict(given)


def test_frames_together_are_denoised_and_know_their_error(tmp_path):
    """Frame 3 is shared by two windows."""
    plain, same, _ = shot(tmp_path, frames="1:5", together=4, denoise=False)
    found, images, noisy = shot(tmp_path, frames="1:5", together=4)
    assert all(f.stats["exposures"] > 1 for f in found.frames)
    assert all(np.array_equal(a, b) for a, b in zip(noisy, same, strict=True))
    assert [f.stats["error"] for f in found.frames] == [f.stats["error"] for f in plain.frames]
    assert [f.flicker for f in found.frames] == [f.flicker for f in plain.frames]
    light = mlt.render(scene_at(world(), timing(20, 0.5), [3]), "mlt", spp=512, seed=99)
    error = relative_error(images[2], light)
    assert error < relative_error(noisy[2], light)
    assert 0.6 < found.frames[2].stats["denoised_error"] / error < 1.6
    assert mlt.read_metadata(tmp_path / "3.exr")["denoised"].endswith("by albedo and normal")
    assert mlt.read_image(tmp_path / "3.exr", "denoised_error").shape == images[2].shape
    flickers = [f.stats.get("denoised_flicker") for f in found.frames]
    assert flickers[0] is None
    assert all(0 < b < 2 * f.flicker for b, f in zip(flickers[1:], found.frames[1:], strict=True))


def test_halves_of_exposures_add_up_to_those_of_the_image():
    window = WindowRender(
        mlt.load_dict(moving()),
        lambda seen: mlt.start(seen, "mlt", spp=1)._integrator,
        timing(10, 0.5),
        whole([1, 2]),
    )
    job = window.start(RenderOptions(spp=64, threads=1))
    job.wait()
    of_all, *of_frames = (job._job.halves(layer) for layer in (-1, 0, 1))
    for half in (0, 1):
        light = sum(frame[half][0] for frame in of_frames)
        assert light == pytest.approx(of_all[half][0], rel=1e-4, abs=1e-5)
    assert not np.array_equal(of_frames[0][0][0], of_frames[1][0][0])


def test_the_guides_of_a_frame_are_those_of_a_render(tmp_path):
    shot(tmp_path, frames="1:3", together=3)
    seen = scene_at(world(), timing(20, 0.5), [2])
    layers = mlt.start(seen, "mlt", spp=1, aovs=GUIDES).result().layers
    found = first_seen(seen, aovs=GUIDES)
    for name in GUIDES.split(","):
        assert np.array_equal(found[name], layers[name])
        stored = mlt.read_image(tmp_path / "2.exr", name)
        assert stored == pytest.approx(layers[name], rel=1e-3, abs=1e-3)


def test_frames_alone_have_some_of_their_neighbours(tmp_path):
    """So they flicker less than each by itself; next to nothing moves."""
    when = {"fps": 500, "frames": "1:3"}
    _, images, _ = shot(tmp_path, together=1, **when)
    jobs = [
        mlt.start(scene_at(world(), timing(500, 0.5), [f]), "mlt", spp=64, denoise=True, threads=1)
        for f in (1, 2)
    ]
    before, after = (job.result().image for job in jobs)
    assert relative_error(images[1], images[0]) < 0.8 * relative_error(after, before)


def test_frames_that_stand_still_do_not_flicker(tmp_path):
    found, images, _ = shot(tmp_path, moving(0.1), "path", frames="1:4")
    assert np.array_equal(images[2], images[3])
    flickers = [f.stats.get("denoised_flicker") for f in found.frames]
    assert flickers[0] is None
    assert flickers[1] > 0
    assert flickers[2:] == [0, 0]
    assert found.stats["denoised_flicker"] > 0


def test_with_few_samples_frames_are_denoised_without_an_error(tmp_path):
    found, images, noisy = shot(tmp_path, frames="1:2", together=1, integrator="path", spp=8)
    assert all("denoised_error" not in f.stats for f in found.frames)
    assert not any(np.array_equal(a, b) for a, b in zip(images, noisy, strict=True))


def test_a_filter_that_fails_leaves_the_frames(tmp_path, monkeypatch):
    import pyoidn

    def fail(*args, **kwargs):
        raise RuntimeError("no device")

    _, plain, _ = shot(tmp_path, frames="1:2", together=2, denoise=False)
    monkeypatch.setattr(pyoidn, "denoise", fail)
    made = {"frames": "1:2", "together": 2, "fps": 20, "spp": 64, "threads": 1, "denoise": True}
    found = mlt.render_shot(world(), "mlt", output=tmp_path / "#.exr", **made)
    for frame, image in zip(found.frames, plain, strict=True):
        assert "no device; the image is not denoised" in frame.stats["warnings"][-1]
        assert np.array_equal(mlt.read_image(frame.files[0]), image)


def test_the_command_line_denoises_frames_together(tmp_path):
    (tmp_path / "scene.xml").write_text(SCENE)
    flags = ["--frames", "1:2", "--together", "2", "--integrator", "mlt", "--spp", "64"]
    done = run(
        PYMLT, "render", tmp_path / "scene.xml", *flags, "--denoise", "-o", tmp_path / "#.exr"
    )
    assert done.returncode == 0, done.stderr
    assert done.stderr.count("denoised") == 2
    assert not np.array_equal(
        mlt.read_image(tmp_path / "2.exr"), mlt.read_image(tmp_path / "2.exr", "noisy")
    )


def test_a_denoised_shot_has_no_checkpoint(tmp_path):
    settings = {"frames": "1:2", "output": tmp_path / "#.exr", "spp": 1}
    with pytest.raises(mlt.UsageError, match="leave one of both out"):
        mlt.render_shot(moving(), denoise=True, checkpoint=str(tmp_path / "a.shot"), **settings)
