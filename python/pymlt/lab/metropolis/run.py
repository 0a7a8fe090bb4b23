"""`run`: chains of a target, a mixture of moves and a start.

Other spaces than numbers and Python objects join by a method of the target,
`target.metropolis_chains(moves, x0, chains, seed)`. `moves` are (move, weight) pairs, `x0` and
`chains` are as they were given to `run`, and it returns (engine, form): an object with
`advance(steps, expected_values)` that returns a dict of what `Samples` is made of, and "object".
"""

from __future__ import annotations

import warnings
from collections.abc import Callable, Sequence
from typing import Any

from ... import _core
from ...algorithms.mutation import Mutation
from .moves import Discrete, Independent, Move
from .reversal import unlike_their_reverse
from .samples import Samples
from .start import Start
from .targets import Target

_lab = _core.lab


def run(
    target: Callable[[Any], Any],
    moves: Any,
    x0: Any = None,
    n: int = 1000,
    *,
    expected_values: bool = False,
    seed: int = 0,
    chains: int | None = None,
    vectorized: bool = False,
) -> Samples:
    """Sample a target by a Markov chain of n steps, or by several.

    Parameters
    ----------
    target
        Any function of a state that returns a number, nowhere negative; not normalised. Or one of
        the built-in targets, with which a run needs no Python between its steps. Or
        `scene.path_target()`: then states are light paths, and moves are mutations of these.
    moves
        A move, or a list [(move, weight), ...] of which one is chosen at each step by weight.
    x0
        The first state: a number, an array of numbers, or (with moves written in Python) any
        object. With `Discrete` moves it is an integer. With `chains`, an array or list with one
        start each, or one start for all; or the `Start` that `bootstrap` returned. A target of
        light paths finds a start by itself (`target.bootstrap`) if there is none.
    n
        Steps of each chain.
    expected_values
        False: each step leaves one sample, the state after it. True: it leaves two, the proposal y
        with weight a and the state x before with weight 1 - a. That says the same in the mean, with
        less noise, and what is rejected is not lost.
    seed
        The same seed, the same samples.
    chains
        Number of independent chains. None: one, and arrays without an axis for chains.
    vectorized
        All chains go in lockstep: the target (and moves written in Python) get arrays of the states
        of many chains, shape (chains,) or (chains, dimensions), and return an array.

    Warns of a move in Python that claims to be symmetric and is not, as far as an eighth as many
    proposals as there are steps can tell; `audit` looks closer.
    """
    found, form = _run(target, moves, x0, n, expected_values, seed, chains, vectorized)
    states = found.states
    if form == "object" and chains is not None:
        states = [x for chain in states for x in chain]
    if form is not None:
        for text in unlike_their_reverse(
            target, found.moves, states, form, vectorized, n * _count(chains), _seed(seed)
        ):
            warnings.warn(text, stacklevel=2)
    return found


def _run(target, moves, x0, n, expected_values, seed, chains, vectorized):
    """The Samples, and what their states are; None for what a target's own chains move."""
    pairs = _weighted(moves)
    if n < 1 or int(n) != n:
        raise _core.UsageError(f"n must be a positive number of steps, not {n!r}")
    b = b_error = None
    if x0 is None:
        x0, b, b_error = _found_start(target, chains, seed)
    elif isinstance(x0, Start):
        x0, b, b_error = x0.starts, x0.b, x0.b_error
        chains = len(x0) if chains is None else chains
    if hasattr(target, "metropolis_chains"):
        _count(chains)
        engine, form = target.metropolis_chains(pairs, x0, chains, _seed(seed))
        kind = None
    else:
        if not callable(target):
            raise _core.UsageError(f"the target must be a function of the state, not {target!r}")
        engine, form = _chains(target, pairs, x0, chains, seed, vectorized)
        kind = form
    trace = engine.advance(int(n), expected_values)
    moved_by = [move for move, _ in pairs]
    return Samples._from_trace(trace, form, chains, moved_by, b, b_error), kind


def _found_start(target, chains, seed):
    """(x0, b, b_error) of a target that can find a start by itself."""
    if hasattr(target, "metropolis_chains") and not hasattr(target, "bootstrap"):
        return None, None, None  # that is its own business
    if not hasattr(target, "bootstrap"):
        raise _core.UsageError("x0 is missing: a chain must start somewhere")
    start = target.bootstrap(chains=_count(chains), seed=_seed(seed))
    return start.starts if chains is not None else start.starts[0], start.b, start.b_error


