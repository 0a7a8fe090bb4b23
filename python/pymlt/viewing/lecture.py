"""The lecture's examples, each with its sliders: a page of a session's panel, or all of a tab."""

from __future__ import annotations

import contextlib
import threading
from html import escape
from typing import Any

from . import formula
from .browser import set_title
from .lecture_chart import Chart, Example
from .lecture_examples import EXAMPLES
from .page import STYLE, WIDE
from .worker import Worker

STROKES = ("#4aa3ff", "#ff9f43", "#3ecf8e", "#ff6b6b", "#bbbbbb")
INK = "#c8c8c8"
COMPUTING = '<p class="mlt">computing …</p>'


class LectureTab(Worker):
    """A tab without a scene."""

    def __init__(self, client: Any):
        super().__init__(client)
        set_title(client, "pymlt lecture")
        client.gui.add_html(STYLE + WIDE)
        self.lecture = Lecture(self)
        self.lecture.show(True)
        self._thread.start()


class Lecture:
    """Of a tab, within the container that is open."""

    def __init__(self, session: Worker):
        self._session, self._gui = session, session.client.gui
        names = [example.name for example in EXAMPLES]
        self._choice = self._gui.add_dropdown("Example", names)
        self._place = self._gui.add_folder(None)
        self._parts: list[Any] = []
        self._sliders: list[Any] = []
        self._charts: list[Any] = []
        self._text: Any = None
        self._example: Example | None = None
        self._asked = threading.Event()
        self._choice.on_update(lambda _: self._choose())

    def show(self, visible: bool) -> None:
        """Its first example is computed when the page is first seen."""
        if visible and self._example is None:
            self._session.post(self._open)

    def _choose(self) -> None:
        """Says so at once, whatever the tab's thread is doing."""
        if self._text is not None:
            self._tell(COMPUTING)
        self._session.post(self._open)

    def _move(self) -> None:
        """Moves of a slider that come before the tab's thread looks at them count as one."""
        if not self._asked.is_set():
            self._asked.set()
            self._tell(self._text.content.replace('"mlt"', '"mlt old"'))
            self._session.post(self._renew)

    def _tell(self, content: str) -> None:
        with contextlib.suppress(RuntimeError):  # the tab's thread has just removed the text
            self._text.content = content

    def _open(self) -> None:
        """Show the example that was chosen."""
        for part in self._parts:
            part.remove()
        self._example = next(e for e in EXAMPLES if e.name == self._choice.value)
        with self._place:
            intro = self._gui.add_html(_introduction(self._example))
            self._sliders = [
                self._gui.add_slider(s.name, float(s.low), float(s.high), s.step, float(s.value))
                for s in self._example.sliders
            ]
            self._text = self._gui.add_html(COMPUTING)
            self._session.client.flush()
            shown = self._run()
            self._charts = [self._gui.add_uplot(**_uplot(chart)) for chart in shown.charts]
        for slider in self._sliders:
            slider.on_update(lambda _: self._move())
        self._parts = [intro, *self._sliders, self._text, *self._charts]

    def _run(self) -> Any:
        assert self._example is not None
        shown = self._example.run(*(float(slider.value) for slider in self._sliders))
        self._text.content = f'<p class="mlt" data-example="1">{escape(shown.text)}</p>'
        return shown

    def _renew(self) -> None:
        self._asked.clear()
        for handle, chart in zip(self._charts, self._run().charts, strict=True):
            handle.data = _data(chart)


def _introduction(example: Example) -> str:
    return (
        f'{formula.STYLE}<p class="mlt">{escape(example.text)}</p>'
        f'<p class="mlt formula">{formula.as_html(example.formula)}</p>'
        f'<p class="mlt source">{escape(example.source)}</p>'
    )


def _data(chart: Chart) -> tuple[Any, ...]:
    return (chart.x.astype(float), *(curve.y.astype(float) for curve in chart.curves))


def _uplot(chart: Chart) -> dict[str, Any]:
    """The arguments of a chart of uPlot."""
    series: list[dict[str, Any]] = [{"label": "x"}]
    for i, curve in enumerate(chart.curves):
        one = {"label": curve.name, "stroke": STROKES[i % len(STROKES)], "width": 1.5}
        if curve.dots:
            one |= {"width": 0, "points": {"show": True, "size": 6 if len(chart.x) < 100 else 3}}
        else:
            one["points"] = {"show": False}
        series.append(one)
    axis = {"stroke": INK, "grid": {"stroke": "rgba(128, 128, 128, 0.25)", "width": 1}}
    scales: dict[str, Any] = {"x": {"time": False}}
    if chart.span is not None:
        scales["y"] = {"range": chart.span}
    return {
        "data": _data(chart),
        "series": tuple(series),
        "title": chart.title,
        "scales": scales,
        "axes": (axis, axis),
        "aspect": 1.4,
        "padding": (10, 10, 0, 0),
    }
