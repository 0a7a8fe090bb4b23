"""Jobs: determinism, budgets, progress, cancelling, Ctrl-C."""

import contextlib
import os
import signal
import subprocess
import sys
import time

import numpy as np
import pytest
import tiny

import pymlt as mlt
from pymlt.cli.common import say
from pymlt.rendering.progress import progress_bar


@pytest.fixture(scope="module")
def scene():
    return mlt.load_string(tiny.XML, res=24)


def big_scene():
    return mlt.load_dict(tiny.scene(), size=(320, 240))


@pytest.mark.parametrize("integrator", mlt.available("integrator"))
def test_the_number_of_threads_does_not_change_a_bit(scene, integrator):
    images = [mlt.render(scene, integrator, spp=6, seed=3, threads=n) for n in (1, 2, 3)]
    assert np.array_equal(images[0], images[1])
    assert np.array_equal(images[0], images[2])


@pytest.mark.parametrize("integrator", mlt.available("integrator"))
def test_the_seed_changes_the_noise(scene, integrator):
    a, b = (mlt.render(scene, integrator, spp=2, seed=s) for s in (1, 2))
    assert not np.array_equal(a, b)


def test_an_image_is_linear_float_rgb_with_row_0_on_top(scene):
    image = mlt.render(scene, spp=4)
    assert image.shape == (12, 24, 3)
    assert image.dtype == np.float32
    assert image[:6].mean() < image[6:].mean()  # the floor is below, the dark above


def test_without_a_budget_the_scene_decides(scene):
    assert mlt.start(scene).result().stats["spp_done"] == 4


def test_time_ends_a_render():
    start = time.perf_counter()
    stats = mlt.start(big_scene(), time=0.5).result().stats
    assert 0.4 < time.perf_counter() - start < 5
    assert 0.4 < stats["seconds"]["render"] < 5
    assert stats["spp_done"] > 0


@pytest.mark.long
@pytest.mark.parametrize("integrator", mlt.available("integrator"))
def test_time_is_kept_within_two_percent(integrator):
    scene = mlt.load_dict(mlt.scenes.door_ajar(), size=(640, 360))
    off = []
    for seed in range(5):
        start = time.perf_counter()
        mlt.start(scene, integrator, time=10.5, seed=seed).wait()
        off.append(abs(time.perf_counter() - start - 10.5) / 10.5)
    assert np.median(off) < 0.02


@pytest.mark.parametrize(
    "wrong",
    [
        {"spp": 0},
        {"spp": -1},
        {"spp": float("nan")},
        {"spp": "many"},
        {"spp": "4"},
        {"spp": True},
        {"spp": 2**31},
        {"spp": 10**400},
        {"time": "1"},
        {"spp": 1e20},
        {"every": 1e300},
        {"threads": 4097},
        {"time": 0},
        {"error": 0},
        {"error": "small"},
        {"error": "small%"},
        {"error": "0.05"},
        {"error": "150%"},
        {"error": 5},
        {"every": 0},
        {"threads": -1},
        {"seed": -1},
        {"seed": 2**64},
        {"seed": 1.5},
        {"seed": True},
    ],
    ids=str,
)
def test_settings_that_make_no_sense_are_refused(scene, wrong):
    with pytest.raises(mlt.UsageError, match=next(iter(wrong))):
        mlt.render(scene, **wrong)


def test_a_job_runs_beside_python_and_can_be_cancelled():
    job = mlt.start(big_scene(), spp=1e7)
    steps = 0
    seen = []
    deadline = time.perf_counter() + 1
    while time.perf_counter() < deadline:
        steps += 1
        seen.append(job.progress)
    assert steps > 1000  # the interpreter was never held up
    assert seen == sorted(seen)
    assert not job.ended
    assert not job.wait(timeout=0.05)
    assert "running" in repr(job)
    job.cancel()
    start = time.perf_counter()
    result = job.result()
    assert time.perf_counter() - start < 2
    assert job.ended
    assert job.cancelled
    assert 0 < result.stats["spp_done"] < 1e7
    assert result.image.max() > 0


