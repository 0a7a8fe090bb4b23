"""The lecture's examples of quadrature as functions of what a slider sets."""

from __future__ import annotations

from ..lab import quadrature
from .lecture_chart import Chart, Curve, Shown


def integrals(log_n: float, steepness: float) -> Shown:
    """Uniform, stratified and importance sampling of x^k."""
    import numpy as np

    def f(x):
        return x**steepness

    counts = np.unique(np.geomspace(4, 10**log_n, 12).astype(int) // 2 * 2)
    line = quadrature.Technique(lambda rng, n: np.sqrt(1 - rng.random(n)), lambda x: 2 * x)
    ways = {
        "uniform": lambda n, s: quadrature.naive(f, (0, 1), n, seed=s),
        "stratified": lambda n, s: quadrature.stratified(f, (0, 1), n, seed=s),
        "importance, p(x) = 2 x": lambda n, s: quadrature.importance(
            f, line.sample, line.pdf, n, seed=s
        ),
    }
    truth = 1 / (steepness + 1)
    errors = {
        name: np.array(
            [
                np.sqrt(np.mean([(way(n, seed).estimate / truth - 1) ** 2 for seed in range(40)]))
                for n in counts
            ]
        )
        for name, way in ways.items()
    }
    last = ", ".join(f"{name} {100 * error[-1]:.2g} %" for name, error in errors.items())
    text = (
        f"The integral of x^{steepness:g} over [0, 1] is {truth:.4f}. With {counts[-1]} samples "
        f"the error is, over 40 runs: {last}. Four times as many uniform samples halve it; "
        "stratified ones do better where f is smooth."
    )
    curves = [Curve(name, np.log10(error)) for name, error in errors.items()]
    return Shown(text, [Chart("log₁₀ error, by log₁₀ of the samples", np.log10(counts), curves)])


def combination(width: float, lobe: float) -> Shown:
    """A lamp of some width, seen by a lobe of another: sample one, the other, or both."""
    import numpy as np

    lamp = quadrature.Technique.uniform((0.05 - width / 2, 0.05 + width / 2))

    def bell(x):
        return np.exp(-0.5 * (x / lobe) ** 2) / (lobe * np.sqrt(2 * np.pi))

    def f(x):
        return lamp.pdf(x) * bell(x)

    both = [lamp, quadrature.Technique(lambda rng, n: rng.normal(0, lobe, n), bell)]
    n = 4000
    results = {
        "the lamp": quadrature.importance(f, both[0].sample, both[0].pdf, n),
        "the lobe": quadrature.importance(f, both[1].sample, both[1].pdf, n),
        **{h: quadrature.combined(f, both, n // 2, heuristic=h) for h in ("balance", "power")},
    }
    text = f"{n} samples: " + "; ".join(f"{name}: {found}" for name, found in results.items())
    x = np.linspace(-0.6, 0.7, 300)
    shown = [Curve("lamp", both[0].pdf(x)), Curve("lobe", bell(x))]
    weights = quadrature.balance(np.array([both[0].pdf(x), np.maximum(bell(x), 1e-300)]))
    return Shown(
        text + ".",
        [
            Chart("The two densities", x, shown),
            Chart(
                "Their weights by the balance heuristic",
                x,
                [Curve("of lamp samples", weights[0]), Curve("of lobe samples", weights[1])],
            ),
        ],
    )
