"""Spectra of files, by name and as values in pbrt-v4 files."""

from pathlib import Path

import numpy as np
import pytest
from pbrt_v3_files import SKY, assert_close, read
from pbrt_v4_files import VIEW, WALL, in_the_open, seen

import pymlt as mlt
from pymlt.formats.pbrt.metals import METALS


@pytest.fixture(autouse=True)
def folder(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    Path("eta.spd").write_text("# nm, n\n300 2 # even\n900 2\n")
    Path("k.spd").write_text("300 3\n900 3\n")


def reflected(eta, k):
    """At normal incidence."""
    eta, k = np.array(eta), np.array(k)
    return ((eta - 1) ** 2 + k**2) / ((eta + 1) ** 2 + k**2)


#: Parameters, and the complex index of refraction that they give.
CONDUCTORS = {
    '"spectrum eta" "eta.spd" "spectrum k" "k.spd"': (2, 3),
    '"spectrum eta" "eta.spd" "spectrum k" [ 300 1 900 1 ]': (2, 1),
    '"rgb eta" [ 1 2 3 ] "spectrum k" "k.spd"': ([1, 2, 3], 3),
    '"spectrum eta" "metal-Au-eta" "rgb k" [ 4 2 1 ]': (METALS["Au"][0], [4, 2, 1]),
    '"spectrum eta" "eta.spd" "spectrum k" "metal-Ag-k"': (2, METALS["Ag"][1]),
    '"spectrum eta" "metal-Au-eta" "spectrum k" "metal-Ag-k"': (METALS["Au"][0], METALS["Ag"][1]),
    '"spectrum eta" "metal-Au-eta"': (METALS["Au"][0], METALS["Cu"][1]),
    '"spectrum k" "k.spd"': (METALS["Cu"][0], 3),
    "": METALS["Cu"],
}


@pytest.mark.parametrize("parameters", CONDUCTORS)
def test_a_conductor_keeps_both_parts_of_its_index(parameters):
    expected = reflected(*CONDUCTORS[parameters])
    found = in_the_open(f'Material "conductor" {parameters}', spp=4)
    np.testing.assert_allclose(found, np.broadcast_to(expected, 3), rtol=2e-3)


@pytest.mark.parametrize("metal", METALS)
def test_a_metal_by_name_has_the_index_of_the_table(metal):
    names = f'"spectrum eta" "metal-{metal}-eta" "spectrum k" "metal-{metal}-k"'
    made = read(VIEW, f'Material "conductor" {names}').scene["conductor-material"]
    assert made["bsdf"] == {"type": "conductor", "material": metal}
    found = in_the_open(f'Material "conductor" {names}', spp=4)
    np.testing.assert_allclose(found, reflected(*METALS[metal]), rtol=2e-3)


@pytest.mark.parametrize("index", [1, 1.5])
def test_a_coating_lets_a_metal_of_files_shine_through(index):
    """Light meets the metal in the coating: its index is that over the coating's."""
    files = '"spectrum conductor.eta" "eta.spd" "spectrum conductor.k" "k.spd"'
    given = f'Material "coatedconductor" {files} "float interface.eta" {index}'
    mirrored = reflected(index, 0)
    expected = mirrored + (1 - mirrored) ** 2 * reflected(2 / index, 3 / index)
    assert_close(in_the_open(given, spp=4), expected)


def test_any_spectrum_may_be_a_file():
    Path("half.spd").write_text("300 .5\n900 .5\n")
    assert_close(in_the_open('Material "diffuse" "spectrum reflectance" "half.spd"'), 0.5)
    by_default = 'Attribute "material" "spectrum reflectance" "half.spd" Material "diffuse"'
    assert_close(in_the_open(by_default), 0.5)


def test_a_missing_file_is_named_with_all_others():
    missing = 'Material "conductor" "spectrum eta" "n.spd" "spectrum k" "c.spd"\n'
    with pytest.raises(mlt.FileError, match=r"7: n\.spd: there is no .*c\.spd: there is no"):
        read(VIEW, missing)


def test_a_file_that_is_no_spectrum_is_refused():
    Path("k.spd").write_text("300 3 900")
    with pytest.raises(mlt.SceneError, match=r"^a\.pbrt:7: k\.spd should hold pairs"):
        read(VIEW, 'Material "conductor" "spectrum eta" "eta.spd" "spectrum k" "k.spd"')


def test_names_that_are_not_known_and_textures_of_metals_are_named():
    mlt.write_image("a.exr", np.ones((2, 2, 3), np.float32))
    texture = 'Texture "t" "spectrum" "imagemap" "string filename" "a.exr"\n'
    metal = 'Material "conductor" "spectrum eta" "metal-Xx-eta" "texture k" "t"'
    made = read(VIEW, SKY, texture, metal, WALL)
    assert made.warnings == [
        "the spectrum 'metal-Xx-eta' is not known; it is taken as 1",
        "a texture as 'k' is left out; it is that of copper",
    ]
    assert_close(
        seen(SKY, texture, metal, WALL, spp=4, warnings=2),
        *reflected(1, METALS["Cu"][1]),
    )