def test_progress_is_reported_to_a_function():
    seen = []
    mlt.render(big_scene(), time=0.6, progress=seen.append)
    assert len(seen) >= 2
    assert seen == sorted(seen)
    assert 0 <= seen[0] < seen[-1] <= 1


def test_a_progress_bar_can_be_asked_for(capsys):
    mlt.render(big_scene(), time=0.4, progress=True)
    assert "%" in capsys.readouterr().err
    mlt.render(big_scene(), time=0.3)
    assert capsys.readouterr().err == ""  # not a terminal


def test_what_is_said_meanwhile_stands_above_the_progress_bar(capsys):
    with progress_bar(True) as show:
        show(0.5, {})
        assert "%" in capsys.readouterr().err
        say("a line")
        cleared, line, drawn = capsys.readouterr().err.partition("pymlt: a line\n")
    assert cleared.endswith("\r")
    assert line
    assert "50%" in drawn


def test_stats_have_the_promised_members(scene):
    stats = mlt.start(scene, "pssmlt", spp=64, seed=9).result().stats
    assert {k: type(v) for k, v in stats.items()} == {
        "version": str,
        "integrator": str,
        "seed": int,
        "size": list,
        "spp_done": type(stats["spp_done"]),
        "seconds": dict,
        "rays": dict,
        "ended_by": str,
        "groups": int,
        "error": float,
        "block_error": float,
        "pixels_carrying_error": float,
        "disagreements": list,
        "b": float,
        "b_error": float,
        "level_error": float,
        "independent_share": float,
        "independent": str,
        "independent_samples": int,
        "samples_carrying_half": int,
        "tours": int,
        "longest_tour": int,
        "tours_waiting": type(stats["tours_waiting"]),
        "invalid_samples": int,
        "stuck": list,
        "mutations": list,
        "warnings": list,
    }
    assert stats["integrator"] == "pssmlt"
    assert stats["seed"] == 9
    assert stats["size"] == [24, 12]
    assert set(stats["seconds"]) == {"load", "bootstrap", "render"}
    assert set(stats["rays"]) == {"intersect", "occluded"}
    assert stats["rays"]["intersect"] > 0
    assert stats["b"] > 0
    for mutation in stats["mutations"]:
        assert mutation["accepted"] <= mutation["generated"] <= mutation["proposed"]


def test_a_render_that_fails_says_why():
    dark = tiny.scene()
    dark["lamp"]["emitter"]["radiance"]["value"] = [0.0, 0.0, 0.0]
    with pytest.raises(mlt.RenderError, match="light"):
        mlt.render(dark, mlt.PSSMLT(independent_share=0), spp=1)


def test_a_render_without_light_warns():
    dark = tiny.scene()
    dark["lamp"]["emitter"]["radiance"]["value"] = [0.0, 0.0, 0.0]
    result = mlt.start(dark, "pssmlt", spp=1).result()
    assert not result.image.any()
    assert "no light" in " ".join(result.stats["warnings"])


# ---- signals -----------------------------------------------------------------------------------

SETUP = """
import sys
sys.path.insert(0, {folder!r})
import pymlt as mlt, tiny
scene = mlt.load_dict(tiny.scene(), size=(320, 240))
"""


def python(code: str, **kwargs) -> subprocess.Popen:
    from pathlib import Path

    setup = SETUP.format(folder=str(Path(tiny.__file__).parent))
    return subprocess.Popen(
        [sys.executable, "-c", setup + code],
        text=True,
        stdout=subprocess.PIPE,
        # What a shell starts in the background has Ctrl-C ignored, and so have its children.
        preexec_fn=lambda: signal.signal(signal.SIGINT, signal.SIG_DFL),
        **kwargs,
    )


