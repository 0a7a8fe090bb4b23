"""The command lines: `pymlt render` and `mlt-render` share one contract; pymlt can do more."""

import json
import os
import re
import resource
import shlex
import shutil
import signal
import subprocess
import sys
import time
from pathlib import Path

import numpy as np
import pytest
import tiny
from command_line import PYMLT, mlt_render, run, the_error

import pymlt as mlt
from pymlt import cli
from pymlt.cli import info

# ---- what a render makes -----------------------------------------------------------------------


def test_a_render_writes_images_and_stats(program, scene):
    done = run(
        program, scene, "-o", "a.exr", "-o", "a.png", "--stats", "a.json", "--spp", 4, "--seed", 7
    )
    assert done.returncode == 0, done.stderr
    assert done.stdout == ""
    image = mlt.read_image("a.exr")
    assert np.array_equal(image, mlt.render(mlt.load_file(scene), spp=4, seed=7))
    assert mlt.read_image("a.png").shape == image.shape
    stats = json.loads(Path("a.json").read_text())
    assert stats["spp_done"] == 4
    assert stats["seed"] == 7
    assert "a.exr" in done.stderr


def test_quiet_is_silent(program, scene):
    done = run(program, scene, "-o", "a.exr", "--spp", 1, "--quiet")
    assert (done.returncode, done.stdout, done.stderr) == (0, "", "")


def test_both_programs_write_the_same_bytes(scene):
    binary = mlt_render() or pytest.skip("mlt-render is not installed beside this Python")
    flags = [scene, "--integrator", "pssmlt", "-p", "chains=16", "-p", "maxDepth=3"]
    flags += ["-D", "res=20", "--spp", 4, "--seed", 3]
    for name, command in {"a": [*PYMLT, "render"], "b": binary}.items():
        for suffix in "exr", "png":
            assert run(command, *flags, "-o", f"{name}.{suffix}").returncode == 0
    assert Path("a.exr").read_bytes() == Path("b.exr").read_bytes()
    assert Path("a.png").read_bytes() == Path("b.png").read_bytes()
    assert '"max_depth": 3' in mlt.read_metadata("a.exr")["integrator"]
    assert mlt.read_image("a.exr").shape == (12, 20, 3)


@pytest.mark.parametrize("integrator", ["path", "pssmlt"])
def test_the_number_of_threads_does_not_change_a_byte(program, scene, integrator):
    flags = [scene, "--integrator", integrator, "--spp", 4, "--size", "32x24"]
    for threads in 1, 2:
        done = run(program, *flags, "--threads", threads, "-o", f"{threads}.exr")
        assert done.returncode == 0
    assert Path("1.exr").read_bytes() == Path("2.exr").read_bytes()


def test_an_integrator_by_name_keeps_the_depth_of_the_scene(program, scene):
    run(program, scene, "--integrator", "pssmlt", "--spp", 1, "-o", "a.exr")
    assert '"max_depth": 4' in mlt.read_metadata("a.exr")["integrator"]


def test_exposure_is_for_png_alone(program, scene):
    run(program, scene, "--spp", 4, "-o", "a.png", "-o", "a.exr")
    run(program, scene, "--spp", 4, "-o", "b.png", "-o", "b.exr", "--exposure", "-2")
    assert np.array_equal(mlt.read_image("a.exr"), mlt.read_image("b.exr"))
    assert mlt.read_image("b.png").mean() < 0.5 * mlt.read_image("a.png").mean()


def test_an_exposure_may_be_what_suits_the_image(program, scene):
    run(program, scene, "--spp", 4, "-o", "a.png", "-o", "a.exr", "--exposure", "auto")
    mlt.write_image("b.png", mlt.read_image("a.exr"), exposure="auto")
    assert Path("a.png").read_bytes() == Path("b.png").read_bytes()
    mlt.write_image("c.png", mlt.read_image("a.exr"))
    assert Path("a.png").read_bytes() != Path("c.png").read_bytes()


def test_time_is_a_budget(program, scene):
    done = run(
        program, scene, "--time", 0.3, "-o", "a.exr", "--stats", "a.json", "--size", "200x150"
    )
    assert done.returncode == 0
    assert 0.2 < json.loads(Path("a.json").read_text())["seconds"]["render"] < 5


# ---- mistakes ----------------------------------------------------------------------------------

