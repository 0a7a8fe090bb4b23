"""`pymlt render --frames`: the frames of a shot."""

from __future__ import annotations

import argparse
import json

from .. import _core
from .._extras import import_extra
from ..algorithms.integrator import as_integrator
from ..rendering.film import is_film, write_film
from ..rendering.frames import (
    check_pattern,
    file_of,
    parse_frames,
    stands_still,
    timing,
)
from ..rendering.shot import Frame, Shot, frames_to_render, render_frames
from ..rendering.summary import percent
from .common import load_scene, reader, say, warn
from .display import exposure
from .running import check_outputs, options_of, save, wait
from .signals import Signals

#: The flags of time, and what they are by default.
TIMES = {"fps": 24.0, "shutter": 0.5}


def add_shot(command) -> None:
    command.add_argument(
        "--frames",
        type=reader(parse_frames),
        metavar="FIRST:LAST",
        help="render these frames of a shot, such as 1:24 or 1:24,31, to files such as "
        "shot.####.exr or shot.%%04d.exr, with a film of them as shot.mp4; frame f is seen from "
        "f / fps seconds of the scene's animations on",
    )
    command.add_argument("--fps", type=float, metavar="N", help="frames per second (24)")
    command.add_argument(
        "--shutter",
        type=float,
        metavar="SHARE",
        help="share of a frame for which the shutter is open, 0 to 1 (0.5)",
    )
    command.add_argument(
        "--together",
        type=int,
        metavar="N",
        help="how many frames that follow each other one render has (for mlt 16, or as many as "
        "4 GB hold, else 1)",
    )
    command.add_argument(
        "--skip-existing",
        action="store_true",
        help="leave out the frames of which all files exist",
    )


def check_shot(args) -> None:
    """Raises UsageError for flags that shots do not have, or that only they have."""
    if not args.frames:
        for name in (*TIMES, "together", "skip_existing"):
            if getattr(args, name) not in (None, False):
                raise _core.UsageError(f"--{name.replace('_', '-')} needs --frames")
        return
    for name in ("bands", "checkpoint", "resume"):
        if getattr(args, name):
            raise _core.UsageError(f"--frames cannot be given with --{name}")
    sequences, films = outputs(args)
    for path in sequences:
        check_pattern(path)
    if films and not sequences:
        raise _core.UsageError(f"{films[0]} is made of the files of frames; add -o shot.####.exr")
    if films:
        import_extra("imageio_ffmpeg", "video", films[0])


def outputs(args) -> tuple[list[str], list[str]]:
    """The names of files for each frame, and those of films."""
    films = [path for path in args.output if is_film(path)]
    return [path for path in args.output if path not in films], films


def run_shot(args) -> int:
    when = timing(
        *(
            default if getattr(args, name) is None else getattr(args, name)
            for name, default in TIMES.items()
        )
    )
    sequences, films = outputs(args)
    to_come, skipped = frames_to_render(args.frames, sequences, args.skip_existing)
    check_outputs(args, [file_of(path, args.frames[0]) for path in sequences])
    options = options_of(args)
    shot, complete = Shot(skipped=skipped), True
    with Signals() as signals:
        scene = signals.abandonable(lambda: load_scene(args))
        still = stands_still(scene, when, args.frames)
        known = [still] if still else []
        tell(args, known)

        def integrator_of(seen: _core.Scene) -> _core.Integrator:
            return as_integrator(seen, args.integrator, args.parameters)

        for number, result, flicker in render_frames(
            scene,
            integrator_of,
            when,
            to_come,
            options,
            lambda job, _: wait(job, signals, args.quiet),
            args.together,
        ):
            files, saved = save(one_image(args, number), result)
            complete = complete and saved
            frame = Frame(number, files, result.stats, flicker)
            shot.frames.append(frame)
            tell(args, [w for w in frame.stats["warnings"] if w not in known])
            known += frame.stats["warnings"]
            if not args.quiet:
                say(f"frame {number}: {result._summary()}{flicker_of(frame)}: {', '.join(files)}")
        complete = complete and save_stats(args, shot)
        if not signals.caught:
            files = [file_of(sequences[0], number) for number in args.frames] if films else []
            for path in films:
                write_film(path, files, fps=when.fps, exposure=exposure(args), tonemap=args.tonemap)
        return ended(args, shot, complete, signals.caught)


def tell(args, warnings: list[str]) -> None:
    if not args.quiet:
        warn(warnings)


def one_image(args, number: int) -> argparse.Namespace:
    """The flags for the image of one frame."""
    files = [file_of(path, number) for path in outputs(args)[0]]
    return argparse.Namespace(**{**vars(args), "output": files, "stats": None})


def flicker_of(measured: Frame | Shot) -> str:
    return "" if measured.flicker is None else f", flicker {percent(measured.flicker)}"


def save_stats(args, shot: Shot) -> bool:
    """Whether they are where they were asked for."""
    if not args.stats:
        return True
    _, problem = _core.save_text(args.stats, json.dumps(shot.stats, indent=2) + "\n")
    if problem:
        say(problem)
    return not problem


def ended(args, shot: Shot, complete: bool, caught: int) -> int:
    """Says what there is, and returns the exit code."""
    if not args.quiet:
        skipped = f", {len(shot.skipped)} skipped" if shot.skipped else ""
        error = "" if shot.error is None else f", error {percent(shot.error)}"
        say(
            f"{'interrupted; ' if caught else ''}{len(shot.frames)} of {len(args.frames)} frames"
            f"{skipped}{error}{flicker_of(shot)}"
        )
    if caught:
        return 128 + caught
    return 0 if complete else 3
