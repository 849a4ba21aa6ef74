# SPDX-License-Identifier: GPL-3.0-or-later
"""Custom normals: those of faces that nobody touches look as before, in the scene, whatever is done beside them."""

import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parent))
import bpy  # isort: skip
import bmesh
import common
import numpy as np
import runner
from common import part

common.install(runner.arguments()[0])
# In degrees: Blender stores custom normals in 16 bits a number.
BAR = 0.1


def with_custom_normals():
    """A turned and stretched UV sphere of quads whose normals are tilted, as a modelling tool leaves them."""
    common.clear()
    obj = common.uv_sphere(32, 16)
    obj.rotation_euler, obj.scale = (0.5, 0.2, 1.0), (1.0, 1.2, 0.9)
    mesh = obj.data
    mesh.polygons.foreach_set("use_smooth", [True] * len(mesh.polygons))
    if bpy.app.version < (4, 1, 0):
        mesh.use_auto_smooth = True
    at = common.coordinates(obj)[[loop.vertex_index for loop in mesh.loops]]
    tilted = at * (1.0, 0.7, 1.5) + (0.1, 0.2, 0.0)
    mesh.normals_split_custom_set((tilted / np.linalg.norm(tilted, axis=1)[:, None]).tolist())
    bpy.context.view_layer.update()
    return obj


def seen(obj):
    """By the places of a face's corners and one of them: the normal there in the scene."""
    was = obj.mode
    if was == "EDIT":
        bpy.ops.object.mode_set(mode="OBJECT")
    normals = part("custom_normals").read(obj.data)
    assert normals is not None, "the custom normals are gone"
    turn = np.linalg.inv(np.array(obj.matrix_world)[:3, :3]).T
    made = {}
    for polygon in obj.data.polygons:
        corners = [tuple(obj.data.vertices[v].co) for v in polygon.vertices]
        for loop, corner in zip(polygon.loop_indices, corners):
            normal = turn @ normals[loop].astype(float)
            made[frozenset(corners), corner] = normal / np.linalg.norm(normal)
    if was == "EDIT":
        bpy.ops.object.mode_set(mode="EDIT")
    return made


def turned(before, after):
    """By how much the normals of faces that are there before and after are turned, in degrees."""
    kept = before.keys() & after.keys()
    return len(kept), max(np.degrees(np.linalg.norm(before[key] - after[key])) for key in kept)


def dent(obj):
    common.edit(obj)
    common.select_faces(obj, lambda face: all(v.co.z > 0.5 for v in face.verts))
    mesh = bmesh.from_edit_mesh(obj.data)
    for vertex in mesh.verts:
        if vertex.select and all(face.select for face in vertex.link_faces):
            vertex.co.z = 0.5
    bmesh.update_edit_mesh(obj.data)


def test_normals_beside_a_faired_region_stay():
    for run in (bpy.ops.mesh.fairmesh_fair, bpy.ops.mesh.fairmesh_live):
        obj = with_custom_normals()
        dent(obj)
        before = seen(obj)
        assert run() == {"FINISHED"}
        count, angle = turned(before, seen(obj))
        assert count > 1000 and angle < BAR, (count, angle)


def test_corners_that_move_have_the_normals_of_the_surface():
    obj = with_custom_normals()
    dent(obj)
    assert bpy.ops.mesh.fairmesh_fair() == {"FINISHED"}
    top = [(key[1], normal) for key, normal in seen(obj).items() if key[1][2] > 0.8]
    turn = np.linalg.inv(np.array(obj.matrix_world)[:3, :3]).T
    for place, normal in top:
        wanted = turn @ np.array(place)
        assert np.degrees(np.linalg.norm(wanted / np.linalg.norm(wanted) - normal)) < 3, place


def test_normals_around_new_faces_stay():
    for run in ("fill_holes", "erase_and_fill"):
        obj = with_custom_normals()
        if run == "fill_holes":
            common.delete_faces(obj, lambda face: face.calc_center_median().z > 0.6)
            before = seen(obj)
            common.select_boundary(obj)
        else:
            common.edit(obj)
            before = seen(obj)
            common.select_faces(obj, lambda face: face.calc_center_median().z > 0.6)
        assert getattr(bpy.ops.mesh, f"fairmesh_{run}")() == {"FINISHED"}
        after = seen(obj)
        count, angle = turned(before, after)
        assert count > 1000 and angle < BAR, (count, angle)
        # The new faces go on with them at their boundary.
        rim = {corner: normal for (_, corner), normal in before.items()}
        new = [
            (corner, normal) for (face, corner), normal in after.items() if (face, corner) not in before and corner in rim
        ]
        assert len(new) > 30
        off = [np.degrees(np.linalg.norm(rim[corner] - normal)) for corner, normal in new]
        assert max(off) < BAR, max(off)


def test_the_same_objects_stay_in_edit_mode_and_undo_is_one_step():
    obj = with_custom_normals()
    dent(obj)
    before, normals = common.coordinates(obj), seen(obj)
    # Selected beside, but not edited.
    beside = bpy.data.objects.new("beside", bpy.data.meshes.new("beside"))
    bpy.context.collection.objects.link(beside)
    beside.select_set(True)
    name = obj.name
    assert set(bpy.context.objects_in_mode) == {obj}
    bpy.ops.ed.undo_push(message="before")
    assert bpy.ops.mesh.fairmesh_fair("EXEC_DEFAULT", True) == {"FINISHED"}
    assert set(bpy.context.objects_in_mode) == {obj}
    assert set(bpy.context.selected_objects) == {obj, beside}
    bpy.ops.ed.undo()
    obj = bpy.data.objects[name]
    assert obj.mode == "EDIT" and np.array_equal(common.coordinates(obj), before)
    assert turned(normals, seen(obj))[1] < BAR


def test_a_mesh_without_custom_normals_gets_none():
    obj = common.uv_sphere(32, 16)
    dent(obj)
    assert bpy.ops.mesh.fairmesh_fair() == {"FINISHED"}
    bpy.ops.object.mode_set(mode="OBJECT")
    assert not obj.data.has_custom_normals and "fairmesh_face" not in obj.data.attributes


runner.run(sys.modules[__name__])
