"""What plug-ins there are, and what their parameters mean."""

import json
import textwrap

from .. import _core

TYPES = {"boolean": "bool", "integer": "int", "float": "float", "string": "str"}
SEQUENCES = {
    "point or vector": "tuple[float, float, float] | list[float] | np.ndarray",
    "transform": "np.ndarray | list[list[float]]",
    "transform or animation": "np.ndarray | list[list[float]] | dict",
    "list of mutations": "Sequence[Mutation | tuple[Mutation, float]]",
}


def type_of(parameter: dict) -> str:
    """The annotation of a parameter: a scalar type, or anything for colours and objects."""
    kind = TYPES.get(parameter["type"]) or SEQUENCES.get(parameter["type"], "Any")
    if parameter["choices"]:
        kind = f"Literal[{', '.join(map(json.dumps, parameter['choices']))}]"
    return f"{kind} | None" if parameter["default"] is None and kind != "Any" else kind


def available(family: str | None = None) -> dict[str, list[str]] | list[str]:
    """The plug-ins of a family ("bsdf", "integrator", ...), or of all families as a dict.

    Raises UsageError for an unknown family.
    """
    families = _core.families()
    if family is None:
        return {name: _core.names(name) for name in families}
    if family not in families:
        raise _core.UsageError(
            f"unknown family {family!r}{_core.suggestion(family, families)}",
        )
    return _core.names(family)


def describe(family: str, name: str) -> str:
    """What a plug-in models and which parameters it has, as text.

    Raises SceneError for one that does not exist.
    """
    schema = _core.schema(family, name)
    return f"{family} {name!r}\n\n{documentation(schema)}"


def documentation(schema: dict) -> str:
    """A schema as the text of a docstring."""
    parts = [textwrap.fill(schema["doc"], 92)]
    if schema["parameters"]:
        parts.append("Parameters\n----------")
        parts[-1] += "".join("\n" + _parameter(p) for p in schema["parameters"])
    return "\n\n".join(parts)


def _parameter(parameter: dict) -> str:
    head = f"{parameter['name']} : {parameter['type']}"
    if parameter["default"] is not None:
        head += f", default {parameter['default']!r}"
    doc = parameter["doc"]
    if parameter["choices"]:
        doc += f" One of: {', '.join(parameter['choices'])}."
    return head + "\n" + textwrap.indent(textwrap.fill(doc, 88), "    ")
