"""`pymlt render --resume`: which scene and flags may stand beside it, and what is to come."""

import re
from pathlib import Path

import numpy as np
import pytest
import tiny
from command_line import PYMLT, mlt_render, run, the_error

import pymlt as mlt
from pymlt import _core
from pymlt.cli.common import FLAGS
from pymlt.cli.resuming import SAVED

RENDER = [*PYMLT, "render"]
SCENE_FLAGS = ["--size", "16x12", "--filter", "box"]
RENDER_FLAGS = ["--integrator", "path", "-p", "maxDepth=3", "--seed", 7]
AGAIN = ["--resume", "a.mlt", "-o", "b.exr"]


@pytest.fixture
def door(tmp_path, monkeypatch) -> list:
    """The command whose checkpoint is a.mlt, of a built-in scene."""
    monkeypatch.chdir(tmp_path)
    command = ["door-ajar", "-D", "opening=40", *SCENE_FLAGS, *RENDER_FLAGS, "--spp", 2]
    done = run(RENDER, *command, "-o", "a.exr", "--checkpoint", "a.mlt")
    assert done.returncode == 0, done.stderr
    return command


@pytest.fixture
def file(scene) -> list:
    """The command whose checkpoint is a.mlt, of a file."""
    command = [scene, "-D", "res=9", "--lenient", "--sensor", 0, *RENDER_FLAGS, "--spp", 2]
    done = run(RENDER, *command, "-o", "a.exr", "--checkpoint", "a.mlt")
    assert done.returncode == 0, done.stderr
    return command


def test_a_checkpoint_says_what_both_programs_cannot_change():
    def is_refused(name):
        try:
            _core.check_flags({"resume", name})
        except mlt.UsageError:
            return True
        return False

    assert set(filter(is_refused, FLAGS)) == SAVED


@pytest.mark.parametrize("which", ["door", "file"])
def test_a_whole_command_may_be_repeated(which, request):
    command = request.getfixturevalue(which)
    done = run(RENDER, *command, *AGAIN)
    assert done.returncode == 0, done.stderr
    assert np.array_equal(mlt.read_image("b.exr"), mlt.read_image("a.exr"))


@pytest.mark.parametrize(
    "flags",
    [["--sensor", 0], ["-D", "opening=40.0"], ["-p", "max_depth=3"], ["-p", "waves=true"]],
    ids=str,
)
def test_another_way_to_say_what_the_checkpoint_says_is_taken(door, flags):
    done = run(RENDER, *AGAIN, *flags)
    assert done.returncode == 0, done.stderr


@pytest.mark.parametrize(
    ("flags", "said"),
    [
        (["--seed", 8], "--seed is 8 here and 7 in the checkpoint a.mlt;"),
        (["--size", "12x16"], "--size is 12x16 here and 16x12 in"),
        (["--filter", "tent"], "--filter is tent here and box in"),
        (["--spectral"], "--spectral is given here and not in"),
        (["--sensor", 1], "--sensor is 1 here and 0 in"),
        (["--integrator", "bdpt"], "--integrator is bdpt here and path in"),
        (["-p", "max_depth=4"], "-p max_depth is 4 here and 3 in"),
        (["-p", "maxDepth=4"], "-p maxDepth is 4 here and 3 in"),
        (["-D", "opening=41"], "-D opening is 41 here and 40 in"),
        (["-p", "max_dpeth=3"], "did you mean 'max_depth'?"),
        (["-D", "openin=40"], "unknown parameter of the scene 'door_ajar'"),
    ],
    ids=str,
)
def test_a_flag_that_differs_is_named_with_both_values(door, flags, said):
    assert said in the_error(run(RENDER, *AGAIN, *flags))


@pytest.mark.parametrize(
    ("flags", "said"),
    [
        (["-D", "res=9"], "need SCENE"),
        (["scene.xml", "-D", "res=10"], "scene.xml as -D, --sensor, --lenient and --strict say"),
        (["scene.xml", "--seed", 8], "--seed is 8 here and 7 in"),
    ],
    ids=str,
)
def test_how_a_file_is_read_cannot_change(file, flags, said):
    assert said in the_error(run(RENDER, *AGAIN, *flags))


