"""Materials of pbrt-v3 files, by closed formulas."""

import math
from pathlib import Path

import numpy as np
import pytest
from pbrt_v3_files import SKY, VIEW, WALL, assert_close, in_the_open, read, seen, written

import pymlt as mlt

FRESNEL = 0.04  #: of the index 1.5, at normal incidence


@pytest.fixture(autouse=True)
def folder(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)


def test_matte_scatters_kd():
    assert_close(in_the_open('Material "matte"'), 0.5)
    assert_close(in_the_open('Material "matte" "color Kd" [ .8 .4 .2 ]'), 0.8, 0.4, 0.2)
    assert_close(in_the_open(""), 0.5)


def test_colours_may_be_xyz():
    """Here of half the white of D65."""
    assert_close(in_the_open('Material "matte" "xyz Kd" [ .47525 .5 .5444 ]'), 0.5, rel=2e-3)


def test_spectra_that_are_no_file_are_named():
    Path("a.spd").write_text("400 .5 # a half\n700 .5")
    assert_close(seen(SKY, 'Material "matte" "spectrum Kd" "a.spd"', WALL), 0.5)
    said = read(VIEW, SKY, 'Material "matte" "spectrum Kd" "half"').warnings
    assert said == ["the spectrum 'half' is not known; it is taken as 1"]


def test_sigma_is_that_of_oren_and_nayar():
    """Seen from above, the factor of Lambert's radiance is their A, for light from anywhere."""
    sun = 'LightSource "distant" "point from" [ 1.7320508 0 1 ] "point to" [ 0 0 0 ]\n'  # at 60 deg
    for degrees in (20, 60):
        sigma2 = math.radians(degrees) ** 2
        a = 1 - sigma2 / (2 * (sigma2 + 0.33))
        found = seen(sun, f'Material "matte" "rgb Kd" [ .6 .6 .6 ] "float sigma" {degrees}', WALL)
        assert_close(found, 0.6 / math.pi * a * 0.5)


SMOOTH = '"bool remaproughness" "false" "float roughness" 0 '


@pytest.mark.parametrize(("kd", "ks"), [(0.25, 0.25), (0.8, 0.5), (0.9, 1), (0, 1), (0.7, 0)])
@pytest.mark.parametrize("kind", ["plastic", "uber"])
def test_plastic_adds_kd_to_what_its_coating_reflects(kind, kd, ks):
    colours = f'"rgb Kd" [ {kd} {kd} {kd} ] "rgb Ks" [ {ks} {ks} {ks} ]'
    assert_close(in_the_open(f'Material "{kind}" {SMOOTH} {colours}', spp=1024), kd + ks * FRESNEL)


def test_plastic_has_its_defaults():
    assert_close(in_the_open(f'Material "plastic" {SMOOTH}'), 0.25 * (1 + FRESNEL))
    made = read(VIEW, 'Material "plastic" ' + WALL).scene["plastic-material"]["bsdf"]
    assert made["bsdf_1"]["alpha"] == pytest.approx(remapped(0.1))


def test_plastic_may_be_textured():
    mlt.write_image("a.exr", np.full((2, 2, 3), 0.9, np.float32))
    texture = 'Texture "a" "color" "imagemap" "string filename" "a.exr"\n'
    found = in_the_open(texture + f'Material "plastic" {SMOOTH} "texture Kd" "a"', spp=1024)
    assert_close(found, 0.9 + 0.25 * FRESNEL)


def remapped(roughness: float) -> float:
    x = math.log(max(roughness, 1e-3))
    return float(np.polyval([0.000640711, 0.0171201, 0.1734, 0.819955, 1.62142], x))


