"""A list of mutations, as the parameters of `MLT` that mean the same."""

from __future__ import annotations

from collections.abc import Sequence

from .. import _core
from .mutation import Mutation
from .mutations import built_in

Mixture = Sequence[Mutation | tuple[Mutation, float]]


def weighted(mutations: Mixture) -> dict[Mutation, float]:
    """A list of mutations, each alone or in a pair with its weight, as a dict of their weights."""
    weights: dict[Mutation, float] = {}
    for item in mutations:
        mutation, weight = item if isinstance(item, tuple | list) else (item, None)
        if not isinstance(mutation, Mutation):
            is_class = isinstance(mutation, type) and issubclass(mutation, Mutation)
            hint = f"; write {mutation.__name__}()" if is_class else ""
            raise _core.UsageError(f"{mutation!r} in mutations is not a mutation{hint}")
        if any(_same(mutation, other) for other in weights):
            raise _core.UsageError(f"{mutation!r} is twice in mutations")
        weights[mutation] = _weight(mutation, weight)
    return weights


def _same(a: Mutation, b: Mutation) -> bool:
    """A built-in mutation takes part once, since the integrator has one set of its parameters."""
    return type(a) is type(b) if a._built_in else a == b


def _weight(mutation: Mutation, weight) -> float:
    if weight is None:
        return mutation._weight if mutation._built_in else 0.3
    if not mutation._built_in and not 0 <= float(weight) < float("inf"):
        raise _core.UsageError(f"the weight of {mutation!r} is {weight}; it must not be negative")
    return float(weight)


def parameter_names() -> list[str]:
    """The parameters of the integrator that a list of mutations stands for."""
    return [
        name
        for made in built_in
        for name in (made._switch, made._weight_name, *made.full_names().values())
    ]


def parameters(mutations: Mixture) -> dict[str, bool | float]:
    """The parameters of the integrator that mean the built-in mutations of this mixture.

    Those not listed are off.
    """
    chosen: dict[str, bool | float] = {made._switch: False for made in built_in}
    for mutation, weight in weighted(mutations).items():
        if mutation._built_in:
            chosen |= {mutation._switch: True, mutation._weight_name: weight}
            chosen |= {mutation.full_names()[own]: v for own, v in mutation._given().items()}
    return chosen


def written_in_python(mutations: Mixture) -> list[tuple[Mutation, float]]:
    """The others, with their weights."""
    weights = weighted(mutations)
    written = [(m, weight) for m, weight in weights.items() if not m._built_in]
    if written and not any(m._built_in and weight > 0 for m, weight in weights.items()):
        raise _core.UsageError(
            "mutations written in Python need a built-in one beside them, such as Bidirectional(): "
            "together they must be able to reach every path"
        )
    return written
