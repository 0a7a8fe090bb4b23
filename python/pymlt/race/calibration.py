"""How many samples a program can take in a given time."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

from .. import _core

ENOUGH = 1 / 8  #: of what the budget leaves for samples: how long they take in the last trial
SLOWEST, FASTEST = 2, 8  #: growth from one trial to the next
MOST = 10**9  #: samples per pixel


@dataclass(frozen=True)
class Calibration:
    """CPU seconds of a run of n samples: about fixed + each * n."""

    fixed: float
    each: float
    known: int = 1  #: samples of the run that told

    def samples(self, seconds: float) -> int:
        """How many samples fit into `seconds` CPU seconds; at least one."""
        return max(1, round((seconds - self.fixed) / self.each))

    def after(self, n: int, seconds: float) -> Calibration:
        """What is known after a further run of n samples: a longer one tells better."""
        if n < 0.9 * self.known or seconds <= self.fixed:
            return self
        return Calibration(self.fixed, (seconds - self.fixed) / n, n)


def calibrate(seconds_of: Callable[[int], float], budget: float) -> Calibration:
    """Try growing numbers of samples until they take an eighth of what they are to take.

    `seconds_of` runs a program with a number of samples and returns its CPU seconds. The first
    trial, of a single sample, and the last one tell the two coefficients. Raises RenderError if the
    time does not grow.
    """
    first = seconds_of(1)
    if first >= budget:
        return Calibration(0.0, first)
    goal = ENOUGH * (budget - first)
    n = max(SLOWEST, min(64, int(budget / 2 / max(first, 1e-9))))
    while (grown := seconds_of(n) - first) < goal:
        factor = 2 * goal / grown if grown > 0 else FASTEST
        n = int(n * min(max(factor, SLOWEST), FASTEST))
        if n > MOST:
            raise _core.RenderError("its time does not grow with {spp}")
    each = grown / (n - 1)
    return Calibration(max(0.0, first - each), each, n)
