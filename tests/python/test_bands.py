"""Bands of wavelengths: what a spectral scene shows in each, as layers of an image."""

import numpy as np
import pytest
import tiny
from command_line import PYMLT, run, the_error
from test_spectral import dispersive, room

import pymlt as mlt
from pymlt.images import layer_names
from pymlt.rendering.bands import parse_bands, share_of_time

V = mlt.Transform


def spectrum(*pairs) -> dict:
    waves, values = (",".join(map(str, column)) for column in zip(*pairs, strict=True))
    return {"type": "irregular", "wavelengths": waves, "values": values}


def sky(radiance: dict) -> dict:
    """Nothing but a sky."""
    return {key: room()[key] for key in ("type", "sensor")} | {
        "light": {"type": "constant", "radiance": radiance}
    }


def spectral_layers(result: mlt.Result) -> dict[str, np.ndarray]:
    return {k: v for k, v in result.layers.items() if k.startswith("spectrum.")}


def test_bands_are_the_means_of_a_spectrum():
    """A spectrum that is linear between 400 and 500 nm, and constant above."""
    light = sky(spectrum((400, 1), (500, 3), (830, 3)))
    result = mlt.render_bands(light, mlt.Path(), bands=(405, 685, 7), spp=64, seed=1, spectral=True)
    layers = spectral_layers(result)
    assert list(layers) == [f"spectrum.{nm}-{nm + 40}nm" for nm in range(405, 685, 40)]
    samples = 64 * result.image[..., 0].size
    for k, layer in enumerate(layers.values()):
        assert (layer.dtype, layer.shape) == (np.float32, (*result.image.shape[:2], 1))
        waves = np.linspace(405 + 40 * k, 445 + 40 * k, 40001)
        values = np.interp(waves, (400, 500), (1, 3))
        error = values.std() / np.sqrt(samples)
        assert abs(layer.mean(dtype=float) - values.mean()) < 4.5 * error + 1e-5


def weight_in_rgb(first: float, last: float) -> np.ndarray:
    """The linear sRGB of light of radiance 1 per nm between two wavelengths, by quadrature.

    White light is added, so that it lies in the gamut, and taken off.
    """
    edge = 1e-3
    white = spectrum((300, 1), (900, 1))
    box = spectrum(
        (300, 1), (first - edge, 1), (first + edge, 2), (last - edge, 2), (last + edge, 1), (900, 1)
    )
    images = [mlt.render(sky(light), mlt.Path(), spp=1) for light in (white, box)]
    return images[1].mean((0, 1)) - images[0].mean((0, 1))


def test_bands_add_up_to_the_image():
    """With the CIE's matching functions as weights, beside a coloured floor and glass.

    The spectra are smooth, so that within 20 nm hardly anything is lost: 0.3 %.
    """
    scene = dispersive()
    scene["floor"]["bsdf"]["reflectance"] = {"type": "rgb", "value": [0.7, 0.4, 0.2]}
    loaded = mlt.load_dict(scene).with_wavelengths()
    bands = (380, 780, 20)
    weights = np.array([weight_in_rgb(*band) for band in parse_bands(bands)])
    differences = []
    for seed in range(12):
        result = mlt.render_bands(loaded, mlt.Path(max_depth=6), bands=bands, spp=64, seed=seed)
        means = np.array([layer.mean(dtype=float) for layer in spectral_layers(result).values()])
        image = result.image.mean((0, 1), dtype=float)
        differences.append((means @ weights - image) / image)
    differences = np.array(differences)
    error = differences.std(0, ddof=1) / np.sqrt(len(differences))
    assert error.max() < 0.006  # so a band that is lost or doubled would be seen
    assert np.all(np.abs(differences.mean(0)) < 6 * error + 0.003)  # 6: p = 1e-4 of Student's t


@pytest.mark.parametrize("integrator", [mlt.MLT, mlt.BDPT, mlt.MMLT, mlt.PSSMLT])
def test_all_algorithms_show_the_same_in_a_band(integrator):
    scene = mlt.load_file(tiny.of_cpp("prism")).with_wavelengths((450, 500))

    def means(algorithm, seed):
        images = (mlt.render(scene, algorithm, spp=128, seed=seed + k) for k in range(8))
        return np.array([image.mean(dtype=float) for image in images])

    a, b = means(mlt.Path(max_depth=6), 0), means(integrator(max_depth=6), 100)
    error = np.sqrt((a.var(ddof=1) + b.var(ddof=1)) / 8)
    assert error < 0.03 * a.mean()
    assert abs(a.mean() - b.mean()) < 6 * error  # p = 1e-4 of Student's t with 7 or more


