"""Scenes whose meshes and images are arrays, not files."""

import pickle
from types import SimpleNamespace

import numpy as np
import pytest
import tiny

import pymlt as mlt

VERTICES = np.array([[-1, 0, -1], [1, 0, -1], [1, 0.5, 1], [-1, 0.2, 1]], np.float32)
FACES = np.array([[0, 2, 1], [0, 3, 2]])
UV = np.array([[0, 0], [1, 0], [1, 1], [0, 1]], np.float32)


def scene(shape, **more) -> dict:
    return tiny.scene() | {"mesh": shape} | more


def image(scene, spp=2) -> np.ndarray:
    return mlt.render(scene, "path", spp=spp, seed=1)


def mesh(**changes) -> dict:
    return {"type": "mesh", "vertices": VERTICES, "faces": FACES, "uv": UV} | changes


def write_ply(path) -> str:
    rows = [" ".join(map(str, row)) for row in np.hstack([VERTICES, UV]).tolist()]
    faces = [f"3 {a} {b} {c}" for a, b, c in FACES]
    path.write_text(
        "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\n"
        "property float z\nproperty float u\nproperty float v\nelement face 2\n"
        "property list uchar int vertex_indices\nend_header\n" + "\n".join(rows + faces) + "\n"
    )
    return str(path)


CHECKS = np.array([[[255, 0, 0], [0, 128, 0]], [[0, 0, 200], [90, 90, 90]]], np.uint8)


def textured(texture) -> dict:
    return scene(mesh(bsdf={"type": "diffuse", "reflectance": {"type": "bitmap"} | texture}))


def test_mesh_from_arrays_is_that_of_a_file(tmp_path):
    file = {"type": "ply", "filename": write_ply(tmp_path / "m.ply")}
    np.testing.assert_array_equal(image(scene(mesh())), image(scene(file)))


@pytest.mark.parametrize("dtype", [np.int32, np.uint8, np.uint64])
def test_arrays_may_have_any_layout(dtype):
    expected = image(scene(mesh()))
    wide = np.zeros((4, 6))
    wide[:, ::2] = VERTICES
    other = mesh(vertices=wide[:, ::2], faces=np.asfortranarray(FACES.astype(dtype)))
    np.testing.assert_array_equal(image(scene(other)), expected)
    lists = mesh(vertices=VERTICES.tolist(), faces=FACES.tolist())
    np.testing.assert_array_equal(image(scene(lists)), expected)


def test_objects_with_vertices_and_faces_are_meshes():
    trimesh = SimpleNamespace(vertices=VERTICES, faces=FACES, visual=SimpleNamespace(uv=UV))
    np.testing.assert_array_equal(image(scene(trimesh)), image(scene(mesh())))


def test_normals_count():
    up = np.tile([[0, 1, 0]], (4, 1))
    assert (image(scene(mesh(normals=up))) != image(scene(mesh()))).any()


def test_textures_from_arrays_are_those_of_files(tmp_path):
    mlt_file, floats = tmp_path / "t.exr", np.linspace(0, 1, 12, dtype=np.float32).reshape(2, 2, 3)
    mlt.write_image(mlt_file, floats)
    np.testing.assert_array_equal(
        image(textured({"data": floats})), image(textured({"filename": str(mlt_file)}))
    )
    OpenImageIO = pytest.importorskip("OpenImageIO")
    out = OpenImageIO.ImageOutput.create(str(tmp_path / "t.png"))
    out.open(str(tmp_path / "t.png"), OpenImageIO.ImageSpec(2, 2, 3, "uint8"))
    out.write_image(CHECKS)
    out.close()
    file = image(textured({"filename": str(tmp_path / "t.png")}))
    np.testing.assert_array_equal(image(textured({"data": CHECKS})), file)


class Bitmap:
    """What of an `mi.Bitmap` is looked at."""

    def __array__(self, dtype=None, copy=None):
        return CHECKS


