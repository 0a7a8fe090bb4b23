"""Motion blur from Python: checkpoints, light paths and mutations where things move."""

import pickle
from pathlib import Path

import numpy as np
import pytest
from test_python_mutations import MOVES

import pymlt as mlt

SCENE = Path(__file__).resolve().parents[2] / "scenes" / "motion" / "scene.xml"


@pytest.fixture(scope="module")
def scene():
    return mlt.load_file(SCENE, size=(32, 18))


def test_the_shutter_blurs(scene):
    still = mlt.load_dict(mlt.scenes.motion(shutter=0), size=(32, 18))
    blurred = mlt.render(scene, spp=16, seed=1)
    assert np.abs(blurred - mlt.render(still, spp=16, seed=1)).max() > 0.1


@pytest.mark.parametrize("integrator", ["path", "bdpt", "pssmlt", "mlt"])
def test_a_resumed_render_ends_with_the_same_pixels(scene, integrator, tmp_path):
    whole = mlt.start(scene, integrator, spp=12, seed=5).result()
    mlt.start(scene, integrator, spp=3, seed=5, checkpoint=tmp_path / "a.mlt").result()
    again = mlt.resume(tmp_path / "a.mlt", spp=12).result()
    assert np.array_equal(again.image, whole.image)


def test_paths_have_the_times_while_the_shutter_is_open(scene):
    paths = [scene.sample_path(seed=seed) for seed in range(8)]
    for x in paths:
        assert scene.visible(x[-1], x[-2])
    times = [x.time for x in paths]
    assert 0 <= min(times) < max(times) <= 1


def test_a_pickled_scene_moves_alike(scene):
    again = pickle.loads(pickle.dumps(scene))
    assert np.array_equal(mlt.render(again, spp=2, seed=1), mlt.render(scene, spp=2, seed=1))


def test_a_ray_from_a_vertex_is_at_the_time_of_its_path(scene):
    x = scene.sample_path(seed=1)
    w = x[-1].direction_to(x[-2])
    assert np.array_equal(scene.intersect(x[-1], w).position,
                          scene.intersect(x[-1], w, x.time).position)  # fmt: skip


@pytest.mark.parametrize("move", MOVES)
def test_mutations_of_python_hold_where_things_move(scene, move):
    report = mlt.audit(move(), scene, paths=4000)
    assert report.verdict != "wrong", report
