"""Run by Python with `bpy`: scenes rendered by the extension, most of them also by Cycles.

Writes NAME.exr and NAME-cycles.exr into a folder, with the number of the frame for what moves.
"""

import sys
from pathlib import Path

import bpy
import numpy as np
from blender_material import material

ROOT = Path(__file__).resolve().parents[2]
SIZE = 64, 36
SAMPLES = 256


def add(make, surface=None, **options):
    make(**options)
    if surface:
        bpy.context.object.data.materials.append(surface)
    return bpy.context.object


def lamp(kind, energy, location, rotation=(0, 0, 0), **values):
    bpy.ops.object.light_add(type=kind, location=location, rotation=rotation)
    for name, value in {"energy": energy, **values}.items():
        setattr(bpy.context.object.data, name, value)


def keyed(owner, name: str, values: dict, interpolation="BEZIER") -> None:
    """Gives a property other values at some frames."""
    for frame, value in values.items():
        setattr(owner, name, value)
        owner.keyframe_insert(name, frame=frame)
    action = owner.id_data.animation_data.action
    layers = getattr(action, "layers", None)
    curves = layers[0].strips[0].channelbags[0].fcurves if layers else action.fcurves
    for curve in curves:
        for key in curve.keyframe_points:
            key.interpolation = interpolation


def fresh(sky=0.0):
    """A floor below a camera, and an even sky."""
    bpy.ops.wm.read_factory_settings(use_empty=True)
    scene = bpy.context.scene
    scene.world = bpy.data.worlds.new("World")
    scene.world.use_nodes = True
    scene.world.node_tree.nodes["Background"].inputs["Strength"].default_value = sky
    add(bpy.ops.mesh.primitive_plane_add, material("floor", Base_Color=(0.6, 0.4, 0.3, 1)), size=8)
    bpy.ops.object.camera_add(location=(0, -7, 4), rotation=(1.05, 0, 0))
    scene.camera = bpy.context.object


def cube():
    bpy.ops.wm.read_factory_settings()


def glass():
    fresh(sky=0.3)
    clear = material("glass", Transmission_Weight=1.0, Roughness=0.0, Base_Color=(0.7, 0.9, 1, 1))
    ball = add(bpy.ops.mesh.primitive_uv_sphere_add, clear, location=(0, 0, 1.2))
    ball.data.shade_smooth()
    lamp("SUN", 2.0, (0, 0, 5), (0.4, 0.3, 0), angle=0.0)


def instances():
    """A collection that is placed twice, once mirrored; an array; metal; coloured lamps."""
    fresh(sky=0.2)
    metal = material("metal", Metallic=1.0, Roughness=0.4, Base_Color=(0.9, 0.6, 0.2, 1))
    cone = add(bpy.ops.mesh.primitive_cone_add, metal, radius1=0.5, depth=1, location=(0, 0, 0.5))
    cone.modifiers.new("Array", "ARRAY").count = 2
    group = bpy.data.collections.new("cones")
    group.objects.link(cone)
    bpy.context.scene.collection.objects.unlink(cone)
    for x, mirror in ((-1.5, 1), (1.5, -1)):
        bpy.ops.object.collection_instance_add(collection="cones", location=(x, 0, 0))
        bpy.context.object.scale.x = mirror
    lamp("AREA", 100, (2, -2, 3), (0.6, 0.5, 0), shape="RECTANGLE", size=1.0, size_y=0.5)
    lamp("POINT", 60, (-2, -1, 3), color=(1, 0.5, 0.3), shadow_soft_size=0.2)


def textured():
    """A picture on the floor, one of the surroundings, a spot, and a camera that is shifted."""
    fresh()
    y, x = np.mgrid[0:16, 0:32] / 16
    sky = bpy.data.images.new("sky", 32, 16, float_buffer=True)
    sky.pixels.foreach_set(np.stack([x, y, 2 - x, np.ones_like(x)], 2).astype("f").ravel())
    checks = bpy.data.images.new("checks", 16, 16)
    tile = np.stack([x, y, x * y, np.ones_like(x)], 2)[:, :16].astype("f")
    checks.pixels.foreach_set(tile.ravel())
    tree = bpy.context.scene.world.node_tree
    background = tree.nodes["Background"]
    background.inputs["Strength"].default_value = 0.5
    surroundings = tree.nodes.new("ShaderNodeTexEnvironment")
    surroundings.image = sky
    turn = tree.nodes.new("ShaderNodeMapping")
    turn.inputs["Rotation"].default_value = (0.2, 0.3, 0.7)
    place = tree.nodes.new("ShaderNodeTexCoord")
    tree.links.new(place.outputs["Generated"], turn.inputs["Vector"])
    tree.links.new(turn.outputs["Vector"], surroundings.inputs["Vector"])
    tree.links.new(surroundings.outputs["Color"], background.inputs["Color"])
    floor = bpy.data.materials["floor"].node_tree
    image = floor.nodes.new("ShaderNodeTexImage")
    image.image = checks
    mapping = floor.nodes.new("ShaderNodeMapping")
    mapping.inputs["Scale"].default_value = (2, 1, 1)
    uv = floor.nodes.new("ShaderNodeTexCoord")
    floor.links.new(uv.outputs["UV"], mapping.inputs["Vector"])
    floor.links.new(mapping.outputs["Vector"], image.inputs["Vector"])
    target = floor.nodes["Principled BSDF"].inputs["Base Color"]
    floor.links.new(image.outputs["Color"], target)
    beam = {"spot_size": 0.8, "spot_blend": 0.5, "shadow_soft_size": 0.0}
    lamp("SPOT", 500, (1, 0, 4), (0.1, 0.2, 0), **beam)
    bpy.context.scene.camera.data.shift_x = 0.2
    bpy.context.scene.camera.data.shift_y = -0.1


