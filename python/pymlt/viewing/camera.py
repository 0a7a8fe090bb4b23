"""The camera of the browser and that of the scene.

viser has x to the right, y down, z forward; a sensor has x to the left, y up, z forward.
"""

from __future__ import annotations

from collections.abc import Iterable
from typing import TYPE_CHECKING, Any, NamedTuple

from .. import _core
from .frame import Frame

if TYPE_CHECKING:
    import numpy as np

FLIP = (-1, -1, 1)  #: the axes of the one camera in those of the other


class Pose(NamedTuple):
    """Where a camera stands, and how it is turned."""

    position: tuple[float, ...]
    wxyz: tuple[float, ...]  #: the quaternion of viser's camera

    @classmethod
    def of(cls, camera: Any) -> Pose:
        """That of a tab's camera."""
        return cls(tuple(map(float, camera.position)), tuple(map(float, camera.wxyz)))

    def is_near(self, other: Pose, size: float) -> bool:
        """Whether nobody would see the difference in a scene of this size."""
        import numpy as np

        apart = np.linalg.norm(np.subtract(self.position, other.position))
        turn = abs(np.dot(self.wxyz, other.wxyz))
        return bool(apart < 1e-5 * size and turn > 1 - 1e-9)

    def to_world(self) -> np.ndarray:
        """The transform of a sensor."""
        import numpy as np
        from viser.transforms import SO3

        matrix = np.eye(4)
        matrix[:3, :3] = SO3(np.asarray(self.wxyz)).as_matrix() * FLIP
        matrix[:3, 3] = self.position
        return matrix


class SceneCamera:
    """The sensor through which a scene is seen."""

    def __init__(self, scene: _core.Scene, sensor: int = 0):
        self._scene = scene
        self.size = (scene.width, scene.height)
        names = scene.parameters()
        self._name = _nth(names, ".shutter_open", sensor)
        if f"{self._name}.to_world" not in names:
            self._name = None  # a meter stays on its shape
        self._film = _nth(names, ".crop_width", sensor)
        if self._film and any(names[f"{self._film}.crop_{side}"] for side in ("width", "height")):
            self._film = None  # a part of an image that is smaller would be another part
        self.radius = scene.info()["radius"] or 1.0
        self._look()

    def _look(self) -> None:
        """Finds where the camera stands, by its rays."""
        import numpy as np
        from viser.transforms import SO3

        (w, h) = self.size
        aside = min(w, h) / 4  # where a round image and one of all directions have an axis
        rasters = [[w / 2, h / 2], [w / 2 + aside, h / 2], [w / 2, h], [w / 2, 0]]
        starts, directions = self._scene.camera_rays(np.array(rasters, dtype=float))
        z = directions[0]
        x = directions[1] - z * (directions[1] @ z) + (starts[1] - starts[0])
        x = x - z * (x @ z)
        x /= np.linalg.norm(x)
        y = np.cross(z, x)
        self.position = starts[0]
        rotation = SO3.from_matrix(np.stack([x, y, z], axis=1))
        self.pose = Pose(tuple(starts[0]), tuple(rotation.wxyz))
        angle = np.arccos(np.clip(directions[2] @ directions[3], -1, 1))
        # parallel rays have none, nor has a view of more than the browser can show
        self.fov = float(angle) if 1e-3 < angle < 2.8 else 0.7
        seen = self._scene.intersect(starts[:1], directions[:1])["distance"][0]
        self.target = starts[0] + z * (seen if np.isfinite(seen) else self.radius)
        self.up = _upright(-y, x)

    def frame(self, canvas: float) -> Frame:
        """Where the image lies in a window of this aspect."""
        return Frame(self.size[0] / self.size[1], canvas)

    def pixel(self, place: tuple[float, float]) -> tuple[int, int]:
        """The pixel at a place of the image, 0 to 1 each way."""
        return tuple(min(int(p * n), n - 1) for p, n in zip(place, self.size, strict=True))  # type: ignore[return-value]

    def scene(self, pose: Pose | None, divisor: int = 1) -> _core.Scene:
        """The scene as a camera there sees it, or its own; with 1/divisor of its rows."""
        values: dict[str, Any] = {}
        if pose is not None and self._name:
            values[f"{self._name}.to_world"] = pose.to_world()
        if divisor > 1 and self._film:
            for side, length in zip(("width", "height"), self.size, strict=True):
                values[f"{self._film}.{side}"] = max(1, -(-length // divisor))
        return self._scene.updated(values) if values else self._scene

    def place_first(self, camera: Any) -> None:
        """Has every tab begin with the scene's view."""
        camera.position = tuple(self.position)
        camera.look_at = tuple(self.target)
        camera.up = tuple(self.up)
        camera.fov = self.fov
        camera.near, camera.far = self.radius * 1e-3, self.radius * 1e3

    def place(self, camera: Any) -> None:
        """Brings the camera of a tab back to the scene's view."""
        camera.up_direction = tuple(self.up)
        camera.position = tuple(self.position)
        camera.look_at = tuple(self.target)


def _nth(names: Iterable[str], parameter: str, index: int) -> str | None:
    """The plug-in with a parameter that no other family has; of several, that of this index."""
    found = [name.removesuffix(parameter) for name in names if name.endswith(parameter)]
    return found[min(index, len(found) - 1)] if found else None


def _upright(up: np.ndarray, right: np.ndarray) -> np.ndarray:
    """The axis about which one walks around: that of the world to which the horizon is level, if
    there is one, else the camera's."""
    import numpy as np

    level = [axis for axis in np.eye(3) if abs(axis @ right) < 1e-3]
    if not level:
        return up
    best = max(level, key=lambda axis: abs(axis @ up))
    return best if abs(best @ up) < 1e-6 or best @ up > 0 else -best
