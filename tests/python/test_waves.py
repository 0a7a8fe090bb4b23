"""The code that one reads (cpp/path) and the waves that render make the same image."""

import numpy as np
import pytest
import tiny
from same_image import assert_same_image

import pymlt as mlt

SAMPLED = ["path", "direct", "ptracer", "bdpt"]


def scene(spheres=False) -> mlt.Scene:
    made = tiny.scene()
    made["ball"]["bsdf"] = {"type": "roughplastic", "alpha": 0.2}
    if spheres:
        made["bulb"] = {
            "type": "sphere",
            "center": [-1, 1.5, 0.5],
            "radius": 0.2,
            "emitter": {"type": "area", "radiance": 4.0},
        }
    return mlt.load_dict(made)


@pytest.mark.parametrize("name", SAMPLED)
@pytest.mark.parametrize("spheres", [False, True])
def test_each_sample_is_the_same_by_both(name, spheres):
    waves, text = (
        mlt.render(scene(spheres), {"type": name, "waves": waves}, spp=16, seed=3)
        for waves in (True, False)
    )
    same = np.isclose(waves, text, rtol=2e-3, atol=1e-5).all(axis=2)
    assert same.mean() > 0.95  # a difference in rounding may send a path past an edge
    assert waves.mean() == pytest.approx(text.mean(), rel=5e-3)


def test_they_are_not_the_same_code():
    waves, text = (
        mlt.render(scene(), {"type": "path", "waves": waves}, spp=16, seed=3)
        for waves in (True, False)
    )
    assert (waves != text).any()  # single and double precision


@pytest.mark.parametrize("name", ["pssmlt", "mlt", "mmlt"])
def test_chains_beside_either_make_the_same_image(name):
    def side(waves):
        def render(spp, seed):
            return mlt.render(scene(True), {"type": name, "waves": waves}, spp=spp, seed=seed)

        return render

    spp = 1600 if name == "mlt" else 800  # few tours have the rarest light
    assert_same_image(
        side(True), side(False), spp=spp, runs=8, scales=((1, 1), (3, 4)), whole_image=0.03
    )
