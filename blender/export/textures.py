"""What is plugged into sockets of materials: colours, numbers and images."""

from mathutils import Euler, Matrix

from pymlt.formats.imported import Imported, rgb

from .images import colours, samples

WRAPS = {"EXTEND": "clamp", "CLIP": "black", "MIRROR": "mirror"}
CHANNELS = {"Red": 0, "Green": 1, "Blue": 2}


def source(socket):
    """The socket that an input comes from, behind reroutes; None if nothing is plugged in."""
    while socket.is_linked:
        found = socket.links[0].from_socket
        if found.node.type != "REROUTE":
            return found
        socket = found.node.inputs[0]
    return None


class Textures:
    """The images of a scene, each of which is added once."""

    def __init__(self, made: Imported):
        self._made = made
        self._added: dict[tuple, str] = {}

    def colour(self, socket) -> dict:
        """What a colour socket gets, as a colour or a texture."""
        found = source(socket)
        if found is None:
            return rgb(socket.default_value[:3])
        if found.node.type == "RGB":
            return rgb(found.default_value[:3])
        return self._texture(found) or rgb(socket.default_value[:3])

    def number(self, socket):
        """What a socket of one number gets, as a number or a texture."""
        found = source(socket)
        if found is None:
            return socket.default_value
        if found.node.type == "VALUE":
            return found.default_value
        if found.node.type == "SEPARATE_COLOR":
            inner = source(found.node.inputs["Color"])
            texture = inner and self._texture(inner, CHANNELS.get(found.name))
        else:
            texture = self._texture(found)
        return texture or socket.default_value

    def _texture(self, found, channel: int | None = None) -> dict | None:
        node = found.node
        if node.type != "TEX_IMAGE" or not node.image:
            self._made.warn(f"the node {node.bl_label!r} is left out where a texture is wanted")
            return None
        if found.name == "Alpha":
            channel = 3
        key = (node.image.name_full, node.extension, node.interpolation, placement(node), channel)
        if key not in self._added:
            bitmap = self._bitmap(node, channel)
            if bitmap is None:
                return None
            self._added[key] = self._made.add(node.image.name, bitmap)
        return {"type": "ref", "id": self._added[key]}

    def _bitmap(self, node, channel: int | None) -> dict | None:
        values = samples(node.image, self._made)
        if values is None:
            return None
        if channel is None:
            values = colours(values)
        else:
            values = values[..., min(channel, values.shape[2] - 1)]
        raw = channel == 3 or node.image.colorspace_settings.is_data
        bitmap = {"type": "bitmap", "data": values, "raw": bool(raw)}
        if node.extension in WRAPS:
            bitmap["wrap_mode"] = WRAPS[node.extension]
        if node.interpolation == "Closest":
            bitmap["filter_type"] = "nearest"
        if rows := placement(node):
            bitmap["to_uv"] = [list(row) for row in rows]
        return bitmap


def placement(node) -> tuple | None:
    """The matrix of the Mapping node before an image, by rows."""
    found = source(node.inputs["Vector"])
    if found is None or found.node.type != "MAPPING":
        return None
    place, turn, scale = (
        found.node.inputs[n].default_value for n in ("Location", "Rotation", "Scale")
    )
    return tuple(map(tuple, Matrix.LocRotScale(place, Euler(turn), scale)))
