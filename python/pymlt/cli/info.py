"""`pymlt info`: what a scene holds."""

from __future__ import annotations

import json

from .common import FLAGS, add_flag, emit, load_scene, warn

HELP = "Print what a scene holds."


def add_arguments(command) -> None:
    command.add_argument("scene", metavar="SCENE", help=FLAGS["scene"].help)
    for name in ("defines", "lenient", "strict"):
        add_flag(command, FLAGS[name])
    command.add_argument("--json", action="store_true", help="print JSON")


def run(args) -> int:
    info = load_scene(args).info()
    if args.json:
        emit(json.dumps(info, indent=2))
        return 0
    shown = {name: value for name, value in info.items() if name != "warnings"}
    shown["size"] = " x ".join(map(str, info["size"]))
    emit("\n".join(f"{name:13} {value}" for name, value in shown.items()))
    warn(info["warnings"])
    return 0
