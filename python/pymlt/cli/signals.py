"""The signals that end a render early."""

from __future__ import annotations

import os
import signal
import threading


class Signals:
    """SIGINT, SIGTERM and SIGHUP (of a terminal that was closed, unless nohup had it ignored) while
    there is something to save: remembered in `caught`, not raised."""

    def __init__(self):
        self.caught = 0

    def __enter__(self):
        if threading.current_thread() is threading.main_thread():
            numbers = [signal.SIGINT, signal.SIGTERM]
            if signal.getsignal(signal.SIGHUP) != signal.SIG_IGN:
                numbers.append(signal.SIGHUP)
            self._old = {n: signal.signal(n, self._catch) for n in numbers}
        else:
            self._old = {}
        return self

    def __exit__(self, *_):
        for number, handler in self._old.items():
            signal.signal(number, handler)

    def _catch(self, number, _frame):
        self.caught = self.caught or number

    def abandonable(self, function):
        """Run a function whose work nobody would miss: a signal ends the program at once."""
        done = {}

        def run():
            try:
                done["value"] = function()
            except BaseException as error:
                done["error"] = error

        thread = threading.Thread(target=run, daemon=True)
        thread.start()
        while thread.is_alive():
            thread.join(0.05)
            if self.caught:
                os._exit(128 + self.caught)
        if "error" in done:
            raise done["error"]
        return done["value"]
