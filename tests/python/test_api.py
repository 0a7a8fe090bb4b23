"""The Python face: classes from schemas, scenes, images, errors."""

import inspect
import os
import pickle
import signal
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest
import tiny

import pymlt as mlt


def test_the_import_is_light():
    code = (
        "import sys, pymlt;"
        "heavy = {'numpy', 'tqdm', 'OpenImageIO', 'flip_evaluator', 'matplotlib', 'scipy',"
        "         'pymlt.lab', 'pymlt.race', 'pymlt.viewing'};"
        "print(sorted(heavy & set(sys.modules)))"
    )
    out = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert out.stdout.strip() == "[]"


def test_all_exported_names_exist():
    assert all(hasattr(mlt, name) for name in mlt.__all__)
    assert len(set(mlt.__all__)) == len(mlt.__all__)


def test_the_stubs_are_current():
    from pymlt import _stubs

    for name, make in _stubs.STUBS.items():
        written = (Path(mlt.__file__).parent / name).read_text()
        assert written == make(), "run `python -m pymlt._stubs`"


def test_functions_and_classes_of_parameters_tell_their_types():
    functions = [v for v in map(vars(mlt).get, mlt.__all__) if inspect.isfunction(v)]
    made = [*mlt.Integrator.__subclasses__(), *mlt._mutations.built_in]
    assert mlt.render in functions
    for shown in functions + made:
        signature = inspect.signature(shown)
        untyped = [p for p in signature.parameters.values() if p.annotation is p.empty]
        assert not untyped, shown
        assert signature.return_annotation != "np.ndarray", f"{shown}: of which numbers?"
    assert "float32" in inspect.signature(mlt.render).return_annotation


# ---- integrators -------------------------------------------------------------------------------

CLASSES = sorted(mlt.Integrator.__subclasses__(), key=lambda c: c.__name__)


def test_every_integrator_has_a_class():
    assert {c().name for c in CLASSES} == set(mlt.available("integrator"))
    assert {"Path", "Direct", "PSSMLT"} <= {c.__name__ for c in CLASSES}


@pytest.mark.parametrize("integrator", CLASSES)
def test_an_integrator_class_tells_its_parameters(integrator):
    parameters = inspect.signature(integrator).parameters
    assert all(p.kind is p.KEYWORD_ONLY for p in parameters.values())
    assert all(name in integrator.__doc__ for name in parameters)
    with pytest.raises(TypeError):
        integrator(3)


@pytest.mark.parametrize("integrator", [c for c in CLASSES if c not in (mlt.Aov, mlt.Depth)])
def test_an_integrator_survives_pickling_and_renders(integrator):
    made = integrator(hide_emitters=True)
    copy = pickle.loads(pickle.dumps(made))
    assert copy == made
    assert copy != integrator()
    assert repr(copy) == f"{integrator.__name__}(hide_emitters=True)"
    scene = mlt.load_string(tiny.XML)
    images = [mlt.render(scene, algo, spp=2, seed=1) for algo in (made, copy, made.to_dict())]
    assert np.array_equal(images[0], images[1])
    assert np.array_equal(images[0], images[2])


def test_a_constructor_only_stores():
    assert mlt.Path(max_depth="many").max_depth == "many"
    with pytest.raises(mlt.SceneError, match="'max_depth' is a string"):
        mlt.render(tiny.scene(), mlt.Path(max_depth="many"))


def test_a_misspelt_parameter_gets_a_suggestion():
    with pytest.raises(TypeError, match="'max_dpeth'; did you mean 'max_depth'"):
        mlt.Path(max_dpeth=3)
    with pytest.raises(mlt.SceneError, match="did you mean 'max_depth'"):
        mlt.render(tiny.scene(), {"type": "path", "max_dpeth": 3})


def test_a_name_keeps_what_the_scene_says_and_an_object_does_not():
    scene = mlt.load_string(tiny.XML, depth=3)
    settings = [
        mlt.start(scene, algo, spp=1).result().integrator
        for algo in (None, "path", "pssmlt", mlt.PSSMLT(), {"type": "pssmlt"})
    ]
    assert [s["max_depth"] for s in settings] == [3, 3, 3, -1, -1]


def test_a_scene_without_integrator_is_rendered_by_mlt():
    scene = tiny.scene()
    del scene["integrator"]
    assert mlt.start(scene, spp=1).result().integrator["type"] == "mlt"


@pytest.mark.parametrize("wrong", [mlt.Path, 3, "pthe", {"type": "diffuse"}])
def test_what_is_no_integrator_is_refused(wrong):
    with pytest.raises(mlt.Error):
        mlt.render(tiny.scene(), wrong, spp=1)


