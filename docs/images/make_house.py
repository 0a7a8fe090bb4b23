"""Draws the house, docs/images/house.svg: python docs/images/make_house.py

The floors stand from the ground up, each on those that it uses; the line is the way of one light
path through them, from left to right, whose steps docs/house.md lists under the same numbers.
"""

from html import escape
from pathlib import Path

PICTURE = Path(__file__).with_name("house.svg")

FLOORS = [  # from the ground up
    ("base", "errors, random numbers, schemas, plug-ins"),
    ("math", "vectors, warps, spectra, microfacets"),
    ("markov", "the Metropolis step, mixtures, chains"),
    ("image", "pictures, files, filters, films"),
    ("lab", "the lecture's targets and moves"),
    ("scene", "shapes, materials, lights, camera, rays"),
    ("io", "scene files read and built"),
    ("path", "walks, light paths and their densities"),
    ("primary", "random numbers as the state of chains"),
    ("wave", "the same walks, many side by side"),
    ("mutation", "the target L*, mutations, the audit"),
    ("rendering", "renders in progress, units of work"),
    ("integrator", "one file for each algorithm"),
    ("job", "threads, budgets, checkpoints, outputs"),
    ("app", "mlt-render, the command line"),
    ("bindings", "the C++ side as pymlt._core"),
]
ROOF = ("Python: pymlt", "scenes · algorithms · rendering · race · diagnostics · lab · cli")
ROUTE = [  # (floor, what happens there); "<": written on the left
    ("app", "start"),
    ("io", "read, build"),
    ("scene", "scene"),
    ("job", "start a job"),
    ("rendering", "prepare"),
    ("path", "first paths"),
    ("markov", "<resample"),
    ("rendering", "advance"),
    ("markov", "step"),
    ("mutation", "propose"),
    ("path", "walk"),
    ("scene", "intersect"),
    ("mutation", "evaluate"),
    ("markov", "accept"),
    ("image", "splat"),
    ("rendering", "<scale"),
    ("job", "write"),
    ("image", "pixel"),
]

WIDTH, ROW, LEFT, STEP, MARGIN, EAVES = 1000, 46, 330, 35, 20, 92
HEIGHT = EAVES + ROW * len(FLOORS) + MARGIN

STYLE = """
  text { font-family: Helvetica, Arial, "DejaVu Sans", sans-serif; fill: #1d2733 }
  .card { fill: #ffffff } .floor { fill: #eef2f7; stroke: #8895a5 } .roof { fill: #f6dfc8 }
  .name { font-size: 17px; font-weight: bold } .what { font-size: 12.5px }
  .way { fill: none; stroke: #b3261e; stroke-width: 2 } .stop { fill: #b3261e }
  .number { font-size: 12px; font-weight: bold; fill: #ffffff }
  .number, .middle { text-anchor: middle }
  .label { font-size: 12px } .under { fill: #eef2f7 }
  @media (prefers-color-scheme: dark) {
    text { fill: #e6ebf1 } .card { fill: #161c24 } .floor { fill: #232c38; stroke: #5d6b7c }
    .roof { fill: #5a4330 } .under { fill: #232c38 } .way { stroke: #ff8a80 }
    .stop { fill: #ff8a80 } .number { fill: #161c24 }
  }"""


def top_of(floor: str) -> int:
    below = [name for name, _ in FLOORS].index(floor)
    return EAVES + ROW * (len(FLOORS) - 1 - below)


def text(kind: str, x: float, y: float, content: str) -> str:
    return f'<text class="{kind}" x="{x:g}" y="{y:g}">{escape(content)}</text>'


def box(kind: str, x: float, y: float, width: float, height: float) -> str:
    return f'<rect class="{kind}" x="{x:g}" y="{y:g}" width="{width:g}" height="{height:g}"/>'


def roof() -> list[str]:
    corners = f"{MARGIN - 12},{EAVES} {WIDTH - MARGIN + 12},{EAVES} {WIDTH - 190},14 190,14"
    return [
        f'<polygon class="floor roof" points="{corners}"/>',
        text("name middle", WIDTH / 2, 44, ROOF[0]),
        text("what middle", WIDTH / 2, 70, ROOF[1]),
    ]


def floors() -> list[str]:
    drawn = []
    for name, what in FLOORS:
        y = top_of(name)
        drawn.append(box("floor", MARGIN, y, WIDTH - 2 * MARGIN, ROW))
        drawn.append(text("name", MARGIN + 12, y + 20, name))
        drawn.append(text("what", MARGIN + 12, y + 37, what))
    return drawn


def way() -> list[str]:
    stops = [(LEFT + STEP * i, top_of(floor) + ROW / 2) for i, (floor, _) in enumerate(ROUTE)]
    line = " ".join(f"{x:g},{y:g}" for x, y in stops)
    drawn = [f'<polyline class="way" points="{line}"/>']
    for (x, y), (_, label) in zip(stops, ROUTE, strict=True):
        width = 6.6 * len(label.strip("<")) + 4
        start = x - 13 - width if label.startswith("<") else x + 13
        drawn.append(box("under", start, y - 9, width, 18))
        drawn.append(text("label", start + 2, y + 4, label.strip("<")))
    for number, (x, y) in enumerate(stops, 1):
        drawn.append(f'<circle class="stop" cx="{x:g}" cy="{y:g}" r="11"/>')
        drawn.append(text("number", x, y + 4, str(number)))
    return drawn


def picture() -> str:
    parts = [
        f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {WIDTH} {HEIGHT}" role="img">',
        "<title>The floors of pymlt and the way of one light path through them</title>",
        f"<style>{STYLE}\n</style>",
        f'<rect class="card" width="{WIDTH}" height="{HEIGHT}" rx="12"/>',
        *roof(),
        *floors(),
        *way(),
        "</svg>",
    ]
    return "\n".join(parts) + "\n"


if __name__ == "__main__":
    PICTURE.write_text(picture())
