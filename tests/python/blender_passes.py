"""Run by Python with `bpy`: which passes Blender sees in a file, by layer; "" is the first one."""

import json
import sys
from pathlib import Path

import bpy

source, target, *layers = sys.argv[1:]
node = bpy.data.node_groups.new("passes", "CompositorNodeTree").nodes.new("CompositorNodeImage")
node.image = bpy.data.images.load(source)
passes = {}
for layer in ["", *layers]:
    if layer:
        node.layer = layer
    passes[layer] = {output.name: output.type for output in node.outputs if output.enabled}
Path(target).write_text(json.dumps(passes))
