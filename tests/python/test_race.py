"""Races: scores that are known in closed form, programs that fail, pages that stand alone."""

import json
import os
import re
import sys
from math import sqrt
from time import process_time
from types import SimpleNamespace

import numpy as np
import pytest
import tiny
from command_line import PYMLT, run, the_error

import pymlt as mlt
from pymlt.diagnostics.metrics import relative_square
from pymlt.race.calibration import Calibration, calibrate
from pymlt.race.child import run_child
from pymlt.race.insets import choose_insets
from pymlt.race.races import judged
from pymlt.race.report.table import levels_apart
from pymlt.race.result import Entry, Settings
from pymlt.race.run import Run, Snapshot
from pymlt.race.score import Judge, Mean, mean_of

SIZE = (16, 12)  # of the tiny scene


@pytest.fixture
def painter(tmp_path):
    """A program that paints 0.5 with noise of a given size: command(sigma)."""

    def command(sigma: float, before: str = "") -> str:
        for seed in range(9):
            mlt.write_image(tmp_path / f"{sigma}-{seed}.exr", painted(seed, sigma))
        return f"{before}cp {tmp_path}/{sigma}-{{seed}}.exr {{output}}"

    return command


def painted(seed: int, sigma: float) -> np.ndarray:
    """What the painter paints."""
    noise = np.random.default_rng(seed).normal(size=(12, 16, 3))
    return np.asarray(0.5 + sigma * noise, dtype=np.float32)


def noisy(seed: int, sigma: float, count: int, size=(64, 64), mean=0.5) -> list[np.ndarray]:
    rng = np.random.default_rng(seed)
    return [mean + sigma * rng.normal(size=(*size, 3)) for _ in range(count)]


# ---- scores


def test_level_and_shape_are_told_apart_exactly():
    reference = np.random.default_rng(1).random((9, 7, 3)) + 0.1
    factors = [0.8, 1.0, 1.5]
    score = Judge.with_reference([reference]).score([f * reference for f in factors], 1)
    assert score.shape.value == pytest.approx(0, abs=1e-20)
    assert score.level.value == pytest.approx(np.mean(factors))
    assert score.level_spread == pytest.approx(np.std(factors, ddof=1))
    assert score.level.error == pytest.approx(score.level_spread / sqrt(3))
    expected = [(f - 1) ** 2 * (reference**2 / (reference**2 + 0.01)).mean() for f in factors]
    assert score.relmse.value == pytest.approx(np.mean(expected))


def test_shape_is_what_is_left_without_the_level():
    reference = np.random.default_rng(2).random((9, 7, 3)) + 0.1
    rough = reference * np.where(np.indices((9, 7)).sum(axis=0) % 2, 1.1, 0.9)[..., None]
    rough *= reference.mean() / rough.mean()
    judge = Judge.with_reference([reference])
    alone, scaled = judge.score([rough], 1), judge.score([3 * rough], 1)
    assert scaled.shape.value == pytest.approx(alone.relmse.value)
    assert alone.shape.value == pytest.approx(alone.relmse.value)
    assert scaled.relmse.value > 100 * alone.relmse.value


def test_the_scores_are_those_of_compare():
    reference, image = noisy(3, 0.2, 2, size=(40, 50))
    score = Judge.with_reference([reference]).score([image], 1, flip=True)
    metrics = mlt.compare(image, reference, flip=score.flip is not None)
    assert score.relmse.value == pytest.approx(metrics["relmse"])
    assert score.trimmed.value == pytest.approx(metrics["relmse_trimmed"])
    assert score.pixel_median.value == pytest.approx(metrics["relmse_median"])
    assert score.percentile_90.value == pytest.approx(metrics["relmse_p90"])
    assert score.flip is None or score.flip.value == pytest.approx(metrics["flip"])