def test_ctrl_c_is_prompt_and_keeps_the_image_so_far():
    process = python(
        """
def started(done):
    if done > 0: print("started", flush=True)
try:
    mlt.render(scene, spp=1e7, progress=started)
except KeyboardInterrupt as error:
    print(error.result, error.result.image.max() > 0)
"""
    )
    assert process.stdout.readline() == "started\n"
    start = time.perf_counter()
    process.send_signal(signal.SIGINT)
    out, _ = process.communicate(timeout=20)
    assert time.perf_counter() - start < 3
    assert process.returncode == 0
    assert out.splitlines()[-1].startswith("Result(path, 320 x 240, ")
    assert out.splitlines()[-1].endswith("True")


def test_leaving_python_ends_running_jobs():
    process = python("job = mlt.start(scene, spp=1e7); print('started', flush=True)")
    assert process.stdout.readline() == "started\n"
    process.communicate(timeout=20)
    assert process.returncode == 0


# ---- too little time -----------------------------------------------------------------------------


@pytest.mark.parametrize("name", ["mlt", "mmlt", "pssmlt"])
def test_preparation_takes_a_small_part_of_the_time(name, scene):
    """However many samples it has at the most."""
    stats = mlt.start(scene, {"type": name, "luminance_samples": 10**8}, time=3).result().stats
    assert stats["seconds"]["bootstrap"] < 1
    assert 0 < stats["independent_share"] < 1
    assert sum(row["proposed"] for row in stats["mutations"]) > 0


# ---- paths that do not end -----------------------------------------------------------------------


def white_room():
    """A closed room where nothing is absorbed: only Russian roulette or max_depth end a path."""
    scene = mlt.scenes.furnace()
    scene["shape"]["bsdf"]["reflectance"]["value"] = [1, 1, 1]
    return mlt.load_dict(scene, size=(512, 384))


def endless(name: str) -> dict:
    roulette = {"rr_depth": 2**31 - 1} if name in SAMPLERS else {}
    return {"type": name, "max_depth": 2**31 - 1, **roulette}


SAMPLERS = ["path", "bdpt", "ptracer"]
CHAINS = ["pssmlt", "mlt"]


def test_time_ends_samples_whose_paths_do_not_end():
    """All at once, since a render waits seconds for a path before it gives it up."""
    scene = white_room()
    start = time.perf_counter()
    jobs = [mlt.start(scene, endless(name), time=0.3, threads=1) for name in SAMPLERS]
    for job in jobs:
        with contextlib.suppress(mlt.RenderError):  # that there is no sample yet
            job.result()
    assert time.perf_counter() - start < 20


@pytest.mark.parametrize("name", CHAINS)
def test_time_ends_chains_whose_paths_do_not_end(name, tmp_path):
    """It may be too short for chains; the samples in their place have Russian roulette."""
    job = mlt.start(white_room(), endless(name), time=0.3)
    assert job.result().stats["ended_by"] == "time"
    job.checkpoint(tmp_path / "a.mlt")
    resumed = mlt.resume(tmp_path / "a.mlt", scene=white_room(), time=0.6).result()
    assert resumed.stats["ended_by"] == "time"


def test_cancel_ends_renders_whose_paths_do_not_end(tmp_path):
    scene = white_room()
    jobs = [mlt.start(scene, endless(name), spp=64, threads=1) for name in SAMPLERS + CHAINS]
    assert not jobs[0].wait(0.5)
    assert not any(job.ended for job in jobs)
    for job in jobs:
        job.cancel()
    for job in jobs:
        job.wait()
    check_that_it_gave_up_a_path(jobs[SAMPLERS.index("bdpt")], tmp_path)


def check_that_it_gave_up_a_path(job, folder):
    """It says so and does not go on."""
    (warning,) = job.result().stats["warnings"]
    assert "had not ended" in warning
    assert "max_depth" in warning
    for action in lambda: job.extend(spp=65), lambda: job.checkpoint(folder / "a.mlt"):
        with pytest.raises(mlt.UsageError, match="gave up a light path"):
            action()


