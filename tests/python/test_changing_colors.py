"""Colours that change over time: closed forms, scene files, edits and shots."""

import pickle
import warnings

import numpy as np
import pytest
import tiny

import pymlt as mlt
from pymlt.formats.xml_writer import to_xml
from pymlt.rendering.frames import scene_at, stands_still, timing

FADING = {"type": "animation", "0": [0.2, 0.4, 0.8], "2": [0.8, 0.4, 0]}
GLOW = {"type": "animation", "0": {"type": "rgb", "value": [1, 1, 4]}, "2": 3.0}


def at(keys: tuple, t: np.ndarray) -> np.ndarray:
    """Linear from time 0 to 2."""
    first, last = np.asarray(keys[0], float), np.asarray(keys[1], float)
    share = np.clip(t / 2, 0, 1)[:, None]
    return first * (1 - share) + last * share


def furnace(reflectance, radiance) -> dict:
    """A camera inside of a ball that glows and reflects inwards."""
    return {
        "type": "scene",
        "sensor": {
            "type": "perspective",
            "fov": 60.0,
            "film": {"type": "hdrfilm", "width": 4, "height": 4, "rfilter": {"type": "box"}},
        },
        "ball": {
            "type": "sphere",
            "flip_normals": True,
            "bsdf": {"type": "diffuse", "reflectance": reflectance},
            "emitter": {"type": "area", "radiance": radiance},
        },
    }


def ball(reflectance, radiance) -> dict:
    """A ball under a sky that is the same everywhere, of which nothing else is seen."""
    scene = furnace(reflectance, radiance)
    scene["sky"] = {"type": "constant", "radiance": scene["ball"].pop("emitter")["radiance"]}
    scene["ball"]["flip_normals"] = False
    scene["sensor"]["fov"] = 10.0
    scene["sensor"]["to_world"] = mlt.Transform.look_at([0, 0, 5], [0, 0, 0], [0, 1, 0])
    return scene


def mean_light(open_: float, close: float, reflections: tuple) -> np.ndarray:
    """The mean of E rho^k over a shutter, summed over these k."""
    t = open_ + (close - open_) * (np.arange(10000) + 0.5) / 10000
    rho = at(([0.2, 0.4, 0.8], [0.8, 0.4, 0]), t)
    glow = at(([1, 1, 4], [3, 3, 3]), t)
    return sum(glow * rho**k for k in reflections).mean(axis=0)


def expect_light(images: list, expected: np.ndarray) -> None:
    """By 16 seeds; a right mean is as far away in one test of a thousand."""
    means = np.mean(images, axis=(1, 2))
    error = means.std(axis=0, ddof=1) / 4 + 1e-6 * expected
    assert np.all(np.abs(means.mean(axis=0) - expected) <= 4.5 * error)
    assert np.all(error <= 0.02 * expected)


SHUTTERS = pytest.mark.parametrize(("frame", "shutter"), [(1, 0.9), (1, 0), (3, 1)])


@pytest.mark.parametrize("algorithm", ["path", "bdpt", "ptracer"])
@SHUTTERS
def test_a_room_has_the_mean_of_its_colours(algorithm, frame, shutter):
    when = timing(1, shutter)
    scene = scene_at(mlt.load_dict(furnace(FADING, GLOW)), when, [frame])
    integrator = {"type": algorithm, "max_depth": 3}
    images = [mlt.render(scene, integrator, spp=256, seed=seed, threads=1) for seed in range(16)]
    expect_light(images, mean_light(*when.times(frame), (0, 1, 2)))


@pytest.mark.parametrize("algorithm", ["path", "bdpt", "pssmlt", "mlt"])
@SHUTTERS
def test_a_ball_has_the_mean_of_its_colours(algorithm, frame, shutter):
    when = timing(1, shutter)
    scene = scene_at(mlt.load_dict(ball(FADING, GLOW)), when, [frame])
    integrator = {"type": algorithm, "max_depth": 2}
    if "mlt" in algorithm:
        integrator |= {"luminance_samples": 1000, "chains": 16}
    images = [mlt.render(scene, integrator, spp=128, seed=seed, threads=1) for seed in range(16)]
    expect_light(images, mean_light(*when.times(frame), (1,)))


