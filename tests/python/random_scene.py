"""Small scenes drawn at random, with every plug-in among them: `random_scene(seed)` is XML.

Every third is plain: Mitsuba 3 has all that is in it.

File names in it are relative to FOLDER.
"""

import math
import random
from pathlib import Path

FOLDER = Path(__file__).parent / "scenes"


def tag(element: str, *content: str, **attributes) -> str:
    words = "".join(f' {key}="{value}"' for key, value in attributes.items())
    inner = "".join(content)
    return f"<{element}{words}>{inner}</{element}>\n" if inner else f"<{element}{words}/>\n"


def value(kind: str, name: str, *numbers) -> str:
    text = ", ".join(f"{n:.4g}" if isinstance(n, float) else str(n) for n in numbers)
    return tag(kind, name=name, value=text)


def point(name: str, xyz) -> str:
    return tag("point", name=name, **{k: f"{v:.4g}" for k, v in zip("xyz", xyz, strict=True)})


def random_scene(seed: int, size=(8, 6)) -> str:
    """A room of which walls may be missing, with some things and lights in it, in any order."""
    return Draw(seed).scene(*size)


class Draw:
    def __init__(self, seed: int):
        self.random = random.Random(seed)
        self.between = self.random.uniform
        # Numbers of its own, so that the scenes without motion are what they were before it.
        self.motion = random.Random(f"motion {seed}")
        self.plain = seed % 3 == 0
        self.moves = self.motion.random() < 0.3 and not self.plain
        self.fog = ""  # the medium around the lens and all lamps, if there is one

    def one_of(self, *choices) -> str:
        """What one of these makes; each is a text or makes one."""
        chosen = self.random.choice(choices)
        return chosen if isinstance(chosen, str) else chosen()

    def ours(self, *choices):
        """Those that Mitsuba 3 does not have."""
        return () if self.plain else choices

    def maybe(self, make, chance=0.5) -> str:
        return make() if self.random.random() < chance else ""

    def triple(self, low, high) -> list[float]:
        return [self.between(low, high) for _ in range(3)]

    # ---- the whole -------------------------------------------------------------------------------

    def scene(self, width: int, height: int) -> str:
        self.fog = self.maybe(self.thin_medium, 0.1)
        things = [self.thing() for _ in range(self.random.randint(1, 4))]
        lights = [self.lamp()] + [self.light() for _ in range(self.random.randint(0, 2))]
        sensors = self.sensor(width, height) + self.maybe(lambda: self.sensor(width, height), 0.2)
        parts = [*self.room(), *things, *lights, self.maybe(self.around_everything, 0.2)]
        if self.fog:
            parts = [part.replace("</emitter>", self.fog + "</emitter>") for part in parts]
        self.random.shuffle(parts)
        return tag("scene", self.integrator(), sensors, *parts, version="3.0.0")

    def integrator(self) -> str:
        depth = value("integer", "max_depth", self.random.choice([-1, -1, 2, 3, 8]))
        hide = self.maybe(lambda: value("boolean", "hide_emitters", "true"), 0.2)
        chance = 0 if self.plain else 0.2
        strict = self.maybe(lambda: value("boolean", "strict_normals", "true"), chance)
        return tag("integrator", depth, hide, strict, type="path")

    def sensor(self, width: int, height: int) -> str:
        eye = f"{self.between(-0.5, 0.5):.3g}, {self.between(-0.5, 0.5):.3g}, 3.6"
        at = tag("lookat", origin=eye, target="0, -0.2, 0", up="0, 1, 0")
        sides = value("integer", "width", width) + value("integer", "height", height)
        names = ("box", "tent", "gaussian", "mitchell", "catmullrom", "lanczos")
        part = value("integer", "crop_offset_x", 1) + value("integer", "crop_width", width - 2)
        sides += self.maybe(lambda: part, 0.1)
        chance = 0 if self.plain else 0.15
        sides += self.maybe(lambda: value("boolean", "spectral", "true"), chance)
        film = tag("film", sides, tag("rfilter", type=self.one_of(*names)), type="hdrfilm")
        film += (value("float", "shutter_close", 1) if self.moves else "") + self.fog
        common = self.to_world(at) + film + value("float", "fov", 45)
        parallel = self.to_world(tag("scale", x=1.2, y=1.2), at)
        lens = value("float", "aperture_radius", self.between(0.05, 0.5))
        lens += value("float", "focus_distance", self.between(2.0, 5.0))
        return self.one_of(
            tag("sensor", common, type="perspective"),
            tag("sensor", common, lens, type="thinlens"),
            tag("sensor", parallel, film, type="orthographic"),
        )

    def room(self) -> list[str]:
        """Each wall is a rectangle that looks inwards."""
        turns = [("x", -90), ("x", 90), ("x", 0), ("y", 90), ("y", -90)]
        chances = [1, 0.7, 0.8, 0.7, 0.7]
        places = [(0, -1, 0), (0, 1, 0), (0, 0, -1), (-1, 0, 0), (1, 0, 0)]

        def wall(turn, place):
            steps = tag("rotate", **{turn[0]: 1, "angle": turn[1]})
            steps += tag("translate", **dict(zip("xyz", place, strict=True)))
            frame = tag("transform", steps, name="to_world")
            return tag("shape", frame, self.matt(), type="rectangle")

        walls = zip(turns, places, chances, strict=True)
        return [self.maybe(lambda t=t, p=p: wall(t, p), c) for t, p, c in walls]

    def around_everything(self) -> str:
        """A surface that light passes, which holds the whole scene, or a pane that nobody sees."""
        opacity = value("float", "opacity", self.between(0, 0.3))
        veil = tag("bsdf", opacity, tag("bsdf", type="diffuse"), type="mask")
        passed = self.one_of(veil, tag("bsdf", type="null"), tag("bsdf", type="thindielectric"))
        far = tag("transform", tag("translate", x=50), name="to_world")
        ball = value("float", "radius", 20.0)
        return self.one_of(
            tag("shape", ball, passed, type="sphere"),
            tag("shape", tag("transform", tag("scale", value=20), name="to_world"), passed,
                type="cube"),
            tag("shape", far, passed, type="rectangle"),
        )  # fmt: skip

    # ---- media -----------------------------------------------------------------------------------

    def homogeneous(self, dense: float) -> str:
        """Grey or coloured."""
        coloured = self.random.random() < 0.5
        extinction = self.triple(0.2, 1) if coloured else [self.between(0, 1)] * 3
        phase = self.maybe(lambda: tag("phase", value("float", "g", self.between(-0.7, 0.8)),
                                       type="hg"))  # fmt: skip
        albedo = value("rgb", "albedo", *self.triple(0.3, 1))
        return (
            value("rgb", "sigma_t", *extinction) + value("float", "scale", dense) + albedo + phase
        )

    def thin_medium(self) -> str:
        return tag("medium", self.homogeneous(0.2), type="homogeneous")

    def cloud(self) -> str:
        """A body of a medium, without a surface or in glass; one in five holds another."""
        surface = self.one_of(tag("bsdf", type="null"), tag("bsdf", type="null"),
                              tag("bsdf", type="dielectric"))  # fmt: skip
        name = f"medium{self.random.randrange(2**30)}"
        inside = tag("medium", self.homogeneous(3), type="homogeneous", id=name)
        centre = self.triple(-0.6, 0.6)

        def body(radius, bounded):
            return tag("shape", point("center", centre), value("float", "radius", radius), surface,
                       bounded, type="sphere")  # fmt: skip

        def outside(medium):
            return medium.replace("<medium", '<medium name="exterior"') if medium else ""

        whole = body(0.4, tag("ref", name="interior", id=name) + outside(self.fog))
        core = tag("medium", self.homogeneous(3), type="homogeneous", name="interior")
        within = body(0.2, core + tag("ref", name="exterior", id=name))
        return inside + whole + self.maybe(lambda: within, 0.2)

    # ---- things ----------------------------------------------------------------------------------

    def placed(self) -> str:
        x, y, z = self.triple(-0.6, 0.6)
        turn = self.triple(-1, 1)  # of length 1, which Mitsuba 3 takes it to have
        axis = {k: v / math.hypot(*turn) for k, v in zip("xyz", turn, strict=True)}
        scale = dict(zip("xyz", self.triple(0.2, 0.5), strict=True))
        steps = tag("scale", **{k: f"{v:.3g}" for k, v in scale.items()})
        steps += tag("rotate", angle=self.random.randrange(360),
                     **{k: f"{v:.3g}" for k, v in axis.items()})  # fmt: skip
        steps += tag("translate", x=f"{x:.3g}", y=f"{y:.3g}", z=f"{z:.3g}")
        return self.to_world(steps)

    def to_world(self, *steps: str) -> str:
        """A transform; in a scene with motion half of them go on to another place."""
        if not self.moves or self.motion.random() < 0.5:
            return tag("transform", *steps, name="to_world")
        between = self.motion.uniform
        axis = {k: f"{between(-1, 1):.3g}" for k in "xyz"}
        scale = {k: f"{between(0.7, 1.4):.3g}" for k in "xyz"}
        if "lookat" in "".join(steps):
            scale = {"value": 1}
        on = tag("scale", **scale)
        turn = tag("rotate", angle=self.motion.randrange(90), **axis)
        shift = tag("translate", **{k: f"{between(-0.3, 0.3):.3g}" for k in "xyz"})
        later = on + "".join(steps) + ("" if "lookat" in "".join(steps) else turn) + shift
        return tag("animation", tag("transform", *steps, time=0),
                   tag("transform", later, time=f"{between(0.5, 2):.3g}"),
                   name="to_world")  # fmt: skip

    def ball(self, radius: float, *nested: str) -> str:
        centre = point("center", self.triple(-0.6, 0.6))
        return tag("shape", centre, value("float", "radius", radius), *nested, type="sphere")

    def copies(self) -> str:
        """Instances of a group of one or two things."""
        name = f"group{self.random.randrange(2**30)}"
        self.moves, moves = False, self.moves  # members of a group stand still in it
        members = [self.thing() for _ in range(self.random.randint(1, 2))]
        self.moves = moves
        if any("instance" in member or "<medium" in member for member in members):
            return "".join(members)
        places = [self.placed() for _ in range(self.random.randint(1, 3))]
        return tag("shape", *members, id=name, type="shapegroup") + "".join(
            tag("shape", tag("ref", id=name), place, type="instance") for place in places
        )

    def thing(self) -> str:
        def shape(name):
            return lambda: tag("shape", self.placed(), self.bsdf(), type=name)

        def mesh(name):
            file = value("string", "filename", f"bump.{name}")
            flat = self.maybe(lambda: value("boolean", "face_normals", "true"), 0.3)
            return lambda: tag("shape", file, flat, self.placed(), self.bsdf(), type=name)

        def painted():
            attribute = value("string", "name", "vertex_color")
            colours = tag("texture", attribute, name="reflectance", type="mesh_attribute")
            file = value("string", "filename", "painted.ply")
            return tag("shape", file, self.placed(), tag("bsdf", colours, type="diffuse"),
                       type="ply")  # fmt: skip

        def cylinder():
            ends = point("p0", self.triple(-0.6, 0.6)) + point("p1", self.triple(-0.6, 0.6))
            return tag("shape", ends, value("float", "radius", 0.2), self.bsdf(), type="cylinder")

        return self.one_of(
            lambda: self.ball(self.between(0.2, 0.5), self.bsdf()), shape("cube"), shape("disk"),
            shape("rectangle"), cylinder, mesh("obj"), mesh("ply"), mesh("serialized"), painted,
            self.copies, self.cloud,
        )  # fmt: skip

    # ---- materials -------------------------------------------------------------------------------

    def reflectance(self, name: str) -> str:
        def colour(name):
            return value("rgb", name, *self.triple(0.1, 0.9))

        def bitmap():
            file = value("string", "filename", "colours.png")
            wrap = value("string", "wrap_mode", self.one_of("repeat", "mirror", "clamp"))
            return tag("texture", file, wrap, name=name, type="bitmap")

        def checkerboard():
            colours = colour("color0") + colour("color1")
            scale = value("float", "uvscale", self.between(1, 5))
            more = "" if self.plain else scale
            return tag("texture", colours, more, name=name, type="checkerboard")

        def scaled():
            factor = value("float", "scale", self.between(0.2, 1.1))
            nested = self.one_of(bitmap, checkerboard).replace(f'name="{name}" ', "")
            return tag("texture", nested, factor, name=name, type="scale")

        spectrum = tag("spectrum", name=name, value="400:0.1, 500:0.7, 600:0.2, 700:0.4")
        return self.one_of(lambda: colour(name), lambda: colour(name), bitmap, checkerboard,
                           spectrum, *self.ours(scaled))  # fmt: skip

    def share(self, name: str) -> str:
        """A number from 0 to 1, or a texture of such."""
        number = value("float", name, self.between(0, 1))
        constant = number.replace(f'name="{name}"', 'name="value"')
        constant = tag("texture", constant, name=name, type="rawconstant")
        return self.one_of(number, number, constant, lambda: self.reflectance(name))

    def matt(self) -> str:
        return tag("bsdf", self.reflectance("reflectance"), type="diffuse")

    def rough(self) -> str:
        kind = value("string", "distribution", self.one_of("ggx", "beckmann"))
        return kind + value("float", "alpha", self.between(0.02, 0.6))

    def phong(self) -> str:
        exponent = value("float", "exponent", self.between(1, 300))
        return tag("bsdf", exponent, self.reflectance("diffuse_reflectance"), type="phong")

    def ward(self) -> str:
        variant = value("string", "variant", self.one_of("ward", "ward-duer", "balanced"))
        alphas = "".join(value("float", f"alpha_{k}", self.between(0.03, 0.6)) for k in "uv")
        return tag("bsdf", variant, alphas, self.reflectance("diffuse_reflectance"), type="ward")

    def clay(self) -> str:
        alpha = value("float", "alpha", self.between(0, 0.8))
        return tag("bsdf", self.reflectance("reflectance"), alpha, type="roughdiffuse")

    def principled(self, name: str, *shares: str) -> str:
        """With some of these parameters."""
        chosen = self.random.sample(shares, self.random.randint(0, len(shares)))
        content = [self.share(parameter) for parameter in chosen]
        return tag("bsdf", self.reflectance("base_color"), *content, type=name)

    def sheet(self) -> str:
        diffuse = value("float", "diff_trans", self.between(0, 2))
        sheet = self.principled("principledthin", "roughness", "anisotropic", "spec_trans", "sheen")
        return sheet.replace("</bsdf>", diffuse + "</bsdf>")

    def opaque(self) -> str:
        metal = value("string", "material", self.one_of("Ag", "Au", "Cu", "none"))
        coated = self.reflectance("diffuse_reflectance")
        return self.one_of(
            self.matt,
            *self.ours(self.phong, self.ward, self.clay),
            lambda: self.principled("principled", "roughness", "anisotropic", "metallic",
                                    "spec_tint", "sheen", "flatness", "clearcoat"),
            tag("bsdf", metal, type="conductor"),
            lambda: tag("bsdf", metal, self.rough(), type="roughconductor"),
            tag("bsdf", coated, type="plastic"),
            lambda: tag("bsdf", coated, self.rough(), type="roughplastic"),
        )  # fmt: skip

    def nested(self, levels: int) -> str:
        """Materials around materials, up to this deep."""
        return self.around(levels - 1) if levels and self.random.random() < 0.4 else self.opaque()

    def around(self, levels: int = 2) -> str:
        """A material around others."""
        bump = tag("texture", value("string", "filename", "colours.png"), type="bitmap")
        normals = bump.replace("<texture", '<texture name="normalmap"')
        height = value("float", "scale", self.between(0.01, 0.2))
        weights = value("string", "weights", self.between(0.1, 1), self.between(0.1, 1))
        absorbed = value("float", "sigma_a", self.between(0, 1))

        def inner():
            return self.nested(levels)

        null = tag("bsdf", type="null")
        return self.one_of(
            lambda: tag("bsdf", self.share("weight"), inner(), inner(), type="blendbsdf"),
            lambda: tag("bsdf", self.share("weight"), inner(), null, type="blendbsdf"),
            *self.ours(
                lambda: tag("bsdf", weights, inner(), inner(), type="mixturebsdf"),
                lambda: tag("bsdf", absorbed, self.opaque(), type="coating"),
            ),
            lambda: tag("bsdf", self.share("opacity"), inner(), type="mask"),
            lambda: tag("bsdf", bump, height, inner(), type="bumpmap"),
            lambda: tag("bsdf", normals, inner(), type="normalmap"),
        )

    def bsdf(self) -> str:
        index = value("float", "int_ior", self.between(1.1, 2.2))
        return self.one_of(
            self.opaque,
            self.opaque,
            self.around,
            self.around,
            lambda: tag("bsdf", self.opaque(), type="twosided"),
            self.sheet,
            lambda: self.principled("principled", "roughness", "anisotropic", "spec_trans",
                                    "metallic", "spec_tint", "sheen", "sheen_tint", "flatness",
                                    "clearcoat", "clearcoat_gloss"),
            tag("bsdf", index, type="thindielectric"),
            tag("bsdf", index, type="dielectric"),
            lambda: tag("bsdf", index, self.rough(), type="roughdielectric"),
            lambda: self.maybe(lambda: tag("bsdf", type="null"), 0.3),
        )  # fmt: skip

    # ---- lights ----------------------------------------------------------------------------------

    def glow(self) -> str:
        return tag("emitter", value("rgb", "radiance", *self.triple(1, 12)), type="area")

    def lamp(self) -> str:
        """Above the floor, so that no image is black."""
        steps = tag("scale", value=f"{self.between(0.1, 0.5):.3g}")
        steps += tag("rotate", x=1, angle=90) + tag("translate", y=0.98)
        return tag("shape", self.to_world(steps), self.glow(), type="rectangle")

    def odd_lamp(self) -> str:
        """Tiny, in glass, or behind a mask of its own."""
        centre = point("center", self.triple(-0.6, 0.6))

        def ball(radius, *nested):
            return tag("shape", centre, value("float", "radius", radius), *nested, type="sphere")

        opacity = value("float", "opacity", self.between(0.1, 0.9))
        masked = tag("bsdf", opacity, self.matt(), type="mask")
        glow = self.glow()
        return self.one_of(
            ball(0.01, glow),
            ball(0.1, masked, glow),
            ball(0.1, glow) + ball(0.2, tag("bsdf", type="dielectric")),
            ball(0.1, glow) + ball(0.2, tag("bsdf", self.rough(), type="roughdielectric")),
        )

    def light(self) -> str:
        colour = self.triple(0.2, 3)
        sky = value("string", "filename", self.one_of("sky.exr", "hot_sky.exr"))
        place = point("position", self.triple(-0.8, 0.8)) + value("rgb", "intensity", *colour)
        sun = tag("vector", name="direction", x=-0.3, y=-0.7, z=-1)
        day = tag("vector", name="sun_direction", x=0.3, y=0.7, z=1)
        day += value("float", "turbidity", self.between(1, 10))
        map_size = value("integer", "resolution", 16)
        above = tag("lookat", origin="0.3, 0.9, 0.8", target="0, -1, -0.2", up="0, 0, 1")
        down = self.to_world(above)
        near = [
            lambda: self.ball(self.between(0.05, 0.2), self.matt(), self.glow()),
            self.odd_lamp,
            self.odd_lamp,
            tag("emitter", place, type="point"),
            tag("emitter", down, value("rgb", "intensity", *colour), type="spot"),
            lambda: tag("emitter", down, self.reflectance("irradiance"), type="projector"),
        ]
        infinite = [
            tag("emitter", sun, value("rgb", "irradiance", *colour), type="directional"),
            tag("emitter", value("rgb", "radiance", *colour), type="constant"),
            tag("emitter", sky, type="envmap"),
            *self.ours(
                tag("emitter", day, map_size, type="sky"),
                tag("emitter", day, type="sun"),
                tag("emitter", day, map_size, type="sunsky"),
            ),
        ]
        return self.one_of(*near, *([] if self.fog else infinite))
