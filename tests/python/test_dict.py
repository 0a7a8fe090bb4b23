"""The Mitsuba dict: the same scenes as XML, and errors that name the place in the dict."""

import pickle
import re

import numpy as np
import pytest
import tiny

import pymlt as mlt


def pixels(scene, *, spp=4, **settings):
    return mlt.render(scene, spp=spp, seed=7, **settings)


def test_a_dict_and_the_same_xml_give_the_same_pixels():
    from_dict = mlt.load_dict(tiny.scene())
    from_xml = mlt.load_string(tiny.XML)
    assert np.array_equal(pixels(from_dict), pixels(from_xml))
    assert pixels(from_dict).std() > 0.01  # there is something to see


@pytest.mark.parametrize(
    "form",
    [
        lambda m: m.tolist(),
        lambda m: m,
        lambda m: m.astype(np.float64, order="F"),
        lambda m: tuple(map(tuple, m)),
        mlt.Transform,
    ],
    ids=["lists", "array", "fortran", "tuples", "Transform"],
)
def test_a_transform_may_be_written_in_many_forms(form):
    expected, scene = tiny.scene(), tiny.scene()
    scene["floor"]["to_world"] = form(scene["floor"]["to_world"].matrix)
    assert np.array_equal(pixels(scene), pixels(expected))


def test_numbers_may_come_from_numpy():
    scene = tiny.scene()
    scene["sensor"]["fov"] = np.float32(40)
    scene["sensor"]["film"]["width"] = np.int16(16)
    scene["ball"]["center"] = np.array([0, 0.6, 0])
    scene["lamp"]["emitter"]["radiance"]["value"] = np.array([5, 6, 7])
    assert np.array_equal(pixels(scene), pixels(tiny.scene()))


def test_older_names_and_integrator_objects_are_accepted():
    scene = tiny.scene()
    scene["sensor"]["toWorld"] = scene["sensor"].pop("to_world")
    scene["integrator"] = mlt.Path(max_depth=4)
    assert np.array_equal(pixels(scene), pixels(tiny.scene()))


def test_an_srgb_colour_is_linear_as_in_mitsuba():
    scene = tiny.scene()
    scene["clay"]["reflectance"] = {"type": "srgb", "color": [0.7, 0.4, 0.2]}
    assert np.array_equal(pixels(mlt.load_dict(scene)), pixels(mlt.load_dict(tiny.scene())))
    scene["clay"]["reflectance"] = {"type": "srgb", "value": [0.7, 0.4, 0.2]}
    with pytest.raises(mlt.SceneError, match="unknown 'value'; valid are: type, color"):
        mlt.load_dict(scene)


def test_uniform_spectra_are_numbers():
    grey, uniform, flat = tiny.scene(), tiny.scene(), tiny.scene()
    grey["clay"]["reflectance"] = 0.25
    uniform["clay"]["reflectance"] = {"type": "uniform", "value": 0.25}
    flat["clay"]["reflectance"] = {"type": "spectrum", "value": 0.25}
    assert np.array_equal(pixels(uniform), pixels(grey))
    assert np.array_equal(pixels(flat), pixels(grey))


def test_the_flat_spectrum_of_a_light_is_not_grey_but_the_uniform_one_is():
    flat, table, uniform, grey = (tiny.scene() for _ in range(4))
    flat["lamp"]["emitter"]["radiance"] = {"type": "spectrum", "value": 3}
    table["lamp"]["emitter"]["radiance"] = {"type": "spectrum", "value": [(360, 3), (830, 3)]}
    uniform["lamp"]["emitter"]["radiance"] = {"type": "uniform", "value": 3}
    grey["lamp"]["emitter"]["radiance"] = {"type": "rgb", "value": 3}
    assert np.allclose(pixels(flat), pixels(table), rtol=1e-3)
    assert np.array_equal(pixels(uniform), pixels(grey))
    assert not np.allclose(pixels(flat), pixels(grey), rtol=0.05)


def lit_by(radiance, reflectance=0.25):
    scene = tiny.scene()
    scene["lamp"]["emitter"]["radiance"] = radiance
    scene["clay"]["reflectance"] = reflectance
    return scene


def both_kinds(scene, spp=4):
    """The pixels of an RGB and of a spectral scene."""
    return [pixels(scene, spp=spp, spectral=spectral) for spectral in (False, True)]


