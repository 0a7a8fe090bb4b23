"""A scene dict as Mitsuba 3 XML."""

from __future__ import annotations

import functools
from pathlib import Path
from typing import Any
from xml.etree import ElementTree as ET

from .. import _core

SPECTRAL_LISTS = ("values", "wavelengths")  #: of the plug-ins regular and irregular


def to_xml(scene: dict[str, Any], folder: Path) -> str:
    """The text of a scene file that lies in `folder`; names of files there become relative."""
    root = ET.Element("scene", version="3.0.0")
    for name, value in scene.items():
        if name != "type":
            _plugin(root, name, value, folder, named="id")
    ET.indent(root)
    return ET.tostring(root, encoding="unicode") + "\n"


def _plugin(
    parent: ET.Element, name: str, plugin: dict[str, Any], folder: Path, *, named: str
) -> None:
    if plugin["type"] == "ref":
        ET.SubElement(parent, "ref", {"id": plugin["id"], "name": name})
        return
    tag = family(plugin["type"], name)
    element = ET.SubElement(parent, tag, {"type": plugin["type"], named: name})
    if "id" in plugin:
        element.set("id", plugin["id"])
    for key, value in plugin.items():
        if key not in ("type", "id"):
            _value(element, key, value, folder)


def _value(parent: ET.Element, name: str, value: Any, folder: Path) -> None:
    if isinstance(value, dict) and value["type"] == "rgb":
        numbers = value["value"]
        text = _numbers(numbers) if isinstance(numbers, list) else repr(numbers)
        ET.SubElement(parent, "rgb", name=name, value=text)
    elif isinstance(value, dict) and value["type"] == "spectrum":
        text = _spectrum(value["value"])
        ET.SubElement(parent, "spectrum", name=name, value=text)
    elif isinstance(value, dict) and value["type"] == "animation":
        animation = ET.SubElement(parent, "animation", name=name)
        for time, key in value.items():
            if time != "type":
                _value(animation, "value", key, folder)
                animation[-1].attrib = {"time": str(time)} | {
                    k: v for k, v in animation[-1].attrib.items() if k != "name"
                }
    elif isinstance(value, dict):
        _plugin(parent, name, value, folder, named="name")
    elif isinstance(value, list) and name in SPECTRAL_LISTS:
        ET.SubElement(parent, "string", name=name, value=_numbers(value))
    elif isinstance(value, list):
        ET.SubElement(parent, "point", name=name, value=_numbers(value))
    elif isinstance(value, str):
        text = _relative(value, folder) if name == "filename" else value
        ET.SubElement(parent, "string", name=name, value=text)
    elif isinstance(value, bool):
        ET.SubElement(parent, "boolean", name=name, value=str(value).lower())
    elif isinstance(value, int | float):
        tag = "integer" if isinstance(value, int) else "float"
        ET.SubElement(parent, tag, name=name, value=repr(value))
    else:
        _transform(parent, value, name=name)


def _transform(parent: ET.Element, value: Any, **attributes: str) -> None:
    matrix = getattr(value, "matrix", value)
    transform = ET.SubElement(parent, "transform", attributes)
    ET.SubElement(transform, "matrix", value=_numbers(float(v) for v in matrix.ravel()))


def _spectrum(value: Any) -> str:
    """One number, or pairs of a wavelength and a power."""
    if isinstance(value, int | float):
        return repr(float(value))
    return ", ".join(f"{float(wave)!r}:{float(power)!r}" for wave, power in value)


def _numbers(values: Any) -> str:
    return ", ".join(repr(float(value)) for value in values)


def _relative(file: str, folder: Path) -> str:
    path = Path(file).resolve()
    inside = path.is_relative_to(folder.resolve())
    return str(path.relative_to(folder.resolve()) if inside else path)


@functools.cache
def families() -> dict[str, list[str]]:
    """The families that have a plug-in, by its name."""
    found: dict[str, list[str]] = {}
    for name in _core.families():
        for plugin in _core.names(name):
            found.setdefault(plugin, []).append(name)
    return found


def family(plugin: str, name: str) -> str:
    """The element of a plug-in; one of several families is named by the parameter."""
    known = families().get(plugin, [name])
    return name if name in known else known[0]
