"""Groups of nodes, which are entered and left while a material is read."""

from contextlib import contextmanager


class Groups:
    """The groups that are being read, the innermost last."""

    def __init__(self):
        self._entered: list = []

    @property
    def is_outside(self) -> bool:
        return not self._entered

    def through(self, found, read):
        """What `read` makes of the socket that a group's socket stands for; None for others."""
        if found.node.type == "GROUP_INPUT" and self._entered:
            outer = named(self._entered[-1].inputs, found.identifier)
            with self._left():
                return outer and read(outer)
        output = found.node.type == "GROUP" and end(found.node.node_tree)
        inner = output and named(output.inputs, found.identifier)
        if not inner:
            return None
        self._entered.append(found.node)
        try:
            return read(inner)
        finally:
            self._entered.pop()

    @contextmanager
    def _left(self):
        group = self._entered.pop()
        try:
            yield
        finally:
            self._entered.append(group)


def end(tree):
    """The node of a group's results; None without one."""
    nodes = tree.nodes if tree else ()
    ends = [node for node in nodes if node.type == "GROUP_OUTPUT"]
    return next((node for node in ends if node.is_active_output), None)


def named(sockets, identifier: str):
    return next((socket for socket in sockets if socket.identifier == identifier), None)
