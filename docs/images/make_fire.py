"""The picture of docs/media.md: a camp fire on a grid, by chains and by path tracing."""

from pathlib import Path
from typing import Any

import numpy as np

import pymlt as mlt

SIZE, SECONDS, CELLS = (240, 240), 25, 48


def flame() -> tuple[np.ndarray, np.ndarray]:
    """Densities and temperatures of tongues that become thin and cold as they rise."""
    height, y, x = np.mgrid[0:CELLS, 0:CELLS, 0:CELLS] / (CELLS - 1.0)
    x, y = 2 * x - 1, 2 * y - 1
    waver = 0.18 * height * np.sin(9 * height + 2 * x), 0.18 * height * np.cos(7 * height + 3 * y)
    radius = np.hypot(x - waver[0], y - waver[1])
    tongues = 1 + 0.35 * np.sin(3 * np.arctan2(y, x) + 6 * height)
    width = (0.65 - 0.5 * height) * tongues + 0.02
    density = np.exp(-((radius / width) ** 4)) * np.minimum(1, 12 * (1 - height))
    temperature = 2000 - 350 * height - 150 * (radius / width) ** 2
    return density.astype(np.float32), np.maximum(temperature, 0).astype(np.float32)


def camp_fire() -> dict[str, Any]:
    density, temperature = flame()
    place = mlt.Transform().translate([-0.5, 0, 0.5]).rotate([1, 0, 0], -90)
    grid = {"type": "gridvolume", "to_world": place}
    fire = {
        "type": "heterogeneous",
        "sigma_t": grid | {"data": density},
        "scale": 6.0,
        "albedo": 0.2,
        "temperature": grid | {"data": temperature},
    }
    box = mlt.Transform().translate([0, 0.5, 0]).scale(0.5)
    scene = {
        "type": "scene",
        "sensor": {
            "type": "perspective",
            "fov": 34.0,
            "to_world": mlt.Transform().look_at([0, 1.4, 3.2], [0, 0.42, 0], [0, 1, 0]),
        },
        "fire": {"type": "cube", "bsdf": {"type": "null"}, "to_world": box, "interior": fire},
        "ground": {
            "type": "rectangle",
            "to_world": mlt.Transform().translate([0, -0.1, 0]).rotate([1, 0, 0], -90).scale(8),
            "bsdf": {"type": "diffuse", "reflectance": 0.35},
        },
    }
    for i in range(9):
        turn = 2 * np.pi * (i + 0.75) / 9
        scene[f"stone{i}"] = {
            "type": "sphere",
            "center": [0.8 * np.cos(turn), 0.0, 0.8 * np.sin(turn)],
            "radius": 0.12 + 0.03 * (i % 3),
            "bsdf": {"type": "diffuse", "reflectance": 0.5},
        }
    return scene


def main() -> None:
    scene = mlt.load_dict(camp_fire(), size=SIZE)
    images = [
        np.asarray(mlt.render(scene, integrator, time=SECONDS, seed=1, threads=1))
        for integrator in (mlt.MLT(), "path")
    ]
    file = Path(__file__).parent / "media-fire.jpg"
    exposure = 0.8 / np.percentile(images[1], 98)
    mlt.write_image(file, exposure * np.hstack(images))


if __name__ == "__main__":
    main()
