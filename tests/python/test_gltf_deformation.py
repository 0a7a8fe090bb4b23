"""Morph targets and skins of glTF files, with the positions that their equations give."""

from dataclasses import dataclass, field

import numpy as np
import pytest

import pymlt as mlt

gl = pytest.importorskip("pygltflib", reason="needs pymlt[gltf]")

from gltf_files import CORNERS, GltfFile, converted  # noqa: E402

HALF = np.sqrt(0.5)
QUARTER_ABOUT_Z = [0, 0, HALF, HALF]
UP = np.tile(np.array([0, 0, 1], np.float32), (4, 1))


@pytest.fixture(autouse=True)
def folder(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)


@dataclass
class WeightedNode(gl.Node):
    """A node with weights of morph targets, which pygltflib does not have."""

    weights: list = field(default_factory=list)


def matrices(file: GltfFile, *given) -> int:
    """An accessor of matrices, which glTF stores by columns."""
    columns = np.array(given, np.float32).transpose(0, 2, 1).reshape(-1, 16)
    index = file.view(np.ascontiguousarray(columns).tobytes())
    kind = {"componentType": gl.FLOAT, "count": len(given), "type": gl.MAT4}
    file.gltf.accessors.append(gl.Accessor(bufferView=index, **kind))
    return len(file.gltf.accessors) - 1


def moved(points, *offset) -> np.ndarray:
    return np.asarray(points) + np.array(offset)


def translation(*offset) -> np.ndarray:
    matrix = np.eye(4)
    matrix[:3, 3] = offset
    return matrix


def bound(file: GltfFile, sets, *, inverse=None, joints=2, **node) -> GltfFile:
    """A square with the given (joints, weights) for each set, on a skin of the first nodes."""
    more = {}
    for number, (rows, weights) in enumerate(sets):
        weights = np.asarray(weights)
        integers = weights.dtype.kind == "u"
        if not integers:
            weights = weights.astype(np.float32)
        more[f"JOINTS_{number}"] = file.accessor(np.array(rows, np.uint8))
        more[f"WEIGHTS_{number}"] = file.accessor(weights, normalized=integers)
    file.gltf.skins.append(gl.Skin(joints=list(range(joints)), inverseBindMatrices=inverse))
    file.node(mesh=file.mesh(**more), skin=0, name="bound", **node)
    return file


def arm() -> GltfFile:
    """A joint at x = 10 and one above it, turned by 90 degrees about z."""
    file = GltfFile()
    file.node(translation=[10, 0, 0], children=[1])
    file.node(root=False, translation=[0, 5, 0], rotation=QUARTER_ABOUT_Z)
    return file


def world(shape: dict) -> np.ndarray:
    """The vertices of a mesh where they are seen."""
    given = np.concatenate([shape["vertices"], np.ones((len(shape["vertices"]), 1))], axis=1)
    return (given @ shape["to_world"].T)[:, :3]


JOINTS = [[0, 1, 0, 0]] * 4
WEIGHTS = np.array([[1, 0, 0, 0], [0, 1, 0, 0], [0.5, 0.5, 0, 0], [0.25, 0.75, 0, 0]])
#: What joint 0 and joint 1 of `arm` do to a point of the square.
MOVED = moved(CORNERS, 10, 0, 0)
TURNED = CORNERS @ np.array([[0, 1, 0], [-1, 0, 0], [0, 0, 1]]) + [10, 5, 0]
BENT = WEIGHTS[:, :1] * MOVED + WEIGHTS[:, 1:2] * TURNED


def test_vertices_are_where_their_joints_put_them():
    made = converted(bound(arm(), [(JOINTS, WEIGHTS)]))
    np.testing.assert_allclose(world(made.scene["bound"]), BENT, atol=1e-6)
    assert [text for text in made.warnings if "skin" in text] == []
    assert mlt.load_dict(made.scene).info()["triangles"] == 2


def test_the_place_of_a_node_with_a_skin_is_ignored():
    file = bound(arm(), [(JOINTS, WEIGHTS)], translation=[7, 7, 7], scale=[3, 3, 3])
    np.testing.assert_allclose(world(converted(file).scene["bound"]), BENT, atol=1e-6)


def test_inverse_bind_matrices_come_before_the_joints():
    file = arm()
    inverse = matrices(file, translation(-10, 0, 0), translation(-10, -5, 0))
    bound(file, [(JOINTS, WEIGHTS)], inverse=inverse)
    turned = (CORNERS - [10, 5, 0]) @ np.array([[0, 1, 0], [-1, 0, 0], [0, 0, 1]]) + [10, 5, 0]
    expected = WEIGHTS[:, :1] * CORNERS + WEIGHTS[:, 1:2] * turned
    np.testing.assert_allclose(world(converted(file).scene["bound"]), expected, atol=1e-5)


