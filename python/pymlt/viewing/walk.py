"""A Markov chain of light paths, one step at a time."""

from __future__ import annotations

from typing import Any, NamedTuple

from .. import _core
from ..algorithms.mutations import built_in

MIXTURE = "the mixture"


class Step(NamedTuple):
    """What one mutation did."""

    mutation: str  #: its name; "" if none suited the path
    proposal: _core.LightPath | None  #: None if it found no path that carries light
    acceptance: float
    accepted: bool

    @property
    def outcome(self) -> str:
        if self.proposal is None:
            return "found no path"
        return "accepted" if self.accepted else "rejected"


class Walk:
    """A chain with the target L* of a scene; each step is that of the renderer's kernel."""

    def __init__(self, scene: _core.Scene, start: _core.LightPath, max_depth: int, seed: int = 0):
        self._target = scene.path_target(max_depth=max(max_depth, start.edges))
        self._seed = seed
        self._chain: Any = None
        self._mutation = MIXTURE
        self.path = start
        self.steps = 0
        self.counts: dict[str, list[int]] = {}  #: chosen, found a path, accepted; by mutation
        if not self._target(start) > 0:
            raise _core.UsageError("light cannot take this path, so no chain can start from it")

    def step(self, mutation: str = MIXTURE) -> Step:
        """One step by this mutation alone, or by the mixture of all, equally likely."""
        chosen = [m for m in built_in if mutation in (MIXTURE, m.__name__)]
        if self._chain is None or mutation != self._mutation:
            moves = [(m(), 1.0) for m in chosen]
            self._seed += 1
            self._chain, _ = self._target.metropolis_chains(moves, self.path, 1, self._seed)
            self._mutation = mutation
        trace = self._chain.advance(1, True)
        self.steps += 1
        proposal, state = trace["samples"][0][0], self.path
        self.path = trace["states"][0][0]
        found = bool(trace["weights"][0, 0] > 0) or proposal is not trace["samples"][0][1]
        index = int(trace["moves"][0, 0])
        step = Step(
            chosen[index].__name__ if index >= 0 else "",
            proposal if found and proposal is not state else None,
            float(trace["acceptance"][0, 0]),
            bool(trace["accepted"][0, 0]),
        )
        count = self.counts.setdefault(step.mutation or "none suits", [0, 0, 0])
        for i, happened in enumerate((True, step.proposal is not None, step.accepted)):
            count[i] += happened
        return step


def names() -> list[str]:
    """Of the mutations, after that of their mixture."""
    return [MIXTURE, *(m.__name__ for m in built_in)]
