# SPDX-License-Identifier: GPL-3.0-or-later
"""The manual's pictures: before and after each operator, and zebra stripes beside those of Blender's Fair Tangency.

    target/blender/bpy-4.2/bin/python bindings/blender/tests/pictures.py ZIP FOLDER

Cycles on the CPU. Stripes are reflections of a striped room: where they kink the normals jump, where they have corners the
curvature does. What is new is orange.
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


def material(name, color):
    """A matte material with a little shine."""
    made = bpy.data.materials.new(name)
    made.use_nodes = True
    shader = made.node_tree.nodes["Principled BSDF"]
    shader.inputs["Base Color"].default_value = (*color, 1)
    shader.inputs["Roughness"].default_value = 0.45
    return made


def zebra():
    """A material that shows stripes by the direction of the reflected ray."""
    made = bpy.data.materials.new("zebra")
    made.use_nodes = True
    tree = made.node_tree
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
    emit(tree, value)
    return made


def painted():
    """A material that shows the colours of Show Curvature."""
    made = bpy.data.materials.new("painted")
    made.use_nodes = True
    tree = made.node_tree
    tree.nodes.clear()
    colors = tree.nodes.new("ShaderNodeAttribute")
    colors.attribute_name = "Mean Curvature"
    emit(tree, colors.outputs["Color"])
    return made


def emit(tree, value):
    emission, output = tree.nodes.new("ShaderNodeEmission"), tree.nodes.new("ShaderNodeOutputMaterial")
    tree.links.new(value, emission.inputs["Color"])
    tree.links.new(emission.outputs[0], output.inputs["Surface"])


def set_scene():
    """Camera, light, background, Cycles."""
    scene = bpy.context.scene
    scene.render.engine = "CYCLES"
    scene.cycles.device = "CPU"
    scene.cycles.samples = 8
    scene.render.resolution_x, scene.render.resolution_y = WIDTH, HEIGHT
    scene.view_settings.view_transform = "Standard"
    scene.world.node_tree.nodes["Background"].inputs[0].default_value = (0.25, 0.25, 0.27, 1)
    camera = bpy.data.objects.new("camera", bpy.data.cameras.new("camera"))
    camera.location = (0, -5.2, 2.6)
    camera.rotation_euler = (np.arctan2(5.2, 2.45), 0, 0)
    camera.data.lens = 70
    bpy.context.collection.objects.link(camera)
    scene.camera = camera
    sun = bpy.data.objects.new("sun", bpy.data.lights.new("sun", "SUN"))
    sun.data.energy = 3
    sun.rotation_euler = (0.7, 0.5, 0)
    bpy.context.collection.objects.link(sun)


def render(obj, path, materials):
    if obj.mode != "OBJECT":
        bpy.ops.object.mode_set(mode="OBJECT")
    obj.data.polygons.foreach_set("use_smooth", np.ones(len(obj.data.polygons), bool))
    obj.data.materials.clear()
    for each in materials:
        obj.data.materials.append(each)
    # The second one for what is to be replaced, or is new.
    selected = np.empty(len(obj.data.polygons), bool)
    obj.data.polygons.foreach_get("select", selected)
    obj.data.polygons.foreach_set("material_index", (selected * (len(materials) - 1)).astype(np.int32))
    set_scene()
    bpy.context.scene.render.filepath = str(path)
    bpy.ops.render.render(write_still=True)


def append(names, path):
    subprocess.run(["convert", *map(str, names), "+append", "-colors", "64", str(path)], check=True)


def beside_fair_tangency(folder):
    names = []
    for name, run in (("before", lambda obj: None), ("tangency", fair_tangency), ("after", fair_selection)):
        common.clear()
        obj = common.irregular_sphere(57)
        common.flatten_cap(obj)
        run(obj)
        names.append(folder / f"{name}.png")
        render(obj, names[-1], [zebra()])
    append(names, folder / "zebra.png")


def dent():
    obj = common.irregular_sphere(40)
    common.flatten_cap(obj)
    return obj


def above(point, at):
    return point.z > 0 and np.hypot(point.x - at[0], point.y - at[1]) < 0.3


def holes():
    bpy.ops.mesh.primitive_torus_add(major_segments=72, minor_segments=36, major_radius=0.8, minor_radius=0.4)
    obj = bpy.context.object
    for x, y in ((0.3, -0.9), (-0.75, -0.3)):
        common.delete_faces(obj, lambda f, at=(x, y): above(f.calc_center_median(), at))
    common.select_boundary(obj)
    return obj


def mouths():
    parts = (
        (0.45, (-1.3, 0, -0.2), (-0.6, 0, -0.1)),
        (0.3, (1.2, 0, -0.5), (0.6, 0, -0.2)),
        (0.25, (0.2, 0, 1.1), (0.1, 0, 0.65)),
    )
    obj = common.tubes(*parts)
    common.select_boundary(obj, lambda e: abs(e.verts[0].co.x) < 0.8 and e.verts[0].co.z < 0.9)
    return obj


def runs():
    obj = common.tubes((0.5, (-1.3, 0, 0), (-0.5, 0, 0)), (0.5, (1.3, 0, 0.2), (0.5, 0, 0)))
    common.select_boundary(obj, lambda e: all(abs(v.co.x) < 0.7 and v.co.y < -0.2 and v.co.z > -0.2 for v in e.verts))
    return obj


def bump():
    obj = common.irregular_sphere(40)
    random = np.random.default_rng(3)
    positions = common.coordinates(obj)
    middle = np.array([0.3, -0.75, 0.6])
    near = np.linalg.norm(positions - middle / np.linalg.norm(middle), axis=1) < 0.45
    positions[near] *= random.uniform(0.9, 1.25, (near.sum(), 1))
    common.move(obj, positions)
    common.edit(obj)
    noise = set(np.flatnonzero(near).tolist())
    common.select_faces(obj, lambda f: any(v.index in noise for v in f.verts))
    return obj


def fill_and_show():
    bpy.ops.mesh.fairmesh_fill_holes()
    bpy.ops.mesh.fairmesh_show_curvature(middle="MEDIAN")


# Before, and what is done.
OPERATORS = (
    ("fair", dent, lambda: bpy.ops.mesh.fairmesh_fair()),
    ("fill", holes, lambda: bpy.ops.mesh.fairmesh_fill_holes()),
    ("join", mouths, lambda: bpy.ops.mesh.fairmesh_join_loops()),
    ("bridge", runs, lambda: bpy.ops.mesh.fairmesh_bridge()),
    ("erase", bump, lambda: bpy.ops.mesh.fairmesh_erase_and_fill()),
    ("curvature", holes, fill_and_show),
)


def before_and_after(folder, name, make, run):
    names = []
    for done in (False, True):
        common.clear()
        obj = make()
        if done:
            run()
        names.append(folder / f"{name}_{done}.png")
        plain = [material("old", (0.55, 0.57, 0.6)), material("new", (0.85, 0.33, 0.05))]
        render(obj, names[-1], [painted(), painted()] if done and name == "curvature" else plain)
    append(names, folder / f"{name}.png")


def main():
    zip_path, folder, *only = sys.argv[1:]
    folder = Path(folder)
    folder.mkdir(exist_ok=True, parents=True)
    common.install(zip_path)
    if not only or "zebra" in only:
        beside_fair_tangency(folder)
    for name, make, run in OPERATORS:
        if not only or name in only:
            before_and_after(folder, name, make, run)


main()
# The module bpy may crash at the end of a process.
common.leave(0)
