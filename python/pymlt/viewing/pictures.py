"""The picture of a tab: the image or a layer, of one render or of two."""

from __future__ import annotations

from time import monotonic
from typing import TYPE_CHECKING, Any, NamedTuple
from weakref import WeakKeyDictionary

from ..pictures.denoising import denoise
from ..rendering.job import Job
from ..rendering.start import start
from . import shown

if TYPE_CHECKING:
    import numpy as np

QUALITY = 90  #: of JPEG, of 100
PATIENCE = 1.0  #: seconds between two denoised pictures of a render, at the least
REST = 2.0  #: times as long as one has taken, that the denoiser rests
LONG = 1.0  #: seconds; halves that take longer are denoised at the beginning and at the end alone


class Denoised(NamedTuple):
    """A picture of a render."""

    image: np.ndarray
    due: float  #: when it is to be made anew
    is_slow: bool  #: whether its halves take long
    final: bool


class Pictures:
    """Makes them for a session."""

    def __init__(self, session: Any):
        self._session = session
        self._layers: dict[str, np.ndarray] = {}
        self._denoised: WeakKeyDictionary[Job, Denoised] = WeakKeyDictionary()

    def forget(self) -> None:
        """What the camera sees has changed."""
        self._layers.clear()

    def make(self, look: shown.Look, share: float | None) -> np.ndarray | None:
        """What is to be seen now, or None if there is nothing yet; `share` divides two renders."""
        if look.layer in shown.AOVS:
            return self._layer(look.layer)
        left = self._render(look, 0)
        if left is None or share is None:
            return left
        right = self._render(look, 1)
        return left if right is None else shown.split(left, right, share)

    def _render(self, look: shown.Look, index: int) -> np.ndarray | None:
        live = self._session.live
        image = live.image(index)
        if image is None:
            small = live.small
            if small is None:
                return None
            return shown.enlarged(shown.picture(small, look.exposure, look.curve), self._size)
        if look.layer == shown.ERROR:
            error = live.jobs[index].error_map
            if error is not None:
                return shown.error_picture(image, error)
        if look.lamps:
            image = _mixed(live.jobs[index], look.lamps)
            image = denoise(image) if look.denoise else image
        elif look.denoise:
            image = self._without_noise(live.jobs[index])
        return shown.picture(image, look.exposure, look.curve)

    def _without_noise(self, job: Job) -> np.ndarray:
        """Denoised anew about once a second, and at the end."""
        known, begun, ended = self._denoised.get(job), monotonic(), job.ended
        if known and (known.final or (begun < known.due and not ended)):
            return known.image
        if known and known.is_slow and not ended:
            image, is_slow = denoise(job.image), True
        else:
            image = job.denoised()
            is_slow = monotonic() - begun > LONG
        due = monotonic() + max(PATIENCE, REST * (monotonic() - begun))
        self._denoised[job] = Denoised(image, due, is_slow, ended)
        return image

    @property
    def _size(self) -> tuple[int, int]:
        return self._session.camera.size

    def _layer(self, name: str) -> np.ndarray:
        """Of a render of its own, with one sample a pixel."""
        if name not in self._layers:
            job = start(self._session.scene(), "direct", spp=1, aovs=name)
            self._layers[name] = shown.layer_picture(name, job.result().layers[name])
        return self._layers[name]


def _mixed(job: Job, factors: dict[str, tuple[float, float, float]]) -> np.ndarray:
    """The light of all lamps, each times its factors."""
    import numpy as np

    return sum(light * np.float32(factors[name]) for name, light in job.light().items())
