"""Names of places in three dimensions that do not lie on top of each other."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    import numpy as np

SIZE = (45, 20)  #: of a label with two names, in pixels


class Labels:
    """The names x0, x1, ... of places in a tab, in one label where they are seen close together."""

    def __init__(self, api: Any, camera: Any, root: str):
        self._api, self._camera, self._root = api, camera, root
        self._places: Sequence[np.ndarray] = ()
        self._groups: list[list[int]] = []
        self._nodes: list[Any] = []

    def put(self, places: Sequence[np.ndarray]) -> None:
        """Name these places, and no other ones."""
        self._places, self._groups = places, []
        self.renew()

    def renew(self) -> None:
        """The camera may have moved."""
        groups = overlapping(seen_at(self._places, self._camera)) if len(self._places) else []
        if groups == self._groups and groups:
            return
        for node in self._nodes:
            node.remove()
        self._groups = groups
        self._nodes = [
            self._api.add_label(
                f"{self._root}/x{group[0]}",
                ", ".join(f"x{i}" for i in group),
                position=tuple(map(float, self._places[group[0]])),
            )
            for group in groups
        ]


def seen_at(places: Sequence[np.ndarray], camera: Any) -> np.ndarray:
    """Where a tab's camera sees them, in pixels to the right and down; NaN behind it."""
    import numpy as np
    from viser.transforms import SO3

    turned = (np.asarray(places, dtype=float) - camera.position) @ SO3(
        np.asarray(camera.wxyz, dtype=float)
    ).as_matrix()
    depth = np.where(turned[:, 2:] > 0, turned[:, 2:], np.nan)
    return turned[:, :2] / depth * camera.image_height / (2 * np.tan(camera.fov / 2))


def overlapping(points: np.ndarray) -> list[list[int]]:
    """Indices of points; in one group are those whose labels would cover that of its first."""
    groups: list[list[int]] = []
    for i, point in enumerate(points):
        near = [group for group in groups if (abs(point - points[group[0]]) < SIZE).all()]
        if near:
            near[0].append(i)
        else:
            groups.append([i])
    return groups
