"""The command line: pymlt render | merge | compare | info | list | lab.

Exit codes: 0 done; 1 `compare --fail-above` found more; 2 a mistake in usage or in the scene, or an
output that cannot be written; 3 the render failed; 130 and 143 interrupted by SIGINT or SIGTERM,
with what was rendered saved. Every error is one line on stderr.
"""

from __future__ import annotations

import argparse
import json
import math
import os
import signal
import sys
import threading
import traceback

from . import _core, lab, scenes
from .jobs import Job, Result, as_integrator, begin, prepare_resume, start
from .loading import load_built_in, load_file
from .merging import merge
from .metrics import compare
from .progress import progress_bar
from .schemas import available

SCENE_HELP = "Mitsuba XML file, or the name of a built-in scene"
METRICS = ("mse", "rmse", "relmse", "relmse_trimmed", "mape", "bias_z", "flip")


def main(arguments: list[str] | None = None) -> int:
    try:
        args = _parser().parse_args(arguments)
        code = args.command(args)
        sys.stdout.flush()
        return code
    except (_core.SceneError, _core.UsageError, _core.FileError) as error:
        return _fail(2, error)
    except (_core.Error, MemoryError) as error:
        return _fail(3, error)
    except BrokenPipeError:  # the reader of our output (`| head`) has seen enough
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
        return 0
    except KeyboardInterrupt:
        return 128 + signal.SIGINT
    except Exception:  # a bug: say where
        traceback.print_exc()
        return 3


def _say(message) -> None:
    print("pymlt:", " ".join(str(message).split("\n")), file=sys.stderr, flush=True)


def _fail(code: int, error: BaseException) -> int:
    _say(str(error) or type(error).__name__)
    return code


# ---- what can be asked --------------------------------------------------------------------------


class _Parser(argparse.ArgumentParser):
    def error(self, message):
        raise _core.UsageError(f"{message}; see {self.prog} --help")


def _parser() -> argparse.ArgumentParser:
    parser = _Parser(
        prog="pymlt",
        description="An open renderer for Metropolis light transport.",
        allow_abbrev=False,
    )
    parser.add_argument("--version", action="version", version=f"pymlt {_core.__version__}")
    commands = parser.add_subparsers(
        required=True, metavar="{render,merge,compare,info,list,lab}", parser_class=_Parser
    )
    _add_render(commands)
    _add_merge(commands)
    _add_compare(commands)
    _add_info(commands)
    _add_list(commands)
    lab.add_command(commands, _add_command)
    return parser


def _add_command(commands, name: str, run, help: str):
    command = commands.add_parser(name, help=help, description=help, allow_abbrev=False)
    command.set_defaults(command=run)
    return command


def _add_render(commands) -> None:
    c = _add_command(commands, "render", _render, "Render a scene to image files.")
    c.add_argument("scene", metavar="SCENE", nargs="?", help=SCENE_HELP)
    c.add_argument(
        "-o",
        "--output",
        metavar="FILE",
        action="append",
        required=True,
        help="image file: .exr, .png or .hdr; may be repeated",
    )
    c.add_argument("--integrator", metavar="NAME", help="algorithm, in place of the scene's own")
    c.add_argument(
        "-p",
        dest="parameters",
        metavar="NAME=VALUE",
        action="append",
        default=[],
        type=_assignment,
        help="integrator parameter; may be repeated",
    )
    _add_defines(c)
    c.add_argument(
        "--size", metavar="WxH", type=_size, help="image size in pixels, such as 640x360"
    )
    c.add_argument("--spp", metavar="N", type=float, help="samples (or mutations) per pixel")
    c.add_argument("--time", metavar="SECONDS", type=float, help="seconds to render")
    c.add_argument("--error", metavar="E", type=float, help="relative error to reach, such as 0.02")
    c.add_argument("--seed", metavar="N", type=int, help="seed of all random numbers (0)")
    c.add_argument("--threads", metavar="N", type=int, default=0, help="0: as many as there are")
    c.add_argument("--checkpoint", metavar="FILE", help="keep the state of the render in this file")
    c.add_argument("--every", metavar="SECONDS", type=float, help="between checkpoints (60)")
    c.add_argument(
        "--resume",
        metavar="FILE",
        help="go on from a checkpoint, in place of SCENE; it is renewed, unless --checkpoint names "
        "another file",
    )
    c.add_argument(
        "--cluster",
        metavar="ADDRESS",
        help="render on a dask cluster, such as tcp://host:8786, or on local:N processes",
    )
    c.add_argument(
        "--stats", metavar="FILE", help="write what the render tells about itself (JSON)"
    )
    c.add_argument(
        "--exposure",
        metavar="STOPS",
        type=float,
        default=0,
        help="brighten PNG files by so many stops",
    )
    c.add_argument("--quiet", action="store_true", help="say nothing but errors")


