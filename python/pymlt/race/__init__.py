"""Races: which algorithm has the smallest error after equal CPU time?

For example::

    race = mlt.equal_time(["path", "bdpt", "mlt"], "scene.xml", "reference.exr", seconds=20)
    print(race)
    race.save_html("race.html")
"""

from .equal_time import equal_time
from .program import Program
from .races import Race, RaceResult
from .report import Report
from .result import Entry
from .run import Run, Snapshot
from .score import Mean, Score

__all__ = [
    "Entry",
    "Mean",
    "Program",
    "Race",
    "RaceResult",
    "Report",
    "Run",
    "Score",
    "Snapshot",
    "equal_time",
]
