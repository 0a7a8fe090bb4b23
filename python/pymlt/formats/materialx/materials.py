"""Materials of MaterialX as BSDFs `openpbr`, with the light that they emit."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np

from ... import _core
from ..imported import Imported, rgb
from .document import standard_nodes
from .graph import Graph
from .normals import with_normals
from .origin import Port
from .shaders import OPENPBR, Shader, shader_of
from .textures import Pattern, Textures
from .values import checked, full

#: Parameters that are numbers or colours alone: of a texture the mean is taken.
UNTEXTURED = {
    "specular_ior",
    "transmission_depth",
    "transmission_scatter",
    "transmission_scatter_anisotropy",
    "transmission_dispersion_scale",
    "transmission_dispersion_abbe_number",
    "subsurface_radius",
    "subsurface_radius_scale",
    "subsurface_scatter_anisotropy",
    "coat_ior",
    "coat_darkening",
    "thin_film_thickness",
    "thin_film_ior",
}
#: What parameters of these families need to do anything.
WEIGHTS = ("transmission", "subsurface", "coat", "fuzz", "thin_film")
THIN_WALLED = "geometry_thin_walled"
THICKEST = 20.0  #: micrometres of a thin film


class Materials:
    """The materials of a document; `contents` are files in memory, by their paths."""

    def __init__(self, document: Any, made: Imported, contents: Mapping[str, bytes] | None = None):
        self._document = document
        self._made = made
        self.textures = Textures(document, contents)

    def read(self) -> dict[str, dict[str, Any]]:
        """By name: what a shape with the material has, a `bsdf` and perhaps an `emitter`."""
        found = {}
        for material in self._document.getMaterialNodes():
            if material.getCategory() != "surfacematerial":
                self._made.warn(f"{material.getNamePath()}: {material.getCategory()} is left out")
                continue
            for given in material.getInputs():
                if given.getName() != "surfaceshader" and given.getConnectedNode() is not None:
                    self._made.warn(f"{given.getNamePath()}: {given.getName()} is left out")
            found[material.getName()] = self.parts(shader_of(material))
            self.textures.images.forget()
        if not found:
            raise _core.SceneError("there is no surfacematerial in the file")
        return found

    def parts(self, shader: Shader) -> dict[str, Any]:
        """The BSDF of a shader, and its emitter if it glows."""
        for name in shader.left_out():
            self._made.warn(f"{shader.node.getNamePath()}: {name} is left out")
        surface = {"type": "openpbr"} | self._parameters(shader)
        made = {"bsdf": with_normals(surface, shader, self.textures, self._made)}
        bends = made["bsdf"] is not surface and "coat_weight" in surface
        if bends and shader.coat_has_its_own_normals:
            self._made.warn(f"{shader.node.getNamePath()}: its normals bend the coat, too")
        radiance = self._radiance(shader)
        return made if radiance is None else made | {"emitter": {"type": "area", **radiance}}

    def _parameters(self, shader: Shader) -> dict[str, Any]:
        """All that differ from the default, without those of a family whose weight is 0."""
        defined = standard_nodes().getNodeDef(f"ND_{OPENPBR}_surfaceshader")
        declared = [given for given in defined.getActiveInputs() if is_parameter(given.getName())]
        found: dict[str, Any] = {}
        for given in sorted(declared, key=lambda given: not given.getName().endswith("_weight")):
            name = given.getName()
            family = next((one for one in WEIGHTS if name.startswith(f"{one}_")), None)
            is_idle = family is not None and not found.get(f"{family}_weight")
            if not is_idle or name == f"{family}_weight":
                value = self._value(shader, given)
                if value is not None:
                    found[name] = value
        return found

    def _value(self, shader: Shader, declared: Any) -> Any:
        """A parameter as a scene dict has it; None for the default."""
        name, port = declared.getName(), shader.port(declared.getName())
        if port is None:
            return None
        where = f"{shader.node.getNamePath()}: {name}"
        pattern = typed(port, declared.getType())
        constant = self.textures.constant(pattern)
        if constant is None and name not in UNTEXTURED:
            bitmap = self.textures.texture(port, where, limits=range_of(declared))
            constant = uniform(bitmap)
            if constant is None:
                return bitmap
        if constant is None:
            self._made.warn(f"{where} is a texture, of which the mean is taken")
            data = self.textures.computed(pattern, where)["data"]
            constant = data.reshape(-1, data.shape[2] if data.ndim > 2 else 1).mean(axis=0).tolist()
        constant = self._in_range(constant, declared, where)
        default = self.textures.constant(lambda graph: graph.constant(declared))
        if default is not None and np.allclose(constant, default, rtol=1e-9):
            return None
        if name == THIN_WALLED:
            return bool(constant[0])
        return constant[0] if len(constant) == 1 else rgb(constant)

    def _in_range(self, values: list[float], declared: Any, where: str) -> list[float]:
        """Numbers between the least and the greatest that the specification allows."""
        low, high = range_of(declared)
        clipped = [min(max(value, low), high) for value in values]
        if clipped != values:
            given, taken = (", ".join(f"{one:.3g}" for one in each) for each in (values, clipped))
            self._made.warn(f"{where} is {given}, and taken as {taken}")
        if declared.getName() == "thin_film_thickness" and clipped[0] > THICKEST:
            self._made.warn(f"{where} is {clipped[0]:.3g} micrometres; nanometres need a unit")
        return clipped

    def _radiance(self, shader: Shader) -> dict[str, Any] | None:
        """That of the light which a shader emits: luminance times colour, 1 nit as 1."""
        luminance, colour = (shader.port(f"emission_{name}") for name in ("luminance", "color"))
        if luminance is None:
            return None
        strength = typed(luminance, "float")
        tint = typed(colour, "color3") if colour is not None else lambda _: np.ones((1, 1, 3))

        def radiance(graph: Graph) -> np.ndarray:
            return strength(graph) * tint(graph)

        where = f"{shader.node.getNamePath()}: emission"
        constant = self.textures.constant(radiance)
        if constant is None:
            return {"radiance": self.textures.computed(radiance, where)}
        emitted = [max(value, 0.0) for value in constant]
        return {"radiance": rgb(emitted)} if any(emitted) else None


def typed(port: Port, kind: str) -> Pattern:
    """What an input of OpenPBR is given, if it is of the type that this input has."""
    return lambda graph: full(checked(graph.value(*port), kind, port[0]), kind)


def is_parameter(name: str) -> bool:
    """Whether an input of OpenPBR is a parameter of `openpbr`: neither light nor normals are."""
    if name.startswith("geometry_"):
        return name in ("geometry_opacity", THIN_WALLED)
    return not name.startswith("emission_")


def range_of(declared: Any) -> tuple[float, float]:
    """The least and the greatest value of an input of OpenPBR."""
    least, most = (declared.getAttribute(name).split(",")[0] for name in ("uimin", "uimax"))
    return float(least or "-inf"), float(most or "inf")


def uniform(bitmap: dict[str, Any]) -> list[float] | None:
    """The numbers of a computed texture whose texels are all the same, such as alpha of none."""
    data = bitmap.get("data")
    if not isinstance(data, np.ndarray) or not (data == data[0, 0]).all():
        return None
    return np.atleast_1d(data[0, 0]).astype(float).tolist()
