"""What a render leaves behind."""

from __future__ import annotations

import os
from dataclasses import dataclass, field, replace
from typing import TYPE_CHECKING, NamedTuple

from .. import _core
from ..pictures.denoising import denoise_with_layers
from ..pictures.notebook import figure, png
from ..pictures.output import OutputFile
from ..pictures.techniques import Technique, techniques_of
from ..pictures.tonemapping import Exposure
from .stats import Stats
from .summary import summary

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import ArrayLike, NDArray


@dataclass
class Result:
    """What a render left behind."""

    image: NDArray[np.float32]  #: float32, (height, width, 3), linear Rec. 709, row 0 on top
    stats: Stats  #: the content of stats.json
    integrator: dict  #: type and every parameter, given or default
    layers: dict[str, NDArray[np.float32]] = field(
        repr=False
    )  #: further images that were kept, by name
    metadata: dict[str, str] = field(repr=False)  #: what `write` puts into an EXR header
    half: bool = field(default=False, repr=False)  #: EXR with 16-bit samples, as the film asks

    @property
    def seed(self) -> int | list[str]:
        """Of all random numbers; those of all renders, if several were merged."""
        return self.stats["seed"]

    @property
    def error_map(self) -> NDArray[np.float32] | None:
        """The standard error of each pixel, of the shape of `image`, or None if it is not known.

        It is estimated from the spread of independent groups, and there must be two of them; for a
        denoised image from what the filter makes of two halves of them.
        """
        return self.layers.get("denoised_error" if "noisy" in self.layers else "error")

    @property
    def block_error(self) -> NDArray[np.float32] | None:
        """The standard errors of the means over blocks of 8 x 8 pixels, or None.

        float32, (rows, columns, 3); the blocks at the right and the lower border may be smaller.
        """
        spread = None if "noisy" in self.layers else self.layers.get("error_block")
        return None if spread is None else spread[::8, ::8]

    @property
    def alpha(self) -> NDArray[np.float32] | None:
        """How much each pixel hides of what lies behind the scene, or None.

        float32, (height, width), from 0 to 1; `image` is multiplied by it. A mean over 64 camera
        rays per pixel (16 away from edges), with the filter of the film.
        """
        alpha = self.layers.get("alpha")
        return None if alpha is None else alpha[..., 0]

    @property
    def techniques(self) -> dict[tuple[int, int], Technique]:
        """The images of the techniques (s, t), of a render by `BDPT(techniques=True)`.

        A path of technique (s, t) has s vertices from the light and t from the camera.
        """
        return techniques_of(self.layers)

    def denoise(
        self, *, albedo: ArrayLike | None = None, normal: ArrayLike | None = None
    ) -> Result:
        """The same without most of its noise: a guess of Open Image Denoise, which is biased.

        albedo, normal
            of what each pixel sees first, float, (height, width, 3), to guide the filter; see
            `pymlt.denoise`. None: the layers "albedo" and "normal", if there are such.

        The image as it was is the layer "noisy"; how wrong the result is, is not known: that tells
        a render with `denoise=True`. `merge` refuses it. Raises UsageError without the extra
        `denoise`, and for arrays of other shapes.
        """
        image, layers, metadata = denoise_with_layers(
            self.image, self.layers, self.metadata, albedo=albedo, normal=normal
        )
        return replace(self, image=image, layers=layers, metadata=metadata)

    def write(
        self,
        path: str | os.PathLike[str],
        exposure: Exposure = 0,
        *,
        tonemap: str = "srgb",
        bits: int | None = None,
    ) -> None:
        """Write the image to .exr (settings, seed and version in its header), .hdr, .png, .jpg
        or .tif.

        An .exr and a .png have alpha if there is one, the .png with colours that are not multiplied
        by it; other files show the image over black. An .exr holds the layers too; beside NAME.png,
        NAME.techniques.png shows the techniques, if there are any, for which it needs the extra
        `plots`. `exposure` brightens pictures (.png, .jpg, .tif), in stops, or "auto" as suits the
        image; `tonemap` names their curve (see `pymlt.tonemap`).
        `bits` of each sample of a picture are 8 or 16, or 32 for linear floats in a .tif; see
        `pymlt.write_image`. Raises FileError if it cannot be written, UsageError for an unknown
        curve or extension, and for bits that the format does not have.
        """
        self._file(path, exposure, tonemap, bits).write()

    def save(
        self,
        path: str | os.PathLike[str],
        exposure: Exposure = 0,
        *,
        tonemap: str = "srgb",
        bits: int | None = None,
    ) -> str:
        """The same, but if `path` fails try other places; returns where the image is."""
        where, problem = self._save(path, exposure, tonemap, bits)
        if not where:
            raise _core.FileError(problem)
        return where

    def _save(
        self,
        path: str | os.PathLike[str],
        exposure: Exposure = 0,
        tonemap: str = "srgb",
        bits: int | None = None,
    ) -> tuple[str, str]:
        """Where the image is, or ""; and why it is not at `path`, or ""."""
        return self._file(path, exposure, tonemap, bits).save()

    def _file(
        self, path: str | os.PathLike[str], exposure: Exposure, tonemap: str, bits: int | None
    ) -> OutputFile:
        linear = self.image, self.layers, self.metadata, self.half
        return OutputFile(os.fspath(path), *linear, exposure, tonemap, bits)

    def _repr_png_(self) -> bytes:
        return png(self.image)

    def _repr_html_(self) -> str:
        return figure(self.image, repr(self))

    def __repr__(self) -> str:
        return f"Result({self._summary()})"

    def _summary(self) -> str:
        return summary(self.integrator["type"], self.image, self.stats)


class Groups(NamedTuple):
    """The independent groups of a render: the image is the mean of theirs.

    Direct light that is rendered separately (`direct_samples` of `mlt`) is not in them.
    """

    #: float32, (groups, height, width, 3): what the mean owes to each. May be negative where groups
    #: borrow light from each other, as those of `pssmlt` do.
    images: NDArray[np.float32]
    weights: np.ndarray  #: of each in the mean, 0 for one that has nothing to say yet
    b: np.ndarray  #: by which each image is scaled, for Metropolis integrators; else 0


class Replay(NamedTuple):
    """What one sample of a pixel has seen."""

    raster: tuple[float, float]  #: where on the image, in pixels
    radiance: np.ndarray  #: RGB, as the film got it there
    paths: list[_core.LightPath]  #: what it found

    def __repr__(self) -> str:
        x, y = self.raster
        rgb = ", ".join(f"{c:.4g}" for c in self.radiance)
        return f"Replay(({x:.2f}, {y:.2f}), rgb=({rgb}), {len(self.paths)} paths)"
