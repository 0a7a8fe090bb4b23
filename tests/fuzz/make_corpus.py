"""Make the seeds in tests/fuzz/corpus, one folder for each target, and the words of scene.dict.

    .venv/bin/python tests/fuzz/make_corpus.py

Seeds are small files of every kind that a reader takes. Checkpoints and packed scenes are what this
build writes: run it again when what these hold has changed.
"""

import json
import re
import shutil
import struct
import sys
import tempfile
import zlib
from collections.abc import Callable, Iterator
from pathlib import Path

import numpy as np
import OpenImageIO

import pymlt as mlt
from pymlt import _core

GLASSES = ("bk7", "sf11", "sapphire", "fused quartz", "water", "diamond")
COMPRESSIONS = ("none", "rle", "zips", "zip", "piz", "pxr24", "b44", "b44a", "dwaa", "dwab")
LONGEST = 4096  # bytes of a scene; tests/fuzz/run.sh has libFuzzer cut off what is longer
FOLDER = Path(__file__).resolve().parent
sys.path.insert(0, str(FOLDER.parent / "python"))
import materialx_files as mx  # noqa: E402
from gltf_files import GltfFile  # noqa: E402
from random_scene import FOLDER as SCENES  # noqa: E402
from random_scene import random_scene  # noqa: E402


def write(target: str, name: str, content: bytes | str) -> None:
    path = FOLDER / "corpus" / target / name
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_bytes(content.encode() if isinstance(content, str) else content)


# ---- images --------------------------------------------------------------------------------------


def image_file(extension: str, channels: int, type: str, tile: int = 0, **attributes) -> bytes:
    """A ramp of 9 x 7 pixels as OpenImageIO writes it."""
    spec = OpenImageIO.ImageSpec(9, 7, channels, type)
    spec.attribute("DateTime", "2000:01:01 00:00:00")  # the same files whenever they are made
    if tile:
        spec.tile_width = spec.tile_height = tile
    for name, value in attributes.items():
        spec.attribute(name.replace("_", ":", 1), value)
    with tempfile.TemporaryDirectory() as folder:
        path = str(Path(folder) / f"a.{extension}")
        out = OpenImageIO.ImageOutput.create(path)
        assert out.open(path, spec), out.geterror()
        ramp = np.linspace(0, 1, 9 * 7 * channels, dtype=np.float32).reshape(7, 9, channels)
        assert out.write_image(ramp), out.geterror()
        out.close()
        return Path(path).read_bytes()


def make_images() -> None:
    for channels, name in ((1, "grey"), (3, "rgb"), (4, "rgba")):
        write("image", f"{name}.png", image_file("png", channels, "uint8"))
        write("image", f"{name}.tga", image_file("tga", channels, "uint8"))
        write("image", f"{name}16.png", image_file("png", channels, "uint16"))
    write("image", "baseline.jpg", image_file("jpg", 3, "uint8"))
    write("image", "grey.jpg", image_file("jpg", 1, "uint8"))
    write("image", "progressive.jpg", image_file("jpg", 3, "uint8", jpeg_progressive=1))
    write("image", "rle.tga", image_file("tga", 3, "uint8", compression="rle"))
    write("image", "rgb.bmp", image_file("bmp", 3, "uint8"))
    write("image", "rgb.hdr", image_file("hdr", 3, "float"))
    write("image", "half.exr", image_file("exr", 3, "half"))


def make_exr() -> None:
    for compression in COMPRESSIONS:
        write("exr", f"{compression}.exr", image_file("exr", 3, "half", compression=compression))
    write("exr", "tiled.exr", image_file("exr", 4, "half", tile=16))
    write("exr", "uint.exr", image_file("exr", 1, "uint"))
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "a.exr"
        image = np.linspace(0, 1, 60, dtype=np.float32).reshape(4, 5, 3)
        mlt.write_image(path, image, metadata={"scene": "a"})
        write("exr", "own.exr", path.read_bytes())


# ---- meshes --------------------------------------------------------------------------------------

CORNERS = [(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0.5)]


