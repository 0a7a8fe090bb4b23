"""Built-in scenes: functions that return a Mitsuba dict for `load_dict` or `render`.

image = mlt.render(mlt.scenes.door_ajar(), "pssmlt", spp=64)

The scenes are the folders of `scenes/`, each with a scene.xml (which `load_file` and mlt-render
read as well) and a README.md. Here the XML is read into a dict, in which everything can be
changed. `filter` is the film's reconstruction filter: "box" where the image is to be denoised.
"""

from __future__ import annotations

import inspect
import sys

from .xml_to_dict import load as _load


def names() -> list[str]:
    """The names of the built-in scenes."""
    module = sys.modules[__name__]
    return [
        name
        for name, function in inspect.getmembers(module, inspect.isfunction)
        if function.__module__ == __name__ and name != "names" and not name.startswith("_")
    ]


def cornell_box() -> dict:
    """The Cornell box (Goral et al. 1984) with the measures and colours of Mitsuba 3's own."""
    return _load("cornell-box")


def glass_ball(filter: str = "gaussian") -> dict:
    """The Cornell box with a glass ball and a light a tenth as wide: a caustic on the floor."""
    return _load("glass-ball", filter=filter)


def door_ajar(opening: float = 16, filter: str = "gaussian") -> dict:
    """A dark room and the light of the next one through a door, which is `opening` degrees open."""
    return _load("door-ajar", opening=opening, filter=filter)


def pool(filter: str = "gaussian") -> dict:
    """A tiled pool below a small light: all is seen and lit through rippled water."""
    return _load("pool", filter=filter)


def drink() -> dict:
    """A full glass of water with ice and a straw: solids that overlap, by their priorities."""
    return _load("drink")


def ring(filter: str = "gaussian") -> dict:
    """A gold ring on paper below a small light: the caustic of a cylindrical mirror."""
    return _load("ring", filter=filter)


def furnace() -> dict:
    """A closed box that emits e and reflects a: the radiance is e / (1 - a) = 0.5 everywhere."""
    return _load("furnace")


def dof(aperture: float = 0.07, filter: str = "gaussian") -> dict:
    """Glass balls before a lens of radius `aperture`: caustics within the blur."""
    return _load("dof", aperture=aperture, filter=filter)


def motion(shutter: float = 1, filter: str = "gaussian") -> dict:
    """A lamp, a glass ball and a fan that move until the shutter closes at time `shutter`."""
    return _load("motion", shutter=shutter, filter=filter)


def goblets() -> dict:
    """Coloured glass in the light of a low lamp, and what it does to that light on the table."""
    return _load("goblets")


def bulb() -> dict:
    """A ribbed bulb, whose glass draws lines with the light of its filament."""
    return _load("bulb")


def orrery(shutter: float = 1) -> dict:
    """Planets that go round a lamp until the shutter closes at time `shutter`."""
    return _load("orrery", shutter=shutter)


def temple() -> dict:
    """A round temple by a lake, below a low sun and its sky."""
    return _load("temple")


def fog(filter: str = "gaussian") -> dict:
    """A dark attic full of dust, and the sun through the slats of its shutter."""
    return _load("fog", filter=filter)


def volcaustic(filter: str = "gaussian") -> dict:
    """Balls of glass in haze under a small lamp: what they gather is seen in the haze itself."""
    return _load("volcaustic", filter=filter)


def milk(filter: str = "gaussian") -> dict:
    """A glass of water with a little milk in it, in the light of a low lamp."""
    return _load("milk", filter=filter)


def candle(filter: str = "gaussian") -> dict:
    """A candle whose wax glows in the light of its flame, and two marbles."""
    return _load("candle", filter=filter)


def skin(filter: str = "gaussian") -> dict:
    """A slab of skin, half of it behind a pane of rough glass, with a small lamp behind it."""
    return _load("skin", filter=filter)


def smoke(filter: str = "gaussian") -> dict:
    """A plume of smoke, a grid, before a dark wall and beside a low lamp."""
    return _load("smoke", filter=filter)


def prism(filter: str = "gaussian") -> dict:
    """A sheet of white light through a prism of flint glass, and its spectrum on a screen."""
    return _load("prism", filter=filter)


def diamond(filter: str = "gaussian") -> dict:
    """A diamond of brilliant cut among narrow lamps: its fire, and coloured light about it."""
    return _load("diamond", filter=filter)


def rainbow(filter: str = "gaussian") -> dict:
    """A sphere of water in parallel light, which throws both rainbows back on a screen."""
    return _load("rainbow", filter=filter)
