"""Textures of MaterialX: images as they are, and arrays that nodes compute."""

import warnings

import numpy as np
import pytest
from materialx_files import image, linked, material, node, write

import pymlt as mlt
from pymlt.pictures.tonemapping import encode_srgb

HEIGHT, WIDTH = 6, 8


@pytest.fixture(autouse=True)
def folder(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    return tmp_path


@pytest.fixture
def pixels():
    """The linear light of colour.exr; colour.png has it encoded, in steps of 1 / 255."""
    found = np.random.default_rng(7).random((HEIGHT, WIDTH, 3)).astype(np.float32)
    mlt.write_image("colour.exr", found)
    mlt.write_image("colour.png", found)
    return found


def shader(*elements, **inputs):
    write("a.mtlx", *elements, material("open_pbr_surface", **inputs))
    return mlt.load_materials("a.mtlx")["M"]["bsdf"]


def base_color(*elements, source):
    return shader(*elements, base_color=linked("color3", source))["base_color"]


def roughness(*elements, source, **link):
    made = shader(*elements, specular_roughness=linked("float", source, **link))
    return made["specular_roughness"]


def texel_centres(width, height):
    """u and v, which points up, of the texels of an array: (height, width) each."""
    return np.meshgrid((np.arange(width) + 0.5) / width, 1 - (np.arange(height) + 0.5) / height)


def seen(texture, u, v):
    """What a texture is at texture coordinates, of which v points down: (points, 3)."""
    corners = np.array([[-1, -1, 0], [1, -1, 0], [1, 1, 0], [-1, 1, 0]], np.float32)
    emitter = {"type": "area", "radiance": texture}
    found = []
    for x, y in zip(u, v, strict=True):
        shape = {
            "type": "mesh",
            "vertices": corners,
            "faces": np.array([[0, 1, 2], [0, 2, 3]]),
            "uv": np.tile(np.array([x, y], np.float32), (4, 1)),
            "emitter": emitter,
        }
        look = mlt.Transform.look_at(origin=[0, 0, 1], target=[0, 0, 0], up=[0, 1, 0])
        camera = {"type": "perspective", "fov": 20, "to_world": look}
        film = {"film": {"type": "hdrfilm", "width": 1, "height": 1, "rfilter": {"type": "box"}}}
        scene = {"type": "scene", "shape": shape, "camera": camera | film}
        found.append(mlt.render(scene, mlt.Path(max_depth=1), spp=1, seed=1)[0, 0])
    return np.array(found)


# ---- images --------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("file", "space", "raw"),
    [("colour.png", "srgb_texture", {}), ("colour.png", "", {"raw": True}), ("colour.exr", "", {})],
)
def test_an_image_that_nothing_changes_is_a_bitmap_of_its_file(folder, pixels, file, space, raw):
    made = base_color(image("i", file, space=space), source="i")
    assert made == {"type": "bitmap", "filename": str(folder / file), **raw}


def test_colours_in_other_spaces_are_converted(pixels):
    made = base_color(image("i", "colour.exr", space="acescg"), source="i")
    matrix = np.array([[1.70505, -0.62179, -0.08326], [-0.13026, 1.1408, -0.01055]])
    expected = np.clip(pixels @ matrix.T, 0, 1)
    assert made["data"][..., :2] == pytest.approx(expected, abs=1e-4)
    assert "raw" not in made


def test_a_number_is_the_red_of_an_image_as_it_is_stored(pixels):
    made = roughness(image("i", "colour.png", "float", space=""), source="i")
    assert made["raw"] is True
    assert made["data"] == pytest.approx(encode_srgb(pixels)[..., 0], abs=0.5 / 255 + 1e-4)


def test_channels_of_one_image_are_taken_apart(pixels):
    packed = image("i", "colour.exr", "vector3", space="")
    apart = node("separate3", "apart", "multioutput", **{"in": linked("vector3", "i")})
    made = roughness(packed, apart, source="apart", output="outy")
    assert made["data"] == pytest.approx(pixels[..., 1], abs=1e-6)
    index = {"in": linked("vector3", "i"), "index": 2}
    made = roughness(packed, node("extract", "one", "float", **index), source="one")
    assert made["data"] == pytest.approx(pixels[..., 2], abs=1e-6)


