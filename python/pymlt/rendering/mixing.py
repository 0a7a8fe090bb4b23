"""Light groups of a render or of its file, mixed anew."""

from __future__ import annotations

import json
import os
from dataclasses import replace
from typing import TYPE_CHECKING

from ..images import read_metadata, read_with_layers
from ..pictures.mixing import mix_layers
from .result import Result

if TYPE_CHECKING:
    from numpy.typing import ArrayLike


def mix(render: str | os.PathLike[str] | Result, /, **factors: ArrayLike) -> Result:
    """The picture with some lights brighter, darker or of another colour, without a render.

    render
        the name of an EXR file, or a Result, with light groups: layers "light.NAME", float32,
        (height, width, 3), linear, which add up to the image.
    factors
        by the name of a group, by what its light is multiplied: a number that is not negative, or
        three for red, green and blue. Groups that are not named have 1. A name that Python has no
        keyword for is given as `**{"my-lamp": 2}`.

    The image of the result is the sum of its layers "light.NAME", which are multiplied alike, so
    that it can be mixed again. Layers that say nothing of light stay; others, such as errors, are
    left out. With all factors 1 it is the image bit for bit, as it was before it was denoised.

    Raises UsageError for images without light groups, for unknown names and for what is no factor;
    FileError for a file that cannot be read or is no EXR.
    """
    given = render if isinstance(render, Result) else _read(os.fspath(render))
    where = repr(given) if isinstance(render, Result) else os.fspath(render)
    classes = {text.partition("=")[0] for text in given.integrator.get("light_layers", "").split()}
    layers = {name: layer for name, layer in given.layers.items() if name not in classes}
    mixed = mix_layers(given.image, layers, given.metadata, factors, where)
    stats = {n: given.stats[n] for n in ("seed", "spp_done", "size") if n in given.stats}
    return replace(given, stats=stats, **mixed._asdict())


def _read(path: str) -> Result:
    metadata = read_metadata(path)
    image, layers = read_with_layers(path)
    height, width = image.shape[:2]
    stats = {"seed": metadata.get("seed", "").split(), "size": [width, height]}
    stats["spp_done"] = float(metadata.get("spp", "nan"))
    integrator = json.loads(metadata.get("integrator", '{"type": "unknown"}'))
    return Result(image, stats, integrator, layers, metadata)
