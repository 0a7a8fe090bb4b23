"""Meshes of USD: faces, values on them, subdivision, and the shapes that have formulas."""

import numpy as np
import pytest

import pymlt as mlt

pytest.importorskip("pxr", reason="needs pymlt[usd]")

from usd_files import converted, mesh, moved

CUBE = """
    point3f[] points = [(-1, -1, -1), (1, -1, -1), (-1, 1, -1), (1, 1, -1),
                        (-1, -1, 1), (1, -1, 1), (-1, 1, 1), (1, 1, 1)]
    int[] faceVertexCounts = [4, 4, 4, 4, 4, 4]
    int[] faceVertexIndices = [0, 2, 3, 1, 4, 5, 7, 6, 0, 1, 5, 4,
                               2, 6, 7, 3, 0, 4, 6, 2, 1, 3, 7, 5]
"""


@pytest.fixture(autouse=True)
def folder(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)


def square(more: str = "", head: str = "") -> dict:
    return converted(mesh(more, head=head)).scene["square"]


def cube(more: str = "") -> dict:
    return converted(f'def Mesh "cube" {{ {CUBE}\n{more} }}').scene["cube"]


def area_vectors(shape: dict) -> np.ndarray:
    a, b, c = shape["vertices"][shape["faces"]].transpose(1, 0, 2)
    return np.cross(b - a, c - a) / 2


def volume(shape: dict) -> float:
    a, b, c = shape["vertices"][shape["faces"]].transpose(1, 0, 2).astype(float)
    return float((np.cross(a, b) * c).sum() / 6)


def test_polygons_become_fans():
    pentagon = converted("""
def Mesh "house" {
    point3f[] points = [(0, 0, 0), (2, 0, 0), (2, 1, 0), (1, 2, 0), (0, 1, 0), (5, 5, 0), (6, 5, 0)]
    int[] faceVertexCounts = [5, 2, 3]
    int[] faceVertexIndices = [0, 1, 2, 3, 4, 5, 6, 0, 1, 2]
    int[] holeIndices = [2]
    uniform token subdivisionScheme = "none"
}""").scene["house"]
    assert len(pentagon["faces"]) == 3
    np.testing.assert_allclose(area_vectors(pentagon).sum(axis=0), [0, 0, 3])
    assert pentagon["face_normals"]
    assert "normals" not in pentagon


def test_the_outside_of_a_left_handed_mesh_is_behind_it():
    assert area_vectors(square())[:, 2].tolist() == [2, 2]
    assert area_vectors(square('uniform token orientation = "leftHanded"'))[:, 2].tolist() == [
        -2,
        -2,
    ]


@pytest.mark.parametrize("hand", ["right", "left"])
def test_values_at_corners_stay_with_their_corners(hand):
    found = square(f"""
    uniform token orientation = "{hand}Handed"
    texCoord2f[] primvars:st = [(0, 0), (1, 0), (1, 1), (0, 1)] (interpolation = "faceVarying")
""")
    expected = (found["vertices"][:, :2] + 1) / 2 * [1, -1] + [0, 1]
    np.testing.assert_allclose(found["uv"], expected, atol=1e-6)


INTERPOLATIONS = {
    "constant": ("[(1, 0, 0)]", [[1, 0, 0]] * 4),
    "uniform": ("[(0, 1, 0)]", [[0, 1, 0]] * 4),
    "vertex": ("[(1, 0, 0), (0, 1, 0), (0, 0, 1), (1, 1, 1)]", [*np.eye(3), [1, 1, 1]]),
    "faceVarying": ("[(0, 0, 1), (1, 0, 0)]", [[0, 0, 1], [1, 0, 0], [1, 0, 0], [0, 0, 1]]),
}


