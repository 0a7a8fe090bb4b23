"""Rendering on a cluster: the same pixels as here, whatever happens to the workers."""

import os
import pickle
import signal
import time
import types

import numpy as np
import pytest
import tiny

import pymlt as mlt
import pymlt.rendering.cluster.worker
from pymlt.cli import main

dask = pytest.importorskip("dask", reason="needs pymlt[cluster]")
distributed = pytest.importorskip("distributed", reason="needs pymlt[cluster]")

# Of dask's processes, when they are killed.
pytestmark = pytest.mark.filterwarnings("ignore")


def processes(count, **settings):
    """So many on this machine; one that dies is replaced."""
    return distributed.LocalCluster(
        n_workers=count,
        processes=True,
        memory_limit=0,
        dashboard_address="127.0.0.1:0",
        silence_logs=60,
        **settings,
    )


@pytest.fixture(scope="module")
def client():
    with processes(2, threads_per_worker=1) as cluster, distributed.Client(cluster) as client:
        yield client


def scene(width=24, height=12):
    return mlt.load_dict(tiny.scene(), size=(width, height))


def wait_until(condition, seconds=20.0):
    deadline = time.monotonic() + seconds
    while not condition():
        assert time.monotonic() < deadline, "it took too long"
        time.sleep(0.01)


@pytest.mark.parametrize("integrator", mlt.available("integrator"))
def test_the_pixels_are_those_of_one_machine(client, integrator):
    here = mlt.render(scene(), integrator, spp=20, seed=3)
    there = mlt.render(scene(), integrator, spp=20, seed=3, cluster=client)
    assert np.array_equal(here, there)


def test_layers_and_stats_are_those_of_one_machine(client):
    bdpt = mlt.BDPT(max_depth=3, techniques=True)
    here, there = (
        mlt.start(scene(), bdpt, spp=20, seed=3, cluster=cluster).result()
        for cluster in (None, client)
    )
    assert here.layers.keys() == there.layers.keys()
    for name, layer in here.layers.items():
        assert np.array_equal(layer, there.layers[name], equal_nan=True), name
    assert here.metadata == there.metadata
    assert {**here.stats, "seconds": 0} == {**there.stats, "seconds": 0}


def test_mutations_as_they_were_weighted_reach_the_workers(client):
    algorithm = mlt.MLT(max_depth=4, mutations=[(mlt.Lens(), 0.7), (mlt.Bidirectional(), 0.3)])
    here, there = (
        mlt.render(scene(), algorithm, spp=20, seed=3, cluster=cluster)
        for cluster in (None, client)
    )
    assert np.array_equal(here, there)


def test_workers_need_none_of_the_scene_s_files(client, tmp_path):
    mesh = tmp_path / "mesh.obj"
    mesh.write_text("v -1 1 0\nv 1 1 0\nv 0 2 0\nf 1 2 3\n")
    description = tiny.scene()
    description["triangle"] = {"type": "obj", "filename": str(mesh)}
    world = mlt.load_dict(description, size=(24, 12))
    here = mlt.render(world, spp=20, seed=3)
    assert not np.array_equal(here, mlt.render(scene(), spp=20, seed=3))
    job = mlt.start(world, spp=20, seed=3, cluster=client)
    mesh.unlink()
    assert np.array_equal(job.result().image, here)


def leftovers(dask_worker):
    state = dask_worker.pymlt_state
    return len(state.scenes) + len(state.helpers) + len(state.cancelled) + len(dask_worker.data)


def test_nothing_is_left_on_the_workers(client):
    mlt.render(scene(), spp=20, cluster=client)
    wait_until(lambda: set(client.run(leftovers).values()) == {0})


class SceneCounter(distributed.WorkerPlugin):
    """On each worker: how often it received, made and unpacked a scene."""

    def setup(self, worker):
        self.counts = worker.scenes = {"received": 0, "made": 0, "unpacked": 0}
        pymlt.rendering.cluster.worker.pickle = types.SimpleNamespace(loads=self.loads)

    def loads(self, packed):
        self.counts["unpacked"] += 1
        return pickle.loads(packed)

    def transition(self, key, start, finish, **_):
        if str(key).endswith("-scene") and finish == "memory":
            self.counts["received" if start == "flight" else "made"] += 1


