"""The picture of docs/animation.md: one column of the image over time, where a shot flickers."""

import tempfile
from pathlib import Path

import numpy as np

import pymlt as mlt

FRAMES, SIZE, SPP, COLUMN = 32, (96, 96), 48, 0.42


def scene() -> dict:
    """A glass ball in a box moves to the right, and its caustic with it."""
    made = mlt.scenes.glass_ball()
    made["sensor"]["film"] |= {"width": SIZE[0], "height": SIZE[1]}
    center = np.array(made["ball"].pop("center"))
    start, end = (mlt.Transform().translate(*(center + np.array([x, 0, 0]))) for x in (0, 0.35))
    made["ball"]["to_world"] = {"type": "animation", "0": start, "1": end}
    return made


def shot(together: int) -> np.ndarray:
    """All frames, (frames, height, width, 3); of both ways with as many mutations."""
    with tempfile.TemporaryDirectory() as folder:
        made = mlt.render_shot(
            scene(),
            mlt.MLT(max_depth=8),
            frames=range(FRAMES),
            output=Path(folder) / "#.exr",
            fps=FRAMES,
            together=together,
            spp=SPP,
        )
        print(together, "together: flicker", made.flicker, "error", made.error)
        return np.array([mlt.read_image(frame.files[0]) for frame in made.frames])


def strip(frames: np.ndarray) -> np.ndarray:
    """The column of all frames, side by side."""
    column = frames[:, :, round(COLUMN * SIZE[0])].swapaxes(0, 1)
    return column.repeat(4, axis=0).repeat(12, axis=1)


if __name__ == "__main__":
    pictures = [strip(shot(together)) for together in (1, 16)]
    gap = np.ones((pictures[0].shape[0], 16, 3), np.float32)
    image = np.concatenate([pictures[0], gap, pictures[1]], axis=1)
    mlt.write_image(Path(__file__).parent / "animation.jpg", image, exposure="auto")
