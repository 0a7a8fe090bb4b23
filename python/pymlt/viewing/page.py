"""Tables of the panel, as HTML that is readable on a narrow screen."""

from __future__ import annotations

import re
from collections.abc import Iterable, Sequence

STYLE = """<style>
.mlt { font-size: 14px; line-height: 1.45; margin: .4em 12px; overflow-x: auto; }
.mlt table { border-collapse: collapse; width: 100%; }
.mlt td, .mlt th { padding: 2px 6px 2px 0; text-align: left; vertical-align: top; }
.mlt tr + tr td { border-top: 1px solid rgba(128, 128, 128, .25); }
.mlt .n { text-align: right; font-variant-numeric: tabular-nums; white-space: nowrap; }
.mlt b.swatch { display: inline-block; width: .8em; height: .8em; border-radius: 2px; }
.mantine-Slider-root { padding-bottom: .9em !important; }
.mantine-Slider-markLabel { margin-top: 3px; font-size: 11px !important; }
@media (max-width: 576px) {
  div[style*="width: 20em"] { width: 100% !important; max-height: 38% !important; }
  div[style*="width: 20em"] div[style*="width: 20em"] { max-height: none !important; }
  div[style*="inset: 0px"]:has(> canvas) { bottom: 38% !important; }
  label, button, button *, input { font-size: 13px !important; }
}
</style>"""

#: The panel of a tab that has nothing beside it; viser gives its width in the one or the other way.
WIDE = """<style>
div[style*="width: 388px"], div[style*="width: 20em"] { width: 100% !important; }
.mantine-Paper-root[style*="width: 20em"] { height: 100%; max-height: 100% !important; }
.mantine-ScrollArea-content { min-width: 0 !important; width: min(100%, 40em); margin: auto; }
</style>"""


def table(rows: Iterable[Sequence[str]], head: bool = False) -> str:
    """Of cells that are HTML; what looks like a number stands on the right."""
    lines = []
    for i, row in enumerate(rows):
        tag = "th" if head and i == 0 else "td"
        cells = (f"<{tag}{_class(cell)}>{cell}</{tag}>" for cell in row)
        lines.append(f"<tr>{''.join(cells)}</tr>")
    return f'<div class="mlt"><table>{"".join(lines)}</table></div>'


def _class(cell: str) -> str:
    return ' class="n"' if re.fullmatch(r"-?[\d.]+(e[+-]?\d+)?( %| spp)?", cell) else ""
