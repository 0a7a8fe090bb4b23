"""Layers of light: of each lamp, and of classes of paths."""

import subprocess

import numpy as np
import pytest

import pymlt as mlt
from pymlt.cli import main
from pymlt.images import read_with_layers

#: Radiance or intensity of the lamps.
LAMPS = {"ceiling": "4 3 2", "key": "2 2 6", "": "0.3 0.5 0.3"}

#: Paths are few and short, so that renders are alike but for what is tested.
EASY = {"max_depth": 5, "waves": False}
METROPOLIS = {**EASY, "luminance_samples": 4096, "chains": 16}
INTEGRATORS = {
    "path": mlt.Path(**EASY),
    "bdpt": mlt.BDPT(**EASY),
    "ptracer": mlt.PTracer(**EASY),
    "direct": mlt.Direct(emitter_samples=2, bsdf_samples=1, waves=False),
    "mlt": mlt.MLT(**METROPOLIS),
    "mlt with direct samples": mlt.MLT(direct_samples=16, **METROPOLIS),
    "erpt": mlt.ERPT(**METROPOLIS),
    "pssmlt": mlt.PSSMLT(**METROPOLIS),
    "pssmlt over bdpt": mlt.PSSMLT(estimator="bdpt", **METROPOLIS),
    "mmlt": mlt.MMLT(**METROPOLIS),
    "rjmlt": mlt.RJMLT(**METROPOLIS),
}


def xml(lit=tuple(LAMPS), more=""):
    """A glass ball in the light of a lamp whose shape has an id, of one with an id of its own, and
    of one without; those that are not `lit` are dark."""

    def light(kind, name, id=""):
        return (
            f'<emitter type="{kind}" {id}><rgb name="radiance" value="{LAMPS[name]}"/></emitter>'
            if name in lit
            else ""
        )

    return f"""
    <scene version="3.0.0">
      <sensor type="perspective">
        <float name="fov" value="40"/>
        <transform name="to_world">
          <lookat origin="0, 1, 4" target="0, 0.6, 0" up="0, 1, 0"/>
        </transform>
        <film type="hdrfilm">
          <integer name="width" value="24"/><integer name="height" value="16"/>
          <string name="component_format" value="float32"/><rfilter type="tent"/>
        </film>
      </sensor>
      <bsdf type="diffuse" id="grey"/>
      <shape type="rectangle">
        <transform name="to_world"><scale value="3"/><translate z="-2"/></transform>
        <ref id="grey"/>
      </shape>
      <shape type="rectangle">
        <transform name="to_world"><rotate x="1" angle="-90"/><scale value="3"/></transform>
        <bsdf type="diffuse"><rgb name="reflectance" value="0.7, 0.4, 0.2"/></bsdf>
      </shape>
      <shape type="sphere">
        <point name="center" x="0" y="0.6" z="0"/><float name="radius" value="0.5"/>
        <bsdf type="dielectric"/>
      </shape>
      <shape type="rectangle" id="ceiling">
        <transform name="to_world"><rotate x="1" angle="90"/><translate y="3"/></transform>
        <ref id="grey"/>{light("area", "ceiling")}
      </shape>
      <shape type="rectangle" id="unnamed">
        <transform name="to_world"><rotate y="1" angle="70"/><translate x="-2.5" y="1"/></transform>
        <ref id="grey"/>{light("area", "key", 'id="key light"')}
      </shape>
      {light("constant", "")}
      {more}
    </scene>"""


#: Lets light pass as it is, in half of its strength.
GLASS_PANE = """
  <shape type="rectangle">
    <transform name="to_world"><scale value="0.6"/><translate y="0.6" z="1.2"/></transform>
    <bsdf type="mask"><float name="opacity" value="0.5"/><ref id="grey"/></bsdf>
  </shape>"""


@pytest.fixture(scope="module")
def scene():
    return mlt.load_string(xml())


NAMES = ["light.ceiling", "light.key_light", "light.rest"]


def result(scene, integrator, spp=64.0, seed=1, **options):
    return mlt.start(scene, integrator, spp=spp, seed=seed, **options).result()


def sum_of(layers):
    total = layers[0].copy()
    for layer in layers[1:]:
        total += layer
    return total


IN_WAVES = {
    "path in waves": mlt.Path(max_depth=5),
    "bdpt in waves": mlt.BDPT(max_depth=5),
    "mlt in waves": mlt.MLT(**{**METROPOLIS, "waves": True}),
}
ALL = INTEGRATORS | IN_WAVES


