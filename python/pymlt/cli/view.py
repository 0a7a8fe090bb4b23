"""`pymlt view`: a scene in the browser while it renders."""

from __future__ import annotations

import os
import time
import webbrowser
from pathlib import Path

from .. import _core
from .common import FLAGS, add_flag, load_scene, say, warn
from .signals import Signals

HELP = "Show a scene in the browser while it renders: orbit the camera, look into its light paths."
VARIABLE = "PYMLT_VIEW_TOKEN"  #: of the environment: a token
SHARED = ("parameters", "defines", "size", "sensor", "lenient", "strict", "threads")


def add_arguments(command) -> None:
    command.add_argument("scene", metavar="SCENE", nargs="?", help="file or built-in scene")
    command.add_argument(
        "--lecture", action="store_true", help="the lecture's examples alone, without a scene"
    )
    add_flag(command, FLAGS["integrator"])
    for name in SHARED:
        add_flag(command, FLAGS[name])
    command.add_argument(
        "--port",
        metavar="N",
        type=int,
        default=None,
        help="of the page, or the next free one (8090)",
    )
    command.add_argument(
        "--host",
        metavar="ADDRESS",
        default="localhost",
        help="where the page is served; others than this machine's need a token (localhost)",
    )
    command.add_argument(
        "--token",
        nargs="?",
        const="",
        metavar="",
        help="let in only who knows the new word that is printed with the address",
    )
    command.add_argument(
        "--token-file",
        metavar="FILE",
        help=f"let in only who knows the word in this file, or else in the variable {VARIABLE}",
    )
    command.add_argument("--open", action="store_true", help="open the page in the browser")


def given_token(args) -> str | None:
    """Arguments can be read by every user of the machine, so no word is taken from there."""
    if args.token is not None:
        raise _core.UsageError(
            "--token takes no word, since every user of the machine could read it: put it into a "
            f"file, --token-file FILE, or into the environment variable {VARIABLE}"
        )
    if args.token_file is None:
        return os.environ.get(VARIABLE)
    try:
        return Path(args.token_file).read_text().strip()
    except (OSError, ValueError) as error:
        reason = getattr(error, "strerror", None) or "it is no text"
        raise _core.FileError(f"{args.token_file}: cannot read the token: {reason}") from None


def given_scene(args) -> _core.Scene | None:
    """None for the lecture. Raises UsageError unless there is either a scene or --lecture."""
    if not args.lecture:
        if args.scene is None:
            raise _core.UsageError("name a scene, or give --lecture for the examples without one")
        scene = load_scene(args)
        warn(scene.warnings)
        return scene
    for name in ("scene", "integrator", *SHARED):
        if getattr(args, name):
            flag = FLAGS[name].spelling if name != "scene" else "the scene"
            raise _core.UsageError(f"--lecture renders nothing: leave out {flag}")
    return None


def run(args) -> int:
    from ..viewing.start import PORT, new_token, view

    token = new_token() if args.token == "" else given_token(args)
    if args.open and token is not None:
        raise _core.UsageError(
            "--open would show the token to every user of the machine, among the arguments of the "
            "browser: open the address that is printed"
        )
    with Signals() as signals:
        scene = signals.abandonable(lambda: given_scene(args))
        port = PORT if args.port is None else args.port
        page = view(
            scene,
            args.integrator,
            parameters=", ".join(f"{name}={value}" for name, value in args.parameters),
            sensor=args.sensor,
            host=args.host,
            port=port,
            token=token,
            threads=args.threads or 0,
        )
        with page:
            if args.port and page.port != args.port:
                say(f"port {args.port} is taken")
            say(f"the view is at {page.url}; Ctrl-C ends it")
            if args.open:
                webbrowser.open(page.url)
            while not signals.caught:
                time.sleep(0.05)
    return 128 + signals.caught
