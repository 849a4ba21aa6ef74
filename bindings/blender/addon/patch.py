# SPDX-License-Identifier: GPL-3.0-or-later
"""Writes the new vertices and faces of filled holes into an edit mesh, with everything that the mesh stores on them.

New vertices have three parents among the old ones, with weights: what can be interpolated, is. New faces take material,
shading and other values from a face at their hole's boundary.
"""

from math import radians

import bmesh
import numpy as np

from . import custom_normals, snapshot
from .new_vertices import NewVertices, corner_layers

# As Face > Tris to Quads has it: how far two triangles may be bent, and a quad's corners from right angles.
_PAIR = {"angle_face_threshold": radians(40), "angle_shape_threshold": radians(40)}


def add(mesh, filled, erased=(), moved=(), pair=False):
    """Adds what a `fairmesh.Filled` or `fairmesh.Bridged` has more than the `Snapshot` it was made of, and selects it.

    `erased`: the numbers of faces that go, and of which nothing is left then. `moved`: those of old vertices that move.
    `pair`: whether new triangles become quads, where two make a good one.
    """
    edit_mesh = snapshot.edit_mesh(mesh)
    movers = [edit_mesh.verts[index] for index in moved]
    places = mesh.unseen(filled.vertices[moved]).tolist() if len(movers) else []
    positions = mesh.unseen(filled.vertices[filled.new_vertices])
    triangles = filled.faces[filled.new_faces]
    used = np.unique(np.concatenate([filled.parents.ravel(), triangles.ravel()]))
    olds = {int(old): edit_mesh.verts[old] for old in used[used < len(mesh.vertices)]}
    remains = erase(edit_mesh, erased)
    patch = _Patch(edit_mesh, mesh, olds, filled.parents, filled.parent_weights)
    try:
        patch.add_vertices(positions)
        patch.add_faces(triangles)
        custom_normals.is_new(edit_mesh, patch.faces)
        # Shape keys are carried on from where the old vertices were.
        for vertex, place in zip(movers, places):
            if vertex.is_valid:
                vertex.co = place
        clean(edit_mesh, *remains)
        if pair:
            edit_mesh.normal_update()
            bmesh.ops.join_triangles(edit_mesh, faces=[face for face in patch.faces if len(face.verts) == 3], **_PAIR)
    except BaseException:
        patch.remove()
        raise
    finally:
        # The edit mesh keeps normals of its own, which shade the faces: new faces would have none.
        edit_mesh.normal_update()
        bmesh.update_edit_mesh(mesh.object.data, loop_triangles=True, destructive=True)


def erase(edit_mesh, erased):
    """Deletes faces; their edges and vertices, which stay for now."""
    if not len(erased):
        return [], []
    edit_mesh.faces.ensure_lookup_table()
    faces = [edit_mesh.faces[index] for index in erased]
    edges = list({edge for face in faces for edge in face.edges})
    verts = list({vert for face in faces for vert in face.verts})
    bmesh.ops.delete(edit_mesh, geom=faces, context="FACES_ONLY")
    return edges, verts


def clean(edit_mesh, edges, verts):
    """Takes edges without faces away, then vertices without edges."""
    for edge in edges:
        if edge.is_valid and not edge.link_faces:
            edit_mesh.edges.remove(edge)
    for vert in verts:
        if vert.is_valid and not vert.link_edges:
            edit_mesh.verts.remove(vert)


class _Patch(NewVertices):
    def __init__(self, *given):
        super().__init__(*given)
        # Before anything is added: the corner of an old face that speaks for each vertex.
        self.corner = {old: _corner(vertex) for old, vertex in self.old.items()}

    def add_faces(self, triangles):
        old = len(self.mesh.vertices)
        values = self._corner_values()
        for triangle in triangles.tolist():
            main = self._main_corner(triangle, old)
            face = self.edit_mesh.faces.new([self.vertex(v) for v in triangle], main.face)
            face.hide = False
            self.faces.append(face)
            for corner, vertex in zip(face.loops, triangle):
                self._write_corner(corner, vertex, old, values)
        for face in self.faces:
            face.select_set(True)
        self.edit_mesh.select_flush_mode()

    def _main_corner(self, triangle, old):
        """The old corner that says most about a new triangle."""
        for vertex in triangle:
            if vertex < old:
                return self.corner[vertex]
        parents, weights = self.parents[triangle[0] - old], self.weights[triangle[0] - old]
        return self.corner[int(parents[np.argmax(weights)])]

    def _corner_values(self):
        """Per layer of corners: (layer, setter, values at the old corners, values at the new vertices)."""
        made = []
        main = [int(three[at]) for three, at in zip(self.parents, self.weights.argmax(axis=1))]
        for layer, get, put, mixes in corner_layers(self.edit_mesh):
            known = {old: get(corner, layer) for old, corner in self.corner.items()}
            if mixes and len(main):
                at_parents = np.array([[known[parent] for parent in three] for three in self.parents.tolist()])
                values = np.einsum("ij,ij...->i...", self.weights, at_parents).tolist()
            else:
                values = [known[parent] for parent in main]
            made.append((layer, put, known, values))
        return made

    def _write_corner(self, corner, vertex, old, values):
        for layer, put, known, at_new in values:
            put(corner, layer, known[vertex] if vertex < old else at_new[vertex - old])


def _corner(vertex):
    """A corner of a face at the vertex; beside the hole if there is one."""
    for edge in vertex.link_edges:
        if edge.is_boundary:
            loop = edge.link_loops[0]
            return loop if loop.vert == vertex else loop.link_loop_next
    return vertex.link_loops[0]
