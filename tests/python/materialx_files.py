"""Small files of MaterialX, as texts."""

from pathlib import Path

COUNTS = {1: "float", 2: "vector2", 3: "color3"}


def attributes(**given) -> str:
    return " ".join(f'{name}="{value}"' for name, value in given.items())


def value_input(name: str, value) -> str:
    """An input with numbers, a flag, a text, or a dict of attributes."""
    if isinstance(value, dict):
        given = value
    elif isinstance(value, bool):
        given = {"type": "boolean", "value": str(value).lower()}
    elif isinstance(value, str):
        given = {"type": "string", "value": value}
    else:
        numbers = [value] if isinstance(value, int | float) else list(value)
        kind = "integer" if isinstance(value, int) else COUNTS[len(numbers)]
        given = {"type": kind, "value": ", ".join(map(str, numbers))}
    return f"<input {attributes(name=name, **given)} />"


def node(category: str, name: str, kind: str, **inputs) -> str:
    inner = "".join(value_input(key, value) for key, value in inputs.items())
    return f"<{category} {attributes(name=name, type=kind)}>{inner}</{category}>"


def linked(kind: str, name: str, **more) -> dict:
    """An input that comes from another node."""
    return {"type": kind, "nodename": name, **more}


def image(name: str, file: str, kind: str = "color3", space: str = "srgb_texture", **inputs) -> str:
    given = {"type": "filename", "value": file}
    if space:
        given["colorspace"] = space
    return node("image", name, kind, file=given, **inputs)


def material(category: str, *, name: str = "M", **inputs) -> str:
    """A shader and the material that is made of it."""
    shader = node(category, f"{name}_shader", "surfaceshader", **inputs)
    return shader + node(
        "surfacematerial",
        name,
        "material",
        surfaceshader=linked("surfaceshader", f"{name}_shader"),
    )


def write(path: str, *elements: str, version: str = "1.39", **given) -> str:
    """A file of these elements; returns its name."""
    text = "".join(elements)
    head = attributes(version=version, **{"xmlns:xi": "http://www.w3.org/2001/XInclude"}, **given)
    Path(path).write_text(f'<?xml version="1.0"?>\n<materialx {head}>{text}</materialx>\n')
    return path
