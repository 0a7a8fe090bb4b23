"""Numbers, commands and pictures that stand on several pages of the documentation agree."""

import re
from math import exp, log
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[2]
DOCS = ROOT / "docs"


def text(page):
    return (DOCS / page).read_text()


def prose(page):
    """A page without its line breaks, in which a number and its unit may be far apart."""
    return " ".join(text(page).split())


def rows(table):
    """The rows of a table, as lists of cells."""
    lines = re.findall(r"^\| (.*?) \|$", table, re.MULTILINE)
    return [[cell.strip(" *`") for cell in line.split("|")] for line in lines]


def number(cell):
    """What a cell says, without its standard error."""
    return float(cell.split(" ")[0].strip("*"))


def over_best():
    """For each algorithm, the names of the scenes and its relMSE over that of the best one."""
    (_, *names, _), *found = rows(text("comparison.md").split("\n## ")[0])
    return {row[0]: dict(zip(names, map(number, row[1:-1]), strict=True)) for row in found}


def geometric_means():
    _, *found = rows(text("comparison.md").split("\n## ")[0])
    return {row[0]: row[-1] for row in found}


def compared():
    """By scene, algorithm and column: the cells of the comparison's tables."""
    found = {}
    for part in text("comparison.md").split("\n## ")[1:]:
        (_, *head), *lines = rows(part)
        found[part.splitlines()[0]] = {
            line[0]: dict(zip(head, line[1:], strict=True)) for line in lines
        }
    return found


def gains():
    """By scene: what docs/benchmarks.md has after 2, 10 and 40 seconds."""
    section = text("benchmarks.md").partition("### What Metropolis gains over samples")[2]
    _, *found = rows(section.partition("\n### ")[0])
    return {row[0]: list(map(float, row[1:])) for row in found}


def test_the_first_pages_have_the_means_of_the_comparison():
    means = geometric_means()
    next_best = min(set(means) - {"mlt"}, key=lambda name: float(means[name]))
    assert f"error is {means['mlt']} times" in " ".join((ROOT / "README.md").read_text().split())
    for figure in (
        f"error is {means['mlt']} times",
        f"`bdpt` has {means['bdpt']} times",
        f"(`{next_best}`) {means[next_best]} times",
        f"`path` {means['path']} times",
    ):
        assert figure in prose("features.md"), figure


def test_the_first_pages_count_the_scenes_of_the_comparison():
    ratios = over_best()
    mlt = ratios["mlt"]
    summary = text("comparison.md").split("\n## ")[0]
    (best,) = re.findall(r"^\| mlt \|(.*)\|[^|]*\|$", summary, re.MULTILINE)
    near = sum(ratio <= 1.2 for ratio in mlt.values())
    worst = max(mlt, key=mlt.get)
    firsts = best.count("**1**")
    assert (
        f"`mlt` is the best itself on {firsts} of {len(mlt)} scenes and within a fifth "
        f"of the best on {near}; at worst it has {mlt[worst]} times, in `{worst}`"
    ) in prose("features.md")
    assert f"has {len(mlt)} scenes" in prose("questions.md")
    assert f"[{len(mlt)} scenes](comparison.md)" in prose("samples-and-chains.md")


def test_each_scene_of_the_comparison_has_a_table_and_a_picture():
    assert list(compared()) == list(over_best()["mlt"])
    for name in compared():
        assert f"](images/race-{name}.jpg)" in text("comparison.md")


@pytest.mark.parametrize("name", gains())
def test_the_benchmarks_have_what_the_comparison_measured(name):
    """Both pages round, to two digits and to four."""
    said = gains()[name][3:6]
    table = compared()[name]
    for column, ratio in zip(("trimmed", "median pixel"), said, strict=False):
        mlt, *others = (number(table[name][column]) for name in ("mlt", "path", "bdpt"))
        assert ratio == pytest.approx(mlt / min(others), rel=0.06)
    assert said[2] == pytest.approx(number(table["mlt"]["level"]), abs=0.0006)


def test_the_benchmarks_have_the_means_of_their_table():
    means = [
        exp(sum(map(log, column)) / len(column)) for column in zip(*gains().values(), strict=True)
    ]
    said = re.search(
        r"means are (\S+), (\S+) and (\S+) after 2, 10 and 40 seconds, those of the median pixel "
        r"(\S+), (\S+) and (\S+)\. ",
        prose("benchmarks.md"),
    ).groups()
    for expected, shown in zip(means[0::3] + means[1::3], map(float, said), strict=True):
        assert shown == pytest.approx(expected, rel=0.03)


def test_captions_have_the_times_of_the_script():
    script = text("images/make.py")
    seconds, width, height = re.search(r'"door_ajar", i, (\d+), \((\d+), (\d+)\)', script).groups()
    assert f"{seconds} CPU-seconds at {width} x {height}" in prose("features.md")
    (seconds,) = re.findall(r'"pool", i, (\d+), ', script)
    assert f"{seconds} CPU-seconds each, made by `docs/images/make.py manifolds`" in prose(
        "strategies.md"
    )


def test_the_first_page_has_the_command_of_its_picture():
    (command,) = re.findall(r"pymlt (render door-ajar .*) -o", text("index.md"))
    assert f"    pymlt {command} -o gallery-door-ajar.jpg" in text("gallery.md")
    assert "gallery-door-ajar.jpg" in text("index.md")
    assert "gallery-door-ajar.jpg" in (ROOT / "README.md").read_text()


def test_each_picture_of_the_gallery_is_made_by_the_command_below_it():
    shown = re.findall(r"\(images/(gallery-[\w-]+\.jpg)\)", text("gallery.md"))
    made = re.findall(r"^    pymlt render .* -o (\S+)$", text("gallery.md"), re.MULTILINE)
    assert shown == made
    assert {path.name for path in DOCS.glob("images/gallery-*.jpg")} == set(made)


def test_each_picture_is_seen_somewhere():
    pages = [*DOCS.rglob("*.md"), DOCS / "conf.py", ROOT / "README.md"]
    pages += (ROOT / "scenes").rglob("*.md")
    named = "".join(page.read_text() for page in pages)
    pictures = [path.name for path in DOCS.glob("images/*.*") if path.suffix != ".py"]
    assert [name for name in pictures if f"images/{name}" not in named] == []