@pytest.mark.parametrize("name", ["path", "ptracer", "bdpt"])
def test_a_path_without_light_ends(name):
    """Of the furnace's albedo of 0.8, less than 1e-37 is left after 390 vertices."""
    scene = mlt.scenes.furnace()
    scene["sensor"]["film"]["rfilter"] = {"type": "box"}
    scene = mlt.load_dict(scene, size=(2, 2))
    stats = mlt.start(scene, {"type": name, "rr_depth": 10**6}, spp=4, seed=1).result().stats
    samples = 4 * 4
    assert 100 < stats["rays"]["intersect"] / samples < 1000  # bdpt has two subpaths


def test_a_forked_process_does_not_wait_for_its_parents_render(scene, tmp_path):
    job = mlt.start(scene, spp=1e9)
    while job.stats["spp_done"] == 0:
        job.wait(0.01)
    looks = [
        job.result,
        job.snapshot,
        lambda: job.image,
        lambda: job.stats,
        lambda: job.groups,
        lambda: job.error_map,
        lambda: job.checkpoint(tmp_path / "a.mlt"),
    ]
    child = os.fork()
    if child == 0:
        os._exit(sum(not is_told_of_the_fork(look) for look in looks))
    assert os.waitpid(child, 0)[1] == 0
    job.cancel()
    job.wait()


def is_told_of_the_fork(look):
    try:
        look()
    except mlt.RenderError as error:
        return "in the process that started it" in str(error) and not hasattr(error, "result")
    return False


MIRRORS = """\
<scene version="3.0.0">
  <sensor type="perspective"><film type="hdrfilm">
    <integer name="width" value="16"/><integer name="height" value="16"/>
  </film></sensor>
  <shape type="cube">
    <transform name="to_world"><scale value="-5"/></transform>
    <bsdf type="twosided">
      <bsdf type="conductor"><string name="material" value="none"/></bsdf>
    </bsdf>
  </shape>
  <emitter type="point"><point name="position" x="0" y="2" z="1"/></emitter>
</scene>
"""


@pytest.mark.parametrize("name", ["bdpt", "mlt", "mmlt", "erpt"])
def test_time_ends_walks_between_mirrors(name):
    """No pair of the thousands of vertices of two walks needs a ray, by which walks are stopped."""
    start = time.perf_counter()
    endless = {"type": name, "max_depth": -1, "rr_depth": 2**31 - 1}
    with contextlib.suppress(mlt.RenderError):  # that the time was too short
        mlt.start(mlt.load_string(MIRRORS), endless, time=0.5).result()
    assert time.perf_counter() - start < 20


def test_preparation_by_searches_through_glass_is_bounded():
    """All light comes through a glass ball, and much of it by way of further balls."""
    rng = np.random.default_rng(1)
    balls = {
        f"ball {i}": {
            "type": "sphere",
            "center": place.tolist(),
            "radius": 0.2,
            "bsdf": {"type": ["dielectric", "conductor"][i % 2]},
        }
        for i, place in enumerate(rng.uniform(-0.7, 0.7, (12, 3)))
    }
    camera = mlt.Transform.look_at(origin=[0, 0, 0.95], target=[0, 0, -1], up=[0, 1, 0])
    scene = mlt.load_dict(
        {
            "type": "scene",
            "sensor": {"type": "perspective", "fov": 60.0, "to_world": camera},
            "walls": {"type": "cube", "bsdf": {"type": "twosided", "bsdf": {"type": "diffuse"}}},
            "glass": {
                "type": "sphere",
                "center": [0, 0.5, 0],
                "radius": 0.3,
                "bsdf": {"type": "dielectric"},
            },
            "lamp": {"type": "point", "position": [0, 0.5, 0.1]},
            **balls,
        },
        size=(16, 16),
    )
    start = time.process_time()
    mlt.start(scene, "mlt", spp=0.1, threads=1).result()
    assert time.process_time() - start < 5  # two on an idle processor
