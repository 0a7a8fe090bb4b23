"""Cryptomattes: ids and coverages are those of closed forms; files are what compositors read."""

import json
import struct

import numpy as np
import pytest
from command_line import PYMLT, mlt_render, run
from test_alpha import GREY, ROWS, SIZE, by_rows, card, glowing, scene

import pymlt as mlt

BOTH = "cryptomatte_object,cryptomatte_material"
#: Psyop's own values, in the tests of its plug-in for Nuke.
HASHES = {
    "hello": 6.0705627102400005616e-17,
    "cube": -4.08461912519e15,
    "sphere": 2.79018604383e15,
    "plane": 3.66557617593e-11,
    "равнина": -1.3192631212399999468e-25,
    "mädchen": 6.2361298211599995797e25,
}
RED = GREY | {"reflectance": {"type": "rgb", "value": [0.8, 0.2, 0.2]}}


def mattes(described, aovs=BOTH, integrator="path", **options) -> mlt.Result:
    return mlt.start(described, integrator, **({"spp": 1, "aovs": aovs} | options)).result()


def halves(**parts) -> dict:
    """Two cards, of which `near` hides all but the upper row and a half of `far`."""
    return scene(near=glowing(), far=card(top=3, z=-1), **parts)


def crossed(film=None) -> dict:
    """Many small cards before and beside each other, of two materials, over nothing."""
    cards = {}
    for i in range(12):
        place = mlt.Transform().translate([i / 8 - 0.7, (i * 5 % 7) / 5 - 0.6, -i / 9])
        bsdf = {"type": "ref", "id": "grey" if i % 2 else "red"}
        shape = {"type": "rectangle", "to_world": place.scale([0.3, 0.4, 1]), "bsdf": bsdf}
        cards[f"card {i}"] = shape
    lamp = {"type": "point", "position": [0, 0, 1], "intensity": 1.0}
    return scene(film or {"width": 48, "height": 40}, grey=GREY, red=RED, lamp=lamp, **cards)


def sum_of_mattes(result, layer) -> np.ndarray:
    names = mlt.cryptomatte.names(result, layer)
    return np.sum([mlt.cryptomatte.matte(result, name, layer) for name in names], axis=0)


# ---- what they hold


def test_a_card_covers_half_of_a_row():
    found = mattes(halves())
    np.testing.assert_array_equal(mlt.cryptomatte.matte(found, "near"), by_rows(ROWS))
    np.testing.assert_array_equal(mlt.cryptomatte.matte(found, "far"), by_rows(1 - ROWS))
    assert mlt.cryptomatte.names(found, "cryptomatte_object") == ["far", "near"]
    first = found.layers["cryptomatte_object00"]
    assert first.dtype == np.float32
    assert first.shape == (SIZE, SIZE, 4)
    np.testing.assert_array_equal(first[..., 1], np.maximum(by_rows(ROWS), by_rows(1 - ROWS)))
    assert not found.layers["cryptomatte_object02"].any()


def test_ids_are_those_of_the_specification():
    shapes = {name: card(z=-number) for number, name in enumerate(HASHES)}
    found = mattes(scene(**shapes, lamp=glowing(z=-9)))
    (key,) = [key for key, text in found.metadata.items() if text == "cryptomatte_object"]
    about = key.removesuffix("name")
    assert found.metadata[f"{about}hash"] == "MurmurHash3_32"
    assert found.metadata[f"{about}conversion"] == "uint32_to_float32"
    manifest = json.loads(found.metadata[f"{about}manifest"])
    for name, value in HASHES.items():
        assert struct.unpack(">f", bytes.fromhex(manifest[name]))[0] == np.float32(value)
    assert found.layers["cryptomatte_object00"][3, 0, 0] == np.float32(HASHES["hello"])


@pytest.mark.parametrize(
    ("name", "key"),
    [("CryptoObject", "3ae39a5"), ("crypto_object", "f834d0a"), ("crypto_material", "bda530a")],
)
def test_metadata_are_found_by_the_hash_of_their_name(name, key):
    found = mattes(halves(), f"{name}:cryptomatte_object").metadata
    assert found[f"cryptomatte/{key}/name"] == name


