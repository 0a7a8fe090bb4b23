"""Render the references of tests/python/mitsuba_cases.py with Mitsuba 3.

    pip install mitsuba
    python tests/python/references/make_references.py [NAME ...]

With `DRJIT_LIBLLVM_PATH` set to libLLVM.so (17 or later) the fast variant is used. Each reference
holds the means of the image over blocks, at four scales, and their standard errors, from many runs.
"""

from __future__ import annotations

import os
import re
import sys
import time
from pathlib import Path

import numpy as np

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))

import mitsuba as mi
import mitsuba_cases
from mitsuba_cases import REFERENCE_RUNS as RUNS
from same_image import ALL, measure


def load(case):
    if case.name == "mitsuba-cornell-box":  # ours, written as XML, against the one that is built in
        box = mi.cornell_box()
        film = dict(zip(("width", "height"), mitsuba_cases.SIZE, strict=True), sample_border=True)
        box["sensor"]["film"].update(film)
        return mi.load_dict(box)
    # Mitsuba samples only what lies inside the image unless told otherwise; then a filter sees less
    # beyond the border than it does elsewhere, and the pixels there mean something else.
    text = case.text()
    if "sample_border" not in text:
        border = '<boolean name="sample_border" value="true"/></film>'
        text = text.replace("</film>", border)
    text = re.sub(r'(<sampler type=)"\w+"', r'\1"multijitter"', text)
    # What older versions had and Mitsuba 3 refuses; this index is the one of vacuum.
    old = r'<(float name="extEta" value="1"|boolean name="banner".*|string name="filename".*png")/>'
    text = re.sub(old, "", text)
    if 'bsdf type="null"' in text:  # where it counts as a vertex for `path`, but not here
        text = text.replace('<integrator type="path"', '<integrator type="volpath"')
    mi.file_resolver().prepend(str(case.path.parent))
    used = {name: value for name, value in case.defines.items() if f"${name}" in text}
    return mi.load_string(text, **used)


def make(name: str, scene, spp: int, digest: str, file: Path) -> None:
    start = time.time()
    blocks = measure(lambda seed: render(scene, spp, seed), ALL, range(RUNS))
    np.savez_compressed(
        file,
        mean=blocks.mean.astype(np.float32),
        error=blocks.error.astype(np.float32),
        digest=digest,
        made_with=f"Mitsuba {mi.__version__}, {RUNS} runs of {spp} samples per pixel",
    )
    print(f"{name}: {time.time() - start:.0f} s", blocks.mean[0], blocks.error[0], flush=True)


def render(scene, spp: int, seed: int) -> np.ndarray:
    return np.array(mi.render(scene, spp=spp, seed=seed))[..., :3]


def main(names):
    mi.set_variant("llvm_ad_rgb" if os.environ.get("DRJIT_LIBLLVM_PATH") else "scalar_rgb")
    mi.set_log_level(mi.LogLevel.Error)
    for case in mitsuba_cases.CASES.values():
        if not names or case.name in names:
            make(case.name, load(case), case.reference_spp, case.digest(), case.reference)


if __name__ == "__main__":
    main(sys.argv[1:])
