"""Run by Python with `bpy`: what the extension, installed from a zip, does beside pictures.

Writes facts.json and pictures into a folder.
"""

import json
import sys
import time
from pathlib import Path

import bpy


def install(archive: str) -> str:
    """Installs and enables the extension, as the command of Blender's preferences does."""
    bpy.ops.extensions.package_install_files(
        filepath=archive, repo="user_default", enable_on_install=True
    )
    return next(addon.module for addon in bpy.context.preferences.addons if "pymlt" in addon.module)


def small(**settings):
    """Blender's default cube, rendered shortly."""
    bpy.ops.wm.read_homefile(use_factory_startup=True)
    scene = bpy.context.scene
    scene.render.engine = "PYMLT"
    scene.render.resolution_x, scene.render.resolution_y = 32, 18
    given = {"integrator": "path", "samples": 16, "time": 0, "error": 0} | settings
    for name, value in given.items():
        setattr(scene.pymlt, name, value)
    return scene


def failure(scene) -> str:
    try:
        bpy.ops.render.render()
    except RuntimeError as error:
        return str(error)
    return ""


def bad_parameter() -> str:
    scene = small()
    scene.pymlt.path.max_depth = -7
    return failure(scene)


def cancelled(engine) -> float:
    """Seconds that a long render takes that Blender wants to end."""
    small(samples=10**8)
    follow = engine.follow
    engine.follow = lambda job, is_stopped, show: follow(job, lambda: True, show)
    begin = time.monotonic()
    bpy.ops.render.render()
    engine.follow = follow
    return time.monotonic() - begin


def shown(engine) -> list[str]:
    """What the line of statistics says during a render."""
    texts = []
    statistics = engine.statistics
    engine.statistics = lambda found: texts.append(statistics(found)) or texts[-1]
    small()
    bpy.ops.render.render()
    engine.statistics = statistics
    return texts


def noisy(path: Path, seed: int, denoise: bool) -> None:
    scene = small(samples=1, seed=seed, denoise=denoise)
    scene.render.resolution_x, scene.render.resolution_y = 64, 36
    scene.render.image_settings.file_format = "OPEN_EXR"
    scene.render.filepath = str(path)
    bpy.ops.render.render(write_still=True)


def layers(path: Path) -> None:
    """A second view layer, without the cube."""
    scene = small()
    scene.view_layers.new("Second").layer_collection.children[0].exclude = True
    save(path)


def passes(path: Path) -> None:
    small()
    save(path)


def transparent(path: Path) -> None:
    small().render.film_transparent = True
    save(path)


def save(path: Path) -> None:
    """Renders into a file with all passes of all layers."""
    image = bpy.context.scene.render.image_settings
    if hasattr(image, "media_type"):  # Blender 5
        image.media_type = "MULTI_LAYER_IMAGE"
    image.file_format, image.color_depth = "OPEN_EXR_MULTILAYER", "32"
    bpy.context.scene.render.filepath = str(path)
    bpy.ops.render.render(write_still=True)


def main(archive: str, folder: Path) -> None:
    name = install(archive)
    engine = sys.modules[f"{name}.engine"]
    scene = small()
    defaults = {
        group: list(getattr(scene.pymlt, group).__annotations__) for group in ("mlt", "path")
    }
    facts = {
        "enabled": name,
        "parameters": defaults,
        "error": bad_parameter(),
        "cancelled": cancelled(engine),
        "shown": shown(engine),
    }
    passes(folder / "passes.exr")
    layers(folder / "layers.exr")
    transparent(folder / "transparent.exr")
    for seed in range(4):
        noisy(folder / f"noisy{seed}.exr", seed, denoise=False)
        noisy(folder / f"denoised{seed}.exr", seed, denoise=True)
    bpy.ops.preferences.addon_disable(module=name)
    facts["disabled"] = not hasattr(bpy.types.Scene, "pymlt")
    (folder / "facts.json").write_text(json.dumps(facts))


main(sys.argv[1], Path(sys.argv[2]))
