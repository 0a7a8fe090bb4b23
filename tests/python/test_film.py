"""Films of frames."""

import subprocess
import sys

import numpy as np
import pytest

import pymlt as mlt
from pymlt.pictures.tonemapping import encode_srgb

imageio_ffmpeg = pytest.importorskip("imageio_ffmpeg", reason="the extra video is not installed")

GREYS = (0.1, 0.4, 0.8)


def frames(height: int = 32, width: int = 48) -> list[np.ndarray]:
    return [np.full((height, width, 3), grey, np.float32) for grey in GREYS]


def seen(path, height: int, width: int) -> tuple[str, np.ndarray]:
    """What the decoder tells of a film, and its frames."""
    command = [imageio_ffmpeg.get_ffmpeg_exe(), "-i", path, "-f", "rawvideo", "-pix_fmt", "rgb24"]
    done = subprocess.run([*command, "-"], capture_output=True, check=True)
    frames = np.frombuffer(done.stdout, np.uint8).reshape(-1, height, width, 3)
    return done.stderr.decode(), frames


def test_a_film_has_the_frames_as_pictures_show_them(tmp_path):
    mlt.write_film(tmp_path / "a.mp4", frames(), fps=10, exposure=-1)
    told, found = seen(tmp_path / "a.mp4", 32, 48)
    assert "10 fps" in told
    assert "48x32" in told
    assert len(found) == 3
    expected = 255 * encode_srgb(np.array(GREYS) / 2)
    assert np.abs(found.mean(axis=(1, 2, 3)) - expected).max() < 3
    assert [path.name for path in tmp_path.iterdir()] == ["a.mp4"]


def test_files_are_frames_and_odd_sizes_are_padded(tmp_path):
    for i, frame in enumerate(frames(31, 47)):
        mlt.write_image(tmp_path / f"{i}.exr", frame)
    mlt.write_film(tmp_path / "a.mp4", [tmp_path / f"{i}.exr" for i in range(3)])
    told, found = seen(tmp_path / "a.mp4", 32, 48)
    assert "48x32" in told
    assert len(found) == 3


@pytest.mark.parametrize(
    ("name", "given", "message"),
    [
        ("a.avi", frames(), r"write .*a\.mp4"),
        ("a.mp4", [], "give some"),
        ("a.mp4", [*frames(), np.zeros((8, 8, 3))], "should be alike"),
        ("a.mp4", [np.zeros((8, 8))], r"should be \(height, width, 3\)"),
    ],
)
def test_what_is_no_film_is_refused(tmp_path, name, given, message):
    with pytest.raises(mlt.UsageError, match=message):
        mlt.write_film(tmp_path / name, given)
    assert list(tmp_path.iterdir()) == []


def test_the_extra_is_named(tmp_path, monkeypatch):
    monkeypatch.setitem(sys.modules, "imageio_ffmpeg", None)
    with pytest.raises(mlt.UsageError, match="a film needs `pip install 'imageio-ffmpeg>="):
        mlt.write_film(tmp_path / "a.mp4", frames())
