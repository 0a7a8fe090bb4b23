"""A render engine for Blender that renders with pymlt."""

from . import engine, left_out, panels, settings


def register() -> None:
    settings.register()
    engine.register()
    left_out.register()
    panels.register()


def unregister() -> None:
    panels.unregister()
    left_out.unregister()
    engine.unregister()
    settings.unregister()
