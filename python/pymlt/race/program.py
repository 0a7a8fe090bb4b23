"""Other renderers as contestants: a command line that writes an image."""

from __future__ import annotations

import re
import shlex
import tempfile
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from .. import _core
from ..images import read_image
from .calibration import Calibration, calibrate
from .child import run_child
from .run import Conditions, Run, Snapshot, finite

PLACEHOLDERS = ("scene", "output", "seed", "seconds", "spp", "threads", "width", "height")


@dataclass(frozen=True)
class Program:
    """A command line that renders, for `equal_time` to measure beside the project's integrators.

    command
        What the shell is to run. In it {output} becomes the name of the EXR file to be written;
        {scene} that of the scene's file; {seed}, {threads}, {width} and {height} numbers.
        {seconds} is the budget in CPU seconds for each thread. A program that cannot be told a time
        has {spp}: how many samples per pixel fit the budget is then found by trial, before the
        race. With neither, the program takes what time it takes.
    label
        What tables call it; by default the command's first word.

    Counted are the CPU seconds, of user and system, of the command and of all processes that it
    starts and waits for, from start to end: loading the scene, too. The command ends with 0 and
    leaves an image of the scene's size, linear; whatever else it does makes it leave the race, with
    a line that says why. For error over time it runs once for each time.

    Raises UsageError for a command without {output}, or with a placeholder that is unknown.
    """

    command: str
    label: str = ""

    def __post_init__(self) -> None:
        for name in re.findall(r"(?<!\$)\{([a-z]+)\}", self.command):
            if name not in PLACEHOLDERS:
                near = _core.suggestion(name, list(PLACEHOLDERS))
                raise _core.UsageError(f"{self.command!r} has an unknown {{{name}}}{near}")
        if "{output}" not in self.command:
            raise _core.UsageError(f"{self.command!r} has no {{output}}: where is its image?")
        if not self.label:
            object.__setattr__(self, "label", self.command.split()[0])


@dataclass
class OutsideRenderer:
    """A program in a race."""

    label: str
    command: str
    calibration: Calibration | None = None  #: if the command has {spp}

    @property
    def settings(self) -> dict[str, Any]:
        """The command."""
        return {"program": self.command}

    def prepare(self, conditions: Conditions) -> None:
        """Find out how many samples fit the budget, if that is asked for."""
        if "{scene}" in self.command and conditions.scene_file is None:
            raise _core.UsageError(f"{self.label}: {{scene}} needs a scene that is a file")
        if "{spp}" in self.command:
            self.calibration = calibrate(
                lambda spp: self._render(conditions, 0, 1.0, spp).seconds, conditions.budget
            )

    def run(self, conditions: Conditions, seed: int) -> Run:
        """One process for each time."""
        snapshots, invalid, spp = [], 0, None
        spent, total = 0.0, sum(conditions.times)
        for share in conditions.times:
            if self.calibration is not None:
                spp = self.calibration.samples(share * conditions.budget)
            before = spent
            snapshot = self._render(conditions, seed, share, spp, (before / total, share / total))
            if self.calibration is not None and spp is not None:
                self.calibration = self.calibration.after(spp, snapshot.seconds)
            image, invalid = finite(snapshot.image)
            snapshots.append(Snapshot(snapshot.seconds, image))
            spent += share
        return Run(seed, list(snapshots), spp, invalid)

    def _render(
        self,
        conditions: Conditions,
        seed: int,
        share: float,
        spp: int | None,
        stretch: tuple[float, float] = (0.0, 0.0),
    ) -> Snapshot:
        """One process; `stretch` says where it lies within the run, as (begin, length)."""
        begin, length = stretch
        budget = share * conditions.budget
        size = (conditions.scene.width, conditions.scene.height)
        with tempfile.TemporaryDirectory(prefix="pymlt-race-") as folder:
            output = Path(folder) / "image.exr"
            command = self._filled(
                scene=conditions.scene_file or "",
                output=output,
                seed=seed,
                seconds=f"{share * conditions.seconds:g}",
                spp=spp,
                threads=conditions.threads,
                width=size[0],
                height=size[1],
            )
            used = run_child(
                command,
                patience=60 + 20 * budget,
                watch=lambda used: conditions.watch(begin + length * min(1, used / budget)),
            )
            return Snapshot(used, read_pixels(output, size))

    def _filled(self, **values: Any) -> str:
        filled = self.command
        for name, value in values.items():
            filled = filled.replace(f"{{{name}}}", shlex.quote(str(value)))
        return filled


def read_pixels(path: Path, size: tuple[int, int]) -> np.ndarray:
    """The colours of an image file: float32, (height, width, 3).

    Raises RenderError if there is none, or one of another size.
    """
    if not path.exists():
        raise _core.RenderError("it has written no image to {output}")
    try:
        image = read_image(path)
    except _core.FileError as error:
        raise _core.RenderError(f"its image cannot be read: {error}") from None
    height, width, channels = image.shape
    if (width, height) != size:
        raise _core.RenderError(
            f"its image has {width} x {height} pixels, the scene {size[0]} x {size[1]}"
        )
    return image[..., :3] if channels >= 3 else np.repeat(image[..., :1], 3, axis=2)
