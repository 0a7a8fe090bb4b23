# Made by `python -m pymlt._stubs`. Do not edit.
from typing import Any

from .mutation import BuiltIn

built_in: list[type[BuiltIn]]

def mutation_class_name(name: str) -> str: ...
def mutation_schemas() -> list[dict[str, Any]]: ...

class Bidirectional(BuiltIn):
    """The bidirectional mutation, which replaces any piece of the path (Veach 1997, sec.
    11.3.1).
    """

    def __init__(
        self,
    ) -> None: ...

class Lens(BuiltIn):
    """The lens perturbation of paths (L|D)DS*E and LS*E (Veach 1997, sec. 11.3.3.1).

    Parameters
    ----------
    smallest_pixels : float, default 0.1
        Smallest move on the image, in pixels.
    largest_share : float, default 0.1
        Largest move on the image, as a share of its diagonal.
    """

    smallest_pixels: float
    largest_share: float
    def __init__(
        self,
        *,
        smallest_pixels: float = ...,
        largest_share: float = ...,
    ) -> None: ...

class Caustic(BuiltIn):
    """The caustic perturbation of paths (L|D)S*DE (Veach 1997, sec. 11.3.3.2).

    Parameters
    ----------
    smallest_pixels : float, default 0.1
        Smallest move on the image, in pixels.
    largest_share : float, default 0.1
        Largest move on the image, as a share of its diagonal.
    """

    smallest_pixels: float
    largest_share: float
    def __init__(
        self,
        *,
        smallest_pixels: float = ...,
        largest_share: float = ...,
    ) -> None: ...

class MultiChain(BuiltIn):
    """The multi-chain perturbation of paths (L|D)(DS+)+DS*E and L(S+D)+S*E (Veach 1997, sec.
    11.3.3.3).

    Parameters
    ----------
    smallest_pixels : float, default 0.1
        Smallest move on the image, in pixels.
    largest_share : float, default 0.1
        Largest move on the image, as a share of its diagonal.
    """

    smallest_pixels: float
    largest_share: float
    def __init__(
        self,
        *,
        smallest_pixels: float = ...,
        largest_share: float = ...,
    ) -> None: ...

class LensSubpath(BuiltIn):
    """The lens subpath mutation, which draws a fresh camera end (Veach 1997, sec. 11.3.4)."""

    def __init__(
        self,
    ) -> None: ...

__all__ = [
    "Bidirectional",
    "Caustic",
    "Lens",
    "LensSubpath",
    "MultiChain",
]
