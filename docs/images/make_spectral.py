"""The picture of docs/spectral.md: a diamond by path, bdpt and mlt in the same time."""

from pathlib import Path

import numpy as np
from PIL import Image, ImageDraw

import pymlt as mlt

SIZE, SECONDS = (400, 300), 20


def main() -> None:
    scene = mlt.load("diamond", size=SIZE, filter="box")
    rows = []
    for name in ("path", "bdpt", "mlt"):
        image = mlt.render(scene, {"type": name, "max_depth": 12}, time=SECONDS, seed=1)
        shown = Image.fromarray((np.clip(image, 0, 1) ** (1 / 2.2) * 255).astype(np.uint8))
        ImageDraw.Draw(shown).text((8, 6), f"{name}, {SECONDS} s", fill="white")
        rows.append(np.asarray(shown))
    file = Path(__file__).parent / "spectral-equal-time.jpg"
    Image.fromarray(np.concatenate(rows, axis=1)).save(file, quality=85)


if __name__ == "__main__":
    main()
