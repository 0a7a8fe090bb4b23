"""Copies of meshes in glTF files."""

import numpy as np
import pytest

import pymlt as mlt

pytest.importorskip("pygltflib", reason="needs pymlt[gltf]")

from gltf_files import CORNERS, GltfFile, converted

HALF = np.sqrt(0.5)


@pytest.fixture(autouse=True)
def folder(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)


def instanced(file: GltfFile, **attributes) -> dict:
    """The extension of a node."""
    given = {name: file.accessor(values, **more) for name, (values, more) in attributes.items()}
    return {"EXT_mesh_gpu_instancing": {"attributes": given}}


TRANSLATIONS = np.array([[1, 0, 0], [0, 2, 0], [0, 0, 3]], np.float32)
SCALES = np.array([[1, 1, 1], [2, 2, 2], [1, 3, 1]], np.float32)
# A half turn about x, a quarter turn about z, none.
TURNS = np.array([[1, 0, 0, 0], [0, 0, HALF, HALF], [0, 0, 0, 1]])
ROTATIONS = [np.diag([1, -1, -1]), np.array([[0, -1, 0], [1, 0, 0], [0, 0, 1]]), np.eye(3)]
KINDS = {
    "floats": (TURNS.astype(np.float32), {}),
    "bytes": (np.round(TURNS * 127).astype(np.int8), {"normalized": True}),
    "shorts": (np.round(TURNS * 32767).astype(np.int16), {"normalized": True}),
}


@pytest.mark.parametrize("glows", [False, True])
@pytest.mark.parametrize("kind", KINDS)
def test_copies_of_a_mesh_are_placed_before_its_node(kind, glows):
    file = GltfFile()
    attributes = {"TRANSLATION": (TRANSLATIONS, {}), "ROTATION": KINDS[kind], "SCALE": (SCALES, {})}
    extension = instanced(file, **attributes)
    mesh = file.mesh(file.material(emissiveFactor=[1, 1, 1] if glows else [0, 0, 0]))
    file.node(mesh=mesh, name="a", translation=[0, 10, 0], extensions=extension)
    made = converted(file)
    copies = [plugin for name, plugin in made.scene.items() if name in ("a", "a_2", "a_3")]
    assert [copy["type"] for copy in copies] == ["mesh" if glows else "instance"] * 3
    for i, copy in enumerate(copies):
        expected = np.eye(4)
        expected[:3, :3] = ROTATIONS[i] @ np.diag(SCALES[i])
        expected[:3, 3] = TRANSLATIONS[i] + [0, 10, 0]
        np.testing.assert_allclose(copy["to_world"], expected, atol=1e-6)
    info = mlt.load_dict(made.scene).info()
    assert info["triangles"] == 2 * (3 if glows else 1)
    assert not [text for text in made.warnings if "EXT_mesh" in text]


def test_instances_have_defaults_and_count_as_surfaces():
    file = GltfFile()
    extension = instanced(file, SCALE=(np.full((2, 3), 3, np.float32), {}))
    file.node(mesh=file.mesh(file.material()), name="a", extensions=extension)
    # Of two squares of area 36 and one of 72 / 99, the last is a hundredth.
    glow = {"emissiveFactor": [1, 1, 1]}
    size = [np.sqrt(72 / 99) / 2, np.sqrt(72 / 99) / 2, 1]
    file.node(mesh=file.mesh(file.material(**glow)), scale=size)
    made = converted(file)
    np.testing.assert_allclose(made.scene["a"]["to_world"], np.diag([3, 3, 3, 1]))
    assert "sun" in made.scene


def test_instances_that_contradict_themselves_are_refused():
    file = GltfFile()
    extension = instanced(file, TRANSLATION=(TRANSLATIONS, {}), SCALE=(SCALES[:2], {}))
    file.node(mesh=file.mesh(), extensions=extension)
    with pytest.raises(mlt.SceneError, match=r"different counts: .*'TRANSLATION': 3, 'SCALE': 2"):
        converted(file)
    file = GltfFile()
    file.node(mesh=file.mesh(), extensions=instanced(file, ROTATION=(CORNERS, {})))
    with pytest.raises(mlt.SceneError, match=r"ROTATION .* has 3 components, but should have 4"):
        converted(file)


def test_other_attributes_of_instances_are_named():
    file = GltfFile()
    extension = instanced(file, TRANSLATION=(TRANSLATIONS, {}), _COLOR=(TRANSLATIONS, {}))
    file.node(mesh=file.mesh(), extensions=extension)
    assert "_COLOR of EXT_mesh_gpu_instancing is left out" in converted(file).warnings