def test_the_scene_travels_once_to_each_worker(monkeypatch):
    """Also to one that comes late, and although dask drops copies that nobody waits for."""
    often = {"distributed.scheduler.active-memory-manager.interval": "20ms"}
    monkeypatch.setattr("pymlt.rendering.cluster.executor.SHORTEST_STAGE", 0.02)
    monkeypatch.setattr("pymlt.rendering.cluster.executor.GROWTH", 0)
    monkeypatch.setattr("pymlt.rendering.cluster.executor.WORKER_SHARE", 1)
    monkeypatch.setattr("pymlt.rendering.cluster.executor.OWNER_SHARE", 1)
    with (
        dask.config.set(often),
        processes(2, threads_per_worker=2) as cluster,
        distributed.Client(cluster) as client,
    ):
        client.register_plugin(SceneCounter())
        job = mlt.start(scene(120, 90), spp=1e7, cluster=client)

        def scenes():
            return list(client.run(lambda dask_worker: dask_worker.scenes).values())

        for workers in 2, 3:
            cluster.scale(workers)
            wait_until(lambda n=workers: [c["unpacked"] for c in scenes()] == [1] * n, seconds=60)
            done = job.stats["spp_done"]
            wait_until(lambda n=done: job.stats["spp_done"] > n + 30, seconds=60)
        job.cancel()
        job.wait()
        assert [c["unpacked"] for c in scenes()] == [1, 1, 1]
        assert sum(c["made"] for c in scenes()) == 1
        threads = 2  # may both ask for it before it has come
        assert max(c["received"] for c in scenes()) <= threads


def test_what_a_lost_worker_held_is_done_by_others(client):
    world = scene(120, 90)
    here = mlt.start(world, "mlt", spp=40, seed=3).result()
    job = mlt.start(world, "mlt", spp=40, seed=3, cluster=client)
    wait_until(lambda: job.stats["spp_done"] > 1)
    victims = client.run(os.getpid)
    os.kill(next(iter(victims.values())), signal.SIGKILL)
    assert not job.ended
    there = job.result()
    assert np.array_equal(here.image, there.image)
    assert there.stats["spp_done"] == here.stats["spp_done"]


def test_a_render_can_be_cancelled_and_keeps_its_image(client):
    client.wait_for_workers(2)
    job = mlt.start(scene(160, 120), "mlt", spp=1e7, cluster=client)
    wait_until(lambda: job.stats["spp_done"] > 1)
    job.cancel()
    start = time.monotonic()
    result = job.result()
    assert time.monotonic() - start < 5
    assert 1 < result.stats["spp_done"] < 1e7
    assert result.image.max() > 0
    wait_until(lambda: not any(client.processing().values()))


def ends_when_it_is_to_cancel():
    pymlt.rendering.cluster.worker.cancel = lambda job, dask_worker: os._exit(1)


def test_a_worker_that_dies_in_the_middle_of_a_message_does_not_end_the_render(tmp_path):
    world, file = scene(72, 48), tmp_path / "state.mlt"
    with processes(2, threads_per_worker=1) as cluster, distributed.Client(cluster) as client:
        job = mlt.start(world, "mlt", spp=80, seed=3, cluster=client, checkpoint=file)
        wait_until(lambda: job.stats["spp_done"] > 1)
        client.run(ends_when_it_is_to_cancel, workers=[next(iter(client.nthreads()))])
        job.cancel()
        assert job.wait(20)
    assert job.stats["ended_by"] == "cancel"
    there = mlt.resume(file, scene=world).result()
    assert np.array_equal(there.image, mlt.render(world, "mlt", spp=80, seed=3))


def test_without_workers_a_render_waits_and_can_be_cancelled():
    with processes(1, threads_per_worker=1) as cluster, distributed.Client(cluster) as client:
        job = mlt.start(scene(120, 90), "mlt", spp=1e7, cluster=client)

        def goes_on():
            done = job.stats["spp_done"]
            wait_until(lambda: job.stats["spp_done"] > done)

        goes_on()
        cluster.scale(0)
        wait_until(lambda: not client.nthreads())
        assert not job.wait(1)
        cluster.scale(1)
        goes_on()
        cluster.scale(0)
        wait_until(lambda: not client.nthreads())
        job.cancel()
        assert job.wait(20)
        assert job.result().image.max() > 0


