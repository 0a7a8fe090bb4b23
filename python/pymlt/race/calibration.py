"""How many samples a program can take in a given time."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

from .. import _core

ENOUGH = 1 / 8  #: of the budget, for the longest trial
GROWTH = 4.0  #: from one trial to the next, at least
MOST = 10**9  #: samples per pixel


@dataclass(frozen=True)
class Calibration:
    """CPU seconds of a run of n samples: about fixed + each * n."""

    fixed: float
    each: float

    def samples(self, seconds: float) -> int:
        """That fit into so many CPU seconds; at least one."""
        return max(1, round((seconds - self.fixed) / self.each))


def calibrate(seconds_of: Callable[[int], float], budget: float) -> Calibration:
    """Try growing numbers of samples until one run takes an eighth of the budget.

    `seconds_of` runs a program with a number of samples and returns its CPU seconds. The last trial
    and the first one, of a single sample, tell the two coefficients. Raises RenderError if the time
    does not grow.
    """
    n, first = 1, seconds_of(1)
    last = first
    while last < ENOUGH * budget:
        per_sample = (last - first) / (n - 1) if n > 1 else last
        goal = n + (2 * ENOUGH * budget - last) / max(per_sample, 1e-9)
        n = int(max(GROWTH * n, min(goal, 64 * n)))
        if n > MOST:
            raise _core.RenderError("its time does not grow with {spp}")
        last = seconds_of(n)
    if n == 1:
        return Calibration(0.0, max(first, 1e-9))
    each = max(last - first, 1e-6 * last) / (n - 1)
    return Calibration(max(0.0, first - each), each)
