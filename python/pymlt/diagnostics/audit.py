"""The audit of a mutation: is its target stationary?

print(mlt.audit(mlt.Lens(), scene).summary())
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import NamedTuple

from .. import _core
from ..algorithms.integrator import Integrator
from ..algorithms.mutation import Mutation
from ..algorithms.mutations import built_in
from ..formats.loading import SceneLike, as_scene


class AuditTest(NamedTuple):
    """One function g of a light path, and what one step of the mutation did to its mean."""

    function: str
    expected: bool  #: of both states with their weights, not of the one that was chosen
    change: float  #: of the mean of g under L*
    error: float  #: its standard error
    z: float
    p: float  #: two-sided
    adjusted_p: float  #: after Holm's correction for all tests


@dataclass(frozen=True)
class Audit:
    """What an audit found; true if, as far as it can tell, the target stays unchanged."""

    verdict: str  #: "right", "wrong" or "inconclusive"
    reason: str
    tests: list[AuditTest]  #: the least probable first
    steps: int
    accepted: int
    effective_samples: float
    text: str

    def __bool__(self) -> bool:
        return self.verdict == "right"

    def summary(self) -> str:
        """A table to read."""
        return self.text

    def __repr__(self) -> str:
        return f"Audit({self.verdict!r}: {self.reason})"


def audit(
    what: Mutation | Integrator,
    scene: SceneLike,
    *,
    paths: int = 10_000,
    seed: int = 0,
    threads: int = 0,
    significance: float = 1e-4,
    max_depth: int | None = None,
) -> Audit:
    """Test whether one step of a mutation, or of an `MLT`, leaves the target unchanged.

    what
        a mutation such as `Lens()` or one that is written in Python, or an `MLT` with its mixture.
    paths
        samples of bidirectional path tracing from which steps start.
    significance
        the chance of finding fault with a mutation that has none.
    max_depth
        edges of the longest path; by default that of the `MLT`, or 8 for a mutation.
    """
    settings = {"hide_emitters": False, "strict_normals": False, "near_specular": 0.1}
    if isinstance(what, Mutation):
        mixture = [(what, 1.0)]
        depth = 8
    elif isinstance(what, Integrator) and what.name == "mlt":
        given, written = what._parts()
        mixture = [
            (made.of(given), given.get(made._weight_name, made._weight))
            for made in built_in
            if given.get(made._switch, True)
        ] + written
        settings = {name: getattr(what, name) for name in settings}
        depth = what.max_depth
    else:
        raise _core.UsageError(f"{what!r} is neither a mutation nor an MLT()")
    report = _core.audit(
        as_scene(scene),
        mixture,
        depth if max_depth is None else max_depth,
        **settings,
        paths=paths,
        seed=seed,
        threads=threads,
        significance=significance,
    )
    return Audit(
        report.verdict,
        report.reason,
        [AuditTest(*test) for test in report.tests],
        report.steps,
        report.accepted,
        report.effective_samples,
        report.text(8),
    )
