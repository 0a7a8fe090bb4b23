"""Where objects are while the shutter is open."""

from dataclasses import dataclass, field

import numpy as np

KEYS = 5  #: moments at which a frame is looked at: enough for turns by less than 720 degrees


def identity(instance) -> tuple:
    """What an instance is called at all times."""
    parent = instance.parent.name_full if instance.parent else ""
    return instance.object.name_full, parent, *instance.persistent_id


@dataclass
class Motion:
    """The matrices of all that is seen, at some moments; none without motion blur."""

    times: list[float] = field(default_factory=list)  #: in frames, from that which is rendered
    places: list[dict[tuple, np.ndarray]] = field(default_factory=list)  #: one dict per moment

    @classmethod
    def of_frame(cls, engine, depsgraph) -> "Motion":
        """Looks at the whole shutter, then returns to the frame."""
        scene = depsgraph.scene
        render, frame = scene.render, scene.frame_current
        if not render.use_motion_blur:
            return cls()
        begin = {"START": 0.0, "CENTER": -0.5, "END": -1.0}[render.motion_blur_position]
        times = render.motion_blur_shutter * (begin + np.linspace(0, 1, KEYS))
        places = []
        for time in times.tolist():
            moment = int(np.floor(frame + time))
            engine.frame_set(moment, subframe=frame + time - moment)
            now = {identity(i): np.array(i.matrix_world) for i in depsgraph.object_instances}
            eye = depsgraph.scene_eval.camera
            places.append(now | {("camera",): np.array(eye.matrix_world)})
        engine.frame_set(frame, subframe=0)
        return cls(times.tolist(), places)

    def matrices(self, key: tuple, still: np.ndarray) -> list[np.ndarray]:
        """Where something is at each moment; one matrix if it does not move."""
        found = [place.get(key, still) for place in self.places] or [still]
        return found if not np.allclose(found, found[0], atol=1e-7) else [still]

    def shutter(self) -> dict:
        """The parameters of a sensor."""
        if not self.times:
            return {}
        return {"shutter_open": self.times[0], "shutter_close": self.times[-1]}


def animated(plugins: list[dict], motion: Motion) -> dict:
    """One plug-in of those of all moments, which differ in where they are."""
    if len(plugins) == 1 or "to_world" not in plugins[0]:
        return plugins[0]
    keys = {str(t): p["to_world"] for t, p in zip(motion.times, plugins, strict=True)}
    return plugins[0] | {"to_world": {"type": "animation", **keys}}
