"""Makes the pictures of docs/rendered-here.md by what stands there, and writes what they took:

    python docs/images/make_rendered_here.py [NAME ...]

A name is that of a picture without here- and .jpg. All of them take 140 seconds of CPU time.
"""

import json
import os
import re
import resource
import shlex
import subprocess
import sys
import tempfile
from pathlib import Path

HERE = Path(__file__).parent
PAGE = HERE.parent / "rendered-here.md"
ROOT = HERE.parents[1]
PICTURE = r"\(images/here-([\w-]+)\.jpg\)"
MEASURED = re.compile(r"<!-- measured -->\n.*?<!-- end -->", re.DOTALL)
STATISTICS = "\nimport json\nopen('stats.json', 'w').write(json.dumps(result.stats))\n"


def programs(section: str) -> list[list[str]]:
    """What a section runs, as arguments of Python; the last one writes stats.json."""
    blocks = re.findall(r"```python\n(.*?)```", section, re.DOTALL)
    lines = re.findall(r"^    pymlt (.*)$", section, re.MULTILINE)
    commands = [["-m", "pymlt", *shlex.split(line), "--stats", "stats.json"] for line in lines]
    return [["-c", block + STATISTICS] for block in blocks] + commands


def measured(seconds: float, stats: dict) -> str:
    """What is said below a command, from its CPU time and its statistics."""
    words = f"*{seconds:.0f} s of CPU time on one thread of a machine with {os.cpu_count()} cores"
    if (error := stats["error"]) is not None:
        shown = f"{100 * error:{'.0f' if error >= 0.1 else '.2g'}}"
        words += f"; {stats['spp_done']:.0f} samples per pixel, error {shown} %"
    if (missing := stats.get("tours_waiting") or 0) >= 0.005:
        words += f", {100 * missing:.0f} % of the light yet to come"
    return f"<!-- measured -->\n{words}.*\n<!-- end -->"


def run(section: str, name: str) -> str:
    """The section after its programs have run, with the picture beside this file."""
    with tempfile.TemporaryDirectory() as folder:
        (Path(folder) / "tests").symlink_to(ROOT / "tests")
        before = resource.getrusage(resource.RUSAGE_CHILDREN)
        for program in programs(section):
            subprocess.run([sys.executable, *program], cwd=folder, check=True)
        after = resource.getrusage(resource.RUSAGE_CHILDREN)
        stats = json.loads((Path(folder) / "stats.json").read_text())
        picture = f"here-{name}.jpg"
        (HERE / picture).write_bytes((Path(folder) / picture).read_bytes())
    seconds = after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime
    return MEASURED.sub(lambda _: measured(seconds, stats), section)


def main(names: list[str]) -> None:
    sections = re.split(r"(?=^## )", PAGE.read_text(), flags=re.MULTILINE)
    for i, section in enumerate(sections):
        found = re.search(PICTURE, section)
        if found and (not names or found[1] in names):
            sections[i] = run(section, found[1])
            PAGE.write_text("".join(sections))


if __name__ == "__main__":
    main(sys.argv[1:])
