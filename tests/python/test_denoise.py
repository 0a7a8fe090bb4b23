"""Denoising: what goes into the filter, what comes out, and what a file says about it."""

import sys
from pathlib import Path

import numpy as np
import pytest
import tiny

import pymlt as mlt
from pymlt import cli
from pymlt.pictures.luminance import target_luminance

pytest.importorskip("pyoidn", reason="needs pymlt[denoise]")


def clean_image():
    """Smooth, with one edge and a stripe that only the albedo knows."""
    y, x = np.mgrid[0:64, 0:80] / 64
    grey = np.where(x > 0.6, 0.2, 0.5 + 0.3 * y)
    return np.repeat(grey[..., None], 3, axis=2).astype(np.float32)


@pytest.fixture(scope="module")
def noisy():
    rng = np.random.default_rng(1)
    clean = clean_image()
    return (clean * rng.gamma(4, 0.25, clean.shape)).astype(np.float32)


def rmse(a, b) -> float:
    return float(np.sqrt(np.mean((a - b) ** 2)))


def test_independent_noise_is_removed(noisy):
    found = mlt.denoise(noisy)
    assert found.shape == noisy.shape
    assert found.dtype == np.float32
    assert rmse(found, clean_image()) < 0.2 * rmse(noisy, clean_image())


def test_an_albedo_keeps_what_the_noise_hides():
    rng = np.random.default_rng(2)
    stripes = np.tile(np.where(np.arange(80) % 4 < 2, 0.2, 0.8), (64, 1))
    albedo = np.repeat(stripes[..., None], 3, axis=2)
    noise = rng.exponential(1, albedo.shape)
    normal = np.broadcast_to([0.0, 0.0, 1.0], albedo.shape)
    plain = rmse(mlt.denoise(albedo * noise), albedo)
    guided = rmse(mlt.denoise(albedo * noise, albedo=albedo), albedo)
    both = mlt.denoise(albedo * noise, albedo=albedo, normal=normal, clean_guides=True)
    assert guided < 0.5 * plain
    assert rmse(both, albedo) < 0.5 * plain


def test_grey_and_alpha_keep_their_shape(noisy):
    assert mlt.denoise(noisy[..., 0]).shape == noisy.shape[:2]
    rgba = np.dstack([noisy, np.linspace(0, 1, noisy[..., 0].size).reshape(noisy.shape[:2])])
    found = mlt.denoise(rgba)
    assert np.array_equal(found[..., 3], rgba[..., 3].astype(np.float32))
    assert found[..., :3] == pytest.approx(mlt.denoise(noisy), abs=1e-6)


def test_what_is_no_number_stays_where_it_is(noisy):
    broken = noisy.copy()
    broken[10, 10], broken[20, 20] = np.nan, np.inf
    found = mlt.denoise(broken)
    assert np.isfinite(found).all()
    assert rmse(found, clean_image()) < 0.3 * rmse(noisy, clean_image())


@pytest.mark.parametrize(
    ("guides", "message"),
    [
        ({"albedo": np.zeros((3, 3, 3))}, r"albedo has the shape \(3, 3, 3\)"),
        ({"albedo": np.zeros((64, 80))}, "albedo has the shape"),
        ({"normal": np.zeros((64, 80, 3))}, "only beside an albedo"),
    ],
)
def test_guides_that_do_not_fit_are_refused(noisy, guides, message):
    with pytest.raises(mlt.UsageError, match=message):
        mlt.denoise(noisy, **guides)


def test_without_the_package_it_says_what_to_install(noisy, scene, monkeypatch, capsys, tmp_path):
    monkeypatch.setitem(sys.modules, "pyoidn", None)
    with pytest.raises(mlt.UsageError, match="pip install 'pyoidn>="):
        mlt.denoise(noisy)
    assert cli.main(["render", scene, "-o", "a.exr", "--denoise"]) == 2
    assert capsys.readouterr().err.count("\n") == 1
    assert not (tmp_path / "a.exr").exists()


# ---- results and files -------------------------------------------------------------------------


