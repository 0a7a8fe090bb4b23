"""Images without what one group of a render alone has found."""

import numpy as np
import pytest
import tiny
from command_line import PYMLT, run

import pymlt as mlt
from pymlt.diagnostics.metrics import sparks
from pymlt.images import layer_names


@pytest.fixture(scope="module")
def goblets():
    return mlt.load_dict(mlt.scenes.goblets(), size=(96, 54))


@pytest.fixture(scope="module")
def filtered(goblets):
    return mlt.start(goblets, "bdpt", spp=128, seed=1, fireflies="groups").result()


def test_sparks_go(filtered):
    before = filtered.layers["unfiltered"]
    assert sparks(before).sum() > 10
    assert sparks(filtered.image).sum() < 0.5 * sparks(before).sum()


def test_it_tells_what_is_removed(goblets, filtered):
    before = filtered.layers["unfiltered"]
    assert np.array_equal(before, mlt.render(goblets, "bdpt", spp=128, seed=1))
    removed = 1 - filtered.image.mean(dtype=float) / before.mean(dtype=float)
    assert filtered.stats["fireflies_removed"] == pytest.approx(removed)
    assert 0 < removed < 0.3
    assert f"{100 * removed:.2g} %" in filtered.metadata["fireflies"]


def test_each_pixel_is_a_mean_of_the_groups_in_the_middle(goblets):
    job = mlt.start(goblets, "path", spp=128, seed=1, fireflies="groups")
    image, groups = job.result().image, job.groups.images.astype(float)
    mean = groups.mean(axis=0)
    quiet = (groups.std(axis=0) < 0.1 * mean).all(axis=2)  # all have seen about the same: G < 1/8
    assert quiet.sum() > 100
    assert np.allclose(image[quiet], mean[quiet], rtol=1e-4)
    assert (image >= groups.min(axis=0) - 1e-6).all()
    assert (image <= groups.max(axis=0) + 1e-6).all()


@pytest.mark.parametrize("integrator", ["path", "mlt", "pssmlt", "erpt"])
@pytest.mark.parametrize("spp", [128, 2048])
def test_no_more_is_removed_than_the_groups_differ(integrator, spp):
    """The mean of m of n numbers differs from that of all by at most s sqrt((n - m) / m), where s
    is their standard deviation (Cauchy-Schwarz); of n groups at most n G are left out. Groups of
    chains are filtered apart from the samples beside them, of which there are none here.
    """
    if integrator in ("mlt", "pssmlt"):
        integrator = {"type": integrator, "independent_share": 0}
    scene = mlt.load_string(tiny.XML, res=16)
    job = mlt.start(scene, integrator, spp=spp, seed=1, fireflies="groups")
    image, groups = job.result().image, job.groups.images.astype(float)
    mean = groups.mean(axis=0)
    removed = np.abs(mean - image)
    assert removed.max() > 0
    luminance = groups @ [0.212639, 0.715169, 0.072192]
    gini = gini_coefficient((luminance + groups.mean(axis=-1)) / 2)[..., None]
    bound = groups.std(axis=0) * np.sqrt(gini / (1 - gini))
    assert (removed <= bound + 1e-5 * mean).all()


def gini_coefficient(brightness):
    """Of numbers along the first axis, by their differences: sum |x_i - x_j| / (2 n sum x_i)."""
    differences = np.abs(brightness[:, None] - brightness[None]).sum(axis=(0, 1))
    return differences / (2 * len(brightness) * np.maximum(brightness.sum(axis=0), 1e-30))


def test_what_is_neither_is_refused():
    with pytest.raises(mlt.UsageError, match="fireflies is 'clamp', but should be 'keep' or"):
        mlt.render(tiny.scene(), fireflies="clamp")


def test_filtered_images_are_not_merged(goblets):
    results = [
        mlt.start(goblets, "path", spp=32, seed=s, fireflies="groups").result() for s in (1, 2)
    ]
    with pytest.raises(mlt.UsageError, match="merge its layer 'unfiltered'"):
        mlt.merge(results)


def test_the_command_line_has_it(tmp_path):
    (tmp_path / "scene.xml").write_text(tiny.XML)
    flags = ["--spp", 64, "--integrator", "path", "--fireflies", "groups", "-o", "a.exr"]
    done = run(PYMLT, "render", "scene.xml", *flags, cwd=tmp_path)
    assert done.returncode == 0, done.stderr
    assert "fireflies by groups: " in done.stderr + done.stdout
    assert "unfiltered" in layer_names(tmp_path / "a.exr")