OUT = ["-o", "a.exr"]
USAGE = {
    "no output": (["scene.xml"], "output"),
    "no scene": (OUT, "required"),
    "unknown extension": (["scene.xml", "-o", "a.jpeg2"], ".exr"),
    "unknown flag": (["scene.xml", *OUT, "--sp", "3"], "--sp"),
    "checkpoint nowhere": (["scene.xml", *OUT, "--checkpoint", "no/x"], "no/x"),
    "checkpoint over a scene": (
        ["scene.xml", *OUT, "--checkpoint", "scene.xml"],
        "scene.xml: scene and --checkpoint name the same file",
    ),
    "checkpoint and image": (["scene.xml", *OUT, "--checkpoint", "a.exr"], "same file"),
    "checkpoint and stats": (
        ["scene.xml", *OUT, "--checkpoint", "x", "--stats", "./x"],
        "--checkpoint and --stats name the same file",
    ),
    "two images": (["scene.xml", *OUT, *OUT], "-o and -o name the same file"),
    "scene and stats": (["scene.xml", *OUT, "--stats", "scene.xml"], "scene and --stats name"),
    "resume and stats": ([*OUT, "--resume", "x", "--stats", "x"], "--resume and --stats name"),
    "overwrite alone": (["scene.xml", *OUT, "--overwrite"], "--overwrite needs --checkpoint"),
    "every alone": (["scene.xml", *OUT, "--every", "5"], "--every"),
    "every 0": (["scene.xml", *OUT, "--checkpoint", "x", "--every", "0"], "every"),
    "resume nothing": ([*OUT, "--resume", "x"], "x: there is no such file"),
    "resume a scene": ([*OUT, "--resume", "scene.xml"], "scene.xml: is no checkpoint"),
    "negative seed": (["scene.xml", *OUT, "--seed", "-1"], "'-1' is not an integer from 0 to 18"),
    "large seed": (["scene.xml", *OUT, "--seed", str(2**64)], "is not an integer from 0 to 18"),
    "seed 1.5": (["scene.xml", *OUT, "--seed", "1.5"], "'1.5' is not an integer from 0 to 18"),
    "error 0": (["scene.xml", *OUT, "--error", "0"], "error"),
    "size": (["scene.xml", *OUT, "--size", "3by4"], "3by4"),
    "size 0": (["scene.xml", *OUT, "--size", "0x4"], "0x4"),
    "spp is a word": (["scene.xml", *OUT, "--spp", "many"], "many"),
    "spp beyond counting": (["scene.xml", *OUT, "--spp", "2e19"], "up to 2147483647"),
    "endless spp": (["scene.xml", *OUT, "--spp", "inf"], "up to 2147483647"),
    "many threads": (["scene.xml", *OUT, "--threads", "4097"], "from 0 to 4096"),
    "every for ever": (["scene.xml", *OUT, "--checkpoint", "x", "--every", "1e300"], "at most 1e9"),
    "exposure": (["scene.xml", *OUT, "--exposure", "1e300"], "from -128 to 128"),
    "spp 0": (["scene.xml", *OUT, "--spp", "0"], "spp"),
    "negative time": (["scene.xml", *OUT, "--time=-1"], "time"),
    "negative threads": (["scene.xml", *OUT, "--threads=-1"], "threads"),
    "-p without value": (["scene.xml", *OUT, "-p", "max_depth"], "max_depth"),
    "-p misspelt": (["scene.xml", *OUT, "-p", "max_dpeth=3"], "did you mean 'max_depth'?"),
    "-p wrong type": (["scene.xml", *OUT, "-p", "max_depth=x"], "'x'"),
    "-p out of range": (["scene.xml", *OUT, "-p", "max_depth=-7"], "max_depth"),
    "-D unknown": (["scene.xml", *OUT, "-D", "rse=3"], "rse"),
    "-D without value": (["scene.xml", *OUT, "-D", "res"], "res"),
    "integrator": (["scene.xml", *OUT, "--integrator", "pssmtl"], "did you mean 'pssmlt'?"),
    "filter": (["scene.xml", *OUT, "--filter", "bxo"], "did you mean 'box'?"),
    "missing scene": (["nowhere.xml", *OUT], "nowhere.xml"),
    "two scenes": (["scene.xml", "scene.xml", *OUT], "scene.xml"),
}


@pytest.mark.parametrize(("arguments", "what"), USAGE.values(), ids=USAGE.keys())
def test_a_mistake_in_usage_is_one_line(program, scene, arguments, what):
    assert what in the_error(run(program, *arguments))
    assert not Path("a.exr").exists()


@pytest.mark.parametrize(
    ("arguments", "said"),
    [
        (["render", "x", "--sp", 4], "there is no flag --sp; did you mean '--spp'?"),
        (["render", "x", "--sp=4"], "there is no flag --sp; did you mean '--spp'?"),
        (["--sp"], "there is no flag --sp; did you mean '--spp' of pymlt render?"),
        (["--versio"], "there is no flag --versio; did you mean '--version'?"),
        (["lab", "--lst"], "there is no flag --lst; did you mean '--list'?"),
        (["render", "x", "--zzz"], "there is no flag --zzz; see pymlt render --help"),
        (["rendr", "x", "--spp", 4], "invalid choice: 'rendr'"),
        (["render", "--", "--spp"], "the following arguments are required: -o/--output"),
    ],
    ids=str,
)
def test_the_error_for_a_misspelt_flag_names_the_one_that_was_meant(arguments, said):
    assert said in the_error(run(PYMLT, *arguments))


