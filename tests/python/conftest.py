"""What all Python tests share: where the external scenes are, which tests run, sharding."""

import importlib.util
import os
from pathlib import Path

import pytest
import tiny
from command_line import PYMLT, mlt_render
from nanovdb_files import nanovdb as nanovdb_file

import pymlt as mlt

REPOSITORY = Path(__file__).resolve().parents[2]


def shared_root() -> Path:
    """The folder of external scenes and references; it need not exist."""
    return Path(os.environ.get("PYMLT_SHARED") or REPOSITORY.parent / "shared")


@pytest.fixture(scope="session")
def repository() -> Path:
    return REPOSITORY


@pytest.fixture(scope="session")
def shared() -> Path:
    """The external scenes and references; for tests that are marked `shared`."""
    return shared_root()


@pytest.fixture(params=["pymlt", "mlt-render"])
def program(request) -> list[str]:
    if request.param == "pymlt":
        return [*PYMLT, "render"]
    return mlt_render() or pytest.skip("mlt-render is not installed beside this Python")


@pytest.fixture
def scene(tmp_path, monkeypatch) -> str:
    monkeypatch.chdir(tmp_path)
    (tmp_path / "scene.xml").write_text(tiny.XML)
    return "scene.xml"


@pytest.fixture
def nanovdb():
    """What makes NanoVDB files, where the build reads them."""
    no_volume = {"type": "nanovdb", "filename": __file__}
    fog = {"type": "heterogeneous", "sigma_t": no_volume}
    with pytest.raises(mlt.FileError) as error:
        mlt.load_dict({"type": "scene", "sensor": {"type": "perspective", "medium": fog}})
    if "does not read" in str(error.value):
        pytest.skip(str(error.value))
    return nanovdb_file


def pytest_addoption(parser):
    parser.addoption("--shard", default="1/1", metavar="I/N", help="run the I-th of N parts")


def pytest_collection_modifyitems(config, items):
    missing = {
        "shared": not (shared_root() / "scenes").is_dir(),
        "peer": importlib.util.find_spec("mitsuba") is None,
    }
    reasons = {
        "shared": f"no external scenes in {shared_root()} (set PYMLT_SHARED)",
        "peer": "Mitsuba 3 is not installed (pip install mitsuba)",
    }
    for item in items:
        for marker, absent in missing.items():
            if absent and item.get_closest_marker(marker):
                item.add_marker(pytest.mark.skip(reason=reasons[marker]))


@pytest.hookimpl(trylast=True)
def pytest_collection_finish(session):
    """Deal the selected tests out like cards, so that each shard gets some of every file."""
    index, count = parse_shard(session.config.getoption("shard"))
    session.items[:] = session.items[index - 1 :: count]


def parse_shard(text: str) -> tuple[int, int]:
    index, slash, count = text.partition("/")
    valid = slash and index.isdigit() and count.isdigit() and 1 <= int(index) <= int(count)
    if not valid:
        raise pytest.UsageError(f"--shard {text}: expected I/N with 1 <= I <= N, such as 2/4")
    return int(index), int(count)
