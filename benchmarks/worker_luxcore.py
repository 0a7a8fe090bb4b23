"""LuxCore's BIDIRCPU on a scene of triangles, as a worker of luxcore.py."""

from __future__ import annotations

import json
import sys
from time import process_time, sleep

import numpy as np
from peers import serve


def settings(size: int, max_depth: int, seed: int) -> dict:
    return {
        "renderengine.type": "BIDIRCPU",
        "renderengine.seed": seed + 1,
        "native.threads.count": 1,
        "path.maxdepth": max_depth,
        "light.maxdepth": max_depth,
        # Roulette after 100 vertices is none: LuxCore's own loses light.
        "path.russianroulette.depth": 100,
        "light.russianroulette.depth": 100,
        "film.width": size,
        "film.height": size,
        "film.filter.type": "NONE",
        "film.outputs.1.type": "RGB",
        "film.outputs.1.filename": "unused.exr",
    }


def camera(description: dict) -> dict:
    return {
        "scene.camera.type": "perspective",
        "scene.camera.lookat.orig": description["origin"],
        "scene.camera.lookat.target": description["target"],
        "scene.camera.up": description["up"],
        "scene.camera.fieldofview": description["fov"],
        "scene.camera.autofocus.enable": 0,
        "scene.camera.lensradius": 0,
    }


def material(name: str, mesh: dict) -> dict:
    prefix = f"scene.materials.{name}"
    if "ior" in mesh:
        return {
            f"{prefix}.type": "glass",
            f"{prefix}.kr": [1.0, 1.0, 1.0],
            f"{prefix}.kt": [1.0, 1.0, 1.0],
            f"{prefix}.interiorior": mesh["ior"],
            f"{prefix}.exteriorior": 1.0,
        }
    made = {f"{prefix}.type": "matte", f"{prefix}.kd": mesh["reflectance"]}
    if "radiance" in mesh:
        made[f"{prefix}.emission"] = mesh["radiance"]
    return made


def main(scene_file: str, size: int, max_depth: int) -> None:
    try:
        import pyluxcore
    except ImportError as error:
        print(json.dumps({"skip": f"{error}"}))
        return

    def properties(values: dict):
        made = pyluxcore.Properties()
        for name, value in values.items():
            made.Set(pyluxcore.Property(name, value))
        return made

    pyluxcore.Init()
    pyluxcore.SetLogHandler(lambda message: None)
    with open(scene_file) as file:
        description = json.load(file)
    scene = pyluxcore.Scene()
    scene.Parse(properties(camera(description["camera"])))
    for i, mesh in enumerate(description["meshes"]):
        name = f"mesh{i}"
        points = [tuple(p) for p in mesh["vertices"]]
        triangles = [tuple(t) for t in mesh["triangles"]]
        scene.DefineMesh(name, points, triangles, None, None, None, None)
        scene.Parse(
            properties(
                material(name, mesh)
                | {
                    f"scene.objects.{name}.shape": name,
                    f"scene.objects.{name}.material": name,
                }
            )
        )

    def render(seconds: float, seed: int, output: str) -> dict:
        config = pyluxcore.RenderConfig(properties(settings(size, max_depth, seed)), scene)
        session = pyluxcore.RenderSession(config)
        start = process_time()
        session.Start()
        while process_time() - start < seconds:
            sleep(0.01)
        session.Stop()
        used = process_time() - start
        session.UpdateStats()
        spp = session.GetStats().Get("stats.renderengine.pass").GetInt()
        pixels = np.zeros((size, size, 3), dtype=np.float32)
        session.GetFilm().GetOutputFloat(pyluxcore.FilmOutputType.RGB, pixels)
        np.save(output, pixels)  # row 0 at the bottom
        return {"seconds": used, "spp": spp}

    serve({"version": pyluxcore.Version()}, render)


if __name__ == "__main__":
    main(sys.argv[1], int(sys.argv[2]), int(sys.argv[3]))
