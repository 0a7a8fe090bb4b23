"""What a type checker and completion see of the package."""

import re
import subprocess
import sys
from typing import get_type_hints

import pytest
import tiny

import pymlt as mlt
from pymlt.rendering.stats import MutationStats, Stats

PROGRAM = """\
import pymlt as mlt

scene = mlt.load("ring")
result = mlt.start(scene, mlt.Path(max_depth=3), spp=1).result()
share: float = result.stats["spp_done"]
result.write("a.png", "auto")
mlt.race.equal_time(["path"], scene)
mlt.equal_time(["path"], scene)
mlt.lab.metropolis
mlt.view(scene)
mlt.traverse(scene)
"""
MISTAKES = {
    "mlt.rendr(scene)": 'has no attribute "rendr"',
    "mlt.MLT(max_dept=3)": "max_dept",
    'result.stats["spp"]': 'no key "spp"',
    'result.write("a.png", "bright")': "incompatible type",
}


@pytest.fixture(scope="module")
def complaints(tmp_path_factory):
    """Those of mypy, by line."""
    folder = tmp_path_factory.mktemp("types")
    (folder / "program.py").write_text(PROGRAM + "\n".join(MISTAKES) + "\n")
    command = [sys.executable, "-m", "mypy", "--cache-dir", str(folder / "cache"), "program.py"]
    done = subprocess.run(command, cwd=folder, capture_output=True, text=True)
    found: dict[int, str] = {}
    for line, text in re.findall(r"^program\.py:(\d+): error: (.*)$", done.stdout, re.M):
        found[int(line)] = found.get(int(line), "") + text
    return found


def test_a_sound_program_has_no_complaints(complaints):
    sound = len(PROGRAM.splitlines())
    assert {line: text for line, text in complaints.items() if line <= sound} == {}


@pytest.mark.parametrize("mistake", MISTAKES)
def test_a_mistake_is_seen_by_mypy(complaints, mistake):
    line = len(PROGRAM.splitlines()) + 1 + list(MISTAKES).index(mistake)
    assert MISTAKES[mistake] in complaints[line]


def test_completion_knows_what_is_imported_later():
    assert {"lab", "race", "view", "render"} <= set(dir(mlt))


def test_the_type_of_stats_has_every_key():
    filtered = mlt.start(tiny.scene(), "mlt", seed=1, spp=16, fireflies="groups").result()
    # of `merge`, of test_denoise.py, and of test_shot_denoised.py
    rest = {"renders", "denoised_error", "denoised_flicker"}
    assert filtered.stats.keys() == get_type_hints(Stats).keys() - rest
    assert filtered.stats["mutations"]
    assert filtered.stats["mutations"][0].keys() == get_type_hints(MutationStats).keys()
    renders = [mlt.start(tiny.scene(), "path", seed=seed, spp=4).result() for seed in (1, 2)]
    assert mlt.merge(renders).stats.keys() == {"seed", "spp_done", "size", "renders"}
