"""Catmull-Clark subdivision surfaces (Catmull & Clark 1978), with creases (DeRose et al. 1998)."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from pxr import Usd, UsdGeom

from ... import _core
from .polygons import Polygons, neighbours, summed
from .primvars import Values

LEVELS = 3  #: how often a surface is divided, unless that makes it too large
CORNERS = 2**19  #: of one surface, beyond which it is not divided again
SHARP = 10.0  #: the sharpness of what stays sharp at every level


class Creases(NamedTuple):
    """What is sharp: edges, as pairs of points, and points."""

    edges: np.ndarray  #: (edges, 2)
    of_edges: np.ndarray  #: their sharpness
    of_points: np.ndarray  #: the sharpness of all points


class Edges(NamedTuple):
    """The edges between the faces of a mesh."""

    ends: np.ndarray  #: (edges, 2)
    of_corner: np.ndarray  #: the edge from each corner to the next one of its face
    faces: np.ndarray  #: how many faces each edge has
    sharpness: np.ndarray


def divided(
    given: Polygons, found: dict[str, Values | None], mesh: UsdGeom.Mesh, time: Usd.TimeCode
) -> tuple[Polygons, dict[str, Values | None]]:
    """A surface that is LEVELS times finer, with its values at corners, which are interpolated
    linearly. Raises SceneError for creases that contradict themselves.
    """
    values = {
        name: value and Values(value.rows if value.of_corners else value.rows[given.corners], True)
        for name, value in found.items()
    }
    crease = creases(mesh, given, time)
    for _ in range(LEVELS):
        if len(given.corners) > CORNERS:
            break
        values = {
            name: value and Values(refined_values(value.rows, given), True)
            for name, value in values.items()
        }
        given, crease = refined(given, crease)
    return given, values


def creases(mesh: UsdGeom.Mesh, given: Polygons, time: Usd.TimeCode) -> Creases:
    """The creases and corners of a mesh, with the corners of its boundary."""
    indices, lengths, sharpness, corners, of_corners = (
        np.array(attribute.Get(time) or [], dtype=kind)
        for attribute, kind in (
            (mesh.GetCreaseIndicesAttr(), int),
            (mesh.GetCreaseLengthsAttr(), int),
            (mesh.GetCreaseSharpnessesAttr(), float),
            (mesh.GetCornerIndicesAttr(), int),
            (mesh.GetCornerSharpnessesAttr(), float),
        )
    )
    count = len(given.points)
    ends = np.cumsum(lengths) - 1
    wrong = lengths.sum() != len(indices) or (lengths < 1).any() or len(corners) != len(of_corners)
    named = np.concatenate([indices, corners])
    if wrong or len(sharpness) not in (len(lengths), (lengths - 1).sum()):
        raise _core.SceneError(f"{mesh.GetPath()}: its creases have lengths that do not match")
    if named.size and not 0 <= named.min() <= named.max() < count:
        raise _core.SceneError(f"{mesh.GetPath()}: a crease has a point that does not exist")
    starts = np.setdiff1d(np.arange(len(indices)), ends)
    if len(sharpness) == len(lengths):
        sharpness = np.repeat(sharpness, lengths - 1)
    of_points = np.zeros(count)
    of_points[corners] = of_corners
    if mesh.GetInterpolateBoundaryAttr().Get(time) != UsdGeom.Tokens.edgeOnly:
        open_edges = edges(given, Creases(np.zeros((0, 2), int), np.zeros(0), of_points))
        on_boundary = np.unique(open_edges.ends[open_edges.faces == 1])
        once = np.bincount(given.corners, minlength=count) == 1
        of_points[on_boundary[once[on_boundary]]] = SHARP
    return Creases(np.stack([indices[starts], indices[starts + 1]], 1), sharpness, of_points)


def means(rows: np.ndarray, given: Polygons) -> np.ndarray:
    """The mean of the rows of the corners of each face."""
    sums: np.ndarray = np.add.reduceat(rows, given.starts, axis=0)
    return sums / given.counts[:, None]


def refined_values(rows: np.ndarray, given: Polygons) -> np.ndarray:
    """Rows for the corners of the next level, by linear interpolation."""
    after, before = (rows[corner] for corner in neighbours(given))
    middle = np.repeat(means(rows, given), given.counts, axis=0)
    of_quads = np.stack([rows, (rows + after) / 2, middle, (rows + before) / 2], 1)
    return of_quads.reshape(-1, rows.shape[1])


def edges(given: Polygons, crease: Creases) -> Edges:
    """The edges of a mesh, with what is sharp; so is each that has not two faces."""
    after, _ = neighbours(given)
    count = len(given.points)

    def key(ends: np.ndarray) -> np.ndarray:
        found: np.ndarray = ends.min(axis=1) * count + ends.max(axis=1)
        return found

    keys, of_corner, faces = np.unique(
        key(np.stack([given.corners, given.corners[after]], 1)),
        return_inverse=True,
        return_counts=True,
    )
    sharpness = np.where(faces == 2, 0.0, SHARP)
    sharp = key(crease.edges)
    place = np.searchsorted(keys, sharp).clip(0, len(keys) - 1)
    is_edge = keys[place] == sharp
    np.maximum.at(sharpness, place[is_edge], crease.of_edges[is_edge])
    return Edges(np.stack([keys // count, keys % count], 1), of_corner.ravel(), faces, sharpness)


def refined(given: Polygons, crease: Creases) -> tuple[Polygons, Creases]:
    """The next level: a quadrilateral for each corner."""
    found = edges(given, crease)
    middles = means(given.points[given.corners], given)
    of_corners = np.repeat(middles, given.counts, axis=0)
    points, lines = len(given.points), len(found.ends)
    every = np.concatenate(
        [
            moved_points(given, found, of_corners, crease),
            edge_points(given, found, of_corners),
            middles,
        ]
    )
    _, before = neighbours(given)
    face = np.repeat(np.arange(len(given.counts)), given.counts)
    line = points + found.of_corner
    quads = np.stack([given.corners, line, points + lines + face, line[before]], 1)
    finer = Polygons(
        every,
        np.full(len(quads), 4),
        quads.ravel(),
        given.face_of_corner,
        np.arange(quads.size),
    )
    return finer, softer(found, crease, points, len(every))


def edge_points(given: Polygons, found: Edges, of_corners: np.ndarray) -> np.ndarray:
    """The new points of edges: the mean of their ends and faces, or of their ends if sharp."""
    ends = given.points[found.ends].sum(axis=1)
    faces = summed(of_corners, found.of_corner, len(ends))
    smooth = (ends + faces) / (2 + found.faces)[:, None]
    share = found.sharpness.clip(0, 1)[:, None]
    return share * ends / 2 + (1 - share) * smooth


def moved_points(
    given: Polygons, found: Edges, of_corners: np.ndarray, crease: Creases
) -> np.ndarray:
    """Where the points go: smooth ones, those on a crease, and corners, which stay."""
    points, count = given.points, len(given.points)
    faces = np.bincount(given.corners, minlength=count)[:, None]
    both, other = found.ends.ravel(), found.ends[:, ::-1].ravel()
    lines = np.bincount(both, minlength=count)[:, None]
    around = summed(of_corners, given.corners, count) / np.maximum(faces, 1)
    opposite = summed(points[other], both, count) / np.maximum(lines, 1)
    valence = np.maximum(lines, 1)
    smooth = (around + opposite + (valence - 2) * points) / valence
    sharpness = np.repeat(found.sharpness, 2)
    is_sharp = sharpness > 0
    sharp = np.bincount(both[is_sharp], minlength=count)[:, None]
    ends = summed(points[other[is_sharp]], both[is_sharp], count)
    on_crease = np.where(sharp == 2, (6 * points + ends) / 8, points)
    mean = summed(sharpness[is_sharp, None], both[is_sharp], count) / np.maximum(sharp, 1)
    share = np.where(sharp >= 2, mean, 0).clip(0, 1)
    found_points = share * on_crease + (1 - share) * smooth
    fixed = crease.of_points.clip(0, 1)[:, None]
    stay = np.where(lines > 0, fixed, 1)
    return stay * points + (1 - stay) * found_points


def softer(found: Edges, crease: Creases, points: int, every: int) -> Creases:
    """What is left of creases at the next level, whose edges are halves."""
    left = np.flatnonzero(found.sharpness > 1)
    middle = points + left
    halves = [np.stack([found.ends[left, end], middle], 1) for end in (0, 1)]
    of_points = np.zeros(every)
    of_points[:points] = np.where(
        crease.of_points >= SHARP, SHARP, np.maximum(crease.of_points - 1, 0)
    )
    sharpness = np.where(found.sharpness >= SHARP, SHARP, found.sharpness - 1)[left]
    return Creases(np.concatenate(halves), np.tile(sharpness, 2), of_points)
