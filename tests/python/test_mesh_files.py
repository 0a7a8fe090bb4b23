"""A mesh in a file of its own, as a scene that can be rendered."""

import gzip
import struct

import numpy as np
import pytest

import pymlt as mlt
from pymlt import cli
from pymlt.formats.ply import Mesh, write_ply

VERTICES = np.array([[0, 0, 0], [30, 0, 0], [0, 40, 0], [0, 0, 20]], np.float32)
FACES = np.array([[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]], np.uint32)


@pytest.fixture(autouse=True)
def folder(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    return tmp_path


def write_obj(path):
    rows = [f"v {x} {y} {z}" for x, y, z in VERTICES.tolist()]
    path.write_text("\n".join(rows + [f"f {a + 1} {b + 1} {c + 1}" for a, b, c in FACES]) + "\n")


def write_stl(path):
    records = [struct.pack("<12fH", 0, 0, 0, *VERTICES[face].ravel(), 0) for face in FACES]
    path.write_bytes(bytes(80) + struct.pack("<I", len(FACES)) + b"".join(records))


def write_text_stl(path):
    lines = ["solid tetrahedron"]
    for face in FACES:
        lines += ["facet normal 0 0 0", "outer loop"]
        lines += [f"vertex {x} {y} {z}" for x, y, z in VERTICES[face].tolist()]
        lines += ["endloop", "endfacet"]
    path.write_text("\n".join([*lines, "endsolid"]))


WRITERS = {
    "a.ply": lambda path: write_ply(path, Mesh(VERTICES, FACES)),
    "a.OBJ": write_obj,
    "a.stl": write_stl,
    "text.stl": write_text_stl,
}


def picture(scene):
    return mlt.render(scene, "path", spp=4, seed=1)


def hidden_emitters(scene):
    """What of the image is not background."""
    return mlt.render(scene, mlt.Path(hide_emitters=True), spp=64, seed=1).max(axis=2) > 0


@pytest.mark.parametrize("name", WRITERS)
def test_a_mesh_is_lit_and_fits_the_image(folder, name):
    WRITERS[name](folder / name)
    scene = mlt.load(name, size=(64, 36))
    assert scene.info()["triangles"] == 4
    seen = hidden_emitters(scene)
    rows, columns = (np.flatnonzero(seen.any(axis=axis)) for axis in (1, 0))
    assert 0 < rows[0] < rows[-1] < 35
    assert 0 < columns[0] < columns[-1] < 63
    assert len(rows) > 18 or len(columns) > 32
    assert picture(scene)[seen].std() > 0.02  # its sides differ


def test_all_formats_show_the_same_mesh(folder):
    shown, brightness = [], []
    for name, write in WRITERS.items():
        write(folder / name)
        scene = mlt.load(name, size=(32, 18))
        shown.append(hidden_emitters(scene))
        brightness.append(mlt.render(scene, "path", spp=64, seed=1).mean())
    assert all(np.array_equal(one, shown[0]) for one in shown)
    assert brightness == pytest.approx(
        [brightness[0]] * len(brightness), rel=0.05
    )  # a .ply is smooth


@pytest.mark.parametrize("name", ["a.ply", "a.OBJ"])
def test_a_mesh_may_be_packed(folder, name):
    WRITERS[name](folder / name)
    content = (folder / name).read_bytes()
    half = len(content) // 2  # gzip files may stand behind each other
    packed = gzip.compress(content[:half]) + gzip.compress(content[half:])
    (folder / f"{name}.gz").write_bytes(packed)
    expected = picture(mlt.load(name, size=(32, 18)))
    np.testing.assert_array_equal(picture(mlt.load(f"{name}.gz", size=(32, 18))), expected)
    (folder / f"{name}.gz").write_bytes(packed[:-20])
    with pytest.raises(mlt.FileError, match=rf"{name}.gz: cannot be unpacked"):
        mlt.load(f"{name}.gz")
    (folder / f"{name}.gz").write_bytes(gzip.compress(b" " * (2**28 + 1), 1))
    with pytest.raises(mlt.FileError, match=rf"{name}.gz: unpacks to more than 268435456 bytes"):
        mlt.load(f"{name}.gz")


def test_faces_that_are_left_out_are_a_warning():
    shape = {"type": "obj", "data": b"v 0 0 0\nv 1 0 0\nv 1 1 0\nf 1 2 3\nf 1 2\nf 2 3\n"}
    rest = {"sensor": {"type": "perspective"}, "light": {"type": "constant"}}
    scene = mlt.load_dict({"type": "scene", "a": shape, **rest})
    assert scene.info()["triangles"] == 1
    (warning,) = scene.info()["warnings"]
    assert "2 faces are left out: fewer than three corners" in warning


def test_the_command_line_renders_a_mesh(folder):
    WRITERS["a.ply"](folder / "a.ply")
    flags = ["--size", "32x18", "--integrator", "path", "--spp", "4", "--seed", "1", "--quiet"]
    assert cli.main(["render", "a.ply", *flags, "-o", "a.exr"]) == 0
    expected = picture(mlt.load("a.ply", size=(32, 18))).astype(np.float16)
    np.testing.assert_array_equal(mlt.read_image("a.exr"), expected)


def test_a_mesh_can_be_written_as_a_scene(folder):
    write_stl(folder / "a.stl")
    assert mlt.convert("a.stl", "a.xml") == []
    np.testing.assert_array_equal(
        picture(mlt.load("a.xml", size=(32, 18))), picture(mlt.load("a.stl", size=(32, 18)))
    )


@pytest.mark.parametrize(
    ("content", "message"),
    [
        (b"", "is no STL"),
        (bytes(80) + b"\1\0\0\0" + bytes(49), "is no STL: .* 133 bytes that 1 triangles take"),
        (bytes(84), "has no triangles"),
        (b"solid a\nendsolid a", "has no triangles"),
        (b"solid a\nvertex 1 2 3 vertex 1 2 3\n", "three vertices of three numbers"),
        (b"solid a\nvertex 1 2 x vertex 1 2 3 vertex 3 2 1\n", "three vertices of three numbers"),
    ],
)
def test_what_is_no_stl_says_so(folder, content, message):
    (folder / "a.stl").write_bytes(content)
    with pytest.raises(mlt.SceneError, match=f"^a.stl: .*{message}|^a.stl: {message}"):
        mlt.load("a.stl")
