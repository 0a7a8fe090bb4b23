"""Scenes that are made of other scenes by changing parameters: equal to those loaded that way."""

import copy
import pickle
import subprocess
import sys
import threading
import time
from pathlib import Path
from types import SimpleNamespace

import numpy as np
import pytest
import tiny

import pymlt as mlt

T = mlt.Transform
rng = np.random.default_rng(1)
TEXELS = rng.random((4, 4, 3), np.float32)
SKY = rng.random((4, 8, 3), np.float32)
VERTICES = np.array([[-1, 0, -1], [1, 0, -1], [1, 0.5, 1], [-1, 0.2, 1]], np.float32)
FACES = np.array([[0, 2, 1], [0, 3, 2]], np.uint32)
UV = np.array([[0, 0], [1, 0], [1, 1], [0, 1]], np.float32)
ASIDE = T.look_at(origin=[3, 2, 3], target=[0, 0.5, 0], up=[0, 1, 0])
SWING = {"type": "animation", "0": T().translate(0, 1, 0), "1": T().translate(1, 1, 0)}


def house() -> dict:
    """Something of everything that a scene can tell its parts, or its parts each other."""
    scene = tiny.scene()
    scene["sensor"] |= {"shutter_close": 1.0}
    return scene | {
        "grain": {"type": "bitmap", "data": TEXELS, "raw": True},
        "mesh": {
            "type": "mesh",
            "vertices": VERTICES,
            "faces": FACES,
            "uv": UV,
            "bsdf": {
                "type": "twosided",
                "bsdf": {
                    "type": "bumpmap",
                    "texture": {"type": "ref", "id": "grain"},
                    "bsdf": {"type": "diffuse", "reflectance": {"type": "ref", "id": "grain"}},
                },
            },
        },
        "pile": {"type": "shapegroup", "brick": {"type": "cube", "bsdf": {"type": "conductor"}}},
        "left": {
            "type": "instance",
            "to_world": T().translate(-1, 1, 0).scale(0.2),
            "pile": {"type": "ref", "id": "pile"},
        },
        "pendulum": {
            "type": "sphere",
            "radius": 0.2,
            "to_world": SWING,
            "emitter": {"type": "area", "radiance": 9.0},
        },
        "sky": {"type": "envmap", "data": SKY},
        "sun": {"type": "sunsky", "sun_direction": [1, 1, 1], "resolution": 16},
        "spot": {"type": "spot", "intensity": 3.0},
    }


EDITS = {
    "sensor.to_world": ASIDE,
    "sensor.fov": 55.0,
    "sensor.shutter_close": 0.5,
    "sensor.film.width": 20,
    "integrator.max_depth": 3,
    "clay.reflectance": {"type": "rgb", "value": [0.1, 0.2, 0.9]},
    "grain.data": TEXELS[::-1] * 0.5,
    "mesh.vertices": VERTICES + np.float32(0.1),
    "ball.center": [0.2, 0.7, 0.1],
    "pile.brick.bsdf.material": "Cu",
    "left.to_world": T().translate(-1, 0.5, 0).scale(0.3),
    "pendulum.to_world": SWING | {"1": T().translate(2, 1, 0)},
    "pendulum.emitter.radiance": {"type": "rgb", "value": [1.0, 9.0, 1.0]},
    "lamp.emitter.radiance": 2.0,
    "lamp.emitter.sampling_weight": 3.0,
    "sky.data": SKY[::-1],
    "sky.scale": 2.0,
    "sun.sun_scale": 0.5,
    "spot.to_world": T.look_at(origin=[1, 2, 1], target=[0, 0, 0], up=[0, 1, 0]),
}


def test_parameters_are_set_by_name_and_then_updated():
    scene = mlt.load_dict(house())
    before = scene.hash
    params = mlt.traverse(scene)
    assert dict(params).keys() == scene.parameters().keys()
    for name, value in EDITS.items():
        params[name] = value
    assert params.scene is scene
    assert params.update() is params.scene
    assert_same(params.scene, scene.updated(EDITS))
    assert scene.hash == before
    np.testing.assert_array_equal(image(params), image(params.scene))
    assert params["sensor.fov"] == 55.0
    params.update({"sensor.fov": 40.0})
    assert params.scene.parameters()["sensor.fov"] == 40.0


