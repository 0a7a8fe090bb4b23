"""The films and strips of docs/animation.md: shots of 48 frames, alone and together.

python docs/images/make_films.py FOLDER [NAME ...] keeps the frames in FOLDER and goes on with them.
"""

import sys
import tempfile
from pathlib import Path
from time import process_time

import numpy as np

import pymlt as mlt

HERE = Path(__file__).parent
SCENES = HERE.parents[1] / "scenes"
FRAMES, SIZE, SPP = 48, (320, 180), 12
#: Frames per second of the scene's animations, and the column of the strip.
SHOTS = {"orrery": (FRAMES, 0.6), "motion": (FRAMES, 0.3), "pool": (24, 0.55)}


def moving_water() -> dict:
    """The pool, whose waves move to the right: a larger sheet of water is drawn through it."""
    sys.path.insert(0, str(SCENES))
    from modeling import height_field, waves, write_ply
    from pool.make import WAVES

    file = Path(tempfile.mkdtemp()) / "water.ply"
    write_ply(file, height_field(*waves(WAVES), 3.8, 2.4, 97, 145))
    end = mlt.Transform().translate(0.7, 0, 0.3)
    return {
        "type": "ply",
        "filename": str(file),
        "to_world": {"type": "animation", "0": mlt.Transform(), "2": end},
        "bsdf": {"type": "dielectric", "int_ior": "water"},
    }


def scene(name: str) -> dict:
    made = getattr(mlt.scenes, name)()
    made["sensor"]["film"] |= {"width": SIZE[0], "height": SIZE[1], "rfilter": {"type": "box"}}
    if name == "pool":
        shapes = {key: value for key, value in made.items() if isinstance(value, dict)}
        made[next(key for key, value in shapes.items() if value["type"] == "ply")] = moving_water()
    return made


def shot(name: str, folder: Path, together: int) -> list[Path]:
    """The files of its frames; those of both ways have as many mutations."""
    fps, _ = SHOTS[name]
    begin = process_time()
    made = mlt.render_shot(
        scene(name),
        mlt.MLT(max_depth=8),
        frames=range(FRAMES),
        output=folder / f"{name}.{together}.####.exr",
        fps=fps,
        together=together,
        spp=SPP,
        threads=1,
        skip_existing=True,
    )
    seconds = process_time() - begin
    print(
        f"{name}, {together} together: error {made.error}, flicker {made.flicker}, {seconds:.0f} s"
    )
    return [folder / f"{name}.{together}.{frame:04}.exr" for frame in range(FRAMES)]


def film(name: str, alone: list[Path], together: list[Path], folder: Path) -> None:
    """Both side by side."""
    files = []
    for frame, pair in enumerate(zip(alone, together, strict=True)):
        images = [mlt.read_image(file) for file in pair]
        gap = np.ones((SIZE[1], 4, 3), np.float32)
        files.append(folder / f"{name}.both.{frame:04}.exr")
        mlt.write_image(files[-1], np.concatenate([images[0], gap, images[1]], axis=1))
    mlt.write_film(HERE / f"shot-{name}.mp4", files, fps=24, exposure="auto")


def strip(name: str, files: list[Path]) -> np.ndarray:
    """One column of all frames, side by side."""
    column = round(SHOTS[name][1] * SIZE[0])
    columns = [mlt.read_image(file)[:, column] for file in files]
    return np.stack(columns, axis=1).repeat(8, axis=1).repeat(2, axis=0)


if __name__ == "__main__":
    folder = Path(sys.argv[1])
    folder.mkdir(parents=True, exist_ok=True)
    for name in sys.argv[2:] or SHOTS:
        pair = [shot(name, folder, together) for together in (1, 16)]
        film(name, *pair, folder)
        left, right = (strip(name, files) for files in pair)
        gap = np.ones((left.shape[0], 16, 3), np.float32)
        image = np.concatenate([left, gap, right], axis=1)
        mlt.write_image(HERE / f"shot-{name}.jpg", image, exposure="auto")
