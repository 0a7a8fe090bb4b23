"""Documentation that can be wrong is tested: tables, links, names of the code, and commands."""

import ast
import importlib.util
import re
import shlex
import subprocess
import tomllib
from pathlib import Path

import pytest
from test_instructions import CASES

import pymlt as mlt
from pymlt.cli import make_parser

ROOT = Path(__file__).resolve().parents[2]
PAGES = [ROOT / "README.md", *ROOT.glob("docs/*.md"), *ROOT.glob("docs/mutations/*.md")]
PAGES += ROOT.glob("docs/course/*.md")
PAGES += ROOT.glob("scenes/**/*.md")
WITH_NOTES = [*PAGES, ROOT / "CONTRIBUTING.md", ROOT / "CHANGELOG.md"]


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


def test_the_table_of_flags_is_that_of_the_programs():
    module = script("make_command_line.py")
    text = module.PAGE.read_text()
    assert "| `-o, --output FILE` |" in text
    assert text == module.page(text), "run: python docs/make_command_line.py"


@pytest.mark.parametrize("command", ["render", "race"])
def test_every_flag_has_an_example(command):
    text = (ROOT / "docs" / "command-line.md").read_text()
    table = re.search(rf"<!-- flags: {command} -->(.*?)<!-- end -->", text, re.DOTALL)[1]
    examples = re.findall(rf"^pymlt ({command} .*)$", text, re.MULTILINE)
    used = {word for line in examples for word in line.split() if word.startswith("-")}
    for spelling in re.findall(r"^\| `([^`]*)`", table, re.MULTILINE):
        assert used & set(re.findall(r"-+[a-zA-Z-]+", spelling)), spelling


def test_the_instructions_of_the_benchmarks_are_those_that_are_guarded():
    table = (ROOT / "docs" / "benchmarks.md").read_text().partition("### What a sample costs")[2]
    names, _, numbers = re.findall(r"^\|(.*)\|$", table, re.MULTILINE)[:3]
    said = dict(zip(re.findall(r"\w+", names), map(int, numbers.split("|")), strict=True))
    assert said == {name: instructions for name, (_, _, instructions) in CASES.items()}


def test_the_readme_is_a_screen_and_a_half():
    assert len((ROOT / "README.md").read_text().splitlines()) <= 75


def test_each_page_is_in_the_navigation():
    docs = ROOT / "docs"
    pages = {str(page.relative_to(docs).with_suffix("")) for page in docs.rglob("*.md")}
    written = {page for page in pages if not page.startswith("auto_")} - {"index"}
    assert written <= set((docs / "index.md").read_text().splitlines())


def test_each_name_of_the_package_is_on_one_page_of_the_reference():
    topics = script("conf.py").TOPICS
    shown = [name for _, names, _ in topics.values() for name in names.split()]
    assert len(shown) == len(set(shown))
    modules = {name.split(".")[0] for _, _, modules in topics.values() for name in modules}
    assert set(mlt.__all__) <= {*shown, *modules, "__version__"}
    navigation = (ROOT / "docs" / "index.md").read_text().splitlines()
    assert {f"auto_api/{topic}" for topic in topics} <= set(navigation)


def test_the_demo_builds_and_installs_nothing_for_tests(tmp_path):
    """And its last lines say what to type next."""
    places = [f"STAMPS={tmp_path}/stamps", f"VENV={tmp_path}/venv", f"BIN={tmp_path}/venv/bin"]
    plan = subprocess.run(
        ["make", "-n", "--no-print-directory", *places, "demo"],
        cwd=ROOT,
        capture_output=True,
        text=True,
        check=True,
    ).stdout
    assert "PYMLT_TESTS=OFF" in plan
    assert "apt-packages.txt" in plan
    assert "apt-packages-test.txt" not in plan
    assert "requirements/dev.txt" not in plan
    assert "activate" in plan.splitlines()[-2]
    assert "pymlt render" in plan.splitlines()[-1]
    everything = subprocess.run(
        ["make", "-n", *places, "build"], cwd=ROOT, capture_output=True, text=True, check=True
    ).stdout
    for what in "PYMLT_TESTS=ON", "apt-packages-test.txt", "requirements/dev.txt":
        assert what in everything


def test_extras_are_those_that_are_used():
    project = tomllib.loads((ROOT / "pyproject.toml").read_text())["project"]
    package = "\n".join(path.read_text() for path in (ROOT / "python").rglob("*.py"))
    of_make = {"test", "dev", "docs", "fuzz", "build", "release"}
    for extra in set(project["optional-dependencies"]) - of_make:
        assert f'"{extra}"' in package, extra


TOPICS = ["quadrature", "stratified", "importance", "combined", "transport equation", "t\\*"]
TOPICS += ["c_ij", "extended recording", "acceptance", "detailed balance", "two states"]
TOPICS += ["parabola", "mutate_1", "mutate_2", "mixture", "blur", "reflection", "initialisation"]
TOPICS += ["start-up bias", "perturbations", "choice of mutations", "adaptivity", "ergodicity"]


