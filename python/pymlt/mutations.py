"""The mutations of `MLT`, and the audit of whether one is right.

    algo = mlt.MLT(mutations=[(mlt.Bidirectional(), 0.4), (mlt.Lens(), 0.3), (mlt.Caustic(), 0.3)])
    print(mlt.audit(mlt.Lens(), scene).summary())

Each class is made from what the C++ side says about the mutation.
"""

from __future__ import annotations

import textwrap
from dataclasses import dataclass
from typing import NamedTuple

from . import _core


class Mutation:
    """A way of changing a light path; it holds no state."""

    _name: str
    _switch: str  # the parameters of the integrator that turn it on ...
    _weight_name: str  # ... and give it its weight
    _weight: float

    @property
    def name(self) -> str:
        """As in `stats` and in the parameters of the integrator."""
        return self._name

    def __repr__(self) -> str:
        return f"{type(self).__name__}()"

    def __eq__(self, other) -> bool:
        return type(self) is type(other)

    def __hash__(self) -> int:
        return hash(type(self))


def mutation_class_name(name: str) -> str:
    """The class of a mutation: "multi_chain" is MultiChain."""
    return "".join(part.capitalize() for part in name.split("_"))


def mutation_documentation(kind: dict) -> str:
    """The docstring of the class of a mutation."""
    return textwrap.fill(f"The {kind['doc']}", 88)


def _make_class(kind: dict) -> type:
    return type(
        mutation_class_name(kind["name"]),
        (Mutation,),
        {
            "__doc__": mutation_documentation(kind),
            "__module__": __name__,
            "_name": kind["name"],
            "_switch": kind["switch"],
            "_weight_name": kind["weight_name"],
            "_weight": kind["weight"],
        },
    )


_classes = [_make_class(kind) for kind in _core.mutation_kinds()]
globals().update({made.__name__: made for made in _classes})
__all__ = [made.__name__ for made in _classes]


# ---- a mixture as parameters of the integrator --------------------------------------------------


def weighted(mutations) -> dict[Mutation, float]:
    """A list of mutations, each alone or in a pair with its weight, as a dict of their weights."""
    weights: dict[Mutation, float] = {}
    for item in mutations:
        mutation, weight = item if isinstance(item, tuple | list) else (item, None)
        if not isinstance(mutation, Mutation):
            name = getattr(mutation, "__name__", None)
            hint = f"; write {name}()" if mutation in _classes else ""
            raise _core.UsageError(f"{mutation!r} in mutations is not a mutation{hint}")
        if mutation in weights:
            raise _core.UsageError(f"{mutation!r} is twice in mutations")
        weights[mutation] = mutation._weight if weight is None else float(weight)
    return weights


def parameter_names() -> list[str]:
    """The parameters of the integrator that a list of mutations stands for."""
    return [name for made in _classes for name in (made._switch, made._weight_name)]


def parameters(mutations) -> dict[str, bool | float]:
    """The parameters of the integrator that mean this mixture: those not listed are off."""
    weights = weighted(mutations)
    chosen: dict[str, bool | float] = {}
    for made in _classes:
        chosen[made._switch] = made() in weights
        if made() in weights:
            chosen[made._weight_name] = weights[made()]
    return chosen


# ---- audit --------------------------------------------------------------------------------------


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
    what,
    scene,
    *,
    paths: int = 10_000,
    seed: int = 0,
    threads: int = 0,
    significance: float = 1e-4,
    max_depth: int | None = None,
) -> Audit:
    """Test whether one step of a mutation, or of an `MLT`, leaves the target unchanged.

    what
        a mutation such as `Lens()`, or an `MLT` with its mixture.
    paths
        samples of bidirectional path tracing from which steps start.
    significance
        the chance of finding fault with a mutation that has none.
    max_depth
        edges of the longest path; by default that of the `MLT`, or 8 for a mutation.
    """
    from .integrators import Integrator
    from .jobs import as_scene

    settings = {"hide_emitters": False, "strict_normals": False, "near_specular": 0.1}
    if isinstance(what, Mutation):
        mixture = [(what.name, 1.0)]
        depth = 8
    elif isinstance(what, Integrator) and what.name == "mlt":
        given = what.to_dict()
        mixture = [
            (made._name, given.get(made._weight_name, made._weight))
            for made in _classes
            if given.get(made._switch, True)
        ]
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
