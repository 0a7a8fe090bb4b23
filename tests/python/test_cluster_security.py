"""`--cluster local:N`: nobody but its owner reaches it. Code runs in it for whoever does."""

import os
import socket
import subprocess
import sys
import tempfile
from pathlib import Path

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
