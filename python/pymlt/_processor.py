"""Chooses between the two builds of the extension that a wheel holds.

`_core` runs on every processor of the architecture, `wide/_core` on those of level 3 (x86-64-v3:
AVX2, FMA, BMI2), where it is faster. The environment variable PYMLT_BUILD=baseline asks for the
first one, for instance where machines of a cluster differ: pixels have the same bits within one of
the builds only.
"""

import importlib.machinery
import importlib.util
import os
import sys
from pathlib import Path

# As /proc/cpuinfo calls what level 3 has beyond level 2; abm is LZCNT.
# System V ABI, AMD64 supplement, sec. 3.1.1.
LEVEL_3 = {"avx", "avx2", "bmi1", "bmi2", "f16c", "fma", "abm", "movbe", "xsave"}


def processor_flags(cpuinfo: Path = Path("/proc/cpuinfo")) -> set[str]:
    """The names of what the processor can do; none where the system does not tell."""
    try:
        lines = cpuinfo.read_text().splitlines()
    except OSError:
        return set()
    return set(next((line for line in lines if line.startswith("flags")), "").split())


def wide_core() -> Path | None:
    """The file of the build for wide vectors, if there is one and it is to be used."""
    files = sorted(Path(__file__).parent.glob("wide/_core.*"))
    if not files or os.environ.get("PYMLT_BUILD") == "baseline":
        return None
    return files[0] if processor_flags() >= LEVEL_3 else None


def load_core() -> None:
    """Makes `pymlt._core` the build for this processor."""
    file = wide_core()
    if file is None or "pymlt._core" in sys.modules:
        return
    loader = importlib.machinery.ExtensionFileLoader("pymlt._core", str(file))
    spec = importlib.util.spec_from_file_location("pymlt._core", file, loader=loader)
    assert spec is not None
    module = importlib.util.module_from_spec(spec)
    sys.modules["pymlt._core"] = module
    loader.exec_module(module)
    # The import system does this for a submodule that it has found by itself.
    setattr(sys.modules["pymlt"], "_core", module)  # noqa: B010


load_core()
