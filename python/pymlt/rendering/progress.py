"""A progress bar, on a terminal or in a notebook."""

from __future__ import annotations

import sys
import warnings
from contextlib import contextmanager, nullcontext, suppress

_FORMAT = "{desc}{percentage:3.0f}%|{bar}| {elapsed}<{remaining}{postfix}"


@contextmanager
def progress_bar(progress):
    """Yields a function to call with the fraction that is done and a dict of numbers to show.

    `progress` may be True, False, None (True on a terminal and in a notebook) or a function of the
    fraction.
    """
    if callable(progress):
        yield lambda done, _: progress(done)
        return
    if progress is None:
        progress = _is_shown() or "ipykernel" in sys.modules
    if not progress:
        yield lambda done, numbers: None
        return
    bar = _bar()

    def update(done, numbers):
        with suppress(OSError):  # of a terminal that has gone
            bar.set_postfix(numbers, refresh=False)
            bar.update(max(0.0, done - bar.n))

    try:
        yield update
    finally:
        with suppress(OSError):
            bar.close()


@contextmanager
def above_bars():
    """Lines that are printed meanwhile to stderr stand above the progress bars there."""
    tqdm = sys.modules.get("tqdm")
    with tqdm.tqdm.external_write_mode(sys.stderr) if tqdm else nullcontext():
        yield


def _is_shown() -> bool:
    return sys.stderr is not None and sys.stderr.isatty()


def _bar():
    """A widget where ipywidgets has one, else a line of text; tqdm would warn of the latter."""
    from tqdm import TqdmWarning

    with warnings.catch_warnings():
        warnings.simplefilter("ignore", TqdmWarning)
        from tqdm.auto import tqdm

        return tqdm(total=1.0, bar_format=_FORMAT, leave=False)