def test_parameters_that_do_not_fit_leave_everything_as_it_was():
    params = mlt.traverse(mlt.load_dict(tiny.scene()))
    scene = params.scene
    with pytest.raises(mlt.UsageError, match=r"no parameter 'sensor\.fow'.*'sensor\.fov'"):
        params["sensor.fow"] = 3
    params["sensor.fov"] = "wide"
    with pytest.raises(mlt.SceneError, match=r"sensor\.fov"):
        params.update()
    assert params.scene is scene
    assert params["sensor.fov"] == 40.0
    assert params.update().hash == scene.hash
    with pytest.raises(mlt.UsageError, match="cannot be taken"):
        del params["sensor.fov"]


@pytest.mark.parametrize("make", [tiny.scene, house, mlt.scenes.motion], ids=lambda f: f.__name__)
def test_a_dict_can_be_written_as_xml(tmp_path, make):
    assert mlt.convert(make(), tmp_path / "scene.xml") == []
    np.testing.assert_array_equal(image(tmp_path / "scene.xml"), image(make()))


def test_a_dict_of_any_form_can_be_written_as_xml(tmp_path):
    scene = tiny.scene()
    scene["integrator"] = mlt.Path(max_depth=3)
    scene["sensor"]["fov"] = np.float32(50)
    scene["ball"]["center"] = np.array([0, 0.5, 0])
    scene["floor"]["to_world"] = scene["floor"]["to_world"].matrix.tolist()
    scene["clay"]["reflectance"] = {"type": "bitmap", "bitmap": TEXELS, "raw": True}
    scene["lamp"]["emitter"]["radiance"] = {"type": "spectrum", "value": [(400, 1), (700, 2.5)]}
    scene["body"] = SimpleNamespace(vertices=VERTICES, faces=FACES)
    mlt.convert(scene, tmp_path / "scene.xml")
    written = mlt.load(tmp_path / "scene.xml")
    np.testing.assert_array_equal(image(written, None), image(mlt.load_dict(scene), None))


def test_a_dict_that_is_no_scene_is_not_written(tmp_path):
    with pytest.raises(mlt.SceneError, match="unknown type 'bal'"):
        mlt.convert({"type": "scene", "ball": {"type": "bal"}}, tmp_path / "scene.xml")
    assert not list(tmp_path.iterdir())


def changed(scene: dict, edits: dict) -> dict:
    """The dict with other values at the end of "key.key.key"."""
    scene = copy.deepcopy(scene)
    for name, value in edits.items():
        *keys, last = name.split(".")
        place = scene
        for key in keys:
            place = place[key]
        place[last] = value
    return scene


def described(scene) -> dict:
    return {key: value for key, value in scene.info().items() if key != "seconds"}


def assert_same(one, other, integrator="path") -> None:
    assert one.hash == other.hash
    assert described(one) == described(other)
    np.testing.assert_array_equal(image(one, integrator), image(other, integrator))


def image(scene, integrator="path") -> np.ndarray:
    return mlt.render(scene, integrator, spp=2, seed=1)


@pytest.mark.parametrize("name", EDITS)
def test_an_edited_scene_is_the_one_loaded_that_way(name):
    loaded = mlt.load_dict(house())
    before = image(loaded)
    edits = {name: EDITS[name]}
    edited = loaded.updated(edits)
    assert_same(edited, mlt.load_dict(changed(house(), edits)))
    assert edited.hash != loaded.hash
    np.testing.assert_array_equal(image(loaded), before)
    assert_same(edited.updated({name: value_of(house(), name)}) if given(name) else loaded, loaded)


def given(name) -> bool:
    try:
        return value_of(house(), name) is not None
    except KeyError:
        return False


def value_of(scene, name):
    for key in name.split("."):
        scene = scene[key]
    return scene


