"""A render engine for Blender that renders with pymlt."""

from . import baking, engine, left_out, panels, settings, shot


def register() -> None:
    settings.register()
    baking.register()
    engine.register()
    shot.register()
    left_out.register()
    panels.register()


def unregister() -> None:
    panels.unregister()
    left_out.unregister()
    shot.unregister()
    engine.unregister()
    baking.unregister()
    settings.unregister()
