"""Kinds of files by their extensions: which are read, and what to do with those that are not."""

from __future__ import annotations

import os

from .. import _core

MESHES = (".ply", ".obj", ".stl", ".ply.gz", ".obj.gz")
USD = (".usd", ".usda", ".usdc", ".usdz")
EXTENSIONS = (".gltf", ".glb", ".pbrt", ".mtlx", *USD, *MESHES)

_BLENDER = "export it from Blender as glTF (.glb), or render it there with pymlt's extension"
_IMPORT = "import it into Blender and export it as glTF (.glb)"
_CAD = "export it from the CAD program, such as FreeCAD, as glTF (.glb), .obj or .stl"
_CONVERT = "convert it to glTF, for example by `assimp export IN OUT.glb`"


def _own(program: str) -> tuple[str, str]:
    return f"a scene of {program}", f"export it from {program} as glTF (.glb)"


#: What a file is, and how it becomes one that is read.
OTHERS = {
    (".blend",): ("a scene of Blender", _BLENDER),
    (".fbx",): ("Autodesk FBX", _IMPORT),
    (".dae",): ("COLLADA", _CONVERT),
    (".abc",): ("Alembic", _IMPORT),
    (".x3d", ".wrl"): ("X3D or VRML", _CONVERT),
    (".3ds",): ("a scene of 3D Studio", _CONVERT),
    (".step", ".stp"): ("STEP, surfaces without triangles", _CAD),
    (".iges", ".igs"): ("IGES, surfaces without triangles", _CAD),
    (".off",): ("a mesh in the Object File Format", _CONVERT),
    (".3mf",): ("a model for 3D printers", _CONVERT),
    (".max",): _own("3ds Max"),
    (".c4d",): _own("Cinema 4D"),
    (".ma", ".mb"): _own("Maya"),
    (".lwo", ".lws"): ("a model of LightWave", _CONVERT),
    (".3dm",): _own("Rhino"),
    (".skp",): _own("SketchUp"),
    (".hip",): _own("Houdini"),
}


def is_foreign(path: str | os.PathLike[str]) -> bool:
    """Whether a file of this name is a scene of another program, materials, or a mesh alone."""
    return os.fspath(path).lower().endswith(EXTENSIONS)


def check_kind(path: str | os.PathLike[str]) -> None:
    """Raises UsageError for a file whose name says that no reader here knows it."""
    text = os.fspath(path)
    for extensions, (kind, advice) in OTHERS.items():
        if text.lower().endswith(extensions):
            raise _core.UsageError(f"{text}: {kind} is not read here; {advice}")


def check_is_mitsuba(path: str | os.PathLike[str]) -> None:
    """Raises UsageError for a file that exists and whose name says that it is no Mitsuba XML."""
    text = os.fspath(path)
    if not os.path.exists(text):
        return
    check_kind(text)
    if is_foreign(text):
        raise _core.UsageError(f"{text}: load_file reads Mitsuba XML; load reads this file")