def test_the_size_of_a_film_is_edited_whatever_size_was_asked_for():
    scene = mlt.load_dict(mlt.scenes.cornell_box(), size=(64, 32))
    half = scene.updated({"sensor.film.width": 32})
    assert (half.width, half.height) == (32, 32)
    small = scene.updated({"sensor.film.width": 16, "sensor.film.height": 8})
    same = mlt.load_dict(mlt.scenes.cornell_box(), size=(16, 8))
    images = [mlt.render(s, "path", spp=2) for s in (small, same)]
    np.testing.assert_array_equal(*images)


def test_edits_one_after_the_other_are_edits_at_once():
    scene = mlt.load_dict(house())
    for name, value in EDITS.items():
        scene = scene.updated({name: value})
    assert_same(scene, mlt.load_dict(house()).updated(EDITS))
    assert_same(scene, mlt.load_dict(changed(house(), EDITS)))


@pytest.mark.parametrize("integrator", mlt.available("integrator"))
def test_every_integrator_renders_an_edited_scene(integrator):
    edits = {"sensor.to_world": ASIDE, "lamp.emitter.radiance": 2.0, "ball.radius": 0.4}
    edited = mlt.load_dict(tiny.scene()).updated(edits)
    assert_same(edited, mlt.load_dict(changed(tiny.scene(), edits)), integrator)


def test_an_edited_xml_scene_is_the_text_with_other_values():
    scene = mlt.load_string(tiny.XML.replace('value="40"', 'value="50"'))
    assert_same(mlt.load_string(tiny.XML).updated({"sensor.fov": 50.0}), scene)
    moved = tiny.XML.replace('x="0" y="0.6"', 'x="0.25" y="0.6"')
    edited = mlt.load_string(tiny.XML).updated({"shape_1.center": [0.25, 0.6, 0]})
    assert_same(edited, mlt.load_string(moved))


def test_an_edited_scene_can_be_pickled_and_so_can_its_original():
    edited = mlt.load_dict(house()).updated({"sky.scale": 2.0})
    copied = pickle.loads(pickle.dumps(edited))
    assert_same(copied, edited)
    assert_same(
        copied.updated({"clay.reflectance": 0.1}), edited.updated({"clay.reflectance": 0.1})
    )


def test_the_files_of_an_unpickled_scene_are_not_needed_again(tmp_path):
    path = tmp_path / "map.exr"
    mlt.write_image(path, SKY)
    dict_ = tiny.scene() | {"sky": {"type": "envmap", "filename": str(path)}}
    scene = mlt.load_dict(dict_)
    wide = changed(dict_, {"sensor.fov": 70.0})
    reference = mlt.load_dict(wide)
    copied = pickle.loads(pickle.dumps(scene))
    path.unlink()
    assert_same(copied.updated({"sensor.fov": 70.0}), reference)
    assert_same(scene.updated({"sensor.fov": 70.0}), reference)
    with pytest.raises(mlt.FileError, match=r"map\.exr"):
        scene.updated({"sky.scale": 2.0})


def test_a_file_that_is_read_again_counts_as_it_is_now(tmp_path):
    path = tmp_path / "map.exr"
    mlt.write_image(path, SKY)
    scene = mlt.load_dict(tiny.scene() | {"sky": {"type": "envmap", "filename": str(path)}})
    mlt.write_image(path, SKY * 2)
    with_file = {"type": "envmap", "filename": str(path), "scale": 3.0}
    now = mlt.load_dict(tiny.scene() | {"sky": with_file})
    assert_same(scene.updated({"sky.scale": 3.0}), now)


def test_an_array_takes_the_place_of_a_file(tmp_path):
    path = tmp_path / "map.exr"
    mlt.write_image(path, SKY)
    scene = mlt.load_dict(tiny.scene() | {"sky": {"type": "envmap", "filename": str(path)}})
    array = mlt.load_dict(tiny.scene() | {"sky": {"type": "envmap", "data": SKY}})
    assert_same(scene.updated({"sky.data": SKY}), array)
    assert_same(array.updated({"sky.filename": str(path)}), scene)


