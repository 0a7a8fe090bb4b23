"""The lecture's laboratory: Metropolis sampling of any function, with the kernel that renders.

For example::

    from pymlt.lab import metropolis

    run = metropolis.run(
        lambda x: (x - 0.5) ** 2 if 0 <= x <= 1 else 0,
        [(metropolis.Uniform(0, 1), 0.1), (metropolis.RandomWalk(0.1), 0.9)],
        x0=0.9,
        n=100_000,
    )
    run.samples, run.acceptance, run.mean(lambda x: x**2)

A target f is any function that is nowhere negative; it need not be normalised. Moves propose a new
state y from the present one x with density q(x -> y). The acceptance
a(x -> y) = min(1, f(y) q(y -> x) / (f(x) q(x -> y))) is formed, and the choice is made, by the one
Metropolis-Hastings step of the C++ side.
"""

from .audit import audit
from .balance import DetailedBalance, detailed_balance
from .moves import AdaptiveWalk, Discrete, Independent, Move, RandomWalk, Symmetric, Uniform
from .reversal import MoveAudit, MoveTest
from .run import run
from .samples import Samples, autocorrelation
from .start import Start, bootstrap
from .targets import Image, Normals, Parabola, PathTarget, Table, Target
from .tours import Tours, tours

__all__ = [
    "AdaptiveWalk",
    "DetailedBalance",
    "Discrete",
    "Image",
    "Independent",
    "Move",
    "MoveAudit",
    "MoveTest",
    "Normals",
    "Parabola",
    "PathTarget",
    "RandomWalk",
    "Samples",
    "Start",
    "Symmetric",
    "Table",
    "Target",
    "Tours",
    "Uniform",
    "audit",
    "autocorrelation",
    "bootstrap",
    "detailed_balance",
    "run",
    "tours",
]