def test_each_topic_of_the_lecture_has_its_figure_and_slider():
    from pymlt.lab import gallery
    from pymlt.viewing.lecture_examples import EXAMPLES

    page = (ROOT / "docs" / "lecture.md").read_text()
    rows = [line.split("|") for line in page.splitlines() if line.startswith("| ")][1:]
    assert set(re.findall(r"`pymlt lab (\w+)`", page)) == set(gallery.names())
    assert {row[4].strip() for row in rows} - {""} == {example.name for example in EXAMPLES}
    said = page.lower()
    for topic in TOPICS:
        assert topic in said, topic


def test_scripts_of_the_gallery_stand_in_the_order_of_the_lecture():
    place = script("conf.py").place_in_the_lecture
    scripts = sorted((path.name for path in ROOT.glob("docs/gallery/*.py")), key=place)
    assert (scripts[0], scripts[-1]) == ("quadrature.py", "ergodicity.py")


def test_the_questions_have_the_words_of_newcomers():
    """By which the site's search finds them."""
    said = set(re.findall(r"\w+", (ROOT / "docs" / "questions.md").read_text().lower()))
    assert {"caustic", "fireflies", "noise", "denoise", "slow", "black", "glass"} <= said


def test_the_headings_that_links_name_exist():
    for page in WITH_NOTES:
        for target, heading in re.findall(r"\]\(([^)#:]*\.md)?#([^)]+)\)", page.read_text()):
            text = ((page.parent / target) if target else page).read_text()
            headings = re.findall(r"^#+ (.*)$", text, re.MULTILINE)
            slugs = {re.sub(r"[^\w -]", "", h.lower()).replace(" ", "-") for h in headings}
            assert heading in slugs, f"{page.name}: {target}#{heading}"


def test_no_two_pages_have_one_title():
    titles = [re.search(r"^# (.*)$", page.read_text(), re.MULTILINE)[1] for page in PAGES[1:]]
    titles.append((ROOT / "docs" / "gallery" / "GALLERY_HEADER.rst").read_text().splitlines()[0])
    assert len(titles) == len(set(titles))


def test_the_documentation_needs_no_network():
    """Formulas are drawn by a copy of MathJax that is built in."""
    assert '"sphinx-mathjax-offline"' in (ROOT / "docs" / "conf.py").read_text()


@pytest.mark.parametrize("page", PAGES, ids=lambda p: str(p.relative_to(ROOT)))
def test_links_lead_somewhere(page):
    for target in re.findall(r"\]\(([^)#]+)(?:#[^)]*)?\)", page.read_text()):
        assert target.startswith("https://") or (page.parent / target).exists(), target


@pytest.mark.parametrize("page", PAGES, ids=lambda p: str(p.relative_to(ROOT)))
def test_commands_parse(page):
    """Every `pymlt ...` line in an indented or fenced block is one that pymlt understands."""
    for line in re.findall(r"^ *pymlt (.*?)(?: +#.*)?$", page.read_text(), re.MULTILINE):
        args = make_parser().parse_args(shlex.split(line))
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
    yield from (ROOT / name for name in ("Makefile", "CMakeLists.txt", "CMakePresets.json"))
    yield from (ROOT / name for name in (".clangd", ".pre-commit-config.yaml", "CITATION.cff"))


@pytest.fixture(scope="module")
def words():
    """All words of the code, and of the names of its files."""
    found = {word for path in ROOT.iterdir() for word in re.findall(r"\w+", path.name)}
    for path in sources():
        if path != Path(__file__).resolve():
            found.update(re.findall(r"\w+", path.read_text(errors="replace")))
            found.update(re.findall(r"\w+", str(path.relative_to(ROOT))))
    return found


NAMING = [f"docs/{name}.md" for name in ("house", "how-to-add", "notation", "strategies")]
NAMING += ["docs/correctness.md", "docs/waves.md", "CONTRIBUTING.md"]


@pytest.mark.parametrize("name", NAMING)
def test_what_a_page_names_exists_in_the_code(name, words):
    text = re.sub(r"```.*?```", "", (ROOT / name).read_text(), flags=re.DOTALL)
    for span in re.findall(r"`([^`\n]+)`", text):
        assert set(re.findall(r"\b[A-Za-z_]\w{2,}", span)) <= words, span


@pytest.mark.parametrize("page", WITH_NOTES, ids=lambda p: str(p.relative_to(ROOT)))
def test_files_that_a_page_names_exist(page):
    text = page.read_text().partition("\n## [0")[0]  # not what an earlier release had
    for path in re.findall(r"`((?:cpp|bindings|python|tests)/[\w/.-]+)`", text):
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


def contributing(pattern):
    return re.search(pattern, (ROOT / "CONTRIBUTING.md").read_text(), re.DOTALL)[1]


