"""What may have been meant by the name of a parameter that a scene does not have."""

from __future__ import annotations

from .. import _core
from .mitsuba_names import PARAMETERS, translated

CLOSE = "; did you mean"
MOST = 3  #: names that are given
#: Parameters of Mitsuba for which scene files have another one.
INSTEAD = {"eta": "int_ior"} | {name: parts[0] for name, parts in PARAMETERS.items()}


def nearest_names(name: str, known: list[str]) -> str:
    """The end of an error: a similar name, one of other plug-ins, or what the plug-in has."""
    plugin, _, parameter = translated(name).rpartition(".")
    parameter = INSTEAD.get(parameter, parameter)
    own = f"{plugin}.{parameter}"
    close = f"{CLOSE} {own!r}?" if own in known else _core.suggestion(own, known)
    if close.startswith(CLOSE):
        return close
    if parts := [other.rpartition(".")[2] for other in known if other.rpartition(".")[0] == plugin]:
        return f"; {plugin} has: {', '.join(parts)}"
    if alike := [other for other in known if other.rpartition(".")[2] == parameter][:MOST]:
        return f"{CLOSE} {' or '.join(map(repr, alike))}?"
    return "; scene.parameters() names them all"
