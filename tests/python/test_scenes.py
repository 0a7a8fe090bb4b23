"""The built-in scenes: the dict is the file, the meshes can be made again, the furnace is even."""

import re
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest

import pymlt as mlt

ROOT = Path(__file__).resolve().parents[2]
FILES = sorted((ROOT / "scenes").glob("*/scene.xml"))
NAMES = [path.parent.name for path in FILES]
MADE = (".ply", ".png", ".vol")  # files that scripts make


def built_in(name, **values):
    return getattr(mlt.scenes, name.replace("-", "_"))(**values)


def test_each_folder_is_a_built_in_scene_and_says_what_it_shows():
    assert mlt.scenes.names() == sorted(name.replace("-", "_") for name in NAMES)
    for name in NAMES:
        assert (ROOT / "scenes" / name / "README.md").stat().st_size > 200
        assert getattr(mlt.scenes, name.replace("-", "_")).__doc__


@pytest.mark.parametrize("name", NAMES)
def test_the_dict_is_the_file(name):
    file = mlt.load_file(ROOT / "scenes" / name / "scene.xml")
    made = mlt.load_dict(built_in(name))
    assert file.warnings == made.warnings == []
    assert file.info() | {"seconds": 0} == made.info() | {"seconds": 0}
    a, b = (
        mlt.render(scene, "path", spp=2, seed=3)
        for scene in (
            mlt.load_file(ROOT / "scenes" / name / "scene.xml", size=(32, 18)),
            mlt.load_dict(built_in(name), size=(32, 18)),
        )
    )
    # The matrices may differ in their last bits, and a ray at an edge with them.
    assert np.isclose(a, b, rtol=1e-4, atol=1e-6).mean() > 0.98


@pytest.mark.parametrize(
    ("name", "define", "value"),
    [
        ("door-ajar", "opening", 60),
        ("dof", "aperture", 0.3),
        ("motion", "shutter", 0.0),
        ("orrery", "shutter", 0.0),
    ],
)
def test_a_parameter_of_the_dict_is_that_of_the_file(name, define, value):
    path = ROOT / "scenes" / name / "scene.xml"
    default = float(re.search(rf'<default name="{define}" value="([^"]+)"', path.read_text())[1])
    size = (32, 18)
    given, plain, file = (
        mlt.render(scene, "path", spp=4, seed=1)
        for scene in (
            mlt.load_dict(built_in(name, **{define: value}), size=size),
            mlt.load_dict(built_in(name), size=size),
            mlt.load_file(path, size=size, **{define: value}),
        )
    )
    assert built_in(name, **{define: default}).keys() == built_in(name).keys()
    assert np.isclose(given, file, rtol=1e-4, atol=1e-6).mean() > 0.98
    assert np.isclose(given, plain, rtol=1e-4, atol=1e-6).mean() < 0.9


@pytest.mark.parametrize(
    "path", sorted((ROOT / "scenes").glob("*/make.py")), ids=lambda p: p.parent.name
)
def test_the_script_makes_the_files_that_are_there(path, tmp_path):
    folder = tmp_path / path.parent.name
    folder.mkdir()
    (folder / "make.py").write_text(path.read_text())
    (tmp_path / "modeling.py").write_text((ROOT / "scenes" / "modeling.py").read_text())
    subprocess.run([sys.executable, str(folder / "make.py")], check=True)
    made = sorted(p.name for p in folder.iterdir() if p.suffix in MADE)
    assert made == sorted(p.name for p in path.parent.iterdir() if p.suffix in MADE)
    for name in made:
        if name.endswith(".png"):
            a, b = (mlt.read_image(p / name) for p in (folder, path.parent))
            assert np.abs(a - b).max() < 0.02
        else:  # the same length; coordinates may differ in their last bits
            assert (folder / name).stat().st_size == (path.parent / name).stat().st_size


# ---- names -------------------------------------------------------------------------------------


def test_a_name_stands_for_a_scene():
    image = mlt.render("door-ajar", "path", spp=1, seed=1)
    loaded = mlt.load_dict(mlt.scenes.door_ajar())
    assert np.array_equal(image, mlt.render(loaded, "path", spp=1, seed=1))
    small = mlt.load("dof", size=(8, 6), aperture=0.25)
    assert (small.width, small.height) == (8, 6)
    assert small.hash == mlt.load_dict(mlt.scenes.dof(aperture=0.25), size=(8, 6)).hash


def test_a_name_that_stands_for_nothing_names_what_was_meant():
    with pytest.raises(mlt.UsageError, match=r"neither a file nor a built-in scene.*'door_ajar'"):
        mlt.render("door-ajr")
    with pytest.raises(mlt.FileError, match=r"ring\.xml: there is no such file"):
        mlt.load("ring.xml")


# ---- the furnace -------------------------------------------------------------------------------


@pytest.mark.parametrize("integrator", [mlt.Path, mlt.PTracer, mlt.BDPT, mlt.PSSMLT])
def test_the_furnace_has_the_radiance_of_the_series(integrator):
    """Up to depth d the radiance is e (1 + a + ... + a^(d - 1)); without a bound, e / (1 - a)."""
    emission, albedo, depth = np.array([0.1, 0.25, 0.4]), np.array([0.8, 0.5, 0.2]), 4
    scene = mlt.load_dict(mlt.scenes.furnace(), size=(24, 16))
    # Independent runs: their spread says how far the mean may be off.
    runs = np.array(
        [
            mlt.render(scene, integrator(max_depth=depth), spp=32, seed=seed).mean(axis=(0, 1))
            for seed in range(16)
        ]
    )
    expected = emission * (1 - albedo**depth) / (1 - albedo)
    error = runs.std(axis=0, ddof=1) / 4
    assert (error < 0.005 * expected).all()  # 0.5 % would be found
    assert (np.abs(runs.mean(axis=0) - expected) < 6 * error + 1e-6).all()


@pytest.mark.parametrize("independent", ["path", "bdpt"])
def test_chains_and_samples_share_the_light_of_a_sphere_that_shines_inwards(independent):
    """1 + 1/2 + 1/4, where points lie on the light itself, on either side of it by rounding."""
    sphere = {
        "type": "sphere",
        "flip_normals": True,
        "bsdf": {"type": "diffuse", "reflectance": 0.5},
        "light": {"type": "area", "radiance": 1.0},
    }
    film = {"type": "hdrfilm", "width": 16, "height": 16, "rfilter": {"type": "box"}}
    scene = {"type": "scene", "sphere": sphere, "sensor": {"type": "perspective", "film": film}}
    integrator = mlt.MLT(max_depth=3, independent=independent, independent_share=0.9)
    assert mlt.render(scene, integrator, spp=256).mean() == pytest.approx(1.75, rel=0.004)


def test_the_furnace_without_a_bound_is_one_half():
    scene = mlt.load_dict(mlt.scenes.furnace(), size=(16, 12))
    few = mlt.MLT(chains=16, luminance_samples=10_000)
    runs = np.array(
        [mlt.render(scene, few, spp=16, seed=seed).mean(axis=(0, 1)) for seed in range(16)]
    )
    error = runs.std(axis=0, ddof=1) / 4
    assert (error < 0.01).all()
    assert (np.abs(runs.mean(axis=0) - 0.5) < 6 * error).all()
