"""`pymlt race`: which algorithm has the smallest error after equal CPU time?"""

from __future__ import annotations

import io
import json
import os
from collections.abc import Callable
from dataclasses import dataclass
from functools import partial
from typing import TYPE_CHECKING

from .. import _core
from .._extras import import_extra
from ..algorithms.integrator import as_integrator
from ..rendering.progress import progress_bar
from .common import FLAGS, add_flag, emit, load_scene, reader, say, warn
from .display import add_tonemap, exposure
from .figures import check_figure_file
from .signals import Signals

if TYPE_CHECKING:
    from ..race import Program, Race, RaceResult

HELP = "Compare algorithms, and other programs, after equal CPU time."
SHARED = ("parameters", "defines", "size", "sensor", "lenient", "strict")
HELP_HERE = {
    "parameters": "parameter of every --algorithm; may be repeated",
    "seed": "seed of the first image of each algorithm (0); others count on from it",
    "exposure": "brighten pictures by this number of stops, or auto, as suits the scene (auto)",
}


def add_arguments(command) -> None:
    command.add_argument("scenes", metavar="SCENE", nargs="+", help="files or built-in scenes")
    add_contestants(command)
    for name in SHARED:
        add_flag(command, FLAGS[name], HELP_HERE.get(name, ""))
    add_measure(command)
    for name in ("seed", "threads"):
        add_flag(command, FLAGS[name], HELP_HERE.get(name, ""))
    add_output(command)


def add_contestants(command) -> None:
    command.add_argument(
        "--algorithm",
        dest="algorithms",
        metavar="NAME[:P=V,...]",
        action="append",
        default=[],
        help="an integrator, such as mlt or pssmlt:p_large=0.5; may be repeated",
    )
    command.add_argument(
        "--program",
        dest="programs",
        metavar="LABEL=COMMAND",
        action="append",
        default=[],
        type=reader(program),
        help="another renderer: a command with {output}, and {scene}, {seed}, {threads}, {width}, "
        "{height}, and {seconds} or {spp}; may be repeated",
    )


def add_measure(command) -> None:
    command.add_argument(
        "--reference",
        dest="references",
        metavar="FILE[,FILE...]",
        action="append",
        default=[],
        help="an image without noise, or independent ones with noise; one for each scene, - for "
        "none; without it seeds are compared with each other",
    )
    command.add_argument(
        "--seconds",
        metavar="SECONDS",
        type=float,
        default=10.0,
        help="CPU seconds for each thread of each image (10)",
    )
    command.add_argument(
        "--repeats",
        metavar="N",
        type=int,
        default=3,
        help="images of each algorithm, with different seeds (3)",
    )


def add_output(command) -> None:
    command.add_argument(
        "--inset",
        dest="insets",
        metavar="X,Y,W,H",
        action="append",
        default=[],
        type=reader(inset),
        help="part of the image to enlarge, in pixels; may be repeated (where algorithms differ)",
    )
    command.add_argument(
        "-o",
        "--output",
        metavar="FILE",
        action="append",
        default=[],
        help="a page (.html), the numbers (.json), or the pictures beside each other (.png, .pdf); "
        "may be repeated",
    )
    add_flag(command, FLAGS["exposure"], HELP_HERE["exposure"])
    add_tonemap(command)
    command.add_argument(
        "--quiet", action="store_true", help="say nothing but errors, and print no table"
    )


def program(text: str) -> Program:
    from ..race.program import Program

    label, equals, command = text.partition("=")
    if not (equals and label.strip() and command.strip()):
        raise _core.UsageError(f"{text!r} should be LABEL=COMMAND")
    return Program(command.strip(), label.strip())


def inset(text: str) -> tuple[int, ...]:
    try:
        x, y, width, height = map(int, text.split(","))
    except ValueError:
        raise _core.UsageError(f"{text!r} should be X,Y,WIDTH,HEIGHT in pixels") from None
    return x, y, width, height


