"""How files of pbrt-v3 are told from those of pbrt-v4: by names that only v3 has."""

from __future__ import annotations

from .tokens import Parameter

MATERIALS = frozenset(
    [
        "disney",
        "fourier",
        "glass",
        "kdsubsurface",
        "matte",
        "metal",
        "mirror",
        "plastic",
        "substrate",
        "translucent",
        "uber",
    ]
)
KINDS = {  #: the types of plug-ins, by their directives
    "AreaLightSource": frozenset({"area"}),
    "Film": frozenset({"image"}),
    "Integrator": frozenset({"directlighting", "whitted"}),
    "Material": MATERIALS,
    "MakeNamedMaterial": MATERIALS,
    "Sampler": frozenset({"02sequence", "lowdiscrepancy", "maxmindist", "random"}),
}
WARNING = (
    "it is a file of pbrt-v3, and is read as one of pbrt-v4, in which colours, materials and lamps"
    " mean something else; `pbrt --upgrade FILE` of pbrt-v4 writes it anew"
)


def only_in_v3(directive: str, kind: str, parameters: dict[str, Parameter]) -> bool:
    """Whether a directive of this kind has no meaning in pbrt-v4."""
    return kind in KINDS.get(directive, ()) or any(
        parameter.kind in ("color", "xyz") for parameter in parameters.values()
    )