def _add_merge(commands) -> None:
    c = _add_command(commands, "merge", _merge, "Merge renders of one scene with different seeds.")
    c.add_argument("renders", metavar="FILE", nargs="+", help=".exr files that pymlt has written")
    c.add_argument("-o", "--output", metavar="FILE", required=True, help=".exr, .png or .hdr")
    c.add_argument(
        "--force", action="store_true", help="whether or not they have the same scene and settings"
    )


def _add_compare(commands) -> None:
    c = _add_command(commands, "compare", _compare, "Print how far an image is from a reference.")
    c.add_argument("image", metavar="A")
    c.add_argument("reference", metavar="B")
    c.add_argument("--json", action="store_true", help="print JSON")
    c.add_argument(
        "--fail-above",
        metavar="METRIC=VALUE",
        action="append",
        default=[],
        type=_limit,
        help="exit with 1 if the metric (for bias_z: its size) is above; may be repeated",
    )


def _add_info(commands) -> None:
    c = _add_command(commands, "info", _info, "Print what a scene holds.")
    c.add_argument("scene", metavar="SCENE", help=SCENE_HELP)
    _add_defines(c)
    c.add_argument("--json", action="store_true", help="print JSON")
    c.set_defaults(size=None)


def _add_list(commands) -> None:
    c = _add_command(commands, "list", _list, "List plug-ins, or the built-in scenes.")
    c.add_argument("family", nargs="?", help="bsdf, emitter, integrator, ..., or scenes")


def _add_defines(command) -> None:
    command.add_argument(
        "-D",
        dest="defines",
        metavar="NAME=VALUE",
        action="append",
        default=[],
        type=_assignment,
        help="value for a <default> parameter of the scene; may be repeated",
    )


def _assignment(text: str) -> tuple[str, str]:
    name, equals, value = text.partition("=")
    if not name or not equals:
        raise argparse.ArgumentTypeError(f"{text!r} is not NAME=VALUE")
    return name, value


def _size(text: str) -> tuple[int, int]:
    width, _, height = text.partition("x")
    if not (width.isdecimal() and height.isdecimal() and int(width) > 0 and int(height) > 0):
        raise argparse.ArgumentTypeError(f"{text!r} is not WIDTHxHEIGHT in pixels, such as 640x360")
    return int(width), int(height)


def _limit(text: str) -> tuple[str, float]:
    name, value = _assignment(text)
    if name not in METRICS:
        raise argparse.ArgumentTypeError(
            f"unknown metric {name!r}{_core.suggestion(name, list(METRICS))}"
        )
    try:
        return name, float(value)
    except ValueError:
        raise argparse.ArgumentTypeError(f"{value!r} is not a number") from None


# ---- render ------------------------------------------------------------------------------------


def _check_resume(args) -> None:
    """With --resume the checkpoint says what is rendered."""
    if not args.scene and not args.resume:
        raise _core.UsageError("SCENE is required, or --resume FILE; see pymlt render --help")
    if args.every is not None and not args.checkpoint and not args.resume:
        raise _core.UsageError("--every needs --checkpoint FILE")
    if not args.resume:
        return
    fixed = {
        "--integrator": args.integrator is not None,
        "-p": args.parameters,
        "-D": args.defines,
        "--size": args.size,
        "--seed": args.seed is not None,
    }
    for flag, given in fixed.items():
        if given:
            raise _core.UsageError(f"{flag} cannot be given with --resume: the checkpoint says it")


def _start(args, signals: _Signals) -> Job:
    budget = {"spp": args.spp, "time": args.time, "error": args.error}
    every = 60 if args.every is None else args.every
    common = {"threads": args.threads, "checkpoint": args.checkpoint, "every": every, **budget}
    if args.resume:
        moved = args.scene if args.scene and os.path.exists(args.scene) else None
        if args.scene and not moved:
            raise _core.FileError(f"{args.scene}: no such file")
        made = signals.abandonable(lambda: prepare_resume(args.resume, scene=moved, **common))
        return begin(made, args.cluster)
    scene = signals.abandonable(lambda: _load(args))
    integrator = as_integrator(scene, args.integrator, args.parameters)
    return start(scene, integrator, seed=args.seed or 0, cluster=args.cluster, **common)


def _render(args) -> int:
    _check_resume(args)
    for path in args.output:
        _core.check_image_writable(path)
    if args.stats:
        _core.check_file_writable(args.stats)
    with _Signals() as signals:
        job = _start(args, signals)
        known = job.stats["warnings"]
        if not args.quiet:
            _warn(known)
        try:
            _wait(job, signals, args.quiet)
        except _core.RenderError as error:
            if hasattr(error, "result"):
                _save(args, error.result)
            raise
        code = 128 + signals.caught if signals.caught else 0
        if code and job.stats["spp_done"] == 0:
            _say("interrupted before the first sample; nothing to save")
            return code
        result = job.result()
        if not args.quiet:
            _warn(result.stats["warnings"][len(known) :])
        _save(args, result)
    if not args.quiet:
        _say(("interrupted; " if code else "") + _summary(result, args.output))
    return code