@pytest.mark.parametrize(
    ("lamp", "name"), [("point", "intensity"), ("spot", "intensity"), ("constant", "radiance")]
)
@pytest.mark.parametrize("algorithm", ["path", "bdpt"])
def test_lamps_have_the_mean_of_their_colours(algorithm, lamp, name):
    """The image is linear in the lamp's colour, which is (1 - t) a + t b."""
    T = mlt.Transform

    def image(value, **shutter) -> np.ndarray:
        scene = tiny.scene()
        del scene["ball"], scene["lamp"]
        scene["sensor"] |= shutter
        scene["lamp"] = {"type": lamp, name: value}
        if lamp != "constant":
            scene["lamp"]["to_world"] = T.look_at([0, 2, 0], [0, 0, 0.1], [0, 1, 0])
        integrator = {"type": algorithm, "max_depth": 2}
        return mlt.render(scene, integrator, spp=256, seed=3, threads=1).mean(axis=(0, 1))

    a, b = [2, 1, 0], [0, 1, 2]
    keys = {"type": "animation", "0": a, "1": b}
    whole = image(keys, shutter_open=0.0, shutter_close=1.0)
    assert whole == pytest.approx(image([1, 1, 1]), rel=0.05)
    early = image(keys, shutter_open=0.0, shutter_close=0.5)
    assert early == pytest.approx(image([1.5, 1, 0.5]), rel=0.05)
    instant = image(keys, shutter_open=0.25, shutter_close=0.25)
    assert instant == pytest.approx(image([1.5, 1, 0.5]), rel=1e-5)


def test_xml_means_the_same():
    xml = """<scene version="3.0.0"><sensor type="perspective"><float name="fov" value="60"/>
      <float name="shutter_close" value="1.5"/>
      <film type="hdrfilm"><integer name="width" value="4"/><integer name="height" value="4"/>
      <rfilter type="box"/></film></sensor>
      <shape type="sphere"><boolean name="flip_normals" value="true"/>
      <bsdf type="diffuse"><animation name="reflectance">
        <rgb time="0" value="0.2 0.4 0.8"/><rgb time="2" value="0.8 0.4 0"/></animation></bsdf>
      <emitter type="area"><animation name="radiance">
        <rgb time="0" value="1 1 4"/><float time="2" value="3"/></animation></emitter>
      </shape></scene>"""
    scene = furnace(FADING, GLOW)
    scene["sensor"]["shutter_close"] = 1.5
    expected = mlt.render(scene, "path", spp=16, seed=1)
    assert np.array_equal(mlt.render(mlt.load_string(xml), "path", spp=16, seed=1), expected)


def test_what_is_written_is_read_again(tmp_path):
    scene = furnace(FADING, GLOW)
    scene["sensor"]["shutter_close"] = 1.5
    scene["ball"]["bsdf"]["reflectance"] = FADING | {
        "3": {"type": "checkerboard", "color0": 0.1, "color1": 0.7}
    }
    loaded = mlt.load_dict(scene)
    expected = mlt.render(loaded, "path", spp=16, seed=1)
    written = mlt.load_string(to_xml(scene, tmp_path))
    packed = pickle.loads(pickle.dumps(loaded))
    for again in (written, packed):
        assert np.array_equal(mlt.render(again, "path", spp=16, seed=1), expected)
    assert packed.hash == loaded.hash


def test_keys_can_be_edited():
    scene = furnace(FADING, GLOW)
    scene["sensor"]["shutter_close"] = 1.5
    loaded = mlt.load_dict(scene)
    value = "ball.bsdf.reflectance.texture_1.value"
    assert loaded.parameters()[value] == (0.8, 0.4, 0)
    scene["ball"]["bsdf"]["reflectance"] = FADING | {"2": [0.5, 0.1, 0.1]}
    expected = mlt.render(scene, "path", spp=16, seed=1)
    edited = loaded.updated({value: [0.5, 0.1, 0.1]})
    whole = loaded.updated({"ball.bsdf.reflectance": scene["ball"]["bsdf"]["reflectance"]})
    for other in (edited, whole):
        assert np.array_equal(mlt.render(other, "path", spp=16, seed=1), expected)
    still = loaded.updated({"ball.bsdf.reflectance": 0.5, "ball.emitter.radiance": 1.0})
    assert still.animations() == []


