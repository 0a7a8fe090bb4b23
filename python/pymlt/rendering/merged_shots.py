"""Several renders of one shot as one: frame by frame."""

from __future__ import annotations

import glob
import os
import re
import warnings
from collections.abc import Iterable

from .. import _core
from .frames import PLACE, Frames, check_pattern, file_of, parse_frames, told
from .merging import merge


def merge_shots(
    shots: Iterable[str | os.PathLike[str]],
    output: str | os.PathLike[str],
    *,
    frames: Frames | None = None,
    force: bool = False,
) -> list[int]:
    """Merge each frame of several renders of one shot, as `merge` does, and return their numbers.

    shots
        the files of each shot, as in "a.####.exr".
    output
        those of the merged frames, as in "both.####.exr".
    frames
        which ones, as for `render_shot`. None: all that every shot has; warns of the others.
    force
        as for `merge`.

    Raises UsageError for names without a place for the number, and for frames that a shot does not
    have; and what `merge` raises.
    """
    patterns, pattern = [check_pattern(shot) for shot in shots], check_pattern(output)
    numbers, missing = frames_of_all(patterns, None if frames is None else parse_frames(frames))
    for warning in missing:
        warnings.warn(warning, stacklevel=2)
    for number in numbers:
        merge([file_of(p, number) for p in patterns], force=force).write(file_of(pattern, number))
    return numbers


def frames_of_all(patterns: list[str], asked: list[int] | None) -> tuple[list[int], list[str]]:
    """The frames that are asked for, or those of which each shot has a file; and which others are
    left out. Raises UsageError."""
    there = {pattern: frames_there(pattern) for pattern in patterns}
    wanted = sorted(set().union(*there.values())) if asked is None else asked
    missing = {p: [n for n in wanted if n not in there[p]] for p in patterns}
    problems = [f"{p} has no frame {told(numbers)}" for p, numbers in missing.items() if numbers]
    if asked and problems:
        raise _core.UsageError("; ".join(problems))
    common = [number for number in wanted if all(number in there[p] for p in patterns)]
    if not common:
        raise _core.UsageError(f"{' and '.join(patterns)} have no frame in common")
    return common, [f"{problem}; the others are merged" for problem in problems]


def frames_there(pattern: str) -> set[int]:
    """The numbers of the files of a shot that exist."""
    before, after = PLACE.split(pattern)
    names = glob.glob(f"{glob.escape(before)}*{glob.escape(after)}")
    shape = re.compile(rf"{re.escape(before)}(\d+){re.escape(after)}")
    numbers = {int(match[1]) for match in map(shape.fullmatch, names) if match}
    return {number for number in numbers if file_of(pattern, number) in names}
