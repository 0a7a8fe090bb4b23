"""Injects bugs, one at a time, and asks whether the tests find them.

    make mutants                                       all of them, in some hours
    make mutants SHARD=2/4                             the second of four parts
    make mutants MUTANTS="phong_pdf projector_time"    these alone

The files *.toml list them: `old` stands once in `file`, and `new` takes its place. `tests` are
those that are asked first: a regular expression for ctest, which begins with a folder of tests/cpp,
or a file of pytest. docs/mutants.md says what each bug breaks.

Everything happens in a copy of the tree, build/mutants, which keeps what it has built. A bug is
found by the first test that fails: one that the list names, else one of all short C++ tests, else
one of pytest's. The exit code is 1 if one survives, 2 for a wrong input.
"""

from __future__ import annotations

import argparse
import filecmp
import itertools
import os
import re
import shutil
import subprocess
import sys
import sysconfig
import time
import tomllib
from dataclasses import dataclass
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
TREE = ROOT / "build" / "mutants"
BUILD = (
    TREE / "build" / "default"
)  # As in the tree itself: then ccache knows what `make` has built.
LOG = TREE / "build" / "mutants.log"


class MutantError(Exception):
    """A list, or a choice from it, that cannot be used."""


@dataclass(frozen=True)
class Mutant:
    name: str
    file: str
    old: str
    new: str
    tests: str

    def check(self, root: Path) -> str:
        """The text of its file, in which `old` stands once."""
        path = root / self.file
        text = path.read_text() if path.is_file() else ""
        if (count := text.count(self.old)) != 1:
            raise MutantError(
                f"mutant '{self.name}': its old text stands {count} times in {self.file}, "
                "but must stand there once"
            )
        return text

    def inject(self, root: Path) -> str:
        """Returns the text that was there before."""
        text = self.check(root)
        (root / self.file).write_text(text.replace(self.old, self.new))
        return text


def read_list() -> list[Mutant]:
    lists = sorted(Path(__file__).parent.glob("*.toml"))
    tables = (tomllib.loads(path.read_text())["mutant"] for path in lists)
    return [Mutant(**table) for table in itertools.chain(*tables)]


def choose(mutants: list[Mutant], names: list[str], shard: str) -> list[Mutant]:
    known = {mutant.name: mutant for mutant in mutants}
    if unknown := [name for name in names if name not in known]:
        raise MutantError(f"there is no mutant '{unknown[0]}' in tests/mutants")
    index, slash, count = shard.partition("/")
    digits = slash and index.isdigit() and count.isdigit()
    if not digits or not 1 <= int(index) <= int(count):
        raise MutantError(f"--shard {shard}: expected I/N with 1 <= I <= N, such as 2/4")
    return [known[name] for name in names or known][int(index) - 1 :: int(count)]


# ---- the copy of the tree


def copy_tree() -> None:
    """What git knows and has not been told to ignore; files that are the same keep their times."""
    listed = subprocess.run(
        ["git", "ls-files", "-z", "--cached", "--others", "--exclude-standard"],
        cwd=ROOT,
        capture_output=True,
        check=True,
        text=True,
    ).stdout.split("\0")
    names = {name for name in listed if name and (ROOT / name).is_file()}
    for name in sorted(names):
        to = TREE / name
        if to.is_file() and filecmp.cmp(ROOT / name, to, shallow=False):
            continue
        to.parent.mkdir(parents=True, exist_ok=True)
        shutil.copy(ROOT / name, to)
    for path in TREE.rglob("*"):
        name = path.relative_to(TREE)
        if path.is_file() and name.parts[0] != "build" and str(name) not in names:
            path.unlink()


def run(command: list, **more) -> tuple[bool, str]:
    result = subprocess.run(
        [str(word) for word in command],
        stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT,
        text=True,
        errors="replace",
        **more,
    )
    with LOG.open("a") as log:
        log.write(f"\n$ {' '.join(map(str, command))}\n{result.stdout}")
    return result.returncode == 0, result.stdout