@pytest.mark.parametrize("roughness", [0.0001, 0.01, 0.1, 0.5, 1])
def test_roughness_is_remapped_by_a_polynomial(roughness):
    given = f'"float uroughness" {roughness} "float vroughness" {roughness}'
    for name, kind in {"glass": "glass", "metal": "metal"}.items():
        made = read(VIEW, f'Material "{kind}" {given}').scene[f"{name}-material"]
        assert made.get("bsdf", made)["alpha"] == pytest.approx(remapped(roughness))
        plain = read(VIEW, f'Material "{kind}" {given} "bool remaproughness" "false"')
        made = plain.scene[f"{name}-material"]
        assert made.get("bsdf", made)["alpha"] == pytest.approx(roughness)


@pytest.mark.parametrize("kind", ["plastic", "translucent"])
def test_roughness_along_the_axes_is_for_some_materials(kind):
    said = read(VIEW, SKY, f'Material "{kind}" "float uroughness" .3').warnings
    assert said == [f"Material '{kind}': 'uroughness' is left out"]


def test_metal_may_be_rougher_along_one_axis():
    made = read(VIEW, 'Material "metal" "float roughness" .5 "float vroughness" .1').scene
    found = made["metal-material"]["bsdf"]
    alphas = [found["alpha_u"], found["alpha_v"]]
    assert alphas == pytest.approx([remapped(0.5), remapped(0.1)])


def test_metal_is_copper_by_default_or_has_the_index_of_files():
    made = read(VIEW, 'Material "metal"').scene["metal-material"]["bsdf"]
    assert made["material"] == "Cu"
    assert made["alpha"] == pytest.approx(remapped(0.01))
    Path("n.spd").write_text("# nm, n\n400 2\n700 2\n")
    Path("k.spd").write_text("400 3\n700 3\n")
    files = '"spectrum eta" "n.spd" "spectrum k" "k.spd"'
    metal = f'Material "metal" {SMOOTH} {files}'
    assert_close(in_the_open(metal), (1 + 9) / (9 + 9))  # ((n-1)^2 + k^2) / ((n+1)^2 + k^2)
    Path("k.spd").write_text("400 3 700")
    with pytest.raises(mlt.SceneError, match=r"^a\.pbrt:7: k\.spd should hold pairs"):
        read(VIEW, metal)
    with pytest.raises(mlt.FileError, match=r"^a\.pbrt:7: Au\.spd: there is no such file"):
        read(VIEW, 'Material "metal" "spectrum eta" "Au.spd" "spectrum k" "Au.spd"')


def test_metal_may_have_a_name_of_pbrt_v4_or_a_part_of_an_index():
    names = '"spectrum eta" "metal-Au-eta" "spectrum k" "metal-Au-k"'
    assert (
        read(VIEW, f'Material "metal" {names}').scene["metal-material"]["bsdf"]["material"] == "Au"
    )
    nothing_absorbed = f'Material "metal" {SMOOTH} "rgb eta" [ 2 2 2 ] "rgb k" [ 0 0 0 ]'
    assert_close(in_the_open(nothing_absorbed), 1 / 9)  # ((n - 1) / (n + 1))^2


def test_mirrors_reflect_kr():
    assert_close(in_the_open('Material "mirror"'), 0.9)
    assert_close(in_the_open('Material "mirror" "rgb Kr" [ .1 .2 .3 ]'), 0.1, 0.2, 0.3)


@pytest.mark.parametrize("name", ["index", "eta"])
def test_glass_has_its_index_and_colours(name):
    """With the index 2 a ninth is reflected; light that enters has a quarter of the radiance."""
    reflects = f'"rgb Kr" [ 1 .5 0 ] "rgb Kt" [ 0 0 0 ] "float {name}" 2'
    assert_close(in_the_open(f'Material "glass" {reflects}', spp=4096), 1 / 9, 1 / 18, 0, rel=0.05)
    transmits = f'"rgb Kr" [ 0 0 0 ] "rgb Kt" [ 1 .5 0 ] "float {name}" 2'
    assert_close(in_the_open(f'Material "glass" {transmits}', spp=1024), 2 / 9, 1 / 9, 0)


