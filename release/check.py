"""Tries the wheels in dist/ where nothing but Python is installed: `make release-check` calls it.

Where debootstrap can make one, that is a root of a Debian or Ubuntu without anything else, kept in
build/roots; else a virtual environment in which no library of the system may be loaded. A built-in
scene is rendered by `pymlt` and by `mlt-render`, and must have the bits of this tree's own render.
"""

import os
import re
import resource
import shutil
import subprocess
import sys
import time
import tomllib
import zipfile
from pathlib import Path

import numpy as np
from make_wheels import BUILD, DIST, ROOT, run, tools

import pymlt as mlt

ROOTS = ROOT / "build" / "roots"
DEBIAN, UBUNTU = "http://deb.debian.org/debian", "http://archive.ubuntu.com/ubuntu"
UBUNTU_KEYS = "/usr/share/keyrings/ubuntu-archive-keyring.gpg"
SUITES = {"bookworm": DEBIAN, "trixie": DEBIAN, "noble": UBUNTU}
RENDER = ["glass-ball", "--integrator", "mlt", "--size", "64x64", "--spp", "8", "--quiet"]
INSTALL_SECONDS, FIRST_IMAGE_SECONDS = 30, 5  # of CPU time, which other programs do not change


# ---- files --------------------------------------------------------------------------------------
def version() -> str:
    """The one version that all files name."""
    named = tomllib.loads((ROOT / "pyproject.toml").read_text())["project"]["version"]
    citation = (ROOT / "CITATION.cff").read_text()
    section, day = re.search(
        r"^## \[(\d\S*)\] - (\S+)", (ROOT / "CHANGELOG.md").read_text(), re.MULTILINE
    ).groups()
    assert f"\nversion: {named}\n" in citation, "CITATION.cff has another version"
    assert section == named, f"the newest section of CHANGELOG.md is {section}"
    assert f"\ndate-released: {day}\n" in citation, "CITATION.cff has another date"
    return named


def check_files(wheel: Path) -> None:
    """Names, licences, and no path of this machine."""
    assert wheel.name.startswith(f"pymlt-{version()}-cp3"), wheel
    assert "-manylinux_" in wheel.name, wheel
    with zipfile.ZipFile(wheel) as file:
        names = file.namelist()
        libraries = [name for name in names if re.match(r"pymlt\.libs/.*\.so", name)]
        licences = [name for name in names if "/licenses/bundled/" in name]
        assert len(licences) > len(libraries) / 2 > 0, licences
        for part in ["_core", "wide/_core", "scene_files/ring/scene.xml", "py.typed"]:
            assert any(name.startswith(f"pymlt/{part}") for name in names), part
        for name in names:
            assert bytes(ROOT) not in file.read(name), f"{name} names {ROOT}"


def check_source(archive: Path) -> None:
    names = run("tar", "tzf", archive).splitlines()
    assert not [name for name in names if re.search(r"/(build|\.venv|\.ci|dist)/|\.so$", name)]
    assert any(name.endswith("/cpp/app/main.cpp") for name in names)


# ---- roots --------------------------------------------------------------------------------------
def remove_root(folder: Path) -> None:
    """A root that was not finished may have the system's own /proc and /sys mounted in it."""
    mounted = [line.split()[1] for line in Path("/proc/mounts").read_text().splitlines()]
    for place in reversed(mounted):
        if Path(place).is_relative_to(folder):
            run("umount", place)
    run("rm", "-rf", "--one-file-system", "--", folder)


def make_root(suite: str) -> Path | None:
    """A fresh system with Python, or None where it cannot be made."""
    folder, log = ROOTS / suite, ROOTS / f"{suite}.log"
    if (folder / "made").exists():
        return folder
    if os.geteuid() or not shutil.which("debootstrap"):
        return None
    if folder.exists():
        remove_root(folder)
    ROOTS.mkdir(parents=True, exist_ok=True)
    ubuntu = SUITES[suite] == UBUNTU
    # Debian's debootstrap need not know Ubuntu's newest names, nor where its keys are. Without them
    # it makes no root.
    script = ["/usr/share/debootstrap/scripts/gutsy"] if ubuntu else []
    flags = ["--components=main,universe", f"--keyring={UBUNTU_KEYS}"] if ubuntu else []
    command = ["debootstrap", "--variant=minbase", "--include=python3,python3-venv"]
    with log.open("w") as output:
        done = subprocess.run(
            [*command, *flags, suite, folder, SUITES[suite], *script],
            stdout=output,
            stderr=subprocess.STDOUT,
        )
    if done.returncode:
        print(f"no root of {suite}: {log.read_text().splitlines()[-1:]}")
        return None
    (folder / "made").touch()
    return folder


def cpu_seconds(*command: object) -> float:
    """The CPU time of a program, which must not fail."""
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    began = time.monotonic()
    run(*command)
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    cpu = after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime
    print(f"  {cpu:.1f} s of CPU time, {time.monotonic() - began:.1f} s")
    return cpu


