"""The last lines of a render: its error, and how long would have done; `--error` in percent."""

import re

import numpy as np
import pytest
from command_line import PYMLT, run, the_error

import pymlt as mlt
from pymlt.cli.common import FLAGS
from pymlt.rendering.needed import duration, needed
from pymlt.rendering.options import RenderOptions
from pymlt.rendering.summary import summary

RENDER = [*PYMLT, "render"]
TOO_FEW = "too few samples to know the error"
RARE = "the error of 0.4 is that of 3 pixels: render for longer"


def made(light=1.0, warnings=(), **stats) -> mlt.Result:
    """A Result that took 10 s to prepare and 40 s to render."""
    seconds = {"load": 0.0, "bootstrap": 10.0, "render": 40.0}
    known = {"spp_done": 4.0, "seconds": seconds, "ended_by": "spp", "warnings": list(warnings)}
    image = np.full((6, 8, 3), light, np.float32)
    return mlt.Result(image, known | stats, {"type": "mlt"}, {}, {})


@pytest.mark.parametrize(
    ("flags", "words"),
    [
        (["--spp", 4], TOO_FEW),
        (["--spp", 32], r"error \d+(\.\d+)? %"),
        (["--spp", 32, "-p", "max_depth=1"], "no light and no error"),
    ],
    ids=str,
)
def test_the_last_line_has_the_error_or_why_there_is_none(scene, flags, words):
    done = run(RENDER, scene, "--integrator", "path", *flags, "-o", "a.exr")
    said = done.stderr.splitlines()[-1]
    assert re.search(rf", {words}: a\.exr$", said), said


def test_a_render_that_runs_is_not_said_to_be_too_short():
    assert summary("mlt", made().image, made(ended_by="", error=None).stats) == (
        "mlt, 8 x 6, 4 spp in 50.0 s"
    )
    assert summary("mlt", made().image, made(error=None).stats).endswith(f", {TOO_FEW}")


@pytest.mark.parametrize(
    ("result", "words"),
    [
        (made(error=None), "to know the error, render for about 3 min (16 spp)"),
        (made(error=None, light=0), ""),
        (made(error=0.3), ""),
        (made(error=0.05, warnings=[RARE]), ""),
        (made(error=0.2, warnings=[RARE]), "for an error of 10 %, render for about 3 min (16 spp)"),
        (
            made(error=0.05, level_error=0.1, warnings=["render for longer"]),
            "to know the brightness to 5 %, render for about 3 min (16 spp)",
        ),
        (
            made(error=1.0, level_error=0.1, warnings=["give it more time"]),
            "for an error of 10 %, render for about 67 min (4e+02 spp), or longer",
        ),
    ],
    ids=str,
)
def test_a_short_render_says_how_long_would_do(result, words):
    said = needed(result)
    assert said.startswith(words)
    assert bool(said) == bool(words)


@pytest.mark.parametrize(
    ("seconds", "words"),
    [
        (0.01, "0.1 s"),
        (9.94, "9.9 s"),
        (9.96, "10 s"),
        (119, "119 s"),
        (120, "2 min"),
        (9e3, "2 h"),
    ],
)
def test_durations_are_said_as_people_do(seconds, words):
    assert duration(seconds) == words


def test_what_is_said_to_be_enough_is_enough(scene):
    flags = [scene, "--integrator", "path", "-o", "a.exr"]
    hint = run(RENDER, *flags, "--spp", 4).stderr.splitlines()[-2]
    spp = re.fullmatch(r"pymlt: to know the error, render for about \d+\.\d s \((\d+) spp\)", hint)[
        1
    ]
    assert TOO_FEW not in run(RENDER, *flags, "--spp", spp).stderr
    assert run(RENDER, *flags, "--spp", 4, "--quiet").stderr == ""


def test_percent_are_a_share(scene):
    for percent, share in (("5%", "0.05"), ("0.7 %", "0.007"), ("100%", "1")):
        errors = [RenderOptions(error=FLAGS["error"].read(text)).error for text in (percent, share)]
        assert errors[0] == pytest.approx(errors[1], rel=1e-12)
    images = [mlt.render(scene, "path", error=e, seed=3) for e in ("40%", 0.4)]
    assert np.array_equal(*images)
    job = mlt.start(scene, "path", spp=2)
    job.wait()
    with pytest.raises(mlt.UsageError, match="did you mean '3%'"):
        job.extend(error=3)


@pytest.mark.parametrize(
    ("error", "said"),
    [
        ("5", "error is 5, which is 500 %; did you mean '5%'?"),
        ("150%", "is not a share up to 1 or percent up to 100"),
        ("0%", "'0%' is not a share up to 1"),
        ("much%", "'much%' is not a share up to 1"),
    ],
)
def test_an_error_above_one_is_asked_about(scene, error, said):
    assert said in the_error(run(RENDER, scene, "--error", error, "-o", "a.exr"))


@pytest.mark.parametrize("error", ["0%", "-3%", "150%", "much%"])
def test_percent_that_are_no_share_are_refused_in_python(scene, error):
    with pytest.raises(mlt.UsageError, match=f"error '{error}' is not a share up to 1 or percent"):
        mlt.start(scene, "path", error=error)
