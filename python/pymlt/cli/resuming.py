"""`pymlt render --resume`: what the command and the checkpoint both say, and what is to come."""

from __future__ import annotations

import argparse
import json
import re
from collections.abc import Iterator
from itertools import product

from .. import _core
from ..algorithms.integrator import as_integrator
from ..rendering.job import Job
from ..rendering.options import RenderOptions
from ..rendering.saved import saved_job
from ..scenes.kinds import is_foreign
from ..scenes.loading import built_in_defaults, number_or_text
from .common import load_scene

#: Flags whose values are in a checkpoint. They may be given again.
SAVED = {"integrator", "parameters", "seed", "size", "filter", "spectral"}
SAVED |= {"light_groups", "light_layers", "defines", "sensor", "lenient", "strict"}


def resumed(args, options: RenderOptions) -> Job:
    """The job of the checkpoint, not yet started. Raises UsageError for flags that differ."""
    saved = _core.Checkpoint(args.resume)
    job = saved_job(saved, args.resume, args.scene, options)
    for flag, given, own in repeated(args, saved, job):
        if given != own:
            raise _core.UsageError(
                f"{flag} is {given} here and {own} in the checkpoint {args.resume}; with "
                "--resume it may be left out, but not changed"
            )
    return job


def repeated(args, saved: _core.Checkpoint, job: Job) -> Iterator[tuple[str, object, object]]:
    """Each flag that is given though the checkpoint says it: its name, and both values."""
    info = job._scene.info()
    if args.seed is not None:
        yield "--seed", args.seed, saved.seed
    if args.size:
        yield "--size", *("x".join(map(str, size)) for size in (args.size, info["size"]))
    if args.filter:
        yield "--filter", args.filter, info["filter"]
    if args.spectral:
        yield "--spectral", "given", "given" if info["spectral"] else "not"
    own = json.loads(saved.integrator.settings)
    if args.light_groups:
        yield "--light-groups", "given", "given" if own.get("light_groups") else "not"
    if args.light_layers:
        given = " ".join("=".join(layer) for layer in args.light_layers)
        yield "--layer", given, own.get("light_layers") or "not"
    if args.integrator:
        yield "--integrator", args.integrator, own["type"]
    if args.parameters:
        made = as_integrator(job._scene, own["type"], args.parameters)
        given = json.loads(made.settings)
        for text, _ in args.parameters:
            name = text if text in own else re.sub("(?=[A-Z])", "_", text).lower()
            yield f"-p {text}", given.get(name), own.get(name)
    yield from repeated_of_scene(args, saved, job)


def repeated_of_scene(
    args, saved: _core.Checkpoint, job: Job
) -> Iterator[tuple[str, object, object]]:
    """What `repeated` yields of flags that say how the scene is read."""
    if saved.built_in:
        name, defines, _, sensor, _ = saved.built_in
        if args.sensor is not None:
            yield "--sensor", args.sensor, sensor or 0
        known = {} if is_foreign(name) else built_in_defaults(name, dict(args.defines))
        known |= {define: number_or_text(value) for define, value in defines.items()}
        for define, value in args.defines:
            yield f"-D {define}", number_or_text(value), known.get(define, "unknown")
    elif args.defines or args.sensor is not None or args.lenient or args.strict:
        if not args.scene:
            raise _core.UsageError(
                "-D, --sensor, --lenient and --strict need SCENE to be given with --resume"
            )
        if not reads_as_saved(args, job):
            raise _core.UsageError(
                f"{args.scene} as -D, --sensor, --lenient and --strict say is not the scene of the "
                f"checkpoint {args.resume}; with --resume they may be left out, but not changed"
            )


def reads_as_saved(args, job: Job) -> bool:
    """Whether SCENE, read as the flags say, is the scene of the checkpoint."""
    info = job._scene.info()
    sizes = [args.size] if args.size else [None, info["size"]]
    sensors = [args.sensor, None] if args.sensor == 0 else [args.sensor]
    given = {**vars(args), "spectral": info["spectral"]}
    return job._scene.hash in (
        load_scene(argparse.Namespace(**{**given, "size": size, "sensor": sensor})).hash
        for size, sensor in product(sizes, sensors)
    )


def to_come(job: Job, options: RenderOptions) -> str:
    """How much a render that goes on has behind it, and how much its budgets add."""
    spent = job.stats["seconds"]
    seconds, spp = spent["bootstrap"] + spent["render"], job.samples
    words = [f"going on after {seconds:.1f} s and {spp:.4g} spp"]
    for flag, unit, total, done in (
        ("--time", "s", options.time, seconds),
        ("--spp", "spp", options.spp, spp),
    ):
        if total is not None and total > done:
            words.append(f"{total - done:.3g} {unit} to come, {total:g} {unit} in all")
        elif total is not None:
            words.append(f"nothing to come: {flag} {total:g} counts from the very beginning")
    return "; ".join(words)
