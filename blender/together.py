"""One render of several frames, whose noise changes as slowly as the picture."""

from dataclasses import replace

import pymlt as mlt
from pymlt.algorithms.integrator import as_integrator
from pymlt.rendering.first_seen import first_seen
from pymlt.rendering.frames import Timing, scene_at
from pymlt.rendering.options import RenderOptions
from pymlt.rendering.windows import WindowRender, frames_together, whole

from . import glow, passes
from .export import OPEN, Joined
from .settings import threads

TIMING = Timing(fps=1, shutter=OPEN)


def most_frames(scene, sensor: dict) -> int:
    """How many frames one render can have with the settings of Blender's scene."""
    view = mlt.load_dict({"type": "scene", "camera": sensor})
    integrator = as_integrator(view, scene.pymlt.chosen_integrator())
    return frames_together(view, integrator, RenderOptions(), None)


class Together:
    """The render of frames that differ in nothing but where things are."""

    def __init__(self, joined: Joined, frames: list[int], scene):
        self.frames = frames
        self.has_begun = False
        self._joined, self._described = joined, joined.scene(len(frames))
        self._settings = scene.pymlt
        self._transparent = scene.render.film_transparent
        self._how = {"seed": scene.pymlt.seed, "threads": threads(scene)}
        self._world = mlt.load_dict(self._described)
        chosen = scene.pymlt.chosen_integrator(transparent=self._transparent)
        self._window = WindowRender(
            self._world,
            lambda seen: as_integrator(seen, chosen),
            TIMING,
            whole(list(range(len(frames)))),
        )

    def start(self) -> mlt.Job:
        budget = self._settings.budget()
        if budget.pop("error") and not any(budget.values()):
            raise mlt.UsageError(
                "frames that are rendered together end by Time or Samples, not by Error; set one"
            )
        self.has_begun = True
        return self._window.start(RenderOptions(**budget, **self._how))

    def shows(self, frame: int, described: dict) -> bool:
        """Whether it renders a frame as it is when Blender has come to it."""
        return self._joined.shows(self.frames.index(frame), described)

    def picture(self, found: mlt.Result) -> mlt.Result:
        """The first frame of what the render has found so far, which later results are made of."""
        self._window.whole = found
        return self._window.result(0)

    def result(self, frame: int) -> mlt.Result:
        """The picture of a frame with its passes, as if it had been rendered alone."""
        place = self.frames.index(frame)
        found = self._window.result(place)
        found.layers |= self._first_seen(place)
        if self._settings.denoise:
            found = found.denoise()
        if not self._transparent:
            return found
        seed = self._settings.seed
        glowing = glow.seen_directly(self._described, seed, lambda world: moment(world, place))
        return replace(found, image=found.image + glowing)

    def _first_seen(self, place: int) -> dict:
        """The layers of what the camera sees first."""
        hidden = self._transparent
        options = {"aovs": passes.AOVS, "alpha": hidden, "hide_emitters": hidden}
        layers = first_seen(moment(self._world, place), **options, **self._how)
        return {name: layers[name] for name in passes.SEEN_FIRST if name in layers}


def moment(world: mlt.Scene, place: int) -> mlt.Scene:
    """One frame of a scene that has several."""
    return scene_at(world, TIMING, [place])
