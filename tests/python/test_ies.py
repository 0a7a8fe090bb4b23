"""The light `ies`, with the intensities of a luminaire's photometric file."""

import itertools
import math

import pytest

import pymlt as mlt

FILM = {"type": "hdrfilm", "width": 1, "height": 1, "rfilter": {"type": "box"}}
METER = {"type": "irradiancemeter", "film": FILM}
BLACK = {"type": "diffuse", "reflectance": 0.0}
UP = mlt.Transform.rotate([1, 0, 0], -90)  # turns +z to +y
CANDELA = [(0, 900), (30, 700), (60, 300), (90, 50)]  # by the angle from straight down


@pytest.fixture
def lamp(tmp_path):
    """A lamp that hangs along y, with the light of CANDELA all around."""
    path = tmp_path / "lamp.ies"
    angles, values = (" ".join(map(str, column)) for column in zip(*CANDELA, strict=True))
    path.write_text(
        "IESNA:LM-63-1995\n[TEST] none\nTILT=NONE\n"
        f"1 1000 1 {len(CANDELA)} 1 1 2 0 0 0 1 1 60\n{angles}\n0\n{values}\n"
    )
    return {"type": "ies", "filename": str(path), "to_world": UP}


def measured(meter, lamp, algorithm="bdpt", spp=4096):
    scene = {"type": "scene", "meter": meter | {"bsdf": BLACK, "sensor": METER}, "lamp": lamp}
    return mlt.render(mlt.load_dict(scene), algorithm, spp=spp)[0, 0]


def lumens(a, b):
    """The flux between two rows: 2 pi times the integral of the intensity with sin(theta)."""
    n = 10_000
    (low, first), (high, last) = ((math.radians(angle), candela) for angle, candela in (a, b))
    thetas = [low + (high - low) * (i + 0.5) / n for i in range(n)]
    values = (first + (last - first) * (i + 0.5) / n for i in range(n))
    mean = sum(v * math.sin(theta) for v, theta in zip(values, thetas, strict=True)) / n
    return 2 * math.pi * (high - low) * mean


@pytest.mark.parametrize("algorithm", ["bdpt", "ptracer", "mlt"])
@pytest.mark.parametrize(("angle", "candela"), [(0, 900), (30, 700), (45, 500), (75, 175)])
def test_on_the_floor_it_is_candela_over_the_distance_squared(lamp, angle, candela, algorithm):
    height, theta = 2, math.radians(angle)
    place = mlt.Transform.translate([height * math.tan(theta), -height, 0]) @ UP
    floor = {"type": "rectangle", "to_world": place.scale(1e-3)}
    expected = candela / 683 * math.cos(theta) ** 3 / height**2
    assert measured(floor, lamp, algorithm) == pytest.approx([expected] * 3, rel=2e-3)


def test_all_its_lumens_arrive_on_a_ball_around_it(lamp):
    radius = 3
    ball = {"type": "sphere", "radius": radius, "flip_normals": True}
    all_lumens = sum(lumens(a, b) for a, b in itertools.pairwise(CANDELA))
    expected = all_lumens / 683 / (4 * math.pi * radius**2)
    warm = {"type": "rgb", "value": [1.5, 1, 0.5]}
    found = measured(ball, lamp | {"scale": warm}, "ptracer", 16384)
    assert found / [1.5, 1, 0.5] == pytest.approx([expected] * 3, rel=0.01)


def test_a_file_that_is_none_is_refused(tmp_path):
    path = tmp_path / "lamp.ies"
    path.write_text("a lamp")
    with pytest.raises(mlt.SceneError, match="has no line TILT=NONE"):
        measured({"type": "rectangle"}, {"type": "ies", "filename": str(path)})
