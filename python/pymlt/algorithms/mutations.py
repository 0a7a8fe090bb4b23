"""The mutations of `MLT` as classes, made from what the C++ side says about each.

    algo = mlt.MLT(mutations=[(mlt.Bidirectional(), 0.4), (mlt.Lens(largest_share=0.05), 0.6)])

A mutation of your own is a subclass of `Mutation`.
"""

from __future__ import annotations

from .. import _core
from .mutation import BuiltIn
from .parameters import make_class


def mutation_class_name(name: str) -> str:
    """The class of a mutation: "multi_chain" is MultiChain."""
    return "".join(part.capitalize() for part in name.split("_"))


def mutation_schemas() -> list[dict]:
    """The schemas of all mutations, with their docs as sentences."""
    return [{**schema, "doc": sentence(schema["doc"])} for schema in _core.mutations()]


def sentence(doc: str) -> str:
    """What a mutation is, with an article where it has none of its own."""
    return f"A{doc[1:]}" if doc.startswith("another ") else f"The {doc}"


built_in = [
    make_class(
        mutation_class_name(schema["name"]),
        (BuiltIn,),
        __name__,
        schema,
        _switch=schema["switch"],
        _weight_name=schema["weight_name"],
        _weight=schema["weight"],
    )
    for schema in mutation_schemas()
]
globals().update({made.__name__: made for made in built_in})
__all__ = [made.__name__ for made in built_in]
