# Made by `python -m pymlt._stubs`. Do not edit.
from typing import Any

from .mutation import BuiltIn

built_in: list[type[BuiltIn]]

def mutation_class_name(name: str) -> str: ...
def mutation_documentation(kind: dict[str, Any]) -> str: ...

class Bidirectional(BuiltIn):
    """The bidirectional mutation, which replaces any piece of the path (Veach 1997, sec.
    11.3.1).
    """

class Lens(BuiltIn):
    """The lens perturbation of paths (L|D)DS*E and LS*E (Veach 1997, sec. 11.3.3.1)."""

class Caustic(BuiltIn):
    """The caustic perturbation of paths (L|D)S*DE (Veach 1997, sec. 11.3.3.2)."""

class MultiChain(BuiltIn):
    """The multi-chain perturbation of paths (L|D)(DS+)+DS*E and L(S+D)+S*E (Veach 1997, sec.
    11.3.3.3).
    """

class LensSubpath(BuiltIn):
    """The lens subpath mutation, which draws a fresh camera end (Veach 1997, sec. 11.3.4)."""

__all__ = [
    "Bidirectional",
    "Caustic",
    "Lens",
    "LensSubpath",
    "MultiChain",
]