def test_two_seeds_tell_half_their_squared_difference():
    a, b = noisy(4, 0.1, 2)
    judge = Judge.between_seeds([[a, b]])
    pair = ((a - b) ** 2 / 2 / (((a + b) / 2) ** 2 + 0.01)).mean(axis=2)
    score = judge.score([a, b], 1)
    assert score.relmse.value == pytest.approx(pair.mean())
    assert score.pixel_median.value == pytest.approx(np.median(pair))
    assert score.percentile_90.value == pytest.approx(np.quantile(pair, 0.9))
    # Of one pair the spread is not known.
    assert score.relmse.error is score.pixel_median.error is score.percentile_90.error is None


@pytest.mark.parametrize("count", [2, 3, 8])
def test_without_a_reference_the_error_is_that_of_the_noise(count):
    """Noise of variance 0.01 around 0.5, relative to 0.5^2 + 0.01."""
    scale = np.full((16, 16, 3), 0.5)
    judge = Judge(scale, None, np.zeros((16, 16)))
    found = [judge.score(noisy(s, 0.1, count, (16, 16)), 1).relmse.value for s in range(200)]
    z = (np.mean(found) - 0.01 / 0.26) / (np.std(found, ddof=1) / sqrt(len(found)))
    assert abs(z) < 4
    assert np.std(found, ddof=1) / sqrt(len(found)) < 0.01 * 0.01 / 0.26  # 4 % would be seen


def test_black_images_have_no_error_between_seeds():
    black, lit = np.zeros((4, 6, 3)), np.ones((4, 6, 3))
    judge = Judge.between_seeds([[black, black], [lit, 2 * lit]])
    score = judge.score([black, black], 1)
    assert score.relmse is score.median is score.trimmed is None
    assert score.pixel_median is score.percentile_90 is None
    assert score.level.value == 0
    assert judge.score([lit, 2 * lit], 1).relmse.value > 0


def test_the_error_between_seeds_is_that_of_the_jackknife():
    images, scale = noisy(5, 0.1, 5, (8, 8)), np.full((8, 8, 3), 0.5)
    judge = Judge(scale, None, np.zeros((8, 8)))
    without = [judge.score(images[:i] + images[i + 1 :], 1).relmse.value for i in range(5)]
    jackknife = sqrt(4 / 5 * np.sum((without - np.mean(without)) ** 2))
    assert judge.score(images, 1).relmse.error == pytest.approx(jackknife)


def test_the_error_of_a_noisy_reference_is_subtracted():
    references, images = noisy(6, 0.04, 4), noisy(7, 0.02, 6)
    score = Judge.with_reference(references).score(images, 1)
    blind = Judge.with_reference([np.mean(references, axis=0)]).score(images, 1)
    assert blind.relmse.value == pytest.approx(2 * 0.0004 / 0.26, rel=0.05)
    assert score.relmse.value == pytest.approx(0.0004 / 0.26, rel=0.05)


def test_the_noise_of_a_reference_is_not_subtracted_from_quantiles():
    references, images = noisy(9, 0.04, 2), noisy(10, 0.02, 3)
    score = Judge.with_reference(references).score(images, 1)
    maps = [relative_square(image, np.mean(references, axis=0)) for image in images]
    assert score.pixel_median == mean_of([float(np.median(errors)) for errors in maps])
    assert score.percentile_90 == mean_of([float(np.quantile(errors, 0.9)) for errors in maps])
    assert score.relmse.value < np.mean(maps) / 2  # of which the noise is subtracted


def test_light_that_nobody_finds_counts_only_against_a_reference():
    reference = np.full((10, 10, 3), 0.5)
    images = noisy(11, 0.01, 3, (10, 10))
    reference[:3] = 2  # a third of the image, and less than half
    known = Judge.with_reference([reference]).score(images, 1)
    spread = Judge.between_seeds([images]).score(images, 1)
    assert known.percentile_90.value == pytest.approx(1.5**2 / 4.01, rel=0.05)
    assert known.pixel_median.value < 0.001
    assert max(spread.relmse.value, spread.percentile_90.value) < 0.001


