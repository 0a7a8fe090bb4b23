"""Formulas of the lecture as HTML, from text such as `a = min(1, {f(y)}/{f(x)})`."""

from __future__ import annotations

import re
from html import escape

STYLE = """<style>
.formula { font: 17px/1.8 "STIX Two Text", "Cambria Math", "Times New Roman", serif; }
.formula sub, .formula sup { font-size: 12px; line-height: 0; }
.formula .over { display: inline-flex; flex-direction: column; vertical-align: middle;
  text-align: center; line-height: 1.35; margin: 2px 3px; }
.formula .over > :first-child { border-bottom: 1px solid; }
.source { opacity: .7; }
.old { opacity: .4; }
</style>"""


def as_html(formula: str) -> str:
    """Single letters become italic, _{i} and ^{i} indices and exponents, {a}/{b} a fraction."""
    text = re.sub(r"([α-ω]|(?<![A-Za-z])[A-Za-zÎ](?![A-Za-z]))", r"<i>\1</i>", escape(formula))
    text = re.sub(r"_\{([^{}]*)\}", r"<sub>\1</sub>", text)
    text = re.sub(r"\^\{([^{}]*)\}", r"<sup>\1</sup>", text)
    fraction = r'<span class="over"><span>\1</span><span>\2</span></span>'
    text = re.sub(r"\{([^{}]*)\}/\{([^{}]*)\}", fraction, text)
    return text.replace("\n", "<br>")
