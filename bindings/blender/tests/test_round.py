# SPDX-License-Identifier: GPL-3.0-or-later
"""Round Edges, end to end."""

import math
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parent))
import bpy  # isort: skip
import bmesh
import common
import numpy as np
import runner
from common import boundary_edges, coordinates

WIDTH = 0.2
common.install(runner.arguments()[0])
round_edges = bpy.ops.mesh.fairmesh_round_edges


def cube(cuts=0):
    """Blender's own cube of side 2, in Edit mode, in the edge mode, nothing selected."""
    bpy.ops.mesh.primitive_cube_add(size=2)
    obj = bpy.context.object
    bpy.ops.object.mode_set(mode="EDIT")
    if cuts:
        bpy.ops.mesh.subdivide(number_cuts=cuts)
    select_edges(obj, lambda edge: False)
    return obj


def select_all():
    """In the face mode, where a face between selected edges is not selected by them."""
    bpy.context.tool_settings.mesh_select_mode = (False, False, True)
    bpy.ops.mesh.select_all(action="SELECT")


def select_edges(obj, chosen):
    bpy.context.tool_settings.mesh_select_mode = (False, True, False)
    mesh = bmesh.from_edit_mesh(obj.data)
    for edge in mesh.edges:
        edge.select_set(chosen(edge))
    mesh.select_flush_mode()
    bmesh.update_edit_mesh(obj.data)


def off_rounded_cube(points, radius):
    """How far points are from a cube whose edges are cylinders."""
    inner = np.clip(points, radius - 1, 1 - radius)
    return np.abs(np.linalg.norm(points - inner, axis=1) - radius)


def near_corner(points, within):
    return (np.abs(points) > 1 - within).all(axis=1)


def check_closed(obj):
    mesh = bmesh.from_edit_mesh(obj.data)
    assert not boundary_edges(obj)
    assert all(e.is_manifold and e.is_contiguous for e in mesh.edges) and all(v.link_faces for v in mesh.verts)
    assert len(mesh.verts) - len(mesh.edges) + len(mesh.faces) == 2


def test_a_cube_is_rounded_and_its_faces_stay_faces():
    obj = cube()
    select_all()
    assert round_edges(length=WIDTH) == {"FINISHED"}
    assert "12 runs of edges rounded" in common.said(), common.said()
    check_closed(obj)
    points = coordinates(obj)
    assert off_rounded_cube(points, WIDTH)[~near_corner(points, 3 * WIDTH)].max() < 1e-3
    mesh = bmesh.from_edit_mesh(obj.data)
    plane = [f for f in mesh.faces if not f.select]
    assert len(plane) == 6 and all(abs(max(np.abs(f.normal)) - 1) < 1e-6 for f in plane)
    assert all(f.smooth == f.select for f in mesh.faces)


def test_edges_are_chosen_and_flat_ones_are_not_meant():
    obj = cube(cuts=2)
    select_edges(obj, lambda edge: all(v.co.z > 0.99 for v in edge.verts))
    assert round_edges(measured="RADIUS", length=WIDTH) == {"FINISHED"}
    assert "4 runs of edges rounded" in common.said(), common.said()
    check_closed(obj)
    points = coordinates(obj)
    assert (points[:, 2] > -1.001).all() and np.abs(points[points[:, 2] < -0.99][:, :2]).max() == 1.0
    select_edges(obj, lambda edge: abs(edge.calc_face_angle(0)) < 0.01)
    runner.raises(lambda: round_edges(length=WIDTH), "no selected edge with two faces bends")
    select_edges(obj, lambda edge: False)
    assert not round_edges.poll()


def test_one_end_is_larger_than_the_other():
    obj = cube()
    select_edges(obj, lambda edge: all(v.co.x > 0.99 and v.co.y > 0.99 for v in edge.verts))
    assert round_edges(length=WIDTH, taper=2.0) == {"FINISHED"}
    check_closed(obj)
    points = coordinates(obj)
    # Arcs are nowhere nearer to the corner than this.
    ends = [np.linalg.norm(points[np.abs(points[:, 2] - z) < 1e-6] - (1, 1, z), axis=1).min() for z in (-1, 1)]
    assert np.allclose(np.sort(ends), (math.sqrt(2) - 1) * WIDTH * np.array((1, 2)), rtol=0.02), ends