def test_glass_without_roughness_is_smooth():
    made = read(VIEW, 'Material "glass"\n').scene["glass-material"]
    assert made["type"] == "dielectric"
    made = read(VIEW, 'Material "glass" "float uroughness" .1').scene["glass-material"]
    assert [made["alpha_u"], made["alpha_v"]] == pytest.approx([remapped(0.1), remapped(0)])


def test_uber_lets_light_pass_by_its_opacity():
    sides = 'Material "uber" "rgb Kd" [ .4 .4 .4 ] "rgb Ks" [ 0 0 0 ] "rgb opacity" [ .5 1 0 ]'
    assert_close(in_the_open(sides), 0.5 * 0.4 + 0.5, 0.4, 1)


def test_the_lobes_of_uber_are_added():
    black = '"rgb Kd" [ 0 0 0 ] "rgb Ks" [ 0 0 0 ]'
    assert_close(in_the_open(f'Material "uber" {black}'), 0)
    both = f'Material "uber" "rgb Kd" [ .2 .2 .2 ] "rgb Kr" [ .5 .5 .5 ] {SMOOTH}'
    assert_close(in_the_open(both, spp=1024), 0.2 + (0.25 + 0.5) * FRESNEL)
    clear = f'Material "uber" {black} "rgb Kr" [ 1 1 1 ] "rgb Kt" [ 1 1 1 ]'
    assert_close(in_the_open(clear, spp=4096), FRESNEL + (1 - FRESNEL) / 1.5**2, rel=0.02)


def test_uber_refracts_into_its_inside():
    """Through two parallel walls that reflect nothing, the square of a transmittance passes."""
    glass = 'Material "uber" "rgb Kd" [ 0 0 0 ] "rgb Ks" [ 0 0 0 ] "rgb Kt" [ 1 1 1 ]\n'
    back = "Translate 0 0 -1 ReverseOrientation\n" + WALL
    assert_close(in_the_open(glass + WALL + back + 'Material "matte"'), (1 - FRESNEL) ** 2)


def test_translucent_shares_its_colour_between_both_sides():
    leaf = (
        'Material "translucent" "rgb Kd" [ .6 .6 .6 ] "rgb Ks" [ 0 0 0 ] "rgb reflect" [ .2 .2 .2 ]'
    )
    leaf += '"rgb transmit" [ .7 .7 .7 ]\n'
    assert_close(in_the_open(leaf), 0.9 * 0.6)
    for side, share in ((1, 0.2), (-1, 0.7)):
        sun = f'LightSource "distant" "point from" [ 0 0 {side} ] "point to" [ 0 0 0 ]\n'
        assert_close(seen(sun, leaf, WALL), share * 0.6 / math.pi)


def test_substrate_reflects_ks_at_normal_incidence():
    flat = '"bool remaproughness" "false" "float uroughness" 0 "float vroughness" 0 '
    coat = f'Material "substrate" {flat} "rgb Kd" [ 0 0 0 ] "rgb Ks" [ .3 .15 0 ]'
    assert_close(in_the_open(coat, warnings=1), 0.3, 0.15, 0)
    base = f'Material "substrate" {flat} "rgb Kd" [ .5 .5 .5 ] "rgb Ks" [ 0 0 0 ]'
    assert_close(in_the_open(base, warnings=1), 0.5)


NAMED = """
MakeNamedMaterial "red" "string type" "matte" "rgb Kd" [ 1 0 0 ]
MakeNamedMaterial "blue" "string type" "matte" "rgb Kd" [ 0 0 1 ]
"""
MIX = 'Material "mix" "string namedmaterial1" "red" "string namedmaterial2" "blue" '


def test_the_amount_of_a_mix_is_the_share_of_the_first_material():
    assert_close(in_the_open(NAMED + MIX), 0.5, 0, 0.5)
    assert_close(in_the_open(NAMED + MIX + '"rgb amount" [ .2 .2 .2 ]'), 0.2, 0, 0.8)
    coloured = MIX + '"rgb amount" [ .2 .3 .4 ]'
    assert_close(in_the_open(NAMED + coloured, warnings=1), 0.3, 0, 0.7)


