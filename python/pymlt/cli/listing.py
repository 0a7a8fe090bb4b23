"""`pymlt list`: what plug-ins and built-in scenes there are."""

from __future__ import annotations

from .. import scenes
from ..algorithms.schemas import available

HELP = "List plug-ins, or the built-in scenes."


def add_arguments(command) -> None:
    command.add_argument("family", nargs="?", help="bsdf, emitter, integrator, ..., or scenes")


def run(args) -> int:
    if args.family == "scenes":
        lines = scenes.names()
    elif args.family:
        lines = available(args.family)
    else:
        lines = [f"{family}: {', '.join(names)}" for family, names in available().items()]
        lines.append(f"scenes: {', '.join(scenes.names())}")
    print("\n".join(lines))
    return 0