def test_a_colour_becomes_a_texture_and_a_colour_again():
    grain = {"type": "bitmap", "data": TEXELS}
    textured = tiny.scene()
    textured["clay"]["reflectance"] = grain
    scene = mlt.load_dict(tiny.scene())
    edited = scene.updated({"clay.reflectance": grain})
    assert_same(edited, mlt.load_dict(textured))
    back = edited.updated({"clay.reflectance": tiny.scene()["clay"]["reflectance"]})
    assert_same(back, scene)


def test_a_checkpoint_of_an_edited_scene_goes_on_with_it(tmp_path):
    edited = mlt.load_dict(tiny.scene()).updated({"sensor.fov": 55.0})
    file = tmp_path / "render.mlt"
    job = mlt.start(edited, "pssmlt", spp=4, seed=1)
    job.wait()
    job.checkpoint(file)
    again = mlt.load_dict(changed(tiny.scene(), {"sensor.fov": 55.0}))
    result = mlt.resume(file, spp=8, scene=again).result()
    whole = mlt.start(edited, "pssmlt", spp=8, seed=1).result()
    np.testing.assert_array_equal(result.image, whole.image)
    with pytest.raises(mlt.SceneError, match="has changed"):
        mlt.resume(file, spp=8, scene=mlt.load_dict(tiny.scene()))


def test_a_scene_is_edited_while_it_renders():
    scene = mlt.load_dict(house())
    alone = image(scene)
    images = []
    thread = threading.Thread(target=lambda: images.extend(image(scene) for _ in range(4)))
    thread.start()
    while thread.is_alive():
        scene.updated({"sensor.to_world": ASIDE, "sky.scale": 2.0, "grain.data": TEXELS * 0.5})
    thread.join()
    for rendered in images:
        np.testing.assert_array_equal(rendered, alone)


def test_parameters_have_their_current_values():
    scene = mlt.load_dict(house())
    parameters = scene.parameters()
    assert parameters["sensor.fov"] == 40
    assert parameters["spot.cutoff_angle"] == 20
    assert parameters["sky.filename"] is None
    assert parameters["clay.reflectance"] == (0.7, 0.4, 0.2)
    np.testing.assert_array_equal(parameters["mesh.vertices"], VERTICES)
    np.testing.assert_array_equal(parameters["mesh.faces"], FACES)
    np.testing.assert_array_equal(parameters["grain.data"], TEXELS)
    assert scene.updated({"sensor.fov": 12}).parameters()["sensor.fov"] == 12
    assert parameters["mesh.bsdf.bsdf.bsdf.reflectance"] == {"type": "ref", "id": "grain"}


def test_names_are_ids_or_places_in_the_tree():
    names = mlt.load_string(tiny.XML).parameters()
    for name in ("sensor.fov", "clay.reflectance", "shape_1.bsdf.int_ior", "shape_2.to_world"):
        assert name in names
    edited = mlt.load_string(tiny.XML).updated({"clay.reflectance.value": 0.1})
    assert edited.parameters()["clay.reflectance"] == 0.1


@pytest.mark.parametrize(
    ("edit", "error", "message"),
    [
        ({"sensor.fvo": 1}, mlt.UsageError, "'sensor.fvo'; did you mean 'sensor.fov'"),
        ({"nothing.like.it": 1}, mlt.UsageError, "scene.parameters\\(\\) names them all"),
        ({"fov": 1}, mlt.UsageError, "no parameter 'fov'"),
        ({3: 1}, mlt.UsageError, "should be a string"),
        ({"sensor.fov": "wide"}, mlt.SceneError, "^sensor.fov: .* should be a float"),
        ({"sensor.fov": [1, 2]}, mlt.SceneError, "^sensor.fov: 'fov' is an array"),
        ({"sensor.fov": 200}, mlt.SceneError, "^sensor.fov: .*'fov'"),
        ({"sensor.to_world": np.eye(3)}, mlt.SceneError, "^sensor.to_world: .* 4 x 4 matrix"),
        ({"clay.reflectance": 2.0}, mlt.SceneError, "^clay.reflectance: .*reflectance"),
        ({"clay.reflectance": {"type": "bitmp"}}, mlt.SceneError, "clay.reflectance.*bitmap"),
        ({"mesh.vertices": VERTICES[:, :2]}, mlt.SceneError, "^mesh.vertices: .*\\(n, 3\\)"),
        ({"mesh.vertices": VERTICES * np.nan}, mlt.SceneError, "^mesh.vertices: .* not finite"),
        ({"mesh.vertices": VERTICES[:2]}, mlt.SceneError, "mesh"),
        ({"grain.data": "texels"}, mlt.SceneError, "^grain.data: .* needs numbers"),
    ],
)
def test_what_cannot_be_changed_is_named_in_one_line(edit, error, message):
    scene = mlt.load_dict(house())
    with pytest.raises(error, match=message) as caught:
        scene.updated(edit)
    assert "\n" not in str(caught.value)