def configure() -> None:
    BUILD.mkdir(parents=True, exist_ok=True)
    LOG.write_text("")
    pybind11 = Path(sysconfig.get_path("purelib")) / "pybind11" / "share" / "cmake" / "pybind11"
    options = ["CMAKE_BUILD_TYPE=Release", "PYMLT_TESTS=ON", "PYMLT_PYTHON=ON"]
    options += [f"pybind11_DIR={pybind11}", f"Python_EXECUTABLE={sys.executable}"]
    ok, _ = run(["cmake", "-G", "Ninja", "-S", TREE, "-B", BUILD, *(f"-D{o}" for o in options)])
    if not ok:
        raise MutantError(f"CMake fails in the copy of the tree: see {LOG}")


def build(targets: list[str]) -> None:
    ok, _ = run(["cmake", "--build", BUILD, "--target", *targets])
    if not ok:
        raise MutantError(f"the tree does not compile: see {LOG}")


# ---- the tests; each function returns the name of the first that fails, or "" if none does


def ctest(pattern: str) -> str:
    until_one_fails = ["--stop-on-failure", "--no-tests=error"]
    ok, output = run(
        ["ctest", "--test-dir", BUILD, "-R", pattern, "-LE", "^long$", *until_one_fails]
    )
    if ok:
        return ""
    listed = output.partition("The following tests FAILED:")[2]  # not those that were skipped
    failed = re.search(r"^\s+\d+ - (\S+) ", listed, re.MULTILINE)
    if not failed:
        raise MutantError(f"ctest ('{pattern}') fails, but names no test: see {LOG}")
    return failed[1]


def base_python() -> Path:
    """One without the editable package, which would be that of the tree itself."""
    return Path(sys.base_prefix, "bin", f"python{sys.version_info.major}.{sys.version_info.minor}")


def pytest(*files: str) -> str:
    build(["_core", "mlt-render"])
    for module in BUILD.glob("_core.*.so"):
        shutil.copy(module, TREE / "python" / "pymlt")
    path = os.pathsep.join([str(TREE / "python"), sysconfig.get_path("purelib")])
    ok, output = run(
        [base_python(), "-m", "pytest", "-x", *files],
        cwd=TREE,
        env={**os.environ, "PYTHONPATH": path, "MLT_RENDER": str(BUILD / "mlt-render")},
    )
    if ok:
        return ""
    failed = re.search(r"^(?:FAILED|ERROR) (\S+)", output, re.MULTILINE)
    if not failed:
        raise MutantError(f"pytest fails without a test: see {LOG}")
    return failed[1]


def first_tests(tests: str) -> str:
    if tests.endswith(".py"):
        return pytest(tests)
    build(["test_" + re.match(r"\w+", tests)[0]])
    return ctest("^" + tests)


def all_tests() -> str:
    build(["all"])
    return ctest(".") or pytest()


# ---- the hunt


def check_clean(mutants: list[Mutant]) -> None:
    for tests in sorted({mutant.tests for mutant in mutants}):
        if failed := first_tests(tests):
            raise MutantError(f"{failed} fails without any mutant: see {LOG}")


def hunt(mutant: Mutant, thorough: bool) -> str:
    before = mutant.inject(TREE)
    try:
        return first_tests(mutant.tests) or (thorough and all_tests()) or ""
    finally:
        (TREE / mutant.file).write_text(before)


def report(mutants: list[Mutant], thorough: bool) -> list[str]:
    """Prints a line for each, and returns the names of those that survive."""
    survivors = []
    for mutant in mutants:
        begin = time.monotonic()
        found_by = hunt(mutant, thorough)
        seconds = time.monotonic() - begin
        print(f"{mutant.name:24} {seconds:6.0f} s  {found_by or 'SURVIVES'}", flush=True)
        if not found_by:
            survivors.append(mutant.name)
    return survivors


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("names", nargs="*", help="mutants; all of the list if none is given")
    parser.add_argument("--shard", default="1/1", metavar="I/N", help="the I-th of N parts")
    parser.add_argument("--quick", action="store_true", help="only the tests that the list names")
    options = parser.parse_args()
    try:
        mutants = choose(read_list(), options.names, options.shard)
        for mutant in mutants:
            mutant.check(ROOT)
        copy_tree()
        configure()
        check_clean(mutants)
        survivors = report(mutants, not options.quick)
    except MutantError as error:
        print(f"mutants: {error}", file=sys.stderr)
        return 2
    print(f"{len(mutants) - len(survivors)} of {len(mutants)} mutants were found")
    return 1 if survivors else 0


if __name__ == "__main__":
    sys.exit(main())
