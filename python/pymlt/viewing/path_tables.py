"""What is said of light paths, as HTML tables."""

from __future__ import annotations

from html import escape

from .. import _core
from ..pictures.tonemapping import encode_srgb
from .page import table
from .pixel_paths import PixelPaths

COLOURS = (
    (66, 135, 245), (240, 140, 40), (60, 180, 110), (230, 70, 70), (170, 110, 230),
    (240, 200, 60), (60, 200, 220), (240, 120, 190), (150, 150, 150),
)  # fmt: skip
WHITE = (255, 255, 255)

#: The letters D and S of a signature in words, by the lobe that scattered.
LOBES = {
    "smooth": "diffuse",
    "reflection": "specular, reflecting",
    "transmission": "specular, transmitting",
}


def colours(found: PixelPaths) -> dict[str, tuple[int, int, int]]:
    """Of each signature; those after the last colour share it."""
    return {
        signature: COLOURS[min(i, len(COLOURS) - 1)]
        for i, signature in enumerate(found.signatures())
    }


def _swatch(shown: tuple[int, int, int]) -> str:
    return f'<b class="swatch" style="background: rgb{shown}"></b>'


def signature_table(found: PixelPaths) -> str:
    if not found.paths:
        return table([[f"No light in {found.samples} samples of pixel {found.pixel}."]])
    rows = [["", "signature", "paths", "share"]]
    shown = colours(found)
    for signature, (count, share) in found.signatures().items():
        rows.append([_swatch(shown[signature]), signature, str(count), f"{100 * share:.1f} %"])
    return table(rows, head=True)


def strategy_table(found: PixelPaths) -> str:
    """Rows: s, vertices from the light; columns: t, from the camera; in percent of the light."""
    if not found.shares:
        return ""
    last_s, last_t = (max(technique[i] for technique in found.shares) for i in range(2))
    rows = [["", *(f"t={t}" for t in range(last_t + 1))]]
    for s in range(last_s + 1):
        cells = [_percent(found.shares.get((s, t))) for t in range(last_t + 1)]
        rows.append([f"<b>s={s}</b>", *cells])
    return table(rows, head=True)


def _percent(share: float | None) -> str:
    if share is None:
        return ""
    return f"{100 * share:.1f}" if share >= 0.0005 else "0"


def vertex_table(path: _core.LightPath) -> str:
    """Each vertex with the densities, per unit of area, of making it from either side."""
    rows = [["", "vertex", "shape", "p light<br>area⁻¹", "p camera<br>area⁻¹"]]
    forward, backward = path.from_light, path.from_camera
    for i, vertex in enumerate(path.vertices):
        place = ", ".join(f"{c:.3g}" for c in vertex["position"])
        kind = LOBES[vertex["lobe"]] if vertex["kind"] == "surface" else vertex["kind"]
        shape = str(vertex["shape"]) if vertex["shape"] >= 0 else ""
        far = "towards " if vertex["infinite"] else ""
        name = f"{escape(str(kind))} vertex<br><small>{far}({place})</small>"
        rows.append([f"x{i}", name, shape, f"{forward[i]:.3g}", f"{backward[i]:.3g}"])
    return table(rows, head=True)


def technique_table(path: _core.LightPath) -> str:
    """p_{s,t} and the weights of every technique that could make the path."""
    rows = [["technique", f"density<br>area<sup>-{path.edges + 1}</sup>", "power", "balance"]]
    power, balance = path.weights("power"), path.weights("balance")
    for s, density in enumerate(path.densities()):
        t = path.edges + 1 - s
        name = f"s={s}, t={t}"
        if path.technique == (s, t):
            name = f"<b>{name}: found it</b>"
        rows.append([name, f"{density:.3g}", f"{power[s]:.3f}", f"{balance[s]:.3f}"])
    return table(rows, head=True)


def path_title(path: _core.LightPath) -> str:
    x, y = path.raster
    found = f", found by s={path.technique[0]}, t={path.technique[1]}" if path.technique else ""
    waves = f"<br>{wavelengths(path)}" if path.wavelengths is not None else ""
    return f'<p class="mlt"><b>{path.signature}</b> at ({x:.2f}, {y:.2f}){found}{waves}</p>'


def colour(path: _core.LightPath) -> tuple[int, int, int]:
    """What the wavelengths of a path show, as bright as can be; white in RGB scenes.

    Where a screen cannot show it, it is mixed with as much white as it takes.
    """
    import numpy as np

    if path.wavelengths is None:
        return WHITE
    light = path.contribution()
    light = light - min(light.min(), 0.0)
    if not 0 < light.max() < np.inf:
        return WHITE
    red, green, blue = np.round(255 * encode_srgb(light / light.max())).astype(int).tolist()
    return red, green, blue


def wavelengths(path: _core.LightPath) -> str:
    """Those that count: the first if the path is dispersed, else all four; "" in RGB scenes."""
    waves = path.wavelengths
    if waves is None:
        return ""
    counted = waves[:1] if path.dispersed else sorted(waves)
    return f"{_swatch(colour(path))} {', '.join(f'{nm:.0f}' for nm in counted)} nm"


def place_table(path: _core.LightPath) -> str:
    """Where a chain is."""
    rows = [["now at", path.signature]]
    if path.wavelengths is not None:
        rows.append(["wavelengths", wavelengths(path)])
    return table(rows)


def path_text(path: _core.LightPath) -> str:
    """All that is known of one path."""
    return path_title(path) + vertex_table(path) + technique_table(path)
