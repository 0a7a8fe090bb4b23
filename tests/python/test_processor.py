"""A wheel holds two builds of the core, of which the processor has one chosen."""

import os
import shutil
import subprocess
import sys
import venv
from pathlib import Path

import pytest

from pymlt import _core, _processor

REPOSITORY = Path(__file__).parents[2]


@pytest.fixture
def package(tmp_path, monkeypatch):
    """A folder in the place of the package, with a build for wide vectors."""
    (tmp_path / "wide").mkdir()
    (tmp_path / "wide" / "_core.so").touch()
    monkeypatch.setattr(_processor, "__file__", str(tmp_path / "_processor.py"))
    monkeypatch.delenv("PYMLT_BUILD", raising=False)
    return tmp_path


def set_flags(monkeypatch, flags):
    monkeypatch.setattr(_processor, "processor_flags", lambda: flags)


def test_wide_build_is_for_processors_of_level_3(package, monkeypatch):
    set_flags(monkeypatch, _processor.LEVEL_3 | {"sse2"})
    assert _processor.wide_core() == package / "wide" / "_core.so"
    set_flags(monkeypatch, _processor.LEVEL_3 - {"fma"})
    assert _processor.wide_core() is None
    set_flags(monkeypatch, set())
    assert _processor.wide_core() is None


def test_baseline_can_be_asked_for(package, monkeypatch):
    set_flags(monkeypatch, _processor.LEVEL_3)
    monkeypatch.setenv("PYMLT_BUILD", "baseline")
    assert _processor.wide_core() is None


def test_chosen_build_is_the_extension_of_the_package(tmp_path):
    package = tmp_path / "pymlt"
    shutil.copytree(
        Path(_processor.__file__).parent, package, ignore=shutil.ignore_patterns("_core.*.so")
    )
    (package / "wide").mkdir()
    shutil.copy(_core.__file__, package / "wide")
    (package / "_processor_flags.txt").write_text("flags : " + " ".join(_processor.LEVEL_3))
    text = (package / "_processor.py").read_text()
    chosen = text.replace("/proc/cpuinfo", str(package / "_processor_flags.txt"))
    assert chosen != text
    (package / "_processor.py").write_text(chosen)
    done = subprocess.run(
        [
            # Without the site: an editable installation would find its own.
            *(sys.executable, "-S", "-c"),
            f"import sys; sys.path.insert(0, {str(tmp_path)!r})\n"
            "import pymlt; from pymlt import _core\n"
            "assert pymlt._core is _core; print(_core.__file__)",
        ],
        capture_output=True,
        text=True,
    )
    assert done.returncode == 0, done.stderr
    assert Path(done.stdout.strip()).parent == package / "wide"


def test_there_may_be_no_wide_build(package, monkeypatch):
    set_flags(monkeypatch, _processor.LEVEL_3)
    (package / "wide" / "_core.so").unlink()
    assert _processor.wide_core() is None


def test_flags_are_those_of_the_first_processor(tmp_path):
    cpuinfo = tmp_path / "cpuinfo"
    cpuinfo.write_text("processor : 0\nflags\t\t: fpu avx2\n\nprocessor : 1\nflags\t\t: fpu\n")
    assert "avx2" in _processor.processor_flags(cpuinfo)
    assert _processor.processor_flags(tmp_path / "none") == set()


@pytest.mark.long
@pytest.mark.timeout(3600)
def test_wheel_uses_the_build_for_this_processor(tmp_path):
    pip = [sys.executable, "-m", "pip", "-q"]
    # Where `make wheel` builds, so that nothing is compiled twice.
    build = f"build-dir={REPOSITORY}/build/wheel-cp3{sys.version_info.minor}"
    flags = ["--no-deps", "--no-build-isolation", f"--config-settings={build}"]
    subprocess.run([*pip, "wheel", *flags, "-w", tmp_path, REPOSITORY], check=True)
    (wheel,) = tmp_path.glob("pymlt-*.whl")
    venv.create(tmp_path / "venv", with_pip=True, system_site_packages=False)
    bin_folder = tmp_path / "venv" / "bin"
    # The dependencies are those of this interpreter.
    (site,) = (tmp_path / "venv" / "lib").glob("python*/site-packages")
    import numpy as np

    (site / "here.pth").write_text(str(Path(np.__file__).parents[1]) + "\n")
    subprocess.run(
        [bin_folder / "python", "-m", "pip", "install", "-q", "--no-deps", wheel], check=True
    )

    def run(program, *arguments, **environment):
        return subprocess.run(
            [bin_folder / program, *arguments],
            env=os.environ | environment,
            cwd=tmp_path,
            capture_output=True,
            text=True,
        )

    show = "import pymlt, pathlib; print(pathlib.Path(pymlt._core.__file__).parent.name)"
    wide = _processor.processor_flags() >= _processor.LEVEL_3
    assert run("python", "-c", show).stdout.strip() == ("wide" if wide else "pymlt")
    assert run("python", "-c", show, PYMLT_BUILD="baseline").stdout.strip() == "pymlt"

    # Checkpoints name the build, since its pixels are its own.
    flags = ["--size", "8x8", "--spp", "2", "--quiet", "-o", "image.exr"]
    rendered = run("mlt-render", "cornell-box", *flags, "--checkpoint", "half.pymlt")
    assert rendered.returncode == 0, rendered.stderr
    assert run("mlt-render", "--resume", "half.pymlt", "-o", "image.exr").returncode == 0
    other = run("mlt-render", "--resume", "half.pymlt", "-o", "x.exr", PYMLT_BUILD="baseline")
    assert other.returncode == (2 if wide else 0), other.stderr
    assert ("build" in other.stderr) == wide