def lettering():
    """A text that glows beside a ball of two shaders, through a lens that is shifted."""
    fresh(sky=0.3)
    glow = material("glow", Emission_Color=(1, 0.9, 0.8, 1), Emission_Strength=3.0)
    text = add(bpy.ops.object.text_add, glow, location=(0, -1, 0.5), rotation=(1.2, 0, 0))
    text.data.body, text.data.extrude = "Hi", 0.1
    both = material("both")
    tree = both.node_tree
    mix, glossy = (tree.nodes.new(f"Shader{name}") for name in ("NodeMixShader", "NodeBsdfGlossy"))
    mix.inputs[0].default_value = 0.4
    tree.links.new(tree.nodes["Principled BSDF"].outputs[0], mix.inputs[1])
    tree.links.new(glossy.outputs[0], mix.inputs[2])
    tree.links.new(mix.outputs[0], tree.nodes["Material Output"].inputs["Surface"])
    add(bpy.ops.mesh.primitive_uv_sphere_add, both, location=(-1.5, 0, 1))
    camera = bpy.context.scene.camera.data
    camera.shift_y, camera.dof.use_dof = -0.1, True
    camera.dof.focus_distance, camera.dof.aperture_fstop = 6.0, 0.2


def grouped():
    """Two balls of one group of shaders, with other colours, and a floor whose colour is one."""
    fresh(sky=0.3)
    inner = bpy.data.node_groups.new("shader", "ShaderNodeTree")
    for name, kind in (("Tint", "Color"), ("Roughness", "Float"), ("IOR", "Float")):
        inner.interface.new_socket(name, in_out="INPUT", socket_type=f"NodeSocket{kind}")
    inner.interface.new_socket("BSDF", in_out="OUTPUT", socket_type="NodeSocketShader")
    begin, end, principled = (
        inner.nodes.new(name)
        for name in ("NodeGroupInput", "NodeGroupOutput", "ShaderNodeBsdfPrincipled")
    )
    for given, socket in (("Tint", "Base Color"), ("Roughness", "Roughness"), ("IOR", "IOR")):
        inner.links.new(begin.outputs[given], principled.inputs[socket])
    inner.links.new(principled.outputs[0], end.inputs[0])
    for x, colour in ((-1.2, (0.8, 0.1, 0.1, 1)), (1.2, (0.1, 0.2, 0.8, 1))):
        made = material("grouped")
        group = made.node_tree.nodes.new("ShaderNodeGroup")
        group.node_tree = inner
        values(group, Tint=colour, Roughness=0.3, IOR=2.0)
        end = made.node_tree.nodes["Material Output"].inputs["Surface"]
        made.node_tree.links.new(group.outputs[0], end)
        add(bpy.ops.mesh.primitive_uv_sphere_add, made, location=(x, 0, 1))
    tone = bpy.data.node_groups.new("tone", "ShaderNodeTree")
    tone.interface.new_socket("Color", in_out="OUTPUT", socket_type="NodeSocketColor")
    colour, end = (tone.nodes.new(name) for name in ("ShaderNodeRGB", "NodeGroupOutput"))
    colour.outputs[0].default_value = (0.2, 0.6, 0.3, 1)
    tone.links.new(colour.outputs[0], end.inputs[0])
    tree = bpy.data.materials["floor"].node_tree
    group = tree.nodes.new("ShaderNodeGroup")
    group.node_tree = tone
    tree.links.new(group.outputs[0], tree.nodes["Principled BSDF"].inputs["Base Color"])
    lamp("AREA", 150, (2, -2, 4), (0.5, 0.4, 0), size=1.5)


