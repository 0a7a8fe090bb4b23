"""The scene's shapes and its light paths in three dimensions, for the page."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from .. import _core
from .labels import Labels
from .pixel_paths import polyline

if TYPE_CHECKING:
    import numpy as np

MOST_TRIANGLES = 60_000  #: that a page gets
LAMP = (255, 220, 120)


class Meshes:
    """The shapes of a scene in a tab, made when they are first shown."""

    def __init__(self, scene: _core.Scene, api: Any):
        self._scene, self._api = scene, api
        self._nodes: list[Any] = []

    def show(self, visible: bool, opacity: float) -> None:
        if visible and not self._nodes:
            self._add()
        for node in self._nodes:
            node.visible, node.opacity = visible, opacity

    def _add(self) -> None:
        shapes = self._scene.triangles()
        total = sum(len(shape["faces"]) for shape in shapes)
        for shape in shapes:
            points, faces = shape["positions"], shape["faces"]
            if total > MOST_TRIANGLES:
                points, faces = simplified(points, faces, MOST_TRIANGLES * len(faces) // total)
            if len(faces):
                self._nodes.append(
                    self._api.add_mesh_simple(
                        f"/shapes/{shape['shape']}",
                        points,
                        faces,
                        color=LAMP if shape["emits"] else _colour(shape["albedo"]),
                        side="double",
                        flat_shading=True,
                        cast_shadow=False,
                        receive_shadow=False,
                    )
                )


def _colour(albedo: tuple[float, float, float]) -> tuple[int, ...]:
    """For a display, and never so dark that it cannot be seen."""
    return tuple(int(60 + 180 * min(max(c, 0.0), 1.0) ** 0.45) if c == c else 128 for c in albedo)


def simplified(points: np.ndarray, faces: np.ndarray, most: int) -> tuple[np.ndarray, np.ndarray]:
    """Vertices in one cell of a grid become one, their mean; the finest grid that leaves about
    `most` triangles (Rossignac & Borrel 1993, Multi-resolution 3D approximations).
    """
    import numpy as np

    if len(faces) <= max(most, 12):
        return points, faces
    low, size = points.min(axis=0), np.ptp(points, axis=0).max() or 1.0
    cells = max(2, int(np.sqrt(max(most, 12))))
    while True:
        keys = np.floor((points - low) / size * (cells - 1e-6)).astype(np.int64)
        _, index, counts = np.unique(keys, axis=0, return_inverse=True, return_counts=True)
        merged = index.reshape(-1)[faces]
        a, b, c = merged.T
        merged = np.unique(merged[(a != b) & (b != c) & (a != c)], axis=0)
        if len(merged) <= max(most, 12) or cells <= 2:
            break
        cells = int(cells * 0.8)
    means = np.zeros((len(counts), 3))
    np.add.at(means, index.reshape(-1), points)
    return (means / counts[:, None]).astype(np.float32), merged.astype(np.uint32)


class Lines:
    """Light paths as lines and tubes in a tab, each under a name."""

    def __init__(self, api: Any, camera: Any, radius: float):
        self._api, self._reach, self._dot = api, 2 * radius, 0.008 * radius
        self.labels = Labels(api, camera, "/paths/names")  #: of the vertices of one path
        self._root = api.add_frame("/paths", show_axes=False)
        self._nodes: dict[str, Any] = {}
        self._named = ""  # the path whose vertices have names

    def show(self, visible: bool) -> None:
        self._root.visible = visible

    def clear(self, name: str) -> None:
        node = self._nodes.pop(name, None)
        if node is not None:
            node.remove()  # with what stands under its name
        if name == self._named:
            self.labels.put([])

    def draw(self, name: str, path: _core.LightPath, colour: Any, width: float) -> None:
        """The edges of a path, as lines of this width in pixels."""
        import numpy as np

        self.clear(name)
        points = polyline(path, self._reach).astype(np.float32)
        self._nodes[name] = self._api.add_line_segments(
            f"/paths/{name}",
            np.stack([points[:-1], points[1:]], axis=1),
            _linear(colour),
            thickness=width,
            thickness_units="screen",
        )

    def draw_one(self, name: str, path: _core.LightPath, colour: Any) -> None:
        """One path with a dot and a name at each vertex but that on the lens."""
        self.draw(name, path, colour, 4)
        places = polyline(path, self._reach)[:-1]
        for i, point in enumerate(places):
            self._api.add_icosphere(
                f"/paths/{name}/x{i}",
                self._dot,
                colour,
                subdivisions=2,
                position=tuple(map(float, point)),
                cast_shadow=False,
                receive_shadow=False,
            )
        self._named = name
        self.labels.put(places)

    def draw_tubes(self, name: str, paths: list[_core.LightPath], colours: list[Any]) -> None:
        """Half transparent, which lines cannot be; without the edges to the lens, since a tube
        around the eye would hide the picture.
        """
        import numpy as np

        self.clear(name)
        lines = [polyline(path, self._reach)[:-1] for path in paths]
        starts, ends = (
            np.concatenate([line[part] for line in lines] or [np.empty((0, 3))])
            for part in (slice(-1), slice(1, None))
        )
        if len(starts):
            self._nodes[name] = self._api.add_batched_meshes_simple(
                f"/paths/{name}",
                **_tubes(starts, ends, 0.3 * self._dot),
                batched_colors=np.repeat(
                    _linear(colours), [len(line) - 1 for line in lines], axis=0
                ),
                opacity=0.5,
                lod="off",
                cast_shadow=False,
                receive_shadow=False,
            )


def _tubes(starts: np.ndarray, ends: np.ndarray, radius: float) -> dict[str, np.ndarray]:
    """A cylinder along z, and what turns it into one from each start to its end."""
    import numpy as np
    import trimesh

    edges = ends - starts
    lengths = np.maximum(np.linalg.norm(edges, axis=1), 1e-20)
    x, y, z = (edges * np.where(edges[:, 2] < 0, -1, 1)[:, None] / lengths[:, None]).T
    # The rotation from z to d is the quaternion (1 + cos, z x d) at unit length.
    turns = np.stack([1 + z, -y, x, 0 * z], axis=1)
    cylinder = trimesh.creation.cylinder(1.0, 1.0, sections=8)
    return {
        "vertices": cylinder.vertices,
        "faces": cylinder.faces,
        "batched_wxyzs": turns / np.linalg.norm(turns, axis=1, keepdims=True),
        "batched_positions": (starts + ends) / 2,
        "batched_scales": np.stack([0 * lengths + radius, 0 * lengths + radius, lengths], axis=1),
    }


def _linear(colour: Any) -> np.ndarray:
    """The page takes colours of lines and tubes as linear light."""
    import numpy as np

    return (255 * (np.array(colour) / 255) ** 2.2).astype(np.uint8)