def test_a_denoised_result_keeps_the_image_and_cannot_be_merged(tmp_path):
    result = mlt.start(tiny.scene(), "path", spp=16, seed=1).result()
    assert "error" in result.layers
    clean = result.denoise()
    assert np.array_equal(clean.image, mlt.denoise(result.image))
    assert np.array_equal(clean.layers["noisy"], result.image)
    assert clean.error_map is None
    assert "denoised" not in result.metadata
    clean.write(tmp_path / "a.exr")
    assert "Open Image Denoise" in mlt.read_metadata(tmp_path / "a.exr")["denoised"]
    with pytest.raises(mlt.UsageError, match="denoised"):
        mlt.merge([tmp_path / "a.exr"])


def test_the_layers_of_a_result_guide_the_filter():
    result = mlt.start(tiny.scene(), "path", spp=4, seed=1).result()
    albedo = np.random.default_rng(1).random(result.image.shape).astype(np.float32)
    result.layers.update(albedo=albedo, sh_normal=2 * albedo - 1)
    guided = result.denoise()
    expected = mlt.denoise(result.image, albedo=albedo, normal=2 * albedo - 1)
    assert np.array_equal(guided.image, expected)
    assert guided.metadata["denoised"].endswith("guided by albedo and normal")
    del result.layers["albedo"]
    assert np.array_equal(result.denoise().image, mlt.denoise(result.image))
    assert np.array_equal(result.denoise(albedo=albedo).image, expected)
    other = result.denoise(albedo=1 - albedo)
    assert not np.array_equal(other.image, expected)


def test_the_command_line_denoises_renders_and_files(scene):
    assert cli.main(["render", scene, "--spp", "16", "--denoise", "-o", "a.exr"]) == 0
    layers = ["--aov", "albedo,sh_normal", "--fireflies", "groups"]
    assert cli.main(["render", scene, "--spp", "16", *layers, "-o", "b.exr"]) == 0
    assert cli.main(["denoise", "b.exr", "-o", "c.exr"]) == 0
    assert np.array_equal(mlt.read_image("a.exr"), mlt.read_image("c.exr"))
    assert np.array_equal(mlt.read_image("a.exr", "noisy"), mlt.read_image("b.exr", "unfiltered"))
    assert np.array_equal(mlt.read_image("c.exr", "noisy"), mlt.read_image("b.exr"))


# ---- renders that are denoised, with their error -----------------------------------------------


@pytest.fixture(scope="module")
def box():
    return mlt.load("cornell-box", size=(96, 72), filter="box")


@pytest.fixture(scope="module")
def reference(box):
    return mlt.render(box, "bdpt", spp=512, seed=99)


def relative_error(image, reference) -> float:
    found, true = (target_luminance(x) for x in (image, reference))
    return float(np.sqrt(np.mean((found - true) ** 2 / (true**2 + 0.01 * true.mean() ** 2))))


@pytest.mark.parametrize("integrator", ["path", "bdpt", "mlt", "pssmlt"])
def test_a_denoised_render_tells_its_error(box, reference, integrator):
    result = mlt.start(box, integrator, spp=64, seed=1, denoise=True).result()
    noisy = mlt.render(box, integrator, spp=64, seed=1)
    assert np.array_equal(result.layers["noisy"], noisy)
    assert result.error_map is result.layers["denoised_error"]
    assert result.error_map.shape == noisy.shape
    assert result.layers["error"].any()
    true = relative_error(result.image, reference)
    assert true < 0.75 * relative_error(noisy, reference)
    assert 0.6 < result.stats["denoised_error"] / true < 1.6
    assert f"denoised {100 * result.stats['denoised_error']:.2g} %" in repr(result)


def test_an_image_alone_is_denoised_as_well(box):
    given = {"spp": 32, "seed": 1, "denoise": True}
    image = mlt.render(box, "path", **given)
    assert np.array_equal(image, mlt.start(box, "path", **given).result().image)
    assert not np.array_equal(image, mlt.render(box, "path", spp=32, seed=1))


def test_an_error_budget_is_that_of_the_denoised_image(box, reference):
    results = [
        mlt.start(box, "path", error=0.06, seed=1, threads=threads, denoise=True).result()
        for threads in (1, 2)
    ]
    for result in results:
        assert result.stats["ended_by"] == "error"
        assert result.stats["denoised_error"] <= 0.06 < result.stats["error"]
        assert relative_error(result.image, reference) < 0.06
    assert np.array_equal(results[0].image, results[1].image)