def make_obj() -> None:
    vertices = "".join(f"v {x} {y} {z}\n" for x, y, z in CORNERS)
    more = "vt 0 0\nvt 1 0\nvt 1 1\nvn 0 0 1\n"
    write("obj", "plain.obj", vertices + "f 1 2 3\nf 1 3 4\n")
    write("obj", "all.obj", f"# a comment\no a\ng b\ns 1\n{vertices}{more}f 1/1/1 2/2/1 3/3/1\n")
    write("obj", "normals.obj", f"{vertices}{more}f 1//1 2//1 3//1 4//1\n")
    concave = "v 0 0 0\nv 2 -1 0\nv 0 2 0\nv -2 -1 0\nv 0 0 0\nf 1 2 3 4 5\nf 2 3\n"
    write("obj", "concave.obj", "\ufeff" + concave)
    write(
        "obj",
        "old.obj",
        f"{vertices}vn nan -1.#IND 1\nvt 1 1.#QNAN\nf 1/1/ 2// 3//1\n".replace("\n", "\r"),
    )
    write("obj", "from-the-end.obj", f"{vertices}{more}f -4/-3 -3/-2 -2/-1\nusemtl x\nmtllib y\n")


def ply_header(form: str) -> str:
    return (
        f"ply\nformat {form} 1.0\ncomment x\nelement vertex 4\n"
        + "".join(f"property float {name}\n" for name in ("x", "y", "z", "nx", "ny", "nz"))
        + "property float u\nproperty float v\nproperty uchar red\n"
        + "element face 2\nproperty list uchar int vertex_indices\nend_header\n"
    )


def make_ply() -> None:
    faces = [(0, 1, 2), (0, 1, 2, 3)]
    lines = [f"{x} {y} {z} 0 0 1 {x} {y} 7" for x, y, z in CORNERS]
    lines += [f"{len(face)} {' '.join(map(str, face))}" for face in faces]
    write("ply", "ascii.ply", ply_header("ascii") + "\n".join(lines) + "\n")
    strips = ply_header("ascii").replace("element face 2", "element tristrips 1")
    strips = strips.replace("uchar int", "int int")
    write("ply", "strips.ply", strips + "\n".join(lines[:4]) + "\n8 0 1 2 3 -1 3 2 1\n")
    for form, order in (("binary_little_endian", "<"), ("binary_big_endian", ">")):
        body = b"".join(struct.pack(f"{order}8fB", *p, 0, 0, 1, *p[:2], 7) for p in CORNERS)
        body += b"".join(struct.pack(f"{order}B{len(f)}i", len(f), *f) for f in faces)
        write("ply", f"{form}.ply", ply_header(form).encode() + body)


def make_serialized() -> None:
    """The bytes before the file are those of the target: which mesh, or that it is compressed."""
    for version, flags, real in ((3, 0x1001, "f"), (4, 0x1013, "f"), (4, 0x202B, "d")):
        body = struct.pack("<I", flags) + (b"name\0" if version == 4 else b"")
        body += struct.pack("<QQ", 4, 2)
        extra = bool(flags & 1) * 3 + bool(flags & 2) * 2 + bool(flags & 8) * 3
        body += struct.pack(f"<12{real}", *np.ravel(CORNERS))
        body += struct.pack(f"<{4 * extra}{real}", *[0.5] * (4 * extra))
        body += struct.pack("<6I", 0, 1, 2, 0, 2, 3)
        mesh = struct.pack("<HH", 0x041C, version) + zlib.compress(body)
        table = struct.pack("<QI" if version == 4 else "<II", 0, 1)
        write("serialized", f"v{version}-{flags:x}", b"\0" + mesh + table)
        write("serialized", f"raw-v{version}-{flags:x}", b"\0raw" + body)


# ---- scenes --------------------------------------------------------------------------------------


def make_vol() -> None:
    values = np.linspace(0, 1, 24, dtype=np.float32)
    for encoding, kept in ((1, values), (2, values.astype(np.float16)), (3, values * 255)):
        data = (kept.astype(np.uint8) if encoding == 3 else kept).tobytes()
        for channels, size in ((1, (2, 3, 4)), (3, (2, 2, 2))):
            header = struct.pack("<5i6f", encoding, *size, channels, 0, 0, 0, 1, 1, 1)
            write("vol", f"{encoding}-{channels}.vol", b"VOL\x03" + header + data)