@pytest.mark.parametrize("tiling", [(3.0, 2.0), (1.0, 1.0)])
def test_tiles_and_offsets_are_those_of_materialx(pixels, tiling):
    """The texture at (u, v) is the image at (u, v) times the tiling less the offset, v upwards."""
    offset = (0.125, 0.25)
    tiles = node(
        "tiledimage",
        "i",
        "color3",
        file={"type": "filename", "value": "colour.exr"},
        uvtiling=tiling,
        uvoffset=offset,
    )
    made = base_color(tiles, source="i")
    assert made["filename"].endswith("colour.exr")
    # Where v points up, texel (row, column) has its centre at ((column + 1/2) / width, 1 - ...).
    u, v = texel_centres(WIDTH, HEIGHT)
    rows, columns = np.array([0, 2, 5]), np.array([1, 4, 7])
    at = np.stack([u[rows, columns], v[rows, columns]], axis=1)
    surface = (at + np.array(offset)) / np.array(tiling)
    found = seen(made, surface[:, 0], 1 - surface[:, 1])
    assert found == pytest.approx(pixels[rows, columns], abs=1e-4)


def test_place2d_turns_scales_and_moves_about_its_pivot(pixels):
    """By 90 degrees clockwise about the middle: right is what was below."""
    placed = node(
        "place2d",
        "place",
        "vector2",
        texcoord=linked("vector2", "uv"),
        pivot=(0.5, 0.5),
        rotate=90.0,
    )
    made = base_color(
        node("texcoord", "uv", "vector2"),
        placed,
        image("i", "colour.exr", space="", texcoord=linked("vector2", "place")),
        source="i",
    )
    u, v = texel_centres(WIDTH, HEIGHT)
    rows, columns = np.array([0, 2, 5]), np.array([1, 4, 7])
    image_u, image_v = u[rows, columns] - 0.5, v[rows, columns] - 0.5
    # rotate2d of the library is (u, v) -> (v, -u) at 90 degrees.
    surface_u, surface_v = -image_v + 0.5, image_u + 0.5
    found = seen(made, surface_u, 1 - surface_v)
    assert found == pytest.approx(pixels[rows, columns], abs=1e-4)


def test_wrapping_and_filtering_are_those_of_the_image(pixels):
    inputs = {"uaddressmode": "clamp", "vaddressmode": "mirror", "filtertype": "closest"}
    made = base_color(image("i", "colour.png", **inputs), source="i")
    assert made["wrap_mode_u"] == "clamp"
    assert made["wrap_mode_v"] == "mirror"
    assert made["filter_type"] == "nearest"


def test_prefixes_of_files_and_folders_of_included_ones_are_heeded(folder, pixels):
    (folder / "maps").mkdir()
    (folder / "colour.png").rename(folder / "maps" / "colour.png")
    write("maps/one.mtlx", image("i", "colour.png"))
    made = base_color('<xi:include href="maps/one.mtlx"/>', source="i")
    assert made["filename"] == str(folder / "maps" / "colour.png")
    write(
        "b.mtlx",
        image("i", "colour.png"),
        material("open_pbr_surface", base_color=linked("color3", "i")),
        fileprefix="maps/",
    )
    made = mlt.load_materials("b.mtlx")["M"]["bsdf"]["base_color"]
    assert made["filename"] == str(folder / "maps" / "colour.png")


def test_all_missing_images_are_named_in_one_error():
    changed = node("invert", "changed", "float", **{"in": linked("float", "b")})
    write(
        "a.mtlx",
        image("a", "one.png"),
        image("b", "two.png", "float", space=""),
        changed,
        material(
            "open_pbr_surface",
            base_color=linked("color3", "a"),
            specular_roughness=linked("float", "changed"),
        ),
    )
    for reader in mlt.load_materials, mlt.load:
        with pytest.raises(
            mlt.FileError, match=r"^a\.mtlx: .*one\.png: .*; .*two\.png: there is no"
        ):
            reader("a.mtlx")


