"""The graphics state of a pbrt file: what AttributeBegin saves and AttributeEnd restores."""

from __future__ import annotations

from dataclasses import dataclass, field, replace
from typing import TYPE_CHECKING, Any

from .area_lights import AreaLight
from .media import Interface
from .motion import ACTIVE
from .params import Params
from .tokens import Parameter, Token, Words

if TYPE_CHECKING:
    import numpy as np

TRANSFORMS = {
    "ConcatTransform": 16,
    "Identity": 0,
    "LookAt": 9,
    "Rotate": 4,
    "Scale": 3,
    "Transform": 16,
    "Translate": 3,
}
#: What the parameters of Attribute are for, by the directives that have them.
ATTRIBUTES = {
    "AreaLightSource": "light",
    "LightSource": "light",
    "MakeNamedMaterial": "material",
    "MakeNamedMedium": "medium",
    "Material": "material",
    "Shape": "shape",
    "Texture": "texture",
}


@dataclass
class State:
    """What directives change for those that follow."""

    #: object space (or world space, before WorldBegin) to the outer space, at two times
    matrices: list[np.ndarray]
    active: tuple[int, ...] = ACTIVE["All"]  #: those of them that transforms change
    material: dict[str, Any] | None = None  #: as the scene refers to it
    made_of: Params | None = None  #: what gave the material, in pbrt-v3, unless it has a name
    area_light: AreaLight | None = None
    interface: Interface = Interface()  # noqa: RUF009 (it is never changed)
    reversed: bool = False
    #: parameters that directives have unless they say otherwise, by what they are for
    defaults: dict[str, dict[str, Parameter]] = field(default_factory=dict)

    def copy(self) -> State:
        return replace(self, matrices=list(self.matrices), defaults=dict(self.defaults))

    @property
    def matrix(self) -> np.ndarray:
        """At the start."""
        return self.matrices[0]

    def attribute(self, directive: Token, words: Words) -> None:
        """Attribute "shape" ...: adds to the defaults."""
        target = words.text(directive)
        if target not in ATTRIBUTES.values():
            valid = ", ".join(sorted(set(ATTRIBUTES.values())))
            raise directive.error(f"Attribute {target!r} is not known; valid are: {valid}")
        self.defaults[target] = self.defaults.get(target, {}) | words.parameters()

    def transform(self, directive: Token, words: Words) -> None:
        """Applies one of TRANSFORMS to what is active."""
        local = local_matrix(directive, words.numbers(TRANSFORMS[directive.text], directive))
        alone = directive.text in ("Identity", "Transform")
        for i in self.active:
            self.matrices[i] = local if alone else self.matrices[i] @ local


def local_matrix(directive: Token, given: list[float]) -> np.ndarray:
    """Of one of TRANSFORMS; the numbers of a matrix stand column by column."""
    import numpy as np

    from ...scenes.transforms import Transform

    match directive.text:
        case "Identity":
            return np.eye(4)
        case "Translate":
            return Transform.translate(given).matrix
        case "Scale":
            return Transform.scale(given).matrix
        case "Rotate":
            return Transform.rotate(given[1:], given[0]).matrix
        case "LookAt":
            return look_at(given, directive)
    return np.array(given).reshape(4, 4).T


def look_at(numbers: list[float], where: Token) -> np.ndarray:
    """World space to that of a camera whose x axis points to the right (pbrt-v4, LookAt)."""
    import numpy as np

    eye, target, up = np.array(numbers).reshape(3, 3)
    forward = target - eye
    right = np.cross(up, forward)
    if not np.any(right):
        raise where.error("LookAt: 'up' is parallel to the direction of view")
    forward, right = forward / np.linalg.norm(forward), right / np.linalg.norm(right)
    world_from_camera = np.eye(4)
    columns = [right, np.cross(forward, right), forward, eye]
    world_from_camera[:3] = np.stack(columns, axis=1)
    return np.linalg.inv(world_from_camera)