def test_a_bitmap_is_data_by_the_name_that_mitsuba_has():
    expected = image(textured({"data": CHECKS}))
    for bitmap in CHECKS, Bitmap():
        np.testing.assert_array_equal(image(textured({"bitmap": bitmap})), expected)
    sky = np.ones((4, 8, 3), np.float32)
    sky_scenes = [scene(mesh(), sky={"type": "envmap", key: sky}) for key in ("data", "bitmap")]
    np.testing.assert_array_equal(*map(image, sky_scenes))


def test_grey_arrays_have_two_dimensions():
    grey = np.array([[0.1, 0.5], [0.9, 0.3]])
    np.testing.assert_array_equal(
        image(textured({"data": grey})), image(textured({"data": grey[..., None]}))
    )


@pytest.mark.parametrize("kind", ["envmap", "goniometric"])
def test_maps_of_all_directions_may_be_arrays(kind, tmp_path):
    sky = np.random.default_rng(1).random((4, 8, 3)).astype(np.float32)
    mlt.write_image(tmp_path / "sky.exr", sky)
    array = scene(mesh(), sky={"type": kind, "data": sky})
    file = scene(mesh(), sky={"type": kind, "filename": str(tmp_path / "sky.exr")})
    np.testing.assert_array_equal(image(array), image(file))


def test_scenes_with_arrays_are_pickled_hashed_and_resumed(tmp_path):
    loaded = mlt.load_dict(textured({"data": CHECKS}))
    copy = pickle.loads(pickle.dumps(loaded))
    np.testing.assert_array_equal(image(copy), image(loaded))
    assert copy.hash == loaded.hash
    assert mlt.load_dict(textured({"data": CHECKS // 2})).hash != loaded.hash
    moved = scene(mesh(vertices=VERTICES + np.float32(0.1)))
    assert mlt.load_dict(moved).hash != mlt.load_dict(scene(mesh())).hash
    whole = mlt.start(loaded, "path", spp=4, checkpoint=tmp_path / "c").result().image
    np.testing.assert_array_equal(mlt.resume(tmp_path / "c", scene=loaded).result().image, whole)


@pytest.mark.parametrize(
    ("shape", "message"),
    [
        (mesh(vertices=VERTICES[:, :2]), r"\['mesh'\]: 'vertices' has the shape \(4, 2\)"),
        (mesh(vertices=VERTICES * np.nan), r"'vertices' is not finite at \[0, 0\]: nan"),
        (mesh(faces=FACES.astype(float)), "'faces' has the dtype float64, but needs integers"),
        (mesh(faces=FACES - 1), "'faces' holds -1"),
        (mesh(faces=FACES + 1), "triangle 1 uses vertex 4, but there are only 4"),
        (mesh(uv=UV[:2]), "as many normals and uvs as vertices"),
        (mesh(vertices=[["a", "b", "c"]]), "'vertices' has the dtype <U1"),
        (mesh(vertices=[[1, 2, 3], [4]]), "'vertices' is not an array"),
        ({"type": "mesh", "vertices": VERTICES}, "the mesh has no triangles"),
    ],
)
def test_mistakes_in_meshes_are_named(shape, message):
    with pytest.raises(mlt.SceneError, match=message) as error:
        mlt.load_dict(scene(shape))
    assert "\n" not in str(error.value)


@pytest.mark.parametrize(
    ("texture", "message"),
    [
        ({"data": np.zeros((2, 2, 5))}, r"'data' has the shape \(2, 2, 5\)"),
        ({"data": np.zeros((2, 2), np.int64)}, "'data' has the dtype int64"),
        ({"data": np.full((2, 2), np.inf)}, "'data' is not finite"),
        ({"data": CHECKS, "filename": "x.png"}, "exclude each other"),
        ({"data": CHECKS, "bitmap": CHECKS}, "'data' and 'bitmap' are the same"),
        ({"data": np.zeros((0, 2))}, "0"),
        ({}, "filename"),
    ],
)
def test_mistakes_in_images_are_named(texture, message):
    with pytest.raises(mlt.SceneError, match=message) as error:
        mlt.load_dict(textured(texture))
    assert "\n" not in str(error.value)
