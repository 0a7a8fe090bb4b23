"""The parameters of one directive of a pbrt file, read with their defaults."""

from __future__ import annotations

from collections.abc import Iterable
from typing import TYPE_CHECKING, Any

from ..imported import Imported
from .spectra import colour
from .tokens import Parameter, Token

if TYPE_CHECKING:
    import numpy as np


class Params:
    """What follows a directive; what nobody asked for is named by `finish`."""

    def __init__(
        self,
        where: Token,
        type: str,
        given: dict[str, Parameter],
        made: Imported,
        defaults: dict[str, Parameter] | None = None,
    ):
        self.where = where
        self.type = type
        self.made = made
        self._given = given
        self._defaults = defaults or {}
        self._read: set[str] = set()

    def get(self, name: str) -> Parameter | None:
        """A parameter, if it is given."""
        self._read.add(name)
        return self._given.get(name, self._defaults.get(name))

    def number(self, name: str, default: float) -> float:
        found = self.get(name)
        if found is None or not found.values or not isinstance(found.values[0], float | bool):
            return default
        return float(found.values[0])

    def text(self, name: str, default: str = "") -> str:
        found = self.get(name)
        return str(found.values[0]) if found and found.values else default

    def flag(self, name: str, default: bool = False) -> bool:
        found = self.get(name)
        return found.values[0] in (True, "true") if found and found.values else default

    def array(self, name: str, width: int) -> np.ndarray | None:
        """Numbers as rows, or None."""
        import numpy as np

        found = self.get(name)
        if found is None or not found.values:
            return None
        if len(found.values) % width:
            raise self.where.error(f"{name!r} has {len(found.values)} numbers")
        return np.array(found.values, dtype=float).reshape(-1, width)

    def colour(self, name: str, default: float | list[float]) -> Any:
        """A colour or spectrum for a scene dict."""
        found = self.get(name)
        return colour(found, self.where, self.made) if found else default

    def part(self, names: Iterable[str]) -> dict[str, Parameter]:
        """Those of the parameters that are given."""
        found = {name: self._given[name] for name in names if name in self._given}
        self._read.update(found)
        return found

    def changed(self, given: dict[str, Parameter]) -> Params:
        """The same plug-in with some parameters of another value."""
        return Params(self.where, self.type, self._given | given, self.made, self._defaults)

    def taken_as(self, type: str, defaults: dict[str, Parameter]) -> Params:
        """The same parameters, of another plug-in."""
        return Params(self.where, type, self._given, self.made, defaults)

    def warn(self, text: str) -> None:
        """Names something that has no counterpart, with the line of the directive."""
        self.made.warn(text, self.where.place)

    def finish(self, ignored: tuple[str, ...] = ()) -> None:
        """Names what has not been read."""
        for name in sorted(set(self._given) - self._read - set(ignored)):
            self.warn(f"{self.where.text} {self.type!r}: {name!r} is left out")