def test_a_checkpoint_replaces_no_other_file(program, scene):
    Path("notes").write_text("not to be lost")
    error = the_error(run(program, scene, *OUT, "--checkpoint", "notes", "--overwrite"))
    assert "notes: is no checkpoint of pymlt" in error
    assert Path("notes").read_text() == "not to be lost"


RULES = ["no scene", "every alone", "every 0", "size"]
RULES += [
    "negative seed",
    "large seed",
    "spp 0",
    "spp is a word",
    "negative threads",
    "-D without value",
]


@pytest.mark.parametrize("name", RULES)
def test_both_programs_refuse_in_the_same_words(scene, name):
    binary = mlt_render() or pytest.skip("mlt-render is not installed beside this Python")
    errors = [the_error(run(p, *USAGE[name][0])) for p in ([*PYMLT, "render"], binary)]
    errors[0] = errors[0].replace("pymlt: ", "mlt-render: ").replace("pymlt render", "mlt-render")
    assert errors[0] == errors[1]


def test_the_largest_seed_is_a_seed(program, scene):
    seed = 2**64 - 1
    assert run(program, scene, *OUT, "--spp", 1, "--seed", seed).returncode == 0
    assert mlt.read_metadata("a.exr")["seed"] == str(seed)


def test_the_last_line_says_what_was_done_and_how_good_it_is(program, scene):
    flags = ["--integrator", "path", "--spp", 64, "--quiet", "-o", "a.exr", "--stats", "a.json"]
    assert run(program, scene, *flags).stderr == ""
    flags.remove("--quiet")
    said = run(program, scene, *flags).stderr.splitlines()[-1].partition(": ")[2]
    stats = json.loads(Path("a.json").read_text())
    error = f"{100 * stats['error']:.2g}"
    assert re.fullmatch(rf"path, 16 x 12, 64 spp in \d+\.\d s, error {error} %: a\.exr", said)


@pytest.mark.parametrize(
    ("error", "said"),
    [(0.0412, ", error 4.1 %"), (0.0997, ", error 10 %"), (1.234, ", error 123 %"), (None, "")],
)
def test_a_result_says_the_same(error, said):
    stats = {"spp_done": 305.0, "seconds": {"bootstrap": 1.0, "render": 59.04}, "error": error}
    result = mlt.Result(np.zeros((36, 64, 3)), stats, {"type": "mlt"}, {}, {})
    assert repr(result) == f"Result(mlt, 64 x 36, 305 spp in 60.0 s{said})"
    result = mlt.Result(np.zeros((36, 64, 3)), {"spp_done": 6.0}, {"type": "mlt"}, {}, {})
    assert repr(result) == "Result(mlt, 64 x 36, 6 spp)"


def test_both_programs_have_the_same_flags():
    binary = mlt_render() or pytest.skip("mlt-render is not installed beside this Python")
    flags = [
        set(re.findall(r"(?<![\w-])--?[a-zA-Z]+", run(command, "--help").stdout))
        for command in ([*PYMLT, "render"], [*binary])
    ]
    own = {"--bands", "--bits", "--cluster", "--denoise", "--fireflies", "--tonemap"}
    own |= {"--frames", "--fps", "--shutter", "--together", "--skip"}  # --skip-existing
    assert flags[0] - flags[1] == own
    assert flags[1] - flags[0] == {"--version"}


SCENE_MISTAKES = {
    "misspelt parameter": ('name="fov"', 'name="fvo"', "did you mean 'fov'?"),
    "misspelt plug-in": ('"dielectric"', '"dielctric"', "did you mean 'dielectric'?"),
    "wrong value": ('value="40"', 'value="forty"', "forty"),
    "dangling reference": ('<ref id="clay"/>', '<ref id="clya"/>', "did you mean 'clay'?"),
    "no end": ("</scene>", "", "scene"),
    "missing": ('<bsdf type="dielectric"/>', '<phase type="sggx"/>', "not supported"),
}


@pytest.mark.parametrize(
    ("good", "bad", "what"), SCENE_MISTAKES.values(), ids=SCENE_MISTAKES.keys()
)
def test_a_mistake_in_a_scene_names_file_and_line(program, scene, good, bad, what):
    Path(scene).write_text(tiny.XML.replace(good, bad, 1))
    error = the_error(run(program, scene, *OUT))
    line = tiny.XML[: tiny.XML.index(good)].count("\n") + 1
    assert f": {scene}:{line}: " in error
    assert what in error


def test_an_unwritable_output_is_known_before_the_scene_is_read(program, scene):
    Path(scene).write_text("this is no scene")
    for output in ["no/such/folder/a.exr", "."]:
        assert "scene.xml" not in the_error(run(program, scene, "-o", output))
    assert "no/a.json" in the_error(run(program, scene, *OUT, "--stats", "no/a.json"))


def test_a_render_that_fails_ends_with_3(program, scene):
    Path(scene).write_text(tiny.XML.replace("5, 6, 7", "0, 0, 0"))
    chains = ["--integrator", "pssmlt", "-p", "independent_share=0"]
    assert "light" in the_error(run(program, scene, *OUT, *chains), code=3)


