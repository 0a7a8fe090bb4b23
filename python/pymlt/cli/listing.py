"""`pymlt list`: what plug-ins and built-in scenes there are, and what their parameters mean."""

from __future__ import annotations

import inspect
import re
import shutil
import textwrap

from .. import _core, scenes
from ..algorithms.schemas import available, describe
from .common import emit

SENTENCE_END = re.compile(r"(?<=\.)(?<!\bal\.) (?=[A-Z])")  #: not that of "et al." or "ch. 10"
HELP = "List plug-ins and built-in scenes, or the parameters of one plug-in."


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
        groups = [[f"{family}:", *_family(family, "  ")] for family in families]
        groups.append(["scenes:", *_scenes("  ")])
        return "\n\n".join("\n".join(group) for group in groups).splitlines()
    if name == "scenes":
        return _scenes("")
    if name in families:
        return _family(name, "")
    found = [family for family, names in families.items() if name in names]
    if not found:
        known = [*families, "scenes", *(n for names in families.values() for n in names)]
        raise _core.UsageError(f"nothing is called {name!r}{_core.suggestion(name, known)}")
    return "\n\n".join(describe(family, name) for family in found).splitlines()


def _family(family: str, indent: str) -> list[str]:
    return _table({name: _core.schema(family, name)["doc"] for name in available(family)}, indent)


def _scenes(indent: str) -> list[str]:
    return _table({name: inspect.getdoc(getattr(scenes, name)) for name in scenes.names()}, indent)


def _table(docs: dict[str, str | None], indent: str) -> list[str]:
    """A line for each name, with as much of its first sentence as the terminal is wide."""
    width = max(map(len, docs))
    room = max(40, shutil.get_terminal_size((100, 24)).columns - width - len(indent) - 2)
    return [f"{indent}{name:{width}}  {_short(doc or '', room)}" for name, doc in docs.items()]


def _short(doc: str, room: int) -> str:
    paragraph = " ".join(doc.split("\n\n")[0].split())
    sentence = SENTENCE_END.split(paragraph)[0]
    return textwrap.shorten(sentence, room, placeholder=" ...")