@pytest.mark.parametrize("flag", ["--seed", "-p", "--size", "--integrator", "--filter"])
def test_mlt_render_takes_no_flag_that_the_checkpoint_says(flag):
    binary = mlt_render() or pytest.skip("mlt-render is not installed beside this Python")
    value = {"--size": "3x4", "-p": "a=1"}.get(flag, "0")
    error = the_error(run(binary, *AGAIN, flag, value))
    assert f"{flag} cannot be given with --resume: the checkpoint says it" in error


def test_another_scene_is_refused_by_its_name(door):
    error = the_error(run(RENDER, "ring", *AGAIN))
    assert error == "pymlt: a.mlt: is a checkpoint of 'door_ajar', not of 'ring'"
    assert "'door-ajr' is neither a file nor" in the_error(run(RENDER, "door-ajr", *AGAIN))
    with pytest.raises(mlt.SceneError, match="not of 'ring'"):
        mlt.resume("a.mlt", scene="ring")


def test_a_name_is_not_the_scene_of_a_file(file):
    error = the_error(run(RENDER, "ring", *AGAIN))
    assert "a.mlt: is a checkpoint of a scene from elsewhere, not of 'ring'" in error


def test_another_file_is_named_beside_the_scene_of_the_checkpoint(file):
    Path("other.xml").write_text(tiny.XML.replace("5, 6, 7", "7, 6, 5"))
    error = the_error(run(RENDER, "other.xml", *AGAIN))
    assert "its scene '" in error
    assert error.endswith(
        "/scene.xml' has changed since the checkpoint was written; it can only be "
        "resumed with the scene as it was, which 'other.xml' is not"
    )
    Path("model.obj").write_text("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n")
    error = the_error(run(RENDER, "model.obj", *AGAIN))
    assert error.endswith("is a checkpoint of a scene from elsewhere, not of 'model.obj'")


def test_the_filter_of_a_denoised_render_is_that_of_the_checkpoint(tmp_path, monkeypatch):
    pytest.importorskip("pyoidn", reason="denoising needs pyoidn")
    monkeypatch.chdir(tmp_path)
    flags = ["furnace", "--size", "8x6", "--integrator", "path", "--spp", 2, "--filter", "tent"]
    run(RENDER, *flags, "--checkpoint", "a.mlt", "-o", "a.exr")
    done = run(RENDER, *AGAIN, "--denoise")
    assert done.returncode == 0, done.stderr
    assert "the filter 'tent' spreads noise" in done.stderr


def test_a_spectral_scene_of_the_package_is_resumed(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    flags = ["ring", "--spectral", "--size", "8x6", "--integrator", "path", "--quiet"]
    run(RENDER, *flags, "--spp", 2, "--checkpoint", "a.mlt", "-o", "a.exr")
    done = run(RENDER, *AGAIN, "--spp", 4)
    assert done.returncode == 0, done.stderr
    run(RENDER, *flags, "--spp", 4, "-o", "a.exr")
    assert np.array_equal(mlt.read_image("b.exr"), mlt.read_image("a.exr"))


def test_a_render_that_goes_on_says_what_is_to_come(door):
    said = run(RENDER, *AGAIN, "--spp", 6).stderr.splitlines()[0]
    assert re.fullmatch(
        r"pymlt: going on after \d+\.\d s and 2 spp; 4 spp to come, 6 spp in all", said
    )
    said = run(RENDER, *AGAIN, "--spp", 6).stderr.splitlines()[0]
    assert said.endswith("; nothing to come: --spp 6 counts from the very beginning")
    said = run(RENDER, *AGAIN, "--time", 0.5).stderr.splitlines()[0]
    to_come = re.search(r"6 spp; (0\.\d+) s to come, 0\.5 s in all$", said)
    assert to_come, said
    assert 0 < float(to_come[1]) <= 0.5
    assert run(RENDER, *AGAIN).stderr.count("to come") == 0
