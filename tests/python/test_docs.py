"""Documentation that can be wrong is tested: tables, links, and the commands of the README."""

import importlib.util
import re
from pathlib import Path

import pytest

import pymlt as mlt
from pymlt.cli import make_parser

ROOT = Path(__file__).resolve().parents[2]
PAGES = [ROOT / "README.md", *ROOT.glob("docs/*.md"), *ROOT.glob("docs/mutations/*.md")]
PAGES += ROOT.glob("scenes/**/*.md")


def test_the_tables_of_parameters_are_those_of_the_schemas():
    path = ROOT / "docs" / "make_integrators.py"
    spec = importlib.util.spec_from_file_location("make_integrators", path)
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
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
