# SPDX-License-Identifier: GPL-3.0-or-later
"""What the tests and measurements share. They run in Blender (blender --python) and in the module bpy (python)."""

import os
import sys
from pathlib import Path

import bpy  # isort: skip  (the module bpy brings bmesh along)
import bmesh
import numpy as np

EXTENSIONS = bpy.app.version >= (4, 2, 0)
#: The add-on's module after `install`.
NAME = "bl_ext.user_default.fairmesh" if EXTENSIONS else "fairmesh_blender"


def install(zip_path):
    """Installs and enables the zip through Blender's own operators."""
    if EXTENSIONS:
        # The module bpy has the add-on for extensions, but does not start it.
        bpy.ops.preferences.addon_enable(module="bl_pkg")
        bpy.ops.extensions.package_install_files(filepath=str(zip_path), repo="user_default", enable_on_install=True)
    else:
        bpy.ops.preferences.addon_install(filepath=str(zip_path), overwrite=True)
        bpy.ops.preferences.addon_enable(module=NAME)
    assert NAME in bpy.context.preferences.addons, f"{NAME} is not enabled"


def part(name):
    """A module of the installed add-on."""
    return sys.modules[f"{NAME}.{name}"]


def said():
    """What the last run left in the sidebar."""
    return " ".join(text for _, text in part("found")._said)


def clear():
    """An empty scene in Object mode."""
    if bpy.context.object and bpy.context.object.mode != "OBJECT":
        bpy.ops.object.mode_set(mode="OBJECT")
    for obj in list(bpy.data.objects):
        bpy.data.objects.remove(obj)
    for mesh in list(bpy.data.meshes):
        bpy.data.meshes.remove(mesh)


def add(name, vertices, faces, edges=()):
    """A new active object with this mesh."""
    mesh = bpy.data.meshes.new(name)
    mesh.from_pydata([tuple(v) for v in vertices], list(edges), [tuple(f) for f in faces])
    obj = bpy.data.objects.new(name, mesh)
    bpy.context.collection.objects.link(obj)
    activate(obj)
    return obj


def activate(obj):
    bpy.context.view_layer.objects.active = obj
    obj.select_set(True)


def coordinates(obj):
    """(n, 3) float64, as stored; also in Edit mode."""
    if obj.mode == "EDIT":
        return np.array([v.co[:] for v in bmesh.from_edit_mesh(obj.data).verts])
    flat = np.empty(3 * len(obj.data.vertices), np.float32)
    obj.data.vertices.foreach_get("co", flat)
    return flat.reshape(-1, 3).astype(np.float64)


def move(obj, positions):
    """In Object mode."""
    obj.data.vertices.foreach_set("co", np.asarray(positions, np.float32).ravel())
    obj.data.update()


def uv_sphere(segments, rings):
    """Blender's own UV sphere of radius 1, put onto the sphere: with many vertices it is off by up to 2e-5."""
    bpy.ops.mesh.primitive_uv_sphere_add(segments=segments, ring_count=rings)
    return _on_sphere(bpy.context.object)


def geodesic_sphere(frequency):
    """A geodesic sphere of 10 frequency^2 + 2 vertices: triangles nearly alike, other than at the poles of a UV sphere."""
    return _on_sphere(add("geodesic", *geodesic(frequency)))


