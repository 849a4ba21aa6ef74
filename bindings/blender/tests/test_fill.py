# SPDX-License-Identifier: GPL-3.0-or-later
"""Fill Hole and Fair, and Show Curvature, end to end."""

import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parent))
import bpy  # isort: skip
import bmesh
import common
import numpy as np
import runner
from common import (
    boundary_edges,
    coordinates,
    delete_faces,
    edit,
    irregular_sphere,
    select_boundary,
    select_vertices,
    uv_sphere,
)

BAR = 1e-5
common.install(runner.arguments()[0])
fill = bpy.ops.mesh.fairmesh_fill_holes
fill_all = bpy.ops.mesh.fairmesh_fill_all_holes
show = bpy.ops.mesh.fairmesh_show_curvature


def holed(frequency=20):
    """An irregular unit sphere without the cap z > 0.85, in Edit mode; the number of vertices left."""
    obj = irregular_sphere(frequency)
    delete_faces(obj, lambda f: f.calc_center_median().z > 0.85)
    return obj, len(obj.data.vertices)


def middle(edge):
    return (edge.verts[0].co + edge.verts[1].co) / 2


def test_the_patch_of_a_sphere_is_the_sphere():
    obj, old = holed()
    before, faces = coordinates(obj), len(obj.data.polygons)
    select_boundary(obj)
    assert fill() == {"FINISHED"}
    after = coordinates(obj)
    assert len(after) > old + 50
    assert np.array_equal(after[:old], before)
    assert np.abs(np.linalg.norm(after, axis=1) - 1).max() < BAR
    mesh = bmesh.from_edit_mesh(obj.data)
    assert not boundary_edges(obj)
    assert all(e.is_manifold and e.is_contiguous for e in mesh.edges)
    # Selected are the new faces.
    selected = [f for f in mesh.faces if f.select]
    assert len(selected) == len(mesh.faces) - faces > 100
    assert all(f.calc_center_median().z > 0.8 for f in selected)


def test_everything_stored_is_carried_on():
    obj = irregular_sphere(20)
    mesh = obj.data
    # Linear functions of the position, so that interpolated values are known; a hole small enough to be flat.
    value = lambda co: 0.5 + 0.25 * co[0] + 0.125 * co[1]  # noqa: E731
    uv = mesh.uv_layers.new(name="UVMap")
    color = mesh.color_attributes.new("paint", "BYTE_COLOR", "CORNER")
    mesh.attributes.new("f", "FLOAT", "POINT")
    mesh.attributes.new("tag", "INT", "FACE")
    group = obj.vertex_groups.new(name="weights")
    for name in "ab":
        mesh.materials.append(bpy.data.materials.new(name))
    for loop in mesh.loops:
        co = mesh.vertices[loop.vertex_index].co
        mesh.uv_layers["UVMap"].data[loop.index].uv = (value(co), 0.5 + co[1] / 4)
        mesh.color_attributes["paint"].data[loop.index].color = (value(co), 0, 1, 1)
    for vertex in mesh.vertices:
        mesh.attributes["f"].data[vertex.index].value = value(vertex.co)
        group.add([vertex.index], value(vertex.co), "REPLACE")
    for polygon in mesh.polygons:
        polygon.use_smooth = True
        polygon.material_index = 1
    mesh.attributes["tag"].data.foreach_set("value", np.full(len(mesh.polygons), 7, np.int32))
    del uv, color
    delete_faces(obj, lambda f: f.calc_center_median().z > 0.9)
    old = len(mesh.vertices)
    read = common.part("snapshot").read(obj)
    common.part("native").load()
    select_boundary(obj)
    fill(density=2.0)
    # The same from the library: it says which old vertices each new one comes from.
    filled = common.part("fairmesh").fill_holes(read.vertices, read.triangles, density=2.0 * np.sqrt(2.0), tolerance=1e-7)
    known = np.array([value(co) for co in read.vertices])
    expected = (filled.parent_weights * known[filled.parents]).sum(axis=1)
    bpy.ops.object.mode_set(mode="OBJECT")
    assert len(mesh.vertices) > old + 100
    new = [p for p in mesh.polygons if max(p.vertices) >= old]
    assert all(p.use_smooth and p.material_index == 1 for p in new)
    assert all(mesh.attributes["tag"].data[p.index].value == 7 for p in new)
    worst = {"f": 0, "weight": 0, "uv": 0, "color": 0}

    def note(name, got, vertex):
        wanted = expected[vertex - old] if vertex >= old else known[vertex]
        worst[name] = max(worst[name], abs(got - wanted))

    for vertex in list(mesh.vertices)[old:]:
        note("f", mesh.attributes["f"].data[vertex.index].value, vertex.index)
        assert [g.group for g in vertex.groups] == [0]
        note("weight", vertex.groups[0].weight, vertex.index)
    for polygon in new:
        for loop in polygon.loop_indices:
            vertex = mesh.loops[loop].vertex_index
            note("uv", mesh.uv_layers["UVMap"].data[loop].uv[0], vertex)
            note("color", mesh.color_attributes["paint"].data[loop].color[0], vertex)
    assert max(worst["f"], worst["weight"], worst["uv"]) < 1e-6, worst
    # A byte per channel, in sRGB.
    assert worst["color"] < 0.01, worst