def test_a_denoised_render_can_be_extended_to_an_error(box):
    job = mlt.start(box, "path", spp=64, seed=1, denoise=True)
    assert job.result().stats["ended_by"] == "spp"
    job.extend(error=0.06)
    result = job.result()
    assert result.stats["ended_by"] == "error"
    assert result.stats["denoised_error"] <= 0.06 < result.stats["error"]


def test_a_running_render_can_be_seen_denoised(box):
    job = mlt.start(box, "path", spp=64, seed=1)
    job.wait()
    assert job.denoised_error is None
    seen = job.denoised()
    assert job.denoised_error < job.error
    assert not np.array_equal(seen, job.image)
    assert np.array_equal(job.result().image, job.image)


def test_a_render_that_is_dropped_while_it_is_judged_ends(box):
    job = mlt.start(box, "path", error=1e-4, seed=1, denoise=True)
    job.wait(0.5)
    core = job._job
    del job
    assert core.ended


def test_normals_alone_guide_no_render(box):
    result = mlt.start(box, "path", spp=64, seed=1, aovs="sh_normal", denoise=True).result()
    plain = mlt.start(box, "path", spp=64, seed=1, aovs="", denoise=True).result()
    assert np.array_equal(result.image, plain.image)
    assert "guided" not in result.metadata["denoised"]


def test_with_few_samples_the_error_is_not_known(box):
    result = mlt.start(box, "path", spp=8, seed=1, denoise=True).result()
    assert "denoised_error" not in result.stats
    assert result.error_map is None
    assert not np.array_equal(result.image, result.layers["noisy"])


def test_a_filter_that_fails_leaves_the_image(box, monkeypatch):
    import pyoidn

    def fail(*args, **kwargs):
        raise RuntimeError("no device")

    monkeypatch.setattr(pyoidn, "denoise", fail)
    result = mlt.start(box, "path", spp=64, seed=1, denoise=True).result()
    assert "Open Image Denoise: no device; the image is not denoised" in result.stats["warnings"]
    assert np.array_equal(result.image, mlt.render(box, "path", spp=64, seed=1))


def test_files_guide_the_filter(scene, noisy, capsys):
    mlt.write_image("a.exr", noisy)
    mlt.write_image("b.exr", clean_image())
    assert cli.main(["denoise", "a.exr", "--albedo", "b.exr", "-o", "c.exr"]) == 0
    assert "guided by albedo: c.exr" in capsys.readouterr().err
    expected = mlt.denoise(noisy, albedo=clean_image())
    assert np.array_equal(mlt.read_image("c.exr"), expected)
    assert cli.main(["denoise", "c.exr", "-o", "d.jpg", "--tonemap", "filmic"]) == 0
    assert mlt.read_image("d.jpg").shape == noisy.shape
    assert cli.main(["denoise", "d.jpg", "-o", "e.png"]) == 0


def test_mistakes_are_one_line(scene, capsys):
    assert cli.main(["denoise", "none.exr", "-o", "a.exr"]) == 2
    assert cli.main(["denoise", "none.exr", "-o", "a.gif"]) == 2
    assert capsys.readouterr().err.count("\n") == 2


def test_the_filter_is_box_and_a_wide_one_is_warned_of(scene, capsys):
    wide = Path(scene).read_text().replace('<rfilter type="box"/>', '<rfilter type="gaussian"/>')
    Path("wide.xml").write_text(wide)
    denoise = ["--denoise", "-o", "a.exr"]
    for name in scene, "wide.xml":
        assert cli.main(["render", name, "--spp", "1", *denoise]) == 0
        assert "filter" not in capsys.readouterr().err
    noisy = mlt.render(mlt.load(scene), spp=1)
    assert np.allclose(mlt.read_image("a.exr", "noisy"), noisy, rtol=1e-3)
    assert cli.main(["render", scene, "--spp", "1", *denoise, "--filter", "gaussian"]) == 0
    warning = "warning: the filter 'gaussian' spreads noise"
    said = capsys.readouterr().err
    assert warning in said
    assert "use --filter box" in said
