"""The error that renders claim, against the error that they have."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass

import numpy as np

from .. import _core
from ..algorithms.integrator import IntegratorLike
from ..rendering.result import Result
from ..rendering.start import start
from .metrics import target_luminance

#: In the warnings of a render whose error is carried by few pixels, and of one in which long tours
#: have yet to make many of the mutations.
WARNINGS = ("true error", "some light was found rarely")


@dataclass(frozen=True)
class Calibration:
    """How wrong some renders with different seeds are, and say they are."""

    integrator: str
    true: float  #: root of relMSE, over all renders
    claimed: float  #: root of the mean square of `stats["error"]`
    warned: float  #: the share of `claimed` squared that is of renders which warn of rare light

    @property
    def ratio(self) -> float:
        """Claimed over true error."""
        return self.claimed / self.true


def calibrate(
    scene: _core.Scene,
    integrators: Sequence[IntegratorLike],
    *,
    seeds: Iterable[int],
    spp: float,
    threads: int = 0,
) -> list[Calibration]:
    """Render a scene by each of several unbiased integrators with each seed.

    What relMSE divides by comes from the mean of all images, those of an integrator weighted by how
    well it knows it. Errors are those around the integrator's own mean, so that no reference need
    be better than all of them.
    """
    runs = [
        [start(scene, integrator, spp=spp, seed=seed, threads=threads).result() for seed in seeds]
        for integrator in integrators
    ]
    images = [np.array([target_luminance(result.image) for result in own]) for own in runs]
    weights = [1 / (own.var(axis=0, ddof=1).mean() + 1e-30) for own in images]
    means = [weight * own.mean(axis=0) for weight, own in zip(weights, images, strict=True)]
    truth = sum(means) / sum(weights)
    scale = truth**2 + 0.01 * truth.mean() ** 2
    return [
        _calibration(own, float(np.sqrt((image.var(axis=0, ddof=1) / scale).mean())))
        for own, image in zip(runs, images, strict=True)
    ]


def _calibration(results: list[Result], true: float) -> Calibration:
    squares = np.array([result.stats["error"] ** 2 for result in results])
    warned = [
        any(warning in text for text in result.stats["warnings"] for warning in WARNINGS)
        for result in results
    ]
    return Calibration(
        results[0].stats["integrator"],
        true,
        float(np.sqrt(squares.mean())),
        float(squares[warned].sum() / squares.sum()),
    )