@pytest.mark.parametrize("mutation", [mlt.Wavelength, mlt.Multiplexed, mlt.Bidirectional])
def test_mutations_leave_the_target_of_a_band_unchanged(mutation):
    scene = mlt.load_file(tiny.of_cpp("prism")).with_wavelengths((450, 600))
    audit = mlt.audit(mutation(), scene, paths=20000, significance=1e-5)
    assert audit, audit.summary()


def lamp_in_glass(ior) -> dict:
    """A short lamp in a block of glass, seen obliquely from above its surface."""
    scene = room()
    scene["sensor"] |= {"to_world": V().look_at([0, -4, 3], [0, 0, 0], [0, 0, 1])}
    scene["sensor"] |= {"fov": 6, "fov_axis": "y"}
    scene["sensor"]["film"] |= {"width": 8, "height": 64}
    del scene["ball"], scene["light"]
    scene["floor"]["bsdf"] = {"type": "dielectric", "int_ior": ior}
    lamp = {"type": "area", "radiance": spectrum((300, 1), (900, 1))}
    place = V().translate([0, 0.58, -1]).scale([1, 0.05, 1])
    scene["lamp"] = {"type": "rectangle", "to_world": place, "emitter": lamp}
    return scene


def rows_of_lamp(ior) -> np.ndarray:
    """Where it is in each band, in pixels from above."""
    scene = lamp_in_glass(ior)
    result = mlt.render_bands(scene, mlt.Path(max_depth=4), bands=(400, 700, 6), spp=64, spectral=1)
    rows = [layer.sum((1, 2), dtype=float) for layer in spectral_layers(result).values()]
    return np.array([row @ np.arange(64) / row.sum() for row in rows])


def test_glass_that_disperses_shows_bands_at_different_places():
    rows = rows_of_lamp("cauchy 1.35 60000")
    assert np.all(np.diff(rows) > 0.1)
    assert rows[-1] - rows[0] > 2
    assert np.ptp(rows_of_lamp(1.5)) < 0.05


def test_the_bits_of_a_band_are_those_of_any_number_of_threads():
    scene = mlt.load_dict(dispersive()).with_wavelengths()
    results = [
        mlt.render_bands(scene, mlt.MLT(max_depth=5), bands=3, spp=4, seed=3, threads=n)
        for n in (1, 2)
    ]
    layers = [spectral_layers(result) for result in results]
    assert len(layers[0]) == 3
    for name, layer in layers[0].items():
        np.testing.assert_array_equal(layer, layers[1][name])


def test_the_image_is_that_without_bands():
    how = {"spp": 4, "seed": 5, "spectral": True}
    result = mlt.render_bands(dispersive(), mlt.BDPT(), bands=2, aovs="albedo", **how)
    image = mlt.render(dispersive(), mlt.BDPT(), **how)
    np.testing.assert_array_equal(result.image, image)
    assert list(spectral_layers(result)) == ["spectrum.360-595nm", "spectrum.595-830nm"]
    assert "albedo" in result.layers


def test_a_checkpoint_knows_its_band(tmp_path):
    path = tmp_path / "render.ckpt"
    scene = mlt.load(tiny.of_cpp("prism")).with_wavelengths((500, 510))
    mlt.render(scene, mlt.MLT(max_depth=6), spp=4, seed=2, checkpoint=path)
    resumed = mlt.resume(path, spp=8).result().image
    np.testing.assert_array_equal(resumed, mlt.render(scene, mlt.MLT(max_depth=6), spp=8, seed=2))


