"""The mutations of `MLT` as classes, made from what the C++ side says about each.

    algo = mlt.MLT(mutations=[(mlt.Bidirectional(), 0.4), (mlt.Lens(), 0.3), (mlt.Caustic(), 0.3)])

A mutation of your own is a subclass of `Mutation`.
"""

from __future__ import annotations

import textwrap

from .. import _core
from .mutation import BuiltIn


def mutation_class_name(name: str) -> str:
    """The class of a mutation: "multi_chain" is MultiChain."""
    return "".join(part.capitalize() for part in name.split("_"))


def mutation_documentation(kind: dict) -> str:
    """The docstring of the class of a mutation."""
    return textwrap.fill(f"The {kind['doc']}", 88)


def _make_class(kind: dict) -> type:
    return type(
        mutation_class_name(kind["name"]),
        (BuiltIn,),
        {
            "__doc__": mutation_documentation(kind),
            "__module__": __name__,
            "_name": kind["name"],
            "_switch": kind["switch"],
            "_weight_name": kind["weight_name"],
            "_weight": kind["weight"],
        },
    )


built_in = [_make_class(kind) for kind in _core.mutation_kinds()]
globals().update({made.__name__: made for made in built_in})
__all__ = [made.__name__ for made in built_in]
