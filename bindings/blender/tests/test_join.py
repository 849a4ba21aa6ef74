# SPDX-License-Identifier: GPL-3.0-or-later
"""Join Loops and Fair, Bridge Edges and Fair, Erase and Fill, and which holes are filled, end to end."""

import sys
import unittest.mock
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parent))
import bpy  # isort: skip
import bmesh
import common
import numpy as np
import runner
from common import boundary_edges, coordinates, delete_faces, edit, irregular_sphere, part, select_boundary, select_faces
from mathutils.bvhtree import BVHTree

BAR = 1e-5
common.install(runner.arguments()[0])
join = bpy.ops.mesh.fairmesh_join_loops
erase = bpy.ops.mesh.fairmesh_erase_and_fill
bridge = bpy.ops.mesh.fairmesh_bridge
fill = bpy.ops.mesh.fairmesh_fill_holes
fill_all = bpy.ops.mesh.fairmesh_fill_all_holes


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


def test_loops_that_belong_together_are_found():
    for call in (lambda: join(groups="AUTO"), lambda: fill_all(join=True)):
        common.clear()
        obj = band_missing()
        bpy.ops.mesh.select_all(action="SELECT")
        call()
        check_whole_sphere(obj)
    # Two holes far from each other do not.
    common.clear()
    obj = irregular_sphere(20)
    delete_faces(obj, lambda f: abs(f.calc_center_median().z) > 0.95)
    bpy.ops.mesh.select_all(action="SELECT")
    runner.raises(lambda: join(groups="AUTO"), "No two loops have a common patch")
    fill_all(join=True)
    check_whole_sphere(obj)


def test_a_part_that_is_turned_around_is_refused_with_both_loops():
    obj = band_missing()
    edit(obj)
    select_faces(obj, lambda f: f.calc_center_median().z < 0)
    bpy.ops.mesh.flip_normals()
    edit(obj, "EDGE")
    select_boundary(obj)
    before = coordinates(obj)
    ends = {v.index for v in rim(obj)}
    runner.raises(join, "faced the other way", "the loops at vertices", "Mesh > Normals > Flip")
    assert np.array_equal(coordinates(obj), before)
    bpy.ops.mesh.fairmesh_select_found()
    assert {v.index for v in bmesh.from_edit_mesh(obj.data).verts if v.select} == ends


def cylinders(gap, angle=0.0):
    """Two of Blender's own cylinders, their ends so many radii apart along an arc that turns so much: the facing loops."""
    radius = gap / angle if angle else 0.0
    end = np.array([radius * (1 - np.cos(angle)), 0, 1 + radius * np.sin(angle)]) if angle else np.array([0, 0, 1.0 + gap])
    axis = np.array([np.sin(angle), 0, np.cos(angle)])
    for place, turn in (((0, 0, 0), 0.0), (end + axis, angle)):
        bpy.ops.mesh.primitive_cylinder_add(end_fill_type="NOTHING", location=place, rotation=(0, turn, 0))
    bpy.ops.object.select_all(action="SELECT")
    bpy.ops.object.join()
    obj = bpy.context.object
    edit(obj, "EDGE")
    ends = [np.linalg.inv(np.array(obj.matrix_world)) @ [*place, 1] for place in ((0, 0, 1), end)]
    select_boundary(obj, lambda e: min(np.linalg.norm(np.array(e.verts[0].co) - at[:3]) for at in ends) < 1.01)
    return obj


def new_faces(obj):
    return [face for face in bmesh.from_edit_mesh(obj.data).faces if face.select]


def widths(obj):
    """Half the way through the patch, from each of its vertices."""
    mesh = bmesh.from_edit_mesh(obj.data)
    mesh.normal_update()
    tree = BVHTree.FromBMesh(mesh)
    inner = [v for v in mesh.verts if v.select and all(face.select for face in v.link_faces)]
    hits = [tree.ray_cast(v.co - 1e-4 * v.normal, -v.normal)[3] for v in inner]
    return np.array([hit for hit in hits if hit is not None]) / 2


