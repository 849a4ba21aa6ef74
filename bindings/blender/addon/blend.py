# SPDX-License-Identifier: GPL-3.0-or-later
"""Writes a mesh with blends into an edit mesh, with everything that the mesh stores.

Faces that no blend reaches stay as they are. Those that are cut go, and their parts come in their place: with the face's
material and other values, its edges' marks, and at corners what the face has there. Blends have the values of the faces that
they lie nearest to, continued where these end.
"""

from dataclasses import dataclass

import bmesh
import numpy as np

from . import custom_normals, fairmesh, patch, snapshot
from .new_vertices import NewVertices, corner_layers

# Crease and bevel weight have layers of their own before Blender 4.0.
_EDGE_LAYERS = ("crease", "bevel_weight", "float", "int", "bool", "string", "float_vector", "float_color", "color")


@dataclass
class Change:
    """What a `fairmesh.Rounded` changes in the `Snapshot` it was made of. Vertices: the old ones, then the new ones."""

    #: Faces that go, ascending.
    erased: np.ndarray
    #: New triangles, (k, 3): first parts of those that go.
    triangles: np.ndarray
    part_count: int
    #: Of each the old triangle that it is a part of, or nearest to.
    sources: np.ndarray
    #: Positions of the new vertices, (j, 3), and where they lie on what goes.
    positions: np.ndarray
    places: fairmesh.Carried


def change(mesh, rounded):
    """The `Change`. Nothing of Blender is touched."""
    kept, parts = rounded.kept_vertices, rounded.kept_faces
    numbers = np.concatenate([kept, len(mesh.vertices) + np.arange(rounded.new_vertex_count)])
    triangles = numbers[rounded.faces]
    is_whole = _whole(mesh, triangles[: len(parts)], parts)
    stays = is_whole[mesh.face_of[parts]]
    gone = ~is_whole[mesh.face_of]
    positions = rounded.vertices[rounded.new_vertices]
    middles = rounded.vertices[rounded.faces[len(parts) :]].mean(axis=1)
    carried = fairmesh.carry_over(mesh.seen(), mesh.triangles, np.concatenate([positions, middles]), among=gone)
    places = fairmesh.Carried(*(each[: len(positions)] for each in (carried.faces, carried.corners, carried.weights)))
    new = np.concatenate([~stays, np.ones(len(middles), bool)])
    return Change(
        erased=np.flatnonzero(~is_whole),
        triangles=triangles[new],
        part_count=int(np.count_nonzero(~stays)),
        sources=np.concatenate([parts[~stays], carried.faces[len(positions) :]]),
        positions=positions,
        places=places,
    )


def _whole(mesh, triangles, sources):
    """Which faces are still there as they were: of their own corners alone, in as many triangles."""
    count = len(mesh.face_selected)
    faces = mesh.face_of[sources]
    keys = np.repeat(np.arange(count), np.diff(mesh.corner_starts)) * len(mesh.vertices) + mesh.corners
    own = np.isin(faces[:, None] * len(mesh.vertices) + triangles, keys).all(axis=1)
    as_before = np.bincount(mesh.face_of, minlength=count) == np.bincount(faces, minlength=count)
    as_before[faces[~own]] = False
    return as_before


def add(mesh, rounded, made):
    """Writes the `Change` of a `Snapshot`, and selects the blends."""
    edit_mesh = snapshot.edit_mesh(mesh)
    edit_mesh.faces.ensure_lookup_table()
    edit_mesh.verts.index_update()
    edit_mesh.faces.index_update()
    used = np.unique(np.concatenate([rounded.parents.ravel(), made.triangles.ravel()]))
    olds = {int(old): edit_mesh.verts[old] for old in used[used < len(mesh.vertices)]}
    blend = _Blend(edit_mesh, mesh, olds, rounded, made)
    try:
        blend.add_vertices(mesh.unseen(made.positions))
        blend.add_faces()
        blend.mark_edges()
    except BaseException:
        blend.remove()
        raise
    else:
        patch.clean(edit_mesh, *patch.erase(edit_mesh, made.erased))
        custom_normals.is_new(edit_mesh, blend.faces)
        blend.join_parts()
        blend.select()
    finally:
        # The edit mesh keeps normals of its own, which shade the faces: new faces would have none.
        edit_mesh.normal_update()
        bmesh.update_edit_mesh(mesh.object.data, loop_triangles=True, destructive=True)