def test_shape_keys_carry_the_patch_along():
    obj = irregular_sphere(20)
    obj.shape_key_add(name="Basis")
    key = obj.shape_key_add(name="Moved")
    flat = (coordinates(obj) * 1.0 + [0, 0, 2]).astype(np.float32).ravel()
    key.data.foreach_set("co", flat)
    obj.active_shape_key_index = 0
    delete_faces(obj, lambda f: f.calc_center_median().z > 0.85)
    select_boundary(obj)
    fill()
    bpy.ops.object.mode_set(mode="OBJECT")
    keys = obj.data.shape_keys.key_blocks
    positions = {}
    for name in ("Basis", "Moved"):
        flat = np.empty(3 * len(obj.data.vertices), np.float32)
        keys[name].data.foreach_get("co", flat)
        positions[name] = flat.reshape(-1, 3).astype(float)
    assert np.abs(np.linalg.norm(positions["Basis"], axis=1) - 1).max() < BAR
    assert np.abs(positions["Moved"] - positions["Basis"] - [0, 0, 2]).max() < 1e-6


def test_a_sharp_edge_goes_on_through_a_patch():
    for erase in (False, True):
        common.clear()
        obj = common.flattened_roof()
        if erase:
            assert bpy.ops.mesh.fairmesh_erase_and_fill(sharp="AUTO") == {"FINISHED"}
        else:
            delete_faces(obj, lambda face: any(max(abs(v.co.x), abs(v.co.y)) < 4 for v in face.verts))
            select_boundary(obj, lambda edge: max(abs(v.co.x) for v in edge.verts) < 6)
            assert fill(sharp="AUTO") == {"FINISHED"}
        at = coordinates(obj)
        assert np.abs(at[:, 2] + np.abs(at[:, 1])).max() < 1e-4, erase
        assert "1 sharp edge goes on" in common.said(), common.said()


def test_a_marked_edge_goes_on_through_a_patch():
    for sharp in ("AUTO", "MARKED", "OFF"):
        common.clear()
        obj = common.flattened_roof()
        common.flatten_and_mark(obj, "SHARP")
        delete_faces(obj, lambda face: any(max(abs(v.co.x), abs(v.co.y)) < 4 for v in face.verts))
        select_boundary(obj, lambda edge: max(abs(v.co.x) for v in edge.verts) < 6)
        fill(sharp=sharp)
        at = coordinates(obj)
        off = np.abs(at[:, 2] + common.FLAT * np.abs(at[:, 1])).max()
        assert (off < 1e-4) == (sharp != "OFF"), (sharp, off)


def two_holes():
    obj = irregular_sphere(20)
    delete_faces(obj, lambda f: f.calc_center_median().z > 0.9 or f.calc_center_median().z < -0.97)
    return obj


