"""The first page of the panel: what is rendered, and how it is shown."""

from __future__ import annotations

import time
from html import escape
from typing import Any
from weakref import WeakKeyDictionary

from .. import _core
from ..algorithms.integrators import integrator_schema
from ..pictures.output import OutputFile
from ..pictures.tonemapping import CURVES, stops_of
from ..rendering.job import Job
from ..rendering.summary import percent
from . import shown
from .lamps import Lamps
from .live import Algorithm
from .page import STYLE, table

NONE = "none"
SECONDS = 600
KEYS = (
    ("drag, arrows", "walk around the point one looks at"),
    ("right button", "move sideways"),
    ("wheel", "come nearer"),
    ("W, S", "forward, back"),
    ("A, D", "left, right"),
    ("Q, E", "down, up"),
    ("click", "light paths through the pixel"),
)


class Controls:
    """Of a session, within the container that is open."""

    def __init__(self, session: Any, algorithm: Algorithm):
        self._session, gui = session, session.client.gui
        self._began = time.monotonic()
        self._errors = ErrorFigures()
        names = sorted(_core.names("integrator"))
        self._status = gui.add_html(STYLE)
        with gui.add_form("What is rendered") as form:
            self._name = gui.add_dropdown("Integrator", names, initial_value=algorithm.name)
            hint = "NAME=VALUE, ...; press Enter. The table below names them all."
            self._parameters = gui.add_text("Parameters", algorithm.parameters, hint=hint)
            self._about = gui.add_html("")
            self._other = gui.add_dropdown("Compare with", [NONE, *names], initial_value=NONE)
            self._others = gui.add_text("Its parameters", "", hint=hint, visible=False)
            self._seconds = gui.add_text("Seconds", str(SECONDS), hint="The render ends then.")
            apply = gui.add_button("Render")
        self._share = gui.add_slider("Left / right", 0, 100, 1, 50, visible=False)
        self._buttons = gui.add_button_group("", ["Stop", "Resume", "Scene's view"])
        with gui.add_folder("How it is shown"):
            self._exposure = gui.add_slider("Exposure", -8.0, 8.0, 0.25, 0.0, hint="in stops")
            fit = gui.add_button("Fit exposure", hint="to the picture as it is now")
            self._curve = gui.add_dropdown("Tone curve", list(CURVES))
            self._denoise = gui.add_checkbox(
                "Denoise", False, hint="the picture, not what is saved"
            )
            self._layer = gui.add_dropdown("Layer", list(shown.LAYERS))
        self.lamps = Lamps(session)
        self._save = gui.add_button_group("Save as", ["EXR", "PNG", "JPEG"])
        with gui.add_folder("Mouse and keys", expand_by_default=False):
            gui.add_html(table(KEYS))
        with gui.add_folder("Parameters of the integrator", expand_by_default=False):
            self._help = gui.add_html("")
        self._explain()
        self._connect(form, apply)
        fit.on_click(lambda _: session.post(self._fit_exposure))

    def _connect(self, form: Any, apply: Any) -> None:
        post = self._session.post
        form.on_submit(lambda _: post(self._session.restart))
        apply.on_click(lambda _: form.submit())
        self._name.on_update(lambda _: post(self._chosen))
        self._other.on_update(lambda _: post(self._chosen))
        self._buttons.on_click(lambda event: post(lambda: self._press(event.target.value)))
        self._save.on_click(lambda event: post(lambda: self._download(event.target.value)))
        for field in (self._exposure, self._curve, self._denoise, self._layer, self._share):
            field.on_update(lambda _: post(self._session.renew))

    # ---- what the session asks

    def algorithms(self) -> list[Algorithm]:
        """Raises UsageError, sooner or later, for what makes no sense."""
        self._began = time.monotonic()
        chosen = [Algorithm(self._name.value, self._parameters.value)]
        if self._other.value != NONE:
            chosen.append(Algorithm(self._other.value, self._others.value))
        return chosen

    def seconds(self) -> float:
        """Raises UsageError."""
        try:
            seconds = float(self._seconds.value)
        except ValueError:
            seconds = 0.0
        if not 0 < seconds < 1e9:
            raise _core.UsageError(
                f"Seconds is {self._seconds.value!r}, but should be a number above 0"
            )
        return seconds

    def look(self) -> shown.Look:
        exposure, clean = float(self._exposure.value), bool(self._denoise.value)
        lamps = self.lamps.factors()
        return shown.Look(self._layer.value, exposure, self._curve.value, clean, lamps)

    def share(self) -> float | None:
        """Of the width that the first of two renders has; None for one."""
        return self._share.value / 100 if self._other.value != NONE else None

    def show_status(self) -> None:
        live, clean = self._session.live, bool(self._denoise.value)
        self.lamps.follow(live.jobs)
        rows = [
            [escape(name), f"{job.samples:.4g} spp", self._errors.figure(job, clean)]
            for name, job in zip(self._names(), live.jobs, strict=False)
        ] or [["first pictures", "", ""]]
        state = "running" if live.running else "ended"
        width, height = self._session.camera.size
        text = f"{width} x {height}, {state}, {time.monotonic() - self._began:.0f} s"
        said = [] if live.running else [w for job in live.jobs for w in job.stats["warnings"]]
        rows += [["note", escape(warning), ""] for warning in said]
        self._status.content = (
            STYLE + f'<p class="mlt" data-state="{state}">{text}</p>' + table(rows)
        )

    def _names(self) -> list[str]:
        return [self._name.value, self._other.value]

    # ---- what the page asks

    def _chosen(self) -> None:
        """Another integrator has other parameters."""
        two = self._other.value != NONE
        self._share.visible = self._others.visible = two
        self._explain()
        self._session.restart()

    def _explain(self) -> None:
        schema = integrator_schema(self._name.value)
        self._about.content = f'<p class="mlt" data-about="1">{escape(schema["doc"])}</p>'
        rows = [["name", "default", "meaning"]]
        for row in schema["parameters"]:
            rows.append([escape(str(row.get(k, ""))) for k in ("name", "default", "doc")])
        self._help.content = table(rows, head=True)

    def _press(self, button: str) -> None:
        live = self._session.live
        if button == "Stop":
            live.stop()
        elif button == "Resume":
            if not live.running and not live.resume(self.seconds()):
                self._session.restart()
        else:
            self._session.camera.place(self._session.client.camera)
        self._session.renew()

    def _first_job(self) -> Any:
        """Raises UsageError if it has no sample yet."""
        jobs = self._session.live.jobs
        if not jobs or jobs[0].samples == 0:
            raise _core.UsageError("there is no picture yet")
        return jobs[0]

    def _fit_exposure(self) -> None:
        stops = stops_of("auto", self._first_job().image)
        self._exposure.value = min(max(round(4 * stops) / 4, -8.0), 8.0)
        self._session.renew()

    def _download(self, kind: str) -> None:
        """Through the browser: the page writes no file on the machine that renders."""
        import tempfile
        from pathlib import Path

        result, look = self._first_job().snapshot(), self.look()
        name = f"{result.integrator['type']}.{kind.lower()}"
        with tempfile.TemporaryDirectory() as folder:
            path = Path(folder) / name
            OutputFile(
                str(path),
                result.image,
                result.layers,
                result.metadata,
                result.half,
                look.exposure,
                look.curve,
            ).write()
            self._session.client.send_file_download(name, path.read_bytes())


class ErrorFigures:
    """The relative errors of renders, estimated again when they have grown by a fifth."""

    def __init__(self) -> None:
        self._known: WeakKeyDictionary[Job, tuple[float, str]] = WeakKeyDictionary()

    def figure(self, job: Job, denoised: bool) -> str:
        """The error with its unit, of what is seen; "" before it is known."""
        if denoised:
            return self._text(job.denoised_error)
        samples, text = self._known.get(job, (0.0, ""))
        if job.samples > 1.2 * samples:
            text = self._text(job.error)
            self._known[job] = job.samples, text
        return text

    @staticmethod
    def _text(error: float | None) -> str:
        return f"\N{PLUS-MINUS SIGN} {percent(error)}" if error else ""