def _warn(warnings: list[str]) -> None:
    for warning in warnings:
        _say(f"warning: {warning}")


def _wait(job: Job, signals: _Signals, quiet: bool) -> None:
    with progress_bar(False if quiet else None) as show:
        while not job.wait(0.1):
            if signals.caught:
                job.cancel()
            show(job.progress, {"spp": f"{job.stats['spp_done']:.4g}"})


def _save(args, result: Result) -> None:
    """Every output is tried, and elsewhere if it fails, before any error is reported."""
    failures = []
    writers = [(path, lambda path: result.save(path, args.exposure)) for path in args.output]
    if args.stats:
        text = json.dumps(result.stats, indent=2) + "\n"
        writers.append((args.stats, lambda path: _core.write_text(path, text)))
    for path, write in writers:
        try:
            written = write(path)
        except _core.FileError as error:
            failures.append(error)
            continue
        if written != path:
            _say(f"{path} could not be written; it is saved as {written}")
    if failures:
        raise failures[0]


def _summary(result: Result, outputs: list[str]) -> str:
    stats = result.stats
    width, height = stats["size"]
    seconds = stats["seconds"]["bootstrap"] + stats["seconds"]["render"]
    spp = stats["spp_done"]
    return f"{width} x {height}, {spp:.4g} spp in {seconds:.1f} s: {', '.join(outputs)}"


def _load(args) -> _core.Scene:
    defines = dict(args.defines)
    name = args.scene.replace("-", "_")
    if os.path.exists(args.scene):
        return load_file(args.scene, size=args.size, **defines)
    if name in scenes.names():
        return load_built_in(name, defines, args.size)
    if "." in name or os.sep in name:
        raise _core.FileError(f"{args.scene}: no such file")
    raise _core.UsageError(
        f"{args.scene!r} is neither a file nor a built-in scene"
        + _core.suggestion(name, scenes.names()),
    )


class _Signals:
    """SIGINT and SIGTERM while there is something to save: remembered in `caught`, not raised."""

    def __init__(self):
        self.caught = 0

    def __enter__(self):
        if threading.current_thread() is threading.main_thread():
            self._old = {n: signal.signal(n, self._catch) for n in (signal.SIGINT, signal.SIGTERM)}
        else:
            self._old = {}
        return self

    def __exit__(self, *_):
        for number, handler in self._old.items():
            signal.signal(number, handler)

    def _catch(self, number, _frame):
        self.caught = self.caught or number

    def abandonable(self, function):
        """Run a function whose work nobody would miss: a signal ends the program at once."""
        outcome = {}

        def run():
            try:
                outcome["value"] = function()
            except BaseException as error:
                outcome["error"] = error

        thread = threading.Thread(target=run, daemon=True)
        thread.start()
        while thread.is_alive():
            thread.join(0.05)
            if self.caught:
                os._exit(128 + self.caught)
        if "error" in outcome:
            raise outcome["error"]
        return outcome["value"]


# ---- merge -------------------------------------------------------------------------------------


def _merge(args) -> int:
    _core.check_image_writable(args.output)
    merge(args.renders, force=args.force).write(args.output)
    return 0


# ---- compare, info, list -----------------------------------------------------------------------


def _compare(args) -> int:
    wanted = {name for name, _ in args.fail_above}
    metrics = compare(args.image, args.reference, flip=True if "flip" in wanted else None)
    if args.json:
        finite = {k: v if math.isfinite(v) else None for k, v in metrics.items()}
        print(json.dumps(finite, indent=2))
    else:
        for name, value in metrics.items():
            print(f"{name:15} {value:.6g}")
    above = [(n, limit) for n, limit in args.fail_above if not abs(metrics[n]) <= limit]
    for name, limit in above:
        _say(f"{name} is {metrics[name]:.6g}, above {limit:g}")
    return 1 if above else 0


def _info(args) -> int:
    info = _load(args).info()
    if args.json:
        print(json.dumps(info, indent=2))
        return 0
    for name, value in info.items():
        if name == "warnings":
            continue
        text = " x ".join(map(str, value)) if name == "size" else value
        print(f"{name:13} {text}")
    for warning in info["warnings"]:
        _say(f"warning: {warning}")
    return 0


def _list(args) -> int:
    if args.family == "scenes":
        lines = scenes.names()
    elif args.family:
        lines = available(args.family)
    else:
        lines = [f"{family}: {', '.join(names)}" for family, names in available().items()]
        lines.append(f"scenes: {', '.join(scenes.names())}")
    print("\n".join(lines))
    return 0


if __name__ == "__main__":
    sys.exit(main())
