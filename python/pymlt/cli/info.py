"""`pymlt info`: what a scene holds, or the header of an image."""

from __future__ import annotations

import json
import os

from .. import _core
from ..images import read_header
from .common import FLAGS, add_flag, emit, load_scene, warn

HELP = "Print what a scene or an image file holds."
SCALES = {10**9: "billion", 10**6: "million"}
UNITS = ("bytes", "kB", "MB", "GB", "TB")


def add_arguments(command) -> None:
    command.add_argument(
        "scene", metavar="FILE", help=f"{FLAGS['scene'].help}; or an image, such as an .exr"
    )
    for name in ("defines", "lenient", "strict"):
        add_flag(command, FLAGS[name])
    command.add_argument("--json", action="store_true", help="print JSON, with exact numbers")


def run(args) -> int:
    is_image = os.path.isfile(args.scene) and _core.is_known_image(args.scene)
    info = read_header(args.scene) if is_image else load_scene(args).info()
    if args.json:
        emit(json.dumps(info, indent=2))
        return 0
    emit("\n".join(image_lines(info) if is_image else scene_lines(info)))
    warn(info.get("warnings", []))
    return 0


def scene_lines(info: dict) -> list[str]:
    shown = {name: value for name, value in info.items() if name not in ("warnings", "bytes")}
    shown["size"] = " x ".join(map(str, info["size"]))
    shown["triangles"] = count(info["triangles"])
    shown["memory"] = memory(info["bytes"])
    shown["center"] = ", ".join(f"{x:.4g}" for x in info["center"])
    shown["radius"] = f"{info['radius']:.4g}"
    shown["seconds"] = f"{info['seconds']:.2g}"
    return table(shown)


def image_lines(header: dict) -> list[str]:
    shown = {name: value for name, value in header.items() if name != "metadata"}
    shown["size"] = " x ".join(map(str, header["size"]))
    shown["channels"] = ", ".join(header["channels"])
    return table(shown | header["metadata"])


def table(shown: dict) -> list[str]:
    width = max(map(len, shown))
    return [f"{name:{width}}  {value}" for name, value in shown.items()]


def count(number: int) -> str:
    """1.2 million; 8194."""
    for scale, name in SCALES.items():
        if number >= scale:
            return f"{number / scale:.3g} {name}"
    return str(number)


def memory(number: float) -> str:
    """34 MB, in powers of 1000."""
    unit = 0
    while number >= 999.5 and unit + 1 < len(UNITS):
        number, unit = number / 1000, unit + 1
    return f"{number:.3g} {UNITS[unit]}"
