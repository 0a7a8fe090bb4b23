"""Which version of pbrt a file is written for: what only one of them has tells.

The first such sign decides, in the order in which the file, with those that it includes, is read.
"""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

from ... import _core
from .. import limits
from .tokens import NO_NUMBERS, Parameter, Token, Words

#: Directives that have a type, and then parameters.
PLUGINS = ["Accelerator", "AreaLightSource", "Camera", "Film", "Integrator", "LightSource"]
PLUGINS += ["Material", "PixelFilter", "Sampler", "Shape"]
#: What the texts before the parameters of a directive are; a name tells nothing.
TEXTS = {plugin: [plugin] for plugin in PLUGINS} | {"Texture": ["name", "Texture", "class"]}
TEXTS |= {"MakeNamedMaterial": ["name"], "MakeNamedMedium": ["name"]}
#: What only pbrt-v3 has: types of plug-ins by their directives, and other names by what they are.
ONLY_IN_V3 = {
    "AreaLightSource": ["area"],
    "Camera": ["environment"],
    "Film": ["image"],
    "Integrator": ["directlighting", "whitted"],
    "LightSource": ["exinfinite"],
    "MakeNamedMedium": ["heterogeneous"],
    "Material": [
        *("disney", "fourier", "glass", "kdsubsurface", "matte", "metal", "mirror"),
        *("plastic", "substrate", "translucent", "uber"),
    ],
    "Sampler": ["02sequence", "lowdiscrepancy", "maxmindist", "random"],
    "Shape": ["cone", "heightfield", "hyperboloid", "nurbs", "paraboloid"],
    "Texture": ["color"],
    "directive": ["WorldEnd"],
    "parameter": ["Kd", "Kr", "Ks", "Kt", "bumpmap", "mapname", "namedmaterial1", "namedmaterial2"],
    "parameter type": ["color", "point", "vector", "xyz"],
}
#: What only pbrt-v4 has.
ONLY_IN_V4 = {
    "Camera": ["spherical"],
    "Film": ["gbuffer", "rgb", "spectral"],
    "Integrator": ["ambientocclusion", "lightpath", "randomwalk", "simplepath", "simplevolpath"],
    "MakeNamedMedium": ["cloud", "nanovdb", "rgbgrid", "uniformgrid"],
    "Material": [
        *("coatedconductor", "coateddiffuse", "conductor", "dielectric", "diffuse"),
        *("diffusetransmission", "interface", "measured", "thindielectric"),
    ],
    "Sampler": ["independent", "paddedsobol", "pmj02bn", "zsobol"],
    "Shape": ["bilinearmesh"],
    "directive": ["Attribute", "ColorSpace", "Import", "Option"],
    "parameter": ["illuminance", "materials", "normalmap", "power", "reflectance"],
}


def is_v3(path: Path) -> bool:
    """Whether a file is written for pbrt-v3; False where nothing tells, or it cannot be read."""
    try:
        return next(_signs(Words(path, NO_NUMBERS)), 4) == 3
    except (_core.Error, *limits.CONTRADICTIONS):
        return False


def foreign(version: int, directive: str, kind: str, given: dict[str, Parameter]) -> list[str]:
    """What of a directive is of the other version than the file."""
    said = [(directive, kind), *(("parameter", name) for name in given)]
    said += [("parameter type", parameter.kind) for parameter in given.values()]
    return [name for what, name in said if next(_only_in(what, name), version) != version]


def _signs(words: Words) -> Iterator[int]:
    """The versions that what stands in a file is for, one after the other."""
    while words.peek() is not None:
        directive = words.take()
        if directive.quoted:
            continue
        yield from _only_in("directive", directive.text)
        if directive.text in ("Import", "Include"):
            words.include(words.take(directive))
        elif directive.text in TEXTS:
            yield from _signs_of_plugin(directive, words)


def _signs_of_plugin(directive: Token, words: Words) -> Iterator[int]:
    for what in TEXTS[directive.text]:
        yield from _only_in(what, words.text(directive))
    for _, kind, name, values in words.declarations():
        yield from _only_in("parameter type", kind)
        yield from _only_in("parameter", name)
        first = next(values, None)
        if first is not None and name == "type":
            yield from _only_in(directive.text, first.text)
        if first is not None and kind == "bool":
            yield 3 if first.quoted else 4
        if kind == "blackbody" and next(values, None):
            yield 3


def _only_in(what: str, name: str) -> Iterator[int]:
    what = "Material" if what == "MakeNamedMaterial" else what
    if name in ONLY_IN_V3.get(what, ()):
        yield 3
    elif name in ONLY_IN_V4.get(what, ()):
        yield 4
