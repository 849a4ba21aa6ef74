# SPDX-License-Identifier: GPL-3.0-or-later
"""Writes the new vertices and faces of filled holes into an edit mesh, with everything that the mesh stores on them.

New vertices have three parents among the old ones, with weights: what can be interpolated, is. New faces take material,
shading and other values from a face at their hole's boundary.
"""

from math import radians

import bmesh
import numpy as np

from . import custom_normals, snapshot

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
    remains = _erase(edit_mesh, erased)
    patch = _Patch(edit_mesh, mesh, olds, filled.parents, filled.parent_weights)
    try:
        patch.add_vertices(positions)
        patch.add_faces(triangles)
        custom_normals.is_new(edit_mesh, patch.faces)
        # Shape keys are carried on from where the old vertices were.
        for vertex, place in zip(movers, places):
            if vertex.is_valid:
                vertex.co = place
        _clean(edit_mesh, *remains)
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


def _erase(edit_mesh, erased):
    """Deletes faces; their edges and vertices, which stay for now."""
    if not len(erased):
        return [], []
    edit_mesh.faces.ensure_lookup_table()
    faces = [edit_mesh.faces[index] for index in erased]
    edges = list({edge for face in faces for edge in face.edges})
    verts = list({vert for face in faces for vert in face.verts})
    bmesh.ops.delete(edit_mesh, geom=faces, context="FACES_ONLY")
    return edges, verts


def _clean(edit_mesh, edges, verts):
    """Takes edges without faces away, then vertices without edges."""
    for edge in edges:
        if edge.is_valid and not edge.link_faces:
            edit_mesh.edges.remove(edge)
    for vert in verts:
        if vert.is_valid and not vert.link_edges:
            edit_mesh.verts.remove(vert)


class _Patch:
    def __init__(self, edit_mesh, mesh, olds, parents, weights):
        self.edit_mesh = edit_mesh
        self.mesh = mesh
        self.parents = parents
        self.weights = weights
        self.new = []
        self.faces = []
        # Before anything is added: the old vertices, and the corner of an old face that speaks for each.
        self.old = olds
        self.corner = {old: _corner(vertex) for old, vertex in self.old.items()}

    def remove(self):
        """Takes back what was added; erased faces stay away."""
        bmesh.ops.delete(self.edit_mesh, geom=self.faces, context="FACES_ONLY")
        bmesh.ops.delete(self.edit_mesh, geom=self.new, context="VERTS")

    def add_vertices(self, positions):
        verts = self.edit_mesh.verts
        helper = verts.new()
        for position, parents, weights in zip(positions.tolist(), self.parents.tolist(), self.weights.tolist()):
            # What cannot be interpolated comes from the main parent.
            new = verts.new(position, self.old[parents[weights.index(max(weights))]])
            _interpolate(new, helper, self._shares(parents, weights))
            new.hide = False
            self.new.append(new)
        verts.remove(helper)
        self._shape_keys(positions)

    def _shares(self, parents, weights):
        """The different parents that count: [(vertex, weight)]."""
        shares = {}
        for parent, weight in zip(parents, weights):
            if weight > 0:
                shares[parent] = shares.get(parent, 0.0) + weight
        return [(self.old[parent], weight) for parent, weight in shares.items()]

    def _shape_keys(self, positions):
        """In other shape keys the patch is moved as its parents are."""
        shapes = self.edit_mesh.verts.layers.shape
        for layer in shapes.values():
            key = self.mesh.object.data.shape_keys.key_blocks.get(layer.name)
            active = key == self.mesh.object.active_shape_key
            for at, new in enumerate(self.new):
                new[layer] = positions[at] if active else positions[at] + self._offset(layer, at)

    def _offset(self, layer, at):
        offset = np.zeros(3)
        for parent, weight in zip(self.parents[at], self.weights[at]):
            vertex = self.old[int(parent)]
            offset += weight * np.subtract(vertex[layer], vertex.co)
        return offset

    def add_faces(self, triangles):
        old = len(self.mesh.vertices)
        values = self._corner_values()
        for triangle in triangles.tolist():
            main = self._main_corner(triangle, old)
            verts = [self.new[v - old] if v >= old else self.old[v] for v in triangle]
            face = self.edit_mesh.faces.new(verts, main.face)
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
        for layer, get, put, mixes in _corner_layers(self.edit_mesh):
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


def _interpolate(target, helper, shares):
    """Values of up to three vertices with their weights; Blender mixes two at a time."""
    if len(shares) < 2:
        return
    (first, a), (second, b) = shares[:2]
    mixed = target if len(shares) == 2 else helper
    mixed.copy_from_vert_interp((first, second), b / (a + b))
    if len(shares) == 3:
        third, c = shares[2]
        target.copy_from_vert_interp((helper, third), c / (a + b + c))


def _corner_layers(edit_mesh):
    """(layer, getter, setter, can be mixed). BMLoop.copy_from would copy what Python knows the corner by, too."""
    layers = edit_mesh.loops.layers
    for layer in layers.uv.values():
        yield layer, _get_uv, _put_uv, True
    for name in ("color", "float_color", "float_vector", "float"):
        for layer in getattr(layers, name).values():
            yield layer, _get, _put, True
    for name in ("int", "bool", "string"):
        for layer in getattr(layers, name).values() if hasattr(layers, name) else ():
            yield layer, _get, _put, False


def _get_uv(corner, layer):
    return tuple(corner[layer].uv)


def _put_uv(corner, layer, value):
    corner[layer].uv = value


def _get(corner, layer):
    value = corner[layer]
    return value if isinstance(value, (float, int, bytes)) else tuple(value)


def _put(corner, layer, value):
    corner[layer] = value