@pytest.mark.parametrize("integrator", ALL.values(), ids=ALL)
def test_the_layers_of_lamps_add_up_to_the_image(scene, integrator):
    """Bit for bit; the image is that of a render without layers, but for rounding."""
    layered = result(scene, integrator, light_groups=True)
    assert layered.metadata["light_groups"].split() == NAMES
    layers = [layered.layers[name] for name in NAMES]
    assert np.array_equal(sum_of(layers), layered.image)
    assert all(layer.max() > 0 for layer in layers)
    plain = result(scene, integrator)
    near_zero = 1e-5 * float(plain.image.mean())
    np.testing.assert_allclose(layered.image, plain.image, rtol=1e-5, atol=near_zero)
    assert "light_groups" not in plain.metadata
    assert not any(name.startswith(("light.", "error.")) for name in plain.layers)


@pytest.mark.parametrize("integrator", [mlt.Path, mlt.BDPT])
@pytest.mark.parametrize("lit", [xml(), xml(more=GLASS_PANE)], ids=["plain", "behind glass"])
def test_waves_keep_lamps_apart_as_single_samples_do(integrator, lit):
    scene = mlt.load_string(lit)
    one, many = (
        result(scene, integrator(max_depth=5, waves=waves), light_groups=True)
        for waves in (False, True)
    )
    for name in NAMES:
        difference = abs(one.layers[name] - many.layers[name])
        assert difference.mean() < 2e-3 * one.layers[name].mean()


@pytest.mark.parametrize("integrator", INTEGRATORS.values(), ids=INTEGRATORS)
def test_classes_that_exclude_each_other_add_up_to_the_image(scene, integrator):
    classes = {"specular": "L.*S.*E", "direct": "L[DM]?E", "rest": "L[DM]{2,}E"}
    layered = result(scene, integrator, light_layers=classes)
    layers = [layered.layers[name] for name in classes]
    near_zero = 1e-5 * float(layered.image.mean())
    np.testing.assert_allclose(sum_of(layers), layered.image, rtol=1e-5, atol=near_zero)
    # the integrator `direct` finds no others
    empty = [name for name in classes if layered.layers[name].max() == 0]
    assert empty == (["rest"] if integrator.name == "direct" else [])
    assert "light_groups" not in layered.metadata


