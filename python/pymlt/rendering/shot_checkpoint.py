"""The checkpoint of a shot: the frames that are done, and what those to come need of them.

The file tells how far the shot is when a window begins. The render of that window keeps its own
checkpoint beside it, FILE.17 if the window begins with frame 17.
"""

from __future__ import annotations

import contextlib
import json
import os
import warnings
from dataclasses import dataclass, field, fields, replace
from typing import Any

from .. import _core
from .frames import Timing, told
from .options import RenderOptions
from .result import Result
from .shot_file import read_shot, write_shot
from .shot_result import Frame, Shot
from .windows import Window

#: Options that do not change the images of a shot.
FREE = {"threads", "checkpoint", "every", "overwrite", "cluster"}


def shot_record(
    scene: _core.Scene,
    integrator: _core.Integrator,
    options: RenderOptions,
    timing: Timing,
    frames: list[int],
    patterns: list[str],
    together: int | None,
) -> dict[str, Any]:
    """What must be the same for a shot to go on, by name."""
    settings = json.loads(integrator.settings)
    own = {f.name: getattr(options, f.name) for f in fields(options) if f.name not in FREE}
    return {
        "frames": told(frames),
        "output": " ".join(patterns),
        **timing._asdict(),
        "together": together,
        **own,
        "size": "x".join(map(str, scene.info()["size"])),
        **{f"the integrator's {name}": value for name, value in settings.items()},
        "the scene's hash": scene.hash,
        "the version of pymlt": _core.__version__,
    }


@dataclass
class ShotCheckpoint:
    """How far a shot is. It is kept in a file, if that has a name."""

    to_come: list[int]  #: frames that were to be rendered when the shot began
    path: str = ""
    record: dict[str, Any] = field(default_factory=dict)
    frames: list[Frame] = field(default_factory=list)  #: those that have been written
    window: int | None = None  #: the first frame of the window that is rendered now
    #: The first frames of renders that have checkpoints.
    renders: list[int] = field(default_factory=list)
    #: Frames of which one of two renders has ended.
    fading: dict[int, Result] = field(default_factory=dict)
    #: The errors that are known of changes to frames to come: see `WindowRender.change`.
    changes: dict[int, list[float | None]] = field(default_factory=dict)
    complete: bool = False
    interrupted: bool = False  #: whether the last render was cancelled
    goes_on: bool = False  #: whether the file was there when the shot began
    _skipping: bool = False

    def shot(self, frames: list[int]) -> Shot:
        """The shot of these frames so far. What is added to its frames is kept."""
        return Shot(self.frames, [frame for frame in frames if frame not in self.to_come])

    def has_done(self, window: Window) -> bool:
        """Whether the window had ended when the shot was interrupted. To be asked in turn."""
        if self._skipping and window.frames[0] == self.window:
            self._skipping = False
        return self._skipping

    def begin(self, window: Window, before: int | None = None) -> None:
        """Keeps what the window needs, and the render of the frame `before` it."""
        self.window = window.frames[0]
        self._keep([frame for frame in (before, self.window) if frame is not None])

    def end(self) -> None:
        """All frames are written."""
        self.complete, self.window = True, None
        self._keep([])

    def _keep(self, renders: list[int]) -> None:
        if not self.path:
            return
        old = [frame for frame in self.renders if frame not in renders]
        self.renders = renders + old
        try:
            write_shot(self.path, vars(self))
        except _core.FileError as error:
            warnings.warn(f"the checkpoint could not be written: {error}", stacklevel=2)
            return
        for frame in old:
            remove_render(self.path, frame)
        self.renders = renders

    def options_of(self, window: Window, options: RenderOptions) -> RenderOptions:
        """Those of its render."""
        path = render_file(self.path, window.frames[0]) if self.path else None
        return replace(options, checkpoint=path, overwrite=options.overwrite and not self.goes_on)

    def has_render(self, window: Window) -> bool:
        """Whether its render was interrupted and goes on."""
        return self.goes_on and os.path.exists(render_file(self.path, window.frames[0]))


def render_file(path: str, first: int) -> str:
    """The checkpoint of the render whose first frame this is."""
    return f"{path}.{first}"


def remove_render(path: str, first: int) -> None:
    with contextlib.suppress(FileNotFoundError):
        os.remove(render_file(path, first))


def kept_shot(
    options: RenderOptions,
    resume: str | os.PathLike[str] | None,
    record: dict[str, Any],
    to_come: list[int],
) -> ShotCheckpoint:
    """The checkpoint of a shot that begins, or goes on from the file `resume`.

    Raises FileError for files that are no such checkpoint, and for those that are there if a shot
    begins, unless they may be overwritten; UsageError for the checkpoint of another shot.
    """
    path = options.checkpoint
    if options.denoise and (path or resume):
        raise _core.UsageError(
            "a shot with denoise has no checkpoint, since its frames wait for those after them; "
            "leave one of both out"
        )
    if resume is None:
        if path:
            _core.check_file_writable(path)
            make_place(path, options.overwrite)
        return ShotCheckpoint(to_come, path or "", record)
    name = os.fspath(resume)
    if path and not (os.path.exists(path) and os.path.samefile(path, name)):
        raise _core.UsageError(
            f"checkpoint is {path} and resume {name}, but a shot goes on in the file that it is "
            "resumed from; leave out checkpoint"
        )
    state = read_shot(name)
    check_same(name, record, state["record"])
    _core.check_file_writable(name)
    return ShotCheckpoint(**{**state, "path": name}, goes_on=True, _skipping=True)


def make_place(path: str, overwrite: bool) -> None:
    """Removes the checkpoint of another shot. Raises FileError if what is there has to stay."""
    if not os.path.exists(path) or os.path.getsize(path) == 0:
        return
    if not overwrite:
        raise _core.FileError(
            f"{path}: is there already; go on with a shot by --resume (resume=), or replace its "
            "checkpoint by --overwrite"
        )
    for first in read_shot(path)["renders"]:
        remove_render(path, first)
    os.remove(path)


def check_same(path: str, given: dict[str, Any], own: dict[str, Any]) -> None:
    """Raises UsageError for the checkpoint of another shot."""
    given = json.loads(json.dumps(given))
    for name in {**own, **given}:
        here, there = (
            "not given" if values.get(name) is None else values[name] for values in (given, own)
        )
        if here != there:
            raise _core.UsageError(
                f"{name} is {here} here and {there} in the checkpoint {path}; a shot goes on only "
                "as it was begun"
            )
