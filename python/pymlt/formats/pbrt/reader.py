"""A pbrt-v4 file as a scene dict: one method for each kind of directive."""

from __future__ import annotations

import re
from pathlib import Path
from typing import TYPE_CHECKING, Any

from ... import _core
from .. import limits
from ..imported import Imported
from ..missing import ABSENT
from ..views import complete
from . import views
from .area_lights import area_light
from .exposure import expose, exposure_time, sensitivity
from .lights import light
from .materials import bsdf
from .media import Interface, medium
from .params import Params
from .shapes import shape
from .state import ATTRIBUTES, TRANSFORMS, State
from .textures import Textures
from .tokens import Parameter, Token, Words
from .version import WARNING, only_in_v3

if TYPE_CHECKING:
    import numpy as np

VIEWS = {
    "Integrator": views.integrator,
    "PixelFilter": views.rfilter,
    "Sampler": views.sampler,
}
#: What becomes of the directives of the view, by its name in the scene dict.
NAMES = {"Camera": "camera", "Film": "film", "PixelFilter": "rfilter", "Sampler": "sampler"}
NAMES["Integrator"] = "integrator"
BEGIN = ("AttributeBegin", "TransformBegin")
END = ("AttributeEnd", "TransformEnd")


def read_pbrt(path: Path, made: Imported) -> None:
    """Adds what a .pbrt file, with those that it includes, holds to a scene.

    Raises FileError for files that cannot be read, SceneError (with file and line) for what is
    wrong in them.
    """
    Reader(path, made).read()


