"""pymlt's `path` on a scene file, as a worker of equal_time.py."""

from __future__ import annotations

import sys
from time import process_time

import numpy as np
from peers import serve

import pymlt as mlt


def main(path: str, width: int, height: int, max_depth: int, colours: str) -> None:
    scene = mlt.load_file(path, size=(width, height), filter="box", lenient=True)
    if colours == "spectral":
        scene = scene.with_wavelengths()

    def render(spp: int, seed: int, output: str) -> dict:
        start = process_time()
        integrator = mlt.Path(max_depth=max_depth)
        image = mlt.render(scene, integrator, spp=spp, seed=seed, threads=1, progress=False)
        seconds = process_time() - start
        np.save(output, image)
        return {"seconds": seconds}

    serve({"version": mlt.__version__}, render)


if __name__ == "__main__":
    main(sys.argv[1], *map(int, sys.argv[2:5]), sys.argv[5])
