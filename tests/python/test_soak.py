"""The soak's script, for a few rounds: it is to work on the day when somebody lets it run."""

import subprocess
import sys

import pytest

import pymlt as mlt


def test_a_few_rounds_of_the_soak_find_nothing(repository):
    script = repository / "tests" / "soak.py"
    done = subprocess.run(
        [sys.executable, script, "--seed", "3", "--rounds", "6", "--hours", "0.01", "--no-cluster"],
        capture_output=True,
        text=True,
        timeout=250,
    )
    assert done.returncode == 0, done.stdout + done.stderr
    assert "seed 3: {" in done.stdout
    assert "pauses" in done.stdout
    assert "kills" in done.stdout


@pytest.mark.parametrize("wrong", ["seed", "layer", "error"])
def test_the_soak_finds_what_is_wrong(wrong, repository, tmp_path, monkeypatch):
    monkeypatch.syspath_prepend(str(repository / "tests"))
    soak = pytest.importorskip("soak")

    def goes_wrong(work, path, seconds):
        if wrong == "seed":
            return mlt.start(
                work.scene, work.integrator, spp=work.options["spp"], seed=1001
            ).result()
        result = work.start().result()
        if wrong == "layer":
            result.layers["error"] = result.layers["error"] + 1
            return result
        raise soak.SoakError("the child ended")

    with pytest.raises(soak.SoakError, match=r"differs|ended"):
        soak.Round(3, 0).check(tmp_path, goes_wrong)
