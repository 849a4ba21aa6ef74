# SPDX-License-Identifier: GPL-3.0-or-later
"""Fair Selection, end to end: the zip installed through Blender's operators, known answers."""

import math
import sys
from pathlib import Path
from types import SimpleNamespace

sys.path.insert(0, str(Path(__file__).parent))
import bpy  # isort: skip
import bmesh
import common
import numpy as np
import runner
from common import activate, coordinates, edit, flatten_cap, irregular_sphere, part, radial_error, said, uv_sphere

BAR = 1e-5
common.install(runner.arguments()[0])
fair = bpy.ops.mesh.fairmesh_fair


def dented(segments=64):
    """A UV sphere whose cap is selected and flat, in Edit mode; and the free vertices."""
    obj = uv_sphere(segments, segments // 2)
    return obj, flatten_cap(obj)


def test_uv_sphere():
    obj, free = dented(70)
    assert radial_error(obj, free) > 0.5
    assert fair() == {"FINISHED"}
    assert radial_error(obj, free) < BAR, radial_error(obj, free)


def test_components_are_counted_where_some_are_not_fair():
    outcome = part("fairmesh").Outcome

    def told(*outcomes):
        components = [SimpleNamespace(outcome=o, vertex=10 * k) for k, o in enumerate(outcomes)]
        worst = SimpleNamespace(
            outcome=outcomes[-1],
            components=components,
            free_vertices=9,
            iterations=5,
            reached=1.0,
            member_weight=0.5,
            sharp_edges=(),
        )
        return part("messages").faired(worst)

    good, bad = outcome.CONVERGED, outcome.NOT_CONVERGED
    assert told(good, good) == ("INFO", "9 vertices faired in 5 iterations")
    assert told(bad) == (
        "WARNING",
        "9 vertices faired in 5 iterations: no sound surface was found; that of least bending is written. "
        "Select more, set Tangents: Averaged, or use Erase and Fill",
    )
    assert "towards Shape: Elastic Sheet" in told(outcome.NEAREST_MEMBER)[1]
    kind, text = told(good, good, bad)
    assert kind == "WARNING" and "(2 of 3 separate parts are fair; one that is not is at vertex 20)" in text


def test_far_from_the_origin():
    # A float at 1,000 is exact to 3e-5: that is the error of the surroundings, too.
    obj = irregular_sphere(16)
    free = flatten_cap(obj, offset=(1000, 0, 0))
    fair()
    assert radial_error(obj, free, (1000, 0, 0)) < 1.5e-4, radial_error(obj, free, (1000, 0, 0))


def test_fixed_vertices_keep_their_bits():
    obj, free = dented()
    before = coordinates(obj)
    fair()
    fixed = np.ones(len(before), bool)
    fixed[free] = False
    assert np.array_equal(coordinates(obj)[fixed], before[fixed])
    assert not np.array_equal(coordinates(obj)[free], before[free])


def test_normals_of_faces_are_those_of_the_new_surface():
    obj, free = dented()
    fair()
    mesh = bmesh.from_edit_mesh(obj.data)
    kept = np.array([f.normal[:] for f in mesh.faces])
    mesh.normal_update()
    assert np.array_equal(kept, [f.normal[:] for f in mesh.faces])
    centres = np.array([f.calc_center_median().normalized()[:] for f in mesh.faces])
    assert (kept * centres).sum(axis=1).min() > 0.99


def test_a_seam_across_the_region():
    obj, free = dented()
    joined = coordinates(obj)
    mesh = bmesh.from_edit_mesh(obj.data)
    along = [e for e in mesh.edges if all(abs(v.co.y) < 1e-6 and v.co.x > 0 for v in e.verts)]
    assert len(along) > 20
    bmesh.ops.split_edges(mesh, edges=along)
    bmesh.update_edit_mesh(obj.data)
    common.select_faces(obj, lambda f: f.select)
    split = coordinates(obj)
    assert len(split) > len(joined) + 20
    bpy.context.tool_settings.mesh_select_mode = (False, False, True)
    assert fair() == {"FINISHED"}
    after = coordinates(obj)
    assert np.abs(np.linalg.norm(after, axis=1) - 1).max() < BAR
    assert len(np.unique(after, axis=0)) == len(joined), "copies of a vertex have come apart"


def test_doubles_of_a_stretched_object_move_alike():
    obj, _ = dented()
    mesh = bmesh.from_edit_mesh(obj.data)
    bmesh.ops.split_edges(mesh, edges=[e for e in mesh.edges if all(abs(v.co.y) < 1e-6 for v in e.verts)])
    bmesh.update_edit_mesh(obj.data)
    common.select_faces(obj, lambda f: f.select)
    before = coordinates(obj)
    obj.scale = (1, 2, 0.7)
    obj.rotation_euler = (0.3, 0.2, 0.1)
    bpy.context.view_layer.update()
    assert fair() == {"FINISHED"}
    after = coordinates(obj)
    assert not np.array_equal(before, after)
    assert len(np.unique(after, axis=0)) == len(np.unique(before, axis=0)) < len(before)


def last_run():
    """The report of the last run, and the message: (report, kind, text)."""
    report = part("fair_operator").last_reports[0]
    return report, *part("messages").faired(report)


def test_the_report_is_of_what_blender_stores():
    obj = irregular_sphere(57)
    free = flatten_cap(obj, offset=(1000, 0, 0))
    fair()
    report, _, _ = last_run()
    is_free = np.zeros(len(obj.data.vertices), bool)
    is_free[free] = True
    faces = np.array([[v.index for v in f.verts] for f in bmesh.from_edit_mesh(obj.data).faces])
    corners = coordinates(obj)[faces[is_free[faces].any(axis=1)]]
    first, second = (np.roll(corners, -k, axis=1) - corners for k in (1, 2))
    sine = np.linalg.norm(np.cross(first, second), axis=2)
    angles = np.degrees(np.arctan2(sine, (first * second).sum(axis=2)))
    assert abs(report.worst_angle - angles.min()) < 1e-4, (report.worst_angle, angles.min())


def test_rounding_that_spoils_triangles_is_told():
    obj = irregular_sphere(57)
    flatten_cap(obj, offset=(2**17, 0, 0))
    fair()
    report, kind, text = last_run()
    assert report.outcome == "poor_when_rounded", report.outcome
    assert kind == "WARNING" and f"({report.poor_triangle_count} triangles)" in text and "near to the origin" in text
    assert "poor faces" in part("found").last(bpy.context).what


def test_a_crease_is_told_and_can_be_selected():
    # The top of a coarse cube cannot meet the normals of its walls.
    bpy.ops.mesh.primitive_cube_add(size=2)
    obj = bpy.context.object
    edit(obj)
    bpy.ops.mesh.select_all(action="SELECT")
    bpy.ops.mesh.subdivide(number_cuts=3)
    bpy.ops.mesh.select_all(action="DESELECT")
    common.select_faces(obj, lambda f: f.calc_center_median().z > 0.99)
    fair(sharp="OFF")
    report, kind, text = last_run()
    assert report.outcome == "boundary_crease", report.outcome
    assert kind == "WARNING" and "crease along the boundary" in text and "Move the boundary" in text
    assert bpy.ops.mesh.fairmesh_select_found() == {"FINISHED"}
    chosen = [v for v in bmesh.from_edit_mesh(obj.data).verts if v.select]
    assert len(chosen) == report.creased_vertex_count > 0


def dented_below_a_needle():
    """The same below a needle that the sphere runs through."""
    obj, _ = dented()
    mesh = bmesh.from_edit_mesh(obj.data)
    corners = ((0.11, 0.07, 0.9), (0.13, 0.08, 0.9), (0.12, 0.1, 0.9), (0.12, 0.085, 1.5))
    needle = [mesh.verts.new(corner) for corner in corners]
    for sides in ((0, 2, 1), (0, 1, 3), (1, 2, 3), (2, 0, 3)):
        mesh.faces.new([needle[k] for k in sides])
    bmesh.update_edit_mesh(obj.data)
    return obj


def test_faces_that_intersect_are_told_and_can_be_selected():
    obj = dented_below_a_needle()
    fair()
    report, kind, text = last_run()
    assert report.outcome == "self_intersecting", report.outcome
    assert kind == "WARNING" and f"({report.intersection_count} pairs, 0 before" in text
    assert "Look at these faces" in text
    assert bpy.ops.mesh.fairmesh_select_found() == {"FINISHED"}
    chosen = [f for f in bmesh.from_edit_mesh(obj.data).faces if f.select]
    assert 3 <= len(chosen) < 20
    common.clear()
    dented_below_a_needle()
    fair(check_intersections=False)
    report, kind, _ = last_run()
    assert kind == "INFO" and not report.intersections_checked


def test_invoke_from_a_script_runs_at_once():
    obj, free = dented()
    assert fair("INVOKE_DEFAULT") == {"FINISHED"}
    assert radial_error(obj, free) < BAR


def moved(obj, before):
    return set(np.flatnonzero((coordinates(obj) != before).any(axis=1)).tolist())


def bumpy():
    """A grid of 10 by 10 faces with a bump on every second vertex, in Edit mode."""
    bpy.ops.mesh.primitive_grid_add(x_subdivisions=10, y_subdivisions=10, size=2)
    obj = bpy.context.object
    positions = coordinates(obj)
    positions[:, 2] = 0.05 * (np.arange(len(positions)) % 2)
    common.move(obj, positions)
    edit(obj)
    return obj


def test_the_select_mode_decides_what_is_free():
    obj = bumpy()
    common.select_faces(obj, lambda f: all(abs(x) < 0.5 for x in f.calc_center_median()[:2]))
    mesh = bmesh.from_edit_mesh(obj.data)
    inside = {v.index for v in mesh.verts if v.link_faces and all(f.select for f in v.link_faces)}
    selected = {v.index for v in mesh.verts if v.select}
    assert len(inside) == 9 and len(selected) == 25
    before = coordinates(obj)
    modes = bpy.context.tool_settings
    for mode, region, expected in (
        ((False, False, True), "AUTO", inside),
        ((True, False, False), "AUTO", selected),
        ((False, True, False), "AUTO", selected),
        ((True, True, True), "AUTO", selected),
        ((False, True, True), "AUTO", selected),
        ((True, False, False), "FACES", inside),
        ((False, False, True), "VERTICES", selected),
    ):
        modes.mesh_select_mode = mode
        fair(region=region)
        # A vertex may happen to be in its place.
        found = moved(obj, before)
        assert found <= expected and len(found) > 0.8 * len(expected), (mode, region, len(found))
        restore(obj, before)


def restore(obj, positions):
    mesh = bmesh.from_edit_mesh(obj.data)
    for vertex, position in zip(mesh.verts, positions):
        vertex.co = position
    bmesh.update_edit_mesh(obj.data)


def test_the_boundary_of_the_mesh_stays():
    obj = bumpy()
    before = coordinates(obj)
    bpy.ops.mesh.select_all(action="SELECT")
    fair()
    boundary = {v.index for v in bmesh.from_edit_mesh(obj.data).verts if v.is_boundary}
    assert len(boundary) == 40
    assert not moved(obj, before) & boundary
    assert len(moved(obj, before)) > 70


def test_ngons_and_quads_stay_faces():
    obj, free = dented()
    mesh = bmesh.from_edit_mesh(obj.data)

    # Every second edge between two parallel circles goes: quads become hexagons.
    def between(edge):
        around = [np.arctan2(v.co.y, v.co.x) / (2 * np.pi) * 64 for v in edge.verts]
        along = abs(around[0] - around[1]) < 1e-3 and len(edge.link_faces[0].verts) == 4
        return along and round(around[0]) % 2 == 0 and len(edge.link_faces[1].verts) == 4

    bmesh.ops.dissolve_edges(mesh, edges=[e for e in mesh.edges if between(e)], use_verts=False)
    bmesh.update_edit_mesh(obj.data)
    common.select_faces(obj, lambda f: all(v.co.z > 0.199 for v in f.verts))
    mesh = bmesh.from_edit_mesh(obj.data)
    corners = [[v.index for v in f.verts] for f in mesh.faces]
    assert max(map(len, corners)) == 6
    free = np.array([v.index for v in mesh.verts if v.select and all(f.select for f in v.link_faces)])
    assert len(free) > 700
    fair()
    mesh = bmesh.from_edit_mesh(obj.data)
    assert [[v.index for v in f.verts] for f in mesh.faces] == corners
    assert radial_error(obj, free) < BAR, radial_error(obj, free)


def test_hidden_faces_are_surroundings_and_stay():
    obj = uv_sphere(64, 32)
    exact = coordinates(obj)
    free = flatten_cap(obj)
    mesh = bmesh.from_edit_mesh(obj.data)
    # All around the cap is hidden, and a part of the cap itself, which is as it has to be.
    hidden = [f for f in mesh.faces if not f.select or f.calc_center_median().x > 0.5]
    wedge = {v.index for f in hidden for v in f.verts}
    for index in wedge:
        mesh.verts.ensure_lookup_table()
        mesh.verts[index].co = exact[index]
    for face in hidden:
        face.select_set(False)
        face.hide_set(True)
    bmesh.update_edit_mesh(obj.data)
    after_hiding = coordinates(obj)
    fair()
    assert not moved(obj, after_hiding) & wedge
    left = np.array([v for v in free if v not in wedge])
    assert len(left) > 200
    assert radial_error(obj, left) < BAR


def test_shape_key():
    obj = uv_sphere(64, 32)
    exact = coordinates(obj)
    obj.shape_key_add(name="Basis")
    obj.shape_key_add(name="Dent")
    obj.shape_key_add(name="Other")
    obj.active_shape_key_index = 1
    free = flatten_cap(obj)
    fair()
    # Edit mode shows the key as it is edited.
    assert radial_error(obj, free) < BAR
    bpy.ops.object.mode_set(mode="OBJECT")

    def key(name):
        flat = np.empty(3 * len(exact), np.float32)
        obj.data.shape_keys.key_blocks[name].data.foreach_get("co", flat)
        return flat.reshape(-1, 3)

    assert np.abs(np.linalg.norm(key("Dent"), axis=1) - 1).max() < BAR
    assert np.array_equal(key("Basis"), exact.astype(np.float32))
    assert np.array_equal(key("Other"), exact.astype(np.float32))
    assert np.array_equal(coordinates(obj), exact)


def test_mirror_editing():
    obj = uv_sphere(64, 32)
    obj.data.use_mirror_x = True
    edit(obj, "VERT")
    mesh = bmesh.from_edit_mesh(obj.data)
    for vertex in mesh.verts:
        if abs(vertex.co.x) > 0.7:
            vertex.co *= 0.9
    bmesh.update_edit_mesh(obj.data)
    bpy.ops.mesh.select_all(action="DESELECT")
    common.select_vertices(obj, lambda v: v.co.x > 0.6)
    fair()
    after = coordinates(obj)
    assert np.abs(np.linalg.norm(after, axis=1) - 1).max() < BAR
    right, left = after[after[:, 0] > 0.75], after[after[:, 0] < -0.75]
    assert len(left) == len(right) > 100
    for row in left:
        assert (right == row * [-1, 1, 1]).all(axis=1).any()


def test_mirror_editing_across_the_plane():
    obj = uv_sphere(64, 32)
    obj.data.use_mirror_x = True
    free = flatten_cap(obj)
    # Of the cap only one half is selected; the plane x = 0 goes through it.
    mesh = bmesh.from_edit_mesh(obj.data)
    for face in mesh.faces:
        if face.calc_center_median().x < 0:
            face.select_set(False)
    mesh.select_flush_mode()
    bpy.context.tool_settings.mesh_select_mode = (True, False, False)
    bmesh.update_edit_mesh(obj.data)
    fair()
    assert radial_error(obj, free) < BAR, radial_error(obj, free)


def test_loose_vertices_and_edges():
    sphere = uv_sphere(64, 32)
    vertices, faces = coordinates(sphere), [list(p.vertices) for p in sphere.data.polygons]
    common.clear()
    n = len(vertices)
    extra = [(0, 0, 3), (0, 0, 4), (1, 0, 3), (np.nan, 0, 0)]
    obj = common.add("loose", list(extra) + list(vertices), [[v + 4 for v in f] for f in faces], [(0, 1), (2, 4)])
    free = flatten_cap(obj)
    mesh = bmesh.from_edit_mesh(obj.data)
    mesh.verts.ensure_lookup_table()
    for index in range(3):
        mesh.verts[index].select_set(True)
    fair()
    assert radial_error(obj, free) < BAR
    assert np.array_equal(coordinates(obj)[:3], extra[:3])
    assert n == len(coordinates(obj)) - 4


def stored(obj):
    """Everything on the mesh but the positions."""
    mesh = obj.data
    found = {}
    for attribute in mesh.attributes:
        if attribute.name in ("position", ".corner_vert", ".corner_edge", ".edge_verts"):
            continue
        values = []
        for item in attribute.data:
            for field in ("value", "vector", "color", "uv"):
                if hasattr(item, field):
                    value = getattr(item, field)
                    values.append(tuple(value) if hasattr(value, "__len__") else value)
                    break
        found[attribute.name] = values
    for layer in mesh.uv_layers:
        found["uv " + layer.name] = [tuple(corner.uv) for corner in layer.data]
    found["groups"] = [[(g.group, g.weight) for g in v.groups] for v in mesh.vertices]
    found["faces"] = [(tuple(p.vertices), p.material_index, p.use_smooth) for p in mesh.polygons]
    return found


def test_suzanne():
    suzanne(0, 468)


def test_suzanne_subdivided():
    suzanne(1, 4 * 468)


def suzanne(cuts, quads):
    """The back of the head, spoilt: a sound result, and everything but the positions stays."""
    bpy.ops.mesh.primitive_monkey_add(calc_uvs=True)
    obj = bpy.context.object
    mesh = obj.data
    if cuts:
        edit(obj)
        bpy.ops.mesh.select_all(action="SELECT")
        bpy.ops.mesh.subdivide(number_cuts=cuts, smoothness=1.0)
        bpy.ops.object.mode_set(mode="OBJECT")
    random = np.random.default_rng(3)
    group = obj.vertex_groups.new(name="weights")
    for vertex in mesh.vertices:
        group.add([vertex.index], float(random.random()), "REPLACE")
    for name, kind, domain in (("a", "FLOAT", "POINT"), ("b", "INT", "FACE"), ("c", "FLOAT_COLOR", "CORNER")):
        mesh.attributes.new(name, kind, domain)
    mesh.attributes["a"].data.foreach_set("value", random.random(len(mesh.vertices)).astype(np.float32))
    mesh.attributes["b"].data.foreach_set("value", random.integers(0, 99, len(mesh.polygons)).astype(np.int32))
    mesh.attributes["c"].data.foreach_set("color", random.random(4 * len(mesh.loops)).astype(np.float32))
    for polygon in mesh.polygons:
        polygon.use_smooth = bool(polygon.index % 3)
    edit(obj)
    common.select_faces(obj, lambda f: f.calc_center_median().y > 0.2 and abs(f.calc_center_median().x) < 0.75)
    for vertex in bmesh.from_edit_mesh(mesh).verts:
        if vertex.link_faces and all(f.select for f in vertex.link_faces):
            vertex.co *= random.uniform(0.9, 1.1)
    bmesh.update_edit_mesh(mesh)
    bpy.ops.object.mode_set(mode="OBJECT")
    before = stored(obj)
    assert quads == sum(p.loop_total == 4 for p in mesh.polygons)
    start = coordinates(obj)
    bpy.ops.object.mode_set(mode="EDIT")
    assert fair() == {"FINISHED"}
    report = part("fair_operator").last_reports[0]
    assert report.outcome.is_success, report
    print(f"        {report.outcome} {report.text}, {report.free_vertices} free vertices, {report.worst_angle:.1f} degrees")
    assert report.flipped_count == 0 and report.worst_angle > 5
    bpy.ops.object.mode_set(mode="OBJECT")
    after = stored(obj)
    assert set(after) == set(before)
    for name in before:
        assert after[name] == before[name], name
    assert quads == sum(p.loop_total == 4 for p in mesh.polygons)
    assert 15 * 4**cuts < report.free_vertices == np.count_nonzero((coordinates(obj) != start).any(axis=1))
    assert len(after["uv UVMap"]) == len(mesh.loops) and len(after["a"]) == len(mesh.vertices)


def test_objects_edited_together():
    first, free_first = dented()
    bpy.ops.object.mode_set(mode="OBJECT")
    second = irregular_sphere(16)
    free_second = flatten_cap(second)
    bpy.ops.object.mode_set(mode="OBJECT")
    third = uv_sphere(16, 8)
    untouched = coordinates(third)
    edit(third)
    bpy.ops.object.mode_set(mode="OBJECT")
    for obj in (first, second, third):
        activate(obj)
    bpy.ops.object.mode_set(mode="EDIT")
    assert len(bpy.context.objects_in_mode_unique_data) == 3
    fair()
    assert radial_error(first, free_first) < BAR
    assert radial_error(second, free_second) < BAR
    assert np.array_equal(coordinates(third), untouched)


def test_an_error_in_one_object_leaves_all_unchanged():
    first, _ = dented()
    bpy.ops.object.mode_set(mode="OBJECT")
    second = uv_sphere(16, 8)
    edit(second)
    bpy.ops.mesh.select_all(action="SELECT")
    bpy.ops.object.mode_set(mode="OBJECT")
    for obj in (first, second):
        activate(obj)
    bpy.ops.object.mode_set(mode="EDIT")
    before = coordinates(first), coordinates(second)
    runner.raises(fair, "irregular" if second.name == "irregular" else second.name)
    assert np.array_equal(coordinates(first), before[0]) and np.array_equal(coordinates(second), before[1])


def test_scaled_objects_are_faired_as_they_are_seen():
    for scale in ((1, 1, 3), (2, -1, 1)):
        common.clear()
        obj, free = dented()
        mesh = bmesh.from_edit_mesh(obj.data)
        for vertex in mesh.verts:
            vertex.co = [x / s for x, s in zip(vertex.co, scale)]
        bmesh.update_edit_mesh(obj.data)
        obj.scale = scale
        bpy.context.view_layer.update()
        fair()
        seen = coordinates(obj)[free] * scale
        assert np.abs(np.linalg.norm(seen, axis=1) - 1).max() < BAR


def test_options_reach_the_library():
    obj, free = dented()
    before = coordinates(obj)
    places = {}
    for options in (
        {},
        {"inner_fairness": "CONFORMAL"},
        {"inner_fairness": "CONVEX"},
        {"boundary_normals": "AVERAGED"},
        {"boundary_normals": "AVERAGED", "curvature": "PART", "continuity": 0.5},
        {"target": "MINIMAL_ENERGY"},
        {"target": "CONSTANT", "constant": 10.0},
        {"digits": 3},
        {"max_iterations": 2},
    ):
        restore(obj, before)
        fair(**options)
        places[str(options)] = coordinates(obj)[free]
    values = list(places.values())
    for i, first in enumerate(values):
        for j, second in enumerate(values[:i]):
            assert not np.array_equal(first, second), (list(places)[i], list(places)[j])
    for name in ("{}", "{'inner_fairness': 'CONFORMAL'}", "{'inner_fairness': 'CONVEX'}"):
        assert np.abs(np.linalg.norm(places[name], axis=1) - 1).max() < BAR, name
    assert part("fair_operator").last_reports[0].outcome == "iteration_limit"


def test_what_is_not_continued_is_told():
    messages = part("messages")

    class Loop:
        reached, jump_before, uncertainty, vertex, vertex_count = 0.25, 0.2, 0.01, 7, 40

    class Component:
        continuity = (Loop,)

    class Report:
        free_vertices, iterations, components, sharp_edges = 5, 9, (Component,), ()
        outcome = messages.Outcome.CONVERGED

    kind, text = messages.faired(Report, 1.0)
    assert kind == "INFO" and "continued by 0.25 in place of 1.00" in text and "40 vertices at vertex 7" in text, text
    assert "curvature" not in messages.faired(Report, 0.25)[1]
    assert "curvature" not in messages.faired(Report)[1]
    assert "curvature goes on along 1 of 1 boundary" in messages.faired(Report, "auto")[1]
    Loop.reached = 0.0
    assert "curvature" not in messages.faired(Report, "auto")[1]
    Loop.uncertainty = 0.3
    assert "curvature" not in messages.faired(Report, 1.0)[1]
    Component.continuity = ()
    assert "is not continued" in messages.faired(Report, 1.0)[1]


def off_roof(obj):
    at = coordinates(obj)
    return np.abs(at[:, 2] + np.abs(at[:, 1])).max()


def test_sharp_edges_go_on():
    for options in ({"sharp": "AUTO"}, {"sharp": "ANGLE", "sharp_angle": math.radians(80)}):
        common.clear()
        obj = common.flattened_roof()
        assert fair(**options) == {"FINISHED"}
        assert off_roof(obj) < 1e-5, off_roof(obj)
        assert "1 sharp edge goes on" in said(), said()
    for options in ({"sharp": "OFF"}, {"sharp": "ANGLE", "sharp_angle": math.radians(100)}):
        common.clear()
        obj = common.flattened_roof()
        fair(**options)
        assert off_roof(obj) > 0.1 and "sharp" not in said().split(":")[0], said()


def test_marked_edges_go_on():
    for how in ("SHARP", "CREASE"):
        for sharp, goes_on in (("AUTO", how), ("MARKED", how), ("AUTO", ""), ("OFF", how)):
            common.clear()
            obj = common.flattened_roof()
            common.flatten_and_mark(obj, how if goes_on else "")
            fair(sharp=sharp)
            at = coordinates(obj)
            off = np.abs(at[:, 2] + common.FLAT * np.abs(at[:, 1])).max()
            assert (off < 1e-5) == (sharp != "OFF" and bool(goes_on)), (how, sharp, goes_on, off)
            assert ("1 sharp edge goes on" in said()) == (off < 1e-5), said()


def test_a_sharp_edge_that_ends_is_told():
    common.clear()
    common.fading_ridge()
    fair(sharp="AUTO")
    assert "1 sharp edge ends at vertex" in said() and "(53 degrees)" in said(), said()
    assert "Select so much that the sharp edge ends outside" in said() and "Sharp Edges: Smooth" in said(), said()


def refused(obj, *parts):
    before = coordinates(obj)
    message = runner.raises(fair, *parts)
    assert np.array_equal(coordinates(obj), before)
    return message


def test_noise_is_for_smoothing_and_a_wrong_shape_for_fairing():
    """As the document says: of a shape that is right but for noise Smooth Vertices keeps more, as fairing forgets it."""
    random = np.random.default_rng(3)
    errors = {}
    for flaw in ("noise", "dent"):
        for way in ("smooth", "fair"):
            common.clear()
            obj = common.geodesic_sphere(40)
            ball = coordinates(obj)
            truth = ball * (1 + 0.04 * np.sin(5 * ball[:, :1]) * np.cos(4 * ball[:, 1:2]) * (flaw == "noise"))
            common.move(obj, truth * (1 + 0.004 * random.standard_normal((len(truth), 1)) * (flaw == "noise")))
            common.edit(obj)
            common.select_faces(obj, lambda face: all(v.co.z > 0.6 for v in face.verts))
            mesh = bmesh.from_edit_mesh(obj.data)
            inside = [v.index for v in mesh.verts if v.select and all(face.select for face in v.link_faces)]
            mesh.verts.ensure_lookup_table()
            for index in inside if flaw == "dent" else ():
                mesh.verts[index].co.z = 0.6
            bmesh.update_edit_mesh(obj.data)
            if way == "smooth":
                bpy.ops.mesh.vertices_smooth(factor=0.5, repeat=20)
            else:
                fair()
            off = np.linalg.norm(coordinates(obj)[inside], axis=1) - np.linalg.norm(truth[inside], axis=1)
            errors[flaw, way] = np.sqrt((off**2).mean())
    assert errors["noise", "smooth"] < errors["noise", "fair"] / 1.5, errors
    assert errors["dent", "fair"] < errors["dent", "smooth"] / 1000, errors


def test_nothing_selected():
    obj, _ = dented()
    bpy.ops.mesh.select_all(action="DESELECT")
    refused(obj, "Nothing is selected: select what is to move")
    next(iter(bmesh.from_edit_mesh(obj.data).faces)).select_set(True)
    refused(obj, "No vertex can move", "select faces with vertices inside")
    bpy.ops.mesh.select_all(action="DESELECT")
    bpy.context.tool_settings.mesh_select_mode = (True, False, False)
    refused(obj, "Nothing is selected: select what is to move")


def test_nothing_fixed():
    obj, _ = dented()
    bpy.ops.mesh.select_all(action="SELECT")
    refused(obj, obj.name, "Vertex", "The mesh is unchanged", "Deselect some of its vertices")


def test_a_third_face_at_an_edge_is_named_and_can_be_selected():
    obj, _ = dented()
    mesh = bmesh.from_edit_mesh(obj.data)
    edge = next(e for e in mesh.edges if all(abs(v.co.z - 0.2) < 1e-6 and v.co.xy.length < 0.3 for v in e.verts))
    new = mesh.verts.new((0, 0, 2))
    mesh.faces.new([edge.verts[0], edge.verts[1], new])
    mesh.verts.index_update()
    ends = sorted(v.index for v in edge.verts)
    bmesh.update_edit_mesh(obj.data)
    refused(obj, f"Edge of vertices {ends[0]} and {ends[1]} of {obj.name}", "Repair the mesh there")
    assert bpy.ops.mesh.fairmesh_select_found() == {"FINISHED"}
    assert [v.index for v in bmesh.from_edit_mesh(obj.data).verts if v.select] == ends
    # After a change the numbers mean nothing any more.
    mesh = bmesh.from_edit_mesh(obj.data)
    mesh.verts.new((0, 0, 5))
    bmesh.update_edit_mesh(obj.data)
    runner.raises(bpy.ops.mesh.fairmesh_select_found, "Run it again")


def test_a_turned_face_is_named():
    obj, _ = dented()
    mesh = bmesh.from_edit_mesh(obj.data)
    face = next(f for f in mesh.faces if f.select and f.calc_center_median().xy.length < 0.3)
    face.normal_flip()
    bmesh.update_edit_mesh(obj.data)
    refused(obj, "Edge of vertices", "Recalculate Outside")


def test_coordinates_that_are_no_numbers():
    obj, free = dented()
    mesh = bmesh.from_edit_mesh(obj.data)
    mesh.verts.ensure_lookup_table()
    mesh.verts[int(free[5])].co.x = np.nan
    bmesh.update_edit_mesh(obj.data)
    runner.raises(fair, f"Vertex {free[5]} of {obj.name}", "Repair the vertex")


def test_undo_and_redo():
    obj, free = dented()
    name = obj.name
    bpy.ops.ed.undo_push(message="before")
    before = coordinates(obj)
    assert fair("EXEC_DEFAULT", True) == {"FINISHED"}
    after = coordinates(obj)
    bpy.ops.ed.undo()
    obj = bpy.data.objects[name]
    assert obj.mode == "EDIT"
    assert np.array_equal(coordinates(obj), before)
    bpy.ops.ed.redo()
    obj = bpy.data.objects[name]
    assert np.array_equal(coordinates(obj), after)
    assert radial_error(obj, free) < BAR


def test_a_job_is_cancelled_at_any_iteration():
    """The thread ends with that outcome. The operator itself does not wait for it."""
    obj = irregular_sphere(158)
    flatten_cap(obj)
    mesh = part("snapshot").read(obj)
    free = part("region").free_mask(mesh, True)
    library, jobs = part("fairmesh"), part("job")
    for last in (0, 1, 4):

        def work(monitor):
            def tell(progress):
                if progress.iteration == last:
                    monitor.cancel()

            return library.fair(mesh.vertices, mesh.triangles, free=free, cancel=monitor, progress=tell)

        job = jobs.Job(work)
        job.start()
        assert job.wait(100)
        assert job.result().outcome == "cancelled", job.result()
        assert job.result().report.iterations <= last + 1


if __name__ == "__main__":
    runner.run(sys.modules[__name__])
