"""A scene's unit of length does not matter: scaled by a power of two, its image has the same bits.

Powers of two scale floating-point numbers exactly, so any difference comes from a threshold in
units of length that hides in the code.
"""

import xml.etree.ElementTree as ET
from pathlib import Path

import numpy as np
import pytest

import pymlt as mlt

SCENES = Path(__file__).parents[2] / "scenes"
LENGTHS = {"aperture", "focus_distance"}  # those of the cameras here
INTEGRATORS = {
    "path": mlt.Path(max_depth=6),
    "ptracer": mlt.PTracer(max_depth=6),
    "bdpt": mlt.BDPT(max_depth=6),
    "pssmlt": mlt.PSSMLT(max_depth=6, luminance_samples=2000, chains=32),
    "mlt": mlt.MLT(max_depth=6, luminance_samples=2000, chains=32, adaptive=False),
    "mlt, adaptive and in two stages": mlt.MLT(
        max_depth=6, luminance_samples=2000, chains=32, two_stage=True
    ),
}


def scaled(path, factor: float) -> str:
    """The XML of a scene whose lengths are `factor` times as large."""
    root = ET.parse(path).getroot()
    for shape in root.iter("shape"):
        transform = shape.find("transform")
        if transform is None:
            transform = ET.SubElement(shape, "transform", name="to_world")
        ET.SubElement(transform, "scale", value=repr(factor))
    for lookat in root.iter("lookat"):
        for name in ("origin", "target"):
            numbers = [float(x) * factor for x in lookat.get(name).replace(",", " ").split()]
            lookat.set(name, ", ".join(map(repr, numbers)))
    for number in root.iter():
        if number.get("name") in LENGTHS:
            number.set("value", repr(float(number.get("value")) * factor))
    return ET.tostring(root, encoding="unicode")


def image(scene: str, factor: float, integrator, folder) -> np.ndarray:
    file = folder / "scene.xml"
    file.write_text(scaled(SCENES / scene / "scene.xml", factor))
    loaded = mlt.load_file(file, size=(24, 18))
    return mlt.render(loaded, integrator, spp=8, seed=2)


@pytest.mark.parametrize("scene", ["cornell-box", "glass-ball", "dof"])
@pytest.mark.parametrize("integrator", INTEGRATORS.values(), ids=INTEGRATORS.keys())
def test_the_unit_of_length_does_not_matter(scene, integrator, tmp_path):
    usual = image(scene, 1.0, integrator, tmp_path)
    assert usual.max() > 0
    for factor in (2.0**-20, 2.0**20):
        np.testing.assert_array_equal(image(scene, factor, integrator, tmp_path), usual)