def test_default_cylinders_are_joined_by_rows_of_quads():
    for gap in range(1, 7):
        common.clear()
        obj = cylinders(gap)
        assert join() == {"FINISHED"}
        faces = new_faces(obj)
        assert all(len(face.verts) == 4 for face in faces) and len(faces) % 32 == 0 and len(faces) > 100 * gap, len(faces)
        points = np.array([v.co[:] for face in faces for v in face.verts])
        radius = np.linalg.norm(points[:, :2], axis=1)
        assert np.abs(radius - 1).max() < 2e-3, (gap, radius.min(), radius.max())
        # The columns go on from those of the cylinders.
        columns = np.degrees(np.arctan2(points[:, 1], points[:, 0])) / 11.25
        assert np.abs(columns - columns.round()).max() < 0.01


def test_elbows_keep_their_width():
    for gap, degrees, least in ((1, 30, 0.99), (2, 60, 0.97), (3, 90, 0.86), (3, 30, 0.98), (6, 60, 0.98), (6, 90, 0.92)):
        common.clear()
        obj = cylinders(gap, np.radians(degrees))
        assert join() == {"FINISHED"}
        assert all(len(face.verts) == 4 for face in new_faces(obj)), (gap, degrees)
        assert widths(obj).min() > least, (gap, degrees, widths(obj).min())
    for gap in (3, 4, 5):
        common.clear()
        obj = cylinders(gap, np.radians(90))
        assert join(target="MINIMAL_ENERGY") == {"FINISHED"}
        assert widths(obj).min() > 0.99, (gap, widths(obj).min())


def test_faces_are_what_is_asked_for():
    obj = cylinders(2)
    assert join(faces="TRIANGLES") == {"FINISHED"}
    assert {len(face.verts) for face in new_faces(obj)} == {3}
    # In a hole there are no rows: pairs of triangles.
    for faces, least in (("AUTO", 0.0), ("QUADS", 0.5)):
        common.clear()
        obj = common.uv_sphere(48, 24)
        delete_faces(obj, lambda f: f.calc_center_median().x > 0.5)
        select_boundary(obj)
        others = len(bmesh.from_edit_mesh(obj.data).faces)
        assert fill(faces=faces) == {"FINISHED"}
        mesh = bmesh.from_edit_mesh(obj.data)
        corners = [len(face.verts) for face in mesh.faces if face.select]
        assert len(mesh.faces) == others + len(corners)
        share = corners.count(4) / len(corners)
        assert share >= least and (share > 0) == (faces == "QUADS"), share
        check_whole_sphere(obj)


def test_two_loops_are_needed():
    obj = band_missing()
    runner.raises(join, "Nothing is selected: select two or more boundary loops", "Shift-Alt-click")
    select_boundary(obj, lambda e: e.verts[0].co.z > 0)
    runner.raises(join, "One loop alone is selected, or none: select two or more boundary loops", "Ctrl-J")
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
    delete_faces(obj, lambda f: f.calc_center_median().z < 0.9)
    edit(obj)
    runner.raises(erase, "No face is selected: select the faces that are to be replaced")
    next(iter(bmesh.from_edit_mesh(obj.data).verts)).select_set(True)
    runner.raises(erase, "No face is selected")
    select_faces(obj, lambda f: any(e.is_boundary for e in f.edges) and f.calc_center_median().x > 0)
    before = coordinates(obj)
    runner.raises(erase, "outer boundary", "Outer Boundaries, Too", "The mesh is unchanged")
    bpy.ops.mesh.select_all(action="SELECT")
    runner.raises(erase, "Nothing is left around the selected faces")
    assert np.array_equal(coordinates(obj), before)


def select_runs(obj, half=0.25):
    """Two runs of boundary edges that face each other."""
    select_boundary(obj, lambda e: e.verts[0].co.x > 0 and max(abs(v.co.y) for v in e.verts) < half)


def rim(obj):
    """The vertices on the boundary."""
    return {v for e in boundary_edges(obj) for v in e.verts}


def opposite(obj):
    """Two vertices that face each other across the equator, by their numbers."""
    return [max(rim(obj), key=lambda v: v.co.x * (v.co.z * side > 0)).index for side in (1, -1)]


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
    runner.raises(bridge, "select two runs of boundary edges")
    for chosen in (lambda e: e.verts[0].co.z > 0, lambda e: True):
        select_boundary(obj, chosen)
        runner.raises(bridge, "Whole loops", "Join Loops and Fair")


def test_a_bridge_of_a_width_from_single_vertices():
    obj = band_missing()
    edit(obj, "VERT")
    select_in_order(obj, opposite(obj), is_known=False)
    runner.raises(bridge, "These are not two runs of edges")
    assert bridge(width=0.5, fill_rest=True) == {"FINISHED"}
    check_whole_sphere(obj)