def test_only_the_selected_hole():
    for chosen in (lambda e: middle(e).z > 0, None):
        common.clear()
        obj = two_holes()
        if chosen:
            select_boundary(obj, chosen)
        else:
            edit(obj, "VERT")
            top = max((v for e in boundary_edges(obj) for v in e.verts), key=lambda v: v.co.z)
            select_vertices(obj, lambda v: v == top)
        fill()
        left = boundary_edges(obj)
        assert left and all(middle(e).z < 0 for e in left)


def test_all_holes_up_to_a_size():
    obj = two_holes()
    small = len([e for e in boundary_edges(obj) if middle(e).z < 0])
    fill_all(max_edges=small)
    assert boundary_edges(obj) and all(middle(e).z > 0 for e in boundary_edges(obj))
    fill_all()
    assert not boundary_edges(obj)
    runner.raises(fill_all, "The mesh has no hole")


def test_holes_with_hidden_vertices_stay_open():
    obj = two_holes()
    for vertex in [v for v in bmesh.from_edit_mesh(obj.data).verts if v.co.z < -0.9]:
        vertex.hide_set(True)
    bmesh.update_edit_mesh(obj.data)
    fill_all()
    left = boundary_edges(obj)
    assert left and all(middle(e).z < 0 for e in left)
    assert all(e.hide for e in left)


def test_the_outer_boundary_of_a_piece_is_filled_on_demand_only():
    obj = irregular_sphere(12)
    delete_faces(obj, lambda f: f.calc_center_median().z < 0.88 or f.calc_center_median().z > 0.98)
    outer = len([e for e in boundary_edges(obj) if middle(e).z < 0.93])
    bpy.ops.mesh.select_all(action="SELECT")
    fill()
    left = boundary_edges(obj)
    assert len(left) == outer and all(middle(e).z < 0.93 for e in left)
    bpy.ops.mesh.select_all(action="SELECT")
    runner.raises(fill, "outer boundary of an open surface", "Outer Boundaries, Too")
    fill(outer=True)
    assert not boundary_edges(obj)


def test_density_and_fairing_are_options():
    sizes = []
    for options in ({}, {"density": 2.0}, {"smooth": False}):
        common.clear()
        obj, old = holed()
        select_boundary(obj)
        fill(**options)
        after = coordinates(obj)
        sizes.append(len(after) - old)
        error = np.abs(np.linalg.norm(after, axis=1) - 1).max()
        assert error < BAR if "smooth" not in options else error > 0.01
    assert 3 * sizes[0] < sizes[1] < 5 * sizes[0] and abs(sizes[2] - sizes[0]) < 0.2 * sizes[0], sizes


def test_scaled_objects():
    obj, _ = holed()
    mesh = bmesh.from_edit_mesh(obj.data)
    for vertex in mesh.verts:
        vertex.co.z /= 3
    bmesh.update_edit_mesh(obj.data)
    obj.scale = (1, 1, 3)
    bpy.context.view_layer.update()
    select_boundary(obj)
    fill()
    assert np.abs(np.linalg.norm(coordinates(obj) * [1, 1, 3], axis=1) - 1).max() < BAR


def test_nothing_selected():
    obj, _ = holed()
    before = coordinates(obj)
    runner.raises(fill, "Nothing is selected", "Alt-click", "Fill All Holes")
    next(v for v in bmesh.from_edit_mesh(obj.data).verts if v.co.z < 0).select_set(True)
    runner.raises(fill, "No hole is selected", "Alt-click", "Fill All Holes")
    assert np.array_equal(coordinates(obj), before)


def test_undo():
    obj, old = holed()
    name = obj.name
    select_boundary(obj)
    bpy.ops.ed.undo_push(message="before")
    fill("EXEC_DEFAULT", True)
    assert len(coordinates(obj)) > old
    bpy.ops.ed.undo()
    obj = bpy.data.objects[name]
    assert len(coordinates(obj)) == old and boundary_edges(obj)
    bpy.ops.ed.redo()
    obj = bpy.data.objects[name]
    assert len(coordinates(obj)) > old and not boundary_edges(obj)


