"""The rows of spheres of docs/openpbr.md: python docs/examples/openpbr_spheres.py [NAME ...]

Each row is rendered to docs/images/openpbr-NAME.jpg; the table below its picture is printed. All of
them take some twenty minutes of two processors.
"""

from __future__ import annotations

import sys
from pathlib import Path
from typing import Any

import numpy as np
from PIL import Image

import pymlt as mlt
from pymlt.formats.imported import Imported
from pymlt.formats.materialx.preview import preview

IMAGES = Path(__file__).parents[1] / "images"
WIDTH, QUALITY, STOPS = 960, 88, -0.5
SAMPLES, SAMPLES_INSIDE = 64, 256  #: where light walks at random inside, noise is stronger
GOLD, RED, BLUE = [1.0, 0.72, 0.32], [0.55, 0.03, 0.02], [0.08, 0.1, 0.3]
TEA, SKIN, LEAF = [0.9, 0.55, 0.25], [0.9, 0.65, 0.5], [0.35, 0.6, 0.1]

Spheres = dict[str, list[Any]]  #: parameters with one value for each sphere
METAL = {"base_color": GOLD, "base_metalness": 1.0}
PAINT = {"base_color": RED, "specular_roughness": 0.5}
CLOTH = {"base_color": BLUE, "specular_roughness": 0.7, "fuzz_color": [0.9, 0.85, 1.0]}
GLASS = {"transmission_weight": 1.0, "transmission_color": TEA}
#: By the names of pictures: what all spheres of a row have, and in what they differ.
ROWS: dict[str, tuple[dict[str, Any], Spheres]] = {
    "metalness": (
        {"base_color": GOLD, "specular_roughness": 0.25},
        {"base_metalness": [0, 0.2, 0.4, 0.6, 0.8, 1]},
    ),
    "roughness": (METAL, {"specular_roughness": [0, 0.2, 0.4, 0.6, 0.8, 1]}),
    "anisotropy": (
        METAL | {"specular_roughness": 0.4},
        {"specular_roughness_anisotropy": [0, 0.2, 0.4, 0.6, 0.8, 0.95]},
    ),
    "coat": (
        PAINT,
        {"coat_weight": [0, 0.5, 1, 1, 1, 1], "coat_roughness": [0, 0, 0, 0.15, 0.3, 0.6]},
    ),
    "fuzz": (
        CLOTH,
        {"fuzz_weight": [0, 0.5, 1, 1, 1, 1], "fuzz_roughness": [0.5, 0.5, 0.5, 0.25, 0.75, 1]},
    ),
    "film": (
        {"base_color": 0.01, "specular_roughness": 0.1, "specular_ior": 2.0},
        {
            "thin_film_weight": [0, 1, 1, 1, 1, 1],
            "thin_film_thickness": [0.2, 0.2, 0.3, 0.4, 0.5, 0.8],
        },
    ),
    "transmission": (
        GLASS,
        {
            "specular_roughness": [0, 0.2, 0.4, 0.1, 0.1, 0.1],
            "transmission_depth": [4, 4, 4, 2, 0.8, 0.3],
        },
    ),
    "subsurface": (
        {"subsurface_weight": 1.0, "subsurface_color": SKIN, "specular_roughness": 0.35},
        {"subsurface_radius": [0.03, 0.1, 0.2, 0.4, 0.8, 1.6]},
    ),
    "leaf": (
        {
            "geometry_thin_walled": True,
            "subsurface_weight": 1.0,
            "subsurface_color": LEAF,
            "specular_roughness": 0.5,
        },
        {"subsurface_scatter_anisotropy": [-1, -0.6, -0.2, 0.2, 0.6, 1]},
    ),
}


def spheres(name: str) -> dict[str, dict[str, Any]]:
    """The materials of a row, from left to right."""
    common, varied = ROWS[name]
    columns = zip(*varied.values(), strict=True)
    found = {}
    for number, values in enumerate(columns):
        given = {"type": "openpbr"} | common | dict(zip(varied, values, strict=True))
        found[f"sphere-{number}"] = {"bsdf": {key: colour(one) for key, one in given.items()}}
    return found


def colour(value: Any) -> Any:
    """A list of three numbers as a colour; other values as they are."""
    return {"type": "rgb", "value": value} if isinstance(value, list) else value


def table(name: str) -> str:
    """What differs between the spheres of a row, as a table of Markdown."""
    lines = [[f"`{key}`", *(f"{one:g}" for one in values)] for key, values in ROWS[name][1].items()]
    lines.insert(1, ["---"] * len(lines[0]))
    return "\n".join(f"| {' | '.join(cells)} |" for cells in lines)


def scene(name: str) -> mlt.Scene:
    """A row of spheres on a floor."""
    made = Imported()
    preview(spheres(name), made)
    film = made.scene["camera"]["film"]
    size = (WIDTH, round(WIDTH * film["height"] / film["width"]))
    return mlt.load_dict(made.scene, size=size, filter="box")


def render(name: str) -> None:
    """Writes the picture of a row."""
    samples = SAMPLES_INSIDE if name == "subsurface" else SAMPLES
    image = mlt.render(scene(name), "path", spp=samples, seed=1, denoise=True)
    shown = mlt.pictures.tonemapping.encode_srgb(mlt.tonemap(image, "filmic", exposure=STOPS))
    file = IMAGES / f"openpbr-{name}.jpg"
    Image.fromarray((255 * shown + 0.5).astype(np.uint8)).save(file, quality=QUALITY)


def main(names: list[str]) -> None:
    for name in names or ROWS:
        render(name)
        print(f"{table(name)}\n", flush=True)


if __name__ == "__main__":
    main(sys.argv[1:])
