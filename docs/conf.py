"""How Sphinx builds the documentation: `make docs`.

Pages are Markdown (MyST). The gallery is made by running docs/gallery; the pages of the Python
interface and of the plug-ins are made from what the package itself says.
"""

import inspect
from importlib import import_module
from pathlib import Path

import pymlt
from pymlt import _core

HERE = Path(__file__).parent

project = "pymlt"
author = "The pymlt authors"
copyright = author
version = release = pymlt.__version__

extensions = [
    "myst_parser",
    "sphinx_copybutton",
    "sphinx_design",
    "sphinx.ext.autodoc",
    "sphinx.ext.napoleon",
    "sphinx-mathjax-offline",
    "sphinx_gallery.gen_gallery",
]
source_suffix = {".md": "markdown", ".rst": "restructuredtext"}
exclude_patterns = ["gallery", "auto_gallery/*.py", "auto_gallery/*.ipynb"]
default_role = "code"
# Links that leave docs/ are for readers of the repository; tests/python/test_docs.py follows them.
suppress_warnings = ["config.cache", "myst.xref_missing"]

html_theme = "furo"
html_title = f"pymlt {version}"
html_copy_source = False
html_logo = html_favicon = "images/logo.svg"
html_static_path = ["style"]
html_css_files = ["pages.css"]
highlight_language = "none"  # Blocks that name no language are commands, mostly.

myst_enable_extensions = ["amsmath", "colon_fence", "deflist", "dollarmath"]
myst_heading_anchors = 3

autodoc_member_order = "bysource"
autodoc_typehints = "none"
napoleon_use_rtype = False
napoleon_use_ivar = True

sphinx_gallery_conf = {
    "examples_dirs": ["gallery"],
    "gallery_dirs": ["auto_gallery"],
    "filename_pattern": r"\.py",
    "within_subsection_order": "ExampleTitleSortKey",
    "copyfile_regex": r"^$",
    "download_all_examples": False,
    "remove_config_comments": True,
    "show_memory": False,
    "write_computation_times": False,
    "abort_on_example_error": True,
    "plot_gallery": True,
}

MODULES = ("cryptomatte", "lab.metropolis", "lab.quadrature", "race")


def write(path: Path, text: str) -> None:
    """Only if it changes, so that an unchanged page is not built again."""
    path.parent.mkdir(exist_ok=True)
    if not path.exists() or path.read_text() != text:
        path.write_text(text)


def directive(kind: str, name: str, *options: str) -> str:
    lines = [f".. {kind}:: {name}"]
    for option in options:
        key, _, value = option.partition(": ")
        lines.append(f"   :{key}: {value}".rstrip())
    return "\n".join(["```{eval-rst}", *lines, "```"]) + "\n"


def python_pages() -> None:
    """One page for the package, one for each module of the lab, one for races."""
    functions, classes = [], []
    for name in pymlt.__all__:
        value = getattr(pymlt, name)
        if inspect.isclass(value):
            classes.append(directive("autoclass", f"pymlt.{name}", "members"))
        elif callable(value):
            functions.append(directive("autofunction", f"pymlt.{name}"))
    sections = ["# The package", "## Functions", *functions, "## Classes", *classes]
    write(HERE / "auto_api" / "pymlt.md", "\n\n".join(sections))
    for module in MODULES:
        shown = sorted(set(import_module(f"pymlt.{module}").__all__) & set(pymlt.__all__))
        options = ["members", "imported-members", f"exclude-members: {', '.join(shown)}"]
        text = f"# pymlt.{module}\n\n" + directive("automodule", f"pymlt.{module}", *options)
        write(HERE / "auto_api" / f"{module}.md", text)


def plugin_pages() -> None:
    """One page for each family of plug-ins, from their schemas."""
    for family in _core.families():
        parts = [f"# {family}"]
        for name in _core.names(family):
            schema = _core.schema(family, name)
            parts.append(f"## {name}\n\n{schema['doc']}")
            if schema["parameters"]:
                rows = ["| parameter | type | default | |", "|---|---|---|---|"]
                rows += [row(parameter) for parameter in schema["parameters"]]
                parts.append("\n".join(rows))
        write(HERE / "auto_plugins" / f"{family}.md", "\n\n".join(parts) + "\n")


def row(parameter: dict) -> str:
    default = parameter["default"]
    shown = "" if default is None else f"`{default}`"
    doc = parameter["doc"].replace("|", "\\|")
    if parameter["choices"]:
        doc += f" One of: {', '.join(parameter['choices'])}."
    return f"| `{parameter['name']}` | {parameter['type']} | {shown} | {doc} |"


def setup(app):
    python_pages()
    plugin_pages()