WAVES, VALUES = [400, 550, 700], [0.2, 0.5, 0.7]
TABLE = {"type": "spectrum", "value": list(zip(WAVES, VALUES, strict=True))}
SPECTRA = {
    "irregular": ({"wavelengths": WAVES, "values": VALUES}, TABLE),
    "regular": ({"wavelength_min": 400, "wavelength_max": 700, "values": np.array(VALUES)}, TABLE),
    "srgb": ({"color": [0.7, 0.4, 0.2]}, {"type": "rgb", "value": [0.7, 0.4, 0.2]}),
    "d65": ({"scale": 0.5}, {"type": "rgb", "value": 0.5}),
}


@pytest.mark.parametrize("name", SPECTRA)
def test_spectra_are_plugins(name):
    given, value = SPECTRA[name]
    plugin = {"type": name} | given
    for made, same in zip(both_kinds(lit_by(plugin)), both_kinds(lit_by(value)), strict=True):
        np.testing.assert_allclose(made, same, rtol=1e-12)
    if name != "d65":
        assert np.array_equal(pixels(lit_by(3, plugin)), pixels(lit_by(3, value)))


@pytest.mark.parametrize("name", [*SPECTRA, "uniform"])
def test_spectra_are_converted_to_xml(name, tmp_path):
    given = SPECTRA[name][0] if name in SPECTRA else {"value": 0.5, "wavelength_max": 600}
    scene = lit_by({"type": name} | given, {"type": "ref", "id": "paint"})
    scene["paint"] = {"type": "regular", "values": VALUES}
    mlt.convert(scene, tmp_path / "a.xml")
    for spectral in (False, True):
        made = mlt.load(tmp_path / "a.xml", spectral=spectral)
        np.testing.assert_array_equal(pixels(made), pixels(scene, spectral=spectral))


def test_a_black_body_has_the_same_colour_with_and_without_wavelengths():
    lamp = {"type": "blackbody", "temperature": 3500, "scale": 1e-4}
    rgb, spectral = (image.mean(axis=(0, 1)) for image in both_kinds(lit_by(lamp), spp=256))
    assert rgb[0] > 2 * rgb[2] > 0
    assert spectral == pytest.approx(rgb, rel=0.05)


def test_spectra_are_referred_to():
    scene = lit_by(3, {"type": "ref", "id": "paint"})
    scene["paint"] = {"type": "rgb", "value": [0.7, 0.4, 0.2]}
    same = pixels(lit_by(3, {"type": "rgb", "value": [0.7, 0.4, 0.2]}))
    assert np.array_equal(pixels(scene), same)


@pytest.mark.parametrize(
    ("plugin", "message"),
    [
        ({"type": "irregular", "wavelengths": WAVES, "values": [1, "x"]}, "'values'"),
        ({"type": "irregular", "wavelengths": WAVES, "values": [1, 2]}, "has 2 numbers"),
        ({"type": "regular", "values": []}, "has 0 numbers"),
        ({"type": "blackbody", "temperature": -1}, "'temperature' is -1 K"),
        ({"type": "blackbody"}, "needs 'temperature'"),
    ],
)
def test_wrong_spectra_are_named(plugin, message):
    with pytest.raises(mlt.SceneError, match=r"scene\['lamp'\].*" + message):
        mlt.load_dict(lit_by(plugin))


def test_file_names_are_relative_to_the_current_directory(tmp_path, monkeypatch):
    mlt.write_image(tmp_path / "grey.exr", np.full((2, 2, 3), 0.25))
    monkeypatch.chdir(tmp_path)
    textured, plain = tiny.scene(), tiny.scene()
    textured["clay"]["reflectance"] = {"type": "bitmap", "filename": "grey.exr"}
    plain["clay"]["reflectance"] = 0.25
    assert np.allclose(pixels(textured), pixels(plain), rtol=1e-5)


def test_the_dict_is_not_changed():
    scene = tiny.scene()
    before = repr(scene)
    mlt.load_dict(scene)
    assert repr(scene) == before


def change(path, **values):
    """A function that updates the dict at a path of keys."""

    def apply(scene):
        for key in path:
            scene = scene[key]
        scene.update(values)

    return apply