def test_an_error_budget_ends_a_render_where_it_ends_on_one_machine(client):
    here, there = (
        mlt.start(scene(), "mlt", error=0.2, seed=3, cluster=cluster).result()
        for cluster in (None, client)
    )
    assert here.stats["ended_by"] == "error"
    assert here.stats["spp_done"] == there.stats["spp_done"]
    assert np.array_equal(here.image, there.image)


@pytest.mark.parametrize(("integrator", "spp"), [("path", 150), ("mlt", 60)])
def test_a_checkpoint_of_a_cluster_is_resumed_anywhere(client, tmp_path, integrator, spp):
    world, file = scene(72, 48), tmp_path / "state.mlt"
    whole = mlt.render(world, integrator, spp=spp, seed=3)
    job = mlt.start(world, integrator, spp=spp, seed=3, cluster=client, checkpoint=file, every=0.2)
    wait_until(lambda: job.stats["spp_done"] > 2)
    job.cancel()
    assert job.result().stats["spp_done"] < spp
    here = mlt.resume(file, scene=world, checkpoint=tmp_path / "other.mlt")
    assert np.array_equal(here.result().image, whole)
    there = mlt.resume(file, scene=world, cluster=client)
    assert np.array_equal(there.result().image, whole)


def test_a_render_on_a_cluster_can_be_extended(client):
    job = mlt.start(scene(), "mlt", spp=10, seed=3, cluster=client)
    job.wait()
    job.extend(spp=20)
    assert np.array_equal(job.result().image, mlt.render(scene(), "mlt", spp=20, seed=3))


def test_time_ends_a_render(client):
    start = time.monotonic()
    stats = mlt.start(scene(160, 120), time=2, cluster=client).result().stats
    assert 1.9 < time.monotonic() - start < 6
    assert stats["spp_done"] > 0


def test_snapshots_of_a_render_on_a_cluster(client):
    snapshots = list(
        mlt.render_progressive(scene(160, 120), spp=100, seed=3, interval=0.1, cluster=client)
    )
    spp = [snapshot.stats["spp_done"] for snapshot in snapshots]
    assert len(spp) >= 3
    assert spp == sorted(spp)
    assert len(set(spp)) >= 3


def test_an_error_in_the_render_is_reported(client):
    dark = tiny.scene()
    dark["lamp"]["emitter"]["radiance"]["value"] = [0.0, 0.0, 0.0]
    with pytest.raises(mlt.RenderError, match="light"):
        mlt.render(dark, mlt.PSSMLT(independent_share=0), spp=1, cluster=client)


def test_a_worker_with_another_build_is_refused(client):
    from pymlt.rendering.cluster.worker import run_task

    future = client.submit(run_task, b"", "job", "scene", None, "another", b"")
    with pytest.raises(mlt.UsageError, match="another build of pymlt"):
        future.result()


def test_a_cluster_that_goes_away_leaves_the_image():
    from pymlt.rendering.cluster.local import local_cluster

    with local_cluster("local:1") as cluster:
        job = mlt.start(scene(160, 120), spp=1e7, cluster=cluster)
        wait_until(lambda: job.stats["spp_done"] > 1)
    with pytest.raises(mlt.RenderError, match="cluster") as caught:
        job.wait(timeout=60)
    assert job.ended
    assert caught.value.result.image.max() > 0


@pytest.mark.parametrize(
    ("cluster", "message"),
    [
        ("local:0", "local:N with N >= 1"),
        ("local:many", "local:N with N >= 1"),
        (4, "cluster is 4, but should be"),
        ("tcp://127.0.0.1:1", "no cluster at tcp://127.0.0.1:1"),
        ("tls://127.0.0.1:1", "asks for a certificate"),
    ],
)
def test_a_cluster_that_is_none_is_refused(cluster, message, monkeypatch):
    monkeypatch.setattr("pymlt.rendering.cluster.connection.CONNECT_SECONDS", 1)
    with pytest.raises(mlt.UsageError, match=message):
        mlt.start(scene(), cluster=cluster)


def test_the_command_line_renders_on_processes_of_this_machine(tmp_path):
    file = tmp_path / "scene.xml"
    file.write_text(tiny.XML)
    arguments = ["render", str(file), "--spp", "20", "--seed", "3", "--quiet"]
    assert main([*arguments, "-o", str(tmp_path / "here.exr")]) == 0
    assert main([*arguments, "-o", str(tmp_path / "there.exr"), "--cluster", "local:2"]) == 0
    assert (tmp_path / "here.exr").read_bytes() == (tmp_path / "there.exr").read_bytes()
