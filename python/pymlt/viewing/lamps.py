"""Sliders that dim and colour the lamps of a render, without rendering anew."""

from __future__ import annotations

from typing import Any

from ..pictures.mixing import PREFIX
from ..pictures.tonemapping import decode_srgb
from ..rendering.job import Job

Factors = dict[str, tuple[float, float, float]]
WHITE = (255, 255, 255)


class Lamps:
    """A folder with the brightness and the colour of each lamp; empty until one asks for it."""

    def __init__(self, session: Any):
        self._session, self._gui = session, session.client.gui
        self._fields: dict[str, tuple[Any, Any]] = {}
        self._folder = self._gui.add_folder("Lamps", expand_by_default=False)
        with self._folder:
            hint = "keeps the light of each lamp, which takes longer and more memory"
            self._asked = self._gui.add_checkbox("Light of each lamp", False, hint=hint)
        self._asked.on_update(lambda _: session.post(session.restart))

    @property
    def asked(self) -> bool:
        return bool(self._asked.value)

    def follow(self, jobs: list[Job]) -> None:
        """Shows the sliders of the lamps that the first render has; those that stay keep theirs."""
        names = jobs[0].light_groups if self.asked and jobs else []
        for name in self._fields.keys() - set(names):
            for field in self._fields.pop(name):
                field.remove()
        with self._folder:
            for name in names:
                if name not in self._fields:
                    self._fields[name] = self._made(name.removeprefix(PREFIX))

    def _made(self, label: str) -> tuple[Any, Any]:
        stops = self._gui.add_slider(label, -8.0, 8.0, 0.25, 0.0, hint="in stops; -8 is off")
        colour = self._gui.add_rgb(f"Colour of {label}", WHITE)
        for field in (stops, colour):
            field.on_update(lambda _: self._session.post(self._session.renew))
        return stops, colour

    def factors(self) -> Factors:
        """By what the light of each lamp is multiplied, for red, green and blue."""
        found: Factors = {}
        for name, (stops, colour) in self._fields.items():
            brightness = 2.0**stops.value if stops.value > -8 else 0.0
            r, g, b = (brightness * float(decode_srgb(c / 255)) for c in colour.value)
            found[name] = (r, g, b)
        return found
