"""The lecture's examples: what is said of each, and its sliders."""

from __future__ import annotations

from .lecture_chains import mixture, parabola, start_up, tours, two_states
from .lecture_chart import Example, Slider
from .lecture_mixing import acceptance, adaptivity, ergodicity
from .lecture_quadrature import combination, integrals

EXAMPLES = (
    Example(
        "Quadrature",
        "Samples may be spread evenly, one or two to a stratum, or drawn where f is large.",
        (Slider("log₁₀ samples", 1, 4, 0.25, 3), Slider("k of x^k", 0.5, 6, 0.5, 2)),
        integrals,
    ),
    Example(
        "Combined sampling",
        "A lamp is reflected by a glossy surface. Where one of both is narrow, samples of the "
        "other seldom meet it; weights that sum to one take the better of both at each x.",
        (Slider("Lamp", 0.01, 1, 0.01, 0.1), Slider("Lobe", 0.01, 0.5, 0.01, 0.1)),
        combination,
    ),
    Example(
        "Two states",
        "The smallest example: f(b) = 1, and a chain should be in a by the share of f(a).",
        (Slider("f(a)", 1, 20, 0.5, 9), Slider("q(→ a)", 0.05, 0.95, 0.05, 0.5)),
        two_states,
    ),
    Example(
        "Parabola",
        "f(x) = (x - 1/2)² on [0, 1], and a move by up to half of the size either way. Small moves "
        "do not cross the middle, where f is 0.",
        (Slider("Size", 0.02, 2, 0.02, 0.1), Slider("Start", 0, 1, 0.05, 0.9)),
        parabola,
    ),
    Example(
        "Mixture",
        "The same with a uniform proposal in a share of the steps, which finds the other branch.",
        (
            Slider("Uniform", 0, 1, 0.01, 0.1),
            Slider("Size", 0.02, 2, 0.02, 0.1),
            Slider("Start", 0, 1, 0.05, 0.9),
        ),
        mixture,
    ),
    Example(
        "Start-up bias",
        "Chains that all start at one place are not yet where f is; a bootstrap puts them there.",
        (Slider("Start", 0, 1, 0.05, 0.9), Slider("Size", 0.02, 1, 0.02, 0.1)),
        start_up,
    ),
    Example(
        "Tours",
        "Chains that start over and over and end by chance: no start is left to be forgotten.",
        (Slider("Steps", 0.2, 40, 0.2, 4), Slider("Size", 0.02, 1, 0.02, 0.1)),
        tours,
    ),
    Example(
        "Acceptance",
        "How far should a random walk on a normal density move?",
        (Slider("log₁₀ size", -1, 1.8, 0.1, 0.4),),
        acceptance,
    ),
    Example(
        "Adaptivity",
        "A random walk that learns its size: less and less, or for ever?",
        (Slider("Decay", 0, 1, 0.1, 0), Slider("Rate", 0.05, 1, 0.05, 0.3)),
        adaptivity,
    ),
    Example(
        "Ergodicity",
        "f is 1 on two islands and 0 in the gap between them. Does the chain come across?",
        (Slider("Gap", 0.02, 0.5, 0.02, 0.3), Slider("Uniform", 0, 0.3, 0.01, 0)),
        ergodicity,
    ),
)
