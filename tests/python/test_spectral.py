"""Light with wavelengths: the same images as in RGB where nothing differs, and Mitsuba's."""

import numpy as np
import pytest
import tiny
from same_image import assert_same_image, visible_beside
from test_stored_references import COATING, FILES, NOISY, TO_XYZ, load, xyz_reference

import pymlt as mlt

V = mlt.Transform


def room(**changes) -> dict:
    """A grey floor and a ball in white light, seen from above."""
    scene = {
        "type": "scene",
        "sensor": {
            "type": "perspective",
            "fov": 40,
            "to_world": V().look_at([0, -4, 3], [0, 0, 0.3], [0, 0, 1]),
            "film": {"type": "hdrfilm", "width": 16, "height": 12, "rfilter": {"type": "box"}},
        },
        "floor": {
            "type": "rectangle",
            "to_world": V().scale([3, 3, 1]),
            "bsdf": {"type": "diffuse", "reflectance": 0.6},
        },
        "ball": {
            "type": "sphere",
            "center": [0, 0, 0.8],
            "radius": 0.6,
            "bsdf": {"type": "dielectric", "int_ior": 1.5},
        },
        "light": {"type": "constant", "radiance": 1.0},
    }
    return scene | changes


GLASS = {"type": "dielectric", "int_ior": "cauchy 1.35 60000"}


@pytest.mark.parametrize("colour", [(1, 1, 1), (0.2, 0.5, 1)])
def test_a_sky_is_as_bright_as_its_colour_says(colour):
    sky = {"type": "constant", "radiance": {"type": "rgb", "value": list(colour)}}
    scene = room(light=sky)
    scene["sensor"]["to_world"] = V().look_at([0, 0, 3], [0, 0, 4], [0, 1, 0])
    image = mlt.render(scene, "path", spp=1024, spectral=True)
    assert image.mean(axis=(0, 1)) == pytest.approx(colour, rel=3e-4)


def dispersive() -> dict:
    scene = room()
    scene["ball"] = scene["ball"] | {"bsdf": GLASS}
    return scene


def relative(image, reference):
    return image.mean((0, 1)) / reference.mean((0, 1)) - 1


def test_grey_scenes_are_those_in_rgb():
    rgb = mlt.render(room(), mlt.Path(max_depth=8), spp=2048)
    spectral = mlt.render(room(), mlt.Path(max_depth=8), spp=2048, spectral=True)
    assert np.abs(relative(spectral, rgb)).max() < 0.004


def test_colours_are_those_in_rgb_after_one_reflection():
    """24 colours as a texture, under a white sky: within the error of the table of spectra."""
    colours = np.random.default_rng(1).random((4, 6, 3)).astype(np.float32)
    scene = room()
    scene["sensor"]["to_world"] = V().look_at([0, 0, 3], [0, 0, 0], [0, 1, 0])
    scene["sensor"]["film"] = {
        "type": "hdrfilm",
        "width": 6,
        "height": 4,
        "rfilter": {"type": "box"},
    }
    texture = {"type": "bitmap", "data": colours, "raw": True, "filter_type": "nearest"}
    scene["floor"]["bsdf"]["reflectance"] = texture
    del scene["ball"]
    images = [
        mlt.render(scene, mlt.Direct(), spp=65536, seed=1, spectral=spectral)
        for spectral in (False, True)
    ]
    assert np.abs(images[1] - images[0]).max() < 0.006


@pytest.mark.parametrize("integrator", [mlt.Path, mlt.BDPT, mlt.MLT, mlt.PSSMLT, mlt.MMLT])
def test_the_bits_are_those_of_any_number_of_threads(integrator):
    images = [
        mlt.render(dispersive(), integrator(max_depth=6), spp=8, seed=3, threads=n, spectral=True)
        for n in (1, 2)
    ]
    np.testing.assert_array_equal(*images)
    assert images[0].mean() > 0


def test_a_checkpoint_goes_on_with_the_same_bits(tmp_path):
    path = tmp_path / "render.ckpt"
    scene = mlt.load(tiny.of_cpp("prism"))
    algorithm = mlt.MLT(max_depth=6)
    mlt.render(scene, algorithm, spp=8, seed=2, checkpoint=path)
    resumed = mlt.resume(path, spp=16).result().image
    np.testing.assert_array_equal(resumed, mlt.render(scene, algorithm, spp=16, seed=2))


def test_a_checkpoint_knows_what_was_asked_for(tmp_path):
    path = tmp_path / "render.ckpt"
    scene = mlt.load(tiny.of_cpp("caustic"), spectral=True)
    mlt.render(scene, mlt.Path(max_depth=4), spp=4, checkpoint=path)
    resumed = mlt.resume(path, spp=8).result().image
    np.testing.assert_array_equal(resumed, mlt.render(scene, mlt.Path(max_depth=4), spp=8))


def test_a_replayed_sample_is_the_sum_of_its_paths():
    found = 0
    for sample in range(20):
        replay = mlt.replay(
            dispersive(), mlt.BDPT(max_depth=5), pixel=(8, 6), sample=sample, spectral=True
        )
        seen = [path.estimate for path in replay.paths if path.technique[1] >= 2]
        if seen:
            np.testing.assert_allclose(sum(seen), replay.radiance, rtol=1e-6, atol=1e-9)
            found += 1
    assert found > 5


