"""The laboratory of the lecture: quadrature, and Metropolis sampling on the step that renders.

`metropolis` runs chains on the lecture's examples, `quadrature` estimates integrals, `gallery` has
scripts that draw one figure for each topic.
"""

from . import gallery, metropolis, quadrature

__all__ = ["gallery", "metropolis", "quadrature"]
