# SPDX-License-Identifier: GPL-3.0-or-later
"""Join Loops and Fair, Bridge Edges and Fair, Erase and Fill, and which holes are filled, end to end."""

import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parent))
import bpy  # isort: skip
import bmesh
import common
import numpy as np
import runner
from common import boundary_edges, coordinates, delete_faces, edit, irregular_sphere, select_boundary, select_faces

BAR = 1e-5
common.install(runner.arguments()[0])
join = bpy.ops.mesh.fairmesh_join_loops
erase = bpy.ops.mesh.fairmesh_erase_and_fill
bridge = bpy.ops.mesh.fairmesh_bridge
fill = bpy.ops.mesh.fairmesh_fill_holes


def band_missing(frequency=20):
    """An irregular unit sphere without a band around its equator, in Edit mode."""
    obj = irregular_sphere(frequency)
    delete_faces(obj, lambda f: abs(f.calc_center_median().z) < 0.3)
    return obj


def check_whole_sphere(obj):
    """Closed, of genus 0, on the unit sphere; selected are the new faces."""
    mesh = bmesh.from_edit_mesh(obj.data)
    assert not boundary_edges(obj)
    assert all(e.is_manifold and e.is_contiguous for e in mesh.edges)
    assert len(mesh.verts) - len(mesh.edges) + len(mesh.faces) == 2
    assert np.abs(np.linalg.norm(coordinates(obj), axis=1) - 1).max() < BAR


def test_a_sphere_without_a_band_is_joined():
    obj = band_missing()
    before, faces = coordinates(obj), len(obj.data.polygons)
    select_boundary(obj)
    assert join() == {"FINISHED"}
    check_whole_sphere(obj)
    assert np.array_equal(coordinates(obj)[: len(before)], before)
    mesh = bmesh.from_edit_mesh(obj.data)
    selected = [f for f in mesh.faces if f.select]
    assert len(selected) == len(mesh.faces) - faces > 100
    assert all(abs(f.calc_center_median().z) < 0.4 for f in selected)


def test_a_sphere_in_four_pieces_is_joined():
    obj = irregular_sphere(30)
    delete_faces(obj, lambda f: min(abs(c) for v in f.verts for c in v.co[:2]) < 0.04)
    select_boundary(obj)
    join()
    check_whole_sphere(obj)


def test_loops_that_belong_together_are_found():
    for call in (lambda: join(groups="AUTO"), lambda: fill(scope="ALL", join=True)):
        common.clear()
        obj = band_missing()
        call()
        check_whole_sphere(obj)
    # Two holes far from each other do not.
    common.clear()
    obj = irregular_sphere(20)
    delete_faces(obj, lambda f: abs(f.calc_center_median().z) > 0.95)
    runner.raises(lambda: join(groups="AUTO"), "No two loops have a common patch")
    fill(scope="ALL", join=True)
    check_whole_sphere(obj)


def test_a_part_that_is_turned_around_is_refused_with_both_loops():
    obj = band_missing()
    edit(obj)
    select_faces(obj, lambda f: f.calc_center_median().z < 0)
    bpy.ops.mesh.flip_normals()
    edit(obj, "EDGE")
    select_boundary(obj)
    before = coordinates(obj)
    ends = {v.index for e in boundary_edges(obj) for v in e.verts}
    runner.raises(join, "faced the other way", "loops 0 and 1", "Mesh > Normals > Flip")
    assert np.array_equal(coordinates(obj), before)
    bpy.ops.mesh.fairmesh_select_found()
    assert {v.index for v in bmesh.from_edit_mesh(obj.data).verts if v.select} == ends


def test_two_loops_are_needed():
    obj = band_missing()
    runner.raises(join, "Select two or more boundary loops", "Shift-Alt-click", "Ctrl-J")
    select_boundary(obj, lambda e: e.verts[0].co.z > 0)
    runner.raises(join, "Select two or more boundary loops")
    # One edge of the other one is enough then.
    other = next(e for e in boundary_edges(obj) if e.verts[0].co.z < 0)
    other.select_set(True)
    join()
    check_whole_sphere(obj)


def test_attributes_are_carried_on_and_undo_takes_it_back():
    obj = irregular_sphere(20)
    mesh = obj.data
    uv = mesh.uv_layers.new(name="UVMap")
    for loop in mesh.loops:
        uv.data[loop.index].uv = (0.25, 0.5)
    for name in "ab":
        mesh.materials.append(bpy.data.materials.new(name))
    for polygon in mesh.polygons:
        polygon.material_index = 1
        polygon.use_smooth = True
    obj.shape_key_add(name="Basis")
    key = obj.shape_key_add(name="Moved")
    key.data.foreach_set("co", (coordinates(obj) + [0, 0, 2]).astype(np.float32).ravel())
    obj.active_shape_key_index = 0
    name = obj.name
    for call in ("join", "erase"):
        edit(obj, "FACE")
        if call == "join":
            delete_faces(obj, lambda f: abs(f.calc_center_median().z) < 0.3)
            select_boundary(obj)
        else:
            select_faces(obj, lambda f: f.calc_center_median().x > 0.8)
        count = len(coordinates(obj))
        bpy.ops.ed.undo_push(message="before")
        (join if call == "join" else erase)("EXEC_DEFAULT", True)
        check_whole_sphere(obj)
        after = len(coordinates(obj))
        bpy.ops.ed.undo()
        obj = bpy.data.objects[name]
        assert len(coordinates(obj)) == count
        bpy.ops.ed.redo()
        obj = bpy.data.objects[name]
        assert len(coordinates(obj)) == after
        bpy.ops.object.mode_set(mode="OBJECT")
        mesh = obj.data
        assert all(p.use_smooth and p.material_index == 1 for p in mesh.polygons)
        assert all(abs(each.uv[0] - 0.25) < 1e-6 and abs(each.uv[1] - 0.5) < 1e-6 for each in mesh.uv_layers[0].data)
        keys = mesh.shape_keys.key_blocks
        flat = np.array([each.co[:] for each in keys["Moved"].data]) - np.array([each.co[:] for each in keys["Basis"].data])
        assert np.abs(flat - [0, 0, 2]).max() < 1e-6


