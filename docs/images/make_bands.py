"""The picture of docs/spectral.md: a prism in bands of wavelengths."""

from pathlib import Path

import numpy as np
from PIL import Image, ImageDraw

import pymlt as mlt
from pymlt.rendering.bands import parse_bands

SIZE, COLUMNS, BANDS, SECONDS = (300, 180), 4, "400:700:12", 7


def main() -> None:
    bands = parse_bands(BANDS)
    scene = mlt.load("prism", size=SIZE, filter="box")
    result = mlt.render_bands(
        scene, mlt.MLT(), bands=BANDS, time=SECONDS * (1 + len(bands)), seed=1, fireflies="groups"
    )
    layers = [result.layers[band.layer][..., 0] for band in bands]
    white = np.percentile(layers, 99)
    shown = []
    for band, layer in zip(bands, layers, strict=True):
        tile = Image.fromarray((np.clip(layer / white, 0, 1) ** (1 / 2.2) * 255).astype(np.uint8))
        draw = ImageDraw.Draw(tile)
        draw.rectangle((4, 4, 78, 20), fill="black")
        draw.text((8, 6), band.layer.partition(".")[2], fill="white")
        shown.append(np.asarray(tile))
    rows = [np.hstack(shown[k : k + COLUMNS]) for k in range(0, len(shown), COLUMNS)]
    file = Path(__file__).parent / "spectral-bands.jpg"
    Image.fromarray(np.vstack(rows)).save(file, quality=80)


if __name__ == "__main__":
    main()
