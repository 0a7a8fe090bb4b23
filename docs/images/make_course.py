"""Makes the figures of docs/course: python docs/images/make_course.py [FIGURE ...]

Each is the last figure of a script of docs/gallery, which `pymlt lab FIGURE` draws as well. Needs
matplotlib.
"""

import runpy
import sys
from pathlib import Path

import matplotlib as mpl

mpl.use("Agg")
import matplotlib.pyplot as plt

DOCS = Path(__file__).parents[1]
FIGURES = ("quadrature", "combined", "two_states", "parabola", "expected_values", "acceptance")
FIGURES += ("blur", "environment", "start", "adaptive", "ergodicity")


def draw(name: str) -> None:
    target = DOCS / "course" / f"{name.replace('_', '-')}.png"
    plt.show = lambda: plt.savefig(target, dpi=90, bbox_inches="tight")
    runpy.run_path(str(DOCS / "gallery" / f"{name}.py"))
    plt.close("all")


if __name__ == "__main__":
    for name in sys.argv[1:] or FIGURES:
        draw(name)
