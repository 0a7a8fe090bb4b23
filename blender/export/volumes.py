"""Volume shaders as media that are the same everywhere in their mesh."""

from typing import Any

import numpy as np

from pymlt.formats.imported import Imported, rgb

from .textures import source


class Volumes:
    """Coefficients per unit of length, as Cycles has them."""

    def __init__(self, made: Imported):
        self._made = made
        self._shaders = {
            "VOLUME_SCATTER": self._scatter,
            "VOLUME_ABSORPTION": self._absorption,
            "PRINCIPLED_VOLUME": self._principled,
            "ADD_SHADER": self._add,
        }

    def medium(self, socket) -> dict[str, Any] | None:
        """The medium of a volume socket; None if there is none, or a warning says why not."""
        scattered, absorbed, g = self._shader(socket)
        if not np.any(scattered + absorbed):
            return None
        made = {"type": "homogeneous", "sigma_s": rgb(scattered), "sigma_a": rgb(absorbed)}
        return made | {"phase": {"type": "hg", "g": float(np.clip(g, -0.99, 0.99))}}

    def _shader(self, socket) -> tuple[np.ndarray, np.ndarray, float]:
        """What is scattered, what is absorbed, and the mean cosine of the phase function."""
        found = source(socket)
        if found is None:
            return np.zeros(3), np.zeros(3), 0.0
        if found.node.type in self._shaders:
            return self._shaders[found.node.type](found.node)
        self._made.warn(f"the shader {found.node.bl_label!r} of volumes is left out")
        return np.zeros(3), np.zeros(3), 0.0

    def _value(self, node, name: str):
        socket = node.inputs[name]
        if socket.is_linked:
            self._made.warn(f"textures of the {name} of volumes are left out")
        value = socket.default_value
        return np.array(value[:3]) if hasattr(value, "__len__") else value

    def _scatter(self, node):
        if getattr(node, "phase", "HENYEY_GREENSTEIN") != "HENYEY_GREENSTEIN":
            self._made.warn("phase functions of volumes become that of Henyey and Greenstein")
        scattered = self._value(node, "Density") * np.clip(self._value(node, "Color"), 0, None)
        return scattered, np.zeros(3), self._value(node, "Anisotropy")

    def _absorption(self, node):
        left_out = 1 - np.clip(self._value(node, "Color"), 0, 1)
        return np.zeros(3), self._value(node, "Density") * left_out, 0.0

    def _principled(self, node):
        if self._value(node, "Emission Strength") or self._value(node, "Blackbody Intensity"):
            self._made.warn("the light that volumes emit is left out")
        density, colour = self._value(node, "Density"), np.clip(self._value(node, "Color"), 0, None)
        kept = np.sqrt(np.clip(self._value(node, "Absorption Color"), 0, 1))
        absorbed = density * np.clip(1 - colour, 0, None) * (1 - kept)
        return density * colour, absorbed, self._value(node, "Anisotropy")

    def _add(self, node):
        """The phase function is that of the shader that scatters more."""
        first, second = (self._shader(socket) for socket in node.inputs[:2])
        more = max(first, second, key=lambda shader: shader[0].sum())
        return first[0] + second[0], first[1] + second[1], more[2]