def test_paths_keep_their_wavelength_in_python():
    scene = mlt.load_dict(dispersive())
    spectral = scene.with_wavelengths()
    for seed in range(5):
        path = spectral.sample_path(seed=seed, max_depth=6)
        value = path.contribution()
        np.testing.assert_array_equal(path.with_vertices(path[:]).contribution(), value)
        # what it brought to the image has the colour of its contribution
        np.testing.assert_allclose(
            path.estimate / np.abs(path.estimate).max(), value / np.abs(value).max(), atol=1e-9
        )


def test_python_knows_the_wavelengths_of_a_path():
    scene = mlt.load_dict(dispersive())
    assert scene.sample_path(seed=1).wavelengths is None
    assert not any(scene.sample_path(seed=seed, max_depth=6).dispersed for seed in range(50))
    spectral = scene.with_wavelengths()
    paths = [spectral.sample_path(seed=seed, max_depth=6) for seed in range(200)]
    waves = np.array([path.wavelengths for path in paths])
    assert waves.shape == (200, 4)
    # One in each quarter of the density, whose borders are these.
    at = np.array([-178.0, 0, 292]) * 0.0072
    below, above = np.tanh(at[0]), np.tanh(at[2])
    middle = 538 + np.arctanh(below + np.array([0.25, 0.5, 0.75]) * (above - below)) / 0.0072
    assert (np.sort(np.searchsorted(middle, waves)) == np.arange(4)).all()
    # The glass of the ball is dispersive, and the floor is not.
    for path in paths:
        through = (path.vertices["lobe"] == "transmission").any()
        assert path.dispersed == through
    assert len({path.dispersed for path in paths}) == 2


def test_layers_are_those_in_rgb():
    scene = mlt.load_dict(room())
    spectral = scene.with_wavelengths()
    assert spectral.info()["spectral"]
    assert not scene.info()["spectral"]
    layers = [
        mlt.start(s, mlt.Path(max_depth=2), spp=2, aovs=["albedo"]).result().layers["albedo"]
        for s in (scene, spectral)
    ]
    np.testing.assert_array_equal(*layers)


@pytest.mark.parametrize(
    ("ior", "message"),
    [
        ("cauchy 1.5 -1e9", "is no index of refraction"),
        ("abbe 1.5 -3", "is no index of refraction"),
        ("sellmeier 1 0.25", "is no index of refraction"),
        ("cauchy 1.5", "names no known material"),
        ("flint", "names no known material"),
        (-1.5, "must be positive"),
    ],
)
def test_indices_that_make_no_sense_are_refused(ior, message):
    scene = room()
    scene["ball"] = scene["ball"] | {"bsdf": {"type": "dielectric", "int_ior": ior}}
    with pytest.raises(mlt.SceneError, match=message):
        mlt.load_dict(scene)


@pytest.mark.long
@pytest.mark.parametrize("integrator", [mlt.BDPT, mlt.MLT, mlt.MMLT, mlt.PSSMLT])
@pytest.mark.parametrize("scene", ["spectral_room", "prism", "frosted_prism", "spectral_fog"])
def test_all_algorithms_show_the_same(scene, integrator):
    loaded = mlt.load_file(tiny.of_cpp(scene))

    def image(algorithm, spp, seed):
        return mlt.render(loaded, algorithm, spp=spp, seed=seed).astype(float).mean((0, 1))

    a = np.array([image(mlt.Path(max_depth=8), 2048, seed) for seed in range(16)])
    b = np.array([image(integrator(max_depth=8), 2048, 100 + seed) for seed in range(16)])
    error = np.sqrt((a.var(0, ddof=1) + b.var(0, ddof=1)) / 16)
    assert np.all(np.abs(a.mean(0) - b.mean(0)) < 4.5 * error + 0.003 * a.mean(0))


# Known differences in spectral mode: Mitsuba interpolates the coefficients of spectra between
# texels, we interpolate the colours, as in RGB; so edges in images differ, and environments by half
# a percent. Images of projectors and spots have the white of equal energy there, that of D65 here;
# and bk7 is a constant there, Schott's glass here.
BLOCKS_12 = ((1, 1), (3, 4))
SYSTEMATIC = {"test_roughplastic_linear_path": COATING, "test_roughplastic_nonlinear_path": COATING}
OTHER = {"test_projector_textured_direct", "test_spot_direct", "test_roughdielectric_path"}
NONE = {"test_instancing_path", "test_texture_interp_direct"}


@pytest.mark.long
@pytest.mark.shared
@pytest.mark.parametrize("file", [file for file in FILES if file not in OTHER | NONE])
def test_mitsubas_spectral_references(file, shared):
    folder_name, reference, integrator = FILES[file]
    folder = shared / "scenes" / "mitsuba-tests" / "tests" / "scenes" / folder_name
    scene = load(folder / f"{file}.xml").with_wavelengths()

    def render(spp, seed):
        return mlt.render(scene, integrator, spp=spp, seed=seed) @ TO_XYZ.T

    known = xyz_reference(folder, reference, "spectral").at(BLOCKS_12)
    assert_same_image(
        render,
        known,
        whole_image=0.025 + 1.5 * visible_beside(known),
        spp=256 if file in NOISY else 128,
        runs=32,
        scales=BLOCKS_12,
        systematic=max(0.01, SYSTEMATIC.get(file, 0)),
    )
