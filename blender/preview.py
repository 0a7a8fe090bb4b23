"""The picture of the viewport: a render that begins anew when the view or the scene changes."""

from time import monotonic

import numpy as np

import pymlt as mlt

from .passes import rgba

INTERVAL = 0.1  #: seconds for which pixels are shown before newer ones are asked for


class Preview:
    """A scene, the camera that looks at it, and the render that runs."""

    def __init__(self):
        self._described: dict = {}
        self._sensor: dict = {}
        self._scene: mlt.Scene | None = None
        self._job: mlt.Job | None = None
        self._how: dict = {}
        self._pixels: np.ndarray | None = None
        self._next = 0.0

    def update(self, described: dict, **how) -> None:
        """Shows another scene, a dict with a sensor "camera"; `how` is for `pymlt.start`."""
        self._described, self._sensor, self._how = described, described["camera"], how
        self._scene = mlt.load_dict(described)
        self._start()

    def look(self, sensor: dict) -> None:
        """Looks from elsewhere; only another kind of camera or image builds the scene again."""
        if same(sensor, self._sensor):
            return
        if kind(sensor) == kind(self._sensor):
            self._scene = self._scene.updated({f"camera.{k}": v for k, v in values(sensor).items()})
        else:
            self._scene = mlt.load_dict(self._described | {"camera": sensor})
        self._sensor = sensor
        self._start()

    def _start(self) -> None:
        self.stop()
        self._job = mlt.start(self._scene, **self._how)
        self._next = 0.0

    @property
    def ended(self) -> bool:
        return self._job is None or self._job.ended

    @property
    def samples(self) -> float:
        return self._job.samples if self._job else 0.0

    def pixels(self) -> np.ndarray | None:
        """What is to be drawn: float32, (height, width, 4), row 0 at the bottom.

        None as long as there is nothing yet.
        """
        if self._job and (self._job.ended or monotonic() >= self._next):
            self._next = monotonic() + INTERVAL
            if self.samples:
                self._pixels = rgba(self._job.image[::-1])
        return self._pixels

    def stop(self) -> None:
        if self._job:
            self._job.cancel()

    def __del__(self):
        self.stop()


def values(sensor: dict) -> dict:
    """What of a camera changes when it moves."""
    return {k: v for k, v in sensor.items() if k not in ("type", "film")}


def kind(sensor: dict) -> tuple:
    """What a camera and its image are, wherever they look from."""
    return sensor["type"], sensor["film"], sorted(values(sensor))


def same(a: dict, b: dict) -> bool:
    return kind(a) == kind(b) and all(np.array_equal(v, b[k]) for k, v in values(a).items())
