"""Mitsuba 3's `path`, in media `volpath`, on a scene file, as a worker of equal_time.py."""

from __future__ import annotations

import json
import sys
from pathlib import Path
from time import process_time
from xml.etree import ElementTree as ET

import numpy as np
from peers import serve


def scene_text(path: Path, size: tuple[int, int], max_depth: int, sampler: str) -> str:
    """The scene with our settings, and without what Mitsuba 3 does not read."""
    root = ET.parse(path).getroot()
    for foreign in root.findall("integrator") + root.findall("dpt"):
        root.remove(foreign)
    for look_at in root.iter("lookAt"):
        look_at.tag = "lookat"
    kind = "path" if root.find(".//medium") is None else "volpath"
    path_tracer = ET.SubElement(root, "integrator", type=kind)
    ET.SubElement(path_tracer, "integer", name="max_depth", value=str(max_depth))
    sensor = root.find("sensor")
    for old in sensor.findall("sampler"):
        sensor.remove(old)
    ET.SubElement(sensor, "sampler", type=sampler)
    film = sensor.find("film")
    film.clear()
    film.set("type", "hdrfilm")
    for name, pixels in zip(("width", "height"), size, strict=True):
        ET.SubElement(film, "integer", name=name, value=str(pixels))
    ET.SubElement(film, "rfilter", type="box")
    return ET.tostring(root, encoding="unicode")


def load(mi, path: Path, *settings):
    config = mi.parser.ParserConfig(mi.variant())
    config.unused_properties = config.unused_parameters = mi.LogLevel.Debug
    mi.file_resolver().append(str(path.parent))
    state = mi.parser.parse_string(config, scene_text(path, *settings))
    mi.parser.transform_all(config, state)
    return mi.parser.instantiate(config, state)


def main(path: str, width: int, height: int, max_depth: int, variant: str, sampler: str) -> None:
    try:
        import drjit as dr
        import mitsuba as mi

        mi.set_variant(variant)
        mi.set_log_level(mi.LogLevel.Error)  # no bars among the answers
    except ImportError as error:
        print(json.dumps({"skip": f"{error}"}))
        return
    scene = load(mi, Path(path), (width, height), max_depth, sampler)
    dr.set_thread_count(1)  # with one thread, spectra do not load

    def render(spp: int, seed: int, output: str) -> dict:
        start = process_time()
        image = np.array(mi.render(scene, spp=spp, seed=seed))  # waits for the result
        seconds = process_time() - start
        np.save(output, image[..., :3])
        return {"seconds": seconds}

    serve({"version": mi.__version__}, render)


if __name__ == "__main__":
    main(sys.argv[1], *map(int, sys.argv[2:5]), *sys.argv[5:])
