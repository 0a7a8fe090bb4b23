"""Materials and textures of pbrt-v4 files, by what a wall of them scatters."""

import math

import numpy as np
import pytest
from pbrt_v3_files import SKY, assert_close, read
from pbrt_v4_files import VIEW, WALL, in_the_open, seen

import pymlt as mlt

#: What is stored as .5 in an image of bytes, in linear light.
DECODED = ((0.5 + 0.055) / 1.055) ** 2.4


@pytest.fixture(autouse=True)
def folder(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)


# ---- diffuse transmission ------------------------------------------------------------------------

LEAVES = {  # parameters, and what is reflected and transmitted
    "": (0.25, 0.25),
    '"rgb reflectance" [ .8 .4 .2 ] "rgb transmittance" [ .1 .3 .5 ]': (
        [0.8, 0.4, 0.2],
        [0.1, 0.3, 0.5],
    ),
    '"rgb reflectance" [ .5 .4 .1 ] "float scale" 3': ([1, 1, 0.3], 0.75),
    '"spectrum reflectance" [ 300 .6 900 .6 ] "float scale" 2': (1, 0.5),
    '"rgb reflectance" [ 0 0 0 ]': (0, 0.25),
    '"rgb transmittance" [ 0 0 0 ]': (0.25, 0),
    '"texture transmittance" "t"': (0.25, [0.4, 0.2, 0.1]),
}


@pytest.mark.parametrize("parameters", LEAVES)
@pytest.mark.parametrize("side", [0, 1])
def test_a_leaf_reflects_and_transmits_evenly(parameters, side):
    mlt.write_image("a.exr", np.full((2, 2, 3), [0.4, 0.2, 0.1], np.float32))
    texture = 'Texture "t" "spectrum" "imagemap" "string filename" "a.exr"\n'
    sun = f'LightSource "distant" "point3 from" [ 0 0 {1 - 2 * side} ] "point3 to" [ 0 0 0 ]\n'
    leaf = f'Material "diffusetransmission" {parameters}\n'
    expected = np.multiply(LEAVES[parameters][side], 1 / math.pi)
    np.testing.assert_allclose(
        seen(texture, sun, leaf, WALL), np.broadcast_to(expected, 3), rtol=0.02, atol=1e-6
    )


def test_a_leaf_below_an_even_sky_shows_the_sum_of_both():
    leaf = 'Material "diffusetransmission" "rgb reflectance" [ .6 .6 .6 ] "float scale" 2'
    assert_close(in_the_open(leaf, spp=1024), 1 + 0.5)


# ---- textures ------------------------------------------------------------------------------------


def texture(kind: str, parameters: str, before: str = "") -> str:
    surface = 'Material "diffuse" "texture reflectance" "t"'
    return f'{before}Texture "t" "spectrum" "{kind}" {parameters}\n{surface}'


IMAGES = {  # of the stored value .5, and .25 in floats
    ("a.exr", '"float scale" 3'): 0.75,
    ("a.exr", '"bool invert" true'): 0.75,
    ("a.exr", '"bool invert" true "float scale" 3'): 0.25,
    ("a.exr", '"bool invert" true "float scale" 5'): 0,
    ("a.exr", '"string encoding" "gamma 2"'): 0.25,
    ("a.png", ""): DECODED,
    ("a.png", '"bool invert" true'): 1 - DECODED,
    ("a.png", '"bool invert" true "string encoding" "linear"'): 0.5,
    ("a.png", '"bool invert" true "string encoding" "gamma 2"'): 0.75,
    ("a.png", '"string encoding" "gamma 2"'): 0.25,
    ("a.png", '"string encoding" "linear"'): 0.5,
}


@pytest.mark.parametrize(("name", "parameters"), IMAGES)
def test_images_are_decoded_scaled_and_inverted(name, parameters):
    mlt.write_image("a.exr", np.full((2, 2, 3), 0.25, np.float32))
    mlt.write_image("a.png", np.full((2, 2, 3), DECODED, np.float32))
    text = texture("imagemap", f'"string filename" "{name}" {parameters}')
    np.testing.assert_allclose(
        in_the_open(text), np.full(3, IMAGES[name, parameters]), rtol=0.02, atol=1e-6
    )


def test_an_inverted_image_stays_where_it_is():
    pixels = np.zeros((2, 2, 3), np.float32)
    pixels[0, 0] = 1
    mlt.write_image("a.exr", pixels)
    text = texture(
        "imagemap", '"string filename" "a.exr" "bool invert" true "float udelta" 1.25 '
        '"float uscale" 0 "float vscale" 0 "float vdelta" %s',
    )  # fmt: skip
    assert_close(in_the_open(text % ".75"), 0)
    assert_close(in_the_open(text % ".25"), 1)


