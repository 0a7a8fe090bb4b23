"""The lists of a scene's shapes, lights and sensors."""

import warnings

import numpy as np
import pytest
import tiny
from test_editing import house

import pymlt as mlt


def names(parts) -> list[str]:
    return [part.name for part in parts]


def test_shapes_are_those_of_the_description():
    scene = mlt.load_dict(house())
    shapes = scene.shapes()
    described = [name for name, part in house().items() if isinstance(part, dict)]
    assert names(shapes) == [n for n in described if n in names(shapes)]
    assert [shape.index for shape in shapes] == list(range(len(shapes)))
    by_name = {shape.name: shape for shape in shapes}
    assert {"mesh", "left", "pendulum"} <= by_name.keys()
    assert "pile" not in by_name  # of which there is only an instance
    assert by_name["left"].type == "instance"
    assert by_name["pendulum"].type == "sphere"
    assert by_name["pendulum"].emits
    assert not by_name["mesh"].emits
    assert by_name["mesh"].material == "mesh.bsdf"
    drawn = [shape["shape"] for shape in scene.triangles()]
    assert drawn == [shape.index for shape in shapes]


def test_boxes_enclose_what_moves_at_all_times():
    scene = mlt.load_dict(house())
    boxes = {shape.name: shape.bbox for shape in scene.shapes()}
    low, high = boxes["pendulum"]  # of radius .2, from (0, 1, 0) to (1, 1, 0)
    np.testing.assert_allclose(low, [-0.2, 0.8, -0.2], atol=1e-6)
    np.testing.assert_allclose(high, [1.2, 1.2, 0.2], atol=1e-6)
    low, high = boxes["left"]  # a cube of the side .4 around (-1, 1, 0)
    np.testing.assert_allclose([low, high], [[-1.2, 0.8, -0.2], [-0.8, 1.2, 0.2]], atol=1e-6)
    whole = scene.bbox()
    np.testing.assert_array_equal(whole[0], np.min([low for low, _ in boxes.values()], axis=0))
    np.testing.assert_array_equal(whole[1], np.max([high for _, high in boxes.values()], axis=0))


def test_boxes_are_where_the_description_has_them_far_from_the_origin():
    place = mlt.Transform.translate([1e6, 0, 0])
    scene = mlt.load_dict(
        {
            "type": "scene",
            "sensor": {"type": "perspective", "to_world": place.translate([0, 0, -5])},
            "ball": {"type": "sphere", "to_world": place.translate([0, 2, 0])},
            "sky": {"type": "constant"},
        }
    )
    np.testing.assert_allclose(scene.bbox(), [[1e6 - 1, 1, -1], [1e6 + 1, 3, 1]], atol=1e-6)


def test_parameters_are_those_that_begin_with_the_name():
    scene = mlt.load_dict(house())
    every = scene.parameters()
    for part in [*scene.shapes(), *scene.emitters(), *scene.sensors()]:
        assert part.parameters
        for name, value in part.parameters.items():
            np.testing.assert_equal(value, every[f"{part.name}.{name}"])
    (sensor,) = scene.sensors()
    moved = scene.updated({f"{sensor.name}.fov": 12.5})
    assert moved.sensors()[0].parameters["fov"] == 12.5


def test_lights_of_shapes_are_listed_too():
    assert "pendulum.emitter" in names(mlt.load_dict(house()).emitters())


def test_a_sensor_of_the_list_is_one_to_render_by():
    scene = tiny.scene()
    aside = mlt.Transform.look_at(origin=[4, 1, 0], target=[0, 0.5, 0], up=[0, 1, 0])
    both = mlt.load_dict(scene | {"other": scene["sensor"] | {"to_world": aside}})
    first, second = both.sensors()
    assert (first.name, second.name) == ("sensor", "other")
    by_index = [mlt.render(both, "path", spp=2, sensor=i) for i in range(2)]
    by_part = [mlt.render(both, "path", spp=2, sensor=part) for part in (first, second)]
    np.testing.assert_array_equal(by_part, by_index)
    given = mlt.render(scene, "path", spp=2, sensor=scene["sensor"] | {"to_world": aside})
    np.testing.assert_array_equal(given, by_index[1])


