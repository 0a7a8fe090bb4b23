"""Node trees of materials as a BSDF and the light that they emit."""

from typing import NamedTuple

from pymlt.formats.imported import Imported, rgb

from . import bakes, surfaces
from .principled import dimmed, lets_light_in, metallic, principled
from .surfaces import blend, is_number, scaled, twosided
from .textures import Textures, source
from .volumes import Volumes

BLACK = surfaces.diffuse(rgb([0, 0, 0]))


class Surface(NamedTuple):
    """What a shader does with light."""

    bsdf: dict
    radiance: dict | None = None  #: of what glows
    medium: dict | None = None  #: what is inside


class Materials:
    """The materials of a scene, each of which is added once."""

    def __init__(self, made: Imported):
        self._made = made
        self._textures = Textures(made)
        self._volumes = Volumes(made)
        self._added: dict[tuple[str, str], Surface] = {}
        self._is_mixed = False
        self.unknown: dict[str, list[tuple[str, str]]] = {}  #: sockets to be baked, by material
        self._shaders = {
            "BSDF_PRINCIPLED": self._principled,
            "BSDF_DIFFUSE": self._diffuse,
            "BSDF_GLOSSY": self._glossy,
            "BSDF_METALLIC": self._metallic,
            "BSDF_GLASS": self._glass,
            "BSDF_REFRACTION": self._glass,
            "BSDF_TRANSPARENT": self._transparent,
            "EMISSION": self._emission,
            "MIX_SHADER": self._mix,
            "ADD_SHADER": self._add,
        }

    def surface(self, material, mesh=None) -> Surface:
        """A reference to the BSDF of a material, which is added with its first use.

        Where textures have been baked for a mesh, the material is another one there.
        """
        if material is None:
            return Surface(twosided(surfaces.diffuse(rgb([0.8, 0.8, 0.8]))))
        baked = bakes.of(mesh, material)
        key = (material.name_full, mesh.name_full if baked else "")
        if key not in self._added:
            self._textures.begin(baked)
            found = self._of_tree(material)
            if not all(self._textures.asked.values()):
                self.unknown[material.name_full] = list(self._textures.asked)
            reference = {"type": "ref", "id": self._made.add(material.name, found.bsdf)}
            inside = found.medium and self._made.add(f"{material.name}-volume", found.medium)
            medium = {"type": "ref", "id": inside} if inside else None
            self._added[key] = Surface(reference, found.radiance, medium)
        return self._added[key]

    def _of_tree(self, material) -> Surface:
        if not material.node_tree:
            return Surface(twosided(surfaces.diffuse(rgb(material.diffuse_color[:3]))))
        output = material.node_tree.get_output_node("CYCLES")
        if output is None:
            return Surface(BLACK)
        if output.inputs["Displacement"].is_linked:
            self._made.warn("the displacement of materials is left out")
        medium = self._volumes.medium(output.inputs["Volume"])
        if medium and not output.inputs["Surface"].is_linked:
            return Surface({"type": "null"}, medium=medium)
        return self._shader(output.inputs["Surface"])._replace(medium=medium)

    def _shader(self, socket) -> Surface:
        found = source(socket)
        if found is None:
            return Surface(BLACK)
        if found.node.type in self._shaders:
            return self._shaders[found.node.type](found.node)
        if entered := self._textures.through_shader(found, self._shader):
            return entered
        self._made.warn(f"the shader {found.node.bl_label!r} is rendered as a diffuse one")
        return Surface(twosided(surfaces.diffuse(rgb([0.8, 0.8, 0.8]))))

    def _bent(self, surface: dict, node) -> dict:
        """With the normals that are plugged in."""
        normal = node.inputs.get("Normal")
        found = normal and self._textures.plugged(normal)
        if not found:
            return surface
        if found.node.type != "NORMAL_MAP" or found.node.space != "TANGENT":
            self._made.warn(
                f"the node {found.node.bl_label!r} is left out where normals are wanted"
            )
            return surface
        if found.node.inputs["Strength"].default_value != 1:
            self._made.warn("the strength of normal maps is left out")
        if self._textures.is_baked:
            self._made.warn("normal maps of materials with baked textures are left out")
            return surface
        image = self._textures.colour(found.node.inputs["Color"])
        if image["type"] == "rgb":
            return surface
        return {"type": "normalmap", "normalmap": image, "bsdf": surface}

    def _opaque(self, surface: dict, node) -> dict:
        return twosided(self._bent(surface, node))

    def _principled(self, node) -> Surface:
        sockets = node.inputs
        made = principled(node, self._textures)
        if self._is_mixed and made.pop("subsurface_weight", 0):
            self._made.warn("subsurface scattering of shaders that are mixed is left out")
        bends = (self._textures.plugged(sockets[name]) for name in ("Normal", "Coat Normal"))
        if made.get("coat_weight") and any(bends):
            self._made.warn("coats have the normals of what they cover")
        bsdf, opacity = self._seen(made, node), self._textures.number(sockets["Alpha"])
        if not is_number(opacity) or opacity < 1:
            bsdf = {"type": "mask", "opacity": opacity, "bsdf": bsdf}
        glow = self._radiance(sockets["Emission Color"], sockets["Emission Strength"])
        return Surface(bsdf, glow and dimmed(glow, made))

    def _metallic(self, node) -> Surface:
        if node.fresnel_type != "F82":
            self._made.warn("metals have their Base Color and Edge Tint, not IOR and Extinction")
        return Surface(self._seen(metallic(node, self._textures), node))

    def _seen(self, made: dict, node) -> dict:
        """With the normals that are plugged in, and from both sides."""
        if made.get("specular_roughness_anisotropy"):
            turned = "Rotation" if node.type == "BSDF_METALLIC" else "Anisotropic Rotation"
            angle = self._textures.constant(node.inputs[turned])
            if angle or self._textures.plugged(node.inputs["Tangent"]):
                self._made.warn("highlights are stretched along the UV map alone")
        return (self._bent if lets_light_in(made) else self._opaque)(made, node)

    def _diffuse(self, node) -> Surface:
        return Surface(self._opaque(surfaces.diffuse(self._textures.colour(node.inputs[0])), node))

    def _glossy(self, node) -> Surface:
        """All colours are reflected alike at all angles."""
        colour, roughness = self._shine(node, "Color")
        if is_number(roughness) and roughness**2 < surfaces.SMOOTH:
            mirror = {"type": "conductor", "material": "none", "specular_reflectance": colour}
            return Surface(self._opaque(mirror, node))
        return Surface(self._opaque(surfaces.metal(colour, roughness), node))

    def _shine(self, node, colour: str) -> tuple:
        sockets = node.inputs
        return self._textures.colour(sockets[colour]), self._textures.number(sockets["Roughness"])

    def _glass(self, node) -> Surface:
        made = surfaces.glass(
            *self._shine(node, "Color"), self._textures.constant(node.inputs["IOR"])
        )
        return Surface(self._bent(made, node))

    def _transparent(self, node) -> Surface:
        return Surface({"type": "null"})

    def _emission(self, node) -> Surface:
        return Surface(BLACK, self._radiance(node.inputs["Color"], node.inputs["Strength"]))

    def _radiance(self, colour, strength) -> dict | None:
        """Colour times strength; None where that is black."""
        factor, tint = self._textures.constant(strength), self._textures.colour(colour)
        if not factor > 0 or not any(tint.get("value", [1])):
            return None
        return scaled(tint, factor)

    def _mix(self, node) -> Surface:
        weight = self._textures.number(node.inputs[0])
        before, self._is_mixed = self._is_mixed, True
        first, second = (self._shader(socket) for socket in node.inputs[1:3])
        self._is_mixed = before
        share = weight if is_number(weight) else 0.5
        glow = first.radiance and scaled(first.radiance, 1 - share)
        glow = glow or (second.radiance and scaled(second.radiance, share))
        return Surface(blend(weight, first.bsdf, second.bsdf), glow)

    def _add(self, node) -> Surface:
        """One of the two glows: of BSDFs, only one counts."""
        first, second = (self._shader(socket) for socket in node.inputs[:2])
        if BLACK not in (first.bsdf, second.bsdf):
            self._made.warn("of two shaders that are added, the first counts")
        bsdf = second.bsdf if first.bsdf == BLACK else first.bsdf
        return Surface(bsdf, first.radiance or second.radiance)
