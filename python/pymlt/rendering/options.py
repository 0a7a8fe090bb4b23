"""The options that all ways to start a render share."""

from __future__ import annotations

import functools
import inspect
import numbers
import operator
import os
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, fields
from typing import Any

from .. import _core


@dataclass
class RenderOptions:
    """How long to render, with which random numbers, and where.

    spp, time, error
        samples (for Metropolis integrators: mutations) per pixel, seconds, and the relative error
        of the image (0.02 or "2%"), as `stats["error"]` estimates it. The first one to be reached
        ends the render; with none, the scene's own sample count counts, else 64.
    seed, threads
        The image depends on the seed (0 to 2**64 - 1) but not on the number of threads (0: all
        there are).
    checkpoint, every, overwrite
        a file that keeps the state of the render, renewed after `every` seconds and at the end;
        `resume` goes on from there. The checkpoint of another render is replaced only with
        `overwrite`.
    aovs
        layers of what the camera sees first, in `result.layers`: "albedo", "depth", "position",
        "uv", "geo_normal", "sh_normal", "shape_index", "prim_index", "optical_depth" (of the media
        before it; infinite where a ray does not leave them), "cryptomatte_object",
        "cryptomatte_material". A list, or one string with commas; "n:sh_normal" calls the layer
        "n". Means over 16 camera rays per pixel (indices: of the ray through its middle; -1 where
        there is nothing). float32, (height, width, 3); depth and indices (height, width, 1). The
        Cryptomattes are layers "cryptomatte_object00", "01" and "02" of four channels: two ids,
        each followed by its coverage (see `pymlt.cryptomatte`); "cryptomatte_object/8" has 8 ids
        per pixel in place of 6. None are the layers of the scene's integrator `aov`.
    light_groups
        whether `result.layers` has the light of each lamp: "light." with the id of the emitter,
        else that of its shape, else "light.rest". They add up to the image, and each has a layer of
        its error, such as "error.light.lamp". For the integrators that have the parameter
        `light_groups`.
    light_layers
        layers with the light of classes of paths, {"caustics": "LS+DE"}: regular expressions over
        the letters of a path from the light to the eye. L is the light, S a mirror or smooth glass,
        D any other surface, M a place in a medium, E the eye.
    alpha
        whether the result has `result.alpha`, also if the film's `pixel_format` is not "rgba": how
        much each pixel hides of what lies behind the scene. Masks, thin glass and media count in
        part, a background that is seen counts in full: `hide_emitters` of the integrator leaves it
        out.
    fireflies
        "groups" shows each pixel without what one of the 16 independent groups of the render alone
        has found there (adaptive median of means, Buisine et al. 2021). Sparks go, and so does
        light that is found rarely: the image is darker, by the share `stats["fireflies_removed"]`,
        which vanishes as the render goes on. The layer "unfiltered" has the image as it was.
        "keep" leaves it so.
    denoise
        whether the result's image is denoised by Open Image Denoise, as far as that lowers its
        error (see docs/denoising.md); `error` is then that of the denoised image, which
        `stats["denoised_error"]` and the layer "denoised_error" tell. The layer "noisy" has the
        image as it was rendered. Without `aovs`, "albedo" and "sh_normal" guide the filter. Needs
        the extra `denoise`, and pixels whose noise is independent: the filter "box".
    cluster
        where to render: a `dask.distributed` client or cluster, the address of one
        ("tcp://host:8786"), or "local:N" for N processes of this machine. None is this process.
        The bootstrap runs here. The pixels are the same. Needs the extra `cluster`.
    """

    spp: float | None = None
    time: float | None = None
    error: float | str | None = None
    seed: int = 0
    threads: int = 0
    checkpoint: str | os.PathLike | None = None
    every: float = 60
    overwrite: bool = False
    aovs: str | Sequence[str] | None = None
    light_groups: bool = False
    light_layers: Mapping[str, str] | None = None
    alpha: bool = False
    fireflies: str = "keep"
    denoise: bool = False
    cluster: Any = None

    def __post_init__(self):
        for name in ("spp", "time", "every"):
            setattr(self, name, number(name, getattr(self, name)))
        self.error = relative_error(self.error)
        self.seed = integer("seed", self.seed, 2**64)
        self.threads = integer("threads", self.threads, 4097)
        if self.fireflies not in ("keep", "groups"):
            raise _core.UsageError(
                f"fireflies is {self.fireflies!r}, but should be 'keep' or 'groups'"
            )
        if self.checkpoint is not None:
            self.checkpoint = os.fspath(self.checkpoint)
            if not self.checkpoint:
                raise _core.UsageError("checkpoint is '', but should be the name of a file")
        if self.aovs is not None and not isinstance(self.aovs, str):
            self.aovs = ",".join(map(str, self.aovs))


