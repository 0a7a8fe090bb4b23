"""How Sphinx builds the documentation: `make docs`.

Pages are Markdown (MyST). The gallery is made by running docs/gallery; the pages of the Python
interface and of the plug-ins are made from what the package itself says.
"""

import inspect
import operator
from importlib import import_module
from pathlib import Path

import pymlt
from pymlt import _core, viewing  # noqa: F401 (an attribute of the package from here on)
from pymlt.algorithms import integrators, mutations

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
autodoc_typehints = "signature"
python_maximum_signature_line_length = 80
napoleon_google_docstring = False
napoleon_use_rtype = False
napoleon_use_ivar = True


def place_in_the_lecture(script: str) -> int:
    """Where docs/lecture.md names a script of the gallery last."""
    return (HERE / "lecture.md").read_text().rindex(f"`pymlt lab {Path(script).stem}`")


sphinx_gallery_conf = {
    "examples_dirs": ["gallery"],
    "gallery_dirs": ["auto_gallery"],
    "filename_pattern": r"\.py",
    "within_subsection_order": place_in_the_lecture,
    "copyfile_regex": r"^$",
    "download_all_examples": False,
    "remove_config_comments": True,
    "show_memory": False,
    "write_computation_times": False,
    "abort_on_example_error": True,
    "plot_gallery": True,
}

# Pages of the Python interface: the title, what of the package they show, and which modules.
TOPICS = {
    "scenes": (
        "Scenes",
        "load load_file load_dict load_string load_materials convert traverse Scene "
        "SceneParameters Transform",
        ["scenes"],
    ),
    "rendering": (
        "Rendering",
        "render start resume render_progressive render_bands render_shot replay Job Replay",
        ["rendering.cluster"],
    ),
    "results": (
        "Results",
        "Result Groups Frame Shot Technique compare comparison_figure merge merge_shots mix",
        [],
    ),
    "images": (
        "Images and their files",
        "read_image write_image write_film read_metadata tonemap denoise",
        ["cryptomatte"],
    ),
    "algorithms": (
        "Algorithms",
        " ".join(["available describe Integrator", *integrators.__all__]),
        [],
    ),
    "mutations": (
        "Mutations and audits",
        " ".join(["audit Audit convergence Convergence Mutation", *mutations.__all__])
        + " LightPath Vertex",
        [],
    ),
    "lab": ("Sampling and quadrature", "", ["lab.metropolis", "lab.quadrature"]),
    "races": ("Races of algorithms", "equal_time Program Race RaceResult", ["race"]),
    "viewing": ("The page that shows a scene", "view viewing.start.View", []),
    "errors": ("Errors", "Error SceneError UsageError FileError RenderError", []),
}


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
    """One page for each topic of the Python interface, and none that is not a topic any more."""
    for page in (HERE / "auto_api").glob("*.md"):
        if page.stem not in TOPICS:
            page.unlink()
    for topic, (title, names, modules) in TOPICS.items():
        parts = [f"# {title}"]
        for name in names.split():
            shown = operator.attrgetter(name)(pymlt)
            options = ["autoclass", "members"] if inspect.isclass(shown) else ["autofunction"]
            parts.append(directive(options[0], f"pymlt.{name}", *options[1:]))
        parts += map(module_part, modules)
        write(HERE / "auto_api" / f"{topic}.md", "\n\n".join(parts))


def module_part(name: str) -> str:
    """All of a module but what the package has too."""
    module = import_module(f"pymlt.{name}")
    options = ["members"]
    if hasattr(module, "__all__"):
        elsewhere = sorted(set(module.__all__) & set(pymlt.__all__))
        options += ["imported-members", f"exclude-members: {', '.join(elsewhere)}"]
    return f"## pymlt.{name}\n\n" + directive("automodule", f"pymlt.{name}", *options)


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


def without_types(app, what, name, shown, options, lines: list[str]) -> None:
    """napoleon takes what stands before a colon in the first line of a property for its type."""
    if what in ("attribute", "property"):
        lines[:0] = ["..", ""]  # an empty comment


def setup(app):
    app.connect("autodoc-process-docstring", without_types, priority=400)
    python_pages()
    plugin_pages()
