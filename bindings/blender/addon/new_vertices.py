# SPDX-License-Identifier: GPL-3.0-or-later
"""New vertices of an edit mesh that come from up to three old ones, with everything that the mesh stores on vertices.

What can be interpolated, is; the rest is that of the parent of the largest weight. And the layers of corners.
"""

import bmesh
import numpy as np


class NewVertices:
    """Vertices that are added to the edit mesh of a `Snapshot`."""

    def __init__(self, edit_mesh, mesh, olds, parents, weights):
        """`olds`: the old vertices by their numbers; `parents` and `weights`, (k, 3), of the new ones."""
        self.edit_mesh = edit_mesh
        self.mesh = mesh
        self.parents = parents
        self.weights = weights
        self.new = []
        self.faces = []
        self.old = olds

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

    def vertex(self, number):
        """A vertex by its number: the new ones come after all old ones."""
        old = len(self.mesh.vertices)
        return self.new[number - old] if number >= old else self.old[number]


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


def corner_layers(edit_mesh):
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