def slit():
    """An irregular unit sphere with a narrow slit, in vertex mode; and two vertices that face each other across it."""
    obj = irregular_sphere(20)
    delete_faces(obj, lambda f: all(abs(v.co.z) < 0.12 and v.co.x > 0.3 for v in f.verts))
    edit(obj, "VERT")
    return obj, opposite(obj)


def select_in_order(obj, vertices, is_known=True):
    """Selects vertices, by their numbers, one after the other or in no order that is known."""
    mesh = bmesh.from_edit_mesh(obj.data)
    bpy.ops.mesh.select_all(action="DESELECT")
    mesh.select_history.clear()
    mesh.verts.ensure_lookup_table()
    for index in vertices:
        mesh.verts[index].select_set(True)
        if is_known:
            mesh.select_history.add(mesh.verts[index])
    bmesh.update_edit_mesh(obj.data)


def test_pairs_of_vertices_are_connected():
    obj, pair = slit()
    # Two need no order.
    select_in_order(obj, pair, is_known=False)
    assert fill(guides=True) == {"FINISHED"}
    check_whole_sphere(obj)


def test_pairs_are_those_selected_one_after_the_other():
    obj, _ = slit()
    along = sorted((v.co.y, v.co.z > 0, v.index) for v in rim(obj))
    above, below = ([index for _, up, index in along if up == side] for side in (True, False))
    # Each with the one across.
    order = [above[3], below[3], below[-4], above[-4]]
    select_in_order(obj, order)
    library = part("fairmesh")
    with unittest.mock.patch.object(library, "fill_holes", wraps=library.fill_holes) as called:
        fill(guides=True)
        assert called.call_args.kwargs["guides"].tolist() == [order[:2], order[2:]]
    check_whole_sphere(obj)


def test_pairs_that_are_none_are_told():
    obj, pair = slit()
    before = coordinates(obj)
    select_in_order(obj, pair[:1])
    runner.raises(lambda: fill(guides=True), "Connect Pairs: select pairs of boundary vertices", "1 is selected")
    # Four, but not one after the other.
    select_in_order(obj, sorted(v.index for v in rim(obj))[:4], is_known=False)
    runner.raises(lambda: fill(guides=True), "Connect Pairs", "0 of them one by one")
    # Two that have an edge between them already.
    select_in_order(obj, [v.index for v in boundary_edges(obj)[0].verts])
    runner.raises(lambda: fill(guides=True), "The mesh is unchanged")
    assert np.array_equal(coordinates(obj), before)


def test_pairs_on_two_loops_that_are_joined():
    obj = band_missing()
    edit(obj, "VERT")
    select_in_order(obj, opposite(obj))
    assert join(guides=True) == {"FINISHED"}
    check_whole_sphere(obj)


def rough():
    """An irregular sphere without a cap, whose rim is noise, with UVs, weights, colours and a shape key, in Edit mode."""
    obj = irregular_sphere(20)
    positions = coordinates(obj)
    noise = np.random.default_rng(2).normal(0, 0.012, len(positions)) * (positions[:, 2] > 0.55)
    common.move(obj, positions * (1 + noise)[:, None])
    mesh = obj.data
    uv = mesh.uv_layers.new(name="UVMap")
    for loop in mesh.loops:
        uv.data[loop.index].uv = mesh.vertices[loop.vertex_index].co.xy
    group = obj.vertex_groups.new(name="weights")
    mesh.attributes.new("paint", "FLOAT_COLOR", "POINT")
    for vertex in mesh.vertices:
        group.add([vertex.index], float(vertex.index % 7) / 7, "REPLACE")
        mesh.attributes["paint"].data[vertex.index].color = (vertex.index % 5 / 5, 0.5, 0.25, 1)
    delete_faces(obj, lambda f: f.calc_center_median().z > 0.75)
    return obj


def carried(obj, count):
    """What the first vertices carry, and the corners of their faces by vertex."""
    mesh = obj.data
    uv = mesh.uv_layers[0].data
    corners = {(p.index, v): tuple(uv[c].uv) for p in mesh.polygons for c, v in zip(p.loop_indices, p.vertices)}
    weights = [[(g.group, g.weight) for g in v.groups] for v in mesh.vertices[:count]]
    colors = [tuple(each.color) for each in list(mesh.attributes["paint"].data)[:count]]
    return corners, weights, colors


