"""
Reflection of an environment
============================

How much light does a glossy surface reflect towards the eye? I = ∫ f g over directions, with f the
radiance of the sky and g the lobe of the surface times the cosine. Metropolis quadrature samples f
by a chain that knows nothing of f but its values, and averages g. It is set against importance
sampling with the same number of evaluations: of the lobe, of a table of f, and of both, combined.
The table gives independent samples of the same f, so it wins by what correlation costs; the chain
is for an f of which there is no table.
"""

import matplotlib.pyplot as plt
import numpy as np

from pymlt.lab import gallery, metropolis, quadrature

gallery.style()

# %%
# The upper hemisphere, as (azimuth, cosine of the polar angle): equal areas, so densities are per
# solid angle. A sky, a bright cloud before the sun, and two windows.

WIDTH, HEIGHT = 256, 64
azimuth = (np.arange(WIDTH) + 0.5) * 2 * np.pi / WIDTH
cosine = (np.arange(HEIGHT) + 0.5) / HEIGHT
A, C = np.meshgrid(azimuth, cosine)
sky = 0.3 + 0.5 * (1 - C) ** 2
sky += 10 * np.exp(-(((A - 2.2) / 0.5) ** 2) - ((C - 0.6) / 0.15) ** 2)
sky[(np.abs(A - 4.3) < 0.25) & (np.abs(C - 0.4) < 0.1)] = 5
sky[(np.abs(A - 5.2) < 0.25) & (np.abs(C - 0.4) < 0.1)] = 5
CELL = np.array([2 * np.pi / WIDTH, 1 / HEIGHT])
f = metropolis.Image(sky)  # its coordinates are cells of the map
sky_integral = f.integral * CELL.prod()


def direction(x):
    """The direction at a position on the map, as a unit vector."""
    a, c = (np.asarray(x) * CELL).T
    s = np.sqrt(np.maximum(0, 1 - c**2))
    return np.stack([s * np.cos(a), s * np.sin(a), c], axis=-1)


MIRROR = direction(np.array([[2.4, 0.62]]) / CELL)[0]


def lobe(exponent):
    """Phong's lobe times the cosine: g at positions on the map."""

    def g(x):
        w = direction(x)
        peak = np.maximum(0, w @ MIRROR) ** exponent * (exponent + 1) / (2 * np.pi)
        return np.where(w[:, 2] > 0, peak * w[:, 2], 0)

    return g


# %%
# Techniques for importance sampling draw positions on the map; their densities are per cell.


def sample_sky(rng, n):
    cell = rng.choice(sky.size, n, p=sky.ravel() / sky.sum())
    return np.stack([cell % WIDTH, cell // WIDTH], axis=1) + rng.random((n, 2))


def sky_pdf(x):
    return f(x) / f.integral


def phong(exponent):
    u = np.cross(MIRROR, [0, 0, 1.0])
    u /= np.linalg.norm(u)
    frame = np.stack([u, np.cross(MIRROR, u), MIRROR])

    def sample(rng, n):
        c, a = rng.random(n) ** (1 / (exponent + 1)), 2 * np.pi * rng.random(n)
        s = np.sqrt(1 - c**2)
        w = np.stack([s * np.cos(a), s * np.sin(a), c], axis=1) @ frame
        # Directions below the horizon land outside of the map, where f is 0.
        return np.stack([np.arctan2(w[:, 1], w[:, 0]) % (2 * np.pi), w[:, 2]], axis=1) / CELL

    def pdf(x):
        around = np.maximum(0, direction(x) @ MIRROR) ** exponent
        return around * (exponent + 1) / (2 * np.pi) * CELL.prod()

    return quadrature.Technique(sample, pdf)


MOVES = [
    (metropolis.Uniform((0, 0), (WIDTH, HEIGHT)), 0.2),
    (metropolis.RandomWalk((20, 5), "normal"), 0.8),
]


def chains(n, exponent, repetitions):
    """n evaluations of f in each repetition, 64 of them to find a start."""
    size = np.array([WIDTH, HEIGHT])
    x0 = [
        metropolis.bootstrap(
            f,
            lambda rng, k: rng.random((k, 2)) * size,
            lambda x: np.full(len(x), 1 / size.prod()),
            64,
            seed=seed,
        ).starts[0]
        for seed in range(repetitions)
    ]
    run = metropolis.run(f, MOVES, np.array(x0), n - 64, chains=repetitions, expected_values=True)
    g = lobe(exponent)(run.samples.reshape(-1, 2)).reshape(run.weights.shape)
    return (g * run.weights).sum(axis=1) / (n - 64) * sky_integral


def repeated(estimate, repetitions):
    return np.array([estimate(seed).estimate for seed in range(repetitions)])


N, REPETITIONS = 1024, 64
exponents = 2.0 ** np.arange(0, 11, 2)
errors: dict[str, list[float]] = {
    "Metropolis": [],
    "the lobe": [],
    "a table of the sky": [],
    "both, combined": [],
}
for exponent in exponents:
    g, technique = lobe(exponent), phong(exponent)

    def product(x, g=g):
        return f(x) * g(x) * CELL.prod()

    fine = (np.stack(np.meshgrid(np.arange(WIDTH * 4), np.arange(HEIGHT * 4)), -1) + 0.5) / 4
    truth = product(fine.reshape(-1, 2)).sum() / 16
    found = {
        "Metropolis": chains(N, exponent, REPETITIONS),
        "the lobe": repeated(
            lambda s, t=technique, p=product: quadrature.importance(p, t.sample, t.pdf, N, seed=s),
            REPETITIONS,
        ),
        "a table of the sky": repeated(
            lambda s, p=product: quadrature.importance(p, sample_sky, sky_pdf, N, seed=s),
            REPETITIONS,
        ),
        "both, combined": repeated(
            lambda s, t=technique, p=product: quadrature.combined(
                p, [t, (sample_sky, sky_pdf)], N // 2, seed=s
            ),
            REPETITIONS,
        ),
    }
    for name, values in found.items():
        errors[name].append(np.sqrt(np.mean((values / truth - 1) ** 2)))

# %%

figure, axes = plt.subplots(1, 2, figsize=(11, 4.2), width_ratios=[1.35, 1])
left, right = axes
left.imshow(
    np.minimum(sky, 8) ** 0.45, extent=(0, 360, 0, 1), origin="lower", aspect="auto", cmap="magma"
)
run = metropolis.run(f, MOVES, (90.0, 38.0), 1500)
left.plot(run.samples[:, 0] * 360 / WIDTH, run.samples[:, 1] / HEIGHT, ".", color="white", ms=2)
levels = lobe(64)(
    np.stack(np.meshgrid(np.arange(WIDTH), np.arange(HEIGHT)), -1).reshape(-1, 2) + 0.5
)
levels = levels.reshape(HEIGHT, WIDTH) / levels.max()
left.contour(np.degrees(A), C, levels, levels=[0.1, 0.5, 0.9], colors=gallery.GREEN, linewidths=1)
left.set(title="The sky f, a chain of 1500 steps, and the lobe g (exponent 64)")
left.set(xlabel="azimuth (degrees)", ylabel="cosine of the polar angle")
left.grid(False)
colors = (gallery.GREEN, gallery.BLUE, gallery.ORANGE, gallery.GREY)
for (name, error), color in zip(errors.items(), colors, strict=True):
    right.loglog(exponents, error, "o-", ms=4, color=color, label=name)
right.set(xlabel="exponent of the lobe", title=f"Relative error with {N} evaluations of f")
right.legend(fontsize=9)
plt.show()
