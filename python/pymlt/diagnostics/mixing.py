"""Have the chains of a Metropolis render converged? R-hat and effective sample size, by ArviZ.

The 16 independent groups of a render are what statisticians call chains. The render is cut into
stretches of equal length, and what a group has seen of an image block in one stretch is a draw.
Consecutive stretches of one group are correlated as its Markov chains are, which effective sample
sizes measure; groups are independent, so R-hat tells whether one of them has seen what others have
not. A. Vehtari, A. Gelman, D. Simpson, B. Carpenter, P.-C. Bürkner, "Rank-normalization, folding,
and localization: an improved R-hat for assessing convergence of MCMC", Bayesian Analysis 2021.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field
from typing import TYPE_CHECKING

from .. import _core
from ..algorithms.integrator import IntegratorLike
from ..formats.loading import SceneLike
from ..pictures.luminance import target_luminance
from ..rendering.progress import progress_bar
from ..rendering.result import Result
from ..rendering.start import start
from ._arviz import import_arviz

if TYPE_CHECKING:
    import numpy as np


@dataclass
class Convergence:
    """How the chains of a render have mixed, block by block."""

    result: Result = field(repr=False)  #: of the whole render
    draws: np.ndarray = field(repr=False)  #: target luminance, (groups, draws, rows, columns)
    rhat: np.ndarray = field(repr=False)  #: (rows, columns); above 1.01 groups have not agreed
    ess: np.ndarray = field(repr=False)  #: of groups x draws, how many count as independent

    def to_arviz(self):
        """The draws as an ArviZ `InferenceData`, for its plots and further diagnostics."""
        return _inference_data(import_arviz("to_arviz"), self.draws)

    def __repr__(self) -> str:
        import numpy as np

        groups, draws = self.draws.shape[:2]
        return (
            f"Convergence({groups} groups x {draws} draws, R-hat up to {np.nanmax(self.rhat):.3g}, "
            f"median effective sample size {np.nanmedian(self.ess):.3g})"
        )


def convergence(
    scene: SceneLike,
    integrator: IntegratorLike | None,
    *,
    spp: float,
    draws: int = 32,
    grid: tuple[int, int] = (12, 16),
    seed: int = 0,
    threads: int = 0,
    progress: bool | Callable[[float], object] | None = None,
) -> Convergence:
    """Render by a Metropolis integrator and tell how its chains have mixed.

    scene, integrator, spp, seed, threads
        as for `start`; `spp` must be enough for as many stretches as there are draws.
    draws
        how many stretches the render is cut into, at least 4 (ArviZ wants that many).
    grid
        (rows, columns) of the image blocks. Blocks that stay black have no R-hat (NaN).

    Each group's own scale b_g is divided out: it comes from the bootstrap, and no chain improves
    it. Its error is part of `Result.error_map`. Needs the extra `arviz`.
    """
    import numpy as np

    arviz = import_arviz("convergence")
    if draws < 4:
        raise _core.UsageError(f"draws is {draws!r}, but at least 4 are needed")
    job = start(scene, integrator, spp=spp / draws, seed=seed, threads=threads)
    seen, work = [], []
    with progress_bar(progress) as show:
        for i in range(1, draws + 1):
            if i > 1:
                job.extend(spp=spp * i / draws)
            job.wait()
            groups = job.groups
            if not groups.b.any():
                raise _core.UsageError("convergence is for Metropolis integrators: it needs chains")
            found = groups.b > 0
            scale = groups.b[found].mean() / groups.b[found]
            means = _block_means(groups.images[found], grid) * scale[:, None, None]
            work.append(job.stats["spp_done"])
            seen.append(means * work[-1])
            show(i / draws, {"spp": f"{work[-1]:.4g}"})
    lengths = np.diff([0, *work])
    if not lengths.all():
        raise _core.UsageError(f"{spp:g} spp are too few for {draws} draws; give more spp")
    sums = np.stack(seen, axis=1)
    values = np.diff(sums, axis=1, prepend=0) / lengths[:, None, None]
    data = _inference_data(arviz, values)
    with np.errstate(divide="ignore", invalid="ignore"):
        rhat, ess = (np.asarray(f(data)["light"]) for f in (arviz.rhat, arviz.ess))
    return Convergence(job.result(), values, rhat, ess)


def _inference_data(arviz, draws: np.ndarray):
    return arviz.from_dict(posterior={"light": draws}, dims={"light": ["row", "column"]})


def _block_means(images: np.ndarray, grid) -> np.ndarray:
    """Means of the target luminance over blocks: (groups, rows, columns)."""
    import numpy as np

    light = target_luminance(images)
    sides = list(zip(grid, light.shape[1:], strict=True))
    if not all(1 <= n <= size for n, size in sides):
        raise _core.UsageError(f"grid is {grid!r}, but the image has {light.shape[1:]} pixels")
    edges = [np.arange(n) * size // n for n, size in sides]
    sums = np.add.reduceat(np.add.reduceat(light, edges[0], axis=1), edges[1], axis=2)
    sizes = [np.diff([*e, size]) for e, (_, size) in zip(edges, sides, strict=True)]
    return sums / np.outer(*sizes)
