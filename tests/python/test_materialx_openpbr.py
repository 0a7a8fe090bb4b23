"""Materials of MaterialX with the plug-in `openpbr`, which renders them."""

import numpy as np
import pytest
from materialx_files import material, write

import pymlt as mlt
from pymlt import _core, cli
from pymlt.formats.files import read_foreign
from pymlt.formats.materialx.document import standard_nodes
from pymlt.formats.materialx.materials import UNTEXTURED, is_parameter


@pytest.fixture(autouse=True)
def folder(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)


def test_each_input_of_openpbr_is_a_parameter_with_the_same_default():
    parameters = {one["name"]: one for one in _core.schema("bsdf", "openpbr")["parameters"]}
    definition = standard_nodes().getNodeDef("ND_open_pbr_surface_surfaceshader")
    inputs = [one for one in definition.getActiveInputs() if is_parameter(one.getName())]
    assert len(inputs) > 30
    for given in inputs:
        parameter = parameters[given.getName()]
        default = np.array(
            given.getValue().asTuple() if "color" in given.getType() else given.getValue()
        )
        assert np.allclose(parameter["default"], default.astype(float)), given.getName()
        takes_textures = "texture" in parameter["type"]
        assert takes_textures != (given.getName() in UNTEXTURED | {"geometry_thin_walled"})


def test_a_file_is_rendered_by_its_name():
    red = material("open_pbr_surface", name="Red", base_color=(0.9, 0.1, 0.1), base_metalness=1.0)
    grey = material("open_pbr_surface", name="Grey", base_color=(0.5, 0.5, 0.5))
    write("a.mtlx", red, grey)
    arguments = ["--size", "60x30", "--spp", "16", "--integrator", "path", "-o", "a.exr"]
    assert cli.main(["render", "a.mtlx", "--quiet", *arguments]) == 0
    seen = mlt.read_image("a.exr")
    left, right = seen[12:18, 14:18].mean(axis=(0, 1)), seen[12:18, 42:46].mean(axis=(0, 1))
    assert left[0] > 3 * left[1]
    assert right[0] < 1.3 * right[1]


def test_parts_of_a_shape_are_what_a_shape_takes():
    glow = {"emission_luminance": 3.0, "emission_color": (1.0, 0.5, 0.25)}
    write("a.mtlx", material("open_pbr_surface", base_color=(0.0, 0.0, 0.0), **glow))
    lamp = {"type": "sphere", **mlt.load_materials("a.mtlx")["M"]}
    look = mlt.Transform.look_at(origin=[0, 0, 4], target=[0, 0, 0], up=[0, 1, 0])
    camera = {"type": "perspective", "fov": 10, "to_world": look}
    given = {"type": "scene", "lamp": lamp, "camera": camera}
    scene = mlt.load_dict(given, size=(4, 4), filter="box")
    seen = mlt.render(scene, mlt.Path(max_depth=1), spp=4, seed=1)
    assert seen.mean(axis=(0, 1)) == pytest.approx([3, 1.5, 0.75], rel=1e-3)


def test_what_the_plug_in_refuses_is_an_error_of_the_file():
    write("a.mtlx", material("open_pbr_surface", specular_ior=0.0))
    with pytest.raises(mlt.SceneError, match=r"^a\.mtlx: .*specular_ior"):
        mlt.load("a.mtlx")


@pytest.mark.parametrize(
    "category", ["open_pbr_surface", "standard_surface", "gltf_pbr", "UsdPreviewSurface"]
)
def test_the_default_of_each_shader_is_rendered(category):
    write("a.mtlx", material(category))
    image = mlt.render(mlt.load("a.mtlx", size=(16, 12)), "path", spp=4, seed=1)
    assert np.isfinite(image).all()
    assert image.min() > 0


def test_a_converted_file_has_the_same_pixels():
    write("a.mtlx", material("open_pbr_surface", base_color=(0.2, 0.4, 0.8), coat_weight=1.0))
    assert mlt.convert("a.mtlx", "a.xml") == []
    images = [
        mlt.render(mlt.load(name, size=(16, 12)), "path", spp=2, seed=1)
        for name in ("a.mtlx", "a.xml")
    ]
    assert np.array_equal(*images)


def test_the_file_s_scene_has_no_warning():
    write("a.mtlx", material("open_pbr_surface"))
    assert read_foreign("a.mtlx").warnings == []
    assert mlt.load("a.mtlx").warnings == []
