"""The light paths through a pixel, and which techniques would find its light."""

from __future__ import annotations

import itertools
from collections import defaultdict
from typing import TYPE_CHECKING, NamedTuple

from .. import _core
from ..algorithms.integrator import as_integrator
from ..rendering.job import Job
from ..rendering.options import RenderOptions

if TYPE_CHECKING:
    import numpy as np


class PixelPaths(NamedTuple):
    """What bidirectional path tracing has found in some samples of a pixel."""

    pixel: tuple[int, int]
    samples: int
    paths: list[_core.LightPath]  #: those with t >= 2, the brightest first
    shares: dict[tuple[int, int], float]  #: of the light, for each technique (s, t)

    def signatures(self) -> dict[str, tuple[int, float]]:
        """How many paths of each signature, and their share of the light; the largest first."""
        found: dict[str, list[float]] = defaultdict(list)
        for path in self.paths:
            found[path.signature].append(brightness(path))
        total = sum(map(sum, found.values())) or 1.0
        ordered = sorted(found.items(), key=lambda item: -sum(item[1]))
        return {signature: (len(values), sum(values) / total) for signature, values in ordered}

    def of(self, signature: str) -> list[_core.LightPath]:
        """Those of one signature, the brightest first."""
        return [path for path in self.paths if path.signature == signature]

    def some(self, most: int) -> list[_core.LightPath]:
        """This number of them, the brightest of each signature in turn."""
        queues: dict[str, list[_core.LightPath]] = {name: [] for name in self.signatures()}
        for path in self.paths:
            queues[path.signature].append(path)
        turns = itertools.zip_longest(*queues.values())
        return [path for turn in turns for path in turn if path is not None][:most]


def brightness(path: _core.LightPath) -> float:
    """The mean of R, G and B of its estimate."""
    return 0.0 if path.estimate is None else float(path.estimate.mean())


def paths_through(
    scene: _core.Scene, pixel: tuple[int, int], samples: int, max_depth: int
) -> PixelPaths:
    """The paths that samples of `bdpt` find. Raises UsageError for a pixel beside the image."""
    integrator = as_integrator(scene, "bdpt", [("max_depth", str(max_depth))])
    job = Job(scene, integrator, RenderOptions(spp=samples, threads=1))
    found = []
    for sample in range(samples):
        paths = job.replay(pixel, sample).paths
        found += [path for path in paths if path.technique[1] >= 2 and brightness(path) > 0]
    found.sort(key=brightness, reverse=True)
    return PixelPaths(pixel, samples, found, technique_shares(found))


def technique_shares(paths: list[_core.LightPath]) -> dict[tuple[int, int], float]:
    """The share of the light that each technique (s, t) brings under the power heuristic.

    A path that was found by any of several techniques, with the weights w of these, stands for all
    that light takes its way: technique s brings w_s / (sum of those w) of it. Techniques with
    t < 2 splat onto other pixels than the sample's, so they are not among those that find here.
    """
    shares: dict[tuple[int, int], float] = defaultdict(float)
    for path in paths:
        weights = path.weights()
        here = float(weights[: path.edges].sum())  # s = 0 ... k - 1: t >= 2
        if not here > 0:
            continue
        for s, weight in enumerate(weights):
            shares[s, path.edges + 1 - s] += brightness(path) * float(weight) / here
    total = sum(shares.values()) or 1.0
    return {technique: share / total for technique, share in shares.items()}


def polyline(path: _core.LightPath, reach: float) -> np.ndarray:
    """The positions of the vertices, from the light; one at infinity stands `reach` away."""
    rows = path.vertices
    points = rows["position"].copy()
    if rows["infinite"][0]:
        points[0] = points[1] + reach * points[0]
    return points
