"""A render in the browser while it refines: the live view, the path inspector, the live lecture.

The page is made by viser (extra `view`). Each tab is a `Session` with a render of its own, which
ends when the tab is closed.
"""

from .start import view

__all__ = ["view"]
