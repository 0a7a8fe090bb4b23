"""How long a render that was too short should have been."""

from __future__ import annotations

from .result import Result

KNOWN_FROM = 16  #: samples per pixel, from which on there is an error
GOOD_LEVEL = 0.05  #: relative error of the brightness of the whole image
GOOD_ERROR = 0.1  #: relative error of the image, below which nobody calls it noise
ASKING = ("render for longer", "more time")  #: what warnings say that ask for a larger budget


def needed(result: Result) -> str:
    """How long would do, as the render has cost so far; "" for one that was long enough.

    Errors fall with the square root of the samples. Where light was found rarely, they and the
    time are larger than they seem.
    """
    stats = result.stats
    spp, error, level = stats["spp_done"], stats.get("error"), stats.get("level_error") or 0
    goals = []
    if error is None and result.image.any():
        goals.append((KNOWN_FROM / spp, "to know the error", ""))
    if any(words in warning for warning in stats["warnings"] for words in ASKING):
        level_goal = f"to know the brightness to {100 * GOOD_LEVEL:.0f} %"
        goals.append(((level / GOOD_LEVEL) ** 2, level_goal, ""))
        error_goal = f"for an error of {100 * GOOD_ERROR:.0f} %"
        goals.append((((error or 0) / GOOD_ERROR) ** 2, error_goal, ", or longer"))
    more, goal, doubt = max(goals, default=(1, "", ""))
    if more <= 1:
        return ""
    seconds = stats["seconds"]["bootstrap"] + more * stats["seconds"]["render"]
    return f"{goal}, render for about {duration(seconds)} ({more * spp:.2g} spp){doubt}"


def duration(seconds: float) -> str:
    """As people say it: 0.4 s, 50 s, 12 min, 3 h."""
    for unit, size in (("h", 3600), ("min", 60)):
        if seconds >= 2 * size:
            return f"{seconds / size:.0f} {unit}"
    return f"{seconds:.0f} s" if seconds >= 9.95 else f"{max(seconds, 0.1):.1f} s"
