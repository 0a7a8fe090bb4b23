"""A coarse guard of speed: instructions per sample, which do not depend on the machine's load.

Two renders of different length are counted by `valgrind --tool=callgrind`; their difference leaves
out loading and preparing. The numbers are those of the default build with GCC. Whoever makes a
render faster lowers them; a change that is worth more instructions raises them and says so.
"""

import json
import re
import shutil
import subprocess

import pytest
from command_line import mlt_render

SIZE = 32
# For each case: its arguments, samples per pixel of the two renders, and instructions per sample.
CASES = {
    "path": ([], (2, 10), 6400),
    "bdpt": ([], (1, 3), 27811),
    "pssmlt": (["chains=512", "independent_share=0", "luminance_samples=1000"], (4, 12), 10316),
    "mlt": (
        ["chains=128", "independent_share=0", "luminance_samples=1000", "adaptive=false"],
        (4, 12),
        9066,  # Of these, 2950 are of the samples that start tours, one for 16 mutations.
    ),
}


def count(integrator: str, parameters: list[str], spp: int, folder) -> tuple[int, float]:
    """Instructions of a render, and how many samples it took."""
    stats = folder / f"{spp}.json"
    counted = subprocess.run(
        ["valgrind", "--tool=callgrind", "--callgrind-out-file=/dev/null", *mlt_render()]
        + ["cornell-box", "--integrator", integrator, "-p", "max_depth=8"]
        + [argument for parameter in parameters for argument in ("-p", parameter)]
        + ["--size", f"{SIZE}x{SIZE}", "--spp", str(spp), "--seed", "1", "--threads", "1"]
        + ["-o", folder / "image.exr", "--stats", stats, "--quiet"],
        capture_output=True,
        text=True,
        check=True,
        timeout=1800,
    )
    instructions = int(re.search(r"Collected : (\d+)", counted.stderr)[1])
    return instructions, json.loads(stats.read_text())["spp_done"] * SIZE**2


@pytest.mark.long
@pytest.mark.skipif(not shutil.which("valgrind"), reason="valgrind is not installed")
@pytest.mark.skipif(not mlt_render(), reason="mlt-render is not installed beside this Python")
@pytest.mark.parametrize("integrator", CASES)
def test_a_sample_takes_no_more_instructions_than_it_did(integrator, tmp_path):
    parameters, lengths, stored = CASES[integrator]
    (short, few), (long, many) = (count(integrator, parameters, n, tmp_path) for n in lengths)
    per_sample = (long - short) / (many - few)
    assert per_sample < 1.1 * stored, f"{per_sample:.0f} instructions per sample, not {stored}"