def python_of(tag: str) -> Path:
    """The interpreter for which a wheel was made."""
    if tag == f"cp3{sys.version_info.minor}":
        return Path(sys.executable)
    return BUILD / tag / "venv/bin/python"


def download_dependencies(wheel: Path, tag: str) -> Path:
    """The wheels that `wheel` needs, for its own Python, so that a root needs no network."""
    folder = ROOTS / "wheels" / tag
    folder.mkdir(parents=True, exist_ok=True)
    run(python_of(tag), "-m", "pip", "download", "-q", "-d", folder, wheel)
    for old in folder.glob("pymlt-*.whl"):
        old.unlink()
    return Path(shutil.copy(wheel, folder)).parent


def try_wheel(python: list, folder: Path, inside: str, wheels: str, name: str) -> None:
    """Installs into `folder`, which the program calls `inside`, and renders there."""
    enter, program = python[:-1], python[-1]
    pip = [*enter, f"{inside}/bin/python", "-m", "pip"]
    install = cpu_seconds(*enter, program, "-m", "venv", inside)
    install += cpu_seconds(*(*pip, "install", "-q", "--no-index", "--find-links", wheels, "pymlt"))
    run(*enter, f"{inside}/bin/python", "-m", "compileall", "-q", f"{inside}/lib")
    first = cpu_seconds(*enter, f"{inside}/bin/pymlt", "render", *RENDER, "-o", f"{inside}/a.png")
    for program in ("pymlt render", "mlt-render"):
        command = f"{inside}/bin/{program}".split()
        run(*enter, *command, *RENDER, "-o", f"{inside}/a.exr")
        same = np.array_equal(mlt.read_image(folder / "a.exr"), mlt.read_image(ROOTS / "tree.exr"))
        assert same, f"{name}: {program} renders other pixels than this tree"
    print(f"{name}: install {install:.1f} s, first image {first:.1f} s of CPU time", flush=True)
    assert install < INSTALL_SECONDS
    assert first < FIRST_IMAGE_SECONDS


def try_in_root(suite: str, root: Path, wheels: dict[str, Path]) -> bool:
    # /proc is mounted in a namespace of its own, and so gone afterwards. The loader needs it.
    script = 'mount -t proc proc "$0/proc" && exec chroot "$0" /usr/bin/env -i LANG=C.UTF-8 "$@"'
    enter = ["unshare", "--mount", "sh", "-c", script, root, "PATH=/usr/bin:/bin"]
    show = "import sys; print(f'cp3{sys.version_info.minor}')"
    tag = run(*enter, "python3", "-c", show).strip()
    if tag not in wheels:
        print(f"{suite} has {tag}, for which there is no wheel")
        return False
    for place, source in (("wheels", download_dependencies(wheels[tag], tag)), ("env", None)):
        shutil.rmtree(root / place, ignore_errors=True)
        if source:
            shutil.copytree(source, root / place)
    try_wheel([*enter, "python3"], root / "env", "/env", "/wheels", f"{suite}, {tag}")
    return True


def try_in_venv(tag: str, wheel: Path) -> None:
    folder = ROOTS / f"venv-{tag}"
    shutil.rmtree(folder, ignore_errors=True)
    wheels = download_dependencies(wheel, tag)
    python = python_of(tag)
    try_wheel([python], folder, str(folder), str(wheels), f"virtual environment, {tag}")
    maps = run(folder / "bin/python", "-c", "import pymlt; print(open('/proc/self/maps').read())")
    loaded = {line.split()[-1] for line in maps.splitlines() if ".so" in line}
    foreign = [path for path in loaded if "pymlt" in path and not path.startswith(str(folder))]
    ours = ("embree", "tbb", "OpenEXR", "Imath", "jpeg", "png", "pugixml", "fmt")
    foreign += [
        p for p in loaded if p.startswith(("/lib", "/usr/lib")) and any(o in p for o in ours)
    ]
    assert not foreign, f"libraries from outside the wheel: {foreign}"


def main() -> None:
    files = sorted(DIST.glob("*.whl"))
    assert files, "make wheel first"
    (source,) = DIST.glob("*.tar.gz")
    run("sh", "-c", 'cd "$0" && sha256sum --strict -c SHA256SUMS', DIST)
    twine = tools(sys.executable, BUILD / "tools", "release")
    run(twine / "twine", "check", "--strict", *files, source)
    check_source(source)
    wheels = {re.search(r"-(cp\d+)-", file.name)[1]: file for file in files}
    for wheel in files:
        check_files(wheel)
    ROOTS.mkdir(parents=True, exist_ok=True)
    run(Path(sys.executable).parent / "mlt-render", *RENDER, "-o", ROOTS / "tree.exr")
    tried = set()
    for suite in SUITES:
        root = make_root(suite)
        if root and try_in_root(suite, root, wheels):
            tried.add(suite)
    for tag, wheel in wheels.items():
        try_in_venv(tag, wheel)
    print(f"tried in roots of: {', '.join(sorted(tried)) or 'nothing'}")


if __name__ == "__main__":
    main()
