# SPDX-License-Identifier: GPL-3.0-or-later
"""A mesh in Edit or Object mode as arrays for the library, and positions back into it.

Faces of any number of corners become triangles for the computation only; the mesh keeps its faces.
"""

from dataclasses import dataclass
from functools import cached_property

import bmesh
import bpy
import numpy as np

from . import custom_normals, fairmesh


class Stale(Exception):
    """The mesh is not any more what was read."""


@dataclass
class Snapshot:
    """What was read. n vertices, m triangles, p faces, e edges; hidden geometry included."""

    object: object
    #: (n, 3) float64, in the object's coordinates; of the active shape key.
    vertices: np.ndarray
    #: (m, 3) int32, and the face that each is a part of, (m,).
    triangles: np.ndarray
    face_of: np.ndarray
    #: (n,) and (p,) masks.
    vertex_selected: np.ndarray
    vertex_hidden: np.ndarray
    face_selected: np.ndarray
    face_hidden: np.ndarray
    #: The number of each face's material, (p,).
    materials: np.ndarray
    #: The corners of all faces one after the other: their vertices and edges, and where each face begins, (p + 1,).
    corners: np.ndarray
    edge_of_corner: np.ndarray
    corner_starts: np.ndarray
    #: How many faces each edge has, (e,), and the vertices at edges with one, (n,).
    edge_faces: np.ndarray
    on_boundary: np.ndarray
    #: The vertices of edges that are marked sharp or creased, (k, 2).
    marked_edges: np.ndarray
    #: 3 by 3: where lengths and angles are those seen in the scene. None: in the object's own coordinates.
    shape: object
    #: Custom normals of the corners, (k, 3), or None.
    normals: object
    #: How many times larger the object is seen than its `seen` vertices are.
    size: float

    @property
    def counts(self):
        """Vertices, edges, faces."""
        return len(self.vertices), len(self.edge_faces), len(self.face_selected)

    def seen(self):
        """The vertices as they are seen in the scene, up to place, direction and size."""
        if self.shape is None:
            return self.vertices
        # Not by a matrix product, which may round each row in its own way: copies of a vertex stay copies.
        return (self.vertices[:, None, :] * self.shape).sum(axis=2)

    def seen_way(self, way):
        """A direction and length of the object's coordinates, (3,), as it is there."""
        return way if self.shape is None else self.shape @ way

    @cached_property
    def on_surface_boundary(self):
        """The vertices on the boundary of the surface, (n,), where edges that lie on each other are one."""
        mask = self.on_boundary
        places, place = np.unique(self.vertices[mask] + 0.0, axis=0, return_inverse=True)
        if len(places) == np.count_nonzero(mask):
            return mask
        place = place.ravel()
        of_vertex = np.full(len(mask), -1)
        of_vertex[mask] = place
        # Not all that have no copy: a slit ends in one, and is none where its sides lie on each other.
        is_open = np.zeros(len(places), bool)
        for loop in fairmesh.boundary_loops(self.seen(), self.triangles):
            is_open[of_vertex[loop.vertices]] = True
        made = mask.copy()
        made[mask] = is_open[place]
        return made

    def unseen(self, positions):
        """Such positions in the object's coordinates."""
        if self.shape is None:
            return positions
        return (positions[:, None, :] * np.linalg.inv(self.shape)).sum(axis=2)  # as above


def read(obj):
    """Reads the mesh of an object."""
    mesh = obj.data
    editing = obj.mode == "EDIT"
    if editing:
        # foreach_get sees the mesh as it was when Edit mode was entered, until this.
        obj.update_from_editmode()
    mesh.calc_loop_triangles()
    corners = _indices(mesh.loops, "vertex_index")
    edge_of_corner = _indices(mesh.loops, "edge_index")
    edge_faces = np.bincount(edge_of_corner, minlength=len(mesh.edges))
    sizes = _indices(mesh.polygons, "loop_total")
    return Snapshot(
        object=obj,
        vertices=_positions(obj, mesh, editing),
        triangles=corners[_indices(mesh.loop_triangles, "loops", 3)],
        # A face of k corners has k - 2 triangles, and they stand in the order of the faces.
        face_of=np.repeat(np.arange(len(sizes), dtype=np.int32), sizes - 2),
        vertex_selected=_get(mesh.vertices, "select", bool),
        vertex_hidden=_get(mesh.vertices, "hide", bool),
        face_selected=_get(mesh.polygons, "select", bool),
        face_hidden=_get(mesh.polygons, "hide", bool),
        materials=_get(mesh.polygons, "material_index", np.int32),
        corners=corners,
        edge_of_corner=edge_of_corner,
        corner_starts=np.concatenate([[0], np.cumsum(sizes, dtype=np.int64)]),
        edge_faces=edge_faces,
        on_boundary=_on_boundary(mesh, edge_faces),
        marked_edges=_marked_edges(mesh, editing),
        shape=_shape(obj),
        normals=custom_normals.read(mesh),
        size=_size(obj),
    )


