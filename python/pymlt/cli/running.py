"""What `pymlt render` does for an image and for each frame of a shot."""

from __future__ import annotations

import json
from dataclasses import fields

from .. import _core
from .._extras import import_extra
from ..pictures.output import check_writable
from ..rendering.job import Job
from ..rendering.options import RenderOptions
from ..rendering.progress import progress_bar
from ..rendering.result import Result
from .common import FLAGS, say
from .display import exposure
from .signals import Signals


def given(args) -> dict:
    values = {name: getattr(args, name) for name in FLAGS}
    return {name: v for name, v in values.items() if not (v is None or v is False or v == [])}


def options_of(args) -> RenderOptions:
    """What the flags ask for. To be called before the scene is loaded: it may choose the filter."""
    values = given(args)
    options = RenderOptions(
        **{f.name: values[f.name] for f in fields(RenderOptions) if f.name in values}
    )
    options.fireflies, options.denoise = args.fireflies, args.denoise
    if args.denoise and args.filter is None and (args.frames or not args.resume):
        args.filter = "box"
    return options


def check_outputs(args, paths: list[str]) -> None:
    """Before the work begins: whether what it makes can be written."""
    for path in paths:
        check_writable(path, args.bits)
    if args.stats:
        _core.check_file_writable(args.stats)
    import numpy  # noqa: F401 (what writing needs)

    if args.denoise:
        import_extra("pyoidn", "denoise", "--denoise")


def wait(job: Job, signals: Signals, quiet: bool) -> None:
    with progress_bar(False if quiet else None) as show:
        while True:
            if signals.caught:  # also before it began, as between the frames of a shot
                job.cancel()
            if job.wait(0.1):
                return
            show(job.progress, job._figures)


def save(args, result: Result) -> tuple[list[str], bool]:
    """Every output is tried, and elsewhere if it fails. Returns where the images are, and whether
    everything is where it was asked for."""
    files = [result._save(path, exposure(args), args.tonemap, args.bits) for path in args.output]
    images = [path for path, _ in files if path]
    if args.stats:
        files.append(_core.save_text(args.stats, json.dumps(result.stats, indent=2) + "\n"))
    problems = [problem for _, problem in files if problem]
    for problem in problems:
        say(problem)
    return images, not problems
