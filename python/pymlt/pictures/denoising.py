"""Denoising, by Intel's Open Image Denoise through the package pyoidn."""

from __future__ import annotations

from typing import TYPE_CHECKING

from .. import _core
from .._extras import import_extra
from .halves import Mixture, Pair, best_mixture
from .output import Contents
from .tonemapping import split_alpha

if TYPE_CHECKING:
    from collections.abc import Iterable

    import numpy as np
    from numpy.typing import ArrayLike, NDArray

# Layers that guide the filter, by the names under which renderers write them.
GUIDES = {"albedo": ("albedo",), "normal": ("normal", "sh_normal")}


def denoise(
    image: ArrayLike,
    *,
    albedo: ArrayLike | None = None,
    normal: ArrayLike | None = None,
    clean_guides: bool = False,
) -> NDArray[np.float32]:
    """An image without most of its noise, as a neural network guesses it.

    The result is biased: it looks better, and is no estimate of the light any more. Not for
    comparisons with a reference, nor for `merge`.

    image
        linear radiance of shape (height, width) or (height, width, channels); a second or fourth
        channel is alpha and stays. What is negative, infinite or no number counts as black.
    albedo
        reflectance of what each pixel sees first, 0 to 1, (height, width, 3): keeps textures.
    normal
        its unit normal in world or camera space, (height, width, 3): keeps edges. Needs `albedo`.
    clean_guides
        these have no noise themselves, so that the filter may follow each detail of them.

    Returns float32 of the shape of `image`. The filter is "RT" of Open Image Denoise for HDR images
    (https://www.openimagedenoise.org; a U-Net that was trained on path tracing). Raises UsageError
    without the extra `denoise`, and for arrays of other shapes.
    """
    import numpy as np

    oidn = import_extra("pyoidn", "denoise", "denoising")
    given = np.asarray(image, dtype=np.float32)
    pixels = given if given.ndim == 3 else given[..., None]
    if pixels.ndim != 3 or pixels.size == 0:
        raise _core.UsageError(
            f"an image of shape {given.shape} was given, but (height, width, channels) is needed"
        )
    if normal is not None and albedo is None:
        raise _core.UsageError("the filter takes a normal only beside an albedo")
    light, alpha = split_alpha(pixels)
    colour = np.repeat(light, 3 // light.shape[2], axis=2)
    guides = {
        name: _guide(name, guide, colour.shape)
        for name, guide in (("albedo", albedo), ("normal", normal))
        if guide is not None
    }
    colour = np.nan_to_num(colour, nan=0, posinf=0).clip(min=0)
    try:
        found = oidn.denoise(colour, **guides, hdr=True, clean_aux=clean_guides and bool(guides))
    except RuntimeError as error:
        raise _core.RenderError(f"Open Image Denoise: {error}") from None
    found = found if light.shape[2] == 3 else found.mean(axis=2, keepdims=True)
    return np.concatenate([found, alpha], axis=2).reshape(given.shape)


def guides_of(
    layers: dict[str, np.ndarray],
    *,
    albedo: ArrayLike | None = None,
    normal: ArrayLike | None = None,
) -> dict[str, ArrayLike]:
    """What guides the filter, as arguments of `denoise`: layers of an image, or what is given.

    A layer of normals without an albedo does not help, and is left out.
    """
    found: dict[str, ArrayLike] = {}
    for guide, names in GUIDES.items():
        present = [layers[name] for name in names if name in layers]
        if present:
            found[guide] = present[0]
    found |= {k: g for k, g in (("albedo", albedo), ("normal", normal)) if g is not None}
    return found if "albedo" in found or normal is not None else {}


def denoise_with_layers(
    image: np.ndarray,
    layers: dict[str, np.ndarray],
    metadata: dict[str, str],
    *,
    albedo: ArrayLike | None = None,
    normal: ArrayLike | None = None,
) -> Contents:
    """The same for what a file or a render holds: its layers guide the filter, or what is given.

    The image itself becomes the layer "noisy"; `metadata` say that it was denoised.
    """
    chosen = guides_of(layers, albedo=albedo, normal=normal)
    clean = denoise(image, albedo=chosen.get("albedo"), normal=chosen.get("normal"))
    return Contents(clean, layers | {"noisy": image}, metadata | {"denoised": how(chosen)})


def denoise_halves(
    image: np.ndarray, raw: Pair, robust: Pair, layers: dict[str, np.ndarray]
) -> Mixture:
    """A render, mixed with what the filter makes of its halves, and how wrong that is.

    raw, robust
        its halves as they are, and without fireflies.
    layers
        its "error", and what guides the filter.
    """
    guides = guides_of(layers)

    def filtered(pair: Pair) -> Pair:
        return Pair(*(denoise(half, **guides) for half in pair))

    return best_mixture(image, layers["error"], raw, robust, (filtered(raw), filtered(robust)))


def how(guides: Iterable[str]) -> str:
    """What a file says about its denoising."""
    from importlib.metadata import version

    how = f"Open Image Denoise, pyoidn {version('pyoidn')}"
    return how + (f", guided by {' and '.join(sorted(guides))}" if guides else "")


def _guide(name: str, guide: ArrayLike, shape: tuple[int, ...]) -> np.ndarray:
    import numpy as np

    pixels = np.asarray(guide, dtype=np.float32)
    if pixels.shape != shape:
        raise _core.UsageError(f"{name} has the shape {pixels.shape}, but should have {shape}")
    low = 0 if name == "albedo" else -1
    return np.nan_to_num(pixels).clip(low, 1)
