"""Values of OpenPBR by MaterialX, for test_openpbr_values.cpp: openpbr_values.inc.

    python tests/cpp/scene/bsdf/openpbr_values.py > tests/cpp/scene/bsdf/openpbr_values.inc

Needs the PyPI package `materialx` (made with 1.39.5, Apache-2.0), g++ and GLM: MaterialX writes its
graph of `open_pbr_surface`, the specification's reference, as GLSL, which is compiled as C++.
"""

import re
import subprocess
import sys
import tempfile
from pathlib import Path

import MaterialX
from MaterialX import PyMaterialXGenGlsl, PyMaterialXGenShader

PINK, BLUE, GOLD = (0.8, 0.3, 0.4), (0.5, 0.7, 0.9), (0.9, 0.7, 0.3)
METAL = {"base_metalness": 1.0, "base_color": GOLD, "specular_color": BLUE}
CASES = {
    "default": {},
    "rough": {"specular_roughness": 0.8, "base_color": PINK},
    "dense": {"specular_ior": 2.0, "specular_roughness": 0.5, "base_color": PINK},
    "clay": {"base_diffuse_roughness": 1.0, "base_color": PINK},
    "metal": METAL | {"specular_roughness": 0.3},
    "rough metal": METAL | {"specular_roughness": 0.8},
    "stretched metal": METAL | {"specular_roughness": 0.5, "specular_roughness_anisotropy": 0.7},
    "coated": {"coat_weight": 1.0, "coat_roughness": 0.3, "base_color": PINK, "coat_color": BLUE},
    "coated metal": METAL | {"coat_weight": 0.6, "coat_roughness": 0.4, "coat_darkening": 0.0},
    "fuzz": {"fuzz_weight": 1.0, "base_color": PINK},
    "dust": {"fuzz_weight": 0.8, "fuzz_roughness": 0.9, "fuzz_color": BLUE, "base_color": PINK},
    "film": {"thin_film_weight": 1.0, "thin_film_thickness": 0.4, "base_color": (0.0, 0.0, 0.0)},
}
#: Unit vectors up to their length, towards the camera and towards the light.
CAMERA = [(0.1, 0.05, 1.0), (0.7, 0.1, 0.7), (0.9, -0.2, 0.3)]
LIGHT = [(0.0, 0.3, 1.0), (-0.6, -0.1, 0.8), (0.5, 0.6, 0.5), (-0.9, 0.1, 0.3)]


def shader() -> str:
    document = MaterialX.createDocument()
    path = MaterialX.getDefaultDataSearchPath()
    MaterialX.loadLibraries(MaterialX.getDefaultDataLibraryFolders(), path, document)
    surface = document.addNode("open_pbr_surface", "s", "surfaceshader")
    context = PyMaterialXGenShader.GenContext(PyMaterialXGenGlsl.GlslShaderGenerator.create())
    context.registerSourceCodeSearchPath(path)
    options = context.getOptions()
    none = PyMaterialXGenShader.HwSpecularEnvironmentMethod.SPECULAR_ENVIRONMENT_NONE
    options.hwSpecularEnvironmentMethod = none
    options.hwMaxActiveLightSources = 1
    complete = PyMaterialXGenShader.ShaderInterfaceType.SHADER_INTERFACE_COMPLETE
    options.shaderInterfaceType = complete
    made = PyMaterialXGenGlsl.GlslShaderGenerator.create().generate("s", surface, context)
    return made.getSourceCode(PyMaterialXGenShader.PIXEL_STAGE)


def as_cpp(code: str) -> str:
    """GLSL in which the one light is `the_light` and no environment shines."""
    code = re.sub(r"#version.*", "", code)
    code = re.sub(r"\bin VertexData\n", "struct VertexData\n", code)
    code = re.sub(r"\buniform ", "static ", code)
    code = re.sub(r"^out vec4", "static vec4", code, flags=re.M)
    code = re.sub(r"\b(?:in)?out (\w+) (\w+)", r"\1& \2", code)
    code = re.sub(r"([(,] *)in (\w+ \w+)", r"\1\2", code)
    code = code.replace("result.intensity = vec3(0.000000, 0.000000, 0.000000);",
                        "result.intensity = vec3(1);")  # fmt: skip
    code = code.replace("result.direction = vec3(0.000000, 0.000000, 0.000000);",
                        "result.direction = the_light;")  # fmt: skip
    code = re.sub(r"\.(xy|zw|xyz|rgb)\b", r".\1()", code)
    for more in ("occlusion * ", ""):  # what environments and what is behind would add
        code = code.replace(f"shader_constructor_out.color += {more}fuzz_layer_out.response;", "")
    code = code.replace("void main()", "void shade()")
    return HEAD + code


HEAD = """
#define GLM_FORCE_SWIZZLE
#include <glm/glm.hpp>
#include <cstdio>
using namespace glm;
struct sampler2D {};
inline vec4 texture(sampler2D, vec2) { return vec4(0); }
inline vec4 textureLod(sampler2D, vec2, float) { return vec4(0); }
inline float fwidth(vec3) { return 1; }
static bool u_refractionTwoSided = false;
static vec3 the_light;
"""


def row(label: str, given: dict, light: tuple, camera: tuple) -> str:
    """Code that prints f for one pair of directions: the light's part over its cosine."""
    sets = "".join(
        f"{name} = vec3({', '.join(map(repr, v))});" if isinstance(v, tuple) else f"{name} = {v!r};"
        for name, v in given.items()
    )
    directions = (f"normalize(vec3({', '.join(map(repr, v))}))" for v in (light, camera))
    sets += "the_light = {}; u_viewPosition = {};".format(*directions)
    pair = ", ".join(f"{{{', '.join(map(str, v))}}}" for v in (light, camera))
    return (
        f"{{{sets} const vec3 f = response();"
        f'std::printf("{{\\"{label}\\", {pair}, {{%.6g, %.6g, %.6g}}}},\\n", f.x, f.y, f.z);}}'
    )


def main() -> None:
    code = shader()
    defaults = "".join(
        f"{name} = {value};"
        for name, value in re.findall(r"^uniform \w+ (\w+) = (.*);", code, flags=re.M)
    )
    rows = "".join(
        f"reset(); {row(label, given, light, camera)}"
        for label, given in CASES.items()
        for camera in CAMERA
        for light in LIGHT
    )
    body = f"""
static void reset() {{
  {defaults}
  u_numActiveLightSources = 1;
  vd.normalWorld = vec3(0, 0, 1);
  vd.tangentWorld = vec3(1, 0, 0);
  vd.positionWorld = vec3(0);
}}
static vec3 response() {{ shade(); return vec3(out1) / the_light.z; }}
int main() {{ {rows} }}
"""
    with tempfile.TemporaryDirectory() as folder:
        source = Path(folder) / "shader.cpp"
        source.write_text(as_cpp(code) + body)
        program = Path(folder) / "shader"
        command = [
            "g++",
            "-std=gnu++20",
            "-O1",
            "-w",
            "-fpermissive",
            "-fsingle-precision-constant",
            str(source),
            "-o",
            str(program),
        ]
        subprocess.run(command, check=True)
        print(
            "// Written by openpbr_values.py from MaterialX 1.39.5 (Apache-2.0): label, wl, wc, f."
        )
        print(subprocess.run([program], check=True, capture_output=True, text=True).stdout, end="")


if __name__ == "__main__":
    sys.exit(main())
