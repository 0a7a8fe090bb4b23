"""What is plugged into sockets of materials: colours, numbers and images."""

from mathutils import Euler, Matrix

from pymlt.formats.imported import Imported, rgb

from .bakes import place
from .groups import Groups
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
        self._baked: dict = {}
        self._place: tuple[str, str] | None = None  #: of the socket that could be baked
        self._groups = Groups()
        self.asked: dict[tuple[str, str], bool] = {}  #: sockets, and whether they are known

    def begin(self, baked: dict) -> None:
        """Another material, with its baked images by the places of sockets."""
        self._baked, self.asked = baked, {}

    @property
    def is_baked(self) -> bool:
        return bool(self._baked)

    def colour(self, socket) -> dict:
        """What a colour socket gets, as a colour or a texture."""
        if texture := self._baked_at(socket):
            return texture
        found = source(socket)
        if found is None:
            return rgb(socket.default_value[:3])
        if found.node.type == "RGB":
            return rgb(found.default_value[:3])
        texture = self.through(found, self.colour)
        return texture or self._texture(found) or rgb(socket.default_value[:3])

    def number(self, socket):
        """What a socket of one number gets, as a number or a texture."""
        if texture := self._baked_at(socket):
            return texture
        found, channel = source(socket), None
        if found is None:
            return socket_values(socket)[0]
        if found.node.type == "VALUE":
            return found.default_value
        given = self.through(found, self.number)
        if given is not None:
            return given
        if found.node.type == "SEPARATE_COLOR" and source(found.node.inputs["Color"]):
            channel = CHANNELS.get(found.name)
            found = source(found.node.inputs["Color"])
        return self._texture(found, channel) or socket_values(socket)[0]

    def plugged(self, socket):
        """The socket that an input comes from, also from outside a group; None without one."""
        found = source(socket)
        if found is None or found.node.type != "GROUP_INPUT":
            return found
        return self.through(found, self.plugged)

    def constant(self, socket):
        """What a socket gets that takes no texture here."""
        found = source(socket)
        if found is None:
            return socket.default_value
        if found.node.type in ("VALUE", "RGB"):
            return found.default_value
        given = self.through(found, self.constant)
        if given is None:
            self._made.warn(f"a texture of the {socket.name} of {socket.node.bl_label} is left out")
        return socket.default_value if given is None else given

    def _baked_at(self, socket) -> dict | None:
        """The image that Cycles has baked for a socket; which is noted, if it could be baked."""
        if self._groups.is_outside:
            self._place = place(socket)
        image = self._baked.get(self._place) if self._place else None
        return image and self._baked_texture(image, len(socket_values(socket)))

    def through(self, found, read):
        """What `read` makes of the socket that a group's socket stands for; None for others."""
        before = self._place
        try:
            return self._groups.through(found, read)
        finally:
            self._place = before

    def through_shader(self, found, read):
        """As `through` for shaders, within whose groups no socket can be baked."""
        self._place = None
        return self.through(found, read)

    def _texture(self, found, channel: int | None = None) -> dict | None:
        node = found.node
        is_image = node.type == "TEX_IMAGE" and node.image is not None
        if self._place:
            self.asked[self._place] = is_image and is_on_uv(node)
        if not is_image:
            self._made.warn(f"the node {node.bl_label!r} is left out where a texture is wanted")
            return None
        if self._baked:
            self._made.warn("what is not baked is left out where other textures are")
            return None
        if not is_on_uv(node):
            self._made.warn("images are placed by the UV map alone")
        if found.name == "Alpha":
            channel = 3
        key = (node.image.name_full, node.extension, node.interpolation, placement(node), channel)
        return self._reference(key, node.image.name, lambda: self._bitmap(node, channel))

    def _baked_texture(self, image, channels: int) -> dict | None:
        def bitmap() -> dict | None:
            values = samples(image, self._made)
            if values is None:
                return None
            values = values[..., 0] if channels == 1 else colours(values)
            return {"type": "bitmap", "data": values, "raw": channels == 1, "wrap_mode": "clamp"}

        return self._reference((image.name_full, channels), image.name, bitmap)

    def _reference(self, key: tuple, name: str, make) -> dict | None:
        """The texture of this key, which is made if it is new."""
        if key not in self._added:
            bitmap = make()
            if bitmap is None:
                return None
            self._added[key] = self._made.add(name, bitmap)
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


def socket_values(socket) -> list:
    """The numbers of a socket: one, or those of a colour."""
    value = socket.default_value
    return list(value) if hasattr(value, "__len__") else [value]


def is_on_uv(node) -> bool:
    """Whether an image lies on the surface by its UV map, and not by what else there is."""
    found = source(node.inputs["Vector"])
    if found is not None and found.node.type == "MAPPING":
        found = source(found.node.inputs["Vector"])
    if found is None:
        return node.projection == "FLAT"
    by_uv = found.node.type == "UVMAP" or (found.node.type, found.name) == ("TEX_COORD", "UV")
    return by_uv and node.projection == "FLAT"


def placement(node) -> tuple | None:
    """The matrix of the Mapping node before an image, by rows."""
    found = source(node.inputs["Vector"])
    if found is None or found.node.type != "MAPPING":
        return None
    place, turn, scale = (
        found.node.inputs[n].default_value for n in ("Location", "Rotation", "Scale")
    )
    return tuple(map(tuple, Matrix.LocRotScale(place, Euler(turn), scale)))
