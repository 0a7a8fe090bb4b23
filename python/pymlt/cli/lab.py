"""`pymlt lab`: the scripts of the gallery."""

from __future__ import annotations

from .. import _core
from ..lab.gallery import draw, names, pyplot_module, script, title
from .common import emit, say
from .figures import check_figure_file, save_figure

HELP = "Run a script of the gallery: show its figure, or save it."


def add_arguments(command) -> None:
    command.add_argument("name", metavar="NAME", nargs="?", help="as --list names them")
    command.add_argument("--list", action="store_true", help="list the scripts")
    command.add_argument(
        "-o", "--output", metavar="FILE", help="save the figure, such as figure.png"
    )


def run(args) -> int:
    if args.list or args.name is None:
        if args.name or args.output or not args.list:
            raise _core.UsageError("lab needs --list or the name of a script; see pymlt lab --help")
        emit("\n".join(f"{name:15} {title(name)}" for name in names()))
        return 0
    script(args.name)  # known, before matplotlib is imported
    output = args.output
    if output:
        check_figure_file(output)
    pyplot = pyplot_module()
    if output:
        pyplot.switch_backend("agg")
    say(f"drawing {args.name}: {title(args.name)}")
    figure = draw(args.name)
    if not output and not has_window():
        output = f"{args.name}.png"
    code = save_figure(figure, output) if output else 0
    pyplot.close(figure)
    return code


def has_window() -> bool:
    from matplotlib import get_backend
    from matplotlib.backends import BackendFilter, backend_registry

    windows = backend_registry.list_builtin(BackendFilter.INTERACTIVE)
    return get_backend().lower() in [name.lower() for name in windows]