@pytest.mark.parametrize("kind", [np.uint8, np.uint16])
def test_weights_may_be_integers_and_in_two_sets(kind):
    most = np.iinfo(kind).max
    weights = np.zeros((4, 4), kind)
    weights[:, 0] = most // 5
    rest = np.zeros((4, 4), kind)
    rest[:, 0] = most - most // 5
    joints = np.zeros((4, 4), int)
    made = converted(bound(arm(), [(joints, weights), (joints + 1, rest)]))
    expected = 0.2 * MOVED + 0.8 * TURNED
    np.testing.assert_allclose(world(made.scene["bound"]), expected, atol=1e-5)


def test_weights_need_not_sum_to_one_and_none_leave_a_vertex_where_it_is():
    weights = 2 * WEIGHTS
    weights[3] = 0
    made = converted(bound(arm(), [(JOINTS, weights)]))
    expected = np.concatenate([BENT[:3], CORNERS[3:]])
    np.testing.assert_allclose(world(made.scene["bound"]), expected, atol=1e-6)


@pytest.mark.parametrize("scale", [(2, 1, 1), (-2, 1, 1)])
def test_normals_stay_perpendicular_to_the_surface_and_on_its_front(scale):
    file = GltfFile()
    # A quarter turn about x and then a scale: the square is in the plane of x and z.
    file.node(scale=list(scale), children=[1])
    file.node(root=False, rotation=[HALF, 0, 0, HALF], children=[2])
    # Half of another quarter turn, so that the scale shears.
    file.node(root=False, rotation=[0, np.sin(np.pi / 8), 0, np.cos(np.pi / 8)])
    joints = [[2, 0, 0, 0]] * 4
    one = np.tile(np.array([1.0, 0, 0, 0]), (4, 1))
    shape = converted(bound(file, [(joints, one)], joints=3)).scene["bound"]
    corners = world(shape)[shape["faces"]]
    fronts = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    fronts /= np.linalg.norm(fronts, axis=1, keepdims=True)
    normal = np.array([HALF / scale[0], -HALF, 0])
    normal /= np.linalg.norm(normal)
    np.testing.assert_allclose(shape["normals"], np.tile(normal, (4, 1)), atol=1e-6)
    np.testing.assert_allclose(fronts, np.tile(normal, (2, 1)), atol=1e-6)


def morphing(file: GltfFile, targets, *, weights=(), of_node=(), **node) -> GltfFile:
    """A square with morph targets: names of attributes and accessors."""
    mesh = file.mesh()
    file.gltf.meshes[mesh].weights = list(weights)
    file.gltf.meshes[mesh].primitives[0].targets = targets
    file.gltf.nodes.append(WeightedNode(mesh=mesh, weights=list(of_node), name="bound", **node))
    file.gltf.scenes[0].nodes.append(len(file.gltf.nodes) - 1)
    return file


LIFT = np.array([[0, 0, 1], [0, 0, 2], [0, 0, 3], [0, 0, 4]], np.float32)
PUSH = np.array([[1, 0, 0]] * 4, np.float32)


@pytest.mark.parametrize(
    ("weights", "of_node", "expected"),
    [
        ((), (), CORNERS),
        ((0, 0), (), CORNERS),
        ((0.5, 2), (), CORNERS + 0.5 * LIFT + 2 * PUSH),
        ((0.5, 2), (-1, 0), CORNERS - LIFT),
        ((), (0, 1), CORNERS + PUSH),
    ],
)
def test_morph_targets_count_with_the_weights_of_the_node_else_of_the_mesh(
    weights, of_node, expected
):
    file = GltfFile()
    targets = [gl.Attributes(POSITION=file.accessor(values)) for values in (LIFT, PUSH)]
    morphing(file, targets, weights=weights, of_node=of_node, translation=[0, 0, 9])
    shape = converted(file).scene["bound"]
    np.testing.assert_allclose(shape["vertices"], expected, atol=1e-6)
    np.testing.assert_allclose(world(shape), moved(expected, 0, 0, 9), atol=1e-6)
    np.testing.assert_allclose(shape["normals"], UP)


def test_morph_targets_turn_normals_and_name_what_they_cannot_change():
    file = GltfFile()
    normals = file.accessor(np.tile(np.array([0, 1, 0], np.float32), (4, 1)))
    target = gl.Attributes(NORMAL=normals, TANGENT=normals, COLOR_0=normals)
    made = converted(morphing(file, [target], weights=[1]))
    expected = np.tile([0, HALF, HALF], (4, 1))
    np.testing.assert_allclose(made.scene["bound"]["normals"], expected, atol=1e-6)
    np.testing.assert_allclose(made.scene["bound"]["vertices"], CORNERS)
    assert "morph targets of COLOR_0 are left out" in made.warnings
    assert [text for text in made.warnings if "TANGENT" in text] == []


def test_sparse_morph_targets_without_a_buffer_view_move_some_vertices():
    file = GltfFile()
    rows = file.view(np.array([1, 3], np.uint16).tobytes())
    values = file.view(np.array([[0, 0, 5], [0, 0, 7]], np.float32).tobytes())
    sparse = gl.Sparse(
        count=2,
        indices=gl.AccessorSparseIndices(bufferView=rows, componentType=gl.UNSIGNED_SHORT),
        values=gl.AccessorSparseValues(bufferView=values),
    )
    file.gltf.accessors.append(
        gl.Accessor(componentType=gl.FLOAT, count=4, type=gl.VEC3, sparse=sparse)
    )
    target = gl.Attributes(POSITION=len(file.gltf.accessors) - 1)
    expected = CORNERS + 0.5 * np.array([[0, 0, 0], [0, 0, 5], [0, 0, 0], [0, 0, 7]])
    shape = converted(morphing(file, [target], weights=[0.5])).scene["bound"]
    np.testing.assert_allclose(shape["vertices"], expected, atol=1e-6)


