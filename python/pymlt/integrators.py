"""The light transport algorithms as classes: `Path(max_depth=8)`, `PSSMLT(chains=256)`, ...

Each class is made from the schema of its plug-in, so names, defaults and docstrings are those of
the C++ side. An object only stores its parameters; they are checked when a render starts.
"""

from __future__ import annotations

import inspect

from . import _core, mutations
from .schemas import documentation

# Names that are abbreviations; any other one is capitalised.
_SPELLING = {name: name.upper() for name in ("bdpt", "erpt", "mlt", "mmlt", "pssmlt")}
_SPELLING["ptracer"] = "PTracer"


class Integrator:
    """A light transport algorithm: a name and its parameters.

    Parameters that were not given are attributes of the class: their defaults.
    """

    _name: str
    _defaults: dict

    def __init__(self, **parameters):
        for name in parameters:
            if name not in self._defaults:
                raise TypeError(
                    f"{type(self).__name__}() has no parameter {name!r}"
                    + _core.suggestion(name, list(self._defaults)),
                )
        self.__dict__.update(parameters)

    @property
    def name(self) -> str:
        """The plug-in's name, as scenes write it."""
        return self._name

    def to_dict(self) -> dict:
        """The Mitsuba dict that means the same."""
        given, written = self._parts()
        if written:
            raise _core.UsageError(
                f"{written[0][0]!r} is written in Python, which a dict cannot say; use the "
                f"{type(self).__name__} object itself"
            )
        return given

    def _parts(self) -> tuple[dict, list]:
        """The dict, and beside it the mutations that are written in Python, with their weights."""
        given = {name: value for name, value in self.__dict__.items() if value is not None}
        return {"type": self._name, **given}, []

    def __repr__(self) -> str:
        changed = [
            f"{name}={value!r}"
            for name, value in self.__dict__.items()
            if name not in self._defaults or value != self._defaults[name]
        ]
        return f"{type(self).__name__}({', '.join(changed)})"

    def __eq__(self, other) -> bool:
        if not isinstance(other, Integrator):
            return NotImplemented
        mine, others = ({**x._defaults, **x.__dict__} for x in (self, other))
        return type(self) is type(other) and mine == others

    __hash__ = None


class _WithMutations:
    """What `MLT` can do beside its plug-in: a list of mutations in place of their parameters."""

    def _parts(self) -> tuple[dict, list]:
        given, _ = super()._parts()
        mixture = given.pop("mutations", None)
        if mixture is None:
            return given, []
        chosen = mutations.parameters(mixture)
        if twice := [name for name in mutations.parameter_names() if name in given]:
            raise _core.UsageError(f"{twice[0]} is given beside mutations; give one of the two")
        return {"adaptive": False, **given, **chosen}, mutations.written_in_python(mixture)


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


def _make_class(plugin: str) -> type:
    schema = integrator_schema(plugin)
    defaults = {p["name"]: p["default"] for p in schema["parameters"]}
    keyword = inspect.Parameter.KEYWORD_ONLY
    signature = inspect.Signature(
        [inspect.Parameter(name, keyword, default=value) for name, value in defaults.items()],
    )
    return type(
        class_name(plugin),
        (_WithMutations, Integrator) if plugin == "mlt" else (Integrator,),
        {
            **defaults,
            "__doc__": documentation(schema),
            "__module__": __name__,
            "__signature__": signature,
            "_name": plugin,
            "_defaults": defaults,
        },
    )


__all__ = []
for _plugin in _core.names("integrator"):
    _class = _make_class(_plugin)
    globals()[_class.__name__] = _class
    __all__.append(_class.__name__)
