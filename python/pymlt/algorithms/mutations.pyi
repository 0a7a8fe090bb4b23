# Made by `python -m pymlt._stubs`. Do not edit.
from typing import Any

from .mutation import BuiltIn

built_in: list[type[BuiltIn]]

def mutation_class_name(name: str) -> str: ...
def mutation_schemas() -> list[dict[str, Any]]: ...
def sentence(doc: str) -> str: ...

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
        smallest_pixels: float = 0.1,
        largest_share: float = 0.1,
    ) -> None: ...

class Caustic(BuiltIn):
    """The caustic perturbation of paths (L|D)S*DE (Veach 1997, sec. 11.3.3.2).

    Parameters
    ----------
    smallest_pixels : float, default 0.1
        Smallest move on the image, in pixels.
    largest_share : float, default 0.1
        Largest move on the image, as a share of its diagonal.
    anisotropic : boolean, default True
        Turn the direction by an ellipse whose image is round, not by a circle.
    """

    smallest_pixels: float
    largest_share: float
    anisotropic: bool
    def __init__(
        self,
        *,
        smallest_pixels: float = 0.1,
        largest_share: float = 0.1,
        anisotropic: bool = True,
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
        smallest_pixels: float = 0.1,
        largest_share: float = 0.1,
    ) -> None: ...

class LensSubpath(BuiltIn):
    """The lens subpath mutation, which draws a fresh camera end (Veach 1997, sec. 11.3.4)."""

    def __init__(
        self,
    ) -> None: ...

class Multiplexed(BuiltIn):
    """The small step in primary sample space, by a technique that can make the path (Otsu et al.
    2017).

    Parameters
    ----------
    step_size : float, default 0.015625
        Largest move of a number in [0, 1).
    """

    step_size: float
    def __init__(
        self,
        *,
        step_size: float = 0.015625,
    ) -> None: ...

class Manifold(BuiltIn):
    """The manifold perturbation of what is lit through specular chains (Jakob & Marschner 2012,
    sec. 5).

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
        smallest_pixels: float = 0.1,
        largest_share: float = 0.1,
    ) -> None: ...

class Propagation(BuiltIn):
    """The propagation of vertices in media along their edges (Pauly et al. 2000, sec. 4.2).

    Parameters
    ----------
    smallest_move : float, default 0.001
        Smallest change of the logarithm of the distance.
    largest_move : float, default 1.0
        Largest change of the logarithm of the distance.
    """

    smallest_move: float
    largest_move: float
    def __init__(
        self,
        *,
        smallest_move: float = 0.001,
        largest_move: float = 1.0,
    ) -> None: ...

class Translucent(BuiltIn):
    """The perturbation of the image position that keeps directions and distances in media and
    behind rough glass (after Gruson et al. 2018).

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
        smallest_pixels: float = 0.1,
        largest_share: float = 0.1,
    ) -> None: ...

class Wavelength(BuiltIn):
    """Another wavelength for the same path; dispersive chains are found again.

    Parameters
    ----------
    smallest_step : float, default 0.0005
        Smallest step, as a share of the visible range in the measure of what the eye sees, or
        of a band.
    largest_step : float, default 0.1
        Largest step, likewise.
    """

    smallest_step: float
    largest_step: float
    def __init__(
        self,
        *,
        smallest_step: float = 0.0005,
        largest_step: float = 0.1,
    ) -> None: ...

__all__ = [
    "Bidirectional",
    "Caustic",
    "Lens",
    "LensSubpath",
    "Manifold",
    "MultiChain",
    "Multiplexed",
    "Propagation",
    "Translucent",
    "Wavelength",
]
