"""The type stubs of the classes that are made from schemas: `python -m pymlt._stubs`.

Run it after a schema has changed; a test compares the stubs with what this makes.
"""

from __future__ import annotations

import json
import textwrap
from pathlib import Path

from . import _core
from .integrators import class_name
from .schemas import documentation

HEAD = "# Made by `python -m pymlt._stubs` from the schemas of the plug-ins. Do not edit.\n"

BASE = '''\
class Integrator:
    """A light transport algorithm: a name and its parameters."""

    @property
    def name(self) -> str: ...
    def to_dict(self) -> dict[str, Any]: ...

def class_name(plugin: str) -> str: ...
'''

TYPES = {"boolean": "bool", "integer": "int", "float": "float", "string": "str"}
SEQUENCES = {
    "point or vector": "tuple[float, float, float] | list[float] | np.ndarray",
    "transform": "np.ndarray | list[list[float]]",
}


def type_of(parameter: dict) -> str:
    """The annotation of a parameter: a scalar type, or anything for colours and objects."""
    kind = TYPES.get(parameter["type"]) or SEQUENCES.get(parameter["type"], "Any")
    if parameter["choices"]:
        kind = f"Literal[{', '.join(map(json.dumps, parameter['choices']))}]"
    return f"{kind} | None" if parameter["default"] is None and kind != "Any" else kind


def class_stub(schema: dict) -> str:
    """The stub of one integrator's class."""
    doc = textwrap.indent(documentation(schema), "    ").lstrip()
    lines = [f"class {class_name(schema['name'])}(Integrator):", f'    """{doc}', '    """', ""]
    lines += [f"    {p['name']}: {type_of(p)}" for p in schema["parameters"]]
    arguments = [f"        {p['name']}: {type_of(p)} = ...," for p in schema["parameters"]]
    if arguments:
        lines += [
            "    def __init__(",
            "        self,",
            "        *,",
            *arguments,
            "    ) -> None: ...",
        ]
    else:
        lines += ["    def __init__(self) -> None: ..."]
    return "\n".join(line.rstrip() for line in lines) + "\n"


def imports(body: str) -> str:
    """What the stubs use, sorted as ruff sorts it."""
    typing = [name for name in ("Any", "Literal") if name in body]
    lines = [f"from typing import {', '.join(typing)}"]
    if "np." in body:
        lines += ["", "import numpy as np"]
    return "\n".join(lines) + "\n"


def integrators_stub() -> str:
    """All of integrators.pyi."""
    schemas = [_core.schema("integrator", name) for name in _core.names("integrator")]
    names = sorted((class_name(s["name"]) for s in schemas), key=lambda n: (not n.isupper(), n))
    exported = "__all__ = [\n" + "".join(f'    "{name}",\n' for name in names) + "]\n"
    body = "\n".join([BASE, *map(class_stub, schemas), exported])
    return f"{HEAD}{imports(body)}\n{body}"


if __name__ == "__main__":
    Path(__file__).with_name("integrators.pyi").write_text(integrators_stub())
