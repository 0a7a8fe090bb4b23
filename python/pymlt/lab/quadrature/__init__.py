"""Monte Carlo quadrature: naive, stratified, by importance sampling, and by several techniques.

For example::

    from pymlt.lab import quadrature

    quadrature.naive(lambda x: x**2, (0, 1), 10_000)          # 0.333 ± 0.003
    quadrature.stratified(lambda x: x**2, (0, 1), 10_000)     # far closer, for the same work

Functions take numpy arrays: in one dimension of shape (n,), in d dimensions of shape (n, d); and
return n values. A domain is (low, high), or a list of these for several dimensions. The source of
the methods is Veach 1997, chapters 2 and 9.
"""

from .heuristics import HEURISTICS, balance, cutoff, maximum, power
from .multiple import combined
from .single import Estimate, importance, naive, stratified
from .technique import Technique

__all__ = [
    "HEURISTICS",
    "Estimate",
    "Technique",
    "balance",
    "combined",
    "cutoff",
    "importance",
    "maximum",
    "naive",
    "power",
    "stratified",
]
