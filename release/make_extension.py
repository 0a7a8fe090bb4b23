"""Makes dist/pymlt-blender-VERSION.zip: the extension for Blender with these wheels.

    python release/make_extension.py dist/pymlt-0.3.0-*.whl

`make blender` calls it. The manifest gets the version of pymlt and the names of the wheels.
"""

import sys
import tomllib
import zipfile
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]
SOURCE = ROOT / "blender"
MANIFEST = "blender_manifest.toml"


def version() -> str:
    return tomllib.loads((ROOT / "pyproject.toml").read_text())["project"]["version"]


def manifest(wheels: list[Path]) -> str:
    """The manifest with what it does not say itself."""
    names = ", ".join(f'"./wheels/{wheel.name}"' for wheel in wheels)
    made = f'{(SOURCE / MANIFEST).read_text()}version = "{version()}"\n'
    return made + f"wheels = [{names}]\n" * bool(wheels)


def make(wheels: list[Path], folder: Path = ROOT / "dist") -> Path:
    """Writes the zip into a folder; returns where it is."""
    folder.mkdir(parents=True, exist_ok=True)
    path = folder / f"pymlt-blender-{version()}.zip"
    with zipfile.ZipFile(path, "w", zipfile.ZIP_DEFLATED) as file:
        file.writestr(MANIFEST, manifest(wheels))
        file.write(ROOT / "LICENSE", "LICENSE")
        for source in sorted(SOURCE.rglob("*.py")):
            file.write(source, source.relative_to(SOURCE))
        for wheel in wheels:
            file.write(wheel, f"wheels/{wheel.name}", zipfile.ZIP_STORED)
    return path


if __name__ == "__main__":
    print(make([Path(name) for name in sys.argv[1:]]))
