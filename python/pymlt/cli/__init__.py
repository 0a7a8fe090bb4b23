"""The command line: pymlt render | merge | compare | info | list | lab.

Exit codes: 0 done; 1 `compare --fail-above` found more; 2 a mistake in usage or in the scene, or an
output that cannot be written, found before the work began; 3 the render failed, or an output at its
end is not where it was asked for; 129, 130 and 143 interrupted by SIGHUP, SIGINT or SIGTERM, with
what was rendered saved. Every error is one line on stderr.
"""

from __future__ import annotations

import os
import signal
import sys
import traceback

from .. import _core
from . import compare, info, lab, listing, merge, render
from .common import Parser, say

COMMANDS = {
    "render": render,
    "merge": merge,
    "compare": compare,
    "info": info,
    "list": listing,
    "lab": lab,
}


def main(arguments: list[str] | None = None) -> int:
    try:
        args = make_parser().parse_args(arguments)
        code = args.command(args)
        sys.stdout.flush()
        return code
    except (_core.SceneError, _core.UsageError, _core.FileError) as error:
        return fail(2, error)
    except (_core.Error, MemoryError) as error:
        return fail(3, error)
    except BrokenPipeError:  # the reader of our output (`| head`) has seen enough
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
        return 0
    except KeyboardInterrupt:
        return 128 + signal.SIGINT
    except Exception:  # a bug: say where
        traceback.print_exc()
        return 3


def fail(code: int, error: BaseException) -> int:
    say(str(error) or type(error).__name__)
    return code


def make_parser() -> Parser:
    parser = Parser(
        prog="pymlt",
        description="An open renderer for Metropolis light transport.",
        allow_abbrev=False,
    )
    parser.add_argument("--version", action="version", version=f"pymlt {_core.__version__}")
    commands = parser.add_subparsers(
        required=True, metavar=f"{{{','.join(COMMANDS)}}}", parser_class=Parser
    )
    for name, module in COMMANDS.items():
        help = module.HELP
        command = commands.add_parser(name, help=help, description=help, allow_abbrev=False)
        command.set_defaults(command=module.run)
        module.add_arguments(command)
    return parser
