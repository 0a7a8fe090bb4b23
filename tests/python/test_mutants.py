"""The list of bugs that `make mutants` injects fits the code, and the documentation."""

import importlib.util
import re
import sys

import pytest
from conftest import REPOSITORY


def load():
    spec = importlib.util.spec_from_file_location("mutants", REPOSITORY / "tests/mutants/run.py")
    module = sys.modules[spec.name] = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


mutants = load()
LIST = mutants.read_list()


@pytest.mark.parametrize("mutant", LIST, ids=lambda mutant: mutant.name)
def test_a_mutant_changes_one_place(mutant):
    assert mutant.old != mutant.new
    mutant.check(REPOSITORY)
    first = mutant.tests if mutant.tests.endswith(".py") else re.match(r"\w+", mutant.tests)[0]
    assert (REPOSITORY / first).is_file() or (REPOSITORY / "tests" / "cpp" / first).is_dir()


def test_the_table_of_the_documentation_names_every_mutant():
    table = (REPOSITORY / "docs" / "mutants.md").read_text()
    assert re.findall(r"^\| `(\w+)` \|", table, re.MULTILINE) == [m.name for m in LIST]


FOUND_BY = re.findall(
    r"^\| `\w+` \| .* \| `([^`]*)` \|$",
    (REPOSITORY / "docs" / "mutants.md").read_text(),
    re.MULTILINE,
)


@pytest.mark.parametrize("test", sorted(set(FOUND_BY)))
def test_a_test_that_the_documentation_names_exists(test):
    if ".py" in test:
        file, name = re.match(r"(?:tests/python/)?(\w+\.py)::(\w+)", test).groups()
        definition, files = f"def {name}\\b", [REPOSITORY / "tests/python" / file]
    else:
        parts = r"(\w+)\.(?:[A-Z]\w*/)?([A-Z]\w*)(?:/\d+)?\.(\w*)"
        folder, suite, name = re.match(parts, test).groups()
        definition = rf"TEST\w*\(\s*{suite},\s*{name}"
        files = (REPOSITORY / "tests" / "cpp" / folder).rglob("*.cpp")
    assert any(re.search(definition, path.read_text()) for path in files)


def test_a_mutant_whose_text_is_gone_is_an_error_that_names_it(tmp_path):
    mutant = mutants.Mutant("twice", "a.h", old="x", new="y", tests="math")
    for text, times in [("", 0), ("x x", 2)]:
        (tmp_path / "a.h").write_text(text)
        with pytest.raises(mutants.MutantError, match=f"'twice': .* {times} times in a.h"):
            mutant.inject(tmp_path)
    (tmp_path / "a.h").write_text("x z")
    assert mutant.inject(tmp_path) == "x z"
    assert (tmp_path / "a.h").read_text() == "y z"


def test_some_mutants_can_be_chosen():
    last, first = LIST[-1].name, LIST[0].name
    assert mutants.choose(LIST, [last, first], "1/1") == [LIST[-1], LIST[0]]
    assert [m for i in "123" for m in mutants.choose(LIST, [], f"{i}/3")][1] == LIST[3]
    with pytest.raises(mutants.MutantError, match="no mutant 'nobody'"):
        mutants.choose(LIST, ["nobody"], "1/1")
    with pytest.raises(mutants.MutantError, match="expected I/N"):
        mutants.choose(LIST, [], "3/2")
