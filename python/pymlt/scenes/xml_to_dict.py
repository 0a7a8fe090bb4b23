"""The XML of a built-in scene as a Mitsuba dict."""

from __future__ import annotations

from pathlib import Path

from .transforms import Transform


def load(folder: str, **values) -> dict:
    """The scene in this folder of the built-in ones, with values for its <default> parameters."""
    from xml.etree import ElementTree

    path = _folder() / folder / "scene.xml"
    root = ElementTree.parse(path).getroot()
    defaults = {e.get("name"): e.get("value") for e in root.findall("default")}
    assert values.keys() <= defaults.keys()
    values = defaults | values
    for element in root.iter():
        for key, text in element.attrib.items():
            if text.startswith("$"):
                element.set(key, str(values[text[1:]]))
    return {"type": "scene"} | _children(root, path.parent)


def _folder() -> Path:
    """Where the scenes are: in the package as it is installed, or beside it in the repository."""
    here = Path(__file__).resolve().parents[1]
    installed = here / "scene_files"
    return installed if installed.is_dir() else here.parents[1] / "scenes"


def _children(element, folder: Path) -> dict:
    """What stands inside an element, by the name or id it has, or by what it is."""
    children: dict = {}
    for child in element:
        if child.tag == "default":
            continue
        key = child.get("name") or (child.get("id") if child.tag != "ref" else None) or child.tag
        if key in children:
            key = f"{key}_{len(children)}"
        children[key] = _value(child, folder)
    return children


def _value(element, folder: Path):
    match element.tag:
        case "float":
            return float(element.get("value"))
        case "integer":
            return int(element.get("value"))
        case "boolean":
            return element.get("value") == "true"
        case "string":
            is_file = element.get("name") == "filename"
            return str(folder / element.get("value")) if is_file else element.get("value")
        case "rgb":
            numbers = _numbers(element.get("value"))
            return {"type": "rgb", "value": numbers if len(numbers) == 3 else numbers[0]}
        case "point" | "vector":
            return [float(element.get(axis, 0)) for axis in "xyz"]
        case "transform":
            return _transform(element)
        case "animation":
            return {"type": "animation"} | {key.get("time"): _value(key, folder) for key in element}
        case "ref":
            return {"type": "ref", "id": element.get("id")}
    return {"type": element.get("type")} | _children(element, folder)


def _transform(element) -> Transform:
    transform = Transform()
    for step in element:
        transform = _step(step) @ transform
    return transform


def _step(step) -> Transform:
    match step.tag:
        case "translate":
            return Transform.translate([float(step.get(axis, 0)) for axis in "xyz"])
        case "scale":
            rest = step.get("value", 1)
            return Transform.scale([float(step.get(axis, rest)) for axis in "xyz"])
        case "rotate":
            axis = [float(step.get(axis, 0)) for axis in "xyz"]
            return Transform.rotate(axis, float(step.get("angle")))
        case "lookat":
            return Transform.look_at(*(_numbers(step.get(k)) for k in ("origin", "target", "up")))
    raise ValueError(f"<{step.tag}> in the transform of a built-in scene")


def _numbers(text: str) -> list[float]:
    return [float(number) for number in text.split(",")]