# ---- nodes ---------------------------------------------------------------------------------------


def test_arithmetic_of_constants_is_a_constant():
    half = node("constant", "half", "float", value=0.5)
    square = node("power", "square", "float", in1=linked("float", "half"), in2=2.0)
    mixed = node("mix", "mixed", "float", bg=0.2, fg=1.0, mix=linked("float", "square"))
    assert roughness(half, square, mixed, source="mixed") == pytest.approx(0.4)


def test_an_image_times_one_is_still_its_file(pixels):
    tint = node("multiply", "t", "color3", in1=linked("color3", "i"), in2=(1.0, 1.0, 1.0))
    made = base_color(image("i", "colour.png"), tint, source="t")
    assert made["filename"].endswith("colour.png")


def test_an_image_that_is_changed_has_its_own_texels(pixels):
    """The nodes are those of two images at the same places, which repeat as these do."""
    place = node("place2d", "p", "vector2", texcoord=linked("vector2", "uv"), scale=(0.25, 0.5))
    where = {"texcoord": linked("vector2", "p")}
    added = node("add", "sum", "color3", in1=linked("color3", "i"), in2=linked("color3", "j"))
    halved = node("multiply", "half", "color3", in1=linked("color3", "sum"), in2=0.5)
    made = base_color(
        node("texcoord", "uv", "vector2"),
        place,
        image("i", "colour.exr", space="", **where),
        image("j", "colour.png", **where),
        added,
        halved,
        source="half",
    )
    assert made["data"] == pytest.approx(pixels, abs=0.02)
    assert np.diag(made["to_uv"]) == pytest.approx([4, 2, 1, 1])


NODES = {
    "subtract": ({"in1": 1.0, "in2": "x"}, lambda x: 1 - x),
    "add": ({"in1": 0.0, "in2": "x"}, lambda x: x),
    "multiply": ({"in1": "x", "in2": "x"}, lambda x: x * x),
    "divide": ({"in1": "x", "in2": 2.0}, lambda x: x / 2),
    "power": ({"in1": "x", "in2": 3.0}, lambda x: x**3),
    "clamp": ({"in": "x", "low": 0.25, "high": 0.5}, lambda x: np.clip(x, 0.25, 0.5)),
    "remap": (
        {"in": "x", "inlow": 0.0, "inhigh": 2.0, "outlow": 0.25, "outhigh": 0.75},
        lambda x: 0.25 + x / 4,
    ),
    "smoothstep": (
        {"in": "x", "low": 0.25, "high": 0.75},
        lambda x: np.clip(2 * x - 0.5, 0, 1) ** 2 * (3 - 2 * np.clip(2 * x - 0.5, 0, 1)),
    ),
    "invert": ({"in": "x"}, lambda x: 1 - x),
    "contrast": ({"in": "x", "amount": 0.5, "pivot": 0.5}, lambda x: 0.25 + x / 2),
    "range": (
        {"in": "x", "inlow": 0.0, "inhigh": 1.0, "outlow": 0.5, "outhigh": 1.0},
        lambda x: 0.5 + x / 2,
    ),
    "absval": ({"in": "x"}, np.abs),
    "modulo": ({"in1": "x", "in2": 0.3}, lambda x: x % 0.3),
    "min": ({"in1": "x", "in2": 0.4}, lambda x: np.minimum(x, 0.4)),
    "sin": ({"in": "x"}, np.sin),
    "sqrt": ({"in": "x"}, np.sqrt),
    "screen": ({"bg": 0.5, "fg": "x", "mix": 1.0}, lambda x: 1 - 0.5 * (1 - x)),
    "ifgreater": (
        {"value1": "x", "value2": 0.5, "in1": 0.9, "in2": "x"},
        lambda x: np.where(x > 0.5, 0.9, x),
    ),
    "mix": ({"bg": 1.0, "fg": 0.25, "mix": "x"}, lambda x: 1 - 0.75 * x),
}