def test_sizes_are_those_of_the_scene():
    obj = cube()
    obj.scale = (3, 3, 3)
    bpy.context.view_layer.update()
    select_all()
    assert round_edges(length=3 * WIDTH) == {"FINISHED"}
    points = coordinates(obj)
    assert off_rounded_cube(points, WIDTH)[~near_corner(points, 3 * WIDTH)].max() < 1e-3


def test_what_faces_have_goes_on():
    obj = cube(cuts=1)
    mesh = bmesh.from_edit_mesh(obj.data)
    colors = mesh.loops.layers.float_color.new("colors")
    uvs, weight = mesh.loops.layers.uv.verify(), mesh.edges.layers.float.new("weight")
    for material in "ab":
        obj.data.materials.append(bpy.data.materials.new(material))
    for face in mesh.faces:
        face.material_index = int(face.normal.z > 0.5)
        side = np.argmax(np.abs(face.normal))
        for corner in face.loops:
            at = np.array(corner.vert.co)
            corner[colors] = (*(at / 2 + 0.5), 1.0)
            corner[uvs].uv = np.delete(at, side)
    # It runs from one edge of the upper face to the other, through blends.
    seam = next(e for e in mesh.edges if all(v.co.z > 0.99 and v.co.x == 0 and v.co.y >= 0 for v in e.verts))
    seam.seam = True
    seam[weight] = 0.5
    select_all()
    assert round_edges(length=WIDTH) == {"FINISHED"}
    mesh = bmesh.from_edit_mesh(obj.data)
    colors, uvs = mesh.loops.layers.float_color["colors"], mesh.loops.layers.uv.verify()
    for face in mesh.faces:
        assert face.material_index == int(face.calc_center_median().z > 0.9) or face.select
        for corner in face.loops:
            # Those of blends are continued from faces beside them.
            most = 0.13 if face.select else 1e-5
            assert np.abs(np.array(corner[colors])[:3] - np.array(corner.vert.co) / 2 - 0.5).max() < most
        if not face.select:
            side = np.argmax(np.abs(face.normal))
            for corner in face.loops:
                assert np.abs(np.array(corner[uvs].uv) - np.delete(corner.vert.co, side)).max() < 1e-5
    seams = [e for e in mesh.edges if e.seam]
    assert all(e[mesh.edges.layers.float["weight"]] == 0.5 for e in seams)
    assert seams and all(abs(v.co.x) < 1e-6 and v.co.z > 0.99 for e in seams for v in e.verts)
    assert abs(sum(e.calc_length() for e in seams) - (1 - WIDTH)) < 0.02


def test_shape_keys_follow():
    obj = cube(cuts=1)
    bpy.ops.object.mode_set(mode="OBJECT")
    obj.shape_key_add(name="Basis")
    raised = obj.shape_key_add(name="Raised")
    for point in raised.data:
        point.co.z += 1.0
    bpy.ops.object.mode_set(mode="EDIT")
    obj.active_shape_key_index = 0
    select_all()
    assert round_edges(length=WIDTH) == {"FINISHED"}
    bpy.ops.object.mode_set(mode="OBJECT")
    basis, raised = (np.array([p.co[:] for p in obj.data.shape_keys.key_blocks[k].data]) for k in ("Basis", "Raised"))
    assert np.abs(raised - basis - [0, 0, 1]).max() < 1e-5


def test_what_cannot_be_is_told_and_nothing_is_changed():
    obj = cube()
    before = coordinates(obj)
    select_all()
    mesh = bmesh.from_edit_mesh(obj.data)
    mesh.faces.ensure_lookup_table()
    mesh.faces[0].hide_set(True)
    bmesh.update_edit_mesh(obj.data)
    select_edges(obj, lambda edge: not edge.hide)
    runner.raises(lambda: round_edges(length=WIDTH), "hidden faces", "The mesh is unchanged")
    assert np.array_equal(coordinates(obj), before)
    bpy.ops.mesh.reveal()
    select_all()
    round_edges(length=5.0)
    assert "narrower than asked" in common.said(), common.said()
    check_closed(obj)


runner.run(sys.modules[__name__])