def test_a_rough_rim_is_smoothed_and_undo_is_one_step():
    obj = rough()
    name = obj.name
    bpy.ops.object.mode_set(mode="OBJECT")
    count = len(obj.data.vertices)
    before = carried(obj, count)
    edit(obj, "EDGE")
    start = coordinates(obj)
    select_boundary(obj)
    bpy.ops.ed.undo_push(message="before")
    fill("EXEC_DEFAULT", True)
    assert np.array_equal(coordinates(obj)[:count], start)
    bpy.ops.ed.undo()
    obj = bpy.data.objects[name]
    assert fill("EXEC_DEFAULT", True, relax_rim=4) == {"FINISHED"}
    after = coordinates(obj)
    moved = (after[:count] != start).any(axis=1)
    assert moved.sum() > 100 and start[moved, 2].min() > 0.4
    normals_are_right(obj)
    bpy.ops.ed.undo()
    assert np.array_equal(coordinates(bpy.data.objects[name]), start)
    bpy.ops.ed.redo()
    obj = bpy.data.objects[name]
    assert np.array_equal(coordinates(obj), after)
    bpy.ops.object.mode_set(mode="OBJECT")
    corners, weights, colors = carried(obj, count)
    assert before[1:] == (weights, colors)
    assert all(corners[key] == value for key, value in before[0].items())


def test_the_rim_moves_no_further_than_asked_in_the_scene():
    for scale in (1.0, 4.0):
        common.clear()
        obj = rough()
        obj.scale = (scale,) * 3
        bpy.context.view_layer.update()
        start = coordinates(obj)
        select_boundary(obj)
        fill(relax_rim=4, relax_within=0.004)
        how_far = scale * np.linalg.norm(coordinates(obj)[: len(start)] - start, axis=1).max()
        assert abs(how_far - 0.004) < 1e-5, how_far


def test_hidden_vertices_of_a_rim_stay():
    obj = rough()
    mesh = bmesh.from_edit_mesh(obj.data)
    outer = rim(obj)
    second = next(o for v in outer for e in v.link_edges for o in [e.other_vert(v)] if o not in outer)
    for face in second.link_faces:
        if not outer & set(face.verts):
            face.hide_set(True)
    second.hide = True
    bmesh.update_edit_mesh(obj.data)
    assert mesh.is_valid
    start = coordinates(obj)
    select_boundary(obj)
    runner.raises(lambda: fill(relax_rim=4), "would move that are hidden", "Smooth Rim", "The mesh is unchanged")
    assert np.array_equal(coordinates(obj), start)


def add_fins(obj, *sides):
    """A fin of one face at a boundary edge above (1) or below (-1) the equator; then in the mode of edges."""
    mesh = bmesh.from_edit_mesh(obj.data)
    for side in sides:
        edge = next(e for e in boundary_edges(obj) if e.verts[0].co.z * side > 0)
        tip = mesh.verts.new((edge.verts[0].co + edge.verts[1].co) * 0.65)
        mesh.faces.new([edge.link_loops[0].link_loop_next.vert, edge.link_loops[0].vert, tip])
    bmesh.update_edit_mesh(obj.data)
    bpy.ops.object.mode_set(mode="OBJECT")
    edit(obj, "EDGE")
    return obj


def ragged():
    """An irregular sphere with two holes, and a fin at each."""
    obj = irregular_sphere(20)
    delete_faces(obj, lambda f: abs(f.calc_center_median().z) > 0.9)
    return add_fins(obj, 1, -1)


def test_what_spoils_the_boundary_is_trimmed_at_the_holes_that_are_filled():
    obj = ragged()
    select_boundary(obj, lambda e: e.verts[0].co.z > 0)
    assert fill(trim=20) == {"FINISHED"}
    outside = [v.co.z for v in bmesh.from_edit_mesh(obj.data).verts if v.co.length > 1.1]
    assert len(outside) == 1 and outside[0] < 0
    assert boundary_edges(obj) and all(e.verts[0].co.z < 0 for e in boundary_edges(obj))
    assert fill_all(trim=20) == {"FINISHED"}
    check_whole_sphere(obj)
    normals_are_right(obj)


