"""Weights of several techniques (Veach & Guibas 1995; Veach 1997, sec. 9.2).

q[i, j] = n_i p_i(x_j) says how many samples technique i is expected to draw near sample j.
"""

from __future__ import annotations


def balance(q):
    """w_i = q_i / sum of all q_j."""
    return q / q.sum(axis=0)


def power(q, beta: float = 2.0):
    """w_i = q_i^beta / sum of all q_j^beta."""
    scaled = (q / q.max(axis=0)) ** beta
    return scaled / scaled.sum(axis=0)


def cutoff(q, alpha: float = 0.1):
    """As balance, but among those with q_i >= alpha max q_j."""
    import numpy as np

    kept = np.where(q >= alpha * q.max(axis=0), q, 0.0)
    return kept / kept.sum(axis=0)


def maximum(q):
    """All weight to the technique with the largest q_i."""
    import numpy as np

    return (np.arange(len(q))[:, None] == q.argmax(axis=0)).astype(float)


HEURISTICS = {"balance": balance, "power": power, "cutoff": cutoff, "maximum": maximum}
