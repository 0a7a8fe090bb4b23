"""Seeds of the fuzz targets in Python, and what they have failed on, without a fuzzer."""

import importlib
from pathlib import Path

import pytest

FOLDER = Path(__file__).resolve().parents[1] / "fuzz"
for package, extra in (("pygltflib", "gltf"), ("MaterialX", "materialx")):
    pytest.importorskip(package, reason=f"needs pymlt[{extra}]")


def files(name: str) -> list[Path]:
    return sorted(FOLDER.glob(f"corpus/{name}/*")) + sorted(FOLDER.glob(f"regressions/{name}/*"))


@pytest.mark.parametrize("name", ["gltf", "materialx", "pbrt"])
def test_targets_survive_their_files(name, monkeypatch):
    monkeypatch.syspath_prepend(FOLDER)
    read = importlib.import_module(f"fuzz_{name}").read
    assert files(name)
    for file in files(name):
        read(file.read_bytes())
