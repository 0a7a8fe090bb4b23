"""Merging renders: the weighted mean, its error, and what is refused."""

import numpy as np
import pytest
import tiny

import pymlt as mlt
from pymlt.cli import main


@pytest.fixture(scope="module")
def scene():
    return mlt.load_string(tiny.XML, res=24)


def result(scene, seed, spp=2.0, integrator="path"):
    return mlt.start(scene, integrator, spp=spp, seed=seed).result()


@pytest.mark.parametrize("integrator", ["path", "pssmlt"])
def test_the_image_is_the_mean_weighted_with_the_samples(scene, integrator):
    parts = [result(scene, seed, spp, integrator) for seed, spp in ((1, 2), (2, 6))]
    merged = mlt.merge(parts)
    spp = [part.stats["spp_done"] for part in parts]
    expected = np.average([p.image.astype(float) for p in parts], axis=0, weights=spp)
    np.testing.assert_allclose(merged.image, expected, rtol=1e-6)
    assert merged.stats["spp_done"] == sum(spp)
    assert merged.metadata["seed"] == "1 2"


def test_files_are_merged_as_results_are(scene, tmp_path):
    parts = [result(scene, seed) for seed in (1, 2, 3)]
    files = [tmp_path / f"{part.seed}.exr" for part in parts]
    for part, file in zip(parts, files, strict=True):
        part.write(file)
    assert main(["merge", *map(str, files), "-o", str(tmp_path / "all.exr")]) == 0
    merged = mlt.merge(parts)
    assert np.array_equal(mlt.read_image(tmp_path / "all.exr"), merged.image)
    assert mlt.read_metadata(tmp_path / "all.exr") == merged.metadata
    # A merged render can be merged, and says which seeds are in it.
    other = result(scene, 4)
    more = mlt.merge([tmp_path / "all.exr", other])
    np.testing.assert_allclose(more.image, mlt.merge([*parts, other]).image, rtol=1e-5)
    with pytest.raises(mlt.UsageError, match="same seed 2"):
        mlt.merge([tmp_path / "all.exr", files[1]])


def test_the_layers_of_techniques_are_merged(scene):
    bdpt = mlt.BDPT(max_depth=3, techniques=True)
    parts = [result(scene, seed, integrator=bdpt) for seed in (1, 2)]
    merged = mlt.merge(parts)
    for technique, images in merged.techniques.items():
        expected = np.mean([part.techniques[technique].weighted for part in parts], axis=0)
        np.testing.assert_allclose(images.weighted, expected, rtol=1e-6)


def test_eight_renders_tell_by_their_spread_how_wrong_their_mean_is(scene):
    """The squared error estimates add up to the squared differences from a reference.

    The bounds are 4 standard errors of their difference, measured over the seeds themselves. (The
    quotient of the sums is compared, since a mean of quotients is too large.)
    """
    reference = mlt.render(scene, "path", spp=4096, seed=999)
    said, true = [], []
    for repeat in range(32):
        merged = mlt.merge([result(scene, 1 + 8 * repeat + i, spp=4) for i in range(8)])
        said.append(np.mean(merged.layers["error"] ** 2))
        true.append(np.mean((merged.image - reference) ** 2))
    error = np.std(np.subtract(said, true), ddof=1) / np.sqrt(len(true)) / np.mean(true)
    assert abs(np.mean(said) / np.mean(true) - 1) < 4 * error
    assert error < 0.1


def test_the_error_of_blocks_is_that_of_their_means(scene):
    parts = [result(scene, seed, spp=1 + seed % 3) for seed in range(1, 9)]
    merged = mlt.merge(parts)
    block = (slice(8, 12), slice(16, 24))  # the lowest row of blocks is smaller
    means = [part.image[block].mean(axis=(0, 1), dtype=float) for part in parts]
    weights = np.array([part.stats["spp_done"] for part in parts])
    weights = weights / weights.sum()
    deviations = weights[:, None] * (means - np.average(means, axis=0, weights=weights))
    expected = np.sqrt(8 / 7 * (deviations**2).sum(axis=0))
    assert merged.layers["error_block"].shape == merged.image.shape
    np.testing.assert_allclose(
        merged.layers["error_block"][block], np.broadcast_to(expected, (4, 8, 3)), rtol=1e-4
    )


def test_fewer_renders_hand_on_their_own_errors(scene):
    parts = [result(scene, seed, spp=spp) for seed, spp in ((1, 2), (2, 6))]
    for part in parts:
        part.layers["error"] = np.full_like(part.image, part.seed)
    merged = mlt.merge(parts)
    expected = np.sqrt((2 / 8 * 1) ** 2 + (6 / 8 * 2) ** 2)
    np.testing.assert_allclose(merged.layers["error"], expected, rtol=1e-6)
    del parts[0].layers["error"]
    assert "error" not in mlt.merge(parts).layers


def test_what_does_not_fit_together_is_refused(scene):
    one = result(scene, 1)
    other_depth = result(scene, 2, integrator=mlt.Path(max_depth=3))
    other_scene = result(mlt.load_string(tiny.XML.replace("0.7, 0.4", "0.7, 0.5"), res=24), 3)
    with pytest.raises(mlt.UsageError, match="same seed 1"):
        mlt.merge([one, result(scene, 1, spp=3)], force=True)
    with pytest.raises(mlt.UsageError, match=r"differ in max_depth: 4 and 3; --force"):
        mlt.merge([one, other_depth])
    with pytest.raises(mlt.UsageError, match="renders of different scenes; --force"):
        mlt.merge([one, other_scene])
    assert mlt.merge([one, other_depth, other_scene], force=True).stats["spp_done"] == 6
    larger = result(mlt.load_string(tiny.XML, res=32), 4)
    with pytest.raises(mlt.UsageError, match="differ in size: 24 x 12 and 32 x 12"):
        mlt.merge([one, larger], force=True)
    with pytest.raises(mlt.UsageError, match="nothing to merge"):
        mlt.merge([])


def test_files_that_are_no_renders_are_refused(scene, tmp_path, capsys):
    foreign = tmp_path / "foreign.exr"
    mlt.write_image(foreign, np.ones((12, 24, 3)))
    assert main(["merge", str(foreign), "-o", str(tmp_path / "all.exr")]) == 2
    message = capsys.readouterr().err
    assert message.count("\n") == 1
    assert "foreign.exr" in message
    assert "pymlt" in message
    assert not (tmp_path / "all.exr").exists()
    assert main(["merge", str(tmp_path / "none.exr"), "-o", str(tmp_path / "all.exr")]) == 2
