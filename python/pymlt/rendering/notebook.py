"""A render in a notebook: the image so far, renewed in its place."""

from __future__ import annotations

import base64
import tempfile
from dataclasses import dataclass
from html import escape
from pathlib import Path
from typing import Any

from .. import _core
from ..images import write_image


@dataclass
class Picture:
    """What a notebook shows of a render."""

    job: Any  #: the Job
    exposure: float

    def _repr_html_(self) -> str:
        data = base64.b64encode(_png(self.job.image, self.exposure)).decode()
        return (
            f'<figure><img src="data:image/png;base64,{data}"/>'
            f"<figcaption>{escape(repr(self))}</figcaption></figure>"
        )

    def __repr__(self) -> str:
        stats = self.job.stats
        width, height = stats["size"]
        done = "" if self.job.ended else f", {100 * self.job.progress:.0f} %"
        return f"{stats['integrator']}, {width} x {height}, {stats['spp_done']:.4g} spp{done}"


def _png(image, exposure: float) -> bytes:
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "image.png"
        write_image(path, image, exposure=exposure)
        return path.read_bytes()


def show(job, interval: float, exposure: float) -> None:
    """Show the image of a Job; see `Job.show`."""
    try:
        from IPython.display import display
    except ImportError:
        raise _core.UsageError("showing a render needs IPython; pip install ipython") from None
    picture = Picture(job, exposure)
    handle = display(picture, display_id=True)
    ended = False
    while not ended:
        ended = job.wait(interval)
        if handle is not None:  # there is a front end
            handle.update(picture)