@pytest.mark.parametrize("category", NODES)
def test_each_node_has_the_values_of_its_formula(category, pixels):
    inputs, formula = NODES[category]
    given = {key: linked("float", "i") if one == "x" else one for key, one in inputs.items()}
    made = roughness(
        image("i", "colour.exr", "float", space=""),
        node(category, "n", "float", **given),
        source="n",
    )
    expected = formula(pixels[..., 0].astype(float))
    assert made["data"] == pytest.approx(expected, abs=1e-5)


def test_colours_go_to_hsv_and_back(pixels):
    there = node("rgbtohsv", "hsv", "color3", **{"in": linked("color3", "i")})
    back = node("hsvtorgb", "rgb", "color3", **{"in": linked("color3", "hsv")})
    made = base_color(image("i", "colour.exr", space=""), there, back, source="rgb")
    assert made["data"] == pytest.approx(pixels, abs=1e-5)
    red = node("constant", "red", "color3", value=(0.8, 0.2, 0.2))
    turned = node("hsvadjust", "turn", "color3", **{"in": linked("color3", "red")})
    turned = turned.replace(
        "/></hsvadjust>",
        "/>" + '<input name="amount" type="vector3" value="0.3333333, 1, 0.5" /></hsvadjust>',
    )
    assert base_color(red, turned, source="turn")["value"] == pytest.approx(
        [0.1, 0.4, 0.1], abs=1e-5
    )


def test_luminance_has_the_weights_of_materialx(pixels):
    grey = node("luminance", "grey", "color3", **{"in": linked("color3", "i")})
    made = base_color(image("i", "colour.exr", space=""), grey, source="grey")
    weights = np.array([0.2722287, 0.6740818, 0.0536895])
    assert made["data"] == pytest.approx(np.repeat((pixels @ weights)[..., None], 3, 2), abs=1e-5)


def test_patterns_of_texture_coordinates_are_computed():
    uv = node("texcoord", "uv", "vector2")
    ramp = node("ramplr", "n", "float", valuel=0.2, valuer=1.0, texcoord=linked("vector2", "uv"))
    made = roughness(uv, ramp, source="n")["data"]
    assert made.shape == (1024, 1024)
    u, v = texel_centres(1024, 1024)
    assert made == pytest.approx(0.2 + 0.8 * u, abs=1e-6)
    split = node("splittb", "n", "float", valuet=0.9, valueb=0.1, center=0.75)
    made = roughness(split, source="n")["data"]
    assert made == pytest.approx(np.where(v >= 0.75, 0.9, 0.1), abs=1e-6)


def test_a_checkerboard_has_its_squares():
    board = node("checkerboard", "n", "color3", color1=(1.0, 0.0, 0.0), color2=(0.0, 0.0, 1.0))
    made = base_color(board, source="n")["data"]
    found = made[64::128, 64::128]  # the middles of 8 x 8 squares
    assert len(np.unique(found.reshape(-1, 3), axis=0)) == 2
    assert (found[0, :-1] != found[0, 1:]).any(axis=1).all()
    assert (found[:-1, 0] != found[1:, 0]).any(axis=1).all()


def test_nodes_that_a_file_defines_are_computed(pixels):
    definition = (
        '<nodedef name="ND_darker" node="darker"><input name="in" type="color3" value="1,1,1"/>'
        '<input name="by" type="float" value="0.5"/><output name="out" type="color3"/></nodedef>'
        '<nodegraph name="NG_darker" nodedef="ND_darker"><multiply name="m" type="color3">'
        '<input name="in1" type="color3" interfacename="in"/>'
        '<input name="in2" type="float" interfacename="by"/></multiply>'
        '<output name="out" type="color3" nodename="m"/></nodegraph>'
    )
    twice = node("darker", "a", "color3", **{"in": linked("color3", "i")})
    twice += node("darker", "b", "color3", **{"in": linked("color3", "a"), "by": 0.25})
    made = base_color(definition, image("i", "colour.exr", space=""), twice, source="b")
    assert made["data"] == pytest.approx(pixels * 0.125, abs=1e-6)