FILM = ("sensor", "film")
MISTAKES = {
    "misspelt parameter": (change(FILM, widht=3), "scene['sensor']['film']: ", "'width'"),
    "wrong type": (change(FILM, width="3"), "scene['sensor']['film']: ", "'width' is a string"),
    "None": (change(FILM, width=None), "scene['sensor']['film']: ", "'width' is None"),
    "not a value": (change(FILM, width=object()), "scene['sensor']['film']: ", "of type object"),
    "huge integer": (change(FILM, width=10**30), "scene['sensor']['film']: ", "64 bits"),
    "wrong shape": (change(["lamp"], to_world=np.eye(3)), "scene['lamp']: ", "4 x 4"),
    "singular": (change(["lamp"], to_world=np.zeros((4, 4))), "scene['lamp']: ", "singular"),
    "nan": (change(["ball"], radius=float("nan")), "scene['ball']: ", "finite"),
    "misspelt plug-in": (
        change(["ball"], bsdf={"type": "dielctric"}),
        "scene['ball']['bsdf']: ",
        "'dielectric'",
    ),
    "unknown type": (change([], x={"type": "sphre"}), "scene['x']: ", "'sphere'"),
    "no type": (change([], x={}), "scene['x']: ", "needs a 'type'"),
    "type is a number": (change([], x={"type": 3}), "scene['x']: ", "'type' is of type int"),
    "refused": (change([], x={"type": "sggx"}), "scene['x']: ", "sggx"),
    "dangling reference": (
        change(["ball"], bsdf={"type": "ref", "id": "clya"}),
        "scene['ball']['bsdf']: ",
        "'clay'",
    ),
    "reference to nothing": (change(["ball"], bsdf={"type": "ref"}), "scene['ball']", "'id'"),
    "two numbers for rgb": (
        change(["clay"], reflectance={"type": "rgb", "value": [1, 2]}),
        "scene['clay']: ",
        "'reflectance'",
    ),
    "rgb without value": (
        change(["clay"], reflectance={"type": "rgb"}),
        "scene['clay']",
        "'value'",
    ),
    "rgb with more": (
        change(["clay"], reflectance={"type": "rgb", "value": [1, 1, 1], "scale": 2}),
        "scene['clay']",
        "'scale'",
    ),
    "bad spectrum": (
        change(["clay"], reflectance={"type": "spectrum", "value": [1, 2, 3]}),
        "scene['clay']",
        "pairs",
    ),
    "number in a scene": (change([], x=3), "scene: ", "'x'"),
    "key is a number": (lambda s: s.update({3: 4}), "scene: ", "of type int"),
    "lone surrogate": (
        change(FILM, pixel_format="\ud800"),
        "scene['sensor']['film']: ",
        "surrogate",
    ),
    "surrogate in a key": (lambda s: s.update({"a\ud800": {}}), "scene: ", "surrogate"),
    "surrogate in a type": (change(["ball"], type="\ud800"), "scene['ball']: ", "surrogate"),
    "integrator": (
        change(["integrator"], max_dpeth=3),
        "scene['integrator']: ",
        "did you mean 'max_depth'?",
    ),
    "unknown integrator": (change(["integrator"], type="pssmtl"), "scene", "'pssmlt'"),
    "integrator that does nothing": (
        change([], integrator={"type": "direct", "emitter_samples": 0, "bsdf_samples": 0}),
        "scene['integrator']: ",
        "needs at least one",
    ),
    "not a scene": (change([], type="scne"), "scene: ", "'scene'"),
    "no sensor": (lambda s: s.pop("sensor"), "scene: ", "sensor"),
}


@pytest.mark.parametrize(("mistake", "where", "what"), MISTAKES.values(), ids=MISTAKES.keys())
def test_a_mistake_is_named_with_its_place(mistake, where, what):
    scene = tiny.scene()
    mistake(scene)
    with pytest.raises(mlt.SceneError) as error:
        mlt.load_dict(scene)
    assert str(error.value).startswith(where)
    assert what in str(error.value)
    assert "\n" not in str(error.value)


def test_a_missing_file_is_a_file_error():
    scene = tiny.scene()
    scene["clay"]["reflectance"] = {"type": "bitmap", "filename": "nowhere.png"}
    with pytest.raises(mlt.FileError, match=r"scene\['clay'\]\['reflectance'\]: .*nowhere.png"):
        mlt.load_dict(scene)


def test_a_dict_that_contains_itself_is_refused():
    scene = tiny.scene()
    scene["clay"]["again"] = scene["clay"]
    with pytest.raises(mlt.SceneError, match="too deeply"):
        mlt.load_dict(scene)