def test_a_shot_of_changing_colours_does_not_stand_still():
    scene = mlt.load_dict(furnace(FADING, GLOW))
    assert scene.animations() == [(0, 2), (0, 2)]
    assert stands_still(scene, timing(1, 0.5), [1]) is None
    assert "animations go from 0 to 2 s" in stands_still(scene, timing(1, 0.5), [2, 3])


def test_a_texture_that_is_referred_to_is_no_animation():
    scene = tiny.scene()
    scene["chess"] = {"type": "checkerboard"}
    scene["clay"]["reflectance"] = {"type": "ref", "id": "chess"}
    assert "nothing in the scene" in stands_still(mlt.load_dict(scene), timing(1, 1), [1])


@pytest.mark.parametrize("together", [1, 2])
def test_frames_of_one_render_have_their_own_colours(tmp_path, together):
    integrator = {"type": "mlt", "max_depth": 2, "luminance_samples": 1000, "chains": 16}
    images = [
        [
            mlt.read_image(frame.files[0])
            for frame in mlt.render_shot(
                ball(FADING, GLOW), integrator, frames="0:1", fps=1, output=tmp_path / "#.exr",
                shutter=0.8, together=together, spp=64, seed=seed, threads=1,
            ).frames
        ]
        for seed in range(16)
    ]  # fmt: skip
    for frame in (0, 1):
        expect_light([both[frame] for both in images], mean_light(frame, frame + 0.8, (1,)))


@pytest.mark.parametrize(
    ("change", "message"),
    [
        ({"reflectance": FADING | {"1": [0, 2, 0]}}, "'reflectance' reaches 2.0"),
        ({"reflectance": FADING | {"1": [0, -1, 0]}}, "'value' must not be negative"),
        ({"reflectance": {"type": "animation", "0": 0.5}}, "has 1 key, but needs two"),
        ({"reflectance": FADING | {"1": "red"}}, "'value' is a string"),
        ({"reflectance": FADING | {"1": np.eye(4)}}, "'value' is a matrix"),
        ({"reflectance": FADING | {"soon": 0.5}}, "the key 'soon', which is not a time"),
        ({"type": "dielectric", "int_ior": FADING}, "bsdf 'dielectric': 'int_ior' cannot change"),
        ({"type": "plastic", "nonlinear": FADING}, "bsdf 'plastic': 'nonlinear' cannot change"),
        ({"type": "diffuse", "colour": FADING}, "unknown parameter 'colour'"),
    ],
)
def test_what_cannot_change_is_refused(change, message):
    scene = furnace(0.5, 1.0)
    scene["ball"]["bsdf"] |= change
    if change.get("type", "diffuse") != "diffuse":
        del scene["ball"]["bsdf"]["reflectance"]
    with pytest.raises(mlt.SceneError, match=message):
        mlt.load_dict(scene)


@pytest.mark.parametrize(
    ("lamp", "message"),
    [
        ({"type": "envmap", "scale": GLOW}, "emitter 'envmap': 'scale' cannot change over time"),
        ({"type": "sun", "scale": GLOW}, "emitter 'sun': 'scale' cannot change over time"),
        (
            {"type": "point", "intensity": GLOW | {"3": {"type": "checkerboard"}}},
            "emitter 'point': 'intensity' should have no textures at its keys",
        ),
        (
            {"type": "point", "intensity": {"type": "checkerboard"}},
            r"should be a radiance \(number, rgb or spectrum\) or animation",
        ),
    ],
)
def test_lamps_that_cannot_change_say_so(lamp, message):
    with warnings.catch_warnings(), pytest.raises(mlt.SceneError, match=message):
        mlt.load_dict(tiny.scene() | {"other": lamp})
