"""Makes the meshes and textures of this folder: python make.py"""

import sys
from pathlib import Path

import numpy as np

HERE = Path(__file__).parent
sys.path.insert(0, str(HERE.parent))

from modeling import boxes, lathe, write_ply, write_png  # noqa: E402

WIDTH, HEIGHT, THICK = 0.9, 2.05, 0.045


def door():
    """A panelled door. The hinge is the y axis; it extends to -x, its front faces +z."""
    stile, half = 0.13, THICK / 2
    panels = [(0.22, 0.95), (1.08, 1.9)]  # from, to: height
    rails = [0.0, *(y for panel in panels for y in panel), HEIGHT]
    parts = [((-WIDTH, 0, -half), (-WIDTH + stile, HEIGHT, half))]
    parts += [((-stile, 0, -half), (0, HEIGHT, half))]
    for low, high in zip(rails[::2], rails[1::2], strict=True):
        parts.append(((-WIDTH + stile, low, -half), (-stile, high, half)))
    for low, high in panels:
        parts.append(((-WIDTH + stile, low, -half / 3), (-stile, high, half / 3)))
        inset = 0.07
        parts.append(
            ((-WIDTH + stile + inset, low + inset, -half * 0.8),
             (-stile - inset, high - inset, half * 0.8))
        )  # fmt: skip
    return boxes(parts)


def wood(rows=128, columns=512, seed=3):
    """Streaks along u: noise that is coarse along the grain and fine across it."""
    rng = np.random.default_rng(seed)
    grain = np.zeros((rows, columns))
    for across, along, amplitude in ((8, 2, 1.0), (24, 4, 0.7), (64, 8, 0.5), (128, 32, 0.3)):
        spectrum = np.fft.fft2(rng.standard_normal((rows, columns)))
        fy, fx = np.fft.fftfreq(rows) * rows / across, np.fft.fftfreq(columns) * columns / along
        noise = np.fft.ifft2(spectrum * np.exp(-(fy[:, None] ** 2) - fx[None, :] ** 2)).real
        grain += amplitude * noise / noise.std()
    t = 0.5 + 0.5 * np.tanh(0.45 * grain[..., None])
    return (1 - t) * np.array([0.50, 0.34, 0.21]) + t * np.array([0.74, 0.56, 0.38])


def painting(size=160):
    """Hills under an evening sky."""
    y, x = np.mgrid[0:size, 0:size] / size
    sky = (
        np.array([0.98, 0.72, 0.48]) * (1 - y)[..., None]
        + np.array([0.42, 0.55, 0.74]) * y[..., None]
    )
    image = np.where((np.hypot(x - 0.66, y - 0.52) < 0.07)[..., None], [1.0, 0.95, 0.8], sky)
    for level, bend, colour in (
        (0.45, 5.0, (0.60, 0.52, 0.62)),
        (0.33, 7.0, (0.40, 0.48, 0.50)),
        (0.2, 9.0, (0.26, 0.36, 0.28)),
    ):
        hill = level + 0.07 * np.sin(bend * x + 9 * level) + 0.03 * np.sin(2.3 * bend * x)
        image = np.where((y < hill)[..., None], colour, image)
    return image


MESHES = {
    "door": door(),
    "knob": lathe([(0.026, 0), (0.026, 0.006), (0.026, 0.006), (0.011, 0.008), (0.010, 0.03),
                   (0.024, 0.042), (0.029, 0.055), (0.022, 0.068), (0, 0.072)], 24, 3),
    # A glass carafe: the outer wall up, over the rim, and the inner wall down again.
    "carafe": lathe([(0, 0), (0.055, 0), (0.055, 0), (0.075, 0.02), (0.088, 0.07), (0.07, 0.13),
                     (0.036, 0.18), (0.032, 0.22), (0.046, 0.265), (0.0445, 0.267), (0.043, 0.265),
                     (0.028, 0.22), (0.031, 0.18), (0.065, 0.128), (0.082, 0.07), (0.07, 0.026),
                     (0.04, 0.014), (0, 0.012)], 40, 3),
    # A hammered copper pot, open at the top.
    "pot": lathe([(0, 0), (0.07, 0), (0.07, 0), (0.12, 0.03), (0.145, 0.09), (0.125, 0.15),
                  (0.10, 0.175), (0.118, 0.195), (0.113, 0.197), (0.095, 0.175), (0.12, 0.148),
                  (0.139, 0.09), (0.115, 0.034), (0, 0.008)], 48, 3),
    "cup": lathe([(0, 0), (0.035, 0), (0.035, 0), (0.055, 0.02), (0.058, 0.06), (0.062, 0.085),
                  (0.059, 0.086), (0.054, 0.06), (0.05, 0.024), (0, 0.008)], 32, 3),
    # A tall vase for the floor.
    "vase": lathe([(0, 0), (0.10, 0), (0.10, 0), (0.16, 0.12), (0.175, 0.3), (0.12, 0.48),
                   (0.07, 0.58), (0.10, 0.68), (0.095, 0.682), (0.062, 0.58), (0.11, 0.48),
                   (0.16, 0.3), (0, 0.05)], 48, 3),
}  # fmt: skip

if __name__ == "__main__":
    for name, mesh in MESHES.items():
        write_ply(HERE / f"{name}.ply", mesh)
    write_png(HERE / "wood.png", wood())
    write_png(HERE / "painting.png", painting())
