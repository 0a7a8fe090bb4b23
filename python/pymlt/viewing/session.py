"""A tab of the browser with a scene: its camera, its render, its controls."""

from __future__ import annotations

import os
import threading
import time
from typing import Any

from .. import _core
from . import shown
from .browser import follow_tab, open_tab, set_title
from .camera import Pose, SceneCamera
from .controls import Controls
from .frame import Frame
from .inspector import Inspector
from .lecture import Lecture
from .live import Algorithm, LiveRender
from .pictures import Pictures
from .worker import Worker

# A picture costs CPU time that the render does not get. Between two pictures there are at least
# INTERVAL seconds, and pictures take at most this SHARE of what the processors have.
INTERVAL = 0.3
SHARE = 0.015


class Session(Worker):
    """Such a tab. Its render belongs to its thread."""

    def __init__(self, camera: SceneCamera, client: Any, algorithm: Algorithm, threads: int):
        super().__init__(client)
        self.camera = camera
        self.pose: Pose | None = None  #: of the camera; None is the scene's own
        self.live = LiveRender(threads)
        self.pictures = Pictures(self)
        self._moved = threading.Event()
        self._due, self._final = 0.0, False
        self._canvas = 0.0
        self.post(self.restart)
        set_title(client, "pymlt")
        tabs = client.gui.add_tab_group()
        with tabs.add_tab("Render"):
            self.controls = Controls(self, algorithm)
        with tabs.add_tab("Paths"):
            self.inspector = Inspector(self)
        with tabs.add_tab("Lecture"):
            self.lecture = Lecture(self)
        show = self.inspector.show_paths
        follow_tab(client, "Paths", lambda is_open: self.post(lambda: show(is_open)))
        follow_tab(client, "Lecture", self.lecture.show)
        self._thread.start()
        client.camera.on_update(self._camera_moved)
        client.scene.on_click()(self._clicked)

    # ---- from other threads

    def _camera_moved(self, _: Any) -> None:
        if not self._moved.is_set():
            self._moved.set()
            self.post(self._follow)

    def _clicked(self, event: Any) -> None:
        place = self.frame().place(*event.screen_pos)
        if place is not None:
            self.post(lambda: self._inspect(self.camera.pixel(place)))

    def _inspect(self, pixel: tuple[int, int]) -> None:
        if not self.inspector.shows_meshes:
            open_tab(self.client, "Paths")
        self.inspector.inspect(pixel)

    # ---- the session's thread

    def _run(self) -> None:
        try:
            while self._take(self._pause()):
                if self.live.is_early:
                    if self.live.advance(0.02):
                        self._show()
                elif self._is_due():
                    self._show()
                self._try(self.inspector.walk_on)
        finally:
            self.live.discard()

    def _pause(self) -> float | None:
        if self.live.is_early:
            return 0.0
        pauses = [self.inspector.pause()]
        if not self._final:
            pauses.append(max(0.05, min(0.5, self._due - time.monotonic())))
        return min((pause for pause in pauses if pause is not None), default=None)

    def frame(self) -> Frame:
        """Where the image lies in the window."""
        return self.camera.frame(self._aspect())

    def _aspect(self) -> float:
        """Of the window, which may have no height for a moment."""
        camera = self.client.camera
        return camera.image_width / camera.image_height if camera.image_height else 1.0

    def _follow(self) -> None:
        """The camera has moved, or the window has another shape."""
        self._moved.clear()
        camera = self.client.camera
        fov = self.frame().fov(self.camera.fov)
        if abs(camera.fov - fov) > 1e-4:
            camera.fov = fov
        if self._canvas != self._aspect():
            self._canvas = self._aspect()
            self.renew()
        self.inspector.camera_moved()
        pose: Pose | None = Pose.of(camera)
        if pose.is_near(self.camera.pose, self.camera.radius):
            pose = None
        same = pose == self.pose or (
            pose and self.pose and pose.is_near(self.pose, self.camera.radius)
        )
        if not same and not self.inspector.shows_meshes:
            self.pose = pose
            self.inspector.pixel = None  # it shows something else now
            self.restart()

    def scene(self, divisor: int = 1) -> _core.Scene:
        """The scene as the camera of the tab sees it."""
        return self.camera.scene(self.pose, divisor)

    def restart(self) -> None:
        """Render anew, since something has changed; if that fails, the old render goes on."""
        self._try(self._restart)

    def _restart(self) -> None:
        controls = self.controls
        self.live.start(
            self.scene, controls.algorithms(), controls.seconds(), lamps=controls.lamps.asked
        )
        self.pictures.forget()
        self.renew()

    def return_to_picture(self) -> None:
        """After the page has shown shapes: the picture from where the camera is now."""
        self.renew()
        self._follow()

    def renew(self) -> None:
        """Show a picture soon."""
        self._due, self._final = 0.0, False

    def _is_due(self) -> bool:
        if self._final or time.monotonic() < self._due:
            return False
        return self.live.image() is not None or not self.live.running

    def _show(self) -> None:
        ended = not self.live.running
        spent = time.thread_time()
        self._try(self.live.check, cure=self._restart)
        self._try(self._send)
        spent = time.thread_time() - spent
        self._due = time.monotonic() + max(INTERVAL, spent / (SHARE * (os.cpu_count() or 1)))
        self._final = ended
        if self.live.is_early:
            self._due = 0.0

    def _send(self) -> None:
        self.controls.show_status()
        if self.inspector.shows_meshes:
            return
        picture = self.pictures.make(self.controls.look(), self.controls.share())
        if picture is not None:
            frame = self.frame()
            if self.inspector.pixel is not None:
                scale = len(picture) / max(self.client.camera.image_height * frame.height, 1)
                picture = shown.marked(picture, self.inspector.pixel, scale)
            self.client.scene.set_background_image(frame.fill(picture), format="jpeg")
            self.client.flush()
