"""What of an object has no counterpart, beside its material and its lamp."""

from pymlt.formats.imported import Imported

RAYS = ("camera", "diffuse", "glossy", "transmission", "volume_scatter", "shadow")


def warn(thing, scene, made: Imported) -> None:
    """Names it; `thing` is an evaluated object that is seen, but no lamp."""
    if thing.type in ("CURVES", "POINTCLOUD", "VOLUME"):
        made.warn("hair, point clouds and volume objects are left out")
    kinds = {
        (system.settings.type, system.settings.render_type) for system in thing.particle_systems
    }
    if ("HAIR", "PATH") in kinds:
        made.warn("hair of particle systems is left out")
    if not all(getattr(thing, f"visible_{ray}") for ray in RAYS):
        made.warn("objects that are hidden from some rays are seen by all")
    if thing.is_holdout or thing.is_shadow_catcher:
        made.warn("holdouts and shadow catchers are rendered as other objects")
    if scene.render.use_motion_blur and thing.is_deform_modified(scene, "RENDER"):
        made.warn("what is deformed while the shutter is open is sharp")
