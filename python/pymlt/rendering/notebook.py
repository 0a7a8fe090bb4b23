"""A render in a notebook: the image so far, renewed in its place."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

from .._extras import import_extra
from ..pictures.notebook import figure
from ..pictures.tonemapping import Exposure
from .summary import summary


@dataclass
class Picture:
    """What a notebook shows of a render."""

    job: Any  #: the Job
    exposure: Exposure

    def _repr_html_(self) -> str:
        return figure(self.job._seen, repr(self), self.exposure)

    def __repr__(self) -> str:
        stats = self.job.stats
        done = "" if self.job.ended else f", {100 * self.job.progress:.0f} % done"
        return summary(stats["integrator"], self.job.image, stats) + done


def show(job, interval: float, exposure: Exposure) -> None:
    """Show the image of a Job; see `Job.show`."""
    display = import_extra("IPython.display", "notebook", "showing a render").display
    picture = Picture(job, exposure)
    handle = display(picture, display_id=True)
    ended = False
    while not ended:
        ended = job.wait(interval)
        if handle is not None:  # there is a front end
            handle.update(picture)
