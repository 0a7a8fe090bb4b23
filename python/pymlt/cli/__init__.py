"""The command line: pymlt render | view | merge | mix | denoise | compare | info | list |
convert | race | lab.

Exit codes: 0 done; 1 `compare --fail-above` found more, or `compare` pixels that are no numbers; 2
a mistake in usage or in the scene, or an output that cannot be written, found before the work
began; 3 the render failed, or an output at its end is not where it was asked for; 129, 130 and 143
interrupted by SIGHUP, SIGINT or SIGTERM, with what was rendered saved. Every error is one line on
stderr.
"""

from __future__ import annotations

import argparse
import signal
import sys
import traceback

from .. import _core, _interrupt
from . import compare, convert, denoise, info, lab, listing, merge, mix, race, render, view
from .common import Parser, names_leniency, open_standard_streams, say
from .completion import SHELLS, PrintCompletion

GROUPS = {
    "render": {"render": render, "view": view},
    "images": {"merge": merge, "mix": mix, "denoise": denoise, "compare": compare},
    "scenes": {"info": info, "list": listing, "convert": convert},
    "algorithms": {"race": race, "lab": lab},
}
COMMANDS = {name: module for group in GROUPS.values() for name, module in group.items()}
EXAMPLES = (
    "pymlt render ring --time 60 --exposure auto -o ring.exr -o ring.png",
    "pymlt render scene.xml --integrator path -p max_depth=8 --spp 64 -o out.exr",
    "pymlt view bunny.ply --open",
    "pymlt list integrator",
    "pymlt COMMAND --help",
)


def main(arguments: list[str] | None = None) -> int:
    open_standard_streams()
    try:
        _interrupt.end()
        return run(make_parser().parse_args(arguments))
    except (_core.SceneError, _core.UsageError, _core.FileError) as error:
        return fail(2, error)
    except (_core.Error, MemoryError) as error:
        return fail(3, error)
    except ImportError as error:  # numpy has more to load than there is memory
        return fail(3, str(error).strip().splitlines()[-1])
    except KeyboardInterrupt:
        return 128 + signal.SIGINT
    except Exception:  # a bug: say where
        if sys.stderr is not None:
            traceback.print_exc()
        return 3


def run(args: argparse.Namespace) -> int:
    try:
        return args.command(args)
    except _core.SceneError as error:
        raise names_leniency(error, args) from None


def fail(code: int, error: BaseException) -> int:
    say(str(error) or type(error).__name__)
    return code


def make_parser() -> Parser:
    parser = Parser(
        prog="pymlt",
        usage="pymlt [-h] [--version] [--print-completion SHELL] COMMAND ...",
        description="An open renderer for Metropolis light transport.",
        epilog=overview(),
        formatter_class=argparse.RawDescriptionHelpFormatter,
        allow_abbrev=False,
    )
    parser.add_argument("--version", action="version", version=f"pymlt {_core.__version__}")
    parser.add_argument(
        "--print-completion",
        choices=SHELLS,
        action=PrintCompletion,
        help="print what this shell needs to complete commands, flags and files",
    )
    parser.set_defaults(command=lambda _: parser.print_help() or 0)
    commands = parser.add_subparsers(
        metavar="COMMAND", parser_class=Parser, help=argparse.SUPPRESS, prog="pymlt"
    )
    for name, module in COMMANDS.items():
        help = module.HELP
        command = commands.add_parser(name, help=help, description=help, allow_abbrev=False)
        command.set_defaults(command=module.run)
        module.add_arguments(command)
    return parser


def overview() -> str:
    """The commands by what they are for, and examples."""
    lines = []
    for title, group in GROUPS.items():
        lines += [f"{title}:", *(f"  {name:9} {module.HELP}" for name, module in group.items()), ""]
    return "\n".join([*lines, "examples:", *(f"  {example}" for example in EXAMPLES)])
