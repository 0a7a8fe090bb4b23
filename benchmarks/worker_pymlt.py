"""pymlt's `path` on its Cornell box, as a worker of equal_time.py."""

from __future__ import annotations

import sys
from time import process_time

import numpy as np
from peers import serve

import pymlt as mlt


def main(size: int, max_depth: int, colours: str) -> None:
    description = mlt.scenes.cornell_box()
    description["sensor"]["film"]["rfilter"] = {"type": "box"}
    scene = mlt.load_dict(description, size=(size, size))
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
    main(int(sys.argv[1]), int(sys.argv[2]), sys.argv[3])