def test_trimming_forgives_a_firefly():
    reference = np.full((50, 50, 3), 0.5)
    image = reference + 0.1
    image[3, 4] = 1e4
    score = Judge.with_reference([reference]).score([image], 1)
    assert score.relmse.value > 1e3
    assert score.trimmed.value == pytest.approx(0.01 / 0.26)
    assert score.pixel_median.value == pytest.approx(0.01 / 0.26)
    assert score.percentile_90.value == pytest.approx(0.01 / 0.26)
    assert score.sparks == 1


def test_what_the_reference_has_is_no_spark():
    reference = np.full((20, 30, 3), 0.5)
    reference[9, 9] = 3
    reference[15:] = 100  # an edge is none
    image = reference.copy()
    image[[4, 5], [20, 25]] = 2.6
    score = Judge.with_reference([reference]).score([reference, image], 1)
    assert score.sparks == 1  # none, and two
    assert Judge.between_seeds([[image]]).score([image], 1).sparks == 3


def test_the_median_forgives_a_seed():
    reference = np.full((9, 9, 3), 0.5)
    images = [reference + d for d in (0.1, 0.2, 50.0)]
    score = Judge.with_reference([reference]).score(images, 1)
    assert score.median == pytest.approx(0.04 / 0.26)


def test_one_image_without_a_reference_has_a_level_alone():
    (image,) = noisy(8, 0.1, 1)
    score = Judge.between_seeds([[image]]).score([image], 1)
    assert (score.relmse, score.trimmed, score.shape, score.level_spread) == (None,) * 4
    assert score.pixel_median is score.percentile_90 is None
    assert score.level.value == pytest.approx(1)


@pytest.mark.parametrize(
    ("mean", "text"),
    [
        (Mean(0.03678, 0.0012), "0.0368 ± 0.0012"),
        (Mean(0.7791, 0.054), "0.78 ± 0.05"),
        (Mean(12.34, 11.0), "12 ± 11"),
        (Mean(1234.5, 321.0), "1.23e+03 ± 3e+02"),
        (Mean(0.012345), "0.0123"),
        (Mean(1.0, 0.0), "1"),
    ],
)
def test_means_are_written_with_the_digits_that_are_known(mean, text):
    assert str(mean) == text


def test_the_mean_of_nothing_is_nothing():
    assert mean_of([]) is None
    assert mean_of([2.0]) == Mean(2.0, None)


# ---- races


@pytest.fixture(scope="module")
def scene():
    return mlt.load_dict(tiny.scene())


def test_a_race_of_integrators_is_complete(scene):
    reference = mlt.render(scene, "path", spp=256)
    algorithms = ["path", "bdpt:max_depth=3", ("mine", mlt.PTracer(max_depth=4))]
    budget = {"seconds": 0.3, "repeats": 2, "threads": 1, "seed": 5}
    race = mlt.equal_time(algorithms, scene, reference, **budget)
    assert [entry.label for entry in race.entries] == ["path", "bdpt:max_depth=3", "mine"]
    for entry in race.entries:
        assert not entry.problem
        assert [run.seed for run in entry.runs] == [5, 6]
        assert all(run.seconds >= 0.3 and run.spp > 0 for run in entry.runs)
        assert len(entry.scores) == len(race.settings.times) == 4
        taken = [score.seconds for score in entry.scores if score]
        assert taken == sorted(taken)
        assert entry.score.relmse.value > 0
        assert entry.image.shape == (12, 16, 3)
    assert race["bdpt:max_depth=3"].settings["max_depth"] == 3
    assert race["path"].settings["max_depth"] == 4  # a name keeps what the scene says
    assert race.reference_error == 0
    assert not race.interrupted