def takes_options(function: Callable, *, fixed: tuple[str, ...] = ()) -> Callable:
    """A function whose keyword `options` is a RenderOptions, as one with a keyword for each option.

    Those that are `fixed` cannot be given. What RenderOptions says about its fields takes the place
    of a line <options> in the docstring.
    """
    signature = inspect.signature(function)
    own = [p for p in signature.parameters.values() if p.name != "options"]
    keyword = inspect.Parameter.KEYWORD_ONLY
    added = [
        inspect.Parameter(f.name, keyword, default=f.default, annotation=f.type)
        for f in fields(RenderOptions)
        if f.name not in fixed
    ]
    names = {p.name for p in added}
    ordered = sorted([*added, *own], key=lambda p: p.kind)
    signature = signature.replace(parameters=ordered)

    @functools.wraps(function)
    def call(*args, **kwargs):
        try:
            signature.bind(*args, **kwargs)
        except TypeError as error:
            raise TypeError(f"{function.__name__}() {error}") from None
        options = {name: kwargs.pop(name) for name in names & kwargs.keys()}
        return function(*args, **kwargs, options=RenderOptions(**options))

    sections = inspect.getdoc(RenderOptions).partition("\n\n")[2]
    call.__doc__ = (inspect.getdoc(function) or "").replace("<options>", sections)
    call.__signature__ = signature
    return call


def number(name: str, value) -> float | None:
    if value is None:
        return None
    if not isinstance(value, numbers.Real) or isinstance(value, bool):
        raise _core.UsageError(f"{name} is {value!r}, but should be a number")
    try:
        return float(value)
    except OverflowError:
        raise _core.UsageError(f"{name} is too large a number") from None


def relative_error(value: float | str | None) -> float | None:
    """A share up to 1, 0.05, or percent, "5%". Raises UsageError for what is neither."""
    (flag,) = (flag for flag in _core.render_flags() if flag.name == "error")
    if isinstance(value, str) and value.endswith("%"):
        try:
            return flag.read(value)
        except _core.UsageError as error:
            raise _core.UsageError(f"error {error}") from None
    share = number("error", value)
    return flag.read(repr(share)) if share is not None and share > 1 else share


def light_classes(layers) -> list[tuple[str, str]]:
    """The names and expressions of `light_layers`, also as a list of pairs."""
    try:
        pairs = list(layers.items() if isinstance(layers, Mapping) else layers or ())
        if all(isinstance(text, str) for pair in pairs for text in pair):
            return [(name, expression) for name, expression in pairs]
    except (TypeError, ValueError):
        pass
    raise _core.UsageError(
        f"light_layers is {layers!r}, but should be a dict such as {{'caustics': 'LS+DE'}}"
    )


def seconds(name: str, value) -> float:
    found = number(name, value)
    if found is None or not found >= 0:
        raise _core.UsageError(f"{name} is {value!r}, but should be a number of seconds")
    return found


def integer(name: str, value, end: int) -> int:
    try:
        if not isinstance(value, bool) and 0 <= operator.index(value) < end:
            return operator.index(value)
    except TypeError:
        pass
    raise _core.UsageError(f"{name} is {value!r}, but should be an integer from 0 to {end - 1}")
