"""Networks of shaders: where the value of an input comes from."""

from __future__ import annotations

from typing import Any, NamedTuple

from pxr import Usd, UsdShade


class Node(NamedTuple):
    """A shader, of which an output is used."""

    shader: UsdShade.Shader
    output: str
    time: Usd.TimeCode

    @property
    def id(self) -> str:
        """Which shader it is, such as UsdUVTexture."""
        return str(self.shader.GetShaderId() or "")

    def source(self, name: str) -> Node | None:
        """The shader that an input is connected to, if there is one."""
        attribute = self.attribute(name)
        if attribute is None or UsdShade.Utils.GetType(attribute.GetName()) != OUTPUT:
            return None
        shader = UsdShade.Shader(attribute.GetPrim())
        return Node(shader, UsdShade.Output(attribute).GetBaseName(), self.time)

    def attribute(self, name: str) -> Usd.Attribute | None:
        """Where the value of an input stands: at the input, or at what it is connected to."""
        given = self.shader.GetInput(name)
        found = given.GetValueProducingAttributes() if given else []
        return found[0] if found else None

    def value(self, name: str, default: Any) -> Any:
        """The value of an input that is connected to no shader."""
        attribute = self.attribute(name)
        if attribute is None or UsdShade.Utils.GetType(attribute.GetName()) == OUTPUT:
            return default
        found = attribute.Get(self.time)
        return default if found is None else found

    def numbers(self, name: str, default: Any) -> list[float]:
        """A value of several numbers."""
        return [float(number) for number in self.value(name, default)]


OUTPUT = UsdShade.AttributeType.Output
