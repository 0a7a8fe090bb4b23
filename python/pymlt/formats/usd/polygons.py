"""Faces with any number of corners, and the triangles that they become."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from pxr import Usd, UsdGeom

from ... import _core


class Polygons(NamedTuple):
    """The faces of a mesh, one after the other."""

    points: np.ndarray  #: (points, 3)
    counts: np.ndarray  #: of corners, by face
    corners: np.ndarray  #: indices of points
    parents: np.ndarray  #: the faces in the file, by face
    kept: np.ndarray  #: the corners in the file, by corner

    @property
    def starts(self) -> np.ndarray:
        """The first corner of each face."""
        return np.cumsum(self.counts) - self.counts

    @property
    def face_of_corner(self) -> np.ndarray:
        """The face in the file that each corner belongs to."""
        return np.repeat(self.parents, self.counts)


def polygons(mesh: UsdGeom.Mesh, time: Usd.TimeCode) -> Polygons:
    """The faces of a mesh, counter-clockwise if seen from outside.

    Raises SceneError where counts and indices contradict each other.
    """
    path = mesh.GetPath()
    points = np.array(mesh.GetPointsAttr().Get(time) or [], dtype=float).reshape(-1, 3)
    counts = np.array(mesh.GetFaceVertexCountsAttr().Get(time) or [], dtype=np.int64)
    corners = np.array(mesh.GetFaceVertexIndicesAttr().Get(time) or [], dtype=np.int64)
    if (counts < 0).any() or counts.sum() != len(corners):
        raise _core.SceneError(
            f"{path}: faceVertexCounts add up to {counts.sum()}, but should to the "
            f"{len(corners)} of faceVertexIndices"
        )
    if corners.size and not 0 <= corners.min() <= corners.max() < len(points):
        raise _core.SceneError(f"{path}: a face has a point that does not exist")
    kept = np.arange(len(corners))
    if mesh.GetOrientationAttr().Get(time) == UsdGeom.Tokens.leftHanded:
        kept = reversed_corners(counts)
    return Polygons(points, counts, corners[kept], np.arange(len(counts)), kept)


def reversed_corners(counts: np.ndarray) -> np.ndarray:
    """The corners of each face in the other order, from the same first one."""
    starts = np.cumsum(counts) - counts
    start, count = np.repeat(starts, counts), np.repeat(counts, counts)
    number = np.arange(counts.sum()) - start
    return start + np.where(number == 0, 0, count - number)


def without(given: Polygons, holes: np.ndarray) -> Polygons:
    """The faces that are no holes, which a file gives by their numbers, and have an area."""
    left = ~np.isin(given.parents, holes) & (given.counts > 2)
    corners = np.repeat(left, given.counts)
    return Polygons(
        given.points,
        given.counts[left],
        given.corners[corners],
        given.parents[left],
        given.kept[corners],
    )


def triangles(given: Polygons) -> tuple[np.ndarray, np.ndarray]:
    """A fan for each face: numbers of corners, (triangles, 3), and the faces in the file.

    That is how USD itself triangulates, also what is not convex.
    """
    fans = np.maximum(given.counts - 2, 0)
    face = np.repeat(np.arange(len(given.counts)), fans)
    number = np.arange(fans.sum()) - np.repeat(np.cumsum(fans) - fans, fans)
    first = given.starts[face]
    return np.stack([first, first + number + 1, first + number + 2], axis=1), given.parents[face]


def neighbours(given: Polygons) -> tuple[np.ndarray, np.ndarray]:
    """The next and the previous corner of the face of each corner."""
    start = np.repeat(given.starts, given.counts)
    count = np.repeat(given.counts, given.counts)
    number = np.arange(len(start)) - start
    return start + (number + 1) % count, start + (number - 1) % count


def summed(rows: np.ndarray, place: np.ndarray, count: int) -> np.ndarray:
    """The sum of the rows that go to each place, (count, width)."""
    columns = [np.bincount(place, weights=column, minlength=count) for column in rows.T]
    return np.stack(columns, 1)


def smooth_normals(given: Polygons) -> np.ndarray:
    """Normals at points, (points, 3): the mean of those of the faces, by their areas."""
    if not len(given.corners):
        return np.zeros_like(given.points)
    origins = np.repeat(given.points[given.corners[given.starts]], given.counts, axis=0)
    after, _ = neighbours(given)
    spokes = given.points[given.corners] - origins
    areas = np.add.reduceat(np.cross(spokes, spokes[after]), given.starts, axis=0)
    normals = summed(np.repeat(areas, given.counts, axis=0), given.corners, len(given.points))
    lengths = np.linalg.norm(normals, axis=1, keepdims=True)
    return np.where(lengths > 0, normals / np.where(lengths > 0, lengths, 1), [0.0, 0, 1])