def test_a_black_border_is_inverted_to_white():
    mlt.write_image("a.exr", np.ones((2, 2, 3), np.float32))
    image = '"string filename" "a.exr" "bool invert" true "string wrap" "black"'
    assert_close(in_the_open(texture("imagemap", f'{image} "float udelta" 3')), 1)


IMAGE = 'Texture "i" "spectrum" "imagemap" "string filename" "a.exr"\n'
GREY = 'Texture "a" "float" "imagemap" "string filename" "a.exr"\n'
SCALED = IMAGE + 'Texture "s" "spectrum" "scale" "texture tex" "i" "float scale" .5\n'
BOARD = 'Texture "b" "spectrum" "checkerboard" "rgb tex1" [ .8 0 0 ] "rgb tex2" [ .8 0 0 ]\n'
MIXTURES = {  # of an image of .6, .3 and .3, whose mean is .4
    ("", ""): 0.5,
    ("", '"rgb tex1" [ 1 0 0 ] "rgb tex2" [ 0 1 0 ] "float amount" .2'): [0.8, 0.2, 0],
    (IMAGE, '"texture tex1" "i" "rgb tex2" [ 0 1 0 ] "float amount" .5'): [0.3, 0.65, 0.15],
    (IMAGE, '"rgb tex1" [ 0 1 0 ] "texture tex2" "i" "float amount" .2'): [0.12, 0.86, 0.06],
    (GREY, '"rgb tex1" [ 1 0 0 ] "rgb tex2" [ 0 1 .5 ] "texture amount" "a"'): [0.6, 0.4, 0.2],
    (SCALED, '"texture tex1" "s" "rgb tex2" [ 0 1 0 ]'): [0.15, 0.575, 0.075],
    (BOARD, '"texture tex1" "b" "rgb tex2" [ 0 1 0 ]'): [0.4, 0.5, 0],
}


@pytest.mark.parametrize(("before", "parameters"), MIXTURES)
def test_a_mix_is_linear_in_its_amount(before, parameters):
    mlt.write_image("a.exr", np.full((2, 2, 3), [0.6, 0.3, 0.3], np.float32))
    found = in_the_open(texture("mix", parameters, before))
    expected = np.broadcast_to(MIXTURES[before, parameters], 3)
    np.testing.assert_allclose(found, expected, rtol=0.02, atol=1e-6)


@pytest.mark.parametrize("amount", ['"float amount" .2', '"texture amount" "i"'])
def test_two_images_are_mixed_also_by_one_of_them(amount):
    """Images that are an amount have the mean of their colours."""
    first, second = np.array([0.6, 0.1, 0.2]), np.array([0.1, 0.3, 0.4])
    mlt.write_image("a.exr", np.full((2, 2, 3), first, np.float32))
    mlt.write_image("b.exr", np.full((2, 3, 3), second, np.float32))
    other = IMAGE.replace('"i"', '"j"').replace("a.exr", "b.exr")
    both = f'"texture tex1" "i" "texture tex2" "j" {amount}'
    share = 0.2 if "float" in amount else first.mean()
    expected = (1 - share) * first + share * second
    assert_close(in_the_open(texture("mix", both, IMAGE + other)), *expected)


def test_two_images_are_multiplied():
    mlt.write_image("a.exr", np.full((2, 2, 3), [0.6, 0.1, 0.2], np.float32))
    both = '"texture tex" "i" "texture scale" "i"'
    assert_close(in_the_open(texture("scale", both, IMAGE)), 0.36, 0.01, 0.04)


def test_a_missing_image_of_a_mixture_is_named():
    text = texture("mix", '"texture tex1" "i"', IMAGE)
    with pytest.raises(mlt.FileError, match=r"a\.exr: there is no such file"):
        read(VIEW, SKY, text, WALL)


# ---- what is left out ----------------------------------------------------------------------------


def test_displacement_and_edge_lengths_are_left_out_by_name():
    shape = WALL + '"texture displacement" "d" "float edgelength" .1'
    texture = 'Texture "d" "float" "constant"\n'
    assert read(VIEW, SKY, texture, shape).warnings == [
        "Shape 'trianglemesh': 'displacement' is left out",
        "Shape 'trianglemesh': 'edgelength' is left out",
    ]
