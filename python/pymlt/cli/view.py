"""`pymlt view`: a scene in the browser while it renders."""

from __future__ import annotations

import time
import webbrowser

from .common import FLAGS, add_flag, load_scene, say, warn
from .signals import Signals

HELP = "Show a scene in the browser while it renders: orbit the camera, look into its light paths."
SHARED = ("parameters", "defines", "size", "sensor", "lenient", "strict", "threads")


def add_arguments(command) -> None:
    command.add_argument("scene", metavar="SCENE", help="file or built-in scene")
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
        help="where the page is served; others than this machine's need --token (localhost)",
    )
    command.add_argument(
        "--token",
        metavar="WORD",
        nargs="?",
        const="",
        help="let in only who knows this word, a new one if none is given",
    )
    command.add_argument("--open", action="store_true", help="open the page in the browser")


def run(args) -> int:
    from ..viewing.start import PORT, new_token, view

    token = new_token() if args.token == "" else args.token
    with Signals() as signals:
        scene = signals.abandonable(lambda: load_scene(args))
        warn(scene.warnings)
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
