"""A progress bar, on a terminal or in a notebook."""

from __future__ import annotations

import sys
from contextlib import contextmanager

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
        progress = sys.stderr.isatty() or "ipykernel" in sys.modules
    if not progress:
        yield lambda done, numbers: None
        return
    from tqdm.auto import tqdm

    with tqdm(total=1.0, bar_format=_FORMAT, leave=False) as bar:

        def update(done, numbers):
            bar.set_postfix(numbers, refresh=False)
            bar.update(max(0.0, done - bar.n))

        yield update