def test_the_floors_of_contributing_are_those_of_the_house():
    said = contributing(r"from the\s+ground up: (.*?);")
    floors = [name for name, _ in script("images/make_house.py").FLOORS]
    assert re.findall(r"\w+", said) == floors
    assert {path.parts[-2] for path in ROOT.glob("tests/cpp/*/test_*.cpp")} <= set(floors)


def imported_parts(path):
    """The parts of pymlt from which a file of it imports anything, inside of functions too."""
    package = ("pymlt", *path.relative_to(ROOT / "python" / "pymlt").parts[:-1])
    for node in ast.walk(ast.parse(path.read_text())):
        if isinstance(node, ast.Import):
            modules = [alias.name.split(".") for alias in node.names]
        elif isinstance(node, ast.ImportFrom):
            above = package[: len(package) + 1 - node.level] if node.level else ()
            module = [*above, *(node.module or "").split(".")]
            modules = [[*filter(None, module), alias.name] for alias in node.names]
        else:
            continue
        yield from (module[1] for module in modules if module[0] == "pymlt" and len(module) > 1)


def test_each_part_of_the_package_imports_only_what_stands_above_it():
    table = contributing(r"\| where in `python/pymlt` \| what \|\n(.*?)\n\n")
    rows = " ".join(re.findall(r"^\| (.*?) \|", table, re.MULTILINE))
    order = [Path(name).stem for name in re.findall(r"`([\w.]+)`", rows)]
    order = [
        "_core",
        "_interrupt",
        "_processor",
        "_extras",
        *order,
        "_stubs",
        "__init__",
        "__main__",
    ]
    for path in (ROOT / "python" / "pymlt").rglob("*.py"):
        part = path.relative_to(ROOT / "python" / "pymlt").with_suffix("").parts[0]
        assert part in order, f"CONTRIBUTING.md does not list {part}"
        allowed = order[: order.index(part) + 1]
        for imported in imported_parts(path):
            assert imported in allowed, f"{path.relative_to(ROOT)} imports {imported}"


# Tables of numbers, one row a line.
DATA = {"cpp/scene/emitter/sky_model.inc", "tests/cpp/scene/bsdf/mitsuba_values.inc"}


def test_comments_can_be_read_alone():
    """A comment that begins so needs the one above it, which tools do not show."""
    incomplete = re.compile(r"(?<!/)//[/]?<? ?(Of|The same|Those)\b.*")
    found = [
        f"{path.relative_to(ROOT)}: {comment[0]}"
        for path in [*ROOT.glob("cpp/**/*.h"), *ROOT.glob("cpp/**/*.cpp"), *ROOT.glob("bindings/*")]
        for comment in incomplete.finditer(path.read_text())
        if not continues(path.read_text(), comment.start())
    ]
    assert not found


def continues(text, place):
    """Whether the line above is a comment, too, of which this one is not the beginning."""
    above = text[:place].rstrip(" ").removesuffix("\n").rsplit("\n", 1)[-1].strip()
    return text[:place].rstrip(" ").endswith("\n") and above.startswith("//")


@pytest.mark.parametrize("folder", ["cpp", "bindings", "tests/cpp", "tests/fuzz", "benchmarks"])
def test_no_line_of_cpp_is_longer_than_the_formatter_allows(folder):
    limit = int(re.search(r"ColumnLimit: (\d+)", (ROOT / ".clang-format").read_text())[1])
    long = []
    for path in (ROOT / folder).rglob("*.*"):
        name = str(path.relative_to(ROOT))
        if path.suffix not in (".cpp", ".h", ".inc") or name in DATA:
            continue
        formatted = True
        for i, line in enumerate(path.read_text().splitlines(), 1):
            formatted = "clang-format on" in line if "clang-format o" in line else formatted
            if formatted and len(line) > limit:
                long.append(f"{name}:{i}")
    assert not long


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


def test_nothing_is_found_wrong_on_the_page_on_prototypes(capsys):
    exec(compile(python_of("docs/prototyping.md"), "prototyping.md", "exec"), {})
    assert "nothing found; a shift of the image position by more than" in capsys.readouterr().out


def test_the_names_of_the_migration_note_exist():
    exec(compile(python_of("docs/migration-0.3.md"), "migration-0.3.md", "exec"), {})


@pytest.mark.parametrize("page", ["README.md", "docs/quick-start.md", "docs/editing.md"])
def test_the_python_examples_of_the_first_pages_run(page, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    code = python_of(page)
    assert "mlt.render(" in code
    # The same statements on small images, so that they take no time.
    code = re.sub(r"(spp|time)=[\d.]+", "spp=1", code)
    load_dict = mlt.load_dict
    monkeypatch.setattr(mlt, "load_dict", lambda scene, size=None: load_dict(scene, size=(24, 16)))
    exec(compile(code, page, "exec"), {})
