"""AgX, the tone curve of Blender, as a closed formula.

Sobotka 2023, AgX (https://github.com/sobotka/AgX), in the version of Chow that Blender has
(https://github.com/EaryChow/AgX_LUT_Gen): light of Rec. 2020, mixed a little between the channels,
goes through a sigmoid of its logarithm and is unmixed. Left out is what Chow's table does for the
most saturated colours alone: 40 % of the hue before the sigmoid, and negative light taken to the
edge of the gamut in place of 0.
"""

from __future__ import annotations

import functools
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    import numpy as np

GREY = 0.18  #: which is shown as it is
BELOW, ABOVE = 10, 6.5  #: stops around it that are shown
SLOPE, POWER = 2.4, 1.5  #: of the sigmoid, and how it bends to its ends
GAMMA = 2.4  #: of the display that its values are for

REC_2020 = [  #: from Rec. 709 (ITU-R BT.2087, sec. 4)
    [0.6274, 0.3293, 0.0433],
    [0.0691, 0.9195, 0.0114],
    [0.0164, 0.0880, 0.8956],
]
INSET = [
    [0.856627153315983, 0.0951212405381588, 0.0482516061458583],
    [0.137318972929847, 0.761241990602591, 0.101439036467562],
    [0.11189821299995, 0.0767994186031903, 0.811302368396859],
]
OUTSET = [  #: inverted
    [0.899796955911611, 0.0871996192028351, 0.013003424885555],
    [0.11142098895748, 0.875575586156966, 0.0130034248855548],
    [0.11142098895748, 0.0871996192028349, 0.801379391839686],
]


def agx(light: np.ndarray) -> np.ndarray:
    """What a display shows, linear, for linear light of Rec. 709; both (..., 3)."""
    import numpy as np

    inset, outset = _matrices()
    mixed = np.maximum(light @ inset, 1e-10)
    stops = np.log2(mixed / GREY).clip(-BELOW, ABOVE)
    formed: np.ndarray = _sigmoid(stops).clip(0, 1) ** GAMMA @ outset
    return formed


@functools.cache
def _matrices() -> tuple[np.ndarray, np.ndarray]:
    """From Rec. 709 to what the sigmoid takes, and back from what it gives; for rows of light."""
    import numpy as np

    to_2020 = np.array(REC_2020)
    return (INSET @ to_2020).T, np.linalg.inv(OUTSET @ to_2020).T


def _sigmoid(stops: np.ndarray) -> np.ndarray:
    """From 0 to 1, through grey at 0, where it has its slope; a curve by Jed Smith on each side."""
    import numpy as np

    middle = GREY ** (1 / GAMMA)
    is_above = stops > 0
    x = abs(stops) / (BELOW + ABOVE)
    width = np.where(is_above, ABOVE, BELOW) / (BELOW + ABOVE)
    height = np.where(is_above, 1 - middle, middle)
    bend = ((SLOPE * width / height) ** POWER - 1) * (x / width) ** POWER
    distance = SLOPE * x * (1 + bend) ** (-1 / POWER)
    shown: np.ndarray = middle + np.where(is_above, distance, -distance)
    return shown
