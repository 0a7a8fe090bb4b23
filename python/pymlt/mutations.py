"""The mutations of `MLT`, and the audit of whether one is right.

    algo = mlt.MLT(mutations=[(mlt.Bidirectional(), 0.4), (mlt.Lens(), 0.3), (mlt.Caustic(), 0.3)])
    print(mlt.audit(mlt.Lens(), scene).summary())

Each class is made from what the C++ side says about the mutation. A mutation of your own is a
subclass of `Mutation`.
"""

from __future__ import annotations

import textwrap
from dataclasses import dataclass
from typing import NamedTuple

from . import _core
from ._core import LightPath


class Mutation:
    """A way of changing a light path. Subclass it to write one in Python.

    It may be audited, join the mixture of an `MLT`, and move chains of `metropolis.run` whose
    target is `scene.path_target()`. All chains and threads share the object, so its methods must
    not change it. They are called from one thread at a time.

    suitability(x)
        The weight with which it takes part in the choice among mutations: 1, or 0 where it cannot
        act on x. Acceptance accounts for it.
    propose(x, rng)
        Returns another path y, made by `x.with_vertices(...)`, or None if it finds none. `rng` is a
        `numpy.random.Generator` on the random stream of the chain; draw from nothing else, and
        renders depend on their seed alone. Visibility is tested afterwards: a path that light
        cannot take is rejected, and so is one that breaks the law of reflection or refraction at a
        delta vertex.
    density(x, y)
        T(x -> y), the density with which `propose` makes y of x, given that this mutation was
        chosen, in the product-area measure of the vertices that y has and x has not: the product
        over these vertices of a density per unit of area (in the units of the scene; per steradian
        for a vertex at infinity, and for a vertex that follows a delta vertex the coefficient of
        that delta), as `y.from_light` and `y.from_camera` are. It is also asked for T(y -> x), and
        must be 0 where `propose` could not have made the path. A constant factor cancels, but not
        one that depends on the paths.

    The contract is that of the C++ side (cpp/mutation/mutation.h; Veach 1997, sec. 11.2).
    """

    _built_in = False

    @property
    def name(self) -> str:
        """As in `stats`: the name of the class."""
        return type(self).__name__

    def suitability(self, x: LightPath) -> float:
        return 1.0

    def propose(self, x: LightPath, rng) -> LightPath | None:
        raise NotImplementedError(f"{type(self).__name__} needs a method propose(x, rng)")

    def density(self, x: LightPath, y: LightPath) -> float:
        raise NotImplementedError(f"{type(self).__name__} needs a method density(x, y)")

    def __repr__(self) -> str:
        return f"{type(self).__name__}()"


class _BuiltIn(Mutation):
    """A mutation of the C++ side; it holds no state."""

    _built_in = True
    _name: str
    _switch: str  # the parameters of the integrator that turn it on ...
    _weight_name: str  # ... and give it its weight
    _weight: float

    @property
    def name(self) -> str:
        """As in `stats` and in the parameters of the integrator."""
        return self._name

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
        (_BuiltIn,),
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
            is_class = isinstance(mutation, type) and issubclass(mutation, Mutation)
            hint = f"; write {mutation.__name__}()" if is_class else ""
            raise _core.UsageError(f"{mutation!r} in mutations is not a mutation{hint}")
        if mutation in weights:
            raise _core.UsageError(f"{mutation!r} is twice in mutations")
        weights[mutation] = _weight(mutation, weight)
    return weights


def _weight(mutation: Mutation, weight) -> float:
    if weight is None:
        return mutation._weight if mutation._built_in else 0.3
    if not mutation._built_in and not 0 <= float(weight) < float("inf"):
        raise _core.UsageError(f"the weight of {mutation!r} is {weight}; it must not be negative")
    return float(weight)


def parameter_names() -> list[str]:
    """The parameters of the integrator that a list of mutations stands for."""
    return [name for made in _classes for name in (made._switch, made._weight_name)]


def parameters(mutations) -> dict[str, bool | float]:
    """The parameters of the integrator that mean the built-in mutations of this mixture.

    Those not listed are off.
    """
    weights = weighted(mutations)
    chosen: dict[str, bool | float] = {}
    for made in _classes:
        chosen[made._switch] = made() in weights
        if made() in weights:
            chosen[made._weight_name] = weights[made()]
    return chosen


def written_in_python(mutations) -> list[tuple[Mutation, float]]:
    """The others, with their weights."""
    weights = weighted(mutations)
    written = [(m, weight) for m, weight in weights.items() if not m._built_in]
    if written and not any(m._built_in and weight > 0 for m, weight in weights.items()):
        raise _core.UsageError(
            "mutations written in Python need a built-in one beside them, such as Bidirectional(): "
            "together they must be able to reach every path"
        )
    return written


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
        a mutation such as `Lens()` or one that is written in Python, or an `MLT` with its mixture.
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
        mixture = [(what, 1.0)]
        depth = 8
    elif isinstance(what, Integrator) and what.name == "mlt":
        given, written = what._parts()
        mixture = [
            (made(), given.get(made._weight_name, made._weight))
            for made in _classes
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
