"""USD files for tests, written as the text that people read."""

from pathlib import Path

from pymlt.formats.files import read_foreign

CAMERA = """
def Camera "camera" {
    float horizontalAperture = 20
    float verticalAperture = 15
    float focalLength = 20
    double3 xformOp:translate = (0, 0, 5)
    uniform token[] xformOpOrder = ["xformOp:translate"]
}
"""

SQUARE = """
    point3f[] points = [(-1, -1, 0), (1, -1, 0), (1, 1, 0), (-1, 1, 0)]
    int[] faceVertexCounts = [4]
    int[] faceVertexIndices = [0, 1, 2, 3]
    uniform token subdivisionScheme = "none"
"""


def mesh(more: str = "", name: str = "square", head: str = "") -> str:
    """A square from -1 to 1 that faces +z."""
    return f'\ndef Mesh "{name}" {head} {{ {SQUARE}\n{more}\n}}\n'


def moved(x: float, y: float, z: float) -> str:
    """What moves a prim."""
    return f"""
    double3 xformOp:translate = ({x}, {y}, {z})
    uniform token[] xformOpOrder = ["xformOp:translate"]
"""


def written(text: str, head: str = "", name: str = "a.usda") -> str:
    """A file in the current folder, which has a camera."""
    Path(name).write_text(f"#usda 1.0\n({head})\n{CAMERA}\n{text}")
    return name


def converted(text: str, head: str = ""):
    """The scene that is made of prims."""
    return read_foreign(written(text, head))
