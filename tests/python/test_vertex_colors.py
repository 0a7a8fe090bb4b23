"""Colours of vertices: arrays of a mesh, and COLOR_0 of glTF files."""

import numpy as np
import pytest
import tiny

import pymlt as mlt
from pymlt import cli

CORNERS = np.array([[-1, 0, -1], [1, 0, -1], [1, 0, 1], [-1, 0, 1]], np.float32)
COLOURS = np.array([[1, 0, 0], [0, 1, 0], [0, 0, 1], [0.2, 0.5, 0.8]], np.float32)
SHOWN = {"type": "mesh_attribute", "name": "vertex_color"}
PLY = """ply
format ascii 1.0
element vertex 4
property float x
property float y
property float z
property float r
property float g
property float b
element face 2
property list uchar int vertex_indices
end_header
{}
3 0 2 1
3 0 3 2
"""


def scene(shape, reflectance=SHOWN) -> dict:
    paint = {"type": "diffuse", "reflectance": reflectance}
    return tiny.scene() | {"mesh": shape | {"bsdf": paint}}


def mesh(**more) -> dict:
    return {"type": "mesh", "vertices": CORNERS, "faces": [[0, 2, 1], [0, 3, 2]]} | more


def image(scene) -> np.ndarray:
    return mlt.render(scene, "path", spp=2, seed=1)


def test_colours_from_arrays_are_those_of_a_file(tmp_path):
    rows = [" ".join(map(str, row)) for row in np.hstack([CORNERS, COLOURS]).tolist()]
    (tmp_path / "m.ply").write_text(PLY.format("\n".join(rows)))
    file = {"type": "ply", "filename": str(tmp_path / "m.ply")}
    coloured = scene(mesh(vertex_color=COLOURS))
    np.testing.assert_array_equal(image(coloured), image(scene(file)))
    grey = mlt.load_dict(coloured).updated({"mesh.vertex_color": np.full((4, 3), 0.5)})
    plain = image(scene(mesh(), {"type": "rgb", "value": 0.5}))
    np.testing.assert_allclose(image(grey), plain, rtol=1e-5)


@pytest.mark.parametrize("colours", [COLOURS[:3], COLOURS[:, :2]])
def test_colours_of_other_shapes_are_refused(colours):
    with pytest.raises(mlt.SceneError, match="vertex_color"):
        mlt.load_dict(scene(mesh(vertex_color=colours)))


@pytest.mark.parametrize("painted", [True, False], ids=["material", "none"])
def test_colours_of_gltf_multiply_the_base_colour(tmp_path, painted, recwarn):
    pytest.importorskip("pygltflib", reason="needs pymlt[gltf]")
    from gltf_files import GltfFile

    file = GltfFile()
    codes = np.tile(np.array([255, 51, 0, 255], np.uint8), (4, 1))
    paint = file.material(colour=(0.5, 1, 1, 1)) if painted else None
    file.node(mesh=file.mesh(paint, COLOR_0=file.accessor(codes, normalized=True)))
    file.node(mesh=file.mesh(paint), translation=[0, 0, -50])  # the same material without colours
    file.camera(translation=[0, 0, 4])
    file.light({"type": "directional", "intensity": 3 * 683})
    read = mlt.load(file.save(tmp_path / "a.glb"), size=(8, 8))
    assert not recwarn.list
    albedo = mlt.start(read, "path", spp=4, aovs="albedo").result().layers["albedo"][4, 4]
    assert albedo == pytest.approx([0.5 if painted else 1, 0.2, 0], abs=1e-4)
    assert cli.main(["convert", str(tmp_path / "a.glb"), str(tmp_path / "a.xml")]) == 0
    converted = mlt.load(tmp_path / "a.xml", size=(8, 8))
    np.testing.assert_array_equal(image(converted), image(read))
