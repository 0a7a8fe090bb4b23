"""The lecture's examples: what is said of each, and its sliders."""

from __future__ import annotations

from .lecture_chains import mixture, parabola, recording, start_up, tours, two_states
from .lecture_chart import Example, Slider
from .lecture_mixing import acceptance, adaptivity, ergodicity
from .lecture_products import blur, reflection
from .lecture_quadrature import combination, integrals

EXAMPLES = (
    Example(
        "Quadrature",
        "Samples may be spread evenly, one or two to a stratum, or drawn where f is large.",
        "uniform: Î = {1}/{n} Σ_{i} f(x_{i})\n"
        "stratified: Î = {1}/{n} Σ_{j} Σ_{i} f(x_{j,i})\n"
        "importance: Î = {1}/{n} Σ_{i} {f(x_{i})}/{p(x_{i})}",
        "Veach 1997, ch. 2; two of the n samples are in each stratum j",
        (Slider("log₁₀ samples", 1, 4, 0.25, 3), Slider("k of x^k", 0.5, 6, 0.5, 2)),
        integrals,
    ),
    Example(
        "Combined sampling",
        "A lamp is reflected by a glossy surface. Where one of both is narrow, samples of the "
        "other seldom meet it; weights that sum to one take the better of both at each x.",
        "Î = Σ_{s} {1}/{n_{s}} Σ_{i} w_{s}(x_{s,i}) {f(x_{s,i})}/{p_{s}(x_{s,i})}\n"
        "w_{s} = {n_{s} p_{s}}/{Σ_{r} n_{r} p_{r}} (balance)\nw_{s} ∝ (n_{s} p_{s})² (power)",
        "Veach & Guibas 1995; Veach 1997, eq. 9.4",
        (Slider("Lamp", 0.01, 1, 0.01, 0.1), Slider("Lobe", 0.01, 0.5, 0.01, 0.1)),
        combination,
    ),
    Example(
        "Two states",
        "The smallest example: f(b) = 1, and a chain should be in a by the share of f(a).",
        "a(x → y) = min(1, {f(y) q(y → x)}/{f(x) q(x → y)})\n"
        "f(x) q(x → y) a(x → y)\n= f(y) q(y → x) a(y → x)",
        "Metropolis et al. 1953, Hastings 1970",
        (Slider("f(a)", 1, 20, 0.5, 9), Slider("q(→ a)", 0.05, 0.95, 0.05, 0.5)),
        two_states,
    ),
    Example(
        "Extended recording",
        "A step can record the state that it has chosen, or both, with the probabilities of being "
        "chosen.",
        "basic: Î = {1}/{n} Σ_{i} g(x_{i+1})\n"
        "extended: Î = {1}/{n} Σ_{i} (a_{i} g(y_{i}) + (1 − a_{i}) g(x_{i}))",
        "Veach & Guibas 1997, sec. 5.1",
        (Slider("Decades of f", 0, 4, 0.5, 3),),
        recording,
    ),
    Example(
        "Parabola",
        "f(x) = (x - 1/2)² on [0, 1], and a move by up to half of the size either way. Small moves "
        "do not cross the middle, where f is 0.",
        "y = x + s (u − ½)\na(x → y) = min(1, {f(y)}/{f(x)})",
        "Metropolis et al. 1953; u is uniform in [0, 1], s the size",
        (Slider("Size", 0.02, 2, 0.02, 0.1), Slider("Start", 0, 1, 0.05, 0.9)),
        parabola,
    ),
    Example(
        "Mixture",
        "The same with a uniform proposal in a share of the steps, which finds the other branch.",
        "m with the probability α_{m}\na(x → y) = min(1, {f(y) q_{m}(y → x)}/{f(x) q_{m}(x → y)})",
        "Veach 1997, sec. 11.4.1",
        (
            Slider("Uniform", 0, 1, 0.01, 0.1),
            Slider("Size", 0.02, 2, 0.02, 0.1),
            Slider("Start", 0, 1, 0.05, 0.9),
        ),
        mixture,
    ),
    Example(
        "Blur",
        "Samples of f, the brightness of a row of pixels, estimate the integrals of f times any g: "
        "here the pixels of the blurred row.",
        "I_{j} = ∫ f g_{j} = ∫ f · {1}/{n} Σ_{i} g_{j}(x_{i})\ng_{j}(x) = h(x − x_{j})",
        "Veach 1997, sec. 11.2; for n → ∞, and h is a bell",
        (Slider("log₁₀ steps", 2, 4.5, 0.25, 3.5), Slider("Width", 0.5, 6, 0.25, 1.5)),
        blur,
    ),
    Example(
        "Reflection",
        "A glossy surface reflects a sky with a sun in it; here in the plane. The chain knows the "
        "sky alone, and serves all lobes.",
        "I = ∫ L(ω) f_{r}(ω) cos θ dω",
        "Kajiya 1986; the surface has a cosine lobe around the mirror's direction (Phong 1975)",
        (Slider("log₁₀ steps", 2, 4.5, 0.25, 3.5), Slider("log₂ exponent", 0, 10, 0.5, 5)),
        reflection,
    ),
    Example(
        "Start-up bias",
        "Chains that all start at one place are not yet where f is; a bootstrap puts them there.",
        "W_{i} = {f(x_{i})}/{p(x_{i})}\nb = {1}/{N} Σ_{i} W_{i}\n"
        "P(start at x_{i}) = {W_{i}}/{Σ_{j} W_{j}}",
        "Veach & Guibas 1997, sec. 5.1",
        (Slider("Start", 0, 1, 0.05, 0.9), Slider("Size", 0.02, 1, 0.02, 0.1)),
        start_up,
    ),
    Example(
        "Tours",
        "Chains that start over and over and end by chance: no start is left to be forgotten.",
        "P(the tour dies in x) = {κ}/{1 + κ}\nκ = {κ_{0} p(x)}/{f(x)}",
        "Wang, Pollock, Roberts & Steinsaltz 2021",
        (Slider("Steps", 0.2, 40, 0.2, 4), Slider("Size", 0.02, 1, 0.02, 0.1)),
        tours,
    ),
    Example(
        "Acceptance",
        "How far should a random walk on a normal density move?",
        "ρ(k) = {cov(x_{i}, x_{i+k})}/{var(x_{i})}\n"
        "steps for one independent sample = 1 + 2 Σ_{k} ρ(k)",
        "Sokal 1997; the best acceptance is .44 here: Gelman, Roberts & Gilks 1996",
        (Slider("log₁₀ size", -1, 1.8, 0.1, 0.4),),
        acceptance,
    ),
    Example(
        "Adaptivity",
        "A random walk that learns its size: less and less, or for ever?",
        "log s ← log s + r i^{−d} (a − .44)",
        "Andrieu & Thoms 2008; right for d > 0: Roberts & Rosenthal 2007. s is the size, r the "
        "rate, d the decay, a the acceptance of step i",
        (Slider("Decay", 0, 1, 0.1, 0), Slider("Rate", 0.05, 1, 0.05, 0.3)),
        adaptivity,
    ),
    Example(
        "Ergodicity",
        "f is 1 on two islands and low or 0 in the gap between them. Does the chain come across?",
        "{1}/{n} Σ_{i} g(x_{i}) → {∫ f g}/{∫ f}\nif every y with f(y) > 0 can be reached",
        "Veach 1997, sec. 11.2",
        (
            Slider("Gap", 0.02, 0.5, 0.02, 0.3),
            Slider("Uniform", 0, 0.3, 0.01, 0),
            Slider("Bridge", 0, 0.3, 0.01, 0),
        ),
        ergodicity,
    ),
)
