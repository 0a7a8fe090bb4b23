"""The axes of the charts of a race."""

import re
import xml.etree.ElementTree as ElementTree
from base64 import b64decode

import pytest

pytest.importorskip("matplotlib", reason="needs matplotlib")

from pymlt.race.report.chart import Series, embedded, error_chart, level_chart


@pytest.mark.parametrize("scale", [1, 1e-4, 1e-9, 1e7])
def test_each_tick_of_an_error_is_where_it_says(scale):
    points = [(0.5, 3.0 * scale, 0.1 * scale), (1, 1.1 * scale, None), (2, 0.4 * scale, scale)]
    figure = error_chart([Series(0, points), Series(11, [(1, 0.0, None), (2, scale, None)])])
    figure.draw_without_rendering()
    (axes,) = figure.axes
    for axis in axes.xaxis, axes.yaxis:
        texts = [(label.get_text(), place) for label, place in
                 zip(axis.get_ticklabels(), axis.get_ticklocs(), strict=True)]  # fmt: skip
        low, high = axis.get_view_interval()
        assert sum(low <= place <= high for _, place in texts) >= 2
        for text, place in texts:
            assert float(text.replace("−", "-")) == pytest.approx(place)


def test_errors_that_are_not_known_make_no_chart():
    assert error_chart([Series(0, [(1, 0.0, None)])]) is None


def test_all_levels_lie_within_the_axis():
    levels = [(0, 0.9, None), (1, 1.3, None), (0.0, 1.1, 0.1)]
    figure = level_chart(
        [Series(0, levels), Series(1, [(0, 1.0, None), (0.0, 1.0, None)])], "level"
    )
    low, high = figure.axes[0].get_xlim()
    assert low < 0.9 < 1.3 < high
    assert low + high == pytest.approx(2)


def test_a_chart_is_an_image_in_the_page_and_always_the_same():
    pages = [embedded(error_chart([Series(0, [(1, 0.5, None)])]), "a < b") for _ in range(2)]
    assert pages[0] == pages[1]
    assert "<figcaption>a &lt; b</figcaption>" in pages[0]
    picture = b64decode(re.search(r"svg\+xml;base64,([^\"]+)", pages[0])[1])
    assert ElementTree.fromstring(picture).tag.endswith("svg")
