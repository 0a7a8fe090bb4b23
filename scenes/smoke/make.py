"""Makes the grid of this folder: python make.py"""

from pathlib import Path

import numpy as np

HERE = Path(__file__).parent
SIZE = (48, 96, 48)  # depth, height, width


def noise(seed: int) -> np.ndarray:
    """A field of mean 0 and deviation 1 whose power falls off as that of turbulence."""
    white = np.fft.rfftn(np.random.default_rng(seed).standard_normal(SIZE))
    waves = np.meshgrid(
        *(np.fft.fftfreq(n) * n for n in SIZE[:2]),
        np.fft.rfftfreq(SIZE[2]) * SIZE[2],
        indexing="ij",
    )
    length = np.sqrt(waves[0] ** 2 + (waves[1] / 2) ** 2 + waves[2] ** 2)
    field = np.fft.irfftn(white * (length + 1) ** -2.3, SIZE, axes=(0, 1, 2))
    return (field - field.mean()) / field.std()


def plume() -> np.ndarray:
    """Smoke that rises, widens and sways; from 0 to 1."""
    z, y, x = np.meshgrid(*((np.arange(n) + 0.5) / n for n in SIZE), indexing="ij")
    sway = [0.05 * np.sin(7 * y + phase) * y for phase in (0.5, 2)]
    away = np.hypot(
        x - 0.5 - sway[0] + 0.03 * noise(1) * y, z - 0.5 - sway[1] + 0.03 * noise(2) * y
    )
    radius = 0.05 + 0.27 * y**0.8
    body = np.clip(1.15 - away / radius, 0, 1) * np.exp(0.75 * noise(3))
    ends = np.clip((1 - y) / 0.35, 0, 1) * np.clip(y / 0.02, 0, 1)
    density = np.clip(body * ends / (0.25 + 2.2 * y), 0, None)
    return density / density.max()


if __name__ == "__main__":
    data = np.round(255 * plume() ** 0.9).astype(np.uint8)
    header = b"VOL\x03" + np.array([3, *SIZE[::-1], 1], np.int32).tobytes()
    box = np.array([0, 0, 0, 1, 1, 1], np.float32).tobytes()
    (HERE / "smoke.vol").write_bytes(header + box + data.tobytes())