@pytest.mark.parametrize("interpolation", INTERPOLATIONS)
def test_normals_of_any_interpolation(interpolation):
    values, expected = INTERPOLATIONS[interpolation]
    indices = "int[] primvars:normals:indices = [0, 1, 1, 0]" * (interpolation == "faceVarying")
    found = square(f"""
    normal3f[] primvars:normals = {values} (interpolation = "{interpolation}")
    {indices}
    normal3f[] normals = [(0, 0, -1), (0, 0, -1), (0, 0, -1), (0, 0, -1)]
""")
    np.testing.assert_allclose(found["normals"], expected)
    assert "face_normals" not in found


def test_colours_without_a_material():
    plain = square("color3f[] primvars:displayColor = [(0.1, 0.2, 0.3)]")
    assert plain["bsdf"]["bsdf"]["reflectance"]["value"] == pytest.approx([0.1, 0.2, 0.3])
    assert "vertex_color" not in plain
    values = INTERPOLATIONS["vertex"][0]
    found = square(f'color3f[] primvars:displayColor = {values} (interpolation = "vertex")')
    assert found["bsdf"]["bsdf"]["reflectance"]["type"] == "mesh_attribute"
    np.testing.assert_allclose(found["vertex_color"], INTERPOLATIONS["vertex"][1])
    assert square()["bsdf"]["bsdf"]["reflectance"] == 0.18


def test_a_mesh_that_names_no_scheme_stays_as_it_is_and_is_smooth():
    found = cube()
    assert len(found["faces"]) == 12
    np.testing.assert_allclose(found["normals"], found["vertices"] / np.sqrt(3), atol=1e-6)
    assert volume(found) == pytest.approx(8)


def test_faces_without_corners_change_nothing():
    text = mesh().replace("[4]", "[4, 0]").replace('uniform token subdivisionScheme = "none"', "")
    found = converted(text).scene["square"]
    np.testing.assert_allclose(found["normals"], [[0, 0, 1]] * 4)
    assert len(found["faces"]) == 2


CATMULL_CLARK = 'uniform token subdivisionScheme = "catmullClark"\n'


def test_a_subdivision_surface_approaches_its_limit():
    found = cube(CATMULL_CLARK)
    assert len(found["faces"]) == 6 * 4**3 * 2
    # The limit of a corner is (9 v + 4 sum e - sum f) / 24 with its neighbours e and f: the half.
    np.testing.assert_allclose(abs(found["vertices"][:8]), 0.5, atol=0.02)
    out = (area_vectors(found) * found["vertices"][found["faces"]].mean(axis=1)).sum(axis=1)
    assert out.min() > 0
    assert (found["normals"] * found["vertices"]).sum(axis=1).min() > 0


def test_creases_and_corners_stay_sharp():
    edges = [(0, 1), (1, 3), (3, 2), (2, 0), (4, 5), (5, 7), (7, 6), (6, 4)]
    edges += [(0, 4), (1, 5), (2, 6), (3, 7)]
    flat = ", ".join(str(end) for edge in edges for end in edge)
    creases = f"""
    int[] creaseIndices = [{flat}]
    int[] creaseLengths = [{", ".join(["2"] * 12)}]
    float[] creaseSharpnesses = [{", ".join(["10"] * 12)}]
"""
    assert volume(cube(CATMULL_CLARK + creases)) == pytest.approx(8)
    soft = volume(cube(CATMULL_CLARK + creases.replace("10", "1.5")))
    assert volume(cube(CATMULL_CLARK)) < 0.9 * soft < 0.9 * 8
    corners = "int[] cornerIndices = [7]\nfloat[] cornerSharpnesses = [10]\n"
    np.testing.assert_allclose(cube(CATMULL_CLARK + corners)["vertices"].max(axis=0), 1)


def test_the_boundary_of_a_surface_stays():
    text = mesh(
        'texCoord2f[] primvars:st = [(0, 0), (1, 0), (1, 1), (0, 1)] (interpolation = "vertex")'
    ).replace('"none"', '"catmullClark"')
    found = converted(text).scene["square"]
    assert area_vectors(found).sum(axis=0) == pytest.approx([0, 0, 4])
    np.testing.assert_allclose(found["uv"], (found["vertices"][:, :2] * [1, -1] + 1) / 2, atol=1e-6)
    edge = 'uniform token interpolateBoundary = "edgeOnly"\n'
    rounded = converted(
        text.replace("int[] faceVertexCounts", edge + "int[] faceVertexCounts")
    ).scene["square"]
    assert area_vectors(rounded).sum(axis=0)[2] < 3.5


