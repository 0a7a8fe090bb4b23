"""`pymlt info`: what a scene holds."""

from __future__ import annotations

import json

from .common import FLAGS, add_flag, load_scene, warn

HELP = "Print what a scene holds."


def add_arguments(command) -> None:
    command.add_argument("scene", metavar="SCENE", help=FLAGS["scene"].help)
    add_flag(command, FLAGS["defines"])
    command.add_argument("--json", action="store_true", help="print JSON")


def run(args) -> int:
    info = load_scene(args).info()
    if args.json:
        print(json.dumps(info, indent=2))
        return 0
    for name, value in info.items():
        if name == "warnings":
            continue
        text = " x ".join(map(str, value)) if name == "size" else value
        print(f"{name:13} {text}")
    warn(info["warnings"])
    return 0
