"""Cameras: Blender's look along -z with +x to the right, pymlt's along +z with +x to the left."""

import math

import numpy as np

TURNED = np.diag([-1.0, 1.0, -1.0, 1.0])
KINDS = ("perspective", "thinlens", "orthographic")


def unscaled(to_world: np.ndarray) -> np.ndarray:
    """A placement with axes of length 1, of a thing whose scale does not count."""
    placed = to_world.copy()
    placed[:3, :3] /= np.linalg.norm(placed[:3, :3], axis=0)
    return placed


def film(width: int, height: int, crop: tuple[int, int, int, int] | None = None) -> dict:
    """An image, or the part of it that begins at `crop[:2]` and is `crop[2:]` large."""
    made = {"type": "hdrfilm", "width": width, "height": height}
    names = ("crop_offset_x", "crop_offset_y", "crop_width", "crop_height")
    return made | dict(zip(names, crop or (), strict=False))


def border(render, width: int, height: int) -> tuple[int, int, int, int] | None:
    """The render border as left, top, width, height in pixels; Blender counts from the bottom."""
    if not render.use_border:
        return None
    left, right = (int(share * width) for share in (render.border_min_x, render.border_max_x))
    bottom, top = (int(share * height) for share in (render.border_min_y, render.border_max_y))
    return left, height - top, max(right - left, 1), max(top - bottom, 1)


def sensor(to_world, projection, image: dict, lens: dict) -> dict:
    """The camera with this projection matrix (OpenGL's), whose film is `image`."""
    placed, projection = unscaled(np.array(to_world)), np.array(projection)
    half = 1 / projection[0, 0], 1 / projection[1, 1]
    if projection[3, 3] == 1:
        shift = [-projection[0, 3] * half[0], -projection[1, 3] * half[1], 0]
        placed[:3, 3] += placed[:3, :3] @ shift
        placed = placed @ TURNED @ np.diag([half[0], half[0], 1, 1])
        return {"type": "orthographic", "to_world": placed, "film": image}
    # Where the middle of the image is, in halves of its size.
    right, up = projection[0, 2], projection[1, 2]
    return {
        "type": "thinlens" if lens else "perspective",
        "to_world": placed @ TURNED,
        "fov": 2 * math.degrees(math.atan(half[0])),
        "principal_point_offset_x": right / 2,
        "principal_point_offset_y": -up / 2,
        "film": image,
        **lens,
    }


def lens(camera) -> dict:
    """The aperture of a camera with depth of field; else nothing."""
    data, field = camera.data, camera.data.dof
    if data.type != "PERSP" or not field.use_dof:
        return {}
    distance = field.focus_distance
    if field.focus_object:
        place = camera.matrix_world.inverted() @ field.focus_object.matrix_world.translation
        distance = max(-place.z, 1e-3)
    # The focal length is in millimetres, the f-number its ratio to the diameter.
    radius = data.lens / 1000 / (2 * field.aperture_fstop)
    return {"aperture_radius": radius, "focus_distance": distance}