def test_graphs_with_inputs_of_their_own_are_computed(pixels):
    graph = (
        '<nodegraph name="g"><input name="gain" type="float" value="0.25"/>'
        + image("i", "colour.exr", space="")
        + '<multiply name="m" type="color3"><input name="in1" type="color3" nodename="i"/>'
        '<input name="in2" type="float" interfacename="gain"/></multiply>'
        '<output name="out" type="color3" nodename="m"/></nodegraph>'
    )
    link = {"type": "color3", "nodegraph": "g", "output": "out"}
    made = shader(graph, base_color=link)["base_color"]
    assert made["data"] == pytest.approx(pixels * 0.25, abs=1e-6)


@pytest.mark.parametrize(
    ("category", "kind"), [("noise3d", "float"), ("position", "vector3"), ("time", "float")]
)
def test_other_nodes_are_an_error_that_says_which_are_read(category, kind):
    nodes = node(category, "n", kind)
    if kind == "vector3":
        index = {"in": linked(kind, "n"), "index": 0}
        nodes += node("extract", "x", "float", **index)
    source = "x" if kind == "vector3" else "n"
    message = rf"^a\.mtlx: n.*: the node '{category}' is not read; read are image, .*smoothstep"
    with pytest.raises(mlt.SceneError, match=message):
        roughness(nodes, source=source)


def test_nodes_in_a_circle_are_refused():
    one = node("invert", "a", "float", **{"in": linked("float", "b")})
    two = node("invert", "b", "float", **{"in": linked("float", "a")})
    with pytest.raises(mlt.SceneError, match=r"^a\.mtlx: .*in a circle"):
        roughness(one, two, source="a")


def test_graphs_in_a_circle_are_refused():
    circle = "".join(
        f'<nodegraph name="{name}"><output name="out" type="vector3" nodegraph="{other}" '
        'output="out"/></nodegraph>'
        for name, other in ("gh", "hg")
    )
    link = {"type": "vector3", "nodegraph": "g", "output": "out"}
    for name in ("geometry_normal", "geometry_tangent"):
        with pytest.raises(mlt.SceneError, match=r"^a\.mtlx: [gh]/out: is connected in a circle"):
            shader(circle, **{name: link})


def test_graphs_that_multiply_are_refused():
    """Each node is made of two of the one before: 2^20 in all."""
    text = ""
    for level in range(20):
        inner = f"n{level - 1}" if level else "invert"
        text += (
            f'<nodedef name="ND_n{level}" node="n{level}"><input name="in" type="float" value="0"/>'
            f'<output name="out" type="float"/></nodedef><nodegraph name="NG_n{level}" '
            f'nodedef="ND_n{level}"><{inner} name="a" type="float"><input name="in" type="float" '
            f'interfacename="in"/></{inner}><{inner} name="b" type="float"><input name="in" '
            'type="float" nodename="a"/></' + inner + '><output name="out" type="float" '
            'nodename="b"/></nodegraph>'
        )
    with pytest.raises(mlt.SceneError, match=r"^a\.mtlx: .*(more than 10000 nodes|100 deep)"):
        roughness(text, node("n19", "n", "float", **{"in": 0.5}), source="n")


def test_slopes_of_slopes_are_refused():
    height = node("heighttonormal", "h", "vector3", **{"in": 0.5})
    height += node("extract", "x", "float", **{"in": linked("vector3", "h")}, index=0)
    height += node("heighttonormal", "g", "vector3", **{"in": linked("float", "x")})
    height += node("extract", "n", "float", **{"in": linked("vector3", "g")}, index=0)
    with pytest.raises(mlt.SceneError, match=r"^a\.mtlx: h: makes slopes of slopes"):
        roughness(height, source="n")