def test_trimming_before_loops_are_joined_and_undone_in_one_step():
    obj = add_fins(band_missing(), 1)
    name, before = obj.name, coordinates(obj)
    select_boundary(obj)
    bpy.ops.ed.undo_push(message="before")
    assert join("EXEC_DEFAULT", True, trim=20) == {"FINISHED"}
    check_whole_sphere(obj)
    bpy.ops.ed.undo()
    assert np.array_equal(coordinates(bpy.data.objects[name]), before)


def test_slivers_beside_erased_faces_go():
    obj = irregular_sphere(20)
    edit(obj)
    select_faces(obj, lambda f: f.calc_center_median().z > 0.85)
    mesh = bmesh.from_edit_mesh(obj.data)
    # A vertex next to the selection is drawn onto an edge of it: slivers.
    rim = [e for e in mesh.edges if len([f for f in e.link_faces if f.select]) == 1]
    face = next(f for f in rim[0].link_faces if not f.select)
    tip = next(v for v in face.verts if v not in rim[0].verts)
    tip.co = tip.co * 0.03 + (rim[0].verts[0].co + rim[0].verts[1].co) * 0.485
    bmesh.update_edit_mesh(obj.data)
    count = len([f for f in mesh.faces if not f.select])
    assert erase(clean_boundary=5) == {"FINISHED"}
    mesh = bmesh.from_edit_mesh(obj.data)
    assert len([f for f in mesh.faces if not f.select]) < count
    assert not boundary_edges(obj) and all(e.is_manifold for e in mesh.edges)


def test_a_trimmed_hole_that_stays_open_keeps_its_faces():
    obj = ragged()
    before = coordinates(obj)
    select_boundary(obj, lambda e: e.verts[0].co.z > 0)
    runner.raises(lambda: fill(trim=20, max_iterations=1, on_failure="OPEN"), "no patch was found that is fair", "unchanged")
    assert np.array_equal(coordinates(obj), before)


def normals_are_right(obj):
    """Those that the edit mesh has are those of its faces and vertices as they are."""
    mesh = bmesh.from_edit_mesh(obj.data)
    kept = np.array([f.normal[:] for f in mesh.faces]), np.array([v.normal[:] for v in mesh.verts])
    mesh.normal_update()
    assert np.array_equal(kept[0], [f.normal[:] for f in mesh.faces])
    assert np.array_equal(kept[1], [v.normal[:] for v in mesh.verts])
    assert (np.linalg.norm(kept[0], axis=1) > 0.99).all()


def test_normals_are_right_at_once_after_every_operator():
    def selected_rims():
        obj = band_missing()
        select_boundary(obj)
        return obj

    def selected_runs():
        obj = band_missing()
        select_runs(obj)
        return obj

    for make, operator in ((selected_rims, join), (selected_rims, fill), (selected_runs, bridge), (bumpy, erase)):
        common.clear()
        obj = make()
        assert operator() == {"FINISHED"}
        normals_are_right(obj)


def test_which_holes_of_all():
    def left(**options):
        common.clear()
        obj = irregular_sphere(20)
        delete_faces(obj, lambda f: f.calc_center_median().z > 0.8 or f.calc_center_median().z < -0.97)
        obj.scale = (2, 2, 2)
        bpy.context.view_layer.update()
        fill_all(smooth=False, **options)
        return {e.verts[0].co.z > 0 for e in boundary_edges(obj)}

    assert left() == set()
    assert left(except_longest=1) == {True}
    # The lower one is about 2 pi 2 0.25 long, the upper one 2 pi 2 0.6.
    assert left(max_length=5.0) == {True}
    # 2 2 0.25 and 2 2 0.6 wide; of areas pi 0.5^2 and pi 1.2^2.
    assert left(max_diagonal=2.0) == {True} and left(max_diagonal=5.0) == set()
    assert left(max_area=2.0) == {True} and left(max_area=6.0) == set()


def test_what_is_not_fair_stays_open_on_demand():
    obj = band_missing()
    select_boundary(obj)
    before = coordinates(obj)
    runner.raises(lambda: join(max_iterations=1, on_failure="OPEN"), "no patch was found that is fair")
    assert np.array_equal(coordinates(obj), before)
    join(max_iterations=1)
    assert not boundary_edges(obj)


if __name__ == "__main__":
    runner.run(sys.modules[__name__])
