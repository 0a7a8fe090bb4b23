"""The type stubs of what is made from tables: `python -m pymlt._stubs`.

Run it after a schema or RenderOptions has changed; a test compares the stubs with what this makes.
"""

from __future__ import annotations

import inspect
import json
import textwrap
from pathlib import Path

from . import _core
from .algorithms.integrators import class_name, integrator_schema
from .algorithms.mutations import mutation_class_name, mutation_schemas
from .algorithms.schemas import documentation, type_of
from .rendering import start

HEAD = "# Made by `python -m pymlt._stubs`. Do not edit.\n"

INTEGRATORS = """\
from collections.abc import Sequence
from typing import Any, Literal

import numpy as np

from .integrator import Integrator
from .mutation import Mutation

def class_name(plugin: str) -> str: ...
def integrator_schema(plugin: str) -> dict[str, Any]: ...
"""

MUTATIONS = """\
from typing import Any

from .mutation import BuiltIn

built_in: list[type[BuiltIn]]

def mutation_class_name(name: str) -> str: ...
def mutation_schemas() -> list[dict[str, Any]]: ...
def sentence(doc: str) -> str: ...
"""

START = """\
import os
from collections.abc import Callable, Iterator, Mapping, Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ..algorithms.integrator import IntegratorLike
from ..formats.loading import SceneLike, SensorLike
from .bands import Bands
from .job import Job
from .result import Replay, Result

"""


def written(default) -> str:
    """A default value as the formatter writes it."""
    return json.dumps(default) if isinstance(default, str) else repr(default)


def class_stub(name: str, base: str, schema: dict) -> str:
    """The stub of a class that is made from a schema."""
    doc = documentation(schema)
    if len(doc) > 88 and "\n" not in doc:
        doc = textwrap.fill(doc, 88)
    doc = textwrap.indent(doc, "    ").lstrip()
    end = '\n    """' if "\n" in doc else '"""'
    lines = [f"class {name}({base}):", f'    """{doc}{end}', ""]
    lines += [f"    {p['name']}: {type_of(p)}" for p in schema["parameters"]]
    arguments = [
        f"        {p['name']}: {type_of(p)} = {written(p['default'])},"
        for p in schema["parameters"]
    ]
    head = ["        *,", *arguments] if arguments else []
    lines += ["    def __init__(", "        self,", *head, "    ) -> None: ..."]
    return "\n".join(line.rstrip() for line in lines) + "\n"


def integrators_stub() -> str:
    """All of algorithms/integrators.pyi."""
    schemas = [integrator_schema(name) for name in _core.names("integrator")]
    names = sorted((class_name(s["name"]) for s in schemas), key=lambda n: (not n.isupper(), n))
    exported = "__all__ = [\n" + "".join(f'    "{name}",\n' for name in names) + "]\n"
    classes = [class_stub(class_name(s["name"]), "Integrator", s) for s in schemas]
    text = HEAD + "\n".join([INTEGRATORS, *classes, exported])
    return text if "np." in text else text.replace("import numpy as np\n\n", "")


def mutations_stub() -> str:
    """All of algorithms/mutations.pyi."""
    names = {mutation_class_name(s["name"]): s for s in mutation_schemas()}
    classes = [class_stub(name, "BuiltIn", schema) for name, schema in names.items()]
    exported = "__all__ = [\n" + "".join(f'    "{n}",\n' for n in sorted(names)) + "]\n"
    return HEAD + "\n".join([MUTATIONS, *classes, exported])


def function_stub(function) -> str:
    """The stub of a function, with the signature that it shows."""
    signature = inspect.signature(function)
    lines = []
    for p in signature.parameters.values():
        if p.kind is p.KEYWORD_ONLY and "*" not in lines:
            lines.append("*")
        name = f"**{p.name}" if p.kind is p.VAR_KEYWORD else p.name
        lines.append(
            f"{name}: {p.annotation}" + ("" if p.default is p.empty else f" = {written(p.default)}")
        )
    arguments = "".join(f"    {line},\n" for line in lines)
    return f"def {function.__name__}(\n{arguments}) -> {signature.return_annotation}: ...\n"


def start_stub() -> str:
    """All of rendering/start.pyi."""
    functions = [f for _, f in inspect.getmembers(start, inspect.isfunction)]
    own = [f for f in functions if f.__module__ == start.__name__]
    return HEAD + START + "".join(map(function_stub, own))


STUBS = {
    "algorithms/integrators.pyi": integrators_stub,
    "algorithms/mutations.pyi": mutations_stub,
    "rendering/start.pyi": start_stub,
}

if __name__ == "__main__":
    for name, make in STUBS.items():
        (Path(__file__).parent / name).write_text(make())