def test_computed_values_are_clipped_to_the_range_of_the_parameter(pixels):
    over = node("divide", "n", "float", in1=linked("float", "i"), in2=0.0)
    picture = image("i", "colour.exr", "float", space="")
    assert roughness(picture, over, source="n") == 1
    twice = node("multiply", "n", "float", in1=linked("float", "i"), in2=2.0)
    found = roughness(picture, twice, source="n")["data"]
    assert found == pytest.approx(np.minimum(2 * pixels[..., 0], 1))


def test_values_that_are_infinite_or_no_numbers_are_refused_by_their_input(pixels):
    root = node("ln", "n", "float", **{"in": linked("float", "minus")})
    minus = node("multiply", "minus", "float", in1=linked("float", "i"), in2=-1.0)
    picture = image("i", "colour.exr", "float", space="")
    with pytest.raises(mlt.SceneError, match=r"^a\.mtlx: M_shader: specular_roughness .*infinite"):
        roughness(picture, minus, root, source="n")
    over = node("divide", "n", "float", in1=linked("float", "i"), in2=0.0)
    with pytest.raises(mlt.SceneError, match=r"^a\.mtlx: M_shader: specular_weight .*infinite"):
        shader(picture, over, specular_weight=linked("float", "n"))


NOISE = {  # by the GLSL code that comes with MaterialX, compiled: noise, its vector, fractal, cells
    (0.3, 0.7): (0.040744, 0.040744, 0.651012, -0.302390, -0.259577, 0.860313),
    (-3.2, 5.6): (-0.527386, -0.527386, 0.051735, -0.707288, -0.591674, 0.679479),
    (12.25, -7.4): (-0.177030, -0.177030, -0.355124, -0.262702, -0.202351, 0.918407),
    (100.1, 41.9): (0.044775, 0.044775, -0.178206, 0.071812, 0.124639, 0.103970),
}


def at_point(category, point, kind="float"):
    """A quarter of a noise at texture coordinates, plus a half: a number that is no texture."""
    x = node(category, "noise", kind, texcoord=point)
    x += node("multiply", "scaled", kind, in1=linked(kind, "noise"), in2=0.25)
    x += node("add", "n", kind, in1=linked(kind, "scaled"), in2=0.5)
    if kind == "float":
        return 4 * roughness(x, source="n") - 2
    return 4 * np.array(base_color(x, source="n")["value"]) - 2


@pytest.mark.parametrize("point", NOISE)
def test_noise_is_that_of_materialx(point):
    one, *three, fractal, cell = NOISE[point]
    assert at_point("noise2d", point) == pytest.approx(one, abs=2e-5)
    assert at_point("noise2d", point, "color3") == pytest.approx(three, abs=2e-5)
    assert at_point("fractal2d", point) == pytest.approx(fractal, abs=2e-5)
    assert at_point("cellnoise2d", point) == pytest.approx(cell, abs=2e-5)


def test_noise_is_a_texture_of_texture_coordinates():
    noise = node("noise2d", "n", "float", amplitude=0.5, pivot=0.5)
    data = roughness(noise, source="n")["data"]
    u, v = texel_centres(1024, 1024)
    row, column = 307, 307  # whose v and u are near 0.7 and 0.3
    assert (u[row, column], v[row, column]) == pytest.approx((0.3, 0.7), abs=1e-3)
    assert 2 * data[row, column] - 1 == pytest.approx(0.040744, abs=5e-3)


def test_only_the_branch_that_is_taken_needs_to_be_read():
    other = node("noise3d", "other", "float")
    first = {"in1": 0.75, "in2": linked("float", "other"), "which": 0}
    assert roughness(other, node("switch", "n", "float", **first), source="n") == 0.75
    with pytest.raises(mlt.SceneError, match="'noise3d' is not read"):
        roughness(other, node("switch", "n", "float", **first | {"which": 1}), source="n")