def make_ies() -> None:
    for last in (0, 90, 180, 360):
        columns = [last * i // 2 for i in range(3 if last else 1)]
        numbers = [1, -1, 2, 2, len(columns), 1, 2, 0, 0, 0, 1, 1, 60, 0, 90, *columns]
        candela = range(1, 2 * len(columns) + 1)
        text = " ".join(map(str, [*numbers, *candela]))
        write("ies", f"{last}.ies", f"IESNA:LM-63-2002\n[TEST] none\nTILT=NONE\n{text}\n".encode())


def scenes_of_every_kind(encode: Callable[[str], bytes]) -> Iterator[tuple[int, bytes]]:
    """Random scenes that are short enough, each with a plug-in that those before it lack."""
    known: set[str] = set()
    for seed in range(500):
        text = random_scene(seed, size=(4, 4))
        used = set(re.findall(r'type="(\w+)"', text))
        if used <= known:
            continue
        content = encode(text)
        if len(content) <= LONGEST:
            known |= used
            yield seed, content


#: What a texture of type spectrum may be.
SPECTRA = (
    '<spectrum name="NAME" value="400:0.1, 500:0.7, 600:0.2"/>',
    '<spectrum name="NAME" filename="red.spd"/>',
    '<texture name="NAME" type="uniform"><float name="value" value="0.5"/>'
    '<float name="wavelength_min" value="400"/></texture>',
    '<texture name="NAME" type="regular"><string name="values" value="0.2, 0.9, 0.4"/></texture>',
    '<texture name="NAME" type="irregular"><string name="wavelengths" value="400, 480, 700"/>'
    '<string name="values" value="0.2, 0.9, 0.4"/></texture>',
    '<texture name="NAME" type="srgb"><rgb name="color" value="0.2, 0.5, 0.9"/></texture>',
    '<texture name="NAME" type="rgb"><rgb name="value" value="0.9, 0.1, 0.2"/></texture>',
    '<spectrum name="NAME" type="d65"><float name="scale" value="0.5"/></spectrum>',
    '<spectrum name="NAME" type="blackbody"><float name="temperature" value="3000"/>'
    '<float name="scale" value="1e-12"/></spectrum>',
)
INDICES = (
    '<string name="int_ior" value="sf11"/>',
    '<string name="int_ior" value="bk7"/><string name="ext_ior" value="water"/>',
    '<string name="int_ior" value="cauchy 1.35 60000"/>',
    '<string name="int_ior" value="sellmeier 1.0396 0.2318 1.0105 0.006 0.02 103.56"/>',
    '<string name="int_ior" value="abbe 1.6 20"/>',
    '<spectrum name="int_ior" value="400:1.7, 500:1.6, 700:1.5"/>',
    '<spectrum name="int_ior" filename="flint.spd"/>',
)
SPECTRAL_SCENE = """<scene version="3.0.0">
<sensor type="perspective">
<transform name="to_world"><lookat origin="0, 1, 4" target="0, 0.3, 0" up="0, 1, 0"/></transform>
<film type="hdrfilm"><boolean name="spectral" value="true"/><rfilter type="box"/></film>
</sensor>
<shape type="sphere"><point name="center" x="0" y="0.5" z="0"/><float name="radius" value="0.5"/>
<bsdf type="GLASS">INDEX</bsdf></shape>
<shape type="disk">
<transform name="to_world"><rotate x="1" angle="-90"/><scale value="3"/></transform>
<bsdf type="diffuse">MATT</bsdf></shape>
<shape type="sphere"><point name="center" x="1" y="2" z="1"/><float name="radius" value="0.3"/>
<emitter type="area">LIGHT</emitter></shape>
</scene>
"""


def spectral_scenes() -> Iterator[tuple[str, str]]:
    """Every kind of spectrum on a lamp and as a reflectance, every kind of glass."""
    glasses = ("dielectric", "roughdielectric", "thindielectric")
    for i, light in enumerate(SPECTRA):
        matt = SPECTRA[(i + 3) % 7]  # what comes after them is light alone
        text = SPECTRAL_SCENE.replace("GLASS", glasses[i % 3])
        text = text.replace("INDEX", INDICES[i % len(INDICES)])
        text = text.replace("LIGHT", light.replace("NAME", "radiance"))
        yield f"spectral-{i}", text.replace("MATT", matt.replace("NAME", "reflectance"))


def make_spectra() -> None:
    for name in ("red", "flint"):
        write("spectrum", f"{name}.spd", (SCENES / f"{name}.spd").read_text())
    write("spectrum", "old.spd", "\ufeff400 0.1\r700 0.5\r")
    write("spectrum", "dark.spd", "100 0\n900 0\n")


def make_scenes() -> None:
    for name in ("stage", "light-spectrum", "mitsuba-cornell-box", "glass-ball"):
        write("xml", f"{name}.xml", (SCENES / f"{name}.xml").read_text())
    write("xml", "utf16.xml", (SCENES / "glass-ball.xml").read_text().encode("utf-16"))
    for seed, text in scenes_of_every_kind(str.encode):
        write("scene", f"{seed}.xml", text)
        write("xml", f"{seed}.xml", text)

    def packed(text: str) -> bytes:
        """With the files that it names."""
        return mlt.load_string(text, directory=SCENES).__getstate__()

    for seed, tree in scenes_of_every_kind(packed):
        write("dict", str(seed), tree)
    for name, text in spectral_scenes():
        write("scene", f"{name}.xml", text)
        write("xml", f"{name}.xml", text)
        write("dict", name, packed(text))


# ---- scenes of other programs --------------------------------------------------------------------


def make_gltf() -> None:
    lit, painted, packed, glass = GltfFile(), GltfFile(), GltfFile(), GltfFile()
    for kind in ("point", "directional", "spot"):
        lit.light({"type": kind, "color": [1, 0.5, 0.2], "intensity": 6, "spot": {}})
    child = lit.node(root=False, mesh=lit.mesh(indices=None, mode=5), scale=[2, 1.5, 1])
    lit.node(translation=[0, 0.2, 0], rotation=[0, 0, 0, 1], children=[child])
    lit.camera(matrix=[1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 4, 1])
    image = painted.texture(np.full((1, 1, 4), 128), wrapS=33071, magFilter=9728)
    glow = {"KHR_materials_emissive_strength": {"emissiveStrength": 2}}
    coat = {"KHR_materials_clearcoat": {"clearcoatFactor": 1}, "KHR_materials_ior": {"ior": 1.3}}
    paint = {"alphaMode": "MASK", "emissiveFactor": [1, 1, 1], "extensions": glow | coat}
    painted.node(mesh=painted.mesh(painted.material(baseColorTexture=image, packed=image, **paint)))
    clear = {"KHR_materials_transmission": {"transmissionFactor": 1}}
    clear |= {"KHR_materials_dispersion": {"dispersion": 0.5}, "KHR_materials_ior": {"ior": 1.6}}
    for roughness in (0.0, 0.5):
        glass.node(mesh=glass.mesh(glass.material(roughness=roughness, extensions=clear)))
    indices = {"bufferView": packed.view(bytes(2)), "componentType": 5123}
    sparse = {"count": 1, "indices": indices, "values": {"bufferView": packed.view(bytes(2))}}
    codes = packed.accessor(np.full((4, 2), 255, np.uint8), normalized=True, sparse=sparse)
    packed.node(mesh=packed.mesh(uvs=codes, mode=6))
    files = {"lit": lit, "painted": painted, "packed": packed, "glass": glass}
    for name, file in files.items():
        with tempfile.TemporaryDirectory() as folder:
            for extension in ("glb", "gltf"):
                path = Path(file.save(Path(folder) / f"a.{extension}"))
                text = path.read_bytes()
                if extension == "gltf":
                    text = json.dumps(json.loads(text), separators=(",", ":")).encode()
                write("gltf", f"{name}.{extension}", text)


def make_materialx() -> None:
    """Each shader; nodes that become images; includes, units and colour spaces."""
    glow = mx.material("UsdPreviewSurface", name="U", opacity=0.5, emissiveColor=(1, 1, 1.0))
    film = {"type": "float", "value": "300", "unit": "nanometer", "unittype": "distance"}
    shaders = (
        mx.material("open_pbr_surface", base_color=(0.5, 0.2, 0.1), coat_weight=0.5),
        mx.material("standard_surface", name="S", coat=0.5, thin_film_thickness=film),
        mx.material("gltf_pbr", name="G", transmission=1.0, sheen_color=(0.2, 0.1, 0.0)),
        glow,
    )
    place = {"texcoord": mx.linked("vector2", "uv"), "rotate": 30.0, "scale": (0.5, 0.25)}
    nodes = (
        mx.node("texcoord", "uv", "vector2"),
        mx.node("place2d", "p", "vector2", **place),
        mx.image("i", "input.png", texcoord=mx.linked("vector2", "p")),
        mx.node("fractal2d", "f", "float", octaves=2, texcoord=mx.linked("vector2", "p")),
        mx.node("mix", "m", "color3", bg=mx.linked("color3", "i"), mix=mx.linked("float", "f")),
        mx.node("bump", "b", "vector3", height=mx.linked("float", "f")),
        mx.material(
            "open_pbr_surface",
            base_color=mx.linked("color3", "m"),
            specular_roughness=mx.linked("float", "f"),
            geometry_normal=mx.linked("vector3", "b"),
        ),
    )
    with tempfile.TemporaryDirectory() as folder:
        for name, elements in (
            ("shaders", shaders),
            ("nodes", nodes),
            ("include", ('<xi:include href="input.mtlx"/>', glow)),
        ):
            path = Path(mx.write(f"{folder}/a.mtlx", *elements, colorspace="acescg"))
            write("materialx", f"{name}.mtlx", path.read_bytes())


PBRT_VIEW = """LookAt 0 1 4  0 1 0  0 1 0
CoordinateSystem "a" CoordSysTransform "a"
Camera "perspective" "float fov" 40 "float lensradius" .1
Sampler "halton" "integer pixelsamples" [ 8 ]
Integrator "path" "integer maxdepth" 3
PixelFilter "box"
Film "rgb" "integer xresolution" 40 "integer yresolution" 30 # a comment
WorldBegin
"""
PBRT_LIGHTS = """LightSource "point" "rgb I" [ 6 3 1.2 ] "point3 from" [ .5 1.5 0 ]
LightSource "distant" "blackbody L" 5000 "float scale" 2
LightSource "spot" "spectrum I" [ 400 1 700 .5 ] "float coneangle" 20
LightSource "infinite" "spectrum L" "stdillum-D65"
AttributeBegin AreaLightSource "diffuse" "rgb L" [1 1 1] "bool twosided" true
Translate 0 2 0 Shape "disk" "float radius" .5 AttributeEnd
"""
PBRT_SHAPES = """Transform [1 0 0 0 0 1 0 0 0 0 1 0 0 0 0 1] Rotate 90 1 0 0 Scale 1 1 2
ReverseOrientation Shape "sphere" "float radius" 2 "float alpha" .5
Shape "trianglemesh" "point3 P" [ -2 0 -1.5  2 0 -1.5  2 0 1.5 ] "integer indices" [0 2 1]
    "normal N" [0 1 0 0 1 0 0 1 0] "point2 uv" [0 0 1 0 1 1]
Shape "bilinearmesh" "point3 P" [0 0 0 1 0 0 0 0 1 1 0 1] Shape "cylinder" "float zmin" -2
ObjectBegin "a" Shape "sphere" ObjectEnd ConcatTransform [1 0 0 0 0 1 0 0 0 0 1 0 0 0 0 1]
ObjectInstance "a" Include "none.pbrt"
"""
PBRT_MATERIALS = """Texture "a" "spectrum" "constant" "rgb value" [.1 .2 .3]
Texture "b" "spectrum" "checkerboard" "texture tex1" "a" "float uscale" 3
Texture "c" "spectrum" "scale" "texture tex" "b" "float scale" .5
MakeNamedMaterial "a" "string type" "diffuse" "texture reflectance" "c"
MakeNamedMaterial "b" "string type" "conductor" "spectrum eta" "metal-Cu-eta"
MakeNamedMaterial "c" "string type" "mix" "string materials" ["a" "b"] "float amount" .3
NamedMaterial "c" Shape "sphere"
Material "coateddiffuse" "float roughness" .1 Shape "sphere"
Material "dielectric" "float uroughness" .1 "float vroughness" .2 "spectrum eta" "glass-BK7"
Shape "sphere" Material "coatedconductor" "float interface.eta" 1.4 Shape "sphere"
"""
PBRT_SPECTRA = """LightSource "infinite" "spectrum L" "stdillum-A" "float scale" 2
LightSource "distant" "spectrum L" [ 400 .5 550 1 700 2 ] LightSource "point" "blackbody I" 2856
Texture "a" "spectrum" "constant" "spectrum value" [ 300 .1 500 .7 900 .2 ]
Material "diffuse" "spectrum reflectance" [ 400 .1 700 .6 ] Shape "sphere"
Material "dielectric" "spectrum eta" "glass-SF11" Shape "sphere"
Material "dielectric" "spectrum eta" "glass-BAF10" "float roughness" .2 Shape "sphere"
Material "thindielectric" "spectrum eta" [ 400 1.6 700 1.5 ] Shape "sphere"
Material "conductor" "spectrum eta" "metal-Au-eta" "spectrum k" "metal-Au-k" Shape "sphere"
Material "conductor" "spectrum eta" [ 400 1.6 700 .1 ] "spectrum k" [ 400 2 700 3 ] Shape "disk"
AttributeBegin AreaLightSource "diffuse" "spectrum L" "stdillum-D65" "float power" 9
Shape "disk" AttributeEnd
MakeNamedMedium "m" "string type" "homogeneous" "spectrum sigma_a" [ 400 .1 700 .2 ]
"""
PBRT_MOTION = """TransformTimes 0 2
ActiveTransform EndTime Translate 1 0 0 ActiveTransform All
Camera "orthographic" "float shutteropen" .1 "float shutterclose" .9
WorldBegin
LightSource "spot" "float power" 3 "float coneangle" 40
LightSource "infinite" "float illuminance" 2
Texture "a" "spectrum" "checkerboard" "rgb tex1" [ .1 .2 .3 ]
Texture "b" "spectrum" "mix" "texture tex1" "a" "rgb tex2" [ 0 1 0 ] "float amount" .3
Material "diffusetransmission" "texture reflectance" "b" "float scale" 2
ActiveTransform StartTime Rotate 20 0 0 1 Shape "disk" "texture alpha" "a"
ObjectBegin "o" Shape "sphere" ObjectEnd ObjectInstance "o"
"""


def make_pbrt() -> None:
    write("pbrt", "view.pbrt", PBRT_VIEW + PBRT_LIGHTS)
    write("pbrt", "shapes.pbrt", PBRT_SHAPES)
    write("pbrt", "materials.pbrt", PBRT_MATERIALS)
    write("pbrt", "spectra.pbrt", PBRT_SPECTRA)
    write("pbrt", "motion.pbrt", PBRT_MOTION)


def make_checkpoints() -> None:
    """Without their heads, which the target makes."""
    scene = mlt.load_file(FOLDER / "scene.xml", size=(4, 4))
    for name in mlt.available("integrator"):
        write("checkpoint", name, checkpoint_body(scene, name))
    for name in ("mlt", "mmlt"):
        write("checkpoint", f"spectral-{name}", checkpoint_body(scene.with_wavelengths(), name))


def checkpoint_body(scene: mlt.Scene, name: str) -> bytes:
    settings = {"type": name}
    if name in ("mlt", "pssmlt", "mmlt", "rjmlt", "erpt"):
        settings |= {"chains": 16, "luminance_samples": 16}
    if name in ("mlt", "pssmlt", "mmlt", "rjmlt"):
        settings |= {"independent_share": 0.3}
    if name == "mlt":  # each mutation makes it longer
        settings |= {"adaptive": False, "multi_chain_perturbation": False}
        settings |= {"caustic_perturbation": False, "lens_subpath_mutation": False}
        settings |= {"manifold_perturbation": False}
        settings |= {"lens_perturbation": not scene.info()["spectral"]}
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "a"
        mlt.start(scene, settings, spp=1, seed=1, checkpoint=path).wait()
        body = path.read_bytes()[28:]
    for _ in ("version", "build"):
        body = body[8 + int.from_bytes(body[:8], "little") :]
    return body


def make_words() -> None:
    """Names of plug-ins, parameters and choices, for libFuzzer to put into scenes."""
    words = set(_core.families())
    for family in _core.families():
        for name in _core.names(family):
            words.add(name)
            for parameter in _core.schema(family, name)["parameters"]:
                words |= {parameter["name"], *parameter["choices"]}
    tags = "default include ref alias scene shape rgb spectrum animation transform translate rotate"
    tags += " lookat"
    words |= set(tags.split())
    words |= {"cauchy ", "sellmeier ", "abbe ", *GLASSES}
    text = "# Made by make_corpus.py.\n" + "".join(f'"{word}"\n' for word in sorted(words))
    (FOLDER / "scene.dict").write_text(text)


if __name__ == "__main__":
    shutil.rmtree(FOLDER / "corpus", ignore_errors=True)
    make_images()
    make_exr()
    make_obj()
    make_ply()
    make_serialized()
    make_vol()
    make_ies()
    make_spectra()
    make_scenes()
    make_gltf()
    make_materialx()
    make_pbrt()
    make_checkpoints()
    make_words()
