# SPDX-License-Identifier: GPL-3.0-or-later
"""Fair Live without a window: edits from scripts by known answers, what is refused, and the parts of its run."""

import math
import sys
import unittest.mock
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parent))
import bpy  # isort: skip
import bmesh
import common
import numpy as np
import runner
from common import part

common.install(runner.arguments()[0])


def edit(kind, vertex=-1, degrees=0.0, way=(0.0, 0.0, 0.0), falloff=0.0):
    """An edit as scripts give it."""
    angle = math.radians(degrees)
    return {"name": "", "kind": kind, "vertex": int(vertex), "angle": angle, "way": way, "falloff": falloff}


def live(edits=(), **options):
    assert bpy.ops.mesh.fairmesh_live(edits=list(edits), **options) == {"FINISHED"}


def cap(make=lambda: common.uv_sphere(48, 24), height=0.2):
    """A sphere with a flat cap: the object, its free vertices, and its boundary loop."""
    obj = make()
    free = common.flatten_cap(obj, height)
    (loop,) = loops(obj)
    return obj, free, loop


def loops(obj):
    return region(obj).loops


def region(obj, **keywords):
    mesh = part("snapshot").read(obj)
    free = part("region").free_mask(mesh, True)
    symmetry = part("region").Symmetry(mesh, free)
    mesh.triangles = part("triangulation").cut_evenly(mesh, free)
    return part("live_region").LiveRegion(mesh, free, symmetry, keywords)


def reset(obj, start):
    """The positions from before the last operator."""
    bpy.ops.object.mode_set(mode="OBJECT")
    common.move(obj, start)
    bpy.ops.object.mode_set(mode="EDIT")


def test_without_edits_it_is_fair_selection():
    obj, free, loop = cap()
    live([edit("TILT", loop.vertices[0]), edit("BULGE")])
    assert common.radial_error(obj, free) < 1e-5


def test_a_tilted_sphere_is_the_sphere_that_leaves_its_circle_steeper():
    """The only disc of constant curvature over a circle is a part of a sphere: tilting gives that of the other angle."""
    for degrees in (-30, -10, 10, 20):
        obj, free, loop = cap(lambda: common.uv_sphere(96, 48), 0.2)
        points = common.coordinates(obj)[loop.vertices]
        height, radius = points[:, 2].mean(), np.linalg.norm(points[:, :2], axis=1).mean()
        assert np.ptp(points[:, 2]) < 1e-6
        live([edit("TILT", loop.vertices[0], degrees)])
        # The angle between the circle's plane and the surface.
        angle = math.atan2(radius, height) + math.radians(degrees)
        wanted = radius / math.sin(angle)
        centre = height - wanted * math.cos(angle)
        found = np.linalg.norm(common.coordinates(obj)[free] - (0, 0, centre), axis=1)
        assert np.abs(found - wanted).max() < 2e-3 * wanted, (degrees, found.min(), found.max(), wanted)
        common.clear()


def test_bulge_is_a_tilt_of_all_loops():
    obj, free, loop = cap()
    start = common.coordinates(obj)
    live([edit("TILT", loop.vertices[0], 15)])
    tilted = common.coordinates(obj)
    reset(obj, start)
    live([edit("BULGE", degrees=15)])
    assert np.abs(common.coordinates(obj) - tilted).max() < 1e-5


def test_falloff_keeps_the_other_side_as_it_was():
    obj, free, loop = cap()
    vertex = max(loop.vertices, key=lambda v: common.coordinates(obj)[v][0])
    live([edit("TILT", vertex, 20, falloff=0.8)])
    off = np.linalg.norm(common.coordinates(obj)[free], axis=1) - 1
    x = common.coordinates(obj)[free][:, 0]
    assert off[x > 0.6].max() > 0.01
    assert np.abs(off[x < -0.8]).max() < 0.2 * off[x > 0.6].max(), (off[x < -0.8], off[x > 0.6].max())


def test_what_is_mirrored_is_symmetric():
    obj, free, loop = cap()
    vertex = max(loop.vertices, key=lambda v: common.coordinates(obj)[v] @ (1, 0.3, 0))
    for kind, way in (("TILT", (0, 0, 0)), ("TWIST", (0, 0, 0)), ("MOVE", (0.1, 0.1, 0.1))):
        live([edit(kind, vertex, 15, way, 1.0)], mirror=(True, False, False))
        positions = common.coordinates(obj)
        image = positions * (-1, 1, 1)
        nearest = np.sqrt(((positions[free][:, None] - image[free][None]) ** 2).sum(axis=2)).min(axis=1)
        assert nearest.max() < 1e-4, (kind, nearest.max())
        assert np.abs(np.linalg.norm(positions[free], axis=1) - 1).max() > 0.005, kind