def test_plug_ins_are_listed_and_described():
    assert "diffuse" in mlt.available("bsdf")
    assert mlt.available()["integrator"] == mlt.available("integrator")
    assert "reflectance" in mlt.describe("bsdf", "diffuse")
    with pytest.raises(mlt.UsageError, match="did you mean 'bsdf'"):
        mlt.available("bsfd")
    with pytest.raises(mlt.SceneError, match="did you mean 'diffuse'"):
        mlt.describe("bsdf", "difuse")


# ---- scenes ------------------------------------------------------------------------------------


def test_a_file_is_loaded_with_defines_and_size(tmp_path):
    path = tmp_path / "scene.xml"
    path.write_text(tiny.XML)
    scene = mlt.load_file(path)
    assert (scene.width, scene.height) == (16, 12)
    assert mlt.load_file(str(path), res=20).width == 20
    sized = mlt.load_file(path, size=(5, 4), depth=2)
    assert mlt.render(sized, spp=1).shape == (4, 5, 3)
    assert mlt.render(path, spp=1).shape == (12, 16, 3)


def test_a_scene_tells_what_it_holds():
    scene = mlt.load_dict(tiny.scene())
    info = scene.info()
    assert info["size"] == (16, 12)
    assert info["shapes"] == 3
    assert info["emitters"] == 1
    assert info["integrator"] == "path"
    assert info["sample_count"] == 4
    assert repr(scene).startswith("Scene(16 x 12, 3 shapes, ")
    assert scene.warnings == []


def test_what_is_ignored_is_a_warning_with_its_line():
    xml = tiny.XML.replace("<scene version", "<!-- -->\n<scene version")
    xml = xml.replace(
        '<rfilter type="box"/>', '<rfilter type="box"/><boolean name="banner" value="false"/>'
    )
    scene = mlt.load_string(xml)
    assert len(scene.warnings) == 1
    assert "banner" in scene.warnings[0]
    assert scene.warnings[0] in mlt.start(scene, spp=1).result().stats["warnings"]


@pytest.mark.parametrize("size", [(0, 4), (3,), 7, "ab", (2.5, 3)])
def test_a_size_that_makes_no_sense_is_refused(size):
    with pytest.raises(mlt.UsageError, match="size"):
        mlt.load_dict(tiny.scene(), size=size)


@pytest.mark.parametrize("name", mlt.scenes.names())
def test_every_built_in_scene_renders(name):
    scene = mlt.load_dict(getattr(mlt.scenes, name)(), size=(24, 16))
    image = mlt.render(scene, spp=4)
    assert scene.warnings == []
    assert image.max() > 0


# ---- errors, images, transforms ----------------------------------------------------------------


def test_errors_are_also_the_built_in_ones():
    for error, builtin in [
        (mlt.SceneError, ValueError),
        (mlt.UsageError, ValueError),
        (mlt.FileError, OSError),
        (mlt.RenderError, RuntimeError),
    ]:
        assert issubclass(error, mlt.Error)
        assert issubclass(error, builtin)
    with pytest.raises(OSError, match=r"nowhere\.xml"):
        mlt.load_file("nowhere.xml")
    error = pickle.loads(pickle.dumps(mlt.SceneError("x")))
    assert isinstance(error, mlt.SceneError)


@pytest.mark.parametrize(("suffix", "tolerance"), [("exr", 0), ("hdr", 0.01), ("png", 0.02)])
def test_images_come_back(tmp_path, suffix, tolerance):
    image = np.random.default_rng(1).random((5, 7, 3)).astype(np.float32)
    path = tmp_path / f"image.{suffix}"
    mlt.write_image(path, image)
    back = mlt.read_image(path)
    assert back.dtype == np.float32
    assert back.shape == image.shape
    assert np.abs(back - image).max() <= tolerance


def test_an_image_owns_its_memory_and_may_be_changed():
    image = mlt.render(tiny.scene(), spp=1)
    image[:] = 3
    assert image.flags.writeable
    assert image.flags.c_contiguous


def test_other_formats_are_read_by_openimageio(tmp_path):
    oiio = pytest.importorskip("OpenImageIO")
    spec = oiio.ImageSpec(4, 3, 3, oiio.UINT8)
    file = oiio.ImageOutput.create(str(tmp_path / "a.tif"))
    file.open(str(tmp_path / "a.tif"), spec)
    file.write_image(np.full((3, 4, 3), 188, np.uint8))
    file.close()
    assert mlt.read_image(tmp_path / "a.tif") == pytest.approx(0.503, abs=1e-3)
    with pytest.raises(mlt.FileError, match=r"none\.tif"):
        mlt.read_image(tmp_path / "none.tif")


def test_exposure_brightens_png(tmp_path):
    image = np.full((2, 2, 3), 0.1, np.float32)
    mlt.write_image(tmp_path / "a.png", image, exposure=1)
    assert mlt.read_image(tmp_path / "a.png") == pytest.approx(0.2, abs=0.01)


