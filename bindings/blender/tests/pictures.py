# SPDX-License-Identifier: GPL-3.0-or-later
"""The README's picture: zebra stripes of one dented mesh, after Blender's Fair Tangency, and after Fair Selection.

    target/blender/bpy-4.2/bin/python bindings/blender/tests/pictures.py ZIP FOLDER

Cycles on the CPU. Stripes are reflections of a striped room: where they kink the normals jump, where they have corners the
curvature does.
"""

import subprocess
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parent))
import bpy  # isort: skip
import common
import numpy as np
from compare import fair_selection, fair_tangency

WIDTH, HEIGHT = 480, 400


def zebra():
    """A material that shows stripes by the direction of the reflected ray."""
    material = bpy.data.materials.new("zebra")
    material.use_nodes = True
    tree = material.node_tree
    tree.nodes.clear()
    place, parts = tree.nodes.new("ShaderNodeTexCoord"), tree.nodes.new("ShaderNodeSeparateXYZ")
    tree.links.new(place.outputs["Reflection"], parts.inputs[0])
    value = parts.outputs["Z"]
    for operation, operand in (("MULTIPLY", 24.0), ("SINE", 0.0), ("MULTIPLY_ADD", 6.0)):
        node = tree.nodes.new("ShaderNodeMath")
        node.operation = operation
        node.use_clamp = operation == "MULTIPLY_ADD"
        tree.links.new(value, node.inputs[0])
        node.inputs[1].default_value = operand
        node.inputs[2].default_value = 0.5
        value = node.outputs[0]
    emission, output = tree.nodes.new("ShaderNodeEmission"), tree.nodes.new("ShaderNodeOutputMaterial")
    tree.links.new(value, emission.inputs["Color"])
    tree.links.new(emission.outputs[0], output.inputs["Surface"])
    return material


def set_scene():
    """Camera, background, Cycles."""
    scene = bpy.context.scene
    scene.render.engine = "CYCLES"
    scene.cycles.device = "CPU"
    scene.cycles.samples = 16
    scene.render.resolution_x, scene.render.resolution_y = WIDTH, HEIGHT
    scene.view_settings.view_transform = "Standard"
    scene.world.node_tree.nodes["Background"].inputs[0].default_value = (0.25, 0.25, 0.27, 1)
    camera = bpy.data.objects.new("camera", bpy.data.cameras.new("camera"))
    camera.location = (0, -5.2, 2.6)
    camera.rotation_euler = (np.arctan2(5.2, 2.45), 0, 0)
    camera.data.lens = 70
    bpy.context.collection.objects.link(camera)
    scene.camera = camera


def render(obj, path):
    if obj.mode != "OBJECT":
        bpy.ops.object.mode_set(mode="OBJECT")
    obj.data.polygons.foreach_set("use_smooth", np.ones(len(obj.data.polygons), bool))
    obj.data.materials.clear()
    obj.data.materials.append(zebra())
    set_scene()
    bpy.context.scene.render.filepath = str(path)
    bpy.ops.render.render(write_still=True)


def main():
    zip_path, folder = sys.argv[1:]
    folder = Path(folder)
    folder.mkdir(exist_ok=True, parents=True)
    common.install(zip_path)
    names = []
    for name, run in (("before", lambda obj: None), ("tangency", fair_tangency), ("fair", fair_selection)):
        common.clear()
        obj = common.irregular_sphere(57)
        common.flatten_cap(obj)
        run(obj)
        names.append(folder / f"{name}.png")
        render(obj, names[-1])
    subprocess.run(["convert", *map(str, names), "+append", "-colors", "64", str(folder / "zebra.png")], check=True)


main()
