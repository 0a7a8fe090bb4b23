"""A render engine for Blender that renders with pymlt."""

from . import engine, panels, settings


def register() -> None:
    settings.register()
    engine.register()
    panels.register()


def unregister() -> None:
    panels.unregister()
    engine.unregister()
    settings.unregister()