def test_what_there_is_stays_if_a_band_fails():
    light = sky(spectrum((500, 0), (510, 1), (600, 1)))
    light["floor"] = room()["floor"]
    with pytest.raises(mlt.RenderError, match="no light path") as caught:
        mlt.render_bands(light, mlt.ERPT(), bands=(400, 600, 2), spp=4, spectral=True)
    assert caught.value.result.image.mean() > 0
    layers = mlt.render_bands(light, mlt.MLT(), bands=(400, 600, 2), spp=4, spectral=True).layers
    assert layers["spectrum.400-500nm"].max() == 0
    assert layers["spectrum.500-600nm"].max() > 0


def test_progress_is_that_of_all_renders():
    seen = []
    scene = mlt.load_dict(room()).with_wavelengths()
    mlt.render_bands(scene, "path", bands=2, spp=64, progress=seen.append)
    assert seen == sorted(seen)
    assert all(0 <= share <= 1 for share in seen)


def test_bands_share_the_time():
    assert share_of_time(6.0, parse_bands(2)) == 2
    assert share_of_time(None, parse_bands(2)) is None


def test_names_have_decimal_commas():
    assert parse_bands("400:401:2")[1].layer == "spectrum.400,5-401nm"


@pytest.mark.parametrize("bands", [3, "3", (360, 830, 3), "360:830:3", np.int64(3)])
def test_bands_are_equal_intervals(bands):
    ends = np.array(parse_bands(bands))
    np.testing.assert_allclose(ends, [[360, 1550 / 3], [1550 / 3, 2020 / 3], [2020 / 3, 830]])


@pytest.mark.parametrize("bands", [0, -1, 1.5, 1001, True, None, "", "x", "400:700", [], "::3"])
def test_numbers_of_bands_that_make_no_sense_are_refused(bands):
    with pytest.raises(mlt.UsageError, match=r"from 1 to 1000.*400:700:10"):
        parse_bands(bands)


@pytest.mark.parametrize("ends", [(300, 700), (400, 831), (500, 400), (500, 500), ("nan", 700)])
def test_ends_that_make_no_sense_are_refused(ends):
    with pytest.raises(mlt.UsageError, match="between 360 and 830 nm, the lower one first"):
        parse_bands((*ends, 2))
    with pytest.raises(mlt.SceneError, match="from 360 to 830 nm, the lower one first"):
        mlt.load_dict(room()).with_wavelengths(tuple(map(float, ends)))


def test_bands_may_be_too_thin():
    with pytest.raises(mlt.UsageError, match=r"thinner than 0\.01 nm"):
        parse_bands((400, 401, 101))


def test_bands_need_a_spectral_scene():
    with pytest.raises(mlt.UsageError, match="need a spectral scene; add spectral=True"):
        mlt.render_bands(room(), bands=3)
    scene = room()
    scene["sensor"]["film"] = scene["sensor"]["film"] | {"band": "400:430"}
    with pytest.raises(mlt.SceneError, match="'band' needs spectral = true"):
        mlt.load_dict(scene)


def test_the_command_line_writes_bands(tmp_path):
    image = tmp_path / "image.exr"
    arguments = (tiny.of_cpp("prism"), "--bands", "400:500:2", "--spp", 2)
    outcome = run(PYMLT, "render", *arguments, "--integrator", "path", "-o", image)
    assert outcome.returncode == 0, outcome.stderr
    names = [f"spectrum.{ends}nm" for ends in ("400-450", "450-500")]
    assert [name for name in layer_names(image) if name in names] == names
    scene = mlt.load(tiny.of_cpp("prism"))
    expected = mlt.render_bands(scene, "path", bands=(400, 500, 2), spp=2)
    for name in names:
        written = mlt.read_image(image, name)
        np.testing.assert_array_equal(written, expected.layers[name].astype(np.float16))


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        ((tiny.of_cpp("caustic"), "--bands", "3"), "need a spectral scene; add --spectral"),
        ((tiny.of_cpp("prism"), "--bands", "0"), "the number of bands, from 1 to 1000"),
        ((tiny.of_cpp("prism"), "--bands", "700:400:3"), "the lower one first"),
        (
            (tiny.of_cpp("prism"), "--bands", "3", "--checkpoint", "none.ckpt"),
            "--bands cannot be given with --checkpoint",
        ),
    ],
)
def test_the_command_line_refuses_bands(arguments, message):
    outcome = run(PYMLT, "render", *arguments, "-o", "none.exr")
    assert message in the_error(outcome)
