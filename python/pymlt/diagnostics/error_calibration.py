"""The error that renders claim, against the error that they have."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass

import numpy as np

from .. import _core
from ..algorithms.integrator import IntegratorLike
from ..pictures.luminance import target_luminance
from ..rendering.result import Result
from ..rendering.start import start

#: In the warnings of a render whose error is carried by few pixels, and of one whose brightness is
#: not known.
WARNINGS = ("true error", "its amount is not known yet")
#: In the warning of an integrator to which some lights of the scene are invisible.
BLIND = "cannot find the light"


@dataclass(frozen=True)
class Calibration:
    """How wrong some renders with different seeds are, and say they are."""

    integrator: str
    true: float  #: root of relMSE, over all renders
    claimed: float  #: root of the mean square of `stats["error"]`
    warned: float  #: the share of `claimed` squared that is of renders which warn of rare light
    quiet_ratio: float  #: claimed over true error of the others alone; nan if there are none

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
    """Render a scene by each of several integrators with each seed.

    Integrators that warn that they cannot find some light are left out. No reference need be better
    than all of them: the truth is the mean of all images, those of an integrator weighted by how
    well it knows it, but without integrators whose tours wait, which have yet to show some light.
    The square of an error, relative to the truth that the other images tell, is the variance around
    the integrator's own mean; where tours wait, also what that mean differs from the truth by,
    beyond the noise of both.
    """
    runs = [
        [start(scene, integrator, spp=spp, seed=seed, threads=threads).result() for seed in seeds]
        for integrator in integrators
    ]
    runs = [own for own in runs if not any(BLIND in text for text in own[0].stats["warnings"])]
    images = [np.array([target_luminance(result.image) for result in own]) for own in runs]
    means = [own.mean(axis=0) for own in images]
    noise = [own.var(axis=0, ddof=1) / len(own) for own in images]
    waiting = [any(result.stats["tours_waiting"] > 0 for result in own) for own in runs]
    fair = [i for i, waits in enumerate(waiting) if not waits] or range(len(runs))
    shares = _shares(noise, fair)
    truth = sum(share * means[i] for i, share in shares.items())
    truth_noise = sum(share**2 * noise[i] for i, share in shares.items())

    def true_squares(i: int) -> np.ndarray:
        """Of each render, so that their mean is right."""
        n = len(images[i])
        squares = np.zeros(n)
        for k, image in enumerate(images[i]):
            others = truth - shares.get(i, 0) * (image - means[i]) / (n - 1)
            squares[k] = ((image - means[i]) ** 2 * n / (n - 1) / _scale(others)).mean()
        if i not in fair:
            bias = ((means[i] - truth) ** 2 - noise[i] - truth_noise) / _scale(truth)
            squares += max(bias.mean(), 0)
        return squares

    return [_calibration(own, true_squares(i)) for i, own in enumerate(runs)]


def _scale(truth: np.ndarray) -> np.ndarray:
    """What squares of errors are divided by, to be relative."""
    return truth**2 + 0.01 * truth.mean() ** 2


def _shares(noise: list[np.ndarray], chosen: Iterable[int]) -> dict[int, float]:
    """The shares of the chosen means in the truth, by how little noise each has."""
    weights = {i: 1 / (noise[i].mean() + 1e-30) for i in chosen}
    return {i: weight / sum(weights.values()) for i, weight in weights.items()}


def _calibration(results: list[Result], true: np.ndarray) -> Calibration:
    claimed = np.array([result.stats["error"] ** 2 for result in results])
    warned = np.array(
        [
            any(warning in text for text in result.stats["warnings"] for warning in WARNINGS)
            for result in results
        ]
    )
    quiet = ~warned
    return Calibration(
        results[0].stats["integrator"],
        float(np.sqrt(true.mean())),
        float(np.sqrt(claimed.mean())),
        float(claimed[warned].sum() / claimed.sum()),
        float(np.sqrt(claimed[quiet].sum() / true[quiet].sum())) if quiet.any() else float("nan"),
    )