def test_a_moved_loop_takes_the_surface_along():
    obj, free, loop = cap()
    start = common.coordinates(obj)
    live([edit("MOVE", loop.vertices[0], way=(0.0, 0.05, 0.2))])
    moved = common.coordinates(obj)
    assert np.abs(moved[loop.vertices] - start[loop.vertices] - (0, 0.05, 0.2)).max() < 1e-6
    # A rigid move of all that bounds the surface moves the surface.
    assert common.radial_error(obj, free, (0, 0.05, 0.2)) < 1e-5
    rest = np.setdiff1d(np.arange(len(start)), np.concatenate([free, loop.vertices]))
    assert np.array_equal(moved[rest], start[rest])
    reset(obj, start)
    live([edit("MOVE", loop.vertices[0], way=(0.0, 0.0, 0.2), falloff=0.5)])
    below = common.coordinates(obj)[rest] - start[rest]
    near = np.abs(start[rest][:, 2] - 0.2) < 0.3
    assert below[near][:, 2].max() > 0.05 and np.array_equal(
        below[start[rest][:, 2] < -0.6], below[start[rest][:, 2] < -0.6] * 0
    )


def test_an_interior_point_is_moved():
    obj = common.uv_sphere(48, 24)
    common.edit(obj, "VERT")
    point = int(np.argmin(np.linalg.norm(common.coordinates(obj) - (0, -0.7, 0.7), axis=1)))
    common.select_vertices(obj, lambda v: v.co.z > 0.1 and v.index != point)
    start = common.coordinates(obj)
    live([edit("MOVE", point, way=(0, -0.1, 0.1))], region="VERTICES")
    moved = common.coordinates(obj)
    assert np.abs(moved[point] - start[point] - (0, -0.1, 0.1)).max() < 1e-6
    around = np.linalg.norm(start - start[point], axis=1) < 0.2
    assert np.linalg.norm(moved[around], axis=1).max() > 1.05


def test_faces_are_kept_and_what_is_not_free_keeps_its_bits():
    obj, free, loop = cap()
    start, faces = common.coordinates(obj), [len(f.vertices) for f in obj.data.polygons]
    live([edit("TILT", loop.vertices[0], 10)])
    fixed = np.setdiff1d(np.arange(len(start)), free)
    assert np.array_equal(common.coordinates(obj)[fixed], start[fixed])
    bpy.ops.object.mode_set(mode="OBJECT")
    assert [len(f.vertices) for f in obj.data.polygons] == faces and 4 in faces


def test_scale_of_the_object_is_as_if_applied():
    obj, free, loop = cap()
    start = common.coordinates(obj)
    scale = np.array((1.0, 1.5, 0.7))
    reset(obj, start * scale)
    one = [edit("TILT", loop.vertices[0], 15, falloff=1.0), edit("MOVE", loop.vertices[0], way=tuple(scale * (0, 0.1, 0.1)))]
    live(one)
    applied = common.coordinates(obj)
    reset(obj, start)
    obj.scale = scale
    bpy.context.view_layer.update()
    live([edit("TILT", loop.vertices[0], 15, falloff=1.0), edit("MOVE", loop.vertices[0], way=(0, 0.1, 0.1))])
    assert np.abs(common.coordinates(obj) * scale - applied).max() < 1e-4


def test_what_is_refused_says_what_to_do():
    obj, free, loop = cap()
    before = common.coordinates(obj)
    runner.raises(lambda: live([edit("TILT", free[0], 10)]), "The mesh is unchanged")
    with unittest.mock.patch.object(part("live_operator"), "MOST_FREE", 10):
        runner.raises(live, f"{len(free)} vertices would move", "at most 10", "Fair Selection")
    bpy.ops.mesh.select_all(action="SELECT")
    runner.raises(live, "no boundary", "deselect")
    bpy.ops.mesh.select_all(action="DESELECT")
    runner.raises(live, "Nothing is selected")
    assert np.array_equal(common.coordinates(obj), before)


def test_loops_have_the_region_on_their_left():
    obj, free, loop = cap()
    points = common.coordinates(obj)[loop.vertices]
    ahead = np.roll(points, -1, axis=0) - points
    # Seen from outside, up is to the left of going around counter-clockwise.
    assert (np.cross(points, ahead)[:, 2] > 0).all()
    assert abs(loop.length - np.linalg.norm(ahead, axis=1).sum()) < 1e-9
    away = loop.distances(loop.vertices[5])
    assert away[5] == 0 and away[6] > 0 > away[4] and np.abs(away).max() <= loop.length / 2


