"""What a release consists of: one version, wheels with everything in them, workflows that parse."""

import importlib.util
import re
import subprocess
import sys
import tomllib
import zipfile
from pathlib import Path

import pytest

import pymlt as mlt

ROOT = Path(__file__).resolve().parents[2]
WORKFLOWS = sorted((ROOT / ".github" / "workflows").glob("*.yml"))


@pytest.fixture
def check(monkeypatch):
    """The script of `make release-check`."""
    monkeypatch.syspath_prepend(str(ROOT / "release"))
    spec = importlib.util.spec_from_file_location("check", ROOT / "release" / "check.py")
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    yield module
    sys.modules.pop("make_wheels", None)


def test_all_files_name_one_version(check):
    assert check.version() == mlt.__version__


def wheel_of(check, tmp_path, leave_out=()):
    names = ["pymlt/_core.so", "pymlt/wide/_core.so", "pymlt/scene_files/ring/scene.xml"]
    names += ["pymlt/py.typed", "pymlt.libs/libpng16-01234567.so.16"]
    names += ["pymlt-1.dist-info/licenses/bundled/libpng16-16.txt"]
    path = tmp_path / f"pymlt-{check.version()}-cp311-cp311-manylinux_2_34_x86_64.whl"
    with zipfile.ZipFile(path, "w") as file:
        for name in names:
            if name not in leave_out:
                file.writestr(name, "")
    return path


def test_a_wheel_with_everything_passes(check, tmp_path):
    check.check_files(wheel_of(check, tmp_path))


@pytest.mark.parametrize(
    "missing", ["pymlt/wide/_core.so", "pymlt-1.dist-info/licenses/bundled/libpng16-16.txt"]
)
def test_a_wheel_in_which_something_is_missing_does_not_pass(check, tmp_path, missing):
    with pytest.raises(AssertionError):
        check.check_files(wheel_of(check, tmp_path, leave_out=[missing]))


def test_the_hashes_are_those_of_all_files(check, tmp_path, monkeypatch):
    make_wheels = sys.modules["make_wheels"]
    monkeypatch.setattr(make_wheels, "DIST", tmp_path)
    for name in ("b.whl", "a.tar.gz", "c.txt"):
        (tmp_path / name).write_text(name)
    make_wheels.write_sums()
    command = ["sha256sum", "--strict", "-c", "SHA256SUMS"]
    said = subprocess.run(command, cwd=tmp_path, capture_output=True, text=True, check=True)
    assert said.stdout.splitlines() == ["a.tar.gz: OK", "b.whl: OK"]


def test_a_wheel_names_no_folder_of_the_machine_that_made_it(check, tmp_path):
    path = wheel_of(check, tmp_path)
    with zipfile.ZipFile(path, "a") as file:
        file.writestr("pymlt/other", f"found in {ROOT}/scenes")
    with pytest.raises(AssertionError, match="names"):
        check.check_files(path)


@pytest.mark.parametrize("path", WORKFLOWS, ids=lambda p: p.stem)
def test_workflows_are_complete_and_call_targets_of_the_makefile(path):
    yaml = pytest.importorskip("yaml")
    workflow = yaml.safe_load(path.read_text())
    # YAML 1.1 reads the key `on` as a truth value.
    assert workflow["name"] == path.stem
    assert workflow.get("on") or workflow[True]
    targets = set(re.findall(r"^([a-z-]+):(?!=)", (ROOT / "Makefile").read_text(), re.MULTILINE))
    for job in workflow["jobs"].values():
        assert job["runs-on"]
        assert job["steps"]
        for step in job["steps"]:
            assert ("run" in step) != ("uses" in step), step
            for target in re.findall(r"^make ([a-z-]+)", step.get("run", ""), re.MULTILINE):
                assert target in targets, target


@pytest.mark.parametrize("target", ["wheel", "blender", "release-check"])
def test_the_makefile_says_what_a_release_runs(target):
    plan = subprocess.run(
        ["make", "-n", target], cwd=ROOT, capture_output=True, text=True, check=True
    ).stdout
    scripts = {"wheel": "make_wheels", "blender": "make_extension", "release-check": "check"}
    assert f"release/{scripts[target]}.py" in plan


def test_the_conda_package_is_what_the_wheel_is():
    yaml = pytest.importorskip("yaml")
    recipe = yaml.safe_load((ROOT / "release" / "conda" / "recipe.yaml").read_text())
    project = tomllib.loads((ROOT / "pyproject.toml").read_text())["project"]
    assert recipe["context"]["version"] == project["version"]
    assert recipe["about"]["summary"] == project["description"]
    assert recipe["about"]["license"] == project["license"]
    names = {"OpenImageIO": "py-openimageio"}  # of what conda-forge calls otherwise
    asked = [re.fullmatch(r"([\w-]+)(>=\S+)", need).groups() for need in project["dependencies"]]
    needs = {f"{names.get(name, name)} {version}" for name, version in asked}
    assert set(recipe["requirements"]["run"]) == {"python", *needs}
    script = recipe["build"]["script"].replace("${{ PYTHON }}", sys.executable)
    flags = script.replace("${{ version }}", project["version"]).split()
    tried = [*flags, "--dry-run", "--ignore-installed"]
    said = subprocess.run(tried, cwd=ROOT / "release", capture_output=True, text=True)
    assert f"pymlt=={project['version']}" in said.stderr  # that there is no wheel here


# ---- what others supply --------------------------------------------------------------------------


def test_actions_are_those_of_one_commit_and_may_only_read():
    assert WORKFLOWS
    for path in WORKFLOWS:
        text = path.read_text()
        assert "\npermissions:\n  contents: read\n" in text, path
        for action in re.findall(r"uses: (\S+)", text):
            assert re.fullmatch(r"[\w./-]+@[0-9a-f]{40}", action), f"{path}: {action}"


def test_every_package_from_pypi_has_a_version_and_a_hash():
    project = tomllib.loads((ROOT / "pyproject.toml").read_text())["project"]
    for extra in ("build", "dev", "docs", "fuzz", "release"):
        text = (ROOT / "requirements" / f"{extra}.txt").read_text()
        pinned = r"^([\w.-]+)==\S+ ?[^\n]*\\\n    --hash=sha256:[0-9a-f]{64}"
        packages = re.findall(pinned, text, re.M)
        assert len(packages) == len(re.findall(r"^\w", text, re.M)) > 3
        asked = [*project["dependencies"], *project["optional-dependencies"][extra]]
        names = {re.match(r"[\w-]+", name)[0].lower() for name in asked if "[" not in name}
        assert names <= set(packages)