def colors(obj):
    flat = np.empty(4 * len(obj.data.vertices), np.float32)
    obj.data.attributes["Mean Curvature"].data.foreach_get("color", flat)
    return flat.reshape(-1, 4)


def values(obj):
    flat = np.empty(len(obj.data.vertices), np.float32)
    obj.data.attributes["mean_curvature"].data.foreach_get("value", flat)
    return flat


def test_curvature_of_a_sphere():
    for mode in ("OBJECT", "EDIT"):
        common.clear()
        obj = irregular_sphere(30)
        common.move(obj, 2 * coordinates(obj))
        bpy.ops.object.mode_set(mode=mode)
        assert show(values=True) == {"FINISHED"}
        assert show(values=True) == {"FINISHED"}
        bpy.ops.object.mode_set(mode="OBJECT")
        assert np.abs(values(obj) + 0.5).max() < 1e-3
        assert obj.data.color_attributes.active_color.name == "Mean Curvature"
        assert len(obj.data.color_attributes) == 1
        found = colors(obj)
        assert (found[:, 0] > 0.4).all() and (found[:, 2] < 0.05).all()
        # Around its median a sphere is white.
        show(middle="MEDIAN", scale="MANUAL", half_width=0.5)
        assert np.abs(colors(obj)[:, :3] - colors(obj)[0, :3]).max() < 0.01
        assert np.ptp(colors(obj)[0, :3]) < 0.01


def test_curvature_colours_tell_hollow_from_bulging():
    # A bump: red on its top, blue around its foot, white on the plane.
    bpy.ops.mesh.primitive_grid_add(x_subdivisions=80, y_subdivisions=80, size=4)
    obj = bpy.context.object
    positions = coordinates(obj)
    rho2 = (positions[:, :2] ** 2).sum(axis=1)
    positions[:, 2] = np.exp(-4 * rho2)
    common.move(obj, positions)
    show(values=True)
    # H = f'' at the top: half the Laplacian of exp(-4 r^2) there, 1/2 (-8 - 8).
    top, foot, far = rho2.argmin(), np.abs(rho2 - 0.6).argmin(), rho2.argmax()
    assert abs(values(obj)[top] + 8) < 0.8, values(obj)[top]
    found = colors(obj)
    assert found[top, 0] > 5 * found[top, 2]
    assert found[foot, 2] > 1.2 * found[foot, 0]
    assert np.ptp(found[far, :3]) < 0.05
    show(scale="MANUAL", half_width=100.0)
    assert np.ptp(colors(obj)[top, :3]) < 0.1


def test_curvature_is_hidden_again():
    hide = bpy.ops.mesh.fairmesh_hide_curvature
    for mode in ("OBJECT", "EDIT"):
        common.clear()
        obj = irregular_sphere(12)
        obj.data.color_attributes.new("Paint", "FLOAT_COLOR", "POINT")
        obj.data.color_attributes.active_color = obj.data.color_attributes["Paint"]
        before = coordinates(obj), set(obj.data.attributes.keys())
        bpy.ops.object.mode_set(mode=mode)
        assert not hide.poll()
        show()
        show(middle="MEDIAN")
        assert obj.data.color_attributes.active_color.name == "Mean Curvature"
        assert hide() == {"FINISHED"}
        assert obj.data.color_attributes.active_color.name == "Paint"
        assert not hide.poll()
        bpy.ops.object.mode_set(mode="OBJECT")
        assert np.array_equal(before[0], coordinates(obj))
        assert before[1] == set(obj.data.attributes.keys())
        assert not list(obj.data.keys())


def test_curvature_with_loose_vertices():
    sphere = uv_sphere(32, 16)
    vertices, faces = coordinates(sphere), [list(p.vertices) for p in sphere.data.polygons]
    common.clear()
    obj = common.add("loose", [*vertices, (0, 0, 5)], faces)
    show()
    assert np.allclose(colors(obj)[-1], [0.05, 0.05, 0.05, 1])
    common.clear()
    common.add("points", [(0, 0, 0), (1, 0, 0)], [])
    runner.raises(show, "no faces")


if __name__ == "__main__":
    runner.run(sys.modules[__name__])