def test_a_result_says_in_the_header_how_it_was_made(tmp_path):
    result = mlt.start(tiny.scene(), mlt.PSSMLT(max_depth=3, chains=16), spp=2, seed=5).result()
    result.write(tmp_path / "a.exr")
    result.write(tmp_path / "b.exr")
    meta = mlt.read_metadata(tmp_path / "a.exr")
    assert meta["software"] == f"pymlt {mlt.__version__}"
    assert meta["seed"] == "5"
    assert '"max_depth": 3' in meta["integrator"]
    assert '"p_large": 0.3' in meta["integrator"]
    assert (tmp_path / "a.exr").read_bytes() == (tmp_path / "b.exr").read_bytes()
    assert np.array_equal(mlt.read_image(tmp_path / "a.exr"), result.image)


def test_an_image_that_cannot_be_written_is_rescued(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    result = mlt.start(tiny.scene(), spp=1).result()
    with pytest.raises(mlt.FileError):
        result.write(tmp_path / "no" / "a.exr")
    saved = {result.save(tmp_path / "no" / "a.exr") for _ in range(2)}
    assert len(saved) == 2
    assert all(np.array_equal(mlt.read_image(path), result.image) for path in saved)


def test_transforms_are_matrices():
    T = mlt.Transform
    point = np.array([1.0, 2.0, 3.0, 1.0])
    chained = T().translate(0, 1, 0).rotate([0, 0, 2], 90).scale(2)
    assert chained == T.translate([0, 1, 0]) @ T.rotate([0, 0, 1], 90) @ T.scale([2, 2, 2])
    assert chained.matrix @ point == pytest.approx([-4, 3, 6, 1])
    assert (chained @ chained.inverse()).matrix == pytest.approx(np.eye(4))
    view = T.look_at(origin=[0, 0, 3.9], target=[0, 0, 0], up=[0, 1, 0])
    expected = [[-1, 0, 0, 0], [0, 1, 0, 0], [0, 0, -1, 3.9], [0, 0, 0, 1]]
    assert view.matrix == pytest.approx(np.array(expected))
    assert T(view.matrix) == view
    assert np.array_equal(np.asarray(view), view.matrix)


def test_transforms_without_a_direction_are_refused():
    with pytest.raises(ValueError, match="axis"):
        mlt.Transform.rotate([0, 0, 0], 90)
    with pytest.raises(ValueError, match="parallel"):
        mlt.Transform.look_at([0, 0, 0], [0, 1, 0], [0, 1, 0])
    with pytest.raises(ValueError, match="4 x 4"):
        mlt.Transform(np.eye(3))


@pytest.mark.parametrize("kind", [np.uint8, np.int64, bool])
def test_integers_are_no_linear_image(tmp_path, kind):
    with pytest.raises(mlt.UsageError, match="linear floats"):
        mlt.write_image(tmp_path / "a.png", np.ones((2, 2, 3), kind))
    assert not (tmp_path / "a.png").exists()


def test_what_is_not_a_number_is_said(tmp_path):
    image = np.full((2, 2, 3), 0.5)
    image[0, 0] = np.nan
    for name in "a.png", "a.hdr":
        with pytest.warns(UserWarning, match=f"{name}: 3 samples are not numbers and become 0"):
            mlt.write_image(tmp_path / name, image)
    mlt.write_image(tmp_path / "a.exr", image)  # which can hold them
    assert np.isnan(mlt.read_image(tmp_path / "a.exr")).sum() == 3


def test_look_at_needs_two_points():
    with pytest.raises(ValueError, match="'origin' and 'target'"):
        mlt.Transform.look_at([1, 2, 3], [1, 2, 3], [0, 1, 0])
    with pytest.raises(ValueError, match="'up'"):
        mlt.Transform.look_at([0, 0, 0], [0, 1, 0], [0, 1, 0])


def test_the_content_of_a_file_decides_who_reads_it(tmp_path):
    image = np.random.default_rng(1).random((5, 4, 3)).astype(np.float32)
    mlt.write_image(tmp_path / "a.exr", image)
    (tmp_path / "a.exr").rename(tmp_path / "a.tiff")
    assert np.array_equal(mlt.read_image(tmp_path / "a.tiff"), image)


@pytest.mark.parametrize(
    ("call", "message"),
    [
        (lambda: mlt.load("ring", size=(2**31, 1)), "size is"),
        (lambda: mlt.load("ring", size=(1, -(2**40))), "size is"),
        (lambda: mlt.load("ring", size=(float("inf"), 1)), "size is"),
        (lambda: mlt.load("ring", sensor=2**70), "sensor is"),
        (lambda: mlt.start("ring", spp=1, checkpoint=""), "checkpoint is ''"),
        (lambda: mlt.start("ring", spp=1, aovs=[3]), "3"),
        (lambda: mlt.render("ring", spp=1, interval=float("nan")), "interval is nan"),
        (lambda: mlt.render("ring", spp=1, interval=-1), "interval is -1"),
        (lambda: next(mlt.render_progressive("ring", interval=float("nan"))), "interval is nan"),
        (lambda: mlt.start("ring", spp=1).wait(float("nan")), "timeout is nan"),
        (lambda: mlt.replay("ring", "path", pixel=(2**31, 0)), "a coordinate of pixel is"),
    ],
)
def test_arguments_out_of_range_are_refused_in_one_line(call, message):
    with pytest.raises(mlt.UsageError, match=message) as caught:
        call()
    assert "\n" not in str(caught.value)


@pytest.mark.parametrize("light", ["constant", "point", "area"])
def test_light_that_would_overflow_an_image_is_refused(light):
    name = "intensity" if light == "point" else "radiance"
    emitter = f'<emitter type="{light}">\n<rgb name="{name}" value="1, 3e38, 1"/></emitter>'
    if light == "area":
        emitter = f'<shape type="sphere">{emitter}</shape>'
    with pytest.raises(mlt.SceneError, match=rf":2: emitter '{light}': '{name}' reaches 3e\+38"):
        mlt.load_string(tiny.XML.replace("\n", "").replace("</scene>", f"{emitter}</scene>"))


def test_a_map_that_would_overflow_an_image_is_refused():
    bright = np.ones((4, 8, 3), dtype=np.float32)
    bright[1, 1] = 3e38
    for emitter in {"bitmap": bright}, {"bitmap": bright / 1e30, "scale": 1e31}:
        with pytest.raises(mlt.SceneError, match="1e\\+30"):
            mlt.load_dict({**tiny.scene(), "sky": {"type": "envmap", **emitter}})


def test_a_lone_surrogate_is_no_file_name():
    with pytest.raises(mlt.UsageError, match="surrogate"):
        mlt.load_file("\ud800")


# ---- files ---------------------------------------------------------------------------------------


@pytest.mark.parametrize("name", ["a.exr", "a.png", "a.jpg"])
def test_a_file_that_is_replaced_keeps_its_permissions(name, tmp_path):
    image = np.ones((4, 4, 3), dtype=np.float32)
    mlt.write_image(tmp_path / name, image)
    new = (tmp_path / name).stat().st_mode
    (tmp_path / "other").touch()
    assert new == (tmp_path / "other").stat().st_mode
    for mode in 0o600, 0o664:
        (tmp_path / name).chmod(mode)
        mlt.write_image(tmp_path / name, image)
        assert (tmp_path / name).stat().st_mode & 0o777 == mode


def test_files_of_others_are_left_alone(tmp_path):
    names = [".partial-1-0", ".partial-0123456789abcdef", ".partial-thesis.pdf"]
    for name in names:
        (tmp_path / name).write_text("mine")
    mlt.write_image(tmp_path / "a.exr", np.ones((4, 4, 3), dtype=np.float32))
    assert sorted(os.listdir(tmp_path)) == sorted([*names, "a.exr"])


def test_a_process_that_is_killed_while_it_writes_leaves_nothing(tmp_path):
    program = """if True:
        import resource, signal, sys
        import numpy, pymlt
        image = numpy.random.default_rng(1).random((64, 64, 3), dtype="f")
        pymlt.write_image("a.exr", image[:4])
        signal.signal(signal.SIGXFSZ, signal.SIG_DFL)
        resource.setrlimit(resource.RLIMIT_FSIZE, (4096, 4096))
        pymlt.write_image("a.exr", image)
    """
    done = subprocess.run([sys.executable, "-c", program], cwd=tmp_path)
    assert done.returncode == -signal.SIGXFSZ
    assert os.listdir(tmp_path) == ["a.exr"]
    assert mlt.read_image(tmp_path / "a.exr").shape == (4, 64, 3)


# ---- objects of the extension --------------------------------------------------------------------


def test_an_object_without_a_value_is_refused():
    """Whatever type: `cls.__new__(cls)` makes an object that holds nothing."""
    bound = [kind for kind in vars(mlt._core).values() if isinstance(kind, type)]
    empty = 0
    for kind in bound:
        if issubclass(kind, BaseException):
            continue
        for name, member in vars(kind).items():
            if isinstance(member, property):
                with pytest.raises(TypeError, match="is empty"):
                    getattr(kind.__new__(kind), name)
                empty += 1
    assert empty > 20
    with pytest.raises(TypeError, match="is empty"):
        mlt._core.Scene.__new__(mlt._core.Scene).info()
