"""The light transport algorithms as classes: `Path(max_depth=8)`, `PSSMLT(chains=256)`, ...

Each class is made from the schema of its plug-in, so names, defaults and docstrings are those of
the C++ side. An object only stores its parameters; they are checked when a render starts.
"""

from __future__ import annotations

import inspect

from . import _core
from .schemas import documentation

# Names that are abbreviations; any other one is capitalised.
_SPELLING = {name: name.upper() for name in ("bdpt", "erpt", "mlt", "mmlt", "pssmlt")}
_SPELLING["ptracer"] = "PTracer"


class Integrator:
    """A light transport algorithm: a name and its parameters."""

    _name: str
    _defaults: dict

    def __init__(self, **parameters):
        for name in parameters:
            if name not in self._defaults:
                raise TypeError(
                    f"{type(self).__name__}() has no parameter {name!r}"
                    + _core.suggestion(name, list(self._defaults)),
                )
        self.__dict__.update(self._defaults | parameters)

    @property
    def name(self) -> str:
        """The plug-in's name, as scenes write it."""
        return self._name

    def to_dict(self) -> dict:
        """The Mitsuba dict that means the same."""
        given = {name: value for name, value in self.__dict__.items() if value is not None}
        return {"type": self._name, **given}

    def __repr__(self) -> str:
        changed = [
            f"{name}={value!r}"
            for name, value in self.__dict__.items()
            if name not in self._defaults or value != self._defaults[name]
        ]
        return f"{type(self).__name__}({', '.join(changed)})"

    def __eq__(self, other) -> bool:
        return type(self) is type(other) and self.__dict__ == other.__dict__

    __hash__ = None


def class_name(plugin: str) -> str:
    """The class of an integrator plug-in: "path" is Path, "pssmlt" is PSSMLT."""
    return _SPELLING.get(plugin) or "".join(part.capitalize() for part in plugin.split("_"))


def _make_class(plugin: str) -> type:
    schema = _core.schema("integrator", plugin)
    defaults = {p["name"]: p["default"] for p in schema["parameters"]}
    keyword = inspect.Parameter.KEYWORD_ONLY
    signature = inspect.Signature(
        [inspect.Parameter(name, keyword, default=value) for name, value in defaults.items()],
    )
    return type(
        class_name(plugin),
        (Integrator,),
        {
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