class _Blend(NewVertices):
    def __init__(self, edit_mesh, mesh, olds, rounded, made):
        super().__init__(edit_mesh, mesh, olds, rounded.parents, rounded.parent_weights)
        self.made = made
        self.seen = mesh.seen()
        self.examples = {int(face): edit_mesh.faces[face] for face in made.erased}
        self.layers = list(corner_layers(edit_mesh))
        of_edges = edit_mesh.edges.layers
        kinds = [getattr(of_edges, name) for name in _EDGE_LAYERS if hasattr(of_edges, name)]
        self.edge_layers = [layer for kind in kinds for layer in kind.values()]
        # What faces that go have at their corners, by face and vertex.
        self.corners = {
            (face, corner.vert.index): [get(corner, layer) for layer, get, _, _ in self.layers]
            for face, example in self.examples.items()
            for corner in example.loops
        }
        self.charts = self._charts()
        self.at = {}
        for (face, vertex), values in self.corners.items():
            self.at.setdefault((vertex, self.charts[face]), values)
        # The edges between two of these faces.
        self.between = {}
        for face, example in self.examples.items():
            for edge in example.edges:
                for other in edge.link_faces:
                    if other.index > face and other.index in self.examples:
                        self.between.setdefault((face, other.index), []).append(edge)

    def _charts(self):
        """Per face that goes a number that it has in common with those beside it where all is the same on both sides."""
        chart = {}
        for face in self.examples:
            if face in chart:
                continue
            front = [face]
            while front:
                here = front.pop()
                if here in chart:
                    continue
                chart[here] = face
                for edge in self.examples[here].edges:
                    ends = [vertex.index for vertex in edge.verts]
                    for other in (each.index for each in edge.link_faces):
                        if other in self.examples and other not in chart and self._is_alike(here, other, ends):
                            front.append(other)
        return chart

    def _is_alike(self, here, there, ends):
        return all(self.corners[here, end] == self.corners[there, end] for end in ends)

    def add_faces(self):
        """The new faces after the example of those that go."""
        face_of, parts = self.mesh.face_of, self.made.part_count
        for at, (triangle, source) in enumerate(zip(self.made.triangles.tolist(), self.made.sources.tolist())):
            example = self.examples[int(face_of[source])]
            face = self.edit_mesh.faces.new([self.vertex(v) for v in triangle], example)
            face.smooth = face.smooth or at >= parts
            self.faces.append(face)
            for corner, vertex in zip(face.loops, triangle) if self.layers else ():
                for (layer, _, put, _), value in zip(self.layers, self._values(vertex, source)):
                    put(corner, layer, value)

    def _values(self, vertex, source):
        """What a corner at a vertex has, in a face whose values are those of an old triangle."""
        mesh, count = self.mesh, len(self.mesh.vertices)
        chart = self.charts[int(mesh.face_of[source])]
        if vertex < count:
            known = self.at.get((vertex, chart))
            if known is not None:
                return known
            return self._mixed(source, _weights(self.seen, mesh.triangles[source], self.seen[vertex]))
        on = int(self.made.places.faces[vertex - count])
        if on >= 0 and self.charts[int(mesh.face_of[on])] == chart:
            return self._mixed(on, self.made.places.weights[vertex - count])
        return self._mixed(source, _weights(self.seen, mesh.triangles[source], self.made.positions[vertex - count]))

    def _mixed(self, triangle, weights):
        """The values of an old triangle's corners by their weights, or those of the nearest where they cannot be mixed."""
        face = int(self.mesh.face_of[triangle])
        corners = [self.corners[face, int(v)] for v in self.mesh.triangles[triangle]]
        main = corners[int(np.argmax(weights))]
        return [
            (weights @ np.array([each[k] for each in corners])).tolist() if mixes else main[k]
            for k, (_, _, _, mixes) in enumerate(self.layers)
        ]

    def mark_edges(self):
        """Where an edge between two faces that are cut goes on between their parts, it is marked as before."""
        part_of = dict(zip(self.faces, self._part_faces()))
        for face, own in part_of.items():
            for edge in face.edges:
                for other in (part_of[f] for f in edge.link_faces if part_of.get(f, own) > own):
                    for old in self.between.get((own, other), ()):
                        if old != edge:
                            self._copy_edge(edge, old)

    def _copy_edge(self, edge, old):
        """Its marks. BMEdge.copy_from would copy what Python knows the edge by, too."""
        edge.seam, edge.smooth = old.seam, old.smooth
        for layer in self.edge_layers:
            edge[layer] = old[layer]

    def _part_faces(self):
        return self.mesh.face_of[self.made.sources[: self.made.part_count]].tolist()

    def join_parts(self):
        """Parts of a face with more than three corners become one face, as far as they hang together."""
        sizes = np.diff(self.mesh.corner_starts)
        part_of = {f: own for f, own in zip(self.faces, self._part_faces()) if sizes[own] > 3}
        between = set()
        for face, own in part_of.items():
            for edge in face.edges:
                if len(edge.link_faces) == 2 and all(part_of.get(f) == own for f in edge.link_faces):
                    between.add(edge)
        bmesh.ops.dissolve_edges(self.edit_mesh, edges=list(between), use_verts=False, use_face_split=False)

    def select(self):
        """The blends."""
        for face in self.faces[self.made.part_count :]:
            face.select_set(True)
        self.edit_mesh.select_flush_mode()


def _weights(vertices, triangle, place):
    """Of a triangle's corners, at the place in its plane that is nearest to this one; no further out than it is long."""
    a, b, c = vertices[triangle]
    matrix = np.stack([b - a, c - a], axis=1)
    found = np.linalg.lstsq(matrix, place - a, rcond=1e-6)[0]
    weights = np.clip([1 - found.sum(), *found], -1, 2)
    return weights / weights.sum()
