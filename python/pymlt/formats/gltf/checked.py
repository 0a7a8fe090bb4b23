"""What pygltflib leaves unchecked: the types of values, and indices."""

from __future__ import annotations

import functools
import math
import reprlib
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import is_dataclass
from types import SimpleNamespace
from typing import Any, TypeVar, Union, get_args, get_origin, get_type_hints

from ... import _core
from ..imported import Imported

Item = TypeVar("Item")
NAMES = {bool: "true or false", float: "a number", int: "an index or a count", str: "a text"}
NAMES[list] = "a list"


def check_types(value: Any, hint: Any, where: str) -> None:
    """Raises SceneError unless JSON, with all in it, is what pygltflib declares a class to hold."""
    if value is None or hint is Any:
        return
    if get_origin(hint) is Union:  # Optional
        hint = get_args(hint)[0]
    if hint.__name__ == "Attributes":  # which declares nothing
        hint = dict[str, int]
    kind = get_origin(hint) or hint
    if not is_kind(value, kind):
        expected = NAMES.get(kind, "an object")
        raise _core.SceneError(f"{where} is {reprlib.repr(value)}, but should be {expected}")
    for inner, inner_hint, name in members(value, hint):
        check_types(inner, inner_hint, f"{where}{name}")


def is_kind(value: Any, kind: type) -> bool:
    """Whole numbers are numbers too; none is negative that counts, none is infinite."""
    if kind is int:
        return type(value) is int and value >= 0
    if kind is float:
        return type(value) in (int, float) and math.isfinite(value)
    return isinstance(value, dict if is_dataclass(kind) else kind)


def members(value: Any, hint: Any) -> Iterator[tuple[Any, Any, str]]:
    """What is in a value: each with its type and how it is named."""
    if isinstance(value, list):
        for number, inner in enumerate(value):
            yield inner, get_args(hint)[0], f"[{number}]"
    elif isinstance(value, dict):
        hints = hints_of(hint) if is_dataclass(hint) else dict.fromkeys(value, get_args(hint)[1])
        for name, inner in value.items():
            yield inner, hints.get(name, Any), f".{name:.80}"


hints_of = functools.cache(get_type_hints)


def at(items: Sequence[Item] | None, index: Any, kind: str) -> Item:
    """The item of an index. Raises SceneError if there is none."""
    count = len(items or ())
    if not items or type(index) is not int or not 0 <= index < count:
        raise _core.SceneError(f"{kind} {reprlib.repr(index)} is not among the {count} of the file")
    return items[index]


def attributes_of(given: Any) -> dict[str, int]:
    """The accessors of the attributes that are there, of a primitive or of a morph target."""
    named = given if isinstance(given, dict) else vars(given)
    return {name: index for name, index in named.items() if index is not None}


def warn_of_others(names: Iterable[str] | None, read: set[str], made: Imported) -> None:
    """Warns of the extensions that are not `read`, among the names that a file gives."""
    for name in sorted(set(names or ()) - read):
        made.warn(f"{name:.80} is left out")


def numbers(value: Any, count: int, name: str) -> list[float]:
    """As `number`, so many of them."""
    check_types(value, list[float], name)
    if len(value) != count:
        raise _core.SceneError(f"{name} has {len(value)} numbers, but should have {count}")
    return [float(v) for v in value]


def number(value: Any, name: str) -> float:
    """A number of an extension, whose types nobody has checked."""
    check_types(value, float, name)
    return float(value)


def texture_info(given: Any, name: str) -> Any:
    """A texture of an extension with the attributes of pygltflib's TextureInfo; None if None."""
    if given is None:
        return None
    check_types(given, dict[str, Any], name)
    info = SimpleNamespace(**{"index": None, "texCoord": None, "extensions": None} | given)
    check_types(info.texCoord, int, f"{name}.texCoord")
    check_types(info.extensions, dict[str, Any], f"{name}.extensions")
    return info
