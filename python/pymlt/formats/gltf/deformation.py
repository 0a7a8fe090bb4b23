"""Morph targets and skins of meshes (glTF 2.0, sec. 3.7.2.2 and 3.7.3)."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING, Any

from ... import _core
from ..imported import Imported
from ..ply import Mesh
from .buffers import Buffers
from .checked import attributes_of

if TYPE_CHECKING:
    import numpy as np

MORPHED = ("POSITION", "NORMAL")
UNUSED = ("TANGENT",)  #: of attributes that meshes do not have here


def morphed(
    mesh: Mesh, targets: list[Any], weights: tuple[float, ...], buffers: Buffers, made: Imported
) -> Mesh:
    """The mesh plus its targets, each times its weight; without weights it stays as it is.

    Raises SceneError where counts differ.
    """
    if not weights:
        return mesh
    if len(weights) != len(targets):
        raise _core.SceneError(
            f"a mesh has {len(targets)} morph targets, but {len(weights)} weights for them"
        )
    values = {"POSITION": mesh.positions, "NORMAL": mesh.normals}
    for target, weight in zip(targets, weights, strict=True):
        given = attributes_of(target) if weight else {}
        for name in sorted(given.keys() - {*MORPHED, *UNUSED}):
            made.warn(f"morph targets of {name} are left out")
        for name in MORPHED:
            if name in given and (base := values[name]) is not None:
                difference = buffers.array(given[name])
                check_shape(difference, base.shape, f"{name} of a morph target")
                values[name] = base + weight * difference
    return mesh._replace(positions=values["POSITION"], normals=unit(values["NORMAL"]))


def skinned(mesh: Mesh, attributes: Any, matrices: np.ndarray, buffers: Buffers) -> Mesh:
    """The mesh in the world, where the matrices of its joints, (joints, 4, 4), put it."""
    import numpy as np

    blended = blended_matrices(len(mesh.positions), attributes, matrices, buffers)
    linear = blended[:, :3, :3]
    positions = np.einsum("nij,nj->ni", linear, mesh.positions) + blended[:, :3, 3]
    cofactors = np.cross(np.roll(linear, -1, axis=1), np.roll(linear, -2, axis=1))
    mirrored = np.einsum("ni,ni->n", linear[:, 0], cofactors[:, 0]) < 0
    triangles = mesh.triangles
    if mirrored.any():
        flipped = mirrored[triangles[:, 0]]
        triangles = np.where(flipped[:, None], triangles[:, ::-1], triangles)
    normals = mesh.normals
    if normals is not None:
        outwards = np.where(mirrored, -1, 1)[:, None]
        normals = unit(outwards * np.einsum("nij,nj->ni", cofactors, normals))
    return mesh._replace(positions=positions, triangles=triangles, normals=normals)


def blended_matrices(
    count: int, attributes: Any, matrices: np.ndarray, buffers: Buffers
) -> np.ndarray:
    """The mean of its joints' matrices by weight for each vertex, (count, 4, 4).

    A vertex without weights stays where it is. Raises SceneError for a joint that is not there.
    """
    import numpy as np

    sums, total = np.zeros((count, 4, 4)), np.zeros((count, 1, 1))
    for joints, weights in influences(attributes, buffers):
        check_shape(joints, (count, 4), "JOINTS of a mesh with a skin")
        check_shape(weights, (count, 4), "WEIGHTS of a mesh with a skin")
        if joints.dtype.kind != "u":
            raise _core.SceneError("JOINTS of a mesh with a skin should be unsigned integers")
        used = joints[weights != 0]
        if used.size and used.max() >= len(matrices):
            raise _core.SceneError(
                f"a vertex has joint {used.max()}, but its skin has {len(matrices)} joints"
            )
        for joint, weight in zip(joints.T, weights.T[..., None, None], strict=True):
            sums += weight * matrices[np.minimum(joint, len(matrices) - 1)]
            total += weight
    return np.where(total > 0, sums / np.where(total > 0, total, 1), np.eye(4))


def influences(attributes: Any, buffers: Buffers) -> list[tuple[np.ndarray, np.ndarray]]:
    """Joints and weights, four for each vertex, of all sets that a mesh has."""
    given = attributes_of(attributes)
    count = sum(name.startswith("JOINTS_") for name in given)
    sets = [(f"JOINTS_{number}", f"WEIGHTS_{number}") for number in range(count)]
    if not sets or not given.keys() >= {name for pair in sets for name in pair}:
        raise _core.SceneError("a mesh with a skin should have JOINTS_0 and WEIGHTS_0, or more")
    return [
        (buffers.array(given[joints]), buffers.array(given[weights])) for joints, weights in sets
    ]


def joint_matrices(skin: Any, places: Mapping[int, np.ndarray], buffers: Buffers) -> np.ndarray:
    """From the frame of a mesh to the world for each joint, (joints, 4, 4); `places` of nodes."""
    import numpy as np

    for joint in skin.joints:
        if joint not in places:
            raise _core.SceneError(f"joint {joint} of a skin is not a node of the scene")
    matrices = np.array([places[joint] for joint in skin.joints]).reshape(-1, 4, 4)
    if skin.inverseBindMatrices is not None:
        by_columns = buffers.array(skin.inverseBindMatrices)[: len(matrices)]
        check_shape(by_columns, (len(matrices), 16), "inverseBindMatrices of a skin")
        matrices = matrices @ by_columns.reshape(-1, 4, 4).transpose(0, 2, 1)
    return matrices


def check_shape(values: np.ndarray, shape: tuple[int, ...], name: str) -> None:
    """Raises SceneError for an accessor of another count or number of components."""
    if values.shape != shape:
        is_, should = (f"{rows} x {columns}" for rows, columns in (values.shape, shape))
        raise _core.SceneError(f"{name} has {is_} numbers, but should have {should}")


def unit(vectors: np.ndarray | None) -> np.ndarray | None:
    """With length 1, except those of length 0."""
    import numpy as np

    if vectors is None:
        return None
    lengths = np.linalg.norm(vectors, axis=1, keepdims=True)
    return vectors / np.where(lengths > 0, lengths, 1)
