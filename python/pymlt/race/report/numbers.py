"""The numbers of a race for JSON."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import asdict
from typing import TYPE_CHECKING, Any

from ... import _core
from .table import notes

if TYPE_CHECKING:
    from ..result import Entry, Outcome


def numbers(results: Sequence[Outcome]) -> dict[str, Any]:
    """Everything but the images; what is not known or not finite is None."""
    made: dict[str, Any] = _finite(
        {
            "pymlt": _core.__version__,
            "processor": results[0].processor if results else None,
            "races": [_race(result) for result in results],
        }
    )
    return made


def _race(result: Outcome) -> dict[str, Any]:
    return {
        "scene": result.settings.name,
        "settings": asdict(result.settings),
        "reference_relmse": result.reference_error,
        "has_reference": result.reference_error is not None,
        "interrupted": result.interrupted,
        "insets": result.insets,
        "notes": notes(result),
        "algorithms": [_entry(entry) for entry in result.entries],
    }


def _entry(entry: Entry) -> dict[str, Any]:
    return {
        "label": entry.label,
        "settings": entry.settings,
        "problem": entry.problem or None,
        "runs": [
            {"seed": run.seed, "cpu_seconds": run.seconds, "spp": run.spp} for run in entry.runs
        ],
        "scores": [asdict(score) if score else None for score in entry.scores],
    }


def _finite(value: Any) -> Any:
    """The same, with lists for tuples, and None for numbers that JSON does not know."""
    if isinstance(value, dict):
        return {key: _finite(inner) for key, inner in value.items()}
    if isinstance(value, list | tuple):
        return [_finite(inner) for inner in value]
    return None if isinstance(value, float) and not math.isfinite(value) else value
