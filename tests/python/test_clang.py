"""The library and the bindings compile without a warning by clang, which builds the fuzz targets.

The default build is another compiler's; what it compiles together is read again, without making
code.
"""

import json
import shlex
import shutil
import subprocess
from itertools import pairwise
from pathlib import Path

import pytest

CLANG = shutil.which("clang++")
COMMANDS = Path(__file__).resolve().parents[2] / "build/default/compile_commands.json"


def compiled() -> dict[str, dict]:
    """How the default build compiles each file of the library, the programs and the bindings."""
    if not COMMANDS.exists():
        return {}
    outputs = {}
    for entry in json.loads(COMMANDS.read_text()):
        arguments = shlex.split(entry["command"])
        output = arguments[arguments.index("-o") + 1]
        target, _, name = output.removeprefix("CMakeFiles/").partition(".dir/")
        if target in ("mlt", "mlt-render", "_core"):
            outputs[f"{target}/{Path(name).stem}"] = entry
    return outputs


COMPILED = compiled()


@pytest.mark.skipif(not CLANG, reason="clang is not installed")
@pytest.mark.skipif(not COMPILED, reason="there is no build in build/default")
@pytest.mark.parametrize("name", COMPILED)
def test_clang_warns_of_nothing(name):
    entry = COMPILED[name]
    arguments = shlex.split(entry["command"])
    kept = ("-D", "-I", "-W", "-std", "-march", "-f")
    flags = [flag for flag in arguments if flag.startswith(kept)]
    for before, folder in pairwise(arguments):
        if before == "-isystem":
            flags += [before, folder]
    checked = subprocess.run(
        [CLANG, "-fsyntax-only", "-Werror", *flags, entry["file"]],
        cwd=entry["directory"],
        capture_output=True,
        text=True,
        timeout=600,
    )
    assert checked.returncode == 0, checked.stderr[:5000]