SHAPES = {  # the volume, and half of the size along each axis
    "Cube": ("double size = 3", 27, [1.5, 1.5, 1.5]),
    "Sphere": (
        "double radius = 2\n double3 xformOp:scale = (1, 1, 2)\n"
        'uniform token[] xformOpOrder = ["xformOp:scale"]',
        4 / 3 * np.pi * 16,
        [2, 2, 4],
    ),
    "Cylinder": (
        'double radius = 1\n double height = 3\n token axis = "X"',
        3 * np.pi,
        [1.5, 1, 1],
    ),
    "Cone": ('double radius = 1\n double height = 3\n token axis = "Y"', np.pi, [1, 1.5, 1]),
    "Capsule": (
        'double radius = 1\n double height = 3\n token axis = "Z"',
        3 * np.pi + 4 / 3 * np.pi,
        [1, 1, 2.5],
    ),
}


@pytest.mark.parametrize("kind", SHAPES)
def test_shapes_that_have_formulas(kind):
    settings, expected, half = SHAPES[kind]
    shape = converted(f'def {kind} "it" {{ {settings}\n}}').scene["it"]
    placed = np.asarray(shape["to_world"])
    if kind == "Cube":
        np.testing.assert_allclose(placed, np.diag([1.5, 1.5, 1.5, 1]))
        return
    vertices = shape["vertices"] @ placed[:3, :3].T
    assert volume(shape | {"vertices": vertices}) == pytest.approx(expected, rel=3e-3)
    np.testing.assert_allclose(vertices.max(axis=0), half, rtol=1e-6)
    np.testing.assert_allclose(vertices.min(axis=0), [-x for x in half], rtol=1e-6)
    outwards = area_vectors(shape)
    turned = [(shape["normals"][corner] * outwards).sum(axis=1) for corner in shape["faces"].T]
    assert np.min(turned) > -1e-6


def test_the_apex_of_a_cone_points_along_its_axis():
    cone = converted('def Cone "it" { token axis = "Y"\n}').scene["it"]["vertices"]
    assert abs(cone[cone[:, 1] == cone[:, 1].max()][:, [0, 2]]).max() < 1e-6


@pytest.mark.parametrize(("axis", "half"), [("X", [0, 2, 1]), ("Y", [1, 0, 2]), ("Z", [1, 2, 0])])
def test_planes_have_their_width_and_length_where_usd_says(axis, half):
    sizes = "double width = 2\n double length = 4"
    plane = converted(f'def Plane "it" {{ {sizes}\n token axis = "{axis}"\n}}')
    to_world = plane.scene["it"]["to_world"]
    np.testing.assert_allclose(abs(to_world[:3, :2]).sum(axis=1), half)
    np.testing.assert_allclose(to_world[:3, 2], np.eye(3)["XYZ".index(axis)])


def test_a_mirrored_mesh_keeps_its_outside():
    mirrored = square(
        moved(0, 0, 0)
        .replace("translate = (0, 0, 0)", "scale = (-1, 1, 1)")
        .replace("xformOp:translate", "xformOp:scale")
    )
    assert mirrored["flip_normals"]
    assert "flip_normals" not in square()


def test_what_is_not_read_is_named():
    text = 'def BasisCurves "hair" {}\n' + mesh("float[] primvars:displayOpacity = [0.5]").replace(
        '"none"', '"loop"'
    )
    warnings = converted(text).warnings
    assert "prims of type BasisCurves are left out" in warnings
    assert "the subdivision scheme 'loop' is left out: the mesh stays as it is" in warnings
    assert "displayOpacity is left out: what has no material is opaque" in warnings
    assert mlt.load_dict(converted(text).scene).info()["triangles"] == 2
