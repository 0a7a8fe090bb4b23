"""glTF files for tests, made by pygltflib: rectangles like Mitsuba's, cameras, lights."""

import io

import numpy as np
import pygltflib as gl

from pymlt.formats.files import read_foreign

KINDS = {"f": gl.FLOAT, "I": gl.UNSIGNED_INT, "B": gl.UNSIGNED_BYTE, "H": gl.UNSIGNED_SHORT}
KINDS |= {"b": gl.BYTE, "h": gl.SHORT}
SHAPES = {1: gl.SCALAR, 2: gl.VEC2, 3: gl.VEC3, 4: gl.VEC4}
CORNERS = np.array([[-1, -1, 0], [1, -1, 0], [1, 1, 0], [-1, 1, 0]], np.float32)


class GltfFile:
    """A file that grows."""

    def __init__(self):
        self.gltf = gl.GLTF2(
            asset=gl.Asset(version="2.0"),
            scene=0,
            scenes=[gl.Scene(nodes=[])],
            buffers=[gl.Buffer()],
        )
        self.blob = b""
        self.lights = []

    def view(self, content: bytes) -> int:
        self.blob += b"\0" * (-len(self.blob) % 4)
        place = gl.BufferView(buffer=0, byteOffset=len(self.blob), byteLength=len(content))
        self.gltf.bufferViews.append(place)
        self.blob += content
        return len(self.gltf.bufferViews) - 1

    def accessor(self, values, **settings) -> int:
        values = np.ascontiguousarray(values)
        made = gl.Accessor(
            bufferView=self.view(values.tobytes()),
            componentType=KINDS[values.dtype.char],
            count=len(values),
            type=SHAPES[values.shape[1] if values.ndim > 1 else 1],
            **settings,
        )
        self.gltf.accessors.append(made)
        return len(self.gltf.accessors) - 1

    def mesh(self, material=None, *, indices=(0, 1, 2, 0, 2, 3), uvs=None, mode=4, **more) -> int:
        """A rectangle from -1 to 1 that faces +z, with Mitsuba's texture coordinates."""
        attributes = gl.Attributes(
            POSITION=self.accessor(CORNERS, min=[-1, -1, 0], max=[1, 1, 0]),
            NORMAL=self.accessor(np.tile(np.array([0, 0, 1], np.float32), (4, 1))),
            TEXCOORD_0=self.accessor((CORNERS[:, :2] + 1) / 2) if uvs is None else uvs,
            **more,
        )
        primitive = gl.Primitive(attributes=attributes, material=material, mode=mode)
        if indices is not None:
            primitive.indices = self.accessor(np.array(indices, np.uint32))
        self.gltf.meshes.append(gl.Mesh(primitives=[primitive]))
        return len(self.gltf.meshes) - 1

    def material(self, *, colour=(1, 1, 1, 1), roughness=1.0, metallic=0.0, **more) -> int:
        textures = {k: more.pop(k) for k in list(more) if k in ("baseColorTexture", "packed")}
        if "packed" in textures:
            textures["metallicRoughnessTexture"] = textures.pop("packed")
        pbr = gl.PbrMetallicRoughness(
            baseColorFactor=list(colour),
            roughnessFactor=roughness,
            metallicFactor=metallic,
            **textures,
        )
        self.gltf.materials.append(gl.Material(pbrMetallicRoughness=pbr, **more))
        return len(self.gltf.materials) - 1

    def texture(self, codes, **sampler) -> gl.TextureInfo:
        """An 8-bit PNG inside of the file."""
        from matplotlib import image

        content = io.BytesIO()
        image.imsave(content, np.asarray(codes, np.uint8), format="png")
        view = self.view(content.getvalue())
        self.gltf.images.append(gl.Image(bufferView=view, mimeType="image/png"))
        self.gltf.samplers.append(gl.Sampler(**sampler))
        count = len(self.gltf.images) - 1
        self.gltf.textures.append(gl.Texture(source=count, sampler=count))
        return gl.TextureInfo(index=count)

    def node(self, *, root: bool = True, **settings) -> int:
        self.gltf.nodes.append(gl.Node(**settings))
        index = len(self.gltf.nodes) - 1
        if root:
            self.gltf.scenes[0].nodes.append(index)
        return index

    def camera(self, **node) -> int:
        view = gl.Perspective(yfov=np.radians(40), aspectRatio=4 / 3, znear=0.1)
        self.gltf.cameras.append(gl.Camera(type="perspective", perspective=view))
        return self.node(camera=len(self.gltf.cameras) - 1, **node)

    def light(self, light: dict, **node) -> int:
        self.lights.append(light)
        given = {"KHR_lights_punctual": {"light": len(self.lights) - 1}}
        return self.node(extensions=given, **node)

    def save(self, path) -> str:
        if self.lights:
            self.gltf.extensionsUsed.append("KHR_lights_punctual")
            self.gltf.extensions = {"KHR_lights_punctual": {"lights": self.lights}}
        self.gltf.buffers[0].byteLength = len(self.blob)
        self.gltf.set_binary_blob(self.blob)
        if str(path).endswith(".gltf"):
            self.gltf.convert_buffers(gl.BufferFormat.DATAURI)
        self.gltf.save(str(path))
        return str(path)


def converted(file: GltfFile):
    """The scene that is made of a file, in the current folder."""
    return read_foreign(file.save("a.glb"))
