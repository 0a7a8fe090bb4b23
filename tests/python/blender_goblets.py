"""Run by Python with `bpy`: the gallery's goblets by the extension, from the file and made anew.

Writes kept.exr and made.exr into a folder.
"""

import sys
from pathlib import Path

import bpy
from blender_engine import ROOT, render

FOLDER = ROOT / "scenes" / "goblets"


def main(folder: Path) -> None:
    sys.path[:0] = [str(FOLDER), str(ROOT)]
    import make_blend

    import blender

    blender.register()
    make_blend.make(folder / "made.blend")
    for name, path in (("made", folder / "made.blend"), ("kept", FOLDER / "goblets.blend")):
        bpy.ops.wm.open_mainfile(filepath=str(path))
        settings = bpy.context.scene.pymlt
        assert bpy.context.scene.render.engine == "PYMLT"
        assert settings.integrator == "mlt"
        assert settings.mlt.max_depth == 12
        settings.denoise = False
        render(folder / f"{name}.exr", "PYMLT")


if __name__ == "__main__":
    main(Path(sys.argv[1]))
