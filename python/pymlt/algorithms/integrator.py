"""What an integrator is in Python, and what users may write in its place."""

from __future__ import annotations

from .. import _core
from .parameters import WithParameters


class Integrator(WithParameters):
    """A light transport algorithm: a name and its parameters.

    Parameters that were not given are attributes of the class: their defaults.
    """

    _name: str

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
        return {"type": self._name, **self._given()}, []


IntegratorLike = Integrator | _core.Integrator | dict | str


def as_integrator(
    scene: _core.Scene, integrator: IntegratorLike | None, assignments=()
) -> _core.Integrator:
    """What `integrator` means for this scene; see `start`."""
    if isinstance(integrator, _core.Integrator):
        return integrator
    if isinstance(integrator, Integrator):
        integrator, written = integrator._parts()
        if written:
            made = _core.integrator_from_dict(integrator)
            return _core.with_mutations(made, scene, written)
    if isinstance(integrator, dict):
        return _core.integrator_from_dict(integrator)
    if integrator is None or isinstance(integrator, str):
        return _core.integrator_by_name(scene, integrator or "", list(assignments))
    if isinstance(integrator, type) and issubclass(integrator, Integrator):
        raise _core.UsageError(f"integrator is a class; write {integrator.__name__}()")
    raise _core.UsageError(f"{integrator!r} is not an integrator, a dict, or a name")
