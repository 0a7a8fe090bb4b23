"""The names of Mitsuba 3's `traverse`, up to 3.10, where they are not those of scene files."""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import TYPE_CHECKING, Any, NamedTuple

from .. import _core
from .arrays import MESH_BUFFERS

if TYPE_CHECKING:
    import numpy as np

#: What a plug-in is to its parent.
PARTS = {
    "brdf_0": "bsdf",
    "brdf_1": "bsdf_1",
    "bsdf_0": "bsdf",
    "nested_bsdf": "bsdf",
    "nested_texture": "texture",
    "interior_medium": "interior",
    "exterior_medium": "exterior",
    "phase_function": "phase",
}
#: Parameters, and ours of which they are made.
PARAMETERS = {
    "vertex_positions": ("vertices",),
    "vertex_normals": ("normals",),
    "vertex_texcoords": ("uv",),
    "size": ("width", "height"),
    "crop_size": ("crop_width", "crop_height"),
    "crop_offset": ("crop_offset_x", "crop_offset_y"),
    "shutter_open_time": ("shutter_open", "shutter_close"),
    "x_fov": ("fov", "fov_axis"),
}
FILM_DIAGONAL = math.hypot(36, 24)  #: mm, of 35 mm film, to which focal lengths refer


class Meaning(NamedTuple):
    """What a name stands for."""

    plugin: str
    parameter: str  #: in Mitsuba, if it is one of PARAMETERS
    names: tuple[str, ...]  #: of our parameters


def translated(name: str) -> str:
    """The name in which plug-ins are called as here, without `value` at its end."""
    parts = name.split(".")
    while len(parts) > 2 and parts[-1] == "value":
        parts.pop()
    return ".".join(PARTS.get(part, part) for part in parts)


def meaning(name: str, known: Mapping[str, Any]) -> Meaning | None:
    """What a name of Mitsuba or of ours means; None if the scene has no such parameter."""
    own = name if name in known else translated(name)
    plugin, _, parameter = own.rpartition(".")
    if own in known:
        return Meaning(plugin, "", (own,))
    names = tuple(f"{plugin}.{part}" for part in PARAMETERS.get(parameter, ()))
    present = names and all(part in known for part in names)
    return Meaning(plugin, parameter, names) if present else None


def read(meant: Meaning, known: Mapping[str, Any], size: tuple[int, int]) -> Any:
    """The value of a parameter as Mitsuba has it; `size` is that of the image."""
    plugin, parameter, names = meant
    values = [known[name] for name in names]
    if parameter == "x_fov":
        sides = zip((f"{plugin}.film.width", f"{plugin}.film.height"), size, strict=True)
        width, height = (known.get(name, pixels) for name, pixels in sides)
        return x_fov(*values, known[f"{plugin}.focal_length"], width / height)
    if parameter == "shutter_open_time":
        return values[1] - values[0]
    if parameter == "crop_size":
        whole = [known[f"{plugin}.{side}"] for side in ("width", "height")]
        return [all_ if part is None else part for part, all_ in zip(values, whole, strict=True)]
    if parameter.startswith("vertex_") and values[0] is not None:
        return moved(parameter, values[0], _to_world(meant, known)).ravel()
    return values if len(values) > 1 else values[0]


def given(meant: Meaning, value: Any, known: Mapping[str, Any]) -> dict[str, Any]:
    """Our parameters with what a value as Mitsuba has it says of them."""
    import numpy as np

    _, parameter, names = meant
    if parameter == "x_fov":
        return {names[0]: value, names[1]: "x"}
    if parameter == "shutter_open_time":
        return {names[1]: known[names[0]] + value}
    if len(names) == 2:
        return dict(zip(names, two_counts(parameter, value), strict=True))
    if parameter.startswith("vertex_"):
        value = moved(parameter, value, np.linalg.inv(_to_world(meant, known)))
    return {names[0]: by_rows(names[0], value)}


def x_fov(fov: float | None, axis: str, focal_length: str, aspect: float) -> float:
    """The horizontal angle of view in degrees; `aspect` is a film's width over its height."""
    if fov is None:
        millimetres = float(focal_length.removesuffix("mm"))
        fov, axis = math.degrees(2 * math.atan(FILM_DIAGONAL / 2 / millimetres)), "diagonal"
    if axis in ("smaller", "larger"):
        axis = "x" if (axis == "larger") == (aspect > 1) else "y"
    wider = {"x": 1.0, "y": aspect, "diagonal": aspect / math.hypot(aspect, 1)}[axis]
    return math.degrees(2 * math.atan(wider * math.tan(math.radians(fov) / 2)))


def by_rows(name: str, value: Any) -> Any:
    """An array of a mesh that is flat, as Mitsuba has them, in rows; other values as they are."""
    import numpy as np

    width = MESH_BUFFERS.get(name.rpartition(".")[2])
    flat = width is not None and not isinstance(value, dict | str) and np.ndim(value) == 1
    if not flat or np.size(value) % width:
        return value
    return np.reshape(value, (-1, width))


def moved(parameter: str, value: Any, matrix: np.ndarray) -> np.ndarray:
    """Points or normals, flat or not, as rows under a transform; texture coordinates as given."""
    import numpy as np

    if parameter == "vertex_texcoords":
        return np.asarray(value)
    rows = np.reshape(np.asarray(value, dtype=float), (-1, 3))
    if parameter == "vertex_positions":
        return rows @ matrix[:3, :3].T + matrix[:3, 3]
    turned = rows @ np.linalg.inv(matrix[:3, :3])
    lengths = np.linalg.norm(turned, axis=1, keepdims=True)
    return turned / np.where(lengths > 0, lengths, 1)


def two_counts(parameter: str, value: Any) -> list[int]:
    try:
        first, second = (int(count) for count in value)
    except (TypeError, ValueError):
        raise _core.UsageError(
            f"{parameter} is {value!r}, but should be two numbers of pixels"
        ) from None
    return [first, second]


def _to_world(meant: Meaning, known: Mapping[str, Any]) -> np.ndarray:
    """That of a mesh, whose vertices Mitsuba has in the world. Raises UsageError if it moves."""
    import numpy as np

    given = known[f"{meant.plugin}.to_world"]
    matrix = np.asarray(getattr(given, "matrix", given))
    if matrix.shape != (4, 4):
        raise _core.UsageError(
            f"{meant.plugin}.{meant.parameter}: the mesh moves; {meant.names[0]} are its own "
            "coordinates"
        )
    return matrix.astype(float)
