"""benchmarks/public_scenes.py: what became of a folder of scenes, and what has changed."""

import json
import subprocess
import sys
from pathlib import Path

import tiny

PROGRAM = Path(__file__).parents[2] / "benchmarks" / "public_scenes.py"


def run(*arguments):
    done = subprocess.run(
        [sys.executable, PROGRAM, *map(str, arguments)], capture_output=True, text=True, check=True
    )
    return done.stdout


def test_it_tells_what_became_of_each_scene_and_what_has_changed(tmp_path):
    folder = tmp_path / "scenes"
    folder.mkdir()
    (folder / "good.xml").write_text(tiny.XML)
    (folder / "bad.xml").write_text("<scene version='3.0.0'><shape type='blob'/></scene>")
    (folder / "part.xml").write_text("<bsdf type='diffuse'/>")
    before = tmp_path / "before.json"
    assert "2 scenes: 1 refused, 1 rendered" in run(folder, "--json", before)
    rows = {Path(row["scene"]).name: row for row in json.loads(before.read_text())}
    assert set(rows) == {"good.xml", "bad.xml"}
    assert max(rows["good.xml"]["mean"]) > 0
    assert "blob" in rows["bad.xml"]["said"][-1]
    assert "changed" not in run(folder, "--against", before)

    (folder / "bad.xml").write_text(tiny.XML)
    said = run(folder, "--against", before, "--pictures", tmp_path / "pictures")
    assert "bad.xml: refused before, rendered now" in said
    assert len(list((tmp_path / "pictures").iterdir())) == 2
