"""Ctrl-C while the command line is being imported ends it without a traceback."""

import os
import signal
import sys


def _end(number, _frame):
    os._exit(128 + number)


def end() -> None:
    """KeyboardInterrupt is raised from now on."""
    if signal.getsignal(signal.SIGINT) is _end:
        signal.signal(signal.SIGINT, signal.default_int_handler)


#: The script `pymlt`, or `python -m pymlt`.
_program = os.path.basename((getattr(sys, "argv", None) or [""])[0])
if _program in ("pymlt", "-m") and signal.getsignal(signal.SIGINT) is signal.default_int_handler:
    try:  # noqa: SIM105 (contextlib takes a while to import)
        signal.signal(signal.SIGINT, _end)
    except ValueError:  # not in the main thread, which alone may do this
        pass
