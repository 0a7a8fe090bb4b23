"""`mlt.view`: a page with a scene that renders."""

from __future__ import annotations

import secrets
import threading
import warnings
from collections.abc import Callable
from html import escape
from typing import Any

from .. import _core
from .._extras import import_extra
from ..formats.loading import SceneLike, as_scene
from .camera import SceneCamera
from .gate import Gate, is_local
from .lecture import LectureTab
from .live import Algorithm
from .session import Session
from .worker import Worker

PORT = 8090


def view(
    scene: SceneLike | None = None,
    integrator: str | None = None,
    *,
    parameters: str = "",
    sensor: int | None = None,
    host: str = "localhost",
    port: int = PORT,
    token: str | None = None,
    threads: int = 0,
) -> View:
    """Show a scene in the browser while it renders; in a notebook, inline.

    scene, sensor
        as for `start`. Without a scene the page has the lecture's examples alone.
    integrator, parameters
        the name of the one to begin with, None is the scene's own, else `mlt`; and its parameters,
        such as "max_depth=8, p_large=0.3".
    host, port
        where the page is served; if the port is taken, at the next one that is free. Other hosts
        than this machine need a `token`, the word without which nobody gets in.
    threads
        of each tab's render; 0: as many as there are.

    Returns at once; the page is there until `View.stop`, or the end of the program. Raises
    UsageError without the extra `view`, for a host without a token, for what needs a scene without
    one, or if no port is free.
    """
    viser = import_extra("viser", "view", "the live view")
    if not is_local(host) and token is None:
        raise _core.UsageError(
            f"{host} can be reached from other machines: give a token too, the word that opens "
            "the page"
        )
    if scene is None:
        if integrator or parameters or sensor is not None or threads:
            raise _core.UsageError(
                "integrator, parameters, sensor and threads are those of a render: give a scene too"
            )
        return View(viser, LectureTab, None, host, port, token)
    loaded = as_scene(scene, sensor)
    name = integrator or loaded.info()["integrator"] or "mlt"
    algorithm = Algorithm(name, parameters)
    algorithm.make(loaded)
    camera = SceneCamera(loaded, sensor or 0)

    def make(client: Any) -> Session:
        return Session(camera, client, algorithm, threads)

    return View(viser, make, camera, host, port, token)


def new_token() -> str:
    """A word that nobody guesses."""
    return secrets.token_urlsafe(16)


class View:
    """A page that is being served; see `view`."""

    def __init__(
        self,
        viser: Any,
        make: Callable[[Any], Worker],
        camera: SceneCamera | None,
        host: str,
        port: int,
        token: str | None,
    ):
        from .server import start_viser

        # A tab may be closed while a picture is made for it; viser says so each time.
        warnings.filterwarnings("ignore", "Queued a .* on a closed connection", UserWarning)
        self._sessions: dict[int, Worker] = {}
        self._lock = threading.Lock()
        self._make = make
        self._gate = Gate(host, port, token)
        try:
            self._server = start_viser(viser, self._gate)
        except BaseException:
            self._gate.socket.close()
            raise
        self._token = token
        self.port: int = self._gate.port
        self._server.gui.configure_theme(
            show_logo=False, show_share_button=False, control_width="large", dark_mode=True
        )
        self._server.gui.main_panel.dock_right()
        if camera is not None:
            camera.place_first(self._server.initial_camera)
        self._server.on_client_connect(self._connect)
        self._server.on_client_disconnect(self._disconnect)

    @property
    def url(self) -> str:
        """What to open in a browser."""
        host = f"[{self._gate.host}]" if ":" in self._gate.host else self._gate.host
        return f"http://{host}:{self.port}/" + (f"?token={self._token}" if self._token else "")

    @property
    def sessions(self) -> list[Worker]:
        """The tabs that are open."""
        with self._lock:
            return list(self._sessions.values())

    def stop(self) -> None:
        """End all renders and take the page away."""
        from .server import stop_viser

        sessions = self.sessions
        for session in sessions:
            session.close()
        stop_viser(self._server)
        for session in sessions:
            session.wait(5)
        with self._lock:
            self._sessions.clear()

    def _connect(self, client: Any) -> None:
        session = self._make(client)
        with self._lock:
            self._sessions[client.client_id] = session
        if client.client_id not in self._server.get_clients():  # it has been closed meanwhile
            self._disconnect(client)

    def _disconnect(self, client: Any) -> None:
        with self._lock:
            session = self._sessions.pop(client.client_id, None)
        if session is not None:
            session.close()

    def __enter__(self) -> View:
        return self

    def __exit__(self, *_: object) -> None:
        self.stop()

    def _repr_html_(self) -> str:
        return (
            f'<iframe src="{escape(self.url)}" style="width: 100%; height: 640px; border: 0">'
            "</iframe>"
        )

    def __repr__(self) -> str:
        return f"View({self.url!r}, {len(self.sessions)} tabs)"