def test_ctrl_c_during_the_imports_is_silent():
    program = """if True:
        import os, signal, sys
        signal.signal(signal.SIGINT, signal.default_int_handler)  # a background job ignores it
        class Finder:
            def find_spec(self, name, *_):
                if name == MODULE:
                    os.kill(os.getpid(), signal.SIGINT)
        sys.meta_path.insert(0, Finder())
        sys.argv = ["/usr/bin/pymlt", "list"]
        from pymlt.cli import main
        sys.exit(main())
    """
    for module in "pymlt._processor", "pymlt._core", "pymlt.rendering.start", "pymlt.cli.race":
        done = run([sys.executable, "-c", program.replace("MODULE", repr(module))])
        assert (done.returncode, done.stdout, done.stderr) == (130, "", ""), module


def test_ctrl_c_is_a_keyboard_interrupt_for_programs_that_import_us():
    program = """if True:
        import os, signal
        signal.signal(signal.SIGINT, signal.default_int_handler)  # a background job ignores it
        import pymlt
        os.kill(os.getpid(), signal.SIGINT)
    """
    assert "KeyboardInterrupt" in run([sys.executable, "-c", program]).stderr


def test_names_that_are_empty_are_refused(program, scene):
    for arguments in (["", "-o", "a.exr"], [scene, "-o", ""], ["--resume", "", "-o", "a.exr"]):
        assert "is empty, but should be the name of a file" in the_error(run(program, *arguments))


