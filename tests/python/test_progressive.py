"""Looking at a render while it runs: snapshots, callbacks, the picture in a notebook."""

import re

import numpy as np
import pytest
import tiny

import pymlt as mlt


def scene():
    return mlt.load_dict(tiny.scene(), size=(160, 120))


def test_snapshots_come_until_the_render_ends():
    snapshots = list(mlt.render_progressive(scene(), "mlt", spp=40, seed=1, interval=0.05))
    spp = [snapshot.stats["spp_done"] for snapshot in snapshots]
    assert len(spp) >= 3
    assert spp == sorted(spp)
    assert np.array_equal(snapshots[-1].image, mlt.render(scene(), "mlt", spp=40, seed=1))


def test_leaving_the_loop_ends_the_render():
    snapshots = mlt.render_progressive(scene(), spp=1e7, interval=0.05)
    assert next(snapshots).image.shape == (120, 160, 3)
    job = snapshots.gi_frame.f_locals["job"]
    snapshots.close()
    assert job.cancelled
    assert job.wait(timeout=5)


def test_a_callback_sees_the_image_and_can_end_the_render():
    seen = []

    def enough(snapshot):
        seen.append(snapshot)
        return len(seen) == 3

    image = mlt.render(scene(), spp=1e7, callback=enough, interval=0.05)
    assert len(seen) == 3
    assert 0 < seen[0].stats["spp_done"] < 1e7
    assert image.shape == seen[0].image.shape


def test_an_error_in_a_callback_ends_the_render():
    def fail(snapshot):
        raise KeyError("mine")

    with pytest.raises(KeyError, match="mine"):
        mlt.render(scene(), spp=1e7, callback=fail, interval=0.05)


# ---- notebooks ---------------------------------------------------------------------------------


@pytest.fixture
def notebook(tmp_path, monkeypatch):
    """An IPython shell that keeps what it is told to display."""
    pytest.importorskip("IPython")
    monkeypatch.setenv("IPYTHONDIR", str(tmp_path))
    from IPython.core.displaypub import CapturingDisplayPublisher
    from IPython.core.interactiveshell import InteractiveShell
    from traitlets.config import Config

    shell = InteractiveShell.instance(config=Config({"HistoryManager": {"enabled": False}}))
    shell.display_pub = CapturingDisplayPublisher()
    yield shell.display_pub.outputs
    InteractiveShell.clear_instance()


def test_a_notebook_shows_the_image_and_renews_it(notebook):
    job = mlt.start(scene(), spp=200, seed=1)
    job.show(interval=0.1)
    assert job.ended
    assert len(notebook) >= 3
    assert len({output["transient"]["display_id"] for output in notebook}) == 1
    assert [output["update"] for output in notebook] == [False] + [True] * (len(notebook) - 1)
    pages = [output["data"]["text/html"] for output in notebook]
    assert len(set(pages)) >= 3
    assert all("data:image/png;base64," in page for page in pages)
    assert "path, 160 x 120, 200 spp" in pages[-1]
    assert "%" in pages[0]
    assert re.fullmatch(r"[^%]* error \d+(\.\d+)? %", notebook[-1]["data"]["text/plain"])


def test_without_a_notebook_the_state_is_printed_once(capsys):
    pytest.importorskip("IPython")
    mlt.start(scene(), spp=2).show(interval=0.1)
    assert capsys.readouterr().out.startswith("path, 160 x 120, ")
