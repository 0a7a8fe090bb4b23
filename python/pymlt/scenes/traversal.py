"""The parameters of a scene as Mitsuba's `traverse` gives them: set some, then `update`."""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator, MutableMapping
from typing import Any

from .. import _core
from . import mitsuba_names, replaced
from .mitsuba_names import Meaning, meaning
from .nearest import nearest_names


class UnknownParameterError(_core.UsageError, KeyError):
    """A name that a scene does not have."""

    __str__ = ValueError.__str__  # KeyError would quote its text


class SceneParameters(MutableMapping[str, Any]):
    """Names and values of what can be changed in a scene; see `Scene.parameters`.

    The names that Mitsuba 3 has for them are understood, too, with its form of the values:
    `ball.bsdf.reflectance.value`, `sensor.film.size`, `mesh.vertex_positions`.
    `update` makes the scene of the changed values, which is `scene` from then on; the scene that
    was traversed stays as it was. Where a scene is expected, as in `render`, this stands for
    `scene`.
    """

    def __init__(self, scene: _core.Scene):
        self._scene = scene
        self._values = scene.parameters()
        self._changes: dict[str, Any] = {}

    @property
    def scene(self) -> _core.Scene:
        """With all changes up to the last `update`."""
        replaced.fetch(self._scene)
        return self._scene

    def __getitem__(self, name: str) -> Any:
        """Raises UsageError, which is a KeyError, for a name that the scene does not have."""
        size = (self._scene.width, self._scene.height)
        return mitsuba_names.read(self._meaning(name), self._values, size)

    def __setitem__(self, name: str, value: Any) -> None:
        """Raises UsageError for a name that the scene does not have."""
        own = mitsuba_names.given(self._meaning(name), value, self._values)
        self._values |= own
        self._changes |= own

    def __contains__(self, name: object) -> bool:
        return isinstance(name, str) and meaning(name, self._values) is not None

    def _meaning(self, name: str) -> Meaning:
        found = meaning(str(name), self._values)
        if found is None:
            near = nearest_names(str(name), list(self._values))
            raise UnknownParameterError(f"the scene has no parameter {name!r}{near}")
        return found

    def __delitem__(self, name: str) -> None:
        raise _core.UsageError(f"{name}: a parameter cannot be taken from a scene")

    def __iter__(self) -> Iterator[str]:
        return iter(self._values)

    def __len__(self) -> int:
        return len(self._values)

    def __repr__(self) -> str:
        return "\n".join(f"{name} = {value!r}" for name, value in self._values.items())

    def update(self, values: Any = (), /, **more: Any) -> _core.Scene:  # type: ignore[override]
        """Sets these values, too, and makes the scene of all that have been set; returns it.

        Raises UsageError for an unknown name, SceneError for a value that does not fit: nothing of
        what has been set since the last update counts then.
        """
        old = self._scene
        try:
            super().update(values, **more)
            if self._changes:
                self._scene = old.updated(self._changes)
                replaced.replace(old, self._scene)
        finally:
            self._changes = {}
            now = self._scene.parameters()
            self._values = {name: now[name] for name in self._values if name in now}
        return self._scene

    def keep(self, names: str | Iterable[str]) -> None:
        """Leave out all parameters but these, as in Mitsuba.

        A name may be a regular expression for the beginning of names. Raises UsageError for one
        that no parameter has.
        """
        kept: set[str] = set()
        for name in [names] if isinstance(names, str) else names:
            kept.update(self._named(name))
        self._values = {name: value for name, value in self._values.items() if name in kept}

    def _named(self, pattern: str) -> list[str]:
        """The names that it means or matches."""
        if (found := meaning(pattern, self._values)) is not None:
            return list(found.names)
        try:
            matching = [name for name in self._values if re.match(pattern, name)]
        except re.error as error:
            raise _core.UsageError(f"{pattern!r} is no regular expression: {error}") from None
        return matching or list(self._meaning(pattern).names)


def traverse(scene: _core.Scene) -> SceneParameters:
    """The parameters of a scene, to be set by their names and then updated by `update`.

        params = mlt.traverse(scene)
        params["clay.reflectance"] = [0.1, 0.2, 0.9]
        params.update()
        image = mlt.render(params)

    A Scene never changes, so it is `params`, or `params.scene`, that has the new values.
    """
    return SceneParameters(scene)
