"""An example of the lecture: what can be set, and what it shows then."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import TYPE_CHECKING, NamedTuple

if TYPE_CHECKING:
    import numpy as np


class Slider(NamedTuple):
    """What can be set."""

    name: str
    low: float
    high: float
    step: float
    value: float


@dataclass
class Curve:
    """One line of a chart; its x are those of the chart."""

    name: str
    y: np.ndarray
    dots: bool = False


@dataclass
class Chart:
    title: str
    x: np.ndarray
    curves: list[Curve]
    span: tuple[float, float] | None = None  #: of the vertical axis; None: that of the curves


@dataclass
class Shown:
    """An example for one setting."""

    text: str
    charts: list[Chart]


@dataclass(frozen=True)
class Example:
    name: str
    text: str
    formula: str  #: as `formula.as_html` reads it
    source: str  #: of the formula
    sliders: tuple[Slider, ...]
    run: Callable[..., Shown]  #: of the values of the sliders