def blocks(image, size=4):
    height, width = (n // size for n in image.shape[:2])
    cut = image.reshape(height, size, width, size, 3).astype(float)
    return cut.mean(axis=(1, 3)).ravel()


@pytest.mark.parametrize("integrator", ["path", "bdpt", "mlt", "pssmlt over bdpt", "mmlt"])
@pytest.mark.parametrize("lamp", LAMPS)
def test_a_layer_is_what_a_render_with_this_lamp_alone_shows(scene, integrator, lamp):
    """Means of blocks, by Student's t over eight seeds with 14 degrees of freedom.

    Among 72 blocks and channels one exceeds 9 with a probability of 2e-5. Blocks that are wrong by
    a fifth are found: their standard error is 2 % in the mean.
    """
    name = dict(zip(LAMPS, NAMES, strict=True))[lamp]
    alone = mlt.load_string(xml(lit=(lamp,)))
    seeds = range(1, 9)
    ours, theirs = (
        np.array([blocks(image) for image in images])
        for images in (
            [
                result(scene, INTEGRATORS[integrator], 16, seed, light_groups=True).layers[name]
                for seed in seeds
            ],
            [result(alone, INTEGRATORS[integrator], 16, seed + 8).image for seed in seeds],
        )
    )
    error = np.sqrt((ours.var(axis=0, ddof=1) + theirs.var(axis=0, ddof=1)) / len(seeds))
    difference = ours.mean(axis=0) - theirs.mean(axis=0)
    assert np.median(error) < 0.05 * theirs.mean()
    assert np.abs(difference / np.maximum(error, 1e-9)).max() < 9


def test_direct_light_is_that_of_a_render_with_one_reflection(scene):
    layered = result(scene, INTEGRATORS["path"], light_layers={"direct": "L(D|S)E"})
    direct = result(scene, mlt.Path(max_depth=2, hide_emitters=True, waves=False))
    np.testing.assert_allclose(layered.layers["direct"], direct.image, rtol=1e-5, atol=1e-7)


def test_places_in_media_are_m():
    fog = """
      <shape type="sphere">
        <point name="center" x="1.2" y="0.6" z="0"/><float name="radius" value="0.5"/>
        <bsdf type="null"/>
        <medium name="interior" type="homogeneous">
          <rgb name="sigma_t" value="2 2 2"/><rgb name="albedo" value="0.8 0.8 0.8"/>
        </medium>
      </shape>"""
    scene = mlt.load_string(xml(more=fog))
    classes = {"seen": "LE", "fog": "LME", "surfaces": "L[DS]E"}
    layered = result(scene, mlt.Path(max_depth=2), light_layers=classes)
    layers = [layered.layers[name] for name in classes]
    near_zero = 1e-5 * float(layered.image.mean())
    np.testing.assert_allclose(sum_of(layers), layered.image, rtol=1e-5, atol=near_zero)
    left, right = np.hsplit(layered.layers["fog"], 2)
    assert right.sum() > 0 == left.sum()


@pytest.mark.parametrize("integrator", INTEGRATORS.values(), ids=INTEGRATORS)
def test_a_resumed_render_has_the_same_layers(scene, integrator, tmp_path):
    asked = {"light_groups": True, "light_layers": {"caustics": "LS+DE"}}
    file = tmp_path / "half.mlt"
    result(scene, integrator, 4, checkpoint=file, threads=1, **asked)
    resumed = mlt.resume(file, scene=scene, spp=9).result()
    whole = result(scene, integrator, 9, threads=2, **asked)
    assert np.array_equal(resumed.image, whole.image)
    for name in [*NAMES, "caustics", "error.light.ceiling"]:
        assert np.array_equal(resumed.layers[name], whole.layers[name]), name


def test_the_layer_of_a_lamp_has_its_own_error(scene):
    """Of lamps that shine alone on a pixel it is that of the image, of others less."""
    layered = result(scene, INTEGRATORS["path"], 64, light_groups=True)
    errors = [layered.layers[f"error.{name}"] for name in NAMES]
    assert all((error > 0).any() for error in errors)
    one = mlt.load_string(xml(lit=("key",)))
    alone = result(one, INTEGRATORS["path"], 64, light_groups=True)
    assert np.array_equal(alone.layers["error.light.key_light"], alone.layers["error"])


def test_files_have_the_layers(program, tmp_path):
    (tmp_path / "scene.xml").write_text(xml())
    file = tmp_path / "image.exr"
    command = [*program, str(tmp_path / "scene.xml"), "--integrator", "path", "--spp", "32"]
    layers = ["--light-groups", "--layer", "caustics=LS+DE", "--layer", "one=L.E"]
    subprocess.run([*command, *layers, "-o", str(file)], check=True)
    image, layers = read_with_layers(file)
    assert np.array_equal(sum_of([layers[name] for name in NAMES]), image)
    assert {"caustics", "one", *(f"error.{name}" for name in NAMES)} < set(layers)
    assert mlt.read_metadata(file)["light_groups"].split() == NAMES


@pytest.mark.parametrize("count", [2, 8])
def test_merged_renders_have_the_mean_of_the_layers_and_their_errors(scene, count):
    parts = [result(scene, "path", seed=seed, light_groups=True) for seed in range(count)]
    merged = mlt.merge(parts)
    for name in NAMES:
        layers = [part.layers[name] for part in parts]
        np.testing.assert_allclose(merged.layers[name], np.mean(layers, axis=0), rtol=1e-5)
    if count == 8:
        expected = np.std([part.layers[NAMES[0]] for part in parts], axis=0, ddof=1) / np.sqrt(8)
    else:
        squares = [np.square(part.layers[f"error.{NAMES[0]}"]) for part in parts]
        expected = np.sqrt(sum(squares)) / 2
    np.testing.assert_allclose(merged.layers[f"error.{NAMES[0]}"], expected, rtol=1e-4, atol=1e-6)


@pytest.mark.parametrize(
    ("integrator", "options", "message"),
    [
        ("depth", {"light_groups": True}, "'depth' keeps no layers of light; those that do are"),
        ("path", {"light_layers": {"bad": "L(S"}}, "layer 'bad': 'L\\(S' is not a regular"),
        ("path", {"light_layers": {"light.a": "LE"}}, "cannot be called 'light.a'"),
        ("path", {"light_layers": {"alpha": "LE"}}, "cannot be called 'alpha'"),
        ("path", {"light_layers": [("a", "LE"), ("a", "LDE")]}, "two layers of paths .* 'a'"),
        ("path", {"light_layers": {"depth": "LE"}, "aovs": "depth"}, "two layers .* 'depth'"),
        ("path", {"light_layers": {"a": "L E"}}, "'a=L E' has a blank"),
        ("path", {"light_layers": {"a": 1}}, "should be a dict"),
        ("path", {"light_layers": {f"a{i}": "LE" for i in range(64)}}, "more than 63 layers"),
        (mlt.BDPT(max_depth=3, techniques=True), {"light_groups": True}, "techniques.* excludes"),
    ],
)
def test_what_cannot_be_kept_is_refused(scene, integrator, options, message):
    with pytest.raises(mlt.Error, match=message):
        mlt.start(scene, integrator, spp=1, **options)


def test_a_checkpoint_says_which_layers_there_are(tmp_path, monkeypatch, capsys):
    monkeypatch.chdir(tmp_path)
    mlt.start("ring", "path", spp=1, checkpoint="ring.mlt", light_groups=True).wait()
    command = ["render", "--resume", "ring.mlt", "--spp", "2", "-o", "ring.exr"]
    assert main([*command, "--light-groups"]) == 0
    assert mlt.read_metadata("ring.exr")["light_groups"].startswith("light.")
    assert main([*command, "--layer", "caustics=LS+DE"]) == 2
    assert "--layer is caustics=LS+DE here and not in the checkpoint" in capsys.readouterr().err