def _weighted(moves) -> list[tuple[Any, float]]:
    """One move, a list of moves, or a list of (move, weight), as the last of these."""
    given = list(moves) if isinstance(moves, Sequence) else [moves]
    if isinstance(moves, tuple):  # (move, weight) without a list around it
        raise _core.UsageError("moves must be a move or a list of (move, weight) pairs")
    pairs = [entry if isinstance(entry, tuple) else (entry, 1.0) for entry in given]
    if not pairs:
        raise _core.UsageError("moves is empty; a chain needs at least one")
    for entry in pairs:
        if len(entry) != 2:
            raise _core.UsageError(f"{entry!r} is not a (move, weight) pair")
        move, weight = entry
        if not hasattr(move, "propose") and not hasattr(move, "_native"):
            raise _core.UsageError(
                f"{move!r} is not a move; use one of pymlt.lab.metropolis, a subclass of Move, or "
                "Symmetric(function)"
            )
        if not 0 <= float(weight) < float("inf"):
            raise _core.UsageError(f"the weight of {move!r} is {weight}; it must not be negative")
    if sum(weight for _, weight in pairs) <= 0:
        raise _core.UsageError("the weights of all moves are 0")
    return [(move, float(weight)) for move, weight in pairs]


def _chains(target, pairs, x0, chains, seed, vectorized):
    """The C++ chains, and what their states are: "number", "integer", "array" or "object"."""
    for move, _ in pairs:
        if isinstance(move, Mutation):
            raise _core.UsageError(
                f"{move!r} moves light paths; the target of these is scene.path_target()"
            )
    discrete = any(isinstance(move, Discrete) for move, _ in pairs)
    count = _count(chains)
    numbers = _numbers(x0, chains)
    if numbers is None:
        return _object_chains(target, pairs, x0, chains, count, seed, vectorized), "object"
    form, starts = numbers
    if discrete:
        form = _integers(starts, form)
    if isinstance(target, Target):
        if starts.shape[1] != target.dimensions:
            raise _core.UsageError(
                f"{target!r} needs states of {target.dimensions} numbers, but x0 has "
                f"{starts.shape[1]}"
            )
        target = target._native
    if vectorized:
        _check_vectorized(pairs)
        pairs = [(_Vectorized.of(move), weight) for move, weight in pairs]
    made = [
        (move._native(starts.shape[1]) if hasattr(move, "_native") else move, weight)
        for move, weight in pairs
    ]
    return _lab.number_chains(target, made, starts, form, _seed(seed), vectorized), form


def _count(chains) -> int:
    if chains is None:
        return 1
    if int(chains) != chains or chains < 1:
        raise _core.UsageError(f"chains must be a positive number, not {chains!r}")
    return int(chains)


def _seed(seed) -> int:
    if int(seed) != seed or not 0 <= seed < 2**64:
        raise _core.UsageError(f"seed must be an integer from 0 to 2**64 - 1, not {seed!r}")
    return int(seed)


def _numbers(x0, chains):
    """(form, array of shape (chains, dimensions)), or None if x0 is not made of numbers."""
    import numpy as np

    try:
        array = np.asarray(x0)
    except ValueError:  # a ragged list
        return None
    if array.dtype.kind not in "iufb" or (array.dtype.kind == "b" and array.ndim == 0):
        return None
    count = _count(chains)
    array = array.astype(float)
    if not np.isfinite(array).all():
        raise _core.UsageError("x0 must be finite")
    # An array is one state for each chain if its length says so, else one state for all.
    each = chains is not None and array.ndim > 0 and array.shape[0] == count
    form = "array" if array.ndim - each > 0 else "number"
    if array.ndim - each > 1 or array.size == 0:
        raise _core.UsageError(
            f"x0 has the shape {array.shape}; it should be a number, an array of numbers, or one "
            f"of these for each of {count} chains"
        )
    rows = array if each else np.broadcast_to(array, (count, *array.shape))
    return form, np.ascontiguousarray(rows.reshape(count, -1))


def _integers(starts, form) -> str:
    import numpy as np

    if form != "number" or not np.array_equal(starts, np.floor(starts)):
        raise _core.UsageError("with Discrete moves x0 must be an integer, the index of a state")
    return "integer"


def _object_chains(target, pairs, x0, chains, count, seed, vectorized):
    if vectorized:
        raise _core.UsageError("vectorized needs states that are numbers or arrays of numbers")
    for move, _ in pairs:
        if hasattr(move, "_native"):
            raise _core.UsageError(
                f"{move!r} moves numbers, but x0 is a {type(x0).__name__}; use moves that are "
                "written in Python"
            )
    each = chains is not None and isinstance(x0, list) and len(x0) == count
    starts = x0 if each else [x0] * count
    return _lab.object_chains(target, pairs, starts, _seed(seed))


def _check_vectorized(pairs) -> None:
    for move, _ in pairs:
        if isinstance(move, Move) and not (move._suits_all and not move._adapts):
            raise _core.UsageError(
                f"{move!r} has suitability or adapt, which a vectorized run cannot use"
            )


class _Vectorized:
    """An Independent move that samples for many chains at once."""

    def __init__(self, move):
        self.move = move
        self.symmetric, self._suits_all, self._adapts = False, True, False

    @staticmethod
    def of(move):
        return _Vectorized(move) if isinstance(move, Independent) else move

    def propose(self, x, rng):
        return self.move.sample(rng, len(x))

    def density(self, x, y):
        return self.move.pdf(y)
