"""The picture of docs/course/perturbations.md: the light that each perturbation moves."""

from pathlib import Path

import numpy as np
from PIL import Image, ImageDraw

import pymlt as mlt

SIZE, SECONDS = (384, 216), 60
CLASSES = {
    "lens": ".*[LD]DS*E",
    "caustic": ".*[LD]S+DE",
    "multi_chain": ".*[LD](DS+)+DS*E|L(S+D)+S+E",
}


def main() -> None:
    scene = mlt.load("goblets", size=SIZE, filter="box")
    result = mlt.start(
        scene, "mlt", time=SECONDS, seed=1, light_layers=CLASSES, fireflies="groups"
    ).result()
    images = {"all light": result.image} | {
        f"{name}: {CLASSES[name]}": result.layers[name] for name in CLASSES
    }
    stops = mlt.pictures.tonemapping.stops_of("auto", result.image)
    tiles = []
    for title, image in images.items():
        shown = mlt.tonemap(image, "filmic", exposure=stops)
        encoded = mlt.pictures.tonemapping.encode_srgb(shown.clip(0, 1))
        tile = Image.fromarray((255 * encoded + 0.5).astype(np.uint8))
        draw = ImageDraw.Draw(tile)
        draw.rectangle((4, 4, 14 + draw.textlength(title), 20), fill="black")
        draw.text((8, 6), title, fill="white")
        tiles.append(np.asarray(tile))
    file = Path(__file__).parents[1] / "course" / "classes.jpg"
    Image.fromarray(np.vstack([np.hstack(tiles[:2]), np.hstack(tiles[2:])])).save(file, quality=85)


if __name__ == "__main__":
    main()