@pytest.mark.parametrize("filter", ["box", "tent", "gaussian", "mitchell", "lanczos"])
@pytest.mark.parametrize("layer", BOTH.split(","))
def test_all_mattes_together_are_alpha(filter, layer):
    described = crossed({"width": 48, "height": 40, "rfilter": {"type": filter}})
    found = mattes(described, f"{layer}/24", alpha=True)
    np.testing.assert_allclose(sum_of_mattes(found, layer), found.alpha, atol=1e-6)
    for first, second in (("00", "01"), ("01", "02")):
        ranks = [found.layers[layer + number] for number in (first, second)]
        assert (ranks[0][..., 1] >= ranks[0][..., 3]).all()
        assert (ranks[0][..., 3] >= ranks[1][..., 1]).all()
    assert (found.layers[f"{layer}00"][..., 1::2] >= 0).all()


def test_what_lies_behind_masks_counts_by_what_is_seen_of_it():
    quarter = {"type": "mask", "opacity": 0.25, "bsdf": GREY}
    found = mattes(scene(mask=card(top=3, bsdf=quarter), void=card(bsdf={"type": "null"}, z=-1),
                         far=glowing(z=-2)))  # fmt: skip
    np.testing.assert_allclose(mlt.cryptomatte.matte(found, "mask"), by_rows([0.25] * 4))
    np.testing.assert_allclose(mlt.cryptomatte.matte(found, "far"), by_rows(0.75 * ROWS))
    assert not mlt.cryptomatte.matte(found, "void").any()


def test_shapes_of_one_material_have_one_matte():
    described = halves(paint=GREY)
    for name in ("near", "far"):
        described[name]["bsdf"] = {"type": "ref", "id": "paint"}
    found = mattes(described)
    np.testing.assert_array_equal(mlt.cryptomatte.matte(found, "paint"), np.ones((SIZE, SIZE)))
    del described["far"]["bsdf"]
    found = mattes(described)
    np.testing.assert_array_equal(mlt.cryptomatte.matte(found, "paint"), by_rows(ROWS))
    np.testing.assert_array_equal(mlt.cryptomatte.matte(found, "default"), by_rows(1 - ROWS))


def test_instances_have_names_and_the_materials_of_their_group():
    left, right = (mlt.Transform().translate([x, 0, 0]) for x in (-1, 1))
    red = card(top=9, bsdf={"type": "ref", "id": "red"})
    red["to_world"] = mlt.Transform().scale([1, 9, 1])
    group = {"type": "ref", "id": "group"}
    described = scene(
        red=RED,
        group={"type": "shapegroup", "member": red},
        left={"type": "instance", "group": group, "to_world": left},
        right={"type": "instance", "group": group, "to_world": right},
        lamp=glowing(z=-9),
    )
    found = mattes(described)
    is_left = np.arange(SIZE) < SIZE / 2 + np.zeros((SIZE, 1))
    np.testing.assert_array_equal(mlt.cryptomatte.matte(found, "left"), is_left)
    np.testing.assert_array_equal(mlt.cryptomatte.matte(found, "right"), ~is_left)
    np.testing.assert_array_equal(mlt.cryptomatte.matte(found, "red"), np.ones((SIZE, SIZE)))
    assert "member" not in mlt.cryptomatte.names(found)


def test_names_are_those_of_the_parameters():
    described = mlt.load_string(
        """<scene version="3.0.0"><shape type="sphere"/><shape type="sphere">
        <bsdf type="diffuse"/></shape><emitter type="constant"/>
        <sensor type="perspective"/></scene>"""
    )
    found = mattes(described)
    assert mlt.cryptomatte.names(found, "cryptomatte_object") == ["shape", "shape_1"]
    assert mlt.cryptomatte.names(found, "cryptomatte_material") == ["default", "shape_1.bsdf"]
    parameters = mlt.traverse(described)
    assert "shape_1.bsdf.reflectance" in parameters
    parameters["shape_1.bsdf.reflectance"] = 0.25
    changed = mattes(parameters.update())
    assert mlt.cryptomatte.names(changed) == mlt.cryptomatte.names(found)


def test_a_shape_that_moves_is_seen_in_part():
    """A card of which the upper edge falls by the height of the image."""
    described = scene(falls=card(bsdf={"type": "ref", "id": "red"}), red=RED, lamp=glowing(z=-1))
    places = {"0": card(top=1)["to_world"], "1": card(top=-1)["to_world"]}
    described["falls"]["to_world"] = {"type": "animation"} | places
    described["sensor"]["shutter_close"] = 1.0
    found = mattes(described, alpha=True)
    expected = by_rows([1 / 8, 3 / 8, 5 / 8, 7 / 8])
    for name in ("falls", "red"):
        np.testing.assert_allclose(mlt.cryptomatte.matte(found, name), expected, atol=0.05)
    for layer in BOTH.split(","):
        np.testing.assert_allclose(sum_of_mattes(found, layer), found.alpha, rtol=1e-6)


