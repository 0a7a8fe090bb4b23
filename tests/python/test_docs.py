"""Documentation that can be wrong is tested: tables, links, names of the code, and commands."""

import importlib.util
import re
from pathlib import Path

import pytest

import pymlt as mlt
from pymlt.cli import make_parser

ROOT = Path(__file__).resolve().parents[2]
PAGES = [ROOT / "README.md", *ROOT.glob("docs/*.md"), *ROOT.glob("docs/mutations/*.md")]
PAGES += ROOT.glob("scenes/**/*.md")


def script(path):
    """A script of the documentation as a module."""
    spec = importlib.util.spec_from_file_location(Path(path).stem, ROOT / "docs" / path)
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


def test_the_tables_of_parameters_are_those_of_the_schemas():
    module = script("make_integrators.py")
    text = module.PAGE.read_text()
    assert set(re.findall("<!-- parameters: (.*) -->", text)) == set(mlt.available("integrator"))
    assert text == module.page(text), "run: python docs/make_integrators.py"


@pytest.mark.parametrize("page", PAGES, ids=lambda p: str(p.relative_to(ROOT)))
def test_links_lead_somewhere(page):
    for target in re.findall(r"\]\(([^)#]+)(?:#[^)]*)?\)", page.read_text()):
        assert target.startswith("https://") or (page.parent / target).exists(), target


@pytest.mark.parametrize("page", PAGES, ids=lambda p: str(p.relative_to(ROOT)))
def test_commands_parse(page):
    """Every `pymlt ...` line in an indented or fenced block is one that pymlt understands."""
    for line in re.findall(r"^ *pymlt (.*?)(?: +#.*)?$", page.read_text(), re.MULTILINE):
        args = make_parser().parse_args(line.split())
        if getattr(args, "scene", None) and not args.scene.endswith(".xml"):
            assert args.scene.replace("-", "_") in mlt.scenes.names()
        if getattr(args, "integrator", None):
            assert args.integrator in mlt.available("integrator")


# ---- the code that pages talk about

# Files that do not exist, but would if somebody followed the page.
IMAGINED = {"bsdf/minnaert.cpp", "mutation/nudge.cpp", "integrator/next_event.cpp"}


def sources():
    folders = ("cpp", "bindings", "python", "tests", "cmake", "benchmarks", "docs")
    kinds = (".cpp", ".h", ".inc", ".py", ".pyi", ".cmake", ".txt")
    for folder in folders:
        yield from (path for path in (ROOT / folder).rglob("*.*") if path.suffix in kinds)


@pytest.fixture(scope="module")
def words():
    """All words of the code, and of the names of its files."""
    found = set()
    for path in sources():
        if path != Path(__file__).resolve():
            found.update(re.findall(r"\w+", path.read_text(errors="replace")))
            found.update(re.findall(r"\w+", str(path.relative_to(ROOT))))
    return found


NAMING = ["house", "how-to-add", "notation", "strategies", "correctness"]


@pytest.mark.parametrize("name", NAMING)
def test_what_a_page_names_exists_in_the_code(name, words):
    text = re.sub(r"```.*?```", "", (ROOT / "docs" / f"{name}.md").read_text(), flags=re.DOTALL)
    for span in re.findall(r"`([^`\n]+)`", text):
        assert set(re.findall(r"[A-Za-z_]\w{2,}", span)) <= words, span


@pytest.mark.parametrize("page", PAGES, ids=lambda p: str(p.relative_to(ROOT)))
def test_files_that_a_page_names_exist(page):
    for path in re.findall(r"`((?:cpp|bindings|python|tests)/[\w/.-]+)`", page.read_text()):
        imagined = any(path.endswith(name) for name in IMAGINED)
        assert imagined or (ROOT / path).exists(), path


def test_the_house_is_drawn_as_the_script_draws_it():
    house = script("images/make_house.py")
    assert house.PICTURE.read_text() == house.picture(), "run: python docs/images/make_house.py"


def test_each_floor_uses_only_floors_below_it():
    floors = [name for name, _ in script("images/make_house.py").FLOORS]
    assert sorted(floors[:-1]) == sorted(path.name for path in (ROOT / "cpp").iterdir())
    for path in [*ROOT.glob("cpp/**/*.h"), *ROOT.glob("cpp/**/*.cpp")]:
        above = floors[floors.index(path.relative_to(ROOT / "cpp").parts[0]) + 1 :]
        for included in re.findall(r'#include "(\w+)/', path.read_text()):
            assert included not in above, f"{path.relative_to(ROOT)} includes {included}/"


EXAMPLES = sorted((ROOT / "docs" / "examples").glob("*.cpp"))


@pytest.mark.parametrize("example", EXAMPLES, ids=lambda p: p.stem)
def test_examples_are_shown_and_short(example):
    page = (ROOT / "docs" / "how-to-add.md").read_text()
    assert f"```{{literalinclude}} examples/{example.name}" in page
    code = [line for line in example.read_text().splitlines() if not re.match(r"\s*(//|$)", line)]
    assert len(code) <= 40


# ---- the code in pages


def python_of(page):
    """All Python of a page as one program."""
    return "\n".join(re.findall(r"```python\n(.*?)```", (ROOT / page).read_text(), re.DOTALL))


def test_the_mutation_of_the_page_on_prototypes_is_right(capsys):
    exec(compile(python_of("docs/prototyping.md"), "prototyping.md", "exec"), {})
    assert "right: none of" in capsys.readouterr().out


def test_the_python_examples_of_the_readme_run(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    code = python_of("README.md")
    assert "mlt.render(" in code
    # The same statements on small images, so that they take no time.
    code = re.sub(r"(spp|time)=[\d.]+", r"\1=1", code)
    load_dict = mlt.load_dict
    monkeypatch.setattr(mlt, "load_dict", lambda scene: load_dict(scene, size=(24, 16)))
    exec(compile(code, "README.md", "exec"), {})