def test_texels_that_are_all_the_same_are_a_number(pixels):
    """Alpha of an image that has none is 1."""
    alpha = node("extract", "n", "float", **{"in": linked("color4", "i")}, index=3)
    half = node("multiply", "half", "float", in1=linked("float", "n"), in2=0.5)
    assert roughness(image("i", "colour.png", "color4"), alpha, half, source="half") == 0.5


# ---- parameters and normals ----------------------------------------------------------------------


def test_a_parameter_without_textures_takes_the_mean_with_a_warning(pixels):
    with pytest.warns(
        UserWarning, match=r"^a\.mtlx: M_shader: specular_ior is a texture"
    ) as caught:
        made = shader(
            image("i", "colour.exr", "float", space=""), specular_ior=linked("float", "i")
        )
    assert len(caught) == 1
    assert made["specular_ior"] == pytest.approx(pixels[..., 0].mean(), abs=1e-5)


def test_a_texture_that_glows_is_the_radiance(pixels):
    inputs = {"emission_luminance": 4.0, "emission_color": linked("color3", "i")}
    write("a.mtlx", image("i", "colour.exr", space=""), material("open_pbr_surface", **inputs))
    emitter = mlt.load_materials("a.mtlx")["M"]["emitter"]
    assert emitter["radiance"]["data"] == pytest.approx(4 * pixels, abs=1e-5)


def bent_by(*elements, category="open_pbr_surface", name="geometry_normal", source="n"):
    write("a.mtlx", *elements, material(category, **{name: linked("vector3", source)}))
    return mlt.load_materials("a.mtlx")["M"]["bsdf"]


def test_a_normal_map_lies_around_the_material(folder, pixels):
    normals = image("i", "colour.png", "vector3", space="")
    made = bent_by(normals, node("normalmap", "n", "vector3", **{"in": linked("vector3", "i")}))
    assert made["type"] == "normalmap"
    assert made["bsdf"] == {"type": "openpbr"}
    expected = {"type": "bitmap", "filename": str(folder / "colour.png"), "raw": True}
    assert made["normalmap"] == expected


def test_the_scale_of_a_normal_map_is_computed(pixels):
    normals = image("i", "colour.exr", "vector3", space="")
    scaled = node("normalmap", "n", "vector3", **{"in": linked("vector3", "i")}, scale=0.5)
    found = 2 * bent_by(normals, scaled)["normalmap"]["data"] - 1
    expected = (2 * pixels - 1) * [0.5, 0.5, 1]
    expected /= np.linalg.norm(expected, axis=2, keepdims=True)
    assert found == pytest.approx(expected, abs=1e-5)


def test_heights_bend_normals_against_their_slope():
    """The height u / 2 has a slope of 1/2 along u, of which MaterialX takes a sixteenth."""
    uv = node("texcoord", "uv", "vector2")
    u = node("extract", "u", "float", **{"in": linked("vector2", "uv")}, index=0)
    height = node("multiply", "height", "float", in1=linked("float", "u"), in2=0.5)
    bump = node("bump", "n", "vector3", height=linked("float", "height"), scale=1.0)
    made = bent_by(uv, u, height, bump)["normalmap"]["data"]
    slope = -1 / 32
    expected = np.array([slope, 0, 1]) / np.hypot(slope, 1)
    assert 2 * made[5, 5] - 1 == pytest.approx(expected, abs=1e-5)


BENT = "M_shader: its normals bend the coat, too"


