"""Files of at most 300 lines, functions of at most 60: what fits into a reader's head."""

import ast
import re
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[2]
MOST_LINES, MOST_LINES_OF_A_FUNCTION = 300, 60
SOURCES = [
    *ROOT.glob("cpp/**/*.h"),
    *ROOT.glob("cpp/**/*.cpp"),
    *ROOT.glob("bindings/*.h"),
    *ROOT.glob("bindings/*.cpp"),
    *ROOT.glob("python/pymlt/**/*.py"),
]
#: Text in which braces and semicolons mean nothing, and lines of the preprocessor.
MEANINGLESS = re.compile(
    r'R"(\w*)\((?:.|\n)*?\)\1"|//[^\n]*|/\*(?:.|\n)*?\*/|"(?:\\.|[^"\\\n])*"'
    r"|'(?:\\.|[^'\\\n])'|^#[^\n]*",
    re.MULTILINE,
)
NO_FUNCTION = re.compile(r"\b(namespace|class|struct|enum|union)\b[^()]*$")


def functions_of_cpp(text):
    """The head and the number of lines of each block that is no type, namespace or table."""
    text = MEANINGLESS.sub(lambda found: "\n" * found[0].count("\n"), text)
    opened, head = [], 0
    for place, character in enumerate(text):
        if character == "{":
            opened.append((place, text[head:place].strip()))
        elif character == "}":
            start, name = opened.pop()
            if ")" in name and not name.endswith("=") and not NO_FUNCTION.search(name):
                yield name, text.count("\n", start, place) + 1
        if character in "{};":
            head = place + 1


def functions_of_python(text):
    for node in ast.walk(ast.parse(text)):
        if isinstance(node, ast.FunctionDef | ast.AsyncFunctionDef):
            body = node.body
            is_documented = ast.get_docstring(node) is not None
            first = body[1].lineno if is_documented and len(body) > 1 else body[0].lineno
            yield node.name, node.end_lineno - first + 1


def too_long(path):
    text = path.read_text()
    if (lines := text.count("\n")) > MOST_LINES:
        yield f"{lines} lines"
    functions = functions_of_python if path.suffix == ".py" else functions_of_cpp
    for name, lines in functions(text):
        if lines > MOST_LINES_OF_A_FUNCTION:
            yield f"{' '.join(name.split())[-60:]}: {lines} lines"


def test_no_file_and_no_function_is_too_long():
    found = {str(path.relative_to(ROOT)): list(too_long(path)) for path in SOURCES}
    assert {name: what for name, what in found.items() if what} == {}


@pytest.mark.parametrize("lines", [60, 61])
def test_a_long_function_is_found(tmp_path, lines):
    file = tmp_path / "long.cpp"
    statements = "  f('{');  // }\n" * (lines - 2)
    file.write_text(f"namespace a {{\nvoid f() {{\n{statements}}}\n}}\n")
    assert len(list(too_long(file))) == (lines == 61)
    file = file.with_suffix(".py")
    file.write_text(
        f'def f():\n    """Text."""\n{"    f()" + chr(10):s}' + "    f()\n" * (lines - 1)
    )
    assert len(list(too_long(file))) == (lines == 61)
