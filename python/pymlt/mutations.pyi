# Made by `python -m pymlt._stubs` from the schemas of the plug-ins. Do not edit.
from collections.abc import Sequence
from os import PathLike
from typing import Any, Literal, NamedTuple

import numpy as np

from ._core import LightPath, Scene
from .integrators import Integrator

class Mutation:
    """A way of changing a light path. Subclass it to write one in Python."""

    @property
    def name(self) -> str: ...
    def suitability(self, x: LightPath) -> float:
        """The weight with which it takes part in the choice: 1, or 0 where it cannot act on x."""

    def propose(self, x: LightPath, rng: np.random.Generator) -> LightPath | None:
        """Another path y, made by `x.with_vertices(...)`, or None."""

    def density(self, x: LightPath, y: LightPath) -> float:
        """T(x -> y) in the product-area measure of the vertices that y has and x has not."""

def mutation_class_name(name: str) -> str: ...
def mutation_documentation(kind: dict[str, Any]) -> str: ...
def weighted(
    mutations: Sequence[Mutation | tuple[Mutation, float]],
) -> dict[Mutation, float]: ...
def parameters(
    mutations: Sequence[Mutation | tuple[Mutation, float]],
) -> dict[str, bool | float]: ...
def parameter_names() -> list[str]: ...
def written_in_python(
    mutations: Sequence[Mutation | tuple[Mutation, float]],
) -> list[tuple[Mutation, float]]: ...

class AuditTest(NamedTuple):
    function: str
    expected: bool
    change: float
    error: float
    z: float
    p: float
    adjusted_p: float

class Audit:
    verdict: Literal["right", "wrong", "inconclusive"]
    reason: str
    tests: list[AuditTest]
    steps: int
    accepted: int
    effective_samples: float
    text: str

    def __bool__(self) -> bool: ...
    def summary(self) -> str: ...

def audit(
    what: Mutation | Integrator,
    scene: Scene | dict[str, Any] | str | PathLike[str],
    *,
    paths: int = ...,
    seed: int = ...,
    threads: int = ...,
    significance: float = ...,
    max_depth: int | None = ...,
) -> Audit: ...

class Bidirectional(Mutation):
    """The bidirectional mutation, which replaces any piece of the path (Veach 1997, sec.
    11.3.1).
    """

class Lens(Mutation):
    """The lens perturbation of paths (L|D)DS*E and LS*E (Veach 1997, sec. 11.3.3.1)."""

class Caustic(Mutation):
    """The caustic perturbation of paths (L|D)S*DE (Veach 1997, sec. 11.3.3.2)."""

class MultiChain(Mutation):
    """The multi-chain perturbation of paths (L|D)(DS+)+DS*E and L(S+D)+S*E (Veach 1997, sec.
    11.3.3.3).
    """

class LensSubpath(Mutation):
    """The lens subpath mutation, which draws a fresh camera end (Veach 1997, sec. 11.3.4)."""

__all__ = [
    "Bidirectional",
    "Caustic",
    "Lens",
    "LensSubpath",
    "MultiChain",
]
