"""A pbrt file as a scene dict: what its directives add to it."""

from __future__ import annotations

from pathlib import Path
from typing import Any

from ..imported import Imported
from ..views import complete
from . import views
from .area_lights import area_light
from .directives import Directives
from .disks import on_a_disk
from .exposure import expose, exposure_time, sensitivity
from .lights import light
from .materials import bsdf
from .media import Interface, medium
from .motion import animation, moves
from .params import Params
from .shapes import shape
from .textures import Textures
from .tokens import Token

#: Of the view, its directives by their names in the scene dict.
NAMES = {"Camera": "camera", "Film": "film", "PixelFilter": "rfilter", "Sampler": "sampler"}
NAMES["Integrator"] = "integrator"
PARTS = ("bsdf", "emitter")  #: of shapes, that may have textures


class Reader(Directives):
    """One file of pbrt-v4. What another version reads differently are class attributes."""

    textures = Textures
    views: Any = views  #: a module
    area_light = staticmethod(area_light)
    bsdf = staticmethod(bsdf)
    exposure_time = staticmethod(exposure_time)
    light = staticmethod(light)
    medium = staticmethod(medium)
    sensitivity = staticmethod(sensitivity)

    def __init__(self, path: Path, made: Imported):
        super().__init__(path, made)
        self._textures = self.textures(path.parent)
        self._named: dict[str, dict[str, Any]] = {}
        self._ids: dict[str, str] = {}
        self._media = {"": ""}
        self._objects: dict[str, str] = {}
        self._group: dict[str, Any] | None = None
        self._views: dict[str, dict[str, Any]] = {}
        self._exposure_time = self._sensitivity = 1.0
        self._shutter: dict[str, float] = {}
        self._moves = False

    def read(self) -> None:
        super().read()
        expose(self._made.scene, self._exposure_time * self._sensitivity)
        if self._moves and "Camera" in self._views:
            self._views["Camera"] |= self._shutter
        for name, element in views.elements(self._views):
            self._made.add(name, element)
        complete(self._made)

    def _directive(self, directive: Token) -> None:
        if directive.text in NAMES:
            self._made.note(NAMES[directive.text])
        super()._directive(directive)

    # ---- the view ------------------------------------------------------------------------------

    def _on_camera(self, directive: Token) -> None:
        import numpy as np

        params = self._params(directive)
        self._exposure_time = self.exposure_time(params)
        for side, default in (("open", 0), ("close", 1)):
            self._shutter[f"shutter_{side}"] = params.number(f"shutter{side}", default)
        from_camera = [np.linalg.inv(matrix) for matrix in self._state.matrices]
        camera = self.views.camera(params, self._state.matrix)
        camera["to_world"] = self._moving(camera["to_world"], from_camera)
        self._views["Camera"] = camera | self._state.interface.around()
        self._spaces["camera"] = from_camera

    def _on_film(self, directive: Token) -> None:
        params = self._params(directive)
        self._sensitivity = self.sensitivity(params)
        self._views["Film"] = self.views.film(params)

    def _on_pixel_filter(self, directive: Token) -> None:
        self._views["PixelFilter"] = self.views.rfilter(self._params(directive))

    def _on_sampler(self, directive: Token) -> None:
        self._views["Sampler"] = self.views.sampler(self._params(directive))

    def _on_integrator(self, directive: Token) -> None:
        self._views["Integrator"] = self.views.integrator(self._params(directive)) or {}

    def _on_accelerator(self, directive: Token) -> None:
        """Has no influence on the image."""
        self._params(directive)

    def _moving(self, to_world: Any, matrices: list[Any]) -> Any:
        """What this transform, that of the start, is while the shutter is open."""
        if not moves(matrices):
            return to_world
        self._moves = True
        return animation(to_world, matrices, self._times)

    def _still(self, params: Params) -> Any:
        """The transform, that of the start, of what cannot move."""
        if moves(self._state.matrices):
            params.warn(f"{params.where.text} {params.type!r} stays where it starts")
        return self._state.matrix

    # ---- materials, textures, lights -----------------------------------------------------------

    def _on_material(self, directive: Token) -> None:
        self._state.material = self._material(self._params(directive))

    def _material(self, params: Params) -> dict[str, Any]:
        """A material without a name."""
        surface = self.bsdf(params, self._textures, self._named)
        return self._reference(self._made.add(f"{params.type}-material", surface))

    def _on_make_named_material(self, directive: Token) -> None:
        name = self._words.text(directive)
        params = self._typed(directive, f"the material {name!r}")
        self._named[name] = self.bsdf(params, self._textures, self._named)
        self._ids[name] = self._made.add(name, self._named[name])

    def _on_named_material(self, directive: Token) -> None:
        name = self._words.text(directive)
        if name not in self._ids:
            raise directive.error(f"there is no material {name!r} above this line")
        self._state.material = self._reference(self._ids[name])

    def _on_make_named_medium(self, directive: Token) -> None:
        name = self._words.text(directive)
        params = self._typed(directive, f"the medium {name!r}")
        found = self.medium(params, self._folder, self._still(params))
        self._media[name] = self._made.add(f"{name}-medium", found) if found else ""

    def _on_medium_interface(self, directive: Token) -> None:
        """With one name it is the medium on both sides."""
        names = [self._words.text(directive)]
        following = self._words.peek()
        names.append(self._words.text(directive) if following and following.quoted else names[0])
        for name in names:
            if name not in self._media:
                raise directive.error(f"there is no medium {name!r} above this line")
        self._state.interface = Interface(*(self._media[name] for name in names))

    def _on_texture(self, directive: Token) -> None:
        name, kind = self._words.text(directive), self._words.text(directive)
        self._textures.declare(name, kind, self._params(directive))

    def _on_light_source(self, directive: Token) -> None:
        params = self._params(directive)
        found = self.light(params, self._folder, self._still(params))
        if found:
            params.finish()
            self._made.add(f"{params.type}-light", found | self._state.interface.around())

    def _on_area_light_source(self, directive: Token) -> None:
        self._state.area_light = self.area_light(self._params(directive), self._textures)

    def _reference(self, id: str) -> dict[str, Any]:
        return {"type": "ref", "id": id}

    # ---- shapes, objects -----------------------------------------------------------------------

    def _on_shape(self, directive: Token) -> None:
        params = self._params(directive)
        found = shape(params, self._folder, self._state.matrix, self._state.reversed)
        if found is None:
            return
        surface = self._surface(params)
        if params.get("alpha"):
            opacity = self._textures.number(params, "alpha", 1.0)
            surface = {"type": "mask", "opacity": opacity, "bsdf": surface}
        found |= {"bsdf": surface} | self._state.interface.sides()
        if self._state.area_light and self._group is None:
            found["emitter"] = self._state.area_light.emitter(found, params)
        elif self._state.area_light:
            params.warn("lights in objects that are instanced are left out")
        if params.type == "disk":
            found |= {part: on_a_disk(found[part], params) for part in PARTS if part in found}
        params.finish()
        if self._group is None:
            found["to_world"] = self._moving(found["to_world"], self._state.matrices)
            self._made.add(params.type, found)
        else:
            self._still(params)
            self._made.charge(found)
            self._group[self._made.name(params.type)] = found

    def _surface(self, params: Params) -> dict[str, Any]:
        """The material of a shape."""
        default = {"type": "twosided", "bsdf": {"type": "diffuse", "reflectance": 0.5}}
        return self._state.material or default

    def _on_object_begin(self, directive: Token) -> None:
        name = self._words.text(directive)
        if self._group is not None:
            raise directive.error("an object is defined inside of another one")
        self._begin(directive)
        self._group = {"type": "shapegroup"}
        self._objects[name] = self._made.add(f"{name}-object", self._group)
        # The dict in the scene is a copy, made before the shapes are known.
        self._made.scene[self._objects[name]] = self._group

    def _on_object_end(self, directive: Token) -> None:
        if self._group is None:
            raise directive.error("ObjectEnd ends nothing")
        self._group = None
        self._state = self._saved.pop()

    def _on_object_instance(self, directive: Token) -> None:
        name = self._words.text(directive)
        if self._group is not None:
            raise directive.error("an object is placed inside of another one")
        if name not in self._objects:
            raise directive.error(f"there is no object {name!r} above this line")
        group = self._made.scene[self._objects[name]]
        if len(group) > 1:
            reference = self._reference(self._objects[name])
            to_world = self._moving(self._state.matrix, self._state.matrices)
            placed = {"type": "instance", "group": reference, "to_world": to_world}
            self._made.add(f"{name}-instance", placed)
