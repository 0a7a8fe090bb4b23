"""`pymlt render`: a scene to image files."""

from __future__ import annotations

from .. import _core
from ..algorithms.integrator import as_integrator
from ..pictures.output import EXTENSIONS
from ..rendering.bands import add_bands, check_spectral, parse_bands, share_of_time
from ..rendering.job import Job
from ..rendering.needed import needed
from ..rendering.result import Result
from .common import FLAGS, add_flag, load_scene, reader, say, warn
from .display import EXPOSURE_HELP, add_bits, add_tonemap
from .resuming import SAVED, resumed, to_come
from .running import check_outputs, given, options_of, save, wait
from .shot import add_shot, check_shot, run_shot
from .signals import Signals

HELP = "Render a scene to image files."


# Where pymlt can do more than mlt-render.
HELP_HERE = {
    "scene": "Mitsuba XML, glTF 2.0, pbrt or USD file, MaterialX, a mesh (.ply, .obj, .stl), or "
    "the name of a built-in scene",
    "output": f"image file: {', '.join(EXTENSIONS)}; may be repeated",
    "exposure": EXPOSURE_HELP,
}


def add_arguments(command) -> None:
    for name, flag in FLAGS.items():
        add_flag(command, flag, HELP_HERE.get(name, ""))
    add_tonemap(command)
    add_bits(command)
    command.add_argument(
        "--bands",
        type=reader(parse_bands),
        metavar="[FROM:TO:]N",
        help="N layers for an .exr, such as spectrum.400-430nm: the mean radiance per nm of a "
        "spectral scene in N equal bands of wavelengths, by default from 360 to 830 nm; each is a "
        "render of its own, of --spp samples or with an equal share of --time",
    )
    command.add_argument(
        "--fireflies",
        choices=("keep", "groups"),
        default="keep",
        metavar="HOW",
        help="groups: leave out what one of the 16 independent groups alone has found in a pixel; "
        "an .exr keeps the image as its layer unfiltered (default keep)",
    )
    command.add_argument(
        "--denoise",
        action="store_true",
        help="remove noise by Open Image Denoise, as far as that lowers the error, which --error "
        "then means; the filter is box, unless --filter names one; an .exr keeps the image as its "
        "layer noisy",
    )
    add_shot(command)


def check(args) -> None:
    try:
        values = given(args)
        _core.check_flags(flags_to_check(args, values))
        files = {name: values[name] for name in values if FLAGS[name].is_file}
        _core.check_files({n: v if isinstance(v, list) else [v] for n, v in files.items()})
        if args.bands and (args.checkpoint or args.resume):
            raise _core.UsageError("--bands cannot be given with --checkpoint or --resume")
        check_shot(args)
    except _core.UsageError as error:
        raise _core.UsageError(f"{error}; see pymlt render --help") from None


def flags_to_check(args, values: dict) -> set[str]:
    """The flags that are given, without those that a checkpoint of one render repeats."""
    if not args.resume:
        return set(values)
    if args.frames:  # all that was said of a shot is said again
        return {*values, "checkpoint"} - {"resume"}
    return set(values) - SAVED


def start(args, signals: Signals) -> Job:
    options = options_of(args)
    if args.resume:
        job = signals.abandonable(lambda: resumed(args, options))._start()
        if not args.quiet:
            say(to_come(job, options))
        return job
    scene = signals.abandonable(lambda: load_scene(args))
    if args.bands:
        check_spectral(scene, "--spectral")
        options.time = share_of_time(options.time, args.bands)
    return Job(scene, as_integrator(scene, args.integrator, args.parameters), options)._start()


def run(args) -> int:
    check(args)
    if args.frames:
        return run_shot(args)
    check_outputs(args, args.output)
    with Signals() as signals:
        job = start(args, signals)
        known = job.stats["warnings"]
        if not args.quiet:
            warn(known + doubts(args, job))
        try:
            wait(job, signals, args.quiet)
        except _core.RenderError as error:
            if hasattr(error, "result"):
                save(args, error.result)
            raise
        code = 128 + signals.caught if signals.caught else 0
        if code and job.stats["spp_done"] == 0:
            say("interrupted before the first sample; nothing to save")
            return code
        result = job.result()
        if args.bands and not code:
            render_bands(args, result, job, signals)
            code = 128 + signals.caught if signals.caught else 0
        if not args.quiet:
            warn(result.stats["warnings"][len(known) :])
            hint = needed(result)
            if hint and not args.bands:  # which share the time with the image
                say(hint)
        images, complete = save(args, result)
    if not args.quiet:
        where = ", ".join(images) or "no image could be saved"
        say(f"{'interrupted; ' if code else ''}{result._summary()}: {where}")
        if "fireflies" in result.metadata:
            say(f"fireflies by {result.metadata['fireflies']}")
    return code if complete else 3


def doubts(args, job: Job) -> list[str]:
    """What is to be said of the flags, once the scene is known."""
    found = [_core.alpha_problem(path) for path in args.output if job.has_alpha]
    if args.denoise and job.filter != "box":
        found.append(
            f"the filter {job.filter!r} spreads noise over several pixels, and --denoise leaves "
            "such noise; use --filter box"
        )
    return list(filter(None, found))


def render_bands(args, result: Result, job: Job, signals: Signals) -> None:
    """Adds the layers of the bands. What there is so far is saved if one of them fails."""
    try:
        add_bands(result, job, args.bands, lambda part: wait(part, signals, args.quiet))
    except _core.RenderError:
        save(args, result)
        raise
