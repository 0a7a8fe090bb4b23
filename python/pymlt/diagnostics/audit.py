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
    """One function of a light path, and what one step of the mutation did to its mean.

    "image x at 5 edges" is of the steps between paths of 5 edges, "... along LDDE" of those between
    paths of this signature; "..., by steps in the image" weighs steps by their length.
    """

    function: str
    expected: bool  #: of both states with their weights, not of the one that was chosen
    change: float  #: of the mean of g under L*
    error: float  #: its standard error
    z: float
    p: float  #: two-sided
    adjusted_p: float  #: after Holm's correction for all tests


class AuditLimit(NamedTuple):
    """A shift of the image position, in each accepted step, that nine audits of ten find."""

    edges: int  #: of the paths that are shifted; 0: of all
    or_more: bool  #: whether longer paths count, too
    pixels: float


@dataclass(frozen=True)
class Audit:
    """What an audit found; true if it found nothing wrong, which says no more than `limits` do."""

    verdict: str  #: "nothing found", "wrong" or "inconclusive"
    reason: str
    tests: list[AuditTest]  #: the least probable first
    steps: int
    accepted: int
    effective_samples: float
    text: str
    limits: list[AuditLimit]  #: of all paths first; empty if no step moves the image position

    def __bool__(self) -> bool:
        return self.verdict == "nothing found"

    def summary(self) -> str:
        """A table to read."""
        return self.text

    def __repr__(self) -> str:
        return f"Audit({self.verdict!r}{';' if self else ':'} {self.reason})"


def audit(
    what: Mutation | Integrator,
    scene: SceneLike,
    *,
    paths: int = 10_000,
    most_paths: int | None = None,
    seed: int = 0,
    threads: int = 0,
    significance: float = 1e-4,
    max_depth: int | None = None,
) -> Audit:
    """Test whether one step of a mutation, or of an `MLT`, leaves the target unchanged.

    No audit can say that it does: the verdict tells which fault would have been found.

    what
        a mutation such as `Lens()` or one that is written in Python, or an `MLT` with its mixture.
    paths
        samples of bidirectional path tracing from which steps start.
    most_paths
        while something looks suspicious, and no more, the audit doubles its samples, up to this
        many; by default 16 times `paths`.
    significance
        the chance of finding fault with a mutation that has none, over all stages.
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
        most_paths=16 * paths if most_paths is None else max(most_paths, paths),
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
        [AuditLimit(*limit) for limit in report.limits],
    )
