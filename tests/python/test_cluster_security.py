"""`--cluster local:N`: nobody but its owner reaches it. Code runs in it for whoever does."""

import os
import socket
import subprocess
import sys
import tempfile
import time
from pathlib import Path

import psutil
import pytest
from listening import listeners

import pymlt as mlt

distributed = pytest.importorskip("distributed", reason="needs pymlt[cluster]")

from pymlt.rendering.cluster.local import local_cluster  # noqa: E402

WORKERS = 2

# Of dask's processes, when they are killed.
pytestmark = pytest.mark.filterwarnings("ignore")


@pytest.fixture(scope="module")
def cluster(tmp_path_factory):
    """With a directory of its own for temporary files; `.listeners` are its sockets."""
    before = listeners()
    with pytest.MonkeyPatch.context() as patch:
        patch.setenv("TMPDIR", str(tmp_path_factory.mktemp("temporary")))
        patch.setattr(tempfile, "tempdir", None)
        with local_cluster(f"local:{WORKERS}") as cluster:
            with distributed.Client(cluster) as client:
                client.wait_for_workers(WORKERS)
            cluster.listeners = listeners() - before
            yield cluster


def who_answers_another_user(ports, seconds: int) -> list[str]:
    command = [sys.executable, Path(__file__).with_name("intruder.py"), str(seconds)]
    outcome = subprocess.run([*command, *map(str, ports)], stdout=subprocess.PIPE, text=True)
    assert outcome.returncode == 0
    return outcome.stdout.split()


def test_only_the_scheduler_and_the_workers_listen_and_on_loopback_alone(cluster):
    assert {listener.host for listener in cluster.listeners} == {"127.0.0.1"}
    assert len(cluster.listeners) == 1 + WORKERS


@pytest.mark.skipif(os.geteuid() != 0, reason="only root can act as another user")
def test_another_user_gets_no_answer(cluster):
    with distributed.LocalCluster(
        n_workers=0, protocol="tcp://", dashboard_address="127.0.0.1:0"
    ) as open_to_all:
        port = open_to_all.scheduler_address.rpartition(":")[2]
        assert who_answers_another_user([port], 60) == [f"tcp://127.0.0.1:{port}"]
    assert who_answers_another_user([found.port for found in cluster.listeners], 3) == []


def test_other_users_cannot_read_the_key(cluster):
    key = cluster.security.tls_worker_key.splitlines()[1].encode()
    for pid in {found.pid for found in cluster.listeners}:
        assert key not in Path(f"/proc/{pid}/cmdline").read_bytes()
        assert Path(f"/proc/{pid}/environ").stat().st_mode & 0o077 == 0
    files = [path for path in Path(os.environ["TMPDIR"]).rglob("*") if path.is_file()]
    assert files  # dask's, of the workers
    assert not [path for path in files if key in path.read_bytes()]


def test_the_certificate_is_made_for_one_cluster_and_not_left_in_the_environment(cluster):
    with local_cluster("local:1") as another:
        assert another.security.tls_worker_key != cluster.security.tls_worker_key
    assert not [name for name in os.environ if "__TLS__" in name]


def test_strangers_who_knock_do_not_stop_it(cluster):
    for listener in cluster.listeners:
        for _ in range(2000):  # of each, dask has a line to say, and nobody reads it
            with socket.create_connection((listener.host, listener.port)) as stranger:
                stranger.sendall(b"GET / HTTP/1.1\r\n\r\n")
    with distributed.Client(cluster, timeout=60) as client:
        assert client.submit(pow, 3, 4).result(timeout=60) == 81


def test_settings_of_the_user_do_not_replace_the_certificate(monkeypatch):
    monkeypatch.setenv("DASK_DISTRIBUTED__COMM__TLS__CA_FILE", "/no/such/file")
    with local_cluster("local:1") as cluster, distributed.Client(cluster) as client:
        client.wait_for_workers(1)
    assert os.environ["DASK_DISTRIBUTED__COMM__TLS__CA_FILE"] == "/no/such/file"


