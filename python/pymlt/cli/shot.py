"""`pymlt render --frames`: the frames of a shot."""

from __future__ import annotations

import argparse
import json
from zipfile import is_zipfile

from .. import _core
from .._extras import import_extra
from ..algorithms.integrator import as_integrator
from ..rendering.film import is_film, write_film
from ..rendering.frames import (
    Timing,
    check_pattern,
    file_of,
    parse_frames,
    stands_still,
    timing,
)
from ..rendering.options import RenderOptions
from ..rendering.shot import frames_to_render, render_frames
from ..rendering.shot_checkpoint import ShotCheckpoint, kept_shot, shot_record
from ..rendering.shot_result import Frame, Shot
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
        if args.resume and is_zipfile(args.resume):
            raise _core.UsageError(
                f"{args.resume} is the checkpoint of a shot; give its whole command, with --frames"
            )
        return
    if args.bands:
        raise _core.UsageError("--frames cannot be given with --bands")
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
    check_outputs(args, [file_of(path, args.frames[0]) for path in sequences])
    options, complete = options_of(args), True
    with Signals() as signals:
        scene = signals.abandonable(lambda: load_scene(args))
        still = stands_still(scene, when, args.frames)
        known = [still] if still else []
        tell(args, known)

        def integrator_of(seen: _core.Scene) -> _core.Integrator:
            return as_integrator(seen, args.integrator, args.parameters)

        kept = checkpoint_of(args, scene, integrator_of(scene), options, when)
        shot = kept.shot(args.frames)
        for number, result, flicker in render_frames(
            scene,
            integrator_of,
            when,
            kept,
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


def checkpoint_of(
    args,
    scene: _core.Scene,
    integrator: _core.Integrator,
    options: RenderOptions,
    when: Timing,
) -> ShotCheckpoint:
    """How far the shot is, which goes on if --resume says so."""
    files = outputs(args)[0]
    record = shot_record(scene, integrator, options, when, args.frames, files, args.together)
    to_come = frames_to_render(args.frames, files, args.skip_existing)
    kept = kept_shot(options, args.resume, record, to_come)
    if args.resume and not args.quiet:
        left = len(kept.to_come) - len(kept.frames)
        say(f"going on after {len(kept.frames)} frames; {left} frames to come")
    return kept


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
