"""BSDF values and densities by Mitsuba 3, for test_bsdf_mitsuba.cpp: mitsuba_values.inc.

    python tests/cpp/scene/bsdf/mitsuba_values.py > tests/cpp/scene/bsdf/mitsuba_values.inc

Needs the PyPI package `mitsuba` (made with 3.9.1).
"""

import math

import mitsuba as mi
import numpy as np

mi.set_variant("scalar_rgb")

PINK = {"type": "rgb", "value": [0.8, 0.3, 0.4]}
PINK_DIFFUSE = {"type": "diffuse", "reflectance": PINK}
TILTED = {"type": "rgb", "value": [0.7, 0.4, 0.9]}


def cases():
    yield "diffuse", {"type": "diffuse", "reflectance": PINK}
    yield "plastic", {"type": "plastic", "diffuse_reflectance": PINK}
    yield (
        "plastic nonlinear",
        {"type": "plastic", "diffuse_reflectance": PINK, "nonlinear": True, "int_ior": 1.9},
    )
    for kind in ("beckmann", "ggx"):
        rough = {"distribution": kind}
        for alpha in (0.1, 0.5):
            label = f"{kind} {alpha:.2f}"
            rough["alpha"] = alpha
            yield (
                f"roughconductor {label}",
                {"type": "roughconductor", "material": "Au", **rough},
            )
            yield f"roughdielectric {label}", {"type": "roughdielectric", **rough}
            yield f"roughplastic {label}", {"type": "roughplastic", **rough}
        yield (
            f"roughconductor {kind} anisotropic",
            {"type": "roughconductor", "distribution": kind, "alpha_u": 0.05, "alpha_v": 0.4},
        )
        yield (
            f"roughdielectric {kind} all normals",
            {
                "type": "roughdielectric",
                "distribution": kind,
                "alpha": 0.3,
                "int_ior": 1.2,
                "ext_ior": 1.7,
                "sample_visible": False,
            },
        )
        yield (
            f"roughplastic {kind} all normals",
            {
                "type": "roughplastic",
                "distribution": kind,
                "alpha": 0.3,
                "nonlinear": True,
                "diffuse_reflectance": 0.9,
            },
        )
    yield "normalmap", {"type": "normalmap", "normalmap": TILTED, "nested": PINK_DIFFUSE}
    yield (
        "normalmap of roughconductor",
        {
            "type": "normalmap",
            "normalmap": TILTED,
            "nested": {"type": "roughconductor", "alpha_u": 0.2, "alpha_v": 0.5, "material": "Au"},
        },
    )
    principled = {"type": "principled", "base_color": PINK}
    yield "principled", dict(principled)
    yield (
        "principled metal",
        principled | {"metallic": 0.7, "roughness": 0.3, "anisotropic": 0.8, "spec_tint": 0.4},
    )
    yield (
        "principled cloth",
        principled
        | {"sheen": 0.8, "sheen_tint": 0.6, "flatness": 0.4, "roughness": 0.9, "specular": 0.2},
    )
    yield (
        "principled coated",
        principled | {"clearcoat": 0.9, "clearcoat_gloss": 0.3, "roughness": 0.6, "eta": 1.7},
    )
    yield (
        "principled glass",
        principled | {"spec_trans": 0.8, "metallic": 0.1, "eta": 1.4, "spec_tint": 0.5},
    )
    thin = {"type": "principledthin", "base_color": PINK}
    yield "principledthin", dict(thin)
    yield (
        "principledthin leaf",
        thin
        | {
            "spec_trans": 0.4,
            "diff_trans": 0.7,
            "eta": 1.3,
            "anisotropic": 0.5,
            "roughness": 0.6,
            "spec_tint": 0.3,
            "sheen": 0.5,
            "sheen_tint": 0.7,
            "flatness": 0.6,
        },
    )


def unit(v):
    return np.asarray(v, float) / np.linalg.norm(v)


def partners(wc, rough, rng):
    """Directions near the mirrored and the refracted one, and one anywhere above."""
    spread = 0.3 * rough
    yield unit(wc * [-1, -1, 1] + rng.normal(size=3) * spread)
    yield unit(-wc + rng.normal(size=3) * spread)
    z = rng.uniform(0.1, 1)
    phi = rng.uniform(0, 2 * math.pi)
    yield np.array([math.sqrt(1 - z * z) * math.cos(phi), math.sqrt(1 - z * z) * math.sin(phi), z])


def rows(label, scene_dict, rng):
    bsdf = mi.load_dict(scene_dict)
    context = mi.BSDFContext()
    interaction = mi.SurfaceInteraction3f()
    interaction.n = [0, 0, 1]
    interaction.sh_frame = mi.Frame3f([1, 0, 0], [0, 1, 0], [0, 0, 1])
    two_sided = any(name in label for name in ("dielectric", "glass", "thin"))
    for wc in ([0.3, -0.2, 0.9], [-0.8, 0.3, 0.35], [0.2, 0.4, -0.8]):
        wc = unit(wc)
        if wc[2] < 0 and not two_sided:
            continue
        for wl in partners(wc, scene_dict.get("alpha", 0.5), rng):
            if abs(wl[2]) < 0.05:
                continue
            interaction.wi = mi.Vector3f(*wc)
            value, density = bsdf.eval_pdf(context, interaction, mi.Vector3f(*wl))
            f = np.array(value) / abs(wl[2])
            if not f.any():
                continue
            numbers = [*wl, *wc, *f]
            light, camera, rgb = (
                ", ".join(f"{x:.9g}" for x in numbers[i : i + 3]) for i in (0, 3, 6)
            )
            yield f'{{"{label}", {{{light}}}, {{{camera}}}, {{{rgb}}}, {density:.9g}}},'


def main():
    print("// Written by mitsuba_values.py: label, wl, wc, f, density of wl given wc.")
    rng = np.random.default_rng(1)
    for label, scene_dict in cases():
        for row in rows(label, dict(scene_dict), rng):
            print(row)


if __name__ == "__main__":
    main()