def test_nothing_but_the_scene_and_the_seed_decides(tmp_path):
    expected = mattes(crossed(), threads=1, seed=3)
    job = mlt.start(crossed(), "pssmlt", spp=1, aovs=BOTH, seed=3, threads=2)
    job.checkpoint(tmp_path / "render.mlt")
    resumed = mlt.resume(tmp_path / "render.mlt", scene=crossed(), aovs=BOTH).result()
    other = mattes(crossed(), seed=4)
    for found in (job.result(), resumed):
        for name in ("cryptomatte_object00", "cryptomatte_material02"):
            np.testing.assert_array_equal(found.layers[name], expected.layers[name])
        assert mlt.cryptomatte.names(found) == mlt.cryptomatte.names(expected)
    changed = other.layers["cryptomatte_object00"] != expected.layers["cryptomatte_object00"]
    assert changed[..., 1].any()


def test_levels_are_as_many_as_are_asked_for():
    found = mattes(halves(), "few:cryptomatte_object/1, many:cryptomatte_object/9").layers
    assert sorted(name for name in found if name.startswith("few")) == ["few00"]
    assert sorted(name for name in found if name.startswith("many")) == [
        f"many0{number}" for number in range(5)
    ]


def test_an_image_of_a_cryptomatte_alone_is_no_mean_of_ids():
    dark = scene(near=card())
    found = mlt.start(dark, {"type": "aov", "aovs": "cryptomatte_object"}, spp=64).result()
    np.testing.assert_allclose(found.image, by_rows(ROWS)[..., None] * np.ones(3), rtol=1e-6)
    np.testing.assert_array_equal(mlt.cryptomatte.matte(found, "near"), by_rows(ROWS))


@pytest.mark.parametrize(
    ("aovs", "said"),
    [
        ("depth/3", "have a number"),
        ("cryptomatte_object/0", "from 1 to 100"),
        ("cryptomatte_object/x", "from 1 to 100"),
        ("cryptomatte_object,cryptomatte_object00:depth", "asked for twice"),
        ("cryptomatte_objects", "did you mean"),
    ],
)
def test_mistakes_are_named(aovs, said):
    with pytest.raises(mlt.UsageError, match=said):
        mattes(halves(), aovs)


# ---- files


@pytest.mark.parametrize("samples", ["float16", "float32"])
def test_files_have_floats_and_metadata(samples, tmp_path):
    OpenImageIO = pytest.importorskip("OpenImageIO")
    described = scene({"component_format": samples, "rfilter": {"type": "box"}}, near=glowing())
    found = mattes(described)
    found.save(tmp_path / "a.exr")
    file = OpenImageIO.ImageInput.open(str(tmp_path / "a.exr"))
    spec = file.spec()
    types = dict(zip(spec.channelnames, spec.channelformats or [spec.format] * 99, strict=False))
    assert str(types["R"]) == {"float16": "half", "float32": "float"}[samples]
    pixels = file.read_image("float")
    for channel in "RGBA":
        name = f"cryptomatte_object00.{channel}"
        assert str(types[name]) == "float"
        np.testing.assert_array_equal(
            pixels[..., spec.channelnames.index(name)],
            found.layers["cryptomatte_object00"][..., "RGBA".index(channel)],
        )
    for name, text in found.metadata.items():
        if name.startswith("cryptomatte/"):
            assert spec.getattribute(name) == text
    assert mlt.cryptomatte.names(tmp_path / "a.exr") == mlt.cryptomatte.names(found)
    np.testing.assert_array_equal(mlt.cryptomatte.matte(tmp_path / "a.exr", "near"), by_rows(ROWS))


def test_both_command_lines_write_them(tmp_path):
    mlt.convert(halves(), tmp_path / "halves.xml")
    for command, name in (([*PYMLT, "render"], "p.exr"), (mlt_render(), "m.exr")):
        flags = ["--integrator", "path", "--spp", "1", "--aov", BOTH, "-o", tmp_path / name]
        outcome = run(command, tmp_path / "halves.xml", *flags)
        assert outcome.returncode == 0, outcome.stderr
    assert mlt.cryptomatte.names(tmp_path / "p.exr") == mlt.cryptomatte.names(tmp_path / "m.exr")
    for name in ("p.exr", "m.exr"):
        np.testing.assert_array_equal(mlt.cryptomatte.matte(tmp_path / name, "near"), by_rows(ROWS))