def run(args) -> int:
    from ..race.races import Race

    check(args)
    race, code = Race([]), 0
    with Signals() as signals:
        races = signals.abandonable(lambda: [prepared(args, i) for i in range(len(args.scenes))])
        with progress_bar(False if args.quiet else None) as show:
            for i, start in enumerate(races):
                numbers = {"scene": args.scenes[i]}
                watch = Watch(
                    signals,
                    lambda done, i=i, n=numbers: show((i + done) / len(races), n),
                    "" if args.quiet else announcement(args, i),
                )
                try:
                    watch.end_if_asked()
                    race.results.append(start(progress=watch))
                except KeyboardInterrupt:
                    break
                except _core.RenderError as error:  # other scenes are not lost
                    say(error)
                    code = 3
        code = 128 + signals.caught if signals.caught else code
    return finish(race, args, code)


def announcement(args, index: int) -> str:
    """What a race on one of the scenes is going to do."""
    images = args.repeats * len([*args.algorithms, *args.programs])
    place = f" ({index + 1} of {len(args.scenes)})" if len(args.scenes) > 1 else ""
    work = f"{args.seconds:g} CPU seconds on each thread"
    return f"{args.scenes[index]}{place}: {images} image{'s' * (images > 1)}, {work} for each"


@dataclass
class Watch:
    """Says that a race begins, shows how far it is, and ends it once a signal has come."""

    signals: Signals
    show: Callable[[float], object]
    announcement: str

    def __call__(self, done: float) -> None:
        self.end_if_asked()
        if self.announcement:
            say(self.announcement)
            self.announcement = ""
        self.show(done)

    def end_if_asked(self) -> None:
        if self.signals.caught:
            raise KeyboardInterrupt


def finish(race: Race, args, code: int) -> int:
    """Say and write what was found; the exit code."""
    if code > 128:
        say(f"interrupted; {'what there is is compared' if race.results else 'nothing to save'}")
    if not race.results:
        return code
    entries = [entry for result in race.results for entry in result.entries]
    if not args.quiet:
        warn([f"{e.label} has left the race: {e.problem}" for e in entries if e.problem])
        emit(race.table())
    saved = [save(race, path, args) for path in args.output]
    return code if all(saved) else 3


def check(args) -> None:
    if not (args.algorithms or args.programs):
        raise _core.UsageError("a race needs --algorithm or --program; see pymlt race --help")
    if args.references and len(args.references) != len(args.scenes):
        raise _core.UsageError(
            f"there are {len(args.scenes)} scenes and {len(args.references)} references; give one "
            "for each scene, - for none"
        )
    for path in args.output:
        if path.lower().endswith(".html"):
            import_extra("matplotlib", "plots", "the page of a race")
        if path.lower().endswith((".html", ".json")):
            _core.check_file_writable(path)
        else:
            check_figure_file(path)


def prepared(args, index: int) -> Callable[..., RaceResult]:
    """The race on one of the scenes, with everything that it needs."""
    from ..race.algorithm import parse_algorithm
    from ..race.equal_time import equal_time, scene_name
    from ..race.insets import check_insets
    from ..race.score import reference_images

    args.scene = args.scenes[index]
    scene = load_scene(args)
    if not args.quiet:
        warn(scene.warnings)
    algorithms = []
    for text in args.algorithms:
        name, own = parse_algorithm(text)
        algorithms.append((text, as_integrator(scene, name, [*args.parameters, *own])))
    size = (scene.width, scene.height)
    given = args.references[index] if args.references else "-"
    file = args.scene if os.path.exists(args.scene) else None
    return partial(
        equal_time,
        [*algorithms, *args.programs],
        scene,
        None if given == "-" else reference_images(given.split(","), size),
        seconds=args.seconds,
        repeats=args.repeats,
        threads=args.threads or 0,
        seed=args.seed or 0,
        insets=check_insets(args.insets, size) or 2,
        name=scene_name(file) if file else args.scene,
        scene_file=file,
    )


def save(race: Race, path: str, args) -> bool:
    """Whether the file is where it was asked for; says where it is."""
    kind = os.path.splitext(path)[1][1:].lower()
    shown = {"exposure": exposure(args, "auto"), "tonemap": args.tonemap}
    if kind == "html":
        content = race.html(**shown).encode()
    elif kind == "json":
        content = json.dumps(race.to_dict(), indent=1).encode() + b"\n"
    else:
        picture = io.BytesIO()
        race.figure(**shown).savefig(picture, format=kind, dpi=150)
        content = picture.getvalue()
    saved, problem = _core.save_text(path, content)
    if problem or not args.quiet:
        say(problem or saved)
    return not problem