def test_without_cryptography_one_line_says_how_to_install_it(monkeypatch):
    monkeypatch.setitem(sys.modules, "cryptography", None)
    with pytest.raises(mlt.UsageError, match="pip install 'cryptography>="):
        local_cluster("local:1")


# ---- the command line ----------------------------------------------------------------------------

RENDER = [sys.executable, "-P", "-m", "pymlt", "render", "cornell-box", "--integrator", "path"]
RENDER += ["--size", "32x32", "--quiet", "--cluster", "local:1", "-o", "a.exr"]


def test_files_of_the_current_folder_are_not_imported(tmp_path):
    """Whatever they are called: uuid and psutil are imported by dask's own modules."""
    for name in "uuid", "psutil", "dask", "yaml":
        (tmp_path / f"{name}.py").write_text("open('ran', 'a')\nraise ImportError('planted')\n")
    done = subprocess.run([*RENDER, "--spp", "4"], cwd=tmp_path, capture_output=True, text=True)
    assert (done.returncode, done.stderr) == (0, "")
    assert not (tmp_path / "ran").exists()


def test_a_trap_in_the_folder_for_temporary_files_is_not_stepped_into(tmp_path):
    trap, victim = tmp_path / "shared", tmp_path / "victim"
    (trap / "dask-scratch-space").mkdir(parents=True)
    (trap / "dask-scratch-space/global.lock").symlink_to(victim)
    (trap / "dask-scratch-space/psutil.py").write_text("open('ran', 'a')\n")
    victim.write_text("precious")
    environment = {**os.environ, "TMPDIR": str(trap)}
    done = subprocess.run([*RENDER, "--spp", "4"], cwd=tmp_path, env=environment)
    assert done.returncode == 0
    assert victim.read_text() == "precious"
    assert not (tmp_path / "ran").exists()
    assert os.listdir(trap) == ["dask-scratch-space"]


@pytest.fixture
def running(tmp_path):
    """A render that does not end by itself, and has begun; its temporary files are in a folder of
    their own. Yields it, its children and that folder."""
    temporary = tmp_path / "temporary"
    temporary.mkdir()
    command = [*RENDER, "--spp", "1e7", "--checkpoint", "state", "--every", "0.5"]
    render = psutil.Popen(
        command,
        cwd=tmp_path,
        env={**os.environ, "TMPDIR": str(temporary)},
        stdout=subprocess.DEVNULL,
        stderr=subprocess.PIPE,
        text=True,
    )
    deadline = time.monotonic() + 60
    while not (tmp_path / "state").exists():
        assert render.poll() is None
        assert time.monotonic() < deadline
        time.sleep(0.05)
    children = render.children(recursive=True)
    yield render, children, temporary
    for process in [render, *children]:
        if process.is_running():
            process.kill()
    render.communicate()


def test_its_temporary_files_are_its_own(running):
    (folder,) = running[2].iterdir()
    assert folder.stat().st_mode & 0o777 == 0o700


def test_nothing_of_it_outlives_an_owner_that_is_killed(running):
    render, children, temporary = running
    assert len(children) == 2
    render.kill()
    _, alive = psutil.wait_procs(children, timeout=10)
    assert not alive
    assert not os.listdir(temporary)


def test_one_line_tells_at_once_that_the_scheduler_is_gone(running):
    render, children, temporary = running
    (scheduler,) = [child for child in children if "distributed.Scheduler" in str(child.cmdline())]
    begun = time.monotonic()
    scheduler.kill()
    said = render.communicate(timeout=30)[1]
    assert time.monotonic() - begun < 10
    assert said.startswith("pymlt: the cluster is gone")
    assert said.count("\n") == 1
    assert render.returncode == 3
    assert not os.listdir(temporary)