def test_programs_are_scored_by_their_images(painter, scene):
    """The numbers are those of the images that the programs are known to write."""
    programs = [mlt.Program(painter(sigma), label) for sigma, label in [(0.1, "a"), (0.02, "b")]]
    race = mlt.equal_time(programs, scene, seconds=1, repeats=3, times=())
    images = {label: [painted(s, x) for s in range(3)] for label, x in [("a", 0.1), ("b", 0.02)]}
    judge = Judge.between_seeds(list(images.values()))
    for label, own in images.items():
        assert race[label].score.relmse == judge.score(own, 1).relmse
        assert race[label].score.seconds >= 0
        assert [run.seed for run in race[label].runs] == [0, 1, 2]
    assert race["a"].score.relmse.value == pytest.approx(0.01 / 0.26, rel=0.2)
    against = mlt.equal_time(
        programs[:1], scene, np.full((12, 16, 3), 0.5), seconds=1, repeats=1, times=()
    )
    expected = mlt.compare(painted(0, 0.1), np.full((12, 16, 3), 0.5), flip=False)["relmse"]
    assert against["a"].score.relmse.value == pytest.approx(expected)


def test_algorithms_take_turns(painter, scene, tmp_path):
    log = tmp_path / "log"
    programs = [
        mlt.Program(painter(0.1, f"echo {label} {{seed}} {{seconds}} >> {log}; "), label)
        for label in "ab"
    ]
    race = mlt.equal_time(programs, scene, seconds=8, repeats=2, seed=7, times=(0.5,))
    assert re.search(r"- a took \S+ CPU seconds instead of \d+\.", race.table())
    turns = [f"{label} {seed} {s}" for seed in (7, 8) for label in "ab" for s in (4, 8)]
    assert log.read_text().splitlines() == turns


