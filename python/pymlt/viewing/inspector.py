"""The second page of the panel: the light paths through a pixel, and a chain that walks."""

from __future__ import annotations

import time
from typing import Any

from .. import _core
from . import path_tables, walk
from .page import table
from .pixel_paths import PixelPaths, brightness, paths_through
from .world import Lines, Meshes

EVERY, NONE = "all", "none"
DRAWN = 60  #: paths of a pixel that are listed
THIN = 24  #: of them that are drawn, since more hide the picture
ACCEPTED, REJECTED = (70, 220, 110), (240, 70, 70)


class Inspector:
    """Of a session, within the container that is open."""

    def __init__(self, session: Any):
        self._session = session
        self.pixel: tuple[int, int] | None = None  #: the one that is marked in the picture
        self._found: PixelPaths | None = None
        self._drawn: list[_core.LightPath] = []
        self._path: _core.LightPath | None = None
        self._walk: walk.Walk | None = None
        self._next_step: float | None = None  # if the chain walks by itself
        self._meshes = Meshes(session.camera.scene(None), session.client.scene)
        self._lines = Lines(session.client.scene, session.client.camera, session.camera.radius)
        gui = session.client.gui
        with gui.add_form("Paths through a pixel") as form:
            gui.add_html('<p class="mlt">Click into the picture, or:</p>')
            self._pixel = gui.add_text("Pixel x, y", "")
            self._samples = gui.add_text("Samples", "64")
            self._depth = gui.add_text("Longest path", "8", hint="in edges")
            find = gui.add_button("Find its paths")
        self._kind = gui.add_dropdown("Signature", [EVERY, NONE], hint="which paths are drawn")
        self._list = gui.add_dropdown("Path", ["none yet"])
        self._shown = gui.add_checkbox("Shapes in 3D", False, hint="to turn the paths among them")
        self._opacity = gui.add_slider("Opacity", 0.05, 1.0, 0.05, 0.4, visible=False)
        with gui.add_folder("By signature"):
            self._signatures = gui.add_html("")
        with gui.add_folder("The path"):
            self._text = gui.add_html("")
        with gui.add_folder("Techniques: percent of the pixel's light", expand_by_default=False):
            self._strategies = gui.add_html("")
        self._add_chain(gui)
        post = session.post
        form.on_submit(lambda _: post(self._typed))
        find.on_click(lambda _: form.submit())
        self._kind.on_update(lambda _: post(self._draw))
        self._list.on_update(lambda _: post(self._choose))
        self._shown.on_update(lambda _: post(self._toggle))
        self._opacity.on_update(lambda _: post(self._toggle))

    def _add_chain(self, gui: Any) -> None:
        with gui.add_folder("Metropolis chain"):
            self._mutation = gui.add_dropdown("Mutation", walk.names())
            self._speed = gui.add_slider("Steps a second", 1, 20, 1, 4)
            buttons = gui.add_button_group("", ["Start here", "Step", "Run", "Pause"])
            stuck = gui.add_button("The chain that was stuck longest", hint="in the render of mlt")
            self._chain = gui.add_html("")
        post = self._session.post
        buttons.on_click(lambda event: post(lambda: self._press(event.target.value)))
        stuck.on_click(lambda _: post(self._open_stuck))

    # ---- what the session asks

    @property
    def shows_meshes(self) -> bool:
        """Whether the page shows shapes in place of the picture."""
        return bool(self._shown.value)

    def show_paths(self, visible: bool) -> None:
        """Paths are drawn while their tab is open."""
        self._lines.show(visible)

    def camera_moved(self) -> None:
        """Other labels may lie close together now."""
        self._lines.labels.renew()

    def pause(self) -> float | None:
        """Seconds to the next step of a chain that walks by itself."""
        return None if self._next_step is None else max(0.0, self._next_step - time.monotonic())

    def walk_on(self) -> None:
        """That step, if it is time."""
        if self.pause() == 0:
            self._next_step = time.monotonic() + 1 / float(self._speed.value)
            self.step()

    def inspect(self, pixel: tuple[int, int], signature: str = "") -> None:
        """Find the paths through a pixel and show the brightest, of that signature if there is."""
        if self.shows_meshes and not signature and self._found:
            return  # a click among meshes is no click on the picture
        x, y = pixel
        scene = self._session.scene()
        if not (0 <= x < scene.width and 0 <= y < scene.height):
            raise _core.UsageError(
                f"pixel ({x}, {y}) is beside the image, which is {scene.width} x {scene.height}"
            )
        samples, depth = self._whole(self._samples, 1, 4096), self._whole(self._depth, 1, 64)
        self._pixel.value, self.pixel = f"{x}, {y}", pixel
        self._session.renew()
        self._found = paths_through(scene, pixel, samples, depth)
        self._session.mended(self._typed)
        self._show_found(signature)

    def step(self) -> None:
        """One step of the chain."""
        if self._walk is None:
            self._start_chain()
        assert self._walk is not None
        step = self._walk.step(self._mutation.value)
        self._draw_step(step)
        rows = [["mutation", "chosen", "found", "accepted"]]
        rows += [[name, *map(str, counts)] for name, counts in self._walk.counts.items()]
        said = f"{step.mutation or 'no mutation suits'}: {step.outcome}"
        if step.proposal is not None:
            said += f", {step.proposal.signature}, a = {step.acceptance:.3g}"
        self._chain.content = (
            f'<p class="mlt" data-steps="{self._walk.steps}">Step {self._walk.steps}. {said}</p>'
            + path_tables.place_table(self._walk.path)
            + table(rows, head=True)
        )

    # ---- what the page asks

    def _whole(self, field: Any, low: int, high: int) -> int:
        try:
            value = int(field.value)
        except ValueError:
            value = low - 1
        if not low <= value <= high:
            raise _core.UsageError(
                f"{field.label} is {field.value!r}, but should be a whole number from {low} to "
                f"{high}"
            )
        return value

    def _typed(self) -> None:
        try:
            x, y = map(int, self._pixel.value.replace(" ", ",").replace(",,", ",").split(","))
        except ValueError:
            raise _core.UsageError(
                f"Pixel is {self._pixel.value!r}, but should be two whole numbers: x, y"
            ) from None
        self._found = None
        self.inspect((x, y))

    def _show_found(self, signature: str) -> None:
        found = self._found
        assert found is not None
        self._signatures.content = path_tables.signature_table(found)
        self._strategies.content = path_tables.strategy_table(found)
        options = [EVERY, *found.signatures(), NONE]
        if tuple(options) != tuple(self._kind.options):
            self._kind.options, self._kind.value = options, EVERY
        drawn = self._drawn = found.some(DRAWN)
        self._draw()
        if not drawn:
            self._list.options, self._text.content, self._path = ["none yet"], "", None
            return
        names = [f"{i + 1}: {p.signature}, {brightness(p):.3g}" for i, p in enumerate(drawn)]
        wanted = [n for n, p in zip(names, drawn, strict=True) if p.signature == signature]
        self._list.options = names
        self._list.value = (wanted or names)[0]
        self._choose()

    def _draw(self) -> None:
        """The brightest paths of the signature that is chosen, or of all of them; or none."""
        kind, found = self._kind.value, self._found
        self._lines.clear("all")
        if kind == NONE:
            self._lines.clear("chosen")
        if found is None or kind == NONE:
            return
        drawn = found.some(THIN) if kind == EVERY else found.of(kind)[:THIN]
        colours = path_tables.colours(found)
        last = drawn[::-1]  # the most important lie on top
        self._lines.draw_tubes("all", last, [colours[path.signature] for path in last])
        if self._path is not None:
            self._draw_chosen(self._path)

    def _draw_chosen(self, path: _core.LightPath) -> None:
        self._lines.draw_one("chosen", path, path_tables.colour(path))

    def _choose(self) -> None:
        number = self._list.value.split(":")[0]
        if not self._drawn or not number.isdigit():
            return
        self._path = self._drawn[min(int(number), len(self._drawn)) - 1]
        if self._kind.value != NONE:
            self._draw_chosen(self._path)
        self._text.content = path_tables.path_text(self._path)

    def _toggle(self) -> None:
        shows = self.shows_meshes
        self._opacity.visible = shows
        self._meshes.show(shows, float(self._opacity.value))
        if shows:
            self._session.client.scene.set_background_image(None)
        else:
            self._session.return_to_picture()

    # ---- the chain

    def _start_chain(self) -> None:
        if self._path is None:
            raise _core.UsageError("choose a path first: click into the picture")
        depth = self._whole(self._depth, 1, 64)
        self._walk = walk.Walk(self._path.scene, self._path, depth)
        self._chain.content = path_tables.place_table(self._walk.path)
        self._lines.clear("all")
        self._lines.clear("proposal")
        self._draw_chosen(self._walk.path)

    def _press(self, button: str) -> None:
        self._next_step = None
        if button == "Start here":
            self._start_chain()
        elif button == "Step":
            self.step()
        elif button == "Run":
            if self._walk is None:
                self._start_chain()
            self._next_step = time.monotonic()

    def _draw_step(self, step: walk.Step) -> None:
        assert self._walk is not None
        self._lines.clear("proposal")
        if step.proposal is not None:
            colour = ACCEPTED if step.accepted else REJECTED
            self._lines.draw("proposal", step.proposal, colour, 2.5)
        self._draw_chosen(self._walk.path)
        self._session.client.flush()

    def _open_stuck(self) -> None:
        """The pixel and the signature at which a chain of the render was rejected most often."""
        for job in self._session.live.jobs:
            stuck = job.stats.get("stuck") or []
            if stuck and stuck[0]["rejections"]:
                at = stuck[0]
                width, height = self._session.camera.size
                pixel = (
                    min(max(int(at["x"]), 0), width - 1),
                    min(max(int(at["y"]), 0), height - 1),
                )
                self._session.say(
                    f"Rejected {at['rejections']} times in a row",
                    f"chain {at['chain']} at pixel {pixel}, {at['signature']}",
                    color="blue",
                )
                self.inspect(pixel, at["signature"])
                return
        raise _core.UsageError("no chain was stuck: render with mlt, pssmlt or mmlt for a while")