def bumpy(frequency=20):
    """An irregular sphere whose cap z > 0.85 is noise; selected are the faces there."""
    obj = irregular_sphere(frequency)
    random = np.random.default_rng(3)
    positions = coordinates(obj)
    cap = positions[:, 2] > 0.85
    positions[cap] *= random.uniform(0.8, 1.2, (cap.sum(), 1))
    common.move(obj, positions)
    edit(obj)
    noise = set(np.flatnonzero(cap).tolist())
    select_faces(obj, lambda f: any(v.index in noise for v in f.verts))
    return obj


def test_a_bump_is_erased_and_filled():
    obj = bumpy()
    faces = len([f for f in bmesh.from_edit_mesh(obj.data).faces if not f.select])
    assert erase() == {"FINISHED"}
    check_whole_sphere(obj)
    # But for some that would have hung loose.
    mesh = bmesh.from_edit_mesh(obj.data)
    assert faces - 10 < len([f for f in mesh.faces if not f.select]) <= faces


def test_quads_go_as_a_whole():
    obj = common.uv_sphere(32, 16)
    edit(obj)
    select_faces(obj, lambda f: 0 < f.calc_center_median().x and abs(f.calc_center_median().z) < 0.3)
    # A quad that would hang at the rest by one edge.
    quad = next(f for f in bmesh.from_edit_mesh(obj.data).faces if f.select and f.calc_center_median().x > 0.9)
    quad.select_set(False)
    bmesh.update_edit_mesh(obj.data)
    erase()
    mesh = bmesh.from_edit_mesh(obj.data)
    assert not boundary_edges(obj) and all(e.is_manifold for e in mesh.edges)
    assert len(mesh.verts) - len(mesh.edges) + len(mesh.faces) == 2
    assert np.abs(np.linalg.norm(coordinates(obj), axis=1) - 1).max() < 1e-3


def test_one_triangle_is_erased_and_comes_back():
    obj = irregular_sphere(8)
    before = coordinates(obj)
    edit(obj)
    select_faces(obj, lambda f: f.index == 100)
    erase()
    assert not boundary_edges(obj) and np.array_equal(coordinates(obj), before)


def test_what_cannot_be_erased_stays():
    obj = irregular_sphere(12)
    delete_faces(obj, lambda f: f.calc_center_median().z < 0.85)
    edit(obj)
    runner.raises(erase, "No face is selected")
    select_faces(obj, lambda f: any(e.is_boundary for e in f.edges) and f.calc_center_median().x > 0)
    before = coordinates(obj)
    runner.raises(erase, "outer boundary", "Outer boundaries, Too", "The mesh is unchanged")
    bpy.ops.mesh.select_all(action="SELECT")
    runner.raises(erase, "nothing is left around the selected faces")
    assert np.array_equal(coordinates(obj), before)


def select_runs(obj, half=0.25):
    """Two runs of boundary edges that face each other."""
    for edge in boundary_edges(obj):
        if edge.verts[0].co.x > 0 and max(abs(v.co.y) for v in edge.verts) < half:
            edge.select_set(True)
    bmesh.update_edit_mesh(obj.data)


def test_a_bridge_between_two_runs_of_edges():
    obj = band_missing()
    before = coordinates(obj)
    select_runs(obj)
    assert bridge() == {"FINISHED"}
    mesh = bmesh.from_edit_mesh(obj.data)
    assert len(coordinates(obj)) > len(before) and np.array_equal(coordinates(obj)[: len(before)], before)
    assert all(e.is_contiguous for e in mesh.edges if len(e.link_faces) == 2)
    # A tube closed at both ends with a hole in its side.
    assert len(mesh.verts) - len(mesh.edges) + len(mesh.faces) == 1
    common.clear()
    obj = band_missing()
    select_runs(obj)
    bridge(fill_rest=True)
    check_whole_sphere(obj)


def test_what_is_no_pair_of_runs_is_not_bridged():
    obj = band_missing()
    for chosen in (lambda e: False, lambda e: e.verts[0].co.z > 0, lambda e: True):
        bpy.ops.mesh.select_all(action="DESELECT")
        select_boundary(obj, chosen)
        runner.raises(bridge, "Select two runs of boundary edges")


def test_which_holes_of_all():
    def left(**options):
        common.clear()
        obj = irregular_sphere(20)
        delete_faces(obj, lambda f: f.calc_center_median().z > 0.8 or f.calc_center_median().z < -0.97)
        obj.scale = (2, 2, 2)
        bpy.context.view_layer.update()
        fill(scope="ALL", smooth=False, **options)
        return {e.verts[0].co.z > 0 for e in boundary_edges(obj)}

    assert left() == set()
    assert left(except_longest=1) == {True}
    # The lower one is about 2 pi 2 0.25 long, the upper one 2 pi 2 0.6.
    assert left(max_length=5.0) == {True}


def test_what_is_not_fair_stays_open_on_demand():
    obj = band_missing()
    select_boundary(obj)
    before = coordinates(obj)
    runner.raises(lambda: join(max_iterations=1, on_failure="OPEN"), "no fair patch was found")
    assert np.array_equal(coordinates(obj), before)
    join(max_iterations=1)
    assert not boundary_edges(obj)


if __name__ == "__main__":
    runner.run(sys.modules[__name__])
