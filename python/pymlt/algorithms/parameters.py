"""Objects that only store parameters, in classes that are made from schemas of the C++ side."""

from __future__ import annotations

import inspect

from .. import _core
from .schemas import documentation, type_of


class WithParameters:
    """Parameters that were not given are attributes of the class: their defaults.

    They are checked when they are used.
    """

    _defaults: dict

    def __init__(self, **parameters):
        for name in parameters:
            if name not in self._defaults:
                raise TypeError(
                    f"{type(self).__name__}() has no parameter {name!r}"
                    + _core.suggestion(name, list(self._defaults)),
                )
        self.__dict__.update(parameters)

    def _given(self) -> dict:
        """The parameters that were given, but for those that are None."""
        return {name: value for name, value in self.__dict__.items() if value is not None}

    def __repr__(self) -> str:
        changed = [
            f"{name}={value!r}"
            for name, value in self.__dict__.items()
            if name not in self._defaults or value != self._defaults[name]
        ]
        return f"{type(self).__name__}({', '.join(changed)})"

    def __eq__(self, other) -> bool:
        if not isinstance(other, WithParameters):
            return NotImplemented
        mine, others = ({**x._defaults, **x.__dict__} for x in (self, other))
        return type(self) is type(other) and mine == others

    __hash__ = None


def make_class(name: str, bases: tuple[type, ...], module: str, schema: dict, **members) -> type:
    """A class with the parameters of a schema as keywords, and their documentation."""
    defaults = {p["name"]: p["default"] for p in schema["parameters"]}
    keyword = inspect.Parameter.KEYWORD_ONLY
    signature = inspect.Signature(
        [
            inspect.Parameter(p["name"], keyword, default=p["default"], annotation=type_of(p))
            for p in schema["parameters"]
        ],
    )
    own = {
        "__doc__": documentation(schema),
        "__module__": module,
        "__signature__": signature,
        "_name": schema["name"],
        "_defaults": defaults,
    }
    return type(name, bases, {**defaults, **own, **members})