def test_two_loops_and_a_slit():
    """A belt has two loops, and none along a split edge within it, whose sides lie on each other."""
    obj = common.uv_sphere(32, 16)
    common.edit(obj)
    common.select_faces(obj, lambda face: all(-0.6 < v.co.z < 0.6 for v in face.verts))
    assert sorted(len(loop.vertices) for loop in loops(obj)) == [32, 32]
    mesh = bmesh.from_edit_mesh(obj.data)
    split = [e for e in mesh.edges if all(abs(v.co.z) < 0.3 and v.co.x > 0.1 and abs(v.co.y) < 0.1 for v in e.verts)]
    assert len(split) > 1
    count = len(mesh.verts)
    bmesh.ops.split_edges(mesh, edges=split)
    assert len(mesh.verts) > count
    bmesh.update_edit_mesh(obj.data)
    assert sorted(len(loop.vertices) for loop in loops(obj)) == [32, 32]
    live([edit("TILT", loops(obj)[0].vertices[0], 10)])


def test_numbers_are_read_as_blender_reads_them():
    numbers = part("number_input").NumberInput

    def typed(*keys):
        number = numbers()
        taken = [number.take(key) for key in keys]
        return number, taken

    number, taken = typed("ONE", "NUMPAD_2", "PERIOD", "FIVE")
    assert number.value == 12.5 and all(taken) and number.text == "12.5|"
    assert typed("MINUS", "THREE")[0].value == -3 and typed("THREE", "NUMPAD_MINUS")[0].value == -3
    assert typed("MINUS", "THREE", "MINUS")[0].value == 3
    assert typed("PERIOD", "FIVE", "PERIOD", "FIVE")[0].value == 0.55
    assert typed("PERIOD")[0].value == 0 and typed("MINUS")[0].value == 0
    number, taken = typed("ONE", "BACK_SPACE", "BACK_SPACE", "A")
    assert number.value is None and not number.is_active and taken == [True, True, False, False]
    number, _ = typed("MINUS", "BACK_SPACE")
    assert number.value is None


def state(obj):
    made = region(obj)
    return made, part("live_state").LiveState(made.loops[0], int(made.loops[0].vertices[0]))


def test_changes_are_taken_back_one_by_one():
    obj, _, loop = cap()
    _, now = state(obj)
    now.choose("TILT")
    now.turn(now.current, 0.3, False)
    now.choose("BULGE")
    now.turn(now.current, 0.2, False)
    now.remember()
    assert [e.angle for e in now.edits.values()] == [0.3, 0.2]
    assert now.take_back() and [e.angle for e in now.edits.values()] == [0.3]
    assert now.take_back() and not now.edits
    assert not now.take_back()


def test_angles_go_in_steps_and_have_an_end():
    obj, _, loop = cap()
    _, now = state(obj)
    now.turn(now.current, math.radians(12), True)
    assert abs(now.current.angle - math.radians(10)) < 1e-12
    now.turn(now.current, 10.0, False)
    assert abs(now.current.angle - math.radians(170)) < 1e-12


def test_the_wheel_goes_from_the_whole_loop_to_two_edges_and_back():
    obj, _, loop = cap()
    _, now = state(obj)
    edge = loop.length / len(loop.vertices)
    now.widen(False, edge, 1.0)
    assert now.current.falloff == loop.length / 2
    for _ in range(60):
        now.widen(False, edge, 1.0)
    assert abs(now.current.falloff - 2 * edge) < 1e-9
    for _ in range(60):
        now.widen(True, edge, 1.0)
    assert now.current.falloff == 0
    assert (now.weights(1.0) == 1).all()


def test_a_thousand_frames_leave_nothing_behind():
    if sys.platform != "linux":
        return
    obj, free, loop = cap(lambda: common.irregular_sphere(16))
    part("native").load()
    moving = region(obj)
    moving.start(part("fairmesh").Monitor())
    kind = part("live_edits").Edit
    were = []
    for frame in range(1000):
        angle = 0.4 * math.sin(frame / 20)
        moving.edit([kind("TILT", int(loop.vertices[0]), angle, falloff=2.0)], (0,))
        moving.update(0.04)
        moving.positions()
        if frame in (200, 999):
            were.append(common.memory())
    moving.close()
    assert were[1] - were[0] < 8, were


if __name__ == "__main__":
    runner.run(sys.modules[__name__])