def foggy():
    """A box of fog, scattered and absorbed by two nodes, and a ball of a principled volume."""
    fresh(sky=0.3)
    fog, smoke = material("fog"), material("smoke")
    for made in (fog, smoke):
        made.node_tree.nodes.remove(made.node_tree.nodes["Principled BSDF"])
    tree = fog.node_tree
    both, scatter, absorb = (
        tree.nodes.new(f"ShaderNode{name}")
        for name in ("AddShader", "VolumeScatter", "VolumeAbsorption")
    )
    values(scatter, Color=(0.8, 0.9, 1, 1), Density=0.8, Anisotropy=0.4)
    values(absorb, Color=(0.9, 0.6, 0.3, 1), Density=0.5)
    for i, node in enumerate((scatter, absorb)):
        tree.links.new(node.outputs[0], both.inputs[i])
    tree.links.new(both.outputs[0], tree.nodes["Material Output"].inputs["Volume"])
    add(bpy.ops.mesh.primitive_cube_add, fog, size=1.6, location=(-1, 0, 1))
    tree = smoke.node_tree
    node = tree.nodes.new("ShaderNodeVolumePrincipled")
    values(node, Color=(0.9, 0.7, 0.5, 1), Density=2.0, Anisotropy=-0.2)
    tree.links.new(node.outputs[0], tree.nodes["Material Output"].inputs["Volume"])
    add(bpy.ops.mesh.primitive_uv_sphere_add, smoke, radius=0.8, location=(1.2, 0, 1.1))
    lamp("AREA", 150, (2, -2, 4), (0.5, 0.4, 0), size=1.5)


def values(node, **inputs):
    for name, value in inputs.items():
        node.inputs[name].default_value = value


def cutout():
    """A text that glows, a box that half of the light passes, and a lamp, all before nothing."""
    fresh(sky=0.5)
    glow = material("glow", Emission_Color=(1, 0.9, 0.8, 1), Emission_Strength=3.0)
    text = add(bpy.ops.object.text_add, glow, location=(-1, -1, 1.2), rotation=(1.2, 0, 0))
    text.data.body, text.data.extrude = "Hi", 0.1
    bpy.data.objects["Plane"].scale = (0.3, 0.3, 1)
    lamp("POINT", 100, (1.5, 0, 1.5), shadow_soft_size=0.4)
    half = material("half", Alpha=0.5)
    add(bpy.ops.mesh.primitive_cube_add, half, size=1, location=(0.5, -1.5, 0.8))
    bpy.context.scene.render.film_transparent = True


def moving():
    """A cube that glows and goes to the right by two metres a frame; the shutter is open."""
    fresh()
    glow = material("glow", Emission_Color=(1, 1, 1, 1), Emission_Strength=1.0)
    cube = add(bpy.ops.mesh.primitive_cube_add, glow, size=0.8)
    keyed(cube, "location", {1: (-2, 0, 0.5), 3: (2, 0, 0.5)}, "LINEAR")
    bpy.context.scene.render.use_motion_blur = True
    bpy.context.scene.render.motion_blur_shutter = 1.0
    bpy.context.scene.frame_start, bpy.context.scene.frame_end = 1, 3


def render(path, engine, size=SIZE, **how):
    scene = bpy.context.scene
    scene.render.engine = engine
    scene.render.resolution_x, scene.render.resolution_y = size
    scene.render.resolution_percentage = 100
    scene.cycles.samples = SAMPLES
    scene.cycles.volume_bounces = 12
    scene.cycles.use_denoising = scene.cycles.use_adaptive_sampling = False
    scene.pymlt.integrator, scene.pymlt.samples = "path", SAMPLES
    scene.pymlt.time = scene.pymlt.error = 0
    scene.render.threads_mode, scene.render.threads = "FIXED", 1
    image = scene.render.image_settings
    image.file_format, image.color_mode = "OPEN_EXR", "RGBA"
    scene.render.filepath = str(path)
    bpy.ops.render.render(**(how or {"write_still": True}))


def part(folder):
    """The middle of the default cube's picture, alone."""
    cube()
    border = bpy.context.scene.render
    border.use_border = border.use_crop_to_border = True
    border.border_min_x, border.border_max_x = 0.25, 0.75
    border.border_min_y, border.border_max_y = 0.5, 1.0
    render(folder / "part.exr", "PYMLT")


def main(folder: Path) -> None:
    sys.path.insert(0, str(ROOT))
    import blender

    blender.register()
    for make in (cube, glass, instances, textured, lettering, grouped, foggy, cutout):
        make()
        for engine, name in (("PYMLT", make.__name__), ("CYCLES", f"{make.__name__}-cycles")):
            render(folder / f"{name}.exr", engine)
    part(folder)
    moving()
    for engine, name in (("PYMLT", "moving"), ("CYCLES", "moving-cycles")):
        render(folder / f"{name}#.exr", engine, animation=True)


if __name__ == "__main__":
    main(Path(sys.argv[1]))
