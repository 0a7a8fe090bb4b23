"""The type stubs of the classes that are made from schemas: `python -m pymlt._stubs`.

Run it after a schema has changed; a test compares the stubs with what this makes.
"""

from __future__ import annotations

import json
import textwrap
from pathlib import Path

from . import _core
from .integrators import class_name, integrator_schema
from .mutations import mutation_class_name, mutation_documentation
from .schemas import documentation

HEAD = "# Made by `python -m pymlt._stubs` from the schemas of the plug-ins. Do not edit.\n"

BASE = '''\
class Integrator:
    """A light transport algorithm: a name and its parameters."""

    @property
    def name(self) -> str: ...
    def to_dict(self) -> dict[str, Any]: ...

def class_name(plugin: str) -> str: ...
def integrator_schema(plugin: str) -> dict[str, Any]: ...
'''

MUTATIONS = '''\
class Mutation:
    """A way of changing a light path. Subclass it to write one in Python."""

    @property
    def name(self) -> str: ...
    def suitability(self, x: LightPath) -> float:
        """The weight with which it takes part in the choice: 1, or 0 where it cannot act on x."""

    def propose(self, x: LightPath, rng: np.random.Generator) -> LightPath | None:
        """Another path y, made by `x.with_vertices(...)`, or None."""

    def density(self, x: LightPath, y: LightPath) -> float:
        """T(x -> y) in the product-area measure of the vertices that y has and x has not."""

def mutation_class_name(name: str) -> str: ...
def mutation_documentation(kind: dict[str, Any]) -> str: ...
def weighted(
    mutations: Sequence[Mutation | tuple[Mutation, float]],
) -> dict[Mutation, float]: ...
def parameters(
    mutations: Sequence[Mutation | tuple[Mutation, float]],
) -> dict[str, bool | float]: ...
def parameter_names() -> list[str]: ...
def written_in_python(
    mutations: Sequence[Mutation | tuple[Mutation, float]],
) -> list[tuple[Mutation, float]]: ...

class AuditTest(NamedTuple):
    function: str
    expected: bool
    change: float
    error: float
    z: float
    p: float
    adjusted_p: float

class Audit:
    verdict: Literal["right", "wrong", "inconclusive"]
    reason: str
    tests: list[AuditTest]
    steps: int
    accepted: int
    effective_samples: float
    text: str

    def __bool__(self) -> bool: ...
    def summary(self) -> str: ...

def audit(
    what: Mutation | Integrator,
    scene: Scene | dict[str, Any] | str | PathLike[str],
    *,
    paths: int = ...,
    seed: int = ...,
    threads: int = ...,
    significance: float = ...,
    max_depth: int | None = ...,
) -> Audit: ...
'''

TYPES = {"boolean": "bool", "integer": "int", "float": "float", "string": "str"}
SEQUENCES = {
    "point or vector": "tuple[float, float, float] | list[float] | np.ndarray",
    "transform": "np.ndarray | list[list[float]]",
    "list of mutations": "Sequence[Mutation | tuple[Mutation, float]]",
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
    lines = []
    if "Sequence[" in body:
        lines += ["from collections.abc import Sequence"]
    if typing := [name for name in ("Any", "Literal", "NamedTuple") if name in body]:
        lines += [f"from typing import {', '.join(typing)}"]
    if "np." in body:
        lines += ["", "import numpy as np"]
    if "Mutation " in body and "class Mutation" not in body:
        lines += ["", "from .mutations import Mutation"]
    return "\n".join(lines) + "\n"


def integrators_stub() -> str:
    """All of integrators.pyi."""
    schemas = [integrator_schema(name) for name in _core.names("integrator")]
    names = sorted((class_name(s["name"]) for s in schemas), key=lambda n: (not n.isupper(), n))
    exported = "__all__ = [\n" + "".join(f'    "{name}",\n' for name in names) + "]\n"
    body = "\n".join([BASE, *map(class_stub, schemas), exported])
    return f"{HEAD}{imports(body)}\n{body}"


def mutation_stub(kind: dict) -> str:
    """The stub of one mutation's class."""
    doc = textwrap.indent(mutation_documentation(kind), "    ").lstrip()
    end = '\n    """' if "\n" in doc else '"""'
    return f'class {mutation_class_name(kind["name"])}(Mutation):\n    """{doc}{end}\n'


def mutations_stub() -> str:
    """All of mutations.pyi."""
    kinds = _core.mutation_kinds()
    names = [mutation_class_name(kind["name"]) for kind in kinds]
    exported = "__all__ = [\n" + "".join(f'    "{n}",\n' for n in sorted(names)) + "]\n"
    body = "\n".join([MUTATIONS, *map(mutation_stub, kinds), exported])
    head = "from collections.abc import Sequence\nfrom os import PathLike\n"
    head += "from typing import Any, Literal, NamedTuple\n\n"
    head += "import numpy as np\n\nfrom ._core import LightPath, Scene\n"
    head += "from .integrators import Integrator\n"
    return f"{HEAD}{head}\n{body}"


STUBS = {"integrators.pyi": integrators_stub, "mutations.pyi": mutations_stub}

if __name__ == "__main__":
    for name, make in STUBS.items():
        Path(__file__).with_name(name).write_text(make())