def test_dicts_that_are_nested_deeply_are_refused_in_a_short_line():
    scene = tiny.scene()
    inner = scene["ball"]["bsdf"]
    for _ in range(3000):
        inner = {"type": "twosided", "bsdf": inner}
    scene["ball"]["bsdf"] = inner
    with pytest.raises(mlt.SceneError, match="too deeply") as error:
        mlt.load_dict(scene)
    assert len(str(error.value)) < 400
    for nested in [], (), {}:
        for _ in range(3000):
            nested = [nested]
        scene["ball"]["bsdf"] = nested
        with pytest.raises(mlt.SceneError) as error:
            mlt.load_dict(scene)
        assert len(str(error.value)) < 400


def test_something_else_than_a_dict_is_refused():
    with pytest.raises(mlt.UsageError, match="needs a dict, not a list"):
        mlt.load_dict([])


@pytest.mark.peer
def test_mitsubas_own_cornell_box_loads_and_is_ours():
    import mitsuba

    mitsuba.set_variant("scalar_rgb")
    theirs = mlt.load_dict(mitsuba.cornell_box(), size=(24, 24))
    ours = mlt.load_dict(mlt.scenes.cornell_box(), size=(24, 24))
    a, b = (mlt.render(s, spp=16, seed=1) for s in (theirs, ours))
    # Their matrices are in single precision, so a few rays may differ.
    assert np.isclose(a, b, rtol=1e-3).mean() > 0.98


def test_an_animation_is_a_dict_of_times():
    moved = mlt.Transform.translate((0, 0.5, 0))

    def scene(**keys):
        tree = tiny.scene()
        tree["sensor"]["shutter_close"] = 1
        tree["ball"]["to_world"] = {"type": "animation", **keys}
        return tree

    from_dict = mlt.load_dict(scene(**{"0": mlt.Transform(), "1": moved.matrix.tolist()}))
    numbers = scene()
    numbers["ball"]["to_world"] |= {1.0: moved, 0: np.eye(4)}
    assert np.array_equal(pixels(from_dict), pixels(numbers))
    still = tiny.scene()
    still["sensor"]["shutter_close"] = 1
    assert not np.array_equal(pixels(from_dict), pixels(still))
    assert np.array_equal(pixels(scene(**{"0": mlt.Transform(), "2": mlt.Transform()})),
                          pixels(still))  # fmt: skip
    assert np.array_equal(pixels(pickle.loads(pickle.dumps(from_dict))), pixels(from_dict))


@pytest.mark.parametrize(
    ("keys", "message"),
    [
        ({"0": np.eye(4)}, "shape 'sphere': 'to_world' has 1 transform, but"),
        ({"0": np.eye(4), "soon": np.eye(4)}, "'to_world' has the key 'soon', which is not a time"),
        ({"0": np.eye(4), "1": [1, 2, 3]}, "'to_world' should have a 4 x 4 matrix at each time"),
        (
            {"0": np.eye(4), "1": np.diag([1, 0, 1, 1])},
            "is singular or has a perspective at time 1",
        ),
        ({"0": np.eye(4), 0: np.eye(4)}, "times must increase"),
    ],
)
def test_an_animation_that_is_wrong_is_refused(keys, message):
    tree = tiny.scene()
    tree["ball"]["to_world"] = {"type": "animation"} | keys
    with pytest.raises(mlt.SceneError, match=re.escape(message)):
        mlt.load_dict(tree)


def test_a_negative_index_of_a_metal_is_taken_without_its_sign():
    metal = '<bsdf type="conductor" id="clay">\n<rgb name="eta" value="{}0.04, 0.9, 1.2"/></bsdf>'
    clay = '<bsdf type="diffuse" id="clay"><rgb name="reflectance" value="0.7, 0.4, 0.2"/></bsdf>'
    assert clay in tiny.XML
    scenes = [mlt.load_string(tiny.XML.replace(clay, metal.format(sign))) for sign in ("-", "")]
    line = tiny.XML[: tiny.XML.index(clay)].count("\n") + 1
    (warning,) = scenes[0].warnings
    assert warning.startswith(f"<string>:{line}: bsdf 'conductor': 'eta' is negative")
    assert np.array_equal(pixels(scenes[0]), pixels(scenes[1]))
