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
def test_the_less_noise_the_less_is_removed(integrator):
    """A 32nd of the variance; noise that a few tours make falls more slowly than its root."""
    scene = mlt.load_string(tiny.XML, res=16)
    few, many = (
        mlt.start(scene, integrator, spp=spp, seed=1, fireflies="groups").result()
        for spp in (128, 4096)
    )
    assert few.stats["fireflies_removed"] > 0
    assert abs(many.stats["fireflies_removed"]) < 0.5 * few.stats["fireflies_removed"]


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