def test_morph_targets_come_before_the_skin():
    file = bound(arm(), [(JOINTS, WEIGHTS)])
    primitive = file.gltf.meshes[0].primitives[0]
    primitive.targets = [gl.Attributes(POSITION=file.accessor(PUSH))]
    file.gltf.meshes[0].weights = [1]
    expected = WEIGHTS[:, :1] * moved(MOVED, 1, 0, 0) + WEIGHTS[:, 1:2] * moved(TURNED, 0, 1, 0)
    np.testing.assert_allclose(world(converted(file).scene["bound"]), expected, atol=1e-6)


def test_one_mesh_has_the_shape_of_each_of_its_nodes():
    file = GltfFile()
    target = gl.Attributes(POSITION=file.accessor(PUSH))
    morphing(file, [target], of_node=[1])
    file.gltf.nodes.append(WeightedNode(mesh=0, weights=[3], name="other"))
    file.gltf.scenes[0].nodes.append(1)
    scene = converted(file).scene
    np.testing.assert_allclose(scene["bound"]["vertices"], CORNERS + PUSH)
    np.testing.assert_allclose(scene["other"]["vertices"], CORNERS + 3 * PUSH)


def test_an_animated_file_is_at_rest_and_says_so():
    file = bound(arm(), [(JOINTS, WEIGHTS)])
    times = file.accessor(np.array([0, 1], np.float32))
    moves = file.accessor(np.array([[50, 0, 0], [60, 0, 0]], np.float32))
    channel = gl.AnimationChannel(
        sampler=0, target=gl.AnimationChannelTarget(node=0, path="translation")
    )
    sampler = gl.AnimationSampler(input=times, output=moves)
    file.gltf.animations.append(gl.Animation(channels=[channel], samplers=[sampler]))
    made = converted(file)
    np.testing.assert_allclose(world(made.scene["bound"]), BENT, atol=1e-6)
    said = "animations are left out: nodes, skins and morph targets have the pose that they have"
    assert [text for text in made.warnings if text.startswith(said)]


def short_weights(file: GltfFile) -> None:
    bound(file, [(JOINTS, WEIGHTS[:3])])


def lost_joint(file: GltfFile) -> None:
    bound(file, [(JOINTS, WEIGHTS)], joints=2)
    file.gltf.skins[0].joints = [0, 9]


def far_joint(file: GltfFile) -> None:
    bound(file, [(np.full((4, 4), 2), WEIGHTS)])


def no_weights(file: GltfFile) -> None:
    bound(file, [(JOINTS, WEIGHTS)])
    file.gltf.meshes[0].primitives[0].attributes.WEIGHTS_0 = None


def few_matrices(file: GltfFile) -> None:
    bound(file, [(JOINTS, WEIGHTS)], inverse=matrices(file, np.eye(4)))


def signed_joints(file: GltfFile) -> None:
    bound(file, [(JOINTS, WEIGHTS)])
    joints = file.accessor(np.zeros((4, 4), np.int8))
    file.gltf.meshes[0].primitives[0].attributes.JOINTS_0 = joints


def other_count(file: GltfFile) -> None:
    morphing(file, [gl.Attributes(POSITION=file.accessor(PUSH))], weights=[1, 1])


def short_target(file: GltfFile) -> None:
    morphing(file, [gl.Attributes(POSITION=file.accessor(PUSH[:3]))], weights=[1])


def text_for_weight(file: GltfFile) -> None:
    morphing(file, [], of_node=["much"])


MISTAKES = {
    short_weights: "WEIGHTS of a mesh with a skin has 3 x 4 numbers, but should have 4 x 4",
    lost_joint: "joint 9 of a skin is not a node of the scene",
    far_joint: "a vertex has joint 2, but its skin has 2 joints",
    no_weights: "a mesh with a skin should have JOINTS_0 and WEIGHTS_0",
    few_matrices: "inverseBindMatrices of a skin has 1 x 16 numbers, but should have 2 x 16",
    signed_joints: "JOINTS of a mesh with a skin should be unsigned integers",
    other_count: "a mesh has 1 morph targets, but 2 weights for them",
    short_target: "POSITION of a morph target has 3 x 3 numbers, but should have 4 x 3",
    text_for_weight: r"nodes\[2\].weights\[0\] is 'much', but should be a number",
}


@pytest.mark.parametrize("spoil", MISTAKES, ids=lambda spoil: spoil.__name__)
def test_skins_and_targets_that_contradict_themselves_are_refused(spoil):
    file = arm()
    spoil(file)
    with pytest.raises(mlt.SceneError, match=MISTAKES[spoil]):
        converted(file)