@pytest.mark.parametrize(
    ("command", "problem"),
    [
        ("echo one; echo two; exit 3 # {output}", "it ended with code 3: two"),
        ("kill -9 $$ # {output}", "it ended by SIGKILL: no reason given"),
        ("true {output}", "it has written no image to {output}"),
        ("echo nonsense > {output}", "its image cannot be read"),
        ("cp wide.exr {output}", "its image has 20 x 12 pixels, the scene 16 x 12"),
        ("cp same.exr {output} # {spp}", "its time does not grow with {spp}"),
    ],
)
def test_what_fails_leaves_the_race(command, problem, painter, scene, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    mlt.write_image("wide.exr", np.zeros((12, 20, 3), dtype=np.float32))
    mlt.write_image("same.exr", np.ones((12, 16, 3), dtype=np.float32))
    monkeypatch.setattr("pymlt.race.calibration.MOST", 100)
    programs = [mlt.Program(command, "bad"), mlt.Program(painter(0.1), "good")]
    race = mlt.equal_time(programs, scene, seconds=100, repeats=2, times=())
    assert race["bad"].problem.startswith(problem)
    assert race["bad"].score is None
    assert len(race["good"].runs) == 2
    assert f"bad has left the race: {problem}" in race.table()
    with pytest.raises(mlt.RenderError, match="no algorithm has left an image: bad"):
        mlt.equal_time(programs[:1], scene, seconds=100, repeats=1, times=())


def test_no_time_for_a_sample_is_a_problem(scene):
    with pytest.raises(mlt.RenderError, match="no sample within"):
        mlt.equal_time([mlt.MLT(luminance_samples=10**7)], scene, seconds=0.01, repeats=1)


def test_samples_that_are_no_numbers_are_counted(scene, tmp_path):
    image = np.ones((12, 16, 3), dtype=np.float32)
    image[2, 3] = np.nan
    mlt.write_image(tmp_path / "nan.exr", image)
    program = mlt.Program(f"cp {tmp_path}/nan.exr {{output}}", "nan")
    race = mlt.equal_time([program], scene, np.ones((12, 16, 3)), seconds=1, repeats=1, times=())
    assert race["nan"].score.relmse.value == pytest.approx(1 / 1.01 / 192)
    assert "nan: 3 samples are not numbers and count as 0." in race.table()


def test_an_interrupted_race_keeps_what_there_is(painter, scene):
    def interrupt_at(share):
        def progress(done):
            if done >= share:
                raise KeyboardInterrupt

        return progress

    programs = [
        mlt.Program(painter(s, "sleep 0.1; "), label) for s, label in [(0.1, "a"), (0.2, "b")]
    ]
    settings = {"seconds": 1, "repeats": 3, "times": ()}
    race = mlt.equal_time(programs, scene, progress=interrupt_at(0.5), **settings)
    assert race.interrupted
    assert [len(entry.runs) for entry in race.entries] == [2, 1]
    assert "Interrupted; there are images: 2 of a, 1 of b." in race.table()
    assert race["b"].score.relmse is None
    with pytest.raises(KeyboardInterrupt):
        mlt.equal_time(programs, scene, progress=interrupt_at(0), **settings)


@pytest.mark.parametrize(
    ("algorithms", "arguments", "what"),
    [
        ([], {}, "at least one"),
        ("path", {}, "should be a list"),
        (["path", "path"], {}, "two algorithms are called 'path'"),
        (["bdtp"], {}, "bdtp"),
        (["path:max_depth"], {}, "should look like"),
        ([("path",)], {}, r"\(label, algorithm\)"),
        ([mlt.Path], {}, "is a class"),
        (["path"], {"seconds": 0}, "seconds is 0"),
        (["path"], {"seconds": "long"}, "seconds is 'long'"),
        (["path"], {"repeats": 0}, "repeats is 0"),
        (["path"], {"times": (0.5, 2)}, "times"),
        (["path"], {"insets": [(10, 0, 8, 8)]}, "does not lie in the image of 16 x 12"),
        (["path"], {"insets": [(1, 2)]}, "should be"),
        (["path"], {"reference": np.zeros((4, 4, 3))}, "reference: the images differ in size"),
        (["path"], {"reference": np.zeros((12, 16, 3))}, "reference: the image is black"),
        (["path"], {"reference": np.full((12, 16, 3), np.nan)}, "not numbers"),
        (["path"], {"reference": []}, "empty"),
        ([mlt.Program("x {output} {scene}")], {}, r"\{scene\} needs a scene that is a file"),
    ],
)
def test_mistakes_are_said_before_anything_runs(algorithms, arguments, what, scene):
    with pytest.raises((mlt.UsageError, mlt.SceneError), match=what) as error:
        mlt.equal_time(algorithms, scene, **arguments)
    assert "\n" not in str(error.value)


def test_commands_are_checked():
    with pytest.raises(mlt.UsageError, match=r"no \{output\}"):
        mlt.Program("render {scene}")
    with pytest.raises(mlt.UsageError, match=r"unknown \{sed\}.*did you mean 'seed'"):
        mlt.Program("render {output} {sed}")
    assert mlt.Program("render ${HOME} {output}").label == "render"


# ---- programs


def test_the_cpu_time_of_descendants_counts():
    busy = "import time\nwhile time.process_time() < 0.3: pass"
    begun = process_time()
    used = run_child(f"{sys.executable} -c '{busy}'; true", patience=60, watch=lambda s: None)
    assert used >= 0.3
    assert process_time() - begun < used


def test_a_program_that_does_not_end_is_ended(tmp_path):
    command = f"echo $$ > {tmp_path}/pid; sleep 60"
    with pytest.raises(mlt.RenderError, match="not ended after 1 seconds"):
        run_child(command, patience=1, watch=lambda s: None)
    with pytest.raises(ProcessLookupError):
        os.kill(int((tmp_path / "pid").read_text()), 0)


@pytest.mark.parametrize(
    ("fixed", "each", "samples"),
    [(2, 0.01, 9800), (2, 1e-6, 98_000_000), (60, 0.01, 4000), (0, 30, 3), (95, 1, 5), (99, 9, 1)],
)
def test_samples_are_found_that_fit_the_budget(fixed, each, samples):
    """Of programs that take some time for all samples together, and some for each."""
    trials = []

    def seconds(n):
        trials.append(fixed + each * n)
        return trials[-1]

    found = calibrate(seconds, 100)
    assert found.samples(100) == samples
    assert found.samples(1) == 1
    assert max(trials) < 110


def test_a_longer_run_tells_better_how_long_a_sample_takes():
    known = Calibration(10.0, 1.0, known=20)
    assert known.samples(100) == 90
    assert known.after(90, 190.0).samples(100) == 45
    assert known.after(10, 190.0) == known  # too short
    assert known.after(90, 9.0) == known  # less than nothing


# ---- what is shown


def made(sigmas: dict[str, float], name="made <here>", reference=True) -> mlt.RaceResult:
    """A race whose images are noise of known sizes."""
    entries, size = [], (48, 32)
    for number, (label, sigma) in enumerate(sigmas.items()):
        runs = []
        for seed, image in enumerate(noisy(number, sigma, 3, (32, 48))):
            half = Snapshot(1.0, (0.5 + sqrt(2) * (image - 0.5)).astype(np.float32))
            runs.append(Run(seed, [half, Snapshot(2.0, image.astype(np.float32))], 8.0))
        entries.append(Entry(label, {"type": "path", "max_depth": 4}, runs))
    entries.append(Entry("late", {"program": "late {output}"}, problem="it was late"))
    settings = Settings(name, size, 2.0, 3, 1, 0, (0.5, 1.0))
    references = [np.full((32, 48, 3), 0.5)] if reference else []
    return judged(settings, entries, references, 2, False)


@pytest.fixture(scope="module", params=[True, False], ids=["reference", "between seeds"])
def result(request):
    return made({"path": 0.1, "<b>&": 0.2}, reference=request.param)


def test_the_table_has_a_line_for_each_algorithm(result):
    lines = result.table().splitlines()
    assert lines[0] == "made <here>: 48 x 32, 2 CPU seconds, 3 seeds"
    shown = ["algorithm", "relMSE", "over best", "median seed", "trimmed", "median pixel"]
    assert re.split("  +", lines[1])[:7] == [*shown, "90 % of pixels"]
    score = result["path"].score
    path = re.split("  +", lines[2])
    assert path[5:7] == [str(score.pixel_median), str(score.percentile_90)]
    assert re.match(r"path +0\.0\d+ ± 0\.0\d+ +1 ", lines[2])
    assert lines[3].startswith("<b>& ")
    assert str(result) == result.table()
    assert "CPU seconds instead of" not in result.table()
    blind = "errors are the spread of the seeds, which sees neither light that nobody finds"
    assert (blind in result.table()) == (result.reference_error is None)


def test_levels_that_are_apart_are_remarked_upon_without_a_reference():
    def entry(label, level, error):
        score = SimpleNamespace(level=Mean(level, error))
        return SimpleNamespace(label=label, score=score)

    entries = [entry("a", 1.0, 0.01), entry("b", 1.02, 0.01), entry("dark", 0.8, 0.01)]
    assert levels_apart(entries) == [
        "dark is 20 % darker than the median of the algorithms, which its error does not show."
    ]
    assert levels_apart([*entries, entry("noisy", 1.3, 0.2)])[1:] == []
    assert levels_apart([]) == []


def test_the_page_stands_alone(result, tmp_path):
    result.save_html(tmp_path / "race.html")
    page = (tmp_path / "race.html").read_text()
    without_images = re.sub(r"data:image/[\w+]+;base64,[\w+/=]+", "DATA", page)
    for outside in ("http:", "https:", "//", "@import", "<script", "<link"):
        assert outside not in without_images
    assert re.findall(r'src="(?!DATA)', without_images) == []
    assert re.findall(r"url\((?!DATA)", without_images) == []
    assert without_images.count("src=") == 3 + 3 * 2 + 2 + 3  # images, insets, errors, charts
    assert "&lt;b&gt;&amp;" in page
    assert "<b>&" not in page
    assert "made &lt;here&gt;" in page
    assert "late has left the race: it was late" in page
    for cell in re.findall(r"\d+\.\d+(?= ± )", result.table()):
        assert cell in page
    for column in ("median pixel", "90 % of pixels"):
        assert f">{column}</th>" in page
        assert f"<dt>{column}</dt>" in page
    assert ("FLIP)" in page) == (result.entries[0].score.flip is not None)


def test_a_notebook_shows_the_page(result):
    assert result._repr_html_().startswith("<iframe srcdoc=")
    assert result._repr_html_().count('"') == 4


def test_numbers_are_strict_json(result, tmp_path):
    result.save_json(tmp_path / "race.json")

    def refuse(name):
        raise AssertionError(name)

    document = json.loads((tmp_path / "race.json").read_text(), parse_constant=refuse)
    (race,) = document["races"]
    assert race["settings"]["size"] == [48, 32]
    path, _, late = race["algorithms"]
    for metric in ("relmse", "pixel_median", "percentile_90"):
        expected = getattr(result["path"].score, metric)
        assert path["scores"][-1][metric] == {"value": expected.value, "error": expected.error}
    assert [run["seed"] for run in path["runs"]] == [0, 1, 2]
    assert late["problem"] == "it was late"
    assert race["has_reference"] == (result.reference_error is not None)


def test_error_over_time_is_measured(result):
    early, late = (score.relmse.value for score in result["path"].scores)
    assert early == pytest.approx(2 * late, rel=1e-3)


def test_the_figure_has_images_and_insets(result):
    pytest.importorskip("matplotlib")
    figure = result.figure(tonemap="filmic")
    assert len(figure.axes) == 3 * (1 + 2)
    titles = "".join(axes.get_title() for axes in figure.axes)
    assert titles.count("median pixel") == 2
    assert ("spread of the seeds" in titles) == (result.reference_error is None)
    with pytest.raises(mlt.UsageError, match="tone curve"):
        result.html(tonemap="sepia")


def test_several_scenes_are_summed_up():
    races = [made({"a": 0.1, "b": 0.2}, "first"), made({"a": 0.2, "b": 0.1}, "second")]
    race = mlt.Race(races)
    means = [entry.score.relmse.value for result in races for entry in result.ranked]
    expected = sqrt(means[1] / means[0])  # of b, which is best in the second scene
    *_, b = race.table().splitlines()
    assert b.split() == ["b", f"{means[1] / means[0]:.2g}", "1", f"{expected:.2g}"]
    page = race.html()
    assert page.count("<section>") == 3
    assert "geometric mean" in page
    assert [entry["scene"] for entry in race.to_dict()["races"]] == ["first", "second"]


def test_a_summary_names_scenes_that_the_spread_of_the_seeds_judges():
    races = [made({"a": 0.1}, "known"), made({"a": 0.1}, "blind", reference=False)]
    title = "relMSE over that of the best algorithm"
    blind = f"{title}; without a reference, by the spread of the seeds: blind"
    assert blind in mlt.Race(races).table().splitlines()
    assert f"<p>{blind}.</p>" in mlt.Race(races).html()
    assert title in mlt.Race([races[0]] * 2).table().splitlines()


def test_insets_lie_where_algorithms_differ():
    even, odd = np.full((60, 90), 0.01), np.full((60, 90), 0.01)
    odd[20:30, 40:50] = 0.5
    odd[5:8, 70:73] = 0.6
    even[50, 10] = 1e9  # a firefly
    first, second = choose_insets([even, odd], 2)
    for inset, (x, y) in ((first, (45, 25)), (second, (71, 6))):
        assert inset.x <= x < inset.x + inset.width
        assert inset.y <= y < inset.y + inset.height
    assert second.x >= first.x + first.width or second.y + second.height <= first.y
    assert len(choose_insets([even[:8, :8]], 5)) == 1  # there is no room for more


def test_equal_images_make_a_page_as_well():
    flat = np.ones((12, 16, 3), dtype=np.float32)
    entry = Entry("flat", {"type": "path"}, [Run(s, [Snapshot(1.0, flat)]) for s in range(2)])
    settings = Settings("flat", SIZE, 1.0, 2, 1, 0, (1.0,))
    result = judged(settings, [entry], [flat.astype(float)], 1, False)
    assert "flat" in result.html()
    assert result["flat"].score.relmse == Mean(0.0, 0.0)


# ---- the command line


def test_the_command_races_and_writes(painter, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    (tmp_path / "scene.xml").write_text(tiny.XML)
    outcome = run(
        [*PYMLT, "race", "scene.xml"],
        *("--algorithm", "path", "--algorithm", "bdpt:max_depth=3", "-p", "rr_depth=3"),
        *("--program", f"painter={painter(0.1)}", "--program", "bad=exit 1 {output} {scene}"),
        *("--seconds", 0.2, "--repeats", 2, "--threads", 1, "--inset", "1,2,4,4"),
        *("-o", "race.html", "-o", "race.json", "-o", "race.png"),
    )
    assert outcome.returncode == 0, outcome.stderr
    announcement, warning, *saved = outcome.stderr.splitlines()
    work = "8 images, 0.2 CPU seconds on each thread for each"
    assert announcement == f"pymlt: scene.xml: {work}"
    assert warning == "pymlt: warning: bad has left the race: it ended with code 1: no reason given"
    assert saved == ["pymlt: race.html", "pymlt: race.json", "pymlt: race.png"]
    assert {"path", "bdpt:max_depth=3", "painter"} <= set(outcome.stdout.split())
    (race,) = json.loads((tmp_path / "race.json").read_text())["races"]
    assert race["insets"] == [[1, 2, 4, 4]]
    depths = [a["settings"].get("max_depth") for a in race["algorithms"]]
    assert depths == [4, 3, None, None]
    assert race["algorithms"][0]["settings"]["rr_depth"] == 3
    assert (tmp_path / "race.html").stat().st_size > 10_000
    assert mlt.read_image(tmp_path / "race.png").shape[2] in (3, 4)


@pytest.mark.parametrize(
    ("arguments", "what"),
    [
        ([], "--algorithm or --program"),
        (["--algorithm", "bdtp"], "did you mean 'bdpt'"),
        (["--algorithm", "path:depth=3"], "depth"),
        (["--algorithm", "path", "--seconds", "-1"], "seconds is -1"),
        (["--algorithm", "path", "--program", "nothing"], "LABEL=COMMAND"),
        (["--program", "a=b"], "no {output}"),
        (["--algorithm", "path", "--reference", "a.exr", "--reference", "b.exr"], "1 scenes and 2"),
        (["--algorithm", "path", "--reference", "a.exr"], "a.exr"),
        (["--algorithm", "path", "--inset", "1,2"], "X,Y,WIDTH,HEIGHT"),
        (["--algorithm", "path", "-o", "race.doc"], "race.doc"),
        (["--algorithm", "path", "-o", "/nowhere/race.html"], "/nowhere/race.html"),
        (["--algorithm", "path", "--tonemap", "sepia"], "sepia"),
    ],
)
def test_a_mistake_on_the_command_line_is_one_line(arguments, what, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    (tmp_path / "scene.xml").write_text(tiny.XML)
    assert what in the_error(run([*PYMLT, "race", "scene.xml"], *arguments))


def test_an_interrupted_command_writes_what_there_is(painter, tmp_path, monkeypatch):
    """The program itself interrupts the race, in its second run."""
    monkeypatch.chdir(tmp_path)
    (tmp_path / "scene.xml").write_text(tiny.XML)
    kill = "test {seed} = 0 || kill -INT $PPID; sleep 0.2; "
    outcome = run(
        [*PYMLT, "race", "scene.xml", "--program", f"painter={painter(0.1, kill)}"],
        *("--seconds", 100, "-o", "race.json", "--quiet"),
    )
    assert outcome.returncode == 130
    assert outcome.stdout == ""
    assert outcome.stderr.splitlines()[-1].startswith("pymlt: interrupted")
    (race,) = json.loads((tmp_path / "race.json").read_text())["races"]
    assert race["interrupted"]
    assert len(race["algorithms"][0]["runs"]) in (1, 2)
