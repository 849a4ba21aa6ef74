# SPDX-License-Identifier: GPL-3.0-or-later
"""Custom normals stay as they look. Blender stores them relative to the faces around: where vertices move and faces come,
those of faces that nobody has touched would turn, too.

At vertices that stay corners keep the normals that they are seen with, as the surface keeps its tangents there. Corners at
vertices that move have Blender's own.
"""

import bmesh
import bpy
import numpy as np

# Of faces, while something is written: their numbers before, from 1.
_MARK = "fairmesh_face"
# Corners at a vertex whose normals are nearer to each other than this (cosine, about half a degree) have one in common.
_ALIKE = 1 - 4e-5


def read(mesh):
    """The normals of all corners, (k, 3), in the object's coordinates; None where they are Blender's own."""
    if not mesh.has_custom_normals:
        return None
    flat = np.empty(3 * len(mesh.loops), np.float32)
    if bpy.app.version >= (4, 1, 0):
        mesh.corner_normals.foreach_get("vector", flat)
    else:
        mesh.calc_normals_split()
        mesh.loops.foreach_get("normal", flat)
        mesh.free_normals_split()
    return flat.reshape(-1, 3)


def mark(snapshot):
    """Before anything is written: faces are known again by this."""
    if snapshot.normals is None:
        return
    edit_mesh = bmesh.from_edit_mesh(snapshot.object.data)
    layer = edit_mesh.faces.layers.int.new(_MARK)
    for number, face in enumerate(edit_mesh.faces, 1):
        face[layer] = number


def is_new(edit_mesh, faces):
    """Takes the mark from new faces, which were made after the example of old ones."""
    layer = edit_mesh.faces.layers.int.get(_MARK)
    for face in faces if layer is not None else ():
        face[layer] = 0


def put_back(snapshots):
    """After all is written. Blender takes custom normals in Object mode alone."""
    chosen = [each for each in snapshots if each.normals is not None]
    if not chosen:
        return
    edited, selected = set(bpy.context.objects_in_mode), list(bpy.context.selected_objects)
    bpy.ops.object.mode_set(mode="OBJECT")
    for each in chosen:
        _put_back(each, each.object.data)
    # All selected objects go to Edit mode.
    for obj in bpy.context.view_layer.objects:
        obj.select_set(obj in edited)
    bpy.ops.object.mode_set(mode="EDIT")
    for obj in bpy.context.view_layer.objects:
        obj.select_set(obj in selected)


def _put_back(before, mesh):
    faces, corners = _get(mesh.polygons, "loop_total", np.int32), _get(mesh.loops, "vertex_index", np.int32)
    old_face = _get(mesh.attributes[_MARK].data, "value", np.int32) - 1
    mesh.attributes.remove(mesh.attributes[_MARK])
    # The corner that each was before, -1 for those of new faces.
    starts = np.concatenate([[0], np.cumsum(faces)[:-1]])
    within = np.arange(len(corners)) - np.repeat(starts, faces)
    of = np.repeat(old_face, faces)
    old = np.where(of >= 0, before.corner_starts[of] + within, -1)
    places = _get(mesh.vertices, "co", np.float32, 3)[corners]
    stays = (old >= 0) & (places == before.vertices[before.corners[old]].astype(np.float32)).all(axis=1)
    normals = np.where(stays[:, None], before.normals[old], 0)
    _continue(normals, corners, old, stays, len(mesh.vertices))
    # Blender 5 takes those that are there for its own, where none is given.
    if "custom_normal" in mesh.attributes:
        mesh.attributes.remove(mesh.attributes["custom_normal"])
    mesh.normals_split_custom_set(normals.tolist())


def _continue(normals, corners, old, stays, count):
    """Gives corners of new faces the normal that all old ones have at their vertex, if they are alike."""
    sums, alike = np.zeros((count, 3)), np.ones(count, bool)
    np.add.at(sums, corners[stays], normals[stays])
    sums /= np.maximum(np.linalg.norm(sums, axis=1, keepdims=True), 1e-12)
    differing = (sums[corners[stays]] * normals[stays]).sum(axis=1) < _ALIKE
    alike[corners[stays][differing]] = False
    new = (old < 0) & alike[corners]
    normals[new] = sums[corners[new]]


def _get(collection, name, kind, width=1):
    values = np.empty(len(collection) * width, kind)
    collection.foreach_get(name, values)
    return values if width == 1 else values.reshape(-1, width)