def test_updated_needs_a_dict():
    with pytest.raises(TypeError):
        mlt.load_dict(tiny.scene()).updated(3)


def grid(n: int) -> dict:
    """A wavy square of 2 (n - 1)^2 triangles."""
    x, y = np.meshgrid(np.linspace(-1, 1, n), np.linspace(-1, 1, n))
    corner = np.arange(n * n).reshape(n, n)[:-1, :-1].ravel()
    return {
        "type": "mesh",
        "vertices": np.stack([x, 0.1 * np.sin(9 * x) * np.cos(7 * y), y], axis=-1).reshape(-1, 3),
        "faces": np.concatenate(
            [
                np.stack([corner, corner + n + 1, corner + 1], axis=1),
                np.stack([corner, corner + n, corner + n + 1], axis=1),
            ]
        ),
        "bsdf": {"type": "diffuse", "reflectance": 0.5},
    }


@pytest.mark.parametrize(
    "edits",
    [
        [{"sensor.to_world": T().translate(0, 1, 4 + 0.1 * i)} for i in range(8)],
        [{"land.bsdf.reflectance": 0.1 * i} for i in range(8)],
        [{"lamp.emitter.radiance": 1.0 * i} for i in range(8)],
    ],
    ids=["camera", "material", "light"],
)
def test_an_edit_without_motion_takes_less_than_five_milliseconds(edits):
    scene = mlt.load_dict(
        tiny.scene() | {"land": grid(439), "sky": {"type": "envmap", "data": SKY}}
    )
    assert scene.info()["triangles"] > 383_000
    seconds = []
    for edit in edits:
        start = time.perf_counter()
        scene.updated(edit)
        seconds.append(time.perf_counter() - start)
    assert min(seconds) < 0.005


MEMORY = """
import numpy as np, resource, test_editing, tiny
import pymlt as mlt

def resident():
    return int(open("/proc/self/statm").read().split()[1]) * resource.getpagesize() / 2**20

base = tiny.scene() | {"land": test_editing.grid(80), "sky": {"type": "envmap", "data": SKY}}
vertices = base["land"]["vertices"]

def work(edits, loads):
    scene = mlt.load_dict(base)
    for i in range(edits):
        edit = {"sensor.fov": 20 + i % 50, "land.bsdf.reflectance": i % 10 / 10, "sky.scale": i % 7}
        if i % 20 == 0:
            edit["land.vertices"] = vertices * (1 + i % 3)
        scene = scene.updated(edit)
    for i in range(loads):
        mlt.load_dict(base)

work(100, 20)
before = resident()
work(1000, 150)
print(before, resident())
""".replace("SKY", "np.ones((128, 256, 3), np.float32)")


def test_memory_returns_to_where_it_was():
    """One mesh that is not freed for each edit would be two gigabytes, one map 800 megabytes."""
    done = subprocess.run(
        [sys.executable, "-c", MEMORY],
        cwd=Path(__file__).parent,
        capture_output=True,
        text=True,
        check=True,
    )
    before, after = map(float, done.stdout.split())
    assert after < before + 16, f"{before:.0f} MB before, {after:.0f} MB after"