def test_merged_images_have_the_mattes_of_the_first(tmp_path):
    parts = [mattes(crossed(), seed=seed) for seed in (1, 2)]
    for part in parts:
        part.save(tmp_path / f"{part.seed}.exr")
    merged = mlt.merge([tmp_path / "1.exr", tmp_path / "2.exr"])
    for name in ("cryptomatte_object00", "cryptomatte_material02"):
        np.testing.assert_array_equal(merged.layers[name], parts[0].layers[name])
    merged.save(tmp_path / "merged.exr")
    np.testing.assert_array_equal(
        mlt.cryptomatte.matte(tmp_path / "merged.exr", "card 3"),
        mlt.cryptomatte.matte(parts[0], "card 3"),
    )


def test_denoised_images_keep_their_mattes():
    pytest.importorskip("pyoidn", reason="needs pymlt[denoise]")
    found = mattes(halves())
    clean = found.denoise()
    np.testing.assert_array_equal(mlt.cryptomatte.matte(clean, "near"), by_rows(ROWS))


def test_what_has_no_matte_is_said(tmp_path):
    found = mattes(halves(), "cryptomatte_object")
    with pytest.raises(mlt.UsageError, match="no matte of 'door'; there are: far, near"):
        mlt.cryptomatte.matte(found, "door")
    with pytest.raises(mlt.UsageError, match="no Cryptomatte 'x'; there are: cryptomatte_object"):
        mlt.cryptomatte.matte(found, "near", "x")
    mlt.write_image(tmp_path / "plain.exr", found.image)
    with pytest.raises(mlt.UsageError, match="there is no Cryptomatte"):
        mlt.cryptomatte.names(tmp_path / "plain.exr")


@pytest.mark.parametrize(
    "manifest", ["", "[]", "{", '{"near": 3}', '{"near": "x"}', '{"near": "-1"}']
)
def test_a_file_with_another_manifest_is_refused(manifest, tmp_path):
    found = mattes(halves(), "cryptomatte_object")
    (key,) = (key for key in found.metadata if key.endswith("/manifest"))
    found.metadata[key] = manifest
    found.save(tmp_path / "a.exr")
    for source in (found, tmp_path / "a.exr"):
        with pytest.raises(mlt.FileError, match="manifest"):
            mlt.cryptomatte.matte(source, "near")


def test_layers_that_are_missing_are_said():
    found = mattes(halves(), "cryptomatte_object")
    found.layers.clear()
    with pytest.raises(mlt.UsageError, match="'cryptomatte_object' are missing"):
        mlt.cryptomatte.matte(found, "near")


def test_files_of_other_renderers_are_read(tmp_path):
    """A pixel of which `cube` covers a half, `plane` a quarter, and another object the rest."""
    OpenImageIO = pytest.importorskip("OpenImageIO")
    ranks = [HASHES["cube"], 0.5, HASHES["plane"], 0.25, 1.5, 0.25, 0, 0]
    spec = OpenImageIO.ImageSpec(1, 1, 3 + len(ranks), "float")
    spec.channelnames = ["R", "G", "B"] + [f"Asset0{i}.{c}" for i in (0, 1) for c in "RGBA"]
    manifest = {
        name: struct.pack(">f", np.float32(HASHES[name])).hex() for name in ("cube", "plane")
    }
    about = {"name": "Asset", "hash": "MurmurHash3_32", "conversion": "uint32_to_float32"}
    for key, text in (about | {"manifest": json.dumps(manifest)}).items():
        spec.attribute(f"cryptomatte/0123456/{key}", text)
    file = OpenImageIO.ImageOutput.create(str(tmp_path / "a.exr"))
    assert file.open(str(tmp_path / "a.exr"), spec)
    file.write_image(np.array([[[1, 1, 1, *ranks]]], np.float32))
    file.close()
    assert mlt.cryptomatte.names(tmp_path / "a.exr") == ["cube", "plane"]
    for name, coverage in (("cube", 0.5), ("plane", 0.25)):
        assert mlt.cryptomatte.matte(tmp_path / "a.exr", name) == coverage
