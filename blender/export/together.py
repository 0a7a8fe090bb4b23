"""Exports of several frames as one scene, in which things move from frame to frame.

Frame k is seen from the time k to k + OPEN, however long Blender's shutter is open: shares of that
time are kept. Things stand where they are to be at both ends of it; what they do until the next
frame is not seen.
"""

import numpy as np

OPEN = 0.5  #: the share of the time from frame to frame in which the shutter is open
SHUTTER = ("shutter_open", "shutter_close")
STILL = ("envmap",)  #: plug-ins whose `to_world` takes no animation


class Joined:
    """The frames that differ from the first one in nothing but where things are."""

    def __init__(self, first: dict):
        self._first = first
        self._frames = [ways(first)]

    def add(self, other: dict) -> str:
        """Adds the export of the next frame; or says what else it is that differs."""
        found = difference(self._first, other)
        if not found:
            self._frames.append(ways(other))
        return found

    def shows(self, place: int, scene: dict) -> bool:
        """Whether the frame at this place is still what it was when it was added."""
        if difference(self._first, scene):
            return False
        before, now = self._frames[place], ways(scene)
        return all(
            moments.keys() == now[name].keys()
            and all(np.allclose(m, now[name][t], atol=1e-6) for t, m in moments.items())
            for name, moments in before.items()
        )

    def scene(self, count: int) -> dict:
        """The scene of the first `count` frames."""
        made = {n: without(p, SHUTTER) if n == "camera" else p for n, p in self._first.items()}
        for name in self._frames[0]:
            keys = {
                str(k + OPEN * share): place
                for k, frame in enumerate(self._frames[:count])
                for share, place in frame[name].items()
            }
            first, *others = keys.values()
            if not all(np.array_equal(first, place) for place in others):
                made[name] = made[name] | {"to_world": {"type": "animation", **keys}}
        return made


def without(plugin: dict, names: tuple[str, ...]) -> dict:
    return {name: value for name, value in plugin.items() if name not in names}


def can_move(plugin) -> bool:
    return isinstance(plugin, dict) and "to_world" in plugin and plugin["type"] not in STILL


def ways(scene: dict) -> dict[str, dict[float, np.ndarray]]:
    """Where each thing is in a frame, at shares of the shutter's time, of which 0 and 1 are two."""
    begin, end = (scene["camera"].get(name, 0.0) for name in SHUTTER)
    found = {}
    for name, plugin in scene.items():
        if can_move(plugin):
            place = plugin["to_world"]
            moments = without(place, ("type",)) if isinstance(place, dict) else {}
            found[name] = {(float(t) - begin) / (end - begin): m for t, m in moments.items()}
            if not moments:
                found[name] = {0.0: place, 1.0: place}
    return found


def difference(a: dict, b: dict) -> str:
    """What else differs in two frames than where things are, in words; "" if nothing does."""
    # Things come before their materials.
    for name in sorted(a.keys() ^ b.keys(), key=lambda name: not can_move((a | b)[name])):
        return f"{name!r} {'appears' if name in b else 'vanishes'}"
    for name, plugin in a.items():
        if not isinstance(plugin, dict):
            continue
        other = b[name]
        ignored = SHUTTER + ("to_world",) * can_become(plugin, other)
        for key in sorted({*plugin, *other}):
            if key not in ignored and not same(plugin.get(key), other.get(key)):
                return f"{name!r} differs in its {key}"
    return ""


def can_become(plugin: dict, other: dict) -> bool:
    """Whether one animation can have the places of both: all of its keys mirror, or none does, and
    an orthographic camera has one scale, that of its image."""
    if not (can_move(plugin) and can_move(other)):
        return False
    a, b = (any_place(p)[:3, :3] for p in (plugin, other))
    if plugin["type"] == "orthographic":
        return np.allclose(*(np.linalg.norm(m, axis=0) for m in (a, b)), rtol=1e-7)
    return bool(np.sign(np.linalg.det(a)) == np.sign(np.linalg.det(b)))


def any_place(plugin: dict) -> np.ndarray:
    place = plugin["to_world"]
    return next(m for t, m in place.items() if t != "type") if isinstance(place, dict) else place


def same(a, b) -> bool:
    if isinstance(a, dict) and isinstance(b, dict):
        return a.keys() == b.keys() and all(same(value, b[key]) for key, value in a.items())
    return bool(np.array_equal(a, b))
