"""A stage as a scene dict: its prims with their shapes, cameras and lights."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any, NamedTuple

import numpy as np
from pxr import Sdf, Usd, UsdGeom, UsdLux, UsdShade

from ... import _core
from .. import limits
from ..frames import is_similarity, looking
from ..imported import Imported
from ..views import complete
from . import cameras, lights, meshes, primitives, skeletons
from .looks import Looks
from .moments import Moments, matrices
from .settings import Settings

INVISIBLE = UsdGeom.Tokens.invisible
HIDDEN = (INVISIBLE, UsdGeom.Tokens.guide, UsdGeom.Tokens.proxy)  #: what is not rendered
COPIES = limits.MEMORY // limits.PART  #: which fill the memory that a scene may take
STILL = ("constant", "directional", "envmap")
#: A stage in which z is up, turned so that y is.
Z_UP = np.array([[1.0, 0, 0, 0], [0, 0, 1, 0], [0, -1, 0, 0], [0, 0, 0, 1]])


class Part(NamedTuple):
    """A plug-in and where it is, (moments, 4, 4): in the world, or in the frame of a group."""

    name: str
    plugin: dict[str, Any]
    placed: np.ndarray
    source: Sdf.Path | None = None  #: the prim of a camera


class Reader:
    """One stage while it is read."""

    def __init__(self, stage: Usd.Stage, made: Imported):
        self._stage = stage
        self._made = made
        self._moments = Moments(stage)
        self._time = self._moments.time
        self._settings = Settings(stage)
        self._looks = Looks(made, self._time)
        self._known: dict[tuple[Any, ...], list[Part]] = {}  #: instances, by their prototype
        self._copies = 0
        self._root = np.eye(4)[None]
        if UsdGeom.GetStageUpAxis(stage) == UsdGeom.Tokens.z:
            self._root = Z_UP[None]

    def read(self) -> None:
        skeletons.pose(self._stage, self._time, self._made)
        for prim in self._stage.GetPseudoRoot().GetChildren():
            for part in self._below(prim, self._root, UsdGeom.Tokens.default_):
                self._add(part)
        self._settings.order(self._made)
        complete(self._made)

    def _add(self, part: Part) -> None:
        kind, to_world = part.plugin["type"], self._moments.to_world(part.placed)
        if kind in STILL and isinstance(to_world, dict):
            self._made.warn("lights at infinity do not move: they are as the shutter opens")
            to_world = part.placed[0]
        placed = {} if kind == "constant" else {"to_world": to_world}
        name = self._made.add(part.name, part.plugin | placed)
        self._settings.note(part.source, name)

    def _below(self, prim: Usd.Prim, parent: np.ndarray, purpose: str) -> Iterator[Part]:
        """The parts of a prim and of all below it."""
        imageable = UsdGeom.Imageable(prim)
        if imageable and purpose != INVISIBLE:
            if imageable.GetPurposeAttr().HasAuthoredValue():
                purpose = imageable.GetPurposeAttr().Get()
            if imageable.GetVisibilityAttr().Get(self._time) == INVISIBLE:
                purpose = INVISIBLE
        local, of_the_world = self._moments.of(prim)
        placed = (self._root if of_the_world else parent) @ local
        if not is_regular(placed).all():
            self._made.warn("what is scaled to nothing is left out")
            return
        yield from self._own(prim, placed, purpose in HIDDEN)
        if prim.IsA(UsdGeom.PointInstancer):
            if purpose != INVISIBLE:
                yield from self._points(UsdGeom.PointInstancer(prim), placed, purpose)
        elif prim.IsInstance():
            yield from self._instance(prim, placed, purpose)
        else:
            yield from self._children(prim, placed, purpose)

    def _own(self, prim: Usd.Prim, placed: np.ndarray, hidden: bool) -> list[Part]:
        """The parts of a prim itself, of a hidden one only a camera.

        Raises SceneError, which names the prim, if that is not possible.
        """
        try:
            if prim.IsA(UsdGeom.Camera):
                return [self._camera(prim, placed)]
            shapes = [] if hidden else self._shapes(prim, placed[0])
            return [self._part(prim, shape, placed) for shape in shapes]
        except _core.Error:
            raise
        except limits.CONTRADICTIONS as error:
            kind = type(error).__name__
            raise _core.SceneError(
                f"{prim.GetPath()}: contradicts itself: {kind}: {error!s:.200}"
            ) from None

    def _children(self, prim: Usd.Prim, placed: np.ndarray, purpose: str) -> Iterator[Part]:
        for child in prim.GetFilteredChildren(Usd.TraverseInstanceProxies()):
            yield from self._below(child, placed, purpose)

    def _shapes(self, prim: Usd.Prim, to_world: np.ndarray) -> list[dict[str, Any]]:
        """The shapes of a prim itself, or the light that it is."""
        glows = prim.HasAPI(UsdLux.LightAPI)
        if glows and not prim.IsA(UsdGeom.Gprim):
            light = lights.light(prim, self._time, to_world, self._made)
            return [light] if light else []
        shapes = self._drawn(prim)
        if glows:
            lights.make_glow(shapes, prim, self._time, to_world, self._made)
        return shapes

    def _drawn(self, prim: Usd.Prim) -> list[dict[str, Any]]:
        """The shapes of a prim itself, as its material makes them look."""
        if prim.IsA(UsdGeom.Mesh):
            return meshes.shapes(prim, self._time, self._looks, self._made)
        shape = primitives.shape(prim, self._time, self._made)
        if shape is not None:
            return [shape | self._looks.of(prim).parts()]
        if prim.IsA(UsdGeom.Gprim):
            self._made.warn(f"prims of type {prim.GetTypeName()} are left out")
        return []

    def _part(self, prim: Usd.Prim, shape: dict[str, Any], placed: np.ndarray) -> Part:
        """A shape where its prim is; spheres become meshes where they are stretched."""
        if shape["type"] == "sphere" and not all(map(is_similarity, placed)):
            mesh = primitives.ellipsoid(shape.pop("radius"), self._made)
            shape = shape | mesh
        placed = placed @ shape.pop("to_world", np.eye(4))
        if "face_normals" in shape and np.linalg.det(placed[0]) < 0:
            shape = shape | {"flip_normals": True}  # the outside stays the outside
        return Part(prim.GetName(), shape, placed)

    def _camera(self, prim: Usd.Prim, placed: np.ndarray) -> Part:
        """A camera; how large it is says how large the image of an orthographic one is."""
        sensor = self._settings.sized(cameras.camera(prim, self._time, self._made))
        frames = np.array([looking(matrix) for matrix in placed])
        if sensor["type"] == "orthographic":
            half = sensor.pop("half_width")
            sizes = np.linalg.norm(placed[:, :3, 0], axis=1) * half
            frames = frames @ np.array([np.diag([size, size, 1, 1]) for size in sizes])
        return Part(prim.GetName(), sensor, frames, prim.GetPath())

    def _instance(self, prim: Usd.Prim, placed: np.ndarray, purpose: str) -> Iterator[Part]:
        """What is below an instance: where there are several of one prototype, they share it."""
        prototype = prim.GetPrototype()
        material, _ = UsdShade.MaterialBindingAPI(prim).ComputeBoundMaterial()
        key = (prototype.GetPath(), material.GetPath(), purpose)
        if key not in self._known:
            parts = list(self._children(prim, np.eye(4)[None], purpose))
            shared = len(prototype.GetInstances()) > 1
            self._known[key] = self._grouped(prim.GetName(), parts) if shared else parts
        for part in self._known[key]:
            yield self._copy(part, prim.GetName(), placed)

    def _points(
        self, instancer: UsdGeom.PointInstancer, placed: np.ndarray, purpose: str
    ) -> Iterator[Part]:
        """The copies of a point instancer."""
        prim, stage = instancer.GetPrim(), self._stage
        targets = instancer.GetPrototypesRel().GetForwardedTargets()
        numbers = np.array(instancer.GetProtoIndicesAttr().Get(self._time) or [], dtype=int)
        places = matrices(
            instancer.ComputeInstanceTransformsAtTime(
                self._time, self._time, instancer.ExcludeProtoXform, instancer.IgnoreMask
            )
        )
        shown = np.array(instancer.ComputeMaskAtTime(self._time) or [True] * len(numbers), bool)
        for number, target in enumerate(targets):
            fit = (numbers == number) & shown & is_regular(places)
            chosen = places[fit]
            if not len(chosen):
                continue
            parts = list(self._below(stage.GetPrimAtPath(target), np.eye(4)[None], purpose))
            if len(chosen) > 1:
                parts = self._grouped(target.name, parts)
            for place in chosen:
                for part in parts:
                    yield self._copy(part, f"{prim.GetName()}-{part.name}", placed @ place)

    def _copy(self, part: Part, name: str, placed: np.ndarray) -> Part:
        """A part of a copy. Raises SceneError for more than a scene may hold, also if nested."""
        self._copies += 1
        if self._copies > COPIES:
            raise _core.SceneError(f"there are more than {COPIES} copies of prims")
        return part._replace(name=name, placed=placed @ part.placed)

    def _grouped(self, name: str, parts: list[Part]) -> list[Part]:
        """Parts of which all that can be in a group are one instance."""
        members = [part for part in parts if is_member(part)]
        if not members:
            return parts
        group = {
            f"part-{number}": part.plugin | {"to_world": part.placed[0]}
            for number, part in enumerate(members)
        }
        known = self._made.add(f"{name}-group", {"type": "shapegroup", **group})
        instance = {"type": "instance", "group": {"type": "ref", "id": known}}
        others = [part for part in parts if not is_member(part)]
        return [*others, Part(name, instance, np.eye(4)[None])]


def is_regular(placed: np.ndarray) -> np.ndarray:
    """Which of several transforms leave a volume its size, or at least some."""
    found: np.ndarray = np.linalg.det(placed[:, :3, :3]) != 0
    return found


def is_member(part: Part) -> bool:
    """Whether it can be in a group: a shape that neither emits nor moves there."""
    is_shape = part.plugin["type"] in ("mesh", "sphere", "cube", "rectangle")
    return is_shape and "emitter" not in part.plugin and len(part.placed) == 1