@pytest.mark.parametrize(
    ("inputs", "expected"),
    [
        ({}, []),
        ({"coat_weight": 1.0}, [BENT]),
        ({"coat_weight": 1.0, "geometry_coat_normal": linked("vector3", "n")}, []),
        (
            {"coat_weight": 1.0, "geometry_coat_normal": linked("vector3", "other")},
            ["M_shader: geometry_coat_normal is left out", BENT],
        ),
        ({"coat_weight": 1.0, "geometry_coat_normal": linked("vector3", "plain")}, [BENT]),
    ],
)
def test_a_coat_that_lies_straight_over_bent_normals_is_a_warning(pixels, inputs, expected):
    elements = image("i", "colour.png", "vector3", space="") + node("normal", "plain", "vector3")
    for name in ("n", "other"):
        elements += node("normalmap", name, "vector3", **{"in": linked("vector3", "i")})
    given = {"geometry_normal": linked("vector3", "n")} | inputs
    write("a.mtlx", elements, material("open_pbr_surface", **given))
    with warnings.catch_warnings(record=True) as caught:
        warnings.simplefilter("always")
        mlt.load_materials("a.mtlx")
    assert [str(one.message) for one in caught] == [f"a.mtlx: {text}" for text in expected]


def test_the_surface_s_own_normals_bend_nothing():
    assert bent_by(node("normal", "n", "vector3")) == {"type": "openpbr"}


def test_normals_of_usd_are_not_encoded(pixels):
    normals = image("i", "colour.exr", "vector3", space="")
    made = bent_by(normals, category="UsdPreviewSurface", name="normal", source="i")
    assert made["normalmap"]["data"] == pytest.approx((pixels + 1) / 2, abs=1e-6)


def test_textures_of_usd_are_scaled_and_taken_apart(pixels):
    """By the names of texture coordinates that programs of USD write."""
    nodes = node("UsdPrimvarReader", "st", "vector2", varname="st")
    given = {"file": {"type": "filename", "value": "colour.exr"}, "st": linked("vector2", "st")}
    given["scale"] = {"type": "color4", "value": "0.5, 0.25, 1, 1"}
    nodes += node("UsdUVTexture", "t", "multioutput", **given)
    inputs = {
        "diffuseColor": linked("color3", "t", output="rgb"),
        "roughness": linked("float", "t", output="g"),
    }
    write("a.mtlx", nodes, material("UsdPreviewSurface", **inputs))
    made = mlt.load_materials("a.mtlx")["M"]["bsdf"]
    assert made["base_color"]["data"] == pytest.approx(pixels * [0.5, 0.25, 1], abs=1e-6)
    assert made["specular_roughness"]["data"] == pytest.approx(pixels[..., 1] / 4, abs=1e-6)


def test_textures_of_gltf_have_factors_alpha_and_normals(folder, pixels):
    alpha = np.linspace(0, 1, HEIGHT * WIDTH, dtype=np.float32).reshape(HEIGHT, WIDTH, 1)
    mlt.write_image("alpha.exr", np.concatenate([pixels, alpha], axis=2))
    file = {"type": "filename", "value": "alpha.exr"}
    factor = {"type": "color4", "value": "1, 0.5, 1, 0.5"}
    nodes = node("gltf_colorimage", "c", "multioutput", file=file, color=factor)
    normals = {"type": "filename", "value": "colour.png"}
    nodes += node("gltf_normalmap", "n", "vector3", file=normals)
    inputs = {
        "base_color": linked("color3", "c", output="outcolor"),
        "alpha": linked("float", "c", output="outa"),
        "alpha_mode": 2,
        "normal": linked("vector3", "n"),
    }
    write("a.mtlx", nodes, material("gltf_pbr", **inputs))
    made = mlt.load_materials("a.mtlx")["M"]["bsdf"]
    assert made["normalmap"]["filename"] == str(folder / "colour.png")
    surface = made["bsdf"]
    assert surface["base_color"]["data"] == pytest.approx(pixels * [1, 0.5, 1], abs=1e-6)
    assert surface["geometry_opacity"]["data"] == pytest.approx(alpha[..., 0] / 2, abs=1e-6)


def test_textures_go_through_the_translation_of_standard_surface(folder, pixels):
    inputs = {"base": 1.0, "base_color": linked("color3", "i")}
    write("a.mtlx", image("i", "colour.png"), material("standard_surface", **inputs))
    made = mlt.load_materials("a.mtlx")["M"]["bsdf"]
    assert made["base_color"] == {"type": "bitmap", "filename": str(folder / "colour.png")}
