"""The frames of a shot: their numbers, their times, and the names of their files."""

from __future__ import annotations

import math
import os
import re
from collections import Counter
from collections.abc import Iterable
from typing import NamedTuple

from .. import _core
from .options import integer, number

Frames = int | str | Iterable[int]

PLACE = re.compile(r"#+|%(?:0\d+)?d")
LAST = 10**9


def parse_frames(frames: Frames) -> list[int]:
    """The numbers of 7, "1:24", "1:24,31", or of a range, each once. Raises UsageError."""
    if isinstance(frames, str):
        found = [n for part in frames.split(",") for n in _parse_part(part, frames)]
    else:
        given = frames if isinstance(frames, Iterable) else [frames]
        found = [integer("a frame", n, LAST) for n in given]
    if not found:
        raise _core.UsageError(f"frames is {frames!r}, which has none; give some, as in '1:24'")
    twice = [n for n, count in Counter(found).items() if count > 1]
    if twice:
        raise _core.UsageError(f"frames is {frames!r}, which has frame {twice[0]} twice")
    return found


def _parse_part(part: str, frames: str) -> range:
    match = re.fullmatch(r"\s*(\d{1,9})(?::(\d{1,9}))?\s*", part)
    if not match:
        raise _core.UsageError(
            f"frames is {frames!r}, but should be the first and the last one, as in 1:24, or "
            "several of these, as in 1:24,31:40"
        )
    first = int(match[1])
    last = int(match[2] or first)
    if last < first:
        raise _core.UsageError(
            f"frames is {frames!r}, but frame {last} comes before {first}; write {last}:{first}"
        )
    return range(first, last + 1)


def told(frames: list[int]) -> str:
    """1:24,31 for the numbers that it means."""
    stretches: list[list[int]] = []
    for frame in frames:
        if stretches and frame == stretches[-1][1] + 1:
            stretches[-1][1] = frame
        else:
            stretches.append([frame, frame])
    return ",".join(f"{a}" if a == b else f"{a}:{b}" for a, b in stretches)


def check_pattern(pattern: str | os.PathLike[str]) -> str:
    """The name of the files of frames, with one place for the number. Raises UsageError."""
    text = os.fspath(pattern)
    places = len(PLACE.findall(text))
    if places != 1:
        stem, extension = os.path.splitext(PLACE.sub("", text))
        right = f"{stem.rstrip('._-') or 'shot'}.####{extension}"
        raise _core.UsageError(
            f"{text} has {places or 'no'} places for the number of a frame; write {right}"
        )
    return text


def file_of(pattern: str, frame: int) -> str:
    """shot.0007.exr for shot.####.exr or shot.%04d.exr."""

    def digits(place: re.Match) -> str:
        return place[0] % frame if place[0][0] == "%" else f"{frame:0{len(place[0])}}"

    return PLACE.sub(digits, pattern)


class Timing(NamedTuple):
    """Frame f is seen while the shutter is open, from f / fps to (f + shutter) / fps."""

    fps: float
    shutter: float

    def times(self, frame: int) -> tuple[float, float]:
        return frame / self.fps, (frame + self.shutter) / self.fps

    def shutter_of(self, window: list[int]) -> dict[str, float]:
        """The parameters of a sensor that sees these frames, which follow each other."""
        opens, closes = self.times(window[0])
        if len(window) == 1:
            return {"shutter_open": opens, "shutter_close": closes}
        return {
            "shutter_open": opens,
            "shutter_close": (window[-1] + 1) / self.fps,
            "exposures": len(window),
            "exposure_share": self.shutter,
        }


def timing(fps: float, shutter: float) -> Timing:
    """Raises UsageError for what is no number of frames per second, or no share of a frame."""
    found = Timing(number("fps", fps) or 0.0, number("shutter", shutter) or 0.0)
    if not (math.isfinite(found.fps) and found.fps > 0):
        raise _core.UsageError(f"fps is {fps!r}, but should be a number above 0, such as 24")
    if not 0 <= found.shutter <= 1:
        raise _core.UsageError(
            f"shutter is {shutter!r}, but should be the share of a frame for which it is open, "
            "from 0 to 1"
        )
    return found


def scene_at(scene: _core.Scene, timing: Timing, window: list[int]) -> _core.Scene:
    """The scene as its sensors see it in these frames, which follow each other."""
    shutter = timing.shutter_of(window)
    values = {}
    for name in scene.parameters():
        own = name.rpartition(".")[2]
        if own in shutter:
            values[name] = shutter[own]
    return scene.updated(values)


def runs(scene: _core.Scene, timing: Timing, frames: list[int]) -> list[list[list[int]]]:
    """The frames in runs without a cut, each a list of moments: of the frames that show the same.

    Within a run each moment follows at once on the one before it, so that only the first and the
    last one may have several frames.
    """
    found: list[list[list[int]]] = []
    animations = scene.animations()
    for frame in frames:
        if not found or found[-1][-1][-1] != frame - 1:
            found.append([[frame]])
        elif is_still(animations, timing, frame - 1, frame):
            found[-1][-1].append(frame)
        elif len(found[-1]) > 1 and len(found[-1][-1]) > 1:
            found.append([[frame]])
        else:
            found[-1].append([frame])
    return found


def is_still(animations: list[tuple[float, float]], timing: Timing, first: int, last: int) -> bool:
    """Whether nothing moves or changes from the first of these frames to the last."""
    begin, end = timing.times(first)[0], timing.times(last)[1]
    return not any(start < end and stop > begin for start, stop in animations)


def stands_still(scene: _core.Scene, timing: Timing, frames: list[int]) -> str | None:
    """The warning for a shot in which nothing moves or changes."""
    animations = scene.animations()
    if not animations:
        return "nothing in the scene has an animation: all frames show the same"
    if not is_still(animations, timing, min(frames), max(frames)):
        return None
    first, last = timing.times(min(frames))[0], timing.times(max(frames))[1]
    start, end = min(start for start, _ in animations), max(end for _, end in animations)
    return (
        f"nothing moves from {first:g} to {last:g} s, the time of these frames: the scene's "
        f"animations go from {start:g} to {end:g} s"
    )