def test_pixels_that_are_no_numbers_are_told_of(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    image = np.ones((4, 4, 3), dtype=np.float32)
    mlt.write_image("a.exr", image)
    image[1, 2] = np.nan
    mlt.write_image("b.exr", image)
    for arguments in (["a.exr", "b.exr"], ["b.exr", "a.exr"], ["b.exr", "b.exr", "--json"]):
        done = run([*PYMLT, "compare"], *arguments)
        assert done.returncode == 1
        assert done.stderr.startswith("pymlt: the images have pixels that are no numbers")
        assert done.stderr.count("\n") == 1


def sparse(name: str, start: bytes, size: int) -> None:
    with open(name, "wb") as file:
        file.write(start)
        file.truncate(size)


LARGE = {
    "ply": '<shape type="ply">{}</shape>',
    "obj": '<shape type="obj">{}</shape>',
    "serialized": '<shape type="serialized">{}</shape>',
    "vol": '<medium type="heterogeneous"><volume name="sigma_t" type="gridvolume">{}</volume>'
    "</medium>",
    "exr": '<emitter type="envmap">{}</emitter>',
}


@pytest.mark.parametrize("kind", LARGE)
def test_a_file_that_memory_does_not_hold_is_named(program, scene, kind):
    sparse(f"large.{kind}", b"", 3 << 30)
    element = LARGE[kind].format(f'<string name="filename" value="large.{kind}"/>')
    Path("large.xml").write_text(Path(scene).read_text().replace("</scene>", f"{element}</scene>"))
    done = run(program, "large.xml", "-o", "a.exr", preexec_fn=lambda: little_memory(5 << 19))
    assert f"large.{kind}: cannot read it: there is no memory" in the_error(done)


def test_a_checkpoint_that_memory_does_not_hold_is_named(program, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    sparse("large.mlt", b"pymlt checkpoint" + (1 << 40).to_bytes(8, "little"), (1 << 40) + 28)
    done = run(
        program, "--resume", "large.mlt", "-o", "a.exr", preexec_fn=lambda: little_memory(5 << 19)
    )
    assert "large.mlt: cannot read it: there is no memory" in the_error(done)


def test_help_and_version_succeed(program):
    for flag in "--help", "--version":
        done = run(program if flag == "--help" else program[:3], flag)
        assert done.returncode == 0
        assert done.stderr == ""
        assert done.stdout


# ---- interruptions and lost folders ------------------------------------------------------------


def start(command, *arguments) -> subprocess.Popen:
    """A program that has begun to render: its first checkpoint is there."""
    checkpoints = ["--checkpoint", "begun", "--every", 0.2]
    process = subprocess.Popen(
        [*command, *map(str, [*arguments, *checkpoints])],
        text=True,
        stderr=subprocess.PIPE,
        stdout=subprocess.PIPE,
        # These tests may themselves run under nohup.
        preexec_fn=lambda: signal.signal(signal.SIGHUP, signal.SIG_DFL),
    )
    while not Path("begun").exists() and process.poll() is None:
        time.sleep(0.02)
    return process


@pytest.mark.parametrize(
    ("number", "code"), [(signal.SIGHUP, 129), (signal.SIGINT, 130), (signal.SIGTERM, 143)]
)
def test_an_interrupted_render_saves_what_there_is(program, scene, number, code):
    flags = [scene, "--size", "320x240", "--spp", "1e7", "-o", "a.exr", "--stats", "a.json"]
    process = start(program, *flags)
    begin = time.perf_counter()
    process.send_signal(number)
    _, err = process.communicate(timeout=20)
    assert time.perf_counter() - begin < 3
    assert process.returncode == code
    assert "interrupted" in err
    assert mlt.read_image("a.exr").max() > 0
    assert 0 < json.loads(Path("a.json").read_text())["spp_done"] < 1e7


def test_nohup_is_respected(program, scene):
    command = ["nohup", *program, scene, "--spp", "1e7", "--time", "3", "-o", "a.exr"]
    process = start(command)
    process.send_signal(signal.SIGHUP)
    process.communicate(timeout=20)
    assert process.returncode == 0


def saved_as(line: str) -> str:
    return line.partition("it is saved as ")[2]


def test_a_finished_image_is_never_lost(program, scene):
    Path("out").mkdir()
    process = start(program, scene, "--time", 3, "-o", "out/a.exr")
    shutil.rmtree("out")
    _, err = process.communicate(timeout=20)
    assert process.returncode == 3
    problem, summary = err.splitlines()
    assert ": out/a.exr: cannot write it: there is no folder 'out'; it is saved as " in problem
    assert mlt.read_image(saved_as(problem)).max() > 0
    assert summary.endswith(f": {saved_as(problem)}")


def no_room_for(size: int) -> None:
    """In a new process: a file that grows beyond `size` bytes is refused, as on a full disk."""
    resource.setrlimit(resource.RLIMIT_FSIZE, (size, size))


def test_a_full_disk_is_said_and_ends_with_3(program, scene):
    flags = ["--size", "64x64", "--spp", 16, "-o", "a.exr", "-o", "a.png", "--stats", "a.json"]
    done = run(program, scene, *flags, preexec_fn=lambda: no_room_for(16384))
    assert done.returncode == 3
    lines = [line.partition(": ")[2] for line in done.stderr.splitlines()]
    full = "cannot write it: File too large; no other place would have it"
    assert lines[:-1] == [f"a.exr: {full}"]
    assert lines[-1].endswith(" %: a.png")
    assert sorted(os.listdir()) == ["a.json", "a.png", "scene.xml"]


@pytest.fixture
def small_disk(tmp_path):
    """A file system of 64 KiB."""
    folder = tmp_path / "small"
    folder.mkdir()
    mounted = subprocess.run(["mount", "-t", "tmpfs", "-o", "size=64k", "small", folder])
    if mounted.returncode != 0:
        pytest.skip("only root mounts a small file system")
    yield folder
    subprocess.run(["umount", folder], check=True)


def test_what_a_full_disk_does_not_hold_is_elsewhere(program, scene, small_disk):
    flags = ["--size", "128x128", "--spp", 16, "-o", "small/a.exr", "--stats", "small/a.json"]
    done = run(program, scene, *flags)
    assert done.returncode == 3
    problem, summary = done.stderr.splitlines()
    assert "small/a.exr: cannot write it: No space left on device; it is saved as " in problem
    assert saved_as(problem) == str(Path("rescued-a.exr").resolve())
    assert summary.endswith(f": {saved_as(problem)}")
    assert mlt.read_image("rescued-a.exr").shape == (128, 128, 3)
    assert os.listdir("small") == ["a.json"]


# ---- compare, info, list, built-in scenes ------------------------------------------------------


@pytest.fixture
def images(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    image = np.random.default_rng(1).random((8, 8, 3)).astype(np.float32)
    mlt.write_image("a.exr", image)
    mlt.write_image("b.exr", image + np.float32(0.5))


def test_compare_prints_metrics(images):
    metrics = json.loads(run(PYMLT, "compare", "b.exr", "a.exr", "--json").stdout)
    assert metrics["mse"] == pytest.approx(0.25, rel=1e-5)
    text = run(PYMLT, "compare", "b.exr", "a.exr").stdout
    assert [line.split()[0] for line in text.splitlines()] == list(metrics)


def test_compare_fails_above_a_limit(images):
    command = [*PYMLT, "compare", "b.exr", "a.exr"]
    assert run(command, "--fail-above", "mse=0.3").returncode == 0
    failed = run(command, "--fail-above", "mse=0.3", "--fail-above", "rmse=0.4")
    assert failed.returncode == 1
    assert "rmse is 0.5, above 0.4" in failed.stderr


def test_compare_does_not_pass_nan(images):
    image = mlt.read_image("a.exr")
    image[3, 3] = np.nan
    mlt.write_image("nan.exr", image)
    done = run(PYMLT, "compare", "nan.exr", "a.exr", "--fail-above", "mse=1e9", "--json")
    assert done.returncode == 1
    assert json.loads(done.stdout)["mse"] is None


@pytest.mark.parametrize(
    ("arguments", "what"),
    [
        (["a.exr"], "B"),
        (["a.exr", "nowhere.exr"], "nowhere.exr"),
        (["a.exr", "b.exr", "--fail-above", "msee=1"], "did you mean 'mse'?"),
        (["a.exr", "b.exr", "--fail-above", "mse=x"], "x"),
    ],
)
def test_compare_explains_mistakes(images, arguments, what):
    assert what in the_error(run(PYMLT, "compare", *arguments))


def test_info_tells_what_a_scene_holds(scene):
    told = json.loads(run(PYMLT, "info", scene, "-D", "res=40", "--json").stdout)
    assert told["size"] == [40, 12]
    assert told["shapes"] == 3
    assert "40 x 12" in run(PYMLT, "info", scene, "-D", "res=40").stdout


def test_a_parameter_of_a_scene_may_have_the_name_of_an_argument():
    scene = Path(__file__).parents[2] / "scenes" / "fog" / "scene.xml"
    told = json.loads(run(PYMLT, "info", scene, "-D", "filter=tent", "--json").stdout)
    assert told["filter"] == "tent"


def test_info_has_numbers_for_people():
    assert [info.count(n) for n in (8194, 1_234_567, 2 * 10**9)] == [
        "8194",
        "1.23 million",
        "2 billion",
    ]
    sizes = [info.memory(n) for n in (0, 999, 999_600, 34_000_000)]
    assert sizes == ["0 bytes", "999 bytes", "1 MB", "34 MB"]
    shown = run(PYMLT, "info", "ring").stdout
    assert re.search(r"^memory +\d+ kB$", shown, re.M)
    assert re.search(r"^center +[-\d., ]+$", shown, re.M)


def test_info_shows_the_header_of_an_image(program, scene):
    run(program, scene, "--spp", 4, "--seed", 7, "--aov", "depth", "-o", "a.exr", "-o", "a.png")
    shown = run(PYMLT, "info", "a.exr").stdout
    assert re.search(r"^size +16 x 12$", shown, re.M)
    assert re.search(r"^channels +.*\bR\b.*depth", shown, re.M)
    assert re.search(r"^seed +7$", shown, re.M)
    header = json.loads(run(PYMLT, "info", "a.png", "--json").stdout)
    assert header["size"] == [16, 12]
    assert (header["format"], header["samples"], header["metadata"]) == ("png", "uint8", {})
    Path("b.exr").write_bytes(Path("a.exr").read_bytes()[:40])
    assert "b.exr" in the_error(run(PYMLT, "info", "b.exr"))


def test_help_groups_the_commands_and_shows_examples():
    shown = run(PYMLT, "--help").stdout
    for name in cli.COMMANDS:
        assert re.search(rf"^  {name} +[A-Z]", shown, re.M)
    examples = shown.partition("examples:\n")[2].splitlines()
    assert len(examples) > 3
    for example in examples[:-1]:
        cli.make_parser().parse_args(shlex.split(example)[1:])


def test_a_shell_completes_commands_flags_and_files(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    Path("hut.exr").touch()
    Path("complete.sh").write_text(run(PYMLT, "--print-completion", "bash").stdout)

    def completed(*words):
        script = 'source ./complete.sh; COMP_WORDS=("$@"); COMP_CWORD=$(($# - 1)); '
        script += "$(complete -p pymlt | grep -oP '(?<=-F )\\S+'); echo ${COMPREPLY[@]}"
        return run(["bash", "-c", script, "bash"], *words).stdout.split()

    assert completed("pymlt", "rend") == ["render"]
    assert completed("pymlt", "render", "--expo") == ["--exposure"]
    assert completed("pymlt", "merge", "hu") == ["hut.exr"]


def test_completion_says_what_it_needs(monkeypatch, capsys):
    monkeypatch.setitem(sys.modules, "shtab", None)
    assert cli.main(["--print-completion", "zsh"]) == 2
    assert "--print-completion needs `pip install 'shtab>=" in capsys.readouterr().err


def test_built_in_scenes_have_names(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    done = run(PYMLT, "render", "cornell-box", "--size", "16x16", "--spp", 2, "-o", "a.exr")
    assert done.returncode == 0
    assert mlt.read_image("a.exr").shape == (16, 16, 3)
    error = the_error(run(PYMLT, "render", "cornell-bx", "-o", "a.exr"))
    assert "did you mean 'cornell_box'?" in error
    assert "size" in the_error(run(PYMLT, "info", "cornell_box", "-D", "size=3"))


def test_list_names_plug_ins_and_scenes():
    assert "diffuse" in run(PYMLT, "list", "bsdf").stdout.split()
    assert "cornell_box" in run(PYMLT, "list", "scenes").stdout.split()
    everything = run(PYMLT, "list").stdout
    assert "\nintegrator:\n" in everything
    assert re.search(r"^  bitmap +An image, interpolated between its texels", everything, re.M)
    assert re.search(r"^  ring +\w", everything, re.M)
    assert "did you mean 'bsdf'?" in the_error(run(PYMLT, "list", "bsfd"))


def test_a_list_does_not_end_a_sentence_within_a_reference():
    environment = os.environ | {"COLUMNS": "200"}
    shown = run(PYMLT, "list", env=environment).stdout
    assert "(Cline et al. 2005): short chains from the paths of bidirectional path tracing" in shown
    assert "Veach 1997, ch. 10)." in shown
    said = r"  mmlt +Multiplexed Metropolis light transport \(Hachisuka et al. 2014\): [^.]*\.$"
    assert re.search(said, shown, re.M)  # its first sentence, and no other


def test_list_shows_the_parameters_of_a_plug_in():
    shown = run(PYMLT, "list", "mlt").stdout
    assert "lens_largest_share : float, default 0.1\n    Largest move on the image" in shown
    assert "integrator 'path'" in run(PYMLT, "list", "path").stdout
    assert "did you mean 'roughplastic'?" in the_error(run(PYMLT, "list", "roughplastik"))


def test_a_closed_pipe_is_no_error():
    done = run(["sh", "-c", f"{sys.executable} -m pymlt list | true"])
    assert done.stderr == ""


def test_without_a_command_there_is_help():
    shown = run(PYMLT)
    assert shown.returncode == 0
    assert shown.stdout.startswith("usage: pymlt")
    assert "Render a scene to image files." in shown.stdout


# ---- streams that are closed or full, names that are not UTF-8, short memory --------------------


def shell(command, redirection: str, *arguments):
    """With streams redirected: 2>&- closes stderr."""
    words = " ".join(shlex.quote(str(word)) for word in [*command, *arguments])
    return run(["bash", "-c", f"exec {words} {redirection}"])


@pytest.mark.parametrize("redirection", ["2>&-", "2>/dev/full", ">&- 2>&- <&-"])
def test_a_render_does_not_need_its_streams(program, scene, redirection):
    done = shell(program, redirection, scene, "--spp", 1, "-o", "a.exr", "-o", "a.png")
    assert done.returncode == 0
    assert np.array_equal(mlt.read_image("a.exr"), mlt.render(scene, spp=1))
    assert mlt.read_image("a.png").max() > 0


@pytest.mark.parametrize("redirection", ["2>&-", "2>/dev/full"])
def test_without_stderr_a_mistake_still_has_its_code(program, scene, redirection):
    assert shell(program, redirection, scene, "-o", "a.gif").returncode == 2


@pytest.mark.parametrize(
    "arguments",
    [["list"], ["--help"], ["render", "--help"], ["info", "furnace", "--json"], ["lab", "--list"]],
    ids=" ".join,
)
@pytest.mark.parametrize(
    ("redirection", "why"), [(">&-", "it is closed"), (">/dev/full", "No space left on device")]
)
def test_what_was_asked_for_and_cannot_be_written_is_an_error(arguments, redirection, why):
    error = the_error(shell(PYMLT, redirection, *arguments))
    assert error == f"pymlt: stdout: cannot write it: {why}"


def test_a_figure_that_the_disk_does_not_hold_is_an_error(tmp_path, monkeypatch):
    import matplotlib.font_manager  # noqa: F401 (its first import writes a cache)

    monkeypatch.chdir(tmp_path)
    flags = ["lab", "expected_values", "-o", "a.png"]
    done = run(PYMLT, *flags, preexec_fn=lambda: no_room_for(4096))
    assert done.returncode == 3
    announcement, problem = done.stderr.splitlines()
    assert announcement.startswith("pymlt: drawing expected_values: ")
    assert problem.startswith("pymlt: a.png: cannot write it: File too large")
    assert os.listdir() == []


def test_names_need_not_be_utf_8(program, scene):
    name = os.fsdecode(b"caf\xe9")
    os.rename(scene, f"{name}.xml")
    text = Path(f"{name}.xml").read_text()
    Path(f"{name}.xml").write_text(text.replace("</scene>", "<unheard/></scene>"))
    flags = ["--spp", 1, "-o", f"{name}.exr", "--checkpoint", name, "--stats", f"{name}.json"]
    done = run(program, f"{name}.xml", *flags, errors="surrogateescape")
    assert done.returncode == 0, done.stderr
    assert sorted(os.listdir(b"."))[:4] == [
        b"caf\xe9",
        b"caf\xe9.exr",
        b"caf\xe9.json",
        b"caf\xe9.xml",
    ]
    assert f"{name}.xml" in json.loads(Path(f"{name}.json").read_text())["warnings"][0]
    done = run(program, "--resume", name, "-o", "b.exr", errors="surrogateescape")
    assert done.returncode == 0, done.stderr
    missing = run(program, f"x{name}.xml", "-o", "b.exr", errors="surrogateescape")
    assert "there is no such file" in the_error(missing)
    neither = run(program, f"x{name}", "-o", "b.exr", errors="surrogateescape")
    assert "xcaf" in the_error(neither)
    assert mlt.read_image(f"{name}.exr").shape == (12, 16, 3)


@pytest.mark.parametrize("kilobytes", [100_000, 200_000])
def test_embree_is_not_blamed_for_short_memory(scene, kilobytes):
    binary = mlt_render() or pytest.skip("mlt-render is not installed beside this Python")
    error = the_error(run(binary, scene, *OUT, preexec_fn=lambda: little_memory(kilobytes)), code=3)
    assert "memory" in error
    assert "does not start" not in error


def little_memory(kilobytes: int) -> None:
    resource.setrlimit(resource.RLIMIT_AS, (1024 * kilobytes, 1024 * kilobytes))


def test_a_size_that_memory_does_not_hold_is_refused_before_the_work(program, scene):
    flags = [scene, "--size", "4000x4000", "--spp", 1, "-o", "a.exr"]
    before = time.perf_counter()
    error = the_error(run(program, *flags, preexec_fn=lambda: little_memory(2_000_000)), code=3)
    assert "an image of 4000 x 4000 pixels needs about 2.5 GB of memory" in error
    assert time.perf_counter() - before < 10


@pytest.mark.parametrize("integrator", ["path", "bdpt", "pssmlt"])
def test_a_render_ends_in_an_image_or_is_refused_whatever_memory_there_is(scene, integrator):
    binary = mlt_render() or pytest.skip("mlt-render is not installed beside this Python")
    flags = ["--integrator", integrator, "-p", "max_depth=2", "--size", "500x500", "--spp", "0.05"]
    outcomes = set()
    for megabytes in range(220, 620, 40):
        limit = 1024 * megabytes
        done = run(binary, scene, *flags, *OUT, preexec_fn=lambda limit=limit: little_memory(limit))
        outcomes.add(done.returncode)
        if done.returncode == 0:
            assert mlt.read_image("a.exr").max() > 0
            Path("a.exr").unlink()
        else:
            assert "memory" in the_error(done, code=3)
    assert outcomes == {0, 3}


def test_no_time_for_a_sample_is_an_error(program, scene):
    error = the_error(run(program, scene, "--time", "1e-9", *OUT), code=3)
    assert "the time was used up before the first sample" in error
    assert not Path("a.exr").exists()


def test_merge_says_what_it_has_made(scene):
    for seed in 1, 2:
        run([*PYMLT, "render"], scene, "--seed", seed, "--spp", 4, "-o", f"{seed}.exr")
    merged = run(PYMLT, "merge", "1.exr", "2.exr", "-o", "both.exr")
    assert merged.stderr == "pymlt: 2 renders of 16 x 12, 8 spp together: both.exr\n"


def test_info_says_that_the_integrator_cannot_render(scene):
    Path(scene).write_text(tiny.XML.replace('type="path"', 'type="photonmapper"'))
    told = run(PYMLT, "info", scene)
    assert told.returncode == 0
    assert "scene.xml:4: integrator 'photonmapper' is not supported" in told.stderr
    assert "cannot be rendered unless another is named" in told.stderr
    assert run([*PYMLT, "render"], scene, "--integrator", "path", *OUT).returncode == 0


def test_mlt_render_knows_the_built_in_scenes(tmp_path, monkeypatch):
    binary = mlt_render() or pytest.skip("mlt-render is not installed beside this Python")
    monkeypatch.chdir(tmp_path)
    flags = ["door_ajar", "-D", "opening=25", "--size", "16x12", "--spp", 2]
    assert run([*PYMLT, "render"], *flags, "-o", "a.exr").returncode == 0
    assert run(binary, *flags, "-o", "b.exr").returncode == 0
    a, b = mlt.read_image("a.exr"), mlt.read_image("b.exr")
    assert np.allclose(a, b, rtol=1e-4, atol=1e-6)
    assert "nowhere" in the_error(run(binary, "nowhere", *OUT))


def test_a_scene_may_come_through_a_pipe(program, scene):
    text = Path(scene).read_text()
    flags = ["/dev/stdin", "--spp", 2, "--checkpoint", "a.mlt", "-o", "a.exr"]
    done = run(program, *flags, input=text)
    assert done.returncode == 0, done.stderr
    assert np.array_equal(mlt.read_image("a.exr"), mlt.render(scene, spp=2))
    done = run(program, "--resume", "a.mlt", "--spp", 3, "-o", "a.exr")
    assert done.returncode == 0, done.stderr
    assert np.array_equal(mlt.read_image("a.exr"), mlt.render(scene, spp=3))


def test_a_built_in_scene_may_be_named_with_resume(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    flags = ["door-ajar", "-o", "a.exr", "--spp", 1]
    run([*PYMLT, "render"], *flags, "--size", "16x12", "--checkpoint", "a.mlt")
    done = run([*PYMLT, "render"], *flags, "--resume", "a.mlt")
    assert done.returncode == 0, done.stderr


def test_a_folder_that_is_gone_is_one_line(program, tmp_path):
    folder = tmp_path / "gone"
    folder.mkdir()
    render = f"{shlex.join(program)} ring -o a.exr"
    script = f"cd {shlex.quote(str(folder))} && rmdir ../gone && {render}"
    assert "the current folder is gone" in the_error(run(["sh", "-c", script]))
