"""Tables, JSON, pictures and pages of races: what a race on one scene and one on several share."""

from __future__ import annotations

import json
import os
import sys
from collections.abc import Sequence
from html import escape
from typing import TYPE_CHECKING, Any

from ... import _core
from ..._extras import import_extra
from ...pictures.tonemapping import Exposure
from .table import notes, summary_table, table

if TYPE_CHECKING:
    from matplotlib.figure import Figure

    from ..result import Outcome


class Report:
    """Races on one scene or on several, to be read."""

    def _races(self) -> Sequence[Outcome]:
        raise NotImplementedError

    def table(self) -> str:
        """Errors with their standard errors, as text.

        For each algorithm: relMSE (see `compare`), and how many times the smallest one it is; its
        median over the seeds; trimmed of the worst 0.1 % of the pixels; what half of the pixels and
        nine of ten do not exceed; of the shape alone; the level and its spread over the seeds;
        sparks; HDR-FLIP; CPU seconds and samples per pixel of an image.
        """
        parts = [
            "\n".join([table(result), *(f"- {note}" for note in notes(result))])
            for result in self._races()
        ]
        if len(self._races()) > 1:
            parts.append(summary_table(self._races()))
        return "\n\n".join(parts)

    def __str__(self) -> str:
        return self.table()

    def to_dict(self) -> dict[str, Any]:
        """All numbers, as `save_json` writes them."""
        from .numbers import numbers

        return numbers(self._races())

    def save_json(self, path: str | os.PathLike[str]) -> None:
        """Write settings and numbers, without images. Raises FileError."""
        text = json.dumps(self.to_dict(), indent=1, allow_nan=False)
        _core.replace_file(os.fspath(path), (text + "\n").encode())

    def html(self, *, exposure: Exposure = "auto", tonemap: str = "srgb") -> str:
        """A page of its own, with everything in it: tables, plots, pictures.

        exposure, tonemap
            how images are shown, as `write_image` has them; "auto" suits the scene.

        Needs the extra `plots`.
        """
        from .page import page

        return page(self._races(), exposure, tonemap)

    def save_html(
        self,
        path: str | os.PathLike[str],
        *,
        exposure: Exposure = "auto",
        tonemap: str = "srgb",
    ) -> None:
        """Write the page that `html` makes. Raises FileError, and UsageError for a wrong curve."""
        page = self.html(exposure=exposure, tonemap=tonemap)
        _core.replace_file(os.fspath(path), page.encode())

    def figure(self, *, exposure: Exposure = "auto", tonemap: str = "srgb") -> Figure:
        """The images beside each other with their insets, as a figure of matplotlib.

        Arguments as for `html`. Needs the extra `plots`.
        """
        from .figure import draw

        return draw(self._races(), exposure, tonemap)

    def show(self) -> None:
        """The page in a notebook, the table anywhere else."""
        if "ipykernel" in sys.modules:
            import_extra("IPython.display", "notebook", "showing a race").display(self)
        else:
            print(self.table())

    def _repr_html_(self) -> str:
        return (
            f'<iframe srcdoc="{escape(self.html())}" '
            'style="width: 100%; height: 50rem; border: 0"></iframe>'
        )