def _marked_edges(mesh, editing):
    marked = _get(mesh.edges, "use_edge_sharp", bool) | _creased(mesh, editing)
    return _indices(mesh.edges, "vertices", 2)[marked]


def _creased(mesh, editing):
    if "crease" in bpy.types.MeshEdge.bl_rna.properties:  # before Blender 4.0
        return _get(mesh.edges, "crease", np.float32) > 0
    if "crease_edge" not in mesh.attributes:
        return np.zeros(len(mesh.edges), bool)
    if not editing:
        return _get(mesh.attributes["crease_edge"].data, "value", np.float32) > 0
    # Attributes have no data in Edit mode.
    edges = bmesh.from_edit_mesh(mesh).edges
    layer = edges.layers.float["crease_edge"]
    return np.fromiter((edge[layer] > 0 for edge in edges), bool, len(edges))


def _on_boundary(mesh, edge_faces):
    mask = np.zeros(len(mesh.vertices), bool)
    for edge in np.flatnonzero(edge_faces == 1).tolist():
        mask[list(mesh.edges[edge].vertices)] = True
    return mask


def selected_edges(obj, among=True):
    """(k, 2): the ends of the selected edges, of a mesh that was just read, of those in a mask."""
    mesh = obj.data
    return _indices(mesh.edges, "vertices", 2)[_get(mesh.edges, "select", bool) & among]


def _indices(collection, name, width=1):
    # Blender's indices and counts are unsigned: into signed arrays they go one by one, 20 times slower.
    return _get(collection, name, np.uint32, width).view(np.int32)


def _get(collection, name, kind, width=1):
    values = np.empty(len(collection) * width, kind)
    collection.foreach_get(name, values)
    return values if width == 1 else values.reshape(-1, width)


def _positions(obj, mesh, editing):
    if editing and mesh.shape_keys:
        # The mesh has the basis; what is edited is the active key, and only the edit mesh has that.
        edit_mesh = bmesh.from_edit_mesh(mesh)
        flat = np.fromiter((x for v in edit_mesh.verts for x in v.co), np.float64, 3 * len(edit_mesh.verts))
        return flat.reshape(-1, 3)
    return _get(mesh.vertices, "co", np.float32, 3).astype(np.float64)


def _size(obj):
    size = abs(float(np.cbrt(np.linalg.det(np.array(obj.matrix_world, np.float64)[:3, :3]))))
    return size if size > 0 else 1.0


def _shape(obj):
    """The object's scale and shear where they change angles; a reflection is taken out."""
    matrix = np.array(obj.matrix_world, np.float64)[:3, :3]
    size = np.cbrt(np.linalg.det(matrix))
    if size == 0:
        return None
    matrix /= size
    return None if np.allclose(matrix @ matrix.T, np.eye(3), rtol=0, atol=1e-5) else matrix


def edit_mesh(snapshot):
    """The edit mesh, if it still is the one that was read."""
    obj = snapshot.object
    try:
        if obj.mode != "EDIT":
            raise Stale
        found = bmesh.from_edit_mesh(obj.data)
    except ReferenceError:
        raise Stale from None
    if (len(found.verts), len(found.edges), len(found.faces)) != snapshot.counts:
        raise Stale
    found.verts.ensure_lookup_table()
    return found


def write_positions(snapshot, indices, positions):
    """Moves the vertices `indices` (k,) to `positions` (k, 3), in the object's coordinates."""
    found = edit_mesh(snapshot)
    vertices = found.verts
    for index, position in zip(indices.tolist(), positions.tolist()):
        vertices[index].co = position
    # The edit mesh keeps normals of its own, which shade the faces.
    found.normal_update()
    bmesh.update_edit_mesh(snapshot.object.data, loop_triangles=True, destructive=False)
