"""`pymlt list`: what plug-ins and built-in scenes there are, and what their parameters mean."""

from __future__ import annotations

from .. import _core, scenes
from ..algorithms.schemas import available, describe
from .common import emit

HELP = "List plug-ins, the parameters of one, or the built-in scenes."


def add_arguments(command) -> None:
    command.add_argument(
        "name",
        nargs="?",
        help="a family (bsdf, emitter, integrator, ...), a plug-in (mlt, roughdielectric, ...), or "
        "scenes",
    )


def run(args) -> int:
    emit("\n".join(_lines(args.name)))
    return 0


def _lines(name: str | None) -> list[str]:
    families = available()
    if name is None:
        lines = [f"{family}: {', '.join(names)}" for family, names in families.items()]
        return [*lines, f"scenes: {', '.join(scenes.names())}"]
    if name == "scenes":
        return scenes.names()
    if name in families:
        return families[name]
    found = [family for family, names in families.items() if name in names]
    if not found:
        known = [*families, "scenes", *(n for names in families.values() for n in names)]
        raise _core.UsageError(f"nothing is called {name!r}{_core.suggestion(name, known)}")
    return "\n\n".join(describe(family, name) for family in found).splitlines()
