"""The parameters of a scene as Mitsuba's `traverse` gives them: set some, then `update`."""

from __future__ import annotations

from collections.abc import Iterator, MutableMapping
from typing import Any

from .. import _core
from . import mitsuba_names
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
        self.scene = scene  #: with all changes up to the last `update`
        self._values = scene.parameters()
        self._changes: dict[str, Any] = {}

    def __getitem__(self, name: str) -> Any:
        """Raises UsageError, which is a KeyError, for a name that the scene does not have."""
        size = (self.scene.width, self.scene.height)
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
        before = self.scene.parameters()
        try:
            super().update(values, **more)
            self.scene = self.scene.updated(self._changes)
        except _core.Error:
            self._values = before
            raise
        finally:
            self._changes = {}
        self._values = self.scene.parameters()
        return self.scene


def traverse(scene: _core.Scene) -> SceneParameters:
    """The parameters of a scene, to be set by their names and then updated by `update`.

        params = mlt.traverse(scene)
        params["clay.reflectance"] = [0.1, 0.2, 0.9]
        params.update()
        image = mlt.render(params)

    A Scene never changes, so it is `params`, or `params.scene`, that has the new values.
    """
    return SceneParameters(scene)
