"""Scenes with several sensors, and the one that is named."""

import re

import numpy as np
import pytest
import tiny
from command_line import PYMLT, mlt_render, run, the_error

import pymlt as mlt

ONE = re.search(r"<sensor.*</sensor>", tiny.XML, re.DOTALL)[0]
# The second looks from the side, at an image of another size.
OTHER = ONE.replace('origin="0, 1, 4"', 'origin="4, 1, 0"').replace('"12"', '"20"')
TWO = tiny.XML.replace(ONE, ONE + OTHER)
ALONE = tiny.XML.replace(ONE, OTHER)


def rendered(scene, **options) -> np.ndarray:
    return mlt.render(scene, "path", spp=2, seed=1, **options)


def test_one_of_several_sensors_is_named():
    side = rendered(mlt.load_string(ALONE))
    assert side.shape == (20, 16, 3)
    np.testing.assert_array_equal(rendered(mlt.load_string(TWO, sensor=1)), side)
    scene = mlt.load_string(TWO)
    assert "this scene has 2 sensors" in scene.warnings[0]
    np.testing.assert_array_equal(rendered(scene, sensor=1), side)
    np.testing.assert_array_equal(rendered(scene.with_sensor(1), sensor=0), rendered(tiny.scene()))
    assert mlt.load_string(TWO, sensor=1).hash != mlt.load_string(TWO, sensor=0).hash


def test_a_dict_may_have_several_sensors():
    scene = tiny.scene()
    scene["other"] = scene["sensor"] | {
        "to_world": mlt.Transform.look_at(origin=[4, 1, 0], target=[0, 0.5, 0], up=[0, 1, 0])
    }
    image = rendered(scene, sensor=1)
    assert image.shape == (12, 16, 3)
    assert not np.array_equal(image, rendered(scene, sensor=0))


FILM = re.search(r"<film.*</film>", ONE, re.DOTALL)[0]


def batch(film: str, inside: str = ONE + OTHER) -> str:
    """A scene whose sensors share this film."""
    return tiny.XML.replace(ONE, f'<sensor type="batch">{inside}{film}</sensor>')


def test_the_sensors_of_a_batch_share_its_film():
    wide = FILM.replace('"$res"', '"32"')
    scene = mlt.load_string(batch(wide))
    assert scene.info()["sensors"] == 2
    side = mlt.load_string(ALONE.replace('"20"', '"12"'))
    np.testing.assert_array_equal(rendered(scene, sensor=0), rendered(tiny.scene()))
    np.testing.assert_array_equal(rendered(scene, sensor=1), rendered(side))
    named = batch('<ref id="shared"/>').replace(
        "<sensor", wide.replace("<film", '<film id="shared"') + "<sensor", 1
    )
    np.testing.assert_array_equal(rendered(mlt.load_string(named), sensor=1), rendered(side))


def test_a_batch_may_be_a_dict():
    scene = tiny.scene()
    film = scene["sensor"].pop("film")
    scene["sensor"] = {
        "type": "batch",
        "film": film | {"width": 48},
        **{f"view_{i}": scene["sensor"] for i in range(3)},
    }
    loaded = mlt.load_dict(scene)
    images = [rendered(loaded, sensor=i) for i in range(loaded.info()["sensors"])]
    assert np.concatenate(images, axis=1).shape == (12, 48, 3)
    np.testing.assert_array_equal(images[2], rendered(tiny.scene()))


@pytest.mark.parametrize(
    ("scene", "said"),
    [
        (batch(FILM.replace('"$res"', '"31"')), "31 pixels wide.*2 sensors.*multiple of 2"),
        (batch(FILM, ""), "has no sensors inside"),
        (batch(FILM, f'<sensor type="batch">{ONE}</sensor>'), "at the top of the scene"),
    ],
)
def test_a_batch_that_cannot_be_shared_is_an_error(scene, said):
    with pytest.raises(mlt.SceneError, match=said):
        mlt.load_string(scene)


@pytest.mark.parametrize("sensor", [2, -1])
def test_a_sensor_that_is_not_there_is_an_error(sensor):
    with pytest.raises(
        mlt.UsageError, match=f"there is no sensor {sensor}: the scene's are 0 to 1"
    ):
        mlt.load_string(TWO, sensor=sensor)
    with pytest.raises(mlt.UsageError, match="there is no sensor"):
        rendered(mlt.load_string(TWO), sensor=sensor)


@pytest.mark.parametrize("sensor", ["1", 1.5, True])
def test_a_sensor_is_an_integer(sensor):
    with pytest.raises(mlt.UsageError, match="should be the number of a sensor"):
        mlt.load_string(TWO, sensor=sensor)


def test_a_checkpoint_knows_its_sensor(tmp_path):
    file, checkpoint = tmp_path / "scene.xml", tmp_path / "state"
    file.write_text(TWO)
    whole = rendered(file, sensor=1)
    mlt.start(file, "path", spp=1, seed=1, sensor=1, checkpoint=checkpoint).wait()
    np.testing.assert_array_equal(mlt.resume(checkpoint, spp=2).result().image, whole)
    with pytest.raises(mlt.SceneError):
        mlt.resume(checkpoint, scene=mlt.load_file(file, sensor=0))


@pytest.mark.parametrize("program", [[*PYMLT, "render"], mlt_render()], ids=["pymlt", "mlt-render"])
def test_both_programs_take_a_sensor(program, tmp_path):
    if not program:
        pytest.skip("mlt-render is not installed beside this Python")
    file, out = tmp_path / "scene.xml", tmp_path / "image.exr"
    file.write_text(TWO)
    settings = ["--spp", 2, "--seed", 1, "--integrator", "path", "-o", out]
    assert run(program, file, *settings, "--sensor", 1, "--quiet").returncode == 0
    image = mlt.read_image(out)
    np.testing.assert_allclose(image, rendered(file, sensor=1), rtol=2e-3)
    assert "there is no sensor 2" in the_error(run(program, file, *settings, "--sensor", 2))
    assert "integer" in the_error(run(program, file, *settings, "--sensor", "front"))
