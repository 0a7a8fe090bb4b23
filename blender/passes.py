"""The passes of a render, and how pixels get into them."""

from typing import NamedTuple

import numpy as np


class Pass(NamedTuple):
    """An image beside the picture."""

    layer: str  #: its name in `Result.layers`
    channels: str  #: Blender's names of them
    kind: str  #: Blender's type


EXTRA = {
    "Error": Pass("error", "RGB", "COLOR"),
    "Albedo": Pass("albedo", "RGB", "COLOR"),
    "Normal": Pass("normal", "XYZ", "VECTOR"),
    "Depth": Pass("depth", "Z", "VALUE"),
}
AOVS = "albedo,normal:sh_normal,depth"
SEEN_FIRST = ("albedo", "normal", "depth", "alpha")  #: layers that no light is needed for
NOTHING = 1e10  #: depth where the camera sees nothing, as in Blender


def register(engine, scene, layer) -> None:
    """Tells the compositor what there is."""
    engine.register_pass(scene, layer, "Combined", 4, "RGBA", "COLOR")
    for name, (_, channels, kind) in EXTRA.items():
        engine.register_pass(scene, layer, name, len(channels), channels, kind)


def add(engine) -> None:
    """Makes room for the passes that Blender does not make itself."""
    for name, (_, channels, _) in EXTRA.items():
        engine.add_pass(name, len(channels), channels)


def write(layer, image: np.ndarray, layers: dict[str, np.ndarray]) -> None:
    """Fills the passes of a layer of Blender's result, whose rows begin at the bottom."""
    fill(layer, "Combined", rgba(image, layers.get("alpha", 1)))
    for name, (key, channels, _) in EXTRA.items():
        if key in layers:
            pixels = layers[key][..., : len(channels)]
            fill(layer, name, np.where(pixels > 0, pixels, NOTHING) if key == "depth" else pixels)


def rgba(image: np.ndarray, alpha=1) -> np.ndarray:
    """A picture with its alpha, by which it is multiplied, as Blender's are."""
    return np.concatenate([image, np.full((*image.shape[:2], 1), alpha, np.float32)], axis=2)


def fill(layer, name: str, pixels: np.ndarray) -> None:
    found = layer.passes.get(name)
    if found is not None:
        found.rect.foreach_set(np.ascontiguousarray(pixels[::-1], np.float32).ravel())
