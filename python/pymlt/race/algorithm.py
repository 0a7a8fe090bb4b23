"""The project's own integrators as contestants."""

from __future__ import annotations

import json
from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from typing import Any

from .. import _core
from ..algorithms.integrator import IntegratorLike, as_integrator
from .cpu_time import render_for
from .program import OutsideRenderer, Program
from .run import Conditions, Contestant, Run, Snapshot, finite

Entrant = IntegratorLike | Program
AlgorithmLike = Entrant | tuple[str, Entrant]


@dataclass(frozen=True)
class Algorithm:
    """An integrator in a race."""

    label: str
    integrator: _core.Integrator

    @property
    def settings(self) -> dict[str, Any]:
        """Its type and every parameter, given or default."""
        made: dict[str, Any] = json.loads(self.integrator.settings)
        return made

    def prepare(self, conditions: Conditions) -> None:
        """Nothing to do."""

    def run(self, conditions: Conditions, seed: int) -> Run:
        """A render by CPU time. Raises RenderError if there was no time for a sample."""
        result, seconds, snapshots = render_for(
            conditions.scene,
            self.integrator,
            conditions.budget,
            seed=seed,
            threads=conditions.threads,
            times=conditions.times[:-1],
            watch=conditions.watch,
        )
        spp = result.stats["spp_done"]
        if spp == 0:
            raise _core.RenderError(f"no sample within {conditions.budget:g} CPU seconds")
        image, invalid = finite(result.image)
        return Run(seed, [*snapshots, Snapshot(seconds, image)], spp, invalid)


def parse_algorithm(text: str) -> tuple[str, list[tuple[str, str]]]:
    """From "pssmlt:p_large=0.5,chains=64" the name and the parameters as (name, value)."""
    name, _, rest = text.partition(":")
    parameters = [part.partition("=") for part in rest.split(",") if part.strip()]
    for key, equals, value in parameters:
        if not (key.strip() and equals and value.strip()):
            raise _core.UsageError(
                f"the algorithm {text!r} should look like mlt or pssmlt:p_large=0.5,chains=64"
            )
    return name.strip(), [(key.strip(), value.strip()) for key, _, value in parameters]


def contestants(
    algorithms: Iterable[AlgorithmLike],
    scene: _core.Scene,
    parameters: Sequence[tuple[str, str]] = (),
) -> list[Contestant]:
    """Those that take part, in their order; `parameters` are for all that are given by name.

    Raises UsageError for what is no algorithm, for two of one label, and for none at all.
    """
    if isinstance(algorithms, str | dict):
        raise _core.UsageError(f"algorithms should be a list, such as [{algorithms!r}]")
    made = [_contestant(algorithm, scene, parameters) for algorithm in algorithms]
    labels = [contestant.label for contestant in made]
    if not made:
        raise _core.UsageError("a race needs at least one algorithm")
    if twice := [label for label in labels if labels.count(label) > 1]:
        raise _core.UsageError(
            f"two algorithms are called {twice[0]!r}; write (label, algorithm) to tell them apart"
        )
    return made


def _contestant(
    algorithm: AlgorithmLike, scene: _core.Scene, parameters: Sequence[tuple[str, str]]
) -> Contestant:
    label = ""
    if isinstance(algorithm, tuple):
        if len(algorithm) != 2 or not isinstance(algorithm[0], str):
            raise _core.UsageError(f"{algorithm!r} should be (label, algorithm)")
        label, algorithm = algorithm
    if isinstance(algorithm, Program):
        return OutsideRenderer(label or algorithm.label, algorithm.command)
    label = label or _label(algorithm)
    if isinstance(algorithm, str):
        name, own = parse_algorithm(algorithm)
        return Algorithm(label, as_integrator(scene, name, [*parameters, *own]))
    return Algorithm(label, as_integrator(scene, algorithm))


def _label(algorithm: IntegratorLike) -> str:
    if isinstance(algorithm, _core.Integrator):
        return str(json.loads(algorithm.settings)["type"])
    if isinstance(algorithm, dict):
        given = [f"{key}={value}" for key, value in algorithm.items() if key != "type"]
        return ":".join([str(algorithm.get("type", "?")), *([",".join(given)] if given else [])])
    return algorithm if isinstance(algorithm, str) else repr(algorithm)
