"""Colour spaces by their names in MaterialX, converted by the graphs of its standard library."""

from __future__ import annotations

LINEAR = ("", "none", "raw", "lin_rec709", "lin_rec709_scene", "lin_srgb", "linear")
ALIASES = {
    "lin_ap1": "acescg",
    "lin_ap1_scene": "acescg",
    "gamma18": "g18_rec709",
    "gamma22": "g22_rec709",
    "srgb": "srgb_texture",
    "sRGB": "srgb_texture",
    "g22_rec709_scene": "g22_rec709",
    "g22_ap1_scene": "g22_ap1",
    "lin_p3d65_scene": "lin_displayp3",
    "srgb_p3d65_scene": "srgb_displayp3",
    "srgb_rec709_scene": "srgb_texture",
    "srgb_rec709_display": "srgb_texture",
}


def canonical(space: str) -> str:
    """One name for each space, empty for linear Rec. 709 and for what has none."""
    return "" if space in LINEAR else ALIASES.get(space, space)
