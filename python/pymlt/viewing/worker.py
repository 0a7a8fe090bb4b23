"""What every tab of the browser has: one thread, which does what the page's callbacks post."""

from __future__ import annotations

import queue
import threading
import traceback
from collections.abc import Callable
from typing import Any

from .. import _core


class Worker:
    """A tab. Any thread may call `post`, `close` and `wait`; the rest belongs to its own."""

    def __init__(self, client: Any):
        self.client = client
        self._actions: queue.SimpleQueue[Callable[[], object] | None] = queue.SimpleQueue()
        self._open = True
        self._complaints: dict[Any, Any] = {}  # the messages, by what has failed
        self._thread = threading.Thread(target=self._run, name="pymlt view: tab", daemon=True)

    # ---- from other threads

    def post(self, action: Callable[[], object]) -> None:
        """Have the tab's thread do it; what goes wrong is shown in the tab."""
        self._actions.put(action)

    def close(self) -> None:
        """End the thread."""
        self._open = False
        self._actions.put(None)

    def wait(self, seconds: float) -> None:
        self._thread.join(seconds)

    # ---- the tab's thread

    def _run(self) -> None:
        while self._take(None):
            pass

    def _take(self, seconds: float | None) -> bool:
        """Does what was posted, waiting at most so long for the first; False at the end."""
        try:
            action = (
                self._actions.get(timeout=seconds) if seconds != 0 else self._actions.get_nowait()
            )
            while True:
                if action is None:
                    return False
                self._try(action)
                action = self._actions.get_nowait()
        except queue.Empty:
            return True

    def _try(self, action: Callable[[], object], cure: Callable[[], object] | None = None) -> None:
        """Does it, or complains until the cure, or else the action, has worked."""
        try:
            action()
        except (_core.Error, ValueError, OverflowError) as error:
            self._complain(cure or action, "This does not work", str(error))
        except Exception as error:  # a bug: say where
            if not self._open:
                return  # nobody listens any more
            traceback.print_exc()
            self._complain(cure or action, "Something went wrong in pymlt", repr(error))
        else:
            if cure is None:
                self.mended(action)

    def _complain(self, cure: Callable[[], object], title: str, text: str) -> None:
        self.mended(cure)
        self._complaints[_key(cure)] = self.say(title, text)

    def mended(self, cure: Callable[[], object]) -> None:
        """Takes away what was said when it failed."""
        message = self._complaints.pop(_key(cure), None)
        if message is not None:
            message.remove()

    def say(self, title: str, text: str, color: str = "red") -> Any:
        """A message at the corner of the page, for a quarter of a minute; returns its handle."""
        return self.client.add_notification(title, text, color=color, auto_close_seconds=15)


def _key(action: Callable[[], object]) -> object:
    """Equal for all that one line of code makes."""
    return getattr(action, "__code__", action)
