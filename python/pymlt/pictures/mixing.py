"""Light groups: an image with some of its lights brighter, darker or of another colour."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING

from .. import _core
from .output import Contents

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import ArrayLike

PREFIX = "light."  #: of the layers that add up to the image, one for each light group
ORIGINALS = ("unfiltered", "noisy")  #: what they add up to, if there is one of these layers
#: How the names of other layers begin that are not true of other light.
LIT = ("error", "denoised_error", "chains", "samples", "raw.", "weighted.", "spectrum.", *ORIGINALS)
CHANGED = ("denoised", "fireflies")  #: metadata of an image that is not the sum


def mix_layers(
    image: np.ndarray,
    layers: dict[str, np.ndarray],
    metadata: dict[str, str],
    factors: Mapping[str, ArrayLike],
    where: str,
) -> Contents:
    """The sum of all light groups, each times its factor: a number or RGB, 1 if it is not given.

    With factors of 1 alone that is the image bit for bit, as it was before it was denoised or
    filtered. `where` is what errors call it. Raises UsageError for unknown names and for what is
    no factor.
    """
    import numpy as np

    groups = {n.removeprefix(PREFIX): x for n, x in layers.items() if n.startswith(PREFIX)}
    if not groups:
        raise _core.UsageError(f"{where} has no light groups; render with --light-groups")
    for name in factors:
        if name not in groups:
            raise _core.UsageError(
                f"{where} has no light group {name!r}; it has {', '.join(sorted(groups))}"
            )
    given = {name: _checked(name, factor) for name, factor in factors.items()}
    changed = {name: factor for name, factor in given.items() if (factor != 1).any()}
    scaled = {name: light * changed.get(name, 1.0) for name, light in groups.items()}
    kept = {name: x for name, x in layers.items() if not name.startswith(LIT)}
    kept |= {f"{PREFIX}{name}": light.astype(np.float32) for name, light in scaled.items()}
    texts = {name: text for name, text in metadata.items() if name not in CHANGED}
    if not changed:
        original = next((layers[name] for name in ORIGINALS if name in layers), image)
        return Contents(original, kept, texts)
    how = " ".join(f"{n}={','.join(f'{x:g}' for x in f.flat)}" for n, f in changed.items())
    texts["mixed"] = "; ".join(filter(None, [metadata.get("mixed"), how]))
    total = np.sum(list(scaled.values()), axis=0, dtype=np.float64)
    return Contents(total.astype(np.float32), kept, texts)


def _checked(name: str, given: ArrayLike) -> np.ndarray:
    import numpy as np

    try:
        factor = np.asarray(given, dtype=np.float64)
    except (TypeError, ValueError):
        factor = np.array(np.nan)
    if factor.shape not in ((), (3,)) or not (np.isfinite(factor) & (factor >= 0)).all():
        raise _core.UsageError(
            f"the factor of {name!r} is {given!r}, but should be a number that is not negative, or "
            "three of them for red, green and blue"
        )
    return factor
