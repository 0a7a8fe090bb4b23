"""Several renders of one scene as one image."""

from __future__ import annotations

import json
import os
from collections.abc import Iterable
from dataclasses import dataclass
from itertools import combinations
from typing import TYPE_CHECKING

from .. import _core
from ..cryptomatte import has_ids
from ..images import read_metadata, read_with_layers
from .result import Result

if TYPE_CHECKING:
    import numpy as np

SPREAD_FROM = 8  #: images whose spread tells how wrong their mean is
BLOCK = 8  #: side in pixels of the blocks of the layer "error_block"
ERRORS = ("error", "error_block")


def merge(renders: Iterable[str | os.PathLike[str] | Result], *, force: bool = False) -> Result:
    """The mean of several renders of one scene, each weighted with its samples.

    With N_i the samples per pixel of render i and I_i its image (for Metropolis integrators b_i
    H_i, its own estimate of the mean of the target times its histogram), the image is sum N_i I_i /
    sum N_i: never weighted with what a render has seen, which would be biased.

    renders
        names of EXR files that pymlt has written, or Results; with different seeds.
    force
        merge renders of different scenes or with different settings, too.

    The result has the layers of the renders, and the Cryptomattes of the first, since of ids there
    are no means. Its layer `error` is the standard error of each pixel,
    `error_block` that of the means over blocks of 8 x 8 pixels: from the spread between the
    renders if there are at least 8, else from the errors of the renders if all of them have one.

    Raises UsageError for renders that do not fit together, FileError for files that are no renders.
    """
    import numpy as np

    parts = [_render(render) for render in renders]
    if not parts:
        raise _core.UsageError("there is nothing to merge")
    _check(parts, force)
    total = sum(part.spp for part in parts)
    weights = [part.spp / total for part in parts]
    names = set.intersection(*(set(part.layers) for part in parts))
    errors = {name for name in names if name in ERRORS or name.startswith("error.")}
    first = parts[0]
    layers = {name: ids for name, ids in first.layers.items() if has_ids(name, first.metadata)}
    layers |= {
        name: _mean([part.layers[name] for part in parts], weights)
        for name in sorted(names.difference(errors, layers))
    }
    if len(parts) >= SPREAD_FROM:
        images = [part.image for part in parts]
        layers["error"] = _spread(images, weights)
        blocks = [_block_means(image) for image in images]
        for name in errors.difference(ERRORS):
            light = [part.layers[name.removeprefix("error.")] for part in parts]
            layers[name] = _spread(light, weights)
        layers["error_block"] = _fill_blocks(_spread(blocks, weights), images[0].shape)
    else:
        for name in errors:
            squares = [np.square(part.layers[name], dtype=np.float64) for part in parts]
            variance = sum(w**2 * s for w, s in zip(weights, squares, strict=True))
            layers[name] = np.sqrt(variance).astype(np.float32)
    seeds = [seed for part in parts for seed in part.seeds]
    metadata = {**first.metadata, "seed": " ".join(seeds), "spp": f"{total:g}"}
    height, width = first.image.shape[:2]
    return Result(
        _mean([part.image for part in parts], weights),
        {"seed": seeds, "spp_done": total, "size": [width, height], "renders": len(parts)},
        json.loads(first.metadata["integrator"]),
        layers,
        metadata,
    )


@dataclass
class _Render:
    name: str
    image: np.ndarray
    layers: dict[str, np.ndarray]
    metadata: dict[str, str]

    @property
    def spp(self) -> float:
        return float(self.metadata["spp"])

    @property
    def seeds(self) -> list[str]:
        """A render that was merged has several."""
        return self.metadata["seed"].split()


def _render(render) -> _Render:
    if isinstance(render, Result):
        return _Render(repr(render), render.image, render.layers, render.metadata)
    path = os.fspath(render)
    metadata = read_metadata(path)
    for name in ("software", "scene", "integrator", "seed", "spp"):
        if name not in metadata:
            raise _core.FileError(
                f"{path}: has no {name!r} in its header; only EXR files that pymlt has rendered "
                "can be merged"
            )
    return _Render(path, *read_with_layers(path), metadata)


def _check(renders: list[_Render], force: bool) -> None:
    first = renders[0]
    for a, b in combinations(renders, 2):
        if common := set(a.seeds) & set(b.seeds):
            raise _core.UsageError(
                f"{a.name} and {b.name} have the same seed {min(common)}, so they show the same "
                "noise; render with different seeds"
            )
    for other in renders[1:]:
        if other.image.shape != first.image.shape:
            raise _core.UsageError(
                f"{first.name} and {other.name} differ in size: {_size(first)} and {_size(other)}"
            )
        for name in () if force else ("frame", "scene", "integrator"):
            values = {part.metadata[name] for part in (first, other) if name in part.metadata}
            if len(values) > 1:
                raise _core.UsageError(
                    f"{first.name} and {other.name} {_difference(name, first, other)}; --force "
                    "(force=True) merges them all the same"
                )
    for render in renders:
        if not render.spp > 0:
            raise _core.UsageError(f"{render.name} has no samples")
        if "denoised" in render.metadata:
            raise _core.UsageError(f"{render.name} is denoised; merge its layer 'noisy'")
        if "fireflies" in render.metadata:
            raise _core.UsageError(f"{render.name} is filtered; merge its layer 'unfiltered'")
        if "mixed" in render.metadata:
            raise _core.UsageError(f"{render.name} is mixed; merge first, and mix what comes of it")


def _size(render: _Render) -> str:
    height, width = render.image.shape[:2]
    return f"{width} x {height}"


def _difference(name: str, a: _Render, b: _Render) -> str:
    if name == "frame":
        return f"are frames {a.metadata[name]} and {b.metadata[name]} of a shot"
    if name == "scene":
        return "are renders of different scenes"
    a, b = (json.loads(render.metadata["integrator"]) for render in (a, b))
    key = next(key for key in {**a, **b} if a.get(key) != b.get(key))
    return f"differ in {key}: {json.dumps(a.get(key))} and {json.dumps(b.get(key))}"


def _mean(images, weights) -> np.ndarray:
    import numpy as np

    total = np.zeros(images[0].shape)
    for image, weight in zip(images, weights, strict=True):
        total += weight * image.astype(np.float64)
    return total.astype(np.float32)


def _spread(images, weights) -> np.ndarray:
    """The standard error of the weighted mean m: sqrt(n / (n - 1) sum w_i^2 (x_i - m)^2).

    D. Gatz and L. Smith, "The standard error of a weighted mean concentration", Atmospheric
    Environment 29 (1995), after W. Cochran, "Sampling techniques", 1977.
    """
    import numpy as np

    mean = _mean(images, weights).astype(np.float64)
    squares = sum(w**2 * (x - mean) ** 2 for x, w in zip(images, weights, strict=True))
    return np.sqrt(len(images) / (len(images) - 1) * squares).astype(np.float32)


def _block_means(image) -> np.ndarray:
    """Blocks at the right and the lower border may be smaller."""
    import numpy as np

    edges = [np.arange(0, extent, BLOCK) for extent in image.shape[:2]]
    sums = np.add.reduceat(np.add.reduceat(image.astype(np.float64), edges[0]), edges[1], axis=1)
    extents = [
        np.diff(np.append(edge, size)) for edge, size in zip(edges, image.shape[:2], strict=True)
    ]
    return sums / np.multiply.outer(*extents)[..., None]


def _fill_blocks(blocks, shape) -> np.ndarray:
    whole = blocks.repeat(BLOCK, axis=0).repeat(BLOCK, axis=1)
    return whole[: shape[0], : shape[1]]
