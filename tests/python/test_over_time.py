"""What halves tell about the mean of neighbouring frames, of which each is a blur."""

import numpy as np
import pytest
from test_halves import SIZE, Noisy, relative_error, scene

from pymlt.pictures.over_time import error_of_change, mean_over_time

LEFT, RIGHT = np.s_[:, : SIZE[1] // 2 - 12], np.s_[:, SIZE[1] // 2 + 12 :]
LAMP, TRAIL = (np.s_[40:44, x : x + 4] for x in (100, 90))


def moving_stripes(k: int) -> np.ndarray:
    """The stripes move by half of their width from frame to frame; the left part stands still."""
    image = scene()
    image[:, SIZE[1] // 2 :] = np.roll(image[:, SIZE[1] // 2 :], k, axis=1)
    return image


def with_lamp(place) -> np.ndarray:
    image = scene()
    image[place] = 1000.0
    return image


def frames(images, variance=2.0, seed=1):
    return [Noisy(image, variance, seed + k).mixture() for k, image in enumerate(images)]


def squares(found, now, image, part) -> list[float]:
    """Of the errors of both, in a part of the image."""
    return [relative_error(f.image[part], image[part]) ** 2 for f in (found, now)]


@pytest.mark.parametrize("variance", [0.2, 2.0, 8.0])
def test_where_nothing_moves_the_mean_is_better_and_knows_its_error(variance):
    """The mean of three has a third of the variance and all of the bias. The halves do not tell
    the weight exactly, so that a quarter of what could be gained is enough."""
    image, both = scene(), []
    for seed in (1, 11, 21):
        before, now, after = frames(3 * [image], variance, seed)
        found = mean_over_time(now, [before, after])
        assert found.relative == pytest.approx(relative_error(found.image, image), rel=0.25)
        both.append(squares(found, now, image, LEFT))
    mixed, alone = np.mean(both, axis=0)
    assert mixed < 0.83 * alone


@pytest.mark.parametrize("variance", [0.2, 2.0, 8.0])
def test_what_moves_is_not_mixed(variance):
    images = [moving_stripes(k) for k in range(3)]
    before, now, after = frames(images, variance)
    found = mean_over_time(now, [before, after])
    mixed, alone = squares(found, now, images[1], RIGHT)
    assert mixed < 1.05 * alone
    mixed, alone = squares(found, now, images[1], LEFT)
    assert mixed < 0.83 * alone
    careless = (before.image + now.image + after.image) / 3
    assert relative_error(careless[RIGHT], images[1][RIGHT]) ** 2 > 1.5 * alone


def test_a_lamp_that_moves_leaves_no_trail():
    images = [with_lamp(LAMP), with_lamp(LAMP), with_lamp(TRAIL)]
    before, now, after = frames(images)
    found = mean_over_time(now, [before, after])
    assert found.image[TRAIL].max() < 1.01 * now.image[TRAIL].max()
    assert relative_error(found.image, images[1]) < relative_error(now.image, images[1])


def test_frames_with_the_same_noise_stay():
    frame = Noisy(scene(), 2.0, 1).mixture()
    found = mean_over_time(frame, [frame, frame])
    assert found.image == pytest.approx(frame.image, rel=1e-6)
    assert found.relative == pytest.approx(frame.relative, rel=0.01)


def test_a_frame_alone_stays():
    frame = Noisy(scene(), 2.0, 1).mixture()
    assert mean_over_time(frame, []) is frame


@pytest.mark.parametrize("variance", [0.2, 2.0, 8.0])
def test_the_error_of_a_change_is_known(variance):
    images = [scene(), 1.1 * scene()]
    claimed, true = [], []
    for seed in range(0, 16, 2):
        before, after = frames(images, variance, seed)
        claimed.append(error_of_change(before, after) ** 2)
        change = after.image - before.image - (images[1] - images[0])
        true.append(relative_error(images[1] + change, images[1]) ** 2)
    assert np.mean(claimed) == pytest.approx(np.mean(true), rel=0.3)
