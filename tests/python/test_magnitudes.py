"""Coordinates, transforms and densities that are too large for rays: one line, and no crash."""

import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest
import tiny
from command_line import run, the_error

import pymlt as mlt
from pymlt.formats.ply import Mesh, write_ply

T = mlt.Transform
CORNERS = np.array([[0, 0, 0], [1, 0, 0], [0, 1, 0]], np.float32)
FACE = np.array([[0, 1, 2]], np.uint32)

# What is added to the tiny scene at its end, line 37, and what is said of it.
XML = {
    "centre": (
        '<shape type="sphere"><point name="center" x="-1e20" y="0" z="0"/></shape>',
        "shape 'sphere': 'center' has the number -1e+20, but should have none beyond 1e+15",
    ),
    "radius": (
        '<shape type="sphere"><float name="radius" value="1e20"/></shape>',
        "shape 'sphere' reaches the coordinate -1e+20, but should have none beyond 1e+15",
    ),
    "scale": (
        '<shape type="rectangle"><transform name="to_world"><scale x="1e20"/></transform></shape>',
        "shape 'rectangle': 'to_world' has the number 1e+20, but should have none beyond 1e+15",
    ),
    "light": (
        '<emitter type="point"><point name="position" x="1e20" y="0" z="0"/></emitter>',
        "emitter 'point': 'position' has the number 1e+20, but should have none beyond 1e+15",
    ),
    "fog": (
        '<shape type="cube"><bsdf type="null"/><medium type="homogeneous" name="interior">'
        '<float name="sigma_t" value="1e20"/></medium></shape>',
        "medium 'homogeneous' has an extinction of 1e+20, but at most 1e+15 is right",
    ),
}


def with_part(part: str) -> str:
    return tiny.XML.replace("</scene>", part + "\n</scene>")


@pytest.mark.parametrize(("part", "message"), XML.values(), ids=XML)
def test_what_is_too_large_is_named_with_its_line(part, message, program, tmp_path):
    (tmp_path / "scene.xml").write_text(with_part(part))
    error = the_error(run(program, "scene.xml", "-o", "out.exr", cwd=tmp_path))
    assert error.endswith(f"scene.xml:{tiny.XML.count(chr(10))}: {message}")


def test_a_camera_too_far_away_is_refused():
    with pytest.raises(mlt.SceneError, match=r":7: sensor 'perspective': 'to_world' has .* 4e\+18"):
        mlt.load_string(tiny.XML.replace("0, 1, 4", "0, 1, 4e18"))


def test_a_lens_too_large_is_refused():
    lens = {"type": "thinlens", "aperture_radius": 1e20, "focus_distance": 1.0}
    with pytest.raises(mlt.SceneError, match=r"the lens has the radius 1e\+20, but at most 1e\+15"):
        mlt.load_dict(tiny.scene() | {"sensor": lens})


def test_meshes_and_groups_too_large_are_refused(tmp_path):
    write_ply(tmp_path / "far.ply", Mesh(CORNERS * np.float32(1e20), FACE))
    lines = [f"v {1e20 * x} {y} 0\n" for x, y, _ in CORNERS.tolist()]
    (tmp_path / "far.obj").write_text("".join(lines) + "f 1 2 3\n")
    array = {"type": "mesh", "vertices": CORNERS * np.float32(1e20), "faces": FACE}
    small = T().scale([1e-15, 1e-15, 1e-15])
    for shape in [
        *({"type": name, "filename": str(tmp_path / f"far.{name}")} for name in ("ply", "obj")),
        array,
        {"type": "instance", "group": {"type": "shapegroup", "far": array}, "to_world": small},
    ]:
        with pytest.raises(mlt.SceneError, match=r"reaches the coordinate 1e\+20, but should have"):
            mlt.load_dict(tiny.scene() | {"far": shape})


@pytest.mark.parametrize("scale", [1e-14, 1e-30, 1e14])
def test_instances_scaled_too_much_are_refused(scale):
    ball = {"type": "shapegroup", "ball": {"type": "sphere", "radius": 1 / scale**0.5}}
    instance = {"type": "instance", "group": ball, "to_world": T().scale([scale] * 3)}
    with pytest.raises(
        mlt.SceneError, match=r"'instance' scales lengths by .*, but here .* is right"
    ):
        mlt.load_dict(tiny.scene() | {"small": instance})


def test_a_volume_too_dense_is_refused():
    dense = {"type": "gridvolume", "data": np.full((2, 2, 2), 1e20)}
    medium = {"type": "heterogeneous", "sigma_t": dense}
    cube = {"type": "cube", "bsdf": {"type": "null"}, "interior": medium}
    with pytest.raises(mlt.SceneError, match=r"'heterogeneous' has an extinction of 1e\+20"):
        mlt.load_dict(tiny.scene() | {"cube": cube})


def test_an_edit_too_large_is_refused_and_changes_nothing():
    scene = mlt.load_string(tiny.XML)
    name = next(name for name in scene.parameters() if name.endswith(".center"))
    before = scene.parameters()
    with pytest.raises(mlt.SceneError, match=r"'center' has the number 1e\+20"):
        scene.updated({name: [1e20, 0, 0]})
    assert str(scene.parameters()) == str(before)


def test_rays_from_too_far_away_are_refused():
    scene = mlt.load_string(tiny.XML)
    far, down = [0, 1e20, 0], [0, -1, 0]
    with pytest.raises(mlt.UsageError, match=r"start has the coordinate 1e\+20, but should have"):
        scene.intersect(far, down)
    with pytest.raises(mlt.UsageError, match=r"start 1 has the coordinate 1e\+20, but should"):
        scene.intersect(np.array([[0, 1, 0], far]), np.array([down, down]))


# ---- one number at a time ------------------------------------------------------------------------

SCENES = Path(__file__).resolve().parents[1] / "scenes"
MUTATE = Path(__file__).with_name("mutate_numbers.py")


def ends_well(every: int, first: int, files: list[Path], timeout: float) -> int:
    """How many mutations have ended with an image or with one of our errors: all."""
    command = [sys.executable, MUTATE, str(every), str(first), *files]
    done = subprocess.run(command, capture_output=True, text=True, timeout=timeout)
    lines = done.stdout.splitlines()
    assert done.returncode == 0, lines[-1] + done.stderr
    return len(lines)


def test_no_number_of_a_scene_ends_the_process():
    names = ["thin_lens", "instances", "smoke", "mixed_lights", "moving_ball", "more_materials"]
    files = [SCENES / f"{name}.xml" for name in names]
    assert ends_well(3, 1, files, timeout=120) > 200


@pytest.mark.long
def test_no_number_of_any_scene_ends_the_process():
    assert ends_well(1, 0, sorted(SCENES.glob("*.xml")), timeout=1800) > 5000