class Reader:
    """One file while it is read."""

    def __init__(self, path: Path, made: Imported):
        import numpy as np

        self._folder = path.parent
        self._made = made
        self._words = Words(path)
        self._state = State(np.eye(4))
        self._saved: list[State] = []
        self._spaces: dict[str, np.ndarray] = {}
        self._textures = Textures(path.parent)
        self._named: dict[str, dict[str, Any]] = {}
        self._ids: dict[str, str] = {}
        self._media = {"": ""}
        self._objects: dict[str, str] = {}
        self._group: dict[str, Any] | None = None
        self._views: dict[str, dict[str, Any]] = {}
        self._exposure_time = self._sensitivity = 1.0
        self._last: Token | None = None

    def read(self) -> None:
        while self._words.peek() is not None:
            self._last = directive = self._words.take()
            self._made.place = directive.place
            try:
                self._directive(directive)
            except (_core.SceneError, _core.FileError) as error:
                if str(error).endswith(ABSENT):
                    self._made.missing.setdefault(str(error), directive.place)
                    continue
                if re.match(r".*:\d+: ", str(error)):
                    raise
                raise type(error)(f"{directive.place}: {error}") from None
            except _core.Error:
                raise
            except limits.CONTRADICTIONS as error:
                raise directive.error(f"{directive.text} makes no sense: {error!s:.200}") from None
        if self._saved and self._last is not None:
            raise self._last.error("an AttributeBegin has no AttributeEnd")
        self._made.place = ""
        expose(self._made.scene, self._exposure_time * self._sensitivity)
        for name, element in views.elements(self._views):
            self._made.add(name, element)
        complete(self._made)

    def _directive(self, directive: Token) -> None:
        name = directive.text
        if name in NAMES:
            self._made.note(NAMES[name])
        method = getattr(self, f"_on_{re.sub('(?<!^)(?=[A-Z])', '_', name).lower()}", None)
        if directive.quoted:
            raise directive.error(f"a directive is expected, not {name!r}")
        if name in TRANSFORMS:
            self._state.transform(directive, self._words)
        elif name in VIEWS:
            self._views[name] = VIEWS[name](self._params(directive)) or {}
        elif name in BEGIN:
            self._begin(directive)
        elif name in END:
            self._end(directive)
        elif method is not None:
            method(directive)
        else:
            self._leave_out(directive)

    def _params(self, directive: Token) -> Params:
        kind = self._words.text(directive)
        return self._given(directive, kind, self._words.parameters())

    def _given(self, directive: Token, kind: str, given: dict[str, Parameter]) -> Params:
        if only_in_v3(directive.text, kind, given):
            self._made.warn(WARNING, directive.place)
        return Params(directive, kind, given, self._made, self._defaults(directive))

    def _defaults(self, directive: Token) -> dict[str, Parameter]:
        """What Attribute says of directives of this kind."""
        return self._state.defaults.get(ATTRIBUTES.get(directive.text, ""), {})

    def _leave_out(self, directive: Token) -> None:
        """What is not known, with all that follows up to the next directive."""
        if not directive.text[:1].isalpha():
            raise directive.error(f"a directive is expected, not {directive.text!r}")
        self._made.warn(f"{directive.text} is left out", directive.place)
        while (token := self._words.peek()) is not None:
            if not token.quoted and token.text[:1].isalpha() and token.text not in _VALUES:
                return
            self._words.take()

    def _begin(self, directive: Token) -> None:
        if len(self._saved) >= limits.NESTING:
            raise directive.error(f"blocks are nested more than {limits.NESTING} deep")
        self._saved.append(self._state.copy())

    def _end(self, directive: Token) -> None:
        if not self._saved:
            raise directive.error(f"{directive.text} ends nothing")
        saved = self._saved.pop()
        if directive.text == "TransformEnd":
            self._state.matrix = saved.matrix
        else:
            self._state = saved

    def _on_attribute(self, directive: Token) -> None:
        self._state.attribute(directive, self._words)

    # ---- transforms, files ---------------------------------------------------------------------

    def _on_world_begin(self, directive: Token) -> None:
        import numpy as np

        self._state.matrix = np.eye(4)

    def _on_world_end(self, directive: Token) -> None:
        """Of pbrt-v3."""

    def _on_reverse_orientation(self, directive: Token) -> None:
        self._state.reversed = not self._state.reversed

    def _on_coordinate_system(self, directive: Token) -> None:
        self._spaces[self._words.text(directive)] = self._state.matrix.copy()

    def _on_coord_sys_transform(self, directive: Token) -> None:
        name = self._words.text(directive)
        if name not in self._spaces:
            raise directive.error(f"there is no coordinate system {name!r}")
        self._state.matrix = self._spaces[name].copy()

    def _on_include(self, directive: Token) -> None:
        self._words.include(self._words.take(directive))

    _on_import = _on_include

    def _on_camera(self, directive: Token) -> None:
        import numpy as np

        params = self._params(directive)
        self._exposure_time = exposure_time(params)
        self._views["Camera"] = views.camera(params, self._state.matrix)
        self._views["Camera"] |= self._state.interface.around()
        self._spaces["camera"] = np.linalg.inv(self._state.matrix)

    def _on_film(self, directive: Token) -> None:
        params = self._params(directive)
        self._sensitivity = sensitivity(params)
        self._views["Film"] = views.film(params)

    def _on_accelerator(self, directive: Token) -> None:
        """Has no influence on the image."""
        self._params(directive)

    # ---- materials, textures, lights -----------------------------------------------------------

    def _on_material(self, directive: Token) -> None:
        params = self._params(directive)
        surface = bsdf(params, self._textures, self._named)
        self._state.material = self._reference(self._made.add(f"{params.type}-material", surface))

    def _on_make_named_material(self, directive: Token) -> None:
        name = self._words.text(directive)
        params = self._typed(directive, f"the material {name!r}")
        self._named[name] = bsdf(params, self._textures, self._named)
        self._ids[name] = self._made.add(name, self._named[name])

    def _on_named_material(self, directive: Token) -> None:
        name = self._words.text(directive)
        if name not in self._ids:
            raise directive.error(f"there is no material {name!r} above this line")
        self._state.material = self._reference(self._ids[name])

    def _on_make_named_medium(self, directive: Token) -> None:
        name = self._words.text(directive)
        params = self._typed(directive, f"the medium {name!r}")
        found = medium(params, self._folder, self._state.matrix)
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

    def _typed(self, directive: Token, what: str) -> Params:
        """The parameters of a directive that gives its kind as one of them."""
        given = self._words.parameters()
        kind = given.pop("type", None)
        if kind is None:
            raise directive.error(f'{what} needs a "string type"')
        return self._given(directive, kind.values[0], given)

    def _on_texture(self, directive: Token) -> None:
        name, kind = self._words.text(directive), self._words.text(directive)
        self._textures.declare(name, kind, self._params(directive))

    def _on_light_source(self, directive: Token) -> None:
        params = self._params(directive)
        found = light(params, self._folder, self._state.matrix)
        if found:
            params.finish()
            self._made.add(f"{params.type}-light", found | self._state.interface.around())

    def _on_area_light_source(self, directive: Token) -> None:
        self._state.area_light = area_light(self._params(directive))

    def _reference(self, id: str) -> dict[str, Any]:
        return {"type": "ref", "id": id}

    # ---- shapes, objects -----------------------------------------------------------------------

    def _on_shape(self, directive: Token) -> None:
        params = self._params(directive)
        found = shape(params, self._folder, self._state.matrix, self._state.reversed)
        if found is None:
            return
        default = {"type": "twosided", "bsdf": {"type": "diffuse", "reflectance": 0.5}}
        surface = self._state.material or default
        if params.get("alpha"):
            opacity = self._textures.number(params, "alpha", 1.0)
            surface = {"type": "mask", "opacity": opacity, "bsdf": surface}
        found |= {"bsdf": surface} | self._state.interface.sides()
        if self._state.area_light and self._group is None:
            found["emitter"] = self._state.area_light.emitter(found, params)
        elif self._state.area_light:
            params.warn("lights in objects that are instanced are left out")
        params.finish(ignored=("edgelength", "displacement"))
        if self._group is None:
            self._made.add(params.type, found)
        else:
            self._made.charge(found)
            self._group[self._made.name(params.type)] = found

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
            placed = {"type": "instance", "group": reference, "to_world": self._state.matrix}
            self._made.add(f"{name}-instance", placed)


_VALUES = ("true", "false")