@pytest.mark.parametrize(
    ("sensor", "message"),
    [
        ({"type": "sphere"}, "unknown sensor 'sphere'"),
        ({"type": "perspective", "fov": -1}, "sensor"),
        ({"type": "perspective", "angle": 30}, "unknown parameter 'angle'"),
    ],
)
def test_a_wrong_sensor_is_refused(sensor, message):
    with pytest.raises(mlt.SceneError, match=message):
        mlt.render(tiny.scene(), sensor=sensor, spp=1)


# ---- edited scenes -----------------------------------------------------------------------------


def edited():
    scene = mlt.load_dict(tiny.scene())
    params = mlt.traverse(scene)
    params["sensor.fov"] = 20
    params.update()
    return scene, params


def rendered(scene) -> np.ndarray:
    return mlt.render(scene, "path", spp=1)


def test_who_renders_an_edited_scene_as_it_was_is_told_once():
    scene, params = edited()
    with pytest.warns(UserWarning, match=r"edited by `params.update\(\)`.* as it was before"):
        rendered(scene)
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        rendered(scene)
        rendered(params)


@pytest.mark.parametrize("how", [{}, {"spectral": True}, {"sensor": tiny.scene()["sensor"]}])
def test_the_warning_names_the_line_that_renders(how):
    scene, _ = edited()
    with pytest.warns(UserWarning, match="edited") as found:
        mlt.render(scene, "path", spp=1, **how)
    assert found[0].filename == __file__


@pytest.mark.parametrize("twice", [False, True])
def test_who_has_used_the_new_scene_may_render_the_old_one(twice):
    scene, params = edited()
    if twice:
        params.update({"sensor.fov": 30})
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        assert not np.array_equal(rendered(params), rendered(scene))
    scene, params = edited()
    newest = params.update({"sensor.fov": 30})
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        rendered(newest)
        rendered(scene)


def test_a_scene_that_was_edited_by_nobody_who_kept_the_result_is_told_of():
    scene = mlt.load_dict(tiny.scene())
    mlt.traverse(scene).update({"sensor.fov": 20})
    with pytest.warns(UserWarning, match="edited"):
        rendered(scene)


def test_an_update_without_changes_makes_no_scene():
    scene = mlt.load_dict(tiny.scene())
    assert mlt.traverse(scene).update() is scene


# ---- parameters that are kept ------------------------------------------------------------------


@pytest.mark.parametrize(
    ("given", "kept"),
    [
        ("sensor.fov", ["sensor.fov"]),
        (["sensor.x_fov"], ["sensor.fov", "sensor.fov_axis"]),
        (["sensor.fov", r"sensor\.film\.(width|height)$"], None),
    ],
)
def test_parameters_are_kept_by_name_or_pattern(given, kept):
    params = mlt.traverse(mlt.load_dict(tiny.scene()))
    params.keep(given)
    expected = kept or ["sensor.fov", "sensor.film.width", "sensor.film.height"]
    assert sorted(params) == sorted(expected)
    params.update({"sensor.fov": 33})
    assert sorted(params) == sorted(expected)
    assert params["sensor.fov"] == 33
    with pytest.raises(mlt.UsageError, match="no parameter"):
        params["sensor.to_world"] = mlt.Transform()


def test_a_name_that_keeps_nothing_is_refused():
    params = mlt.traverse(mlt.load_dict(tiny.scene()))
    with pytest.raises(mlt.UsageError, match=r"no parameter 'sensor\.fow'.*sensor\.fov"):
        params.keep("sensor.fow")
    with pytest.raises(mlt.UsageError, match="no regular expression"):
        params.keep("(")
