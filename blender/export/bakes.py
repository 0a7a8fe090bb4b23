"""Images that Cycles has made of textures: which mesh and material have them."""

LAYER = "pymlt"  #: the UV map on which they lie


def of(mesh, material) -> dict[tuple[str, str], object]:
    """The baked images of a material on a mesh, by the node and the socket that they feed."""
    if mesh is None or material is None:
        return {}
    return {
        (bake.node, bake.socket): bake.image
        for bake in getattr(mesh, "pymlt_bakes", ())
        if bake.image and bake.material and bake.material.name_full == material.name_full
    }


def place(socket) -> tuple[str, str]:
    """What a socket is called among those of a material."""
    return socket.node.name, socket.identifier
