"""What is said where a package that only some need is missing."""

import re
import shlex
import sys
import tomllib
from pathlib import Path

import pytest
import tiny

import pymlt as mlt
from pymlt._extras import import_extra

PROJECT = tomllib.loads((Path(__file__).parents[2] / "pyproject.toml").read_text())["project"]
EXTRAS = PROJECT["optional-dependencies"]


def name(requirement: str) -> str:
    return re.match(r"[\w-]+", requirement)[0]


@pytest.mark.parametrize("extra", sorted(EXTRAS.keys() - {"test", "dev", "docs"}))
def test_the_packages_themselves_are_named(extra):
    with pytest.raises(mlt.UsageError) as error:
        import_extra("no_such_module", extra, "this")
    command = str(error.value).removeprefix("this needs `pip install ").removesuffix("`")
    assert list(map(name, shlex.split(command))) == list(map(name, EXTRAS[extra]))


def test_a_cluster_names_them(monkeypatch):
    monkeypatch.setitem(sys.modules, "distributed", None)
    with pytest.raises(mlt.UsageError, match="a cluster needs `pip install 'cryptography>="):
        mlt.render(tiny.scene(), spp=1, cluster="local:1")
