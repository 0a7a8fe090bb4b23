"""The light transport algorithms as classes: `Path(max_depth=8)`, `PSSMLT(chains=256)`, ...

Each class is made from the schema of its plug-in, so names, defaults and docstrings are those of
the C++ side. An object only stores its parameters; they are checked when a render starts.
"""

from __future__ import annotations

from .. import _core
from . import mixture
from .integrator import Integrator
from .parameters import make_class

# Names that are abbreviations; any other one is capitalised.
_SPELLING = {name: name.upper() for name in ("bdpt", "erpt", "mlt", "mmlt", "pssmlt", "rjmlt")}
_SPELLING["ptracer"] = "PTracer"


class _WithMutations:
    """What `MLT` can do beside its plug-in: a list of mutations in place of their parameters."""

    def _parts(self) -> tuple[dict, list]:
        given, _ = super()._parts()
        mutations = given.pop("mutations", None)
        if mutations is None:
            return given, []
        chosen = mixture.parameters(mutations)
        if twice := [name for name in mixture.parameter_names() if name in given]:
            raise _core.UsageError(f"{twice[0]} is given beside mutations; give one of the two")
        return {"adaptive": False, **given, **chosen}, mixture.written_in_python(mutations)


_MUTATIONS = {
    "name": "mutations",
    "type": "list of mutations",
    "default": None,
    "doc": "Those that take part, such as [(Bidirectional(), 0.4), (Lens(), 0.6)], in place of the "
    "parameters for each; others are off, and so is `adaptive` unless it is given.",
    "choices": [],
}


def integrator_schema(plugin: str) -> dict:
    """The schema of a plug-in, with the parameters that its class adds."""
    schema = _core.schema("integrator", plugin)
    if plugin == "mlt":
        schema["parameters"].append(_MUTATIONS)
    return schema


def class_name(plugin: str) -> str:
    """The class of an integrator plug-in: "path" is Path, "pssmlt" is PSSMLT."""
    return _SPELLING.get(plugin) or "".join(part.capitalize() for part in plugin.split("_"))


__all__ = []
for _plugin in _core.names("integrator"):
    _bases = (_WithMutations, Integrator) if _plugin == "mlt" else (Integrator,)
    _class = make_class(class_name(_plugin), _bases, __name__, integrator_schema(_plugin))
    globals()[_class.__name__] = _class
    __all__.append(_class.__name__)
