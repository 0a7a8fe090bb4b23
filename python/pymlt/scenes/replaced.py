"""Which scenes have been edited into others that nobody has looked at.

In Mitsuba an update changes the scene itself; here whoever renders the old one has probably
forgotten that it stays as it was.
"""

from __future__ import annotations

import warnings
import weakref

from .. import _core

_newer: weakref.WeakKeyDictionary[_core.Scene, weakref.ref[_core.Scene]] = (
    weakref.WeakKeyDictionary()
)


def replace(old: _core.Scene, new: _core.Scene) -> None:
    """`old`, and what it has itself replaced, is now represented by `new`."""
    for scene in [old, *_replaced_by(old)]:
        _newer[scene] = weakref.ref(new)


def fetch(new: _core.Scene) -> None:
    """Somebody has `new`, so that what it replaces may be used on purpose."""
    for scene in _replaced_by(new):
        del _newer[scene]


def warn_if_replaced(scene: _core.Scene) -> None:
    """Once for each scene."""
    if _newer.pop(scene, None) is not None:
        warnings.warn(
            "this scene has been edited by `params.update()` of mlt.traverse, and is rendered as "
            "it was before: a Scene never changes; render `params`, or `params.scene`",
            stacklevel=5,
        )


def _replaced_by(new: _core.Scene) -> list[_core.Scene]:
    return [scene for scene, other in list(_newer.items()) if other() is new]