def test_a_mix_without_its_materials_is_refused():
    with pytest.raises(mlt.SceneError, match=r"^a\.pbrt:7: a mix needs the names of two"):
        read(VIEW, MIX)


def test_disney_is_principled():
    given = '"color color" [ .8 .4 .2 ] "float metallic" .3 "float clearcoat" .5 "float eta" 1.4'
    made = read(VIEW, f'Material "disney" {given}')
    assert made.scene["disney-material"]["bsdf"] == {
        "type": "principled",
        "base_color": {"type": "rgb", "value": [0.8, 0.4, 0.2]},
        "eta": 1.4,
        "roughness": 0.5,
        "anisotropic": 0.0,
        "metallic": 0.3,
        "sheen": 0.0,
        "sheen_tint": 0.5,
        "spec_tint": 0.0,
        "clearcoat": 0.5,
        "clearcoat_gloss": 1.0,
    }
    found = read(VIEW, 'Material "disney" "color scatterdistance" [ 1 1 1 ]').warnings
    assert "Material 'disney': 'scatterdistance' is left out" in found


def test_thin_disney_transmits_diffusely():
    leaf = 'Material "disney" "bool thin" "true" "float difftrans" 2 "float roughness" 0'
    sun = 'LightSource "distant" "point from" [ 0 0 -1 ] "point to" [ 0 0 0 ]\n'
    assert_close(
        seen(sun, leaf + ' "color color" [ .6 .3 0 ]', WALL), *np.array([0.6, 0.3, 0]) / math.pi
    )
    for clear in ('"float spectrans" .5', '"bool thin" "true" "float spectrans" .5'):
        assert in_the_open('Material "disney" ' + clear).min() > 0.1


@pytest.mark.parametrize("kind", ["hair", "fourier", "subsurface", "kdsubsurface"])
def test_materials_without_a_counterpart_become_matte(kind):
    made = read(VIEW, f'Material "{kind}" "rgb Kd" [ .1 .2 .3 ]')
    assert f"the material '{kind}' has no counterpart; it becomes matte" in made.warnings
    assert made.scene[f"{kind}-material"]["bsdf"]["reflectance"]["value"] == [0.1, 0.2, 0.3]


def test_bump_maps_are_left_out_by_name():
    bump = 'Texture "b" "float" "constant" "float value" 1\nMaterial "matte" "texture bumpmap" "b"'
    assert read(VIEW, bump, SKY).warnings == ["bump maps are left out"]


def test_a_shape_changes_parameters_of_its_material():
    red = '"rgb Kd" [ .3 0 0 ]'
    assert_close(seen(SKY, 'Material "matte" "rgb Kd" [ .9 .9 .9 ]', WALL, red), 0.3, 0, 0)
    assert_close(seen(SKY, WALL, red), 0.3, 0, 0)
    both = 'Material "matte" "rgb Kd" [ .9 .9 .9 ]' + WALL + red
    assert_close(seen(SKY, both, "Translate 0 0 .5", WALL), 0.9)


def test_a_shape_does_not_change_a_named_material():
    said = 'NamedMaterial "blue"' + WALL + '"rgb Kd" [ .3 0 0 ]'
    assert_close(seen(SKY, NAMED, said, warnings=1), 0, 0, 1)


MATERIALS = ["matte", "plastic", "substrate", "glass", "mirror", "metal", "translucent", "uber"]


@pytest.mark.parametrize("kind", [*MATERIALS, "disney"])
def test_every_material_survives_a_conversion(kind):
    path = written(VIEW, SKY, f'Material "{kind}"', WALL)
    mlt.convert(path, "b.xml")
    with pytest.warns() if kind == "substrate" else pytest.MonkeyPatch.context():
        images = [mlt.render(mlt.load(name), "path", spp=4, seed=1) for name in (path, "b.xml")]
    np.testing.assert_array_equal(*images)
    assert images[0].min() > 0
