"""Mitsuba 3's `path` on its Cornell box, as a worker of equal_time.py."""

from __future__ import annotations

import json
import sys
from time import process_time

import numpy as np
from peers import serve


def main(size: int, max_depth: int, variant: str, sampler: str) -> None:
    try:
        import drjit as dr
        import mitsuba as mi

        mi.set_variant(variant)
    except ImportError as error:
        print(json.dumps({"skip": f"{error}"}))
        return
    description = mi.cornell_box()
    description["integrator"] = {"type": "path", "max_depth": max_depth}
    description["sensor"]["film"] |= {"width": size, "height": size, "rfilter": {"type": "box"}}
    description["sensor"]["sampler"] = {"type": sampler}
    scene = mi.load_dict(description)
    dr.set_thread_count(1)  # with one thread, spectra do not load

    def render(spp: int, seed: int, output: str) -> dict:
        start = process_time()
        image = np.array(mi.render(scene, spp=spp, seed=seed))  # waits for the result
        seconds = process_time() - start
        np.save(output, image[..., :3])
        return {"seconds": seconds}

    serve({"version": mi.__version__}, render)


if __name__ == "__main__":
    main(int(sys.argv[1]), int(sys.argv[2]), sys.argv[3], sys.argv[4])