def irregular_sphere(frequency, seed=1):
    """A geodesic sphere of 10 frequency^2 + 2 vertices, a sixth of its edges turned, then shaken by a sixth of an edge."""
    random = np.random.default_rng(seed)
    vertices, faces = geodesic(frequency)
    obj = add("irregular", vertices, faces)
    mesh = bmesh.new()
    mesh.from_mesh(obj.data)
    edges = list(mesh.edges)
    used = set()
    turned = []
    for index in random.permutation(len(edges))[: len(edges) // 4]:
        edge = edges[index]
        around = {v.index for f in edge.link_faces for v in f.verts}
        if not around & used:
            used |= {v.index for v in edge.verts}
            turned.append(edge)
    bmesh.ops.rotate_edges(mesh, edges=turned, use_ccw=True)
    mesh.to_mesh(obj.data)
    mesh.free()
    move(obj, coordinates(obj) + random.uniform(-1, 1, (len(vertices), 3)) * 1.1 / frequency / 6)
    return _on_sphere(obj)


def geodesic(frequency):
    """The icosahedron with edges cut into so many parts, on the unit sphere: vertices, triangles."""
    bpy.ops.mesh.primitive_ico_sphere_add(subdivisions=1)
    assert len(bpy.context.object.data.polygons) == 20
    ico = bpy.context.object
    corners = coordinates(ico)
    points, faces = [], []
    for polygon in ico.data.polygons:
        a, b, c = (corners[v] for v in polygon.vertices)
        start = len(points)
        number = {}
        for i in range(frequency + 1):
            for j in range(frequency + 1 - i):
                number[i, j] = start + len(number)
                points.append(a + (b - a) * i / frequency + (c - a) * j / frequency)
        for i, j in number:
            if (i + 1, j) in number and (i, j + 1) in number:
                faces.append((number[i, j], number[i + 1, j], number[i, j + 1]))
            if (i + 1, j) in number and (i, j + 1) in number and (i + 1, j + 1) in number:
                faces.append((number[i + 1, j], number[i + 1, j + 1], number[i, j + 1]))
    bpy.data.objects.remove(ico)
    points = np.array(points)
    _, first, inverse = np.unique(np.round(points * 1e5).astype(np.int64), axis=0, return_index=True, return_inverse=True)
    return points[first], inverse.ravel()[np.array(faces)]


def flattened_roof():
    """A roof whose ridge, along the x axis, is flattened in the middle, where its faces are selected; in Edit mode."""
    return _roof(lambda x, y, is_inside: np.where(is_inside, -3.0, -np.abs(y)))


#: How steep `flatten_and_mark` leaves the roof.
FLAT = 0.1


def flatten_and_mark(obj, how):
    """Makes the roof so flat that its ridge is no sharp edge, and marks that as "SHARP" or "CREASE", if asked."""
    mesh = bmesh.from_edit_mesh(obj.data)
    if how == "CREASE":
        layers = mesh.edges.layers
        layer = layers.crease.verify() if hasattr(layers, "crease") else layers.float.new("crease_edge")
    for vertex in mesh.verts:
        vertex.co.z *= FLAT
    for edge in mesh.edges:
        if how and all(abs(vertex.co.y) < 0.5 for vertex in edge.verts):
            if how == "SHARP":
                edge.smooth = False
            else:
                edge[layer] = 1.0
    bmesh.update_edit_mesh(obj.data)


def fading_ridge():
    """A ridge of 53 degrees along the x axis, which leads into the selected faces; beyond them the surface is flat."""

    def height(x, y, is_inside):
        far = np.clip((x + 3) / 6, 0, 1)
        return -np.abs(y) * (1 - far * far * (3 - 2 * far)) / 2

    return _roof(height)


def _roof(height):
    line = np.arange(15) - 7.0
    x, y = (grid.ravel() for grid in np.meshgrid(line, line))
    is_inside = (np.abs(x) < 4) & (np.abs(y) < 4)
    i = np.arange(15 * 15).reshape(15, 15)
    faces = np.stack([i[:-1, :-1], i[:-1, 1:], i[1:, 1:], i[1:, :-1]], axis=-1).reshape(-1, 4)
    obj = add("roof", np.stack([x, y, height(x, y, is_inside)], axis=1), faces)
    edit(obj)
    select_faces(obj, lambda face: any(is_inside[v.index] for v in face.verts))
    return obj


def _on_sphere(obj):
    exact = coordinates(obj)
    move(obj, exact / np.linalg.norm(exact, axis=1)[:, None])
    return obj


def tube(radius, start, end, turn=0.0, around=32):
    """An open tube between two points: vertices, quads."""
    start, end = np.asarray(start, float), np.asarray(end, float)
    axis = (end - start) / np.linalg.norm(end - start)
    u = np.cross(axis, (0, 1, 0))
    u /= np.linalg.norm(u)
    v = np.cross(axis, u)
    rows = max(3, round(np.linalg.norm(end - start) / (2 * np.pi * radius / around)))
    angle = turn + 2 * np.pi * np.arange(around) / around
    ring = radius * (np.outer(np.cos(angle), u) + np.outer(np.sin(angle), v))
    vertices = np.concatenate([start + (end - start) * k / rows + ring for k in range(rows + 1)])
    faces = [
        (i * around + j, i * around + (j + 1) % around, (i + 1) * around + (j + 1) % around, (i + 1) * around + j)
        for i in range(rows)
        for j in range(around)
    ]
    return vertices, faces


def tubes(*parts):
    """An object of several tubes, in the mode of edges."""
    vertices, faces, count = [], [], 0
    for part in parts:
        points, quads = tube(*part)
        vertices.append(points)
        faces += [[index + count for index in quad] for quad in quads]
        count += len(points)
    obj = add("tubes", np.concatenate(vertices), faces)
    edit(obj, "EDGE")
    return obj


def edit(obj, mode="FACE"):
    """Edit mode with this select mode and nothing selected."""
    activate(obj)
    if obj.mode != "EDIT":
        bpy.ops.object.mode_set(mode="EDIT")
    bpy.context.tool_settings.mesh_select_mode = (mode == "VERT", mode == "EDGE", mode == "FACE")
    bpy.ops.mesh.select_all(action="DESELECT")


def select_faces(obj, chosen):
    """Selects faces in Edit mode: `chosen(face)`."""
    _select(obj, "faces", chosen)


def select_vertices(obj, chosen):
    """Selects vertices in Edit mode: `chosen(vertex)`."""
    _select(obj, "verts", chosen)


def _select(obj, kind, chosen):
    mesh = bmesh.from_edit_mesh(obj.data)
    for element in getattr(mesh, kind):
        if chosen(element):
            element.select_set(True)
    mesh.select_flush_mode()
    bmesh.update_edit_mesh(obj.data, loop_triangles=False, destructive=False)


def delete_faces(obj, chosen):
    """In Edit mode, in the mode of edges; nothing is selected then."""
    edit(obj)
    select_faces(obj, chosen)
    bpy.ops.mesh.delete(type="FACE")
    # Edit mode would give new vertices the places of deleted ones in the order.
    bpy.ops.object.mode_set(mode="OBJECT")
    edit(obj, "EDGE")


def boundary_edges(obj):
    return [e for e in bmesh.from_edit_mesh(obj.data).edges if e.is_boundary]


def select_boundary(obj, chosen=lambda edge: True):
    for edge in boundary_edges(obj):
        if chosen(edge):
            edge.select_set(True)
    bmesh.update_edit_mesh(obj.data)


def flatten_cap(obj, height=0.2, offset=(0.0, 0.0, 0.0)):
    """Selects the faces above `height` of a unit sphere at `offset` and lays the vertices inside flat, in Edit mode.

    Returns the free vertices.
    """
    offset = np.asarray(offset)
    move(obj, coordinates(obj) + offset)
    edit(obj)
    select_faces(obj, lambda face: all(v.co.z - offset[2] > height for v in face.verts))
    mesh = bmesh.from_edit_mesh(obj.data)
    free = [v for v in mesh.verts if v.select and all(f.select for f in v.link_faces)]
    for vertex in free:
        vertex.co.z = height + offset[2]
    bmesh.update_edit_mesh(obj.data, destructive=False)
    return np.array([v.index for v in free])


def radial_error(obj, free, offset=(0.0, 0.0, 0.0)):
    """The largest distance of the free vertices from the unit sphere."""
    radius = np.linalg.norm(coordinates(obj)[free] - np.asarray(offset), axis=1)
    return float(np.abs(radius - 1).max())


def memory():
    """What the process has in memory, in MB; of Linux alone."""
    return int(Path("/proc/self/statm").read_text().split()[1]) * 4096 / 1e6


def leave(code):
    """Ends the process with this code, whichever way it was started."""
    sys.stdout.flush()
    os._exit(code)
