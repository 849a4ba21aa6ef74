"""Meshes of Open3D, of both of its interfaces."""

from __future__ import annotations

import copy
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ._carry import Change, vertex_normals
from ._hosts import Host, package


class TriangleMesh(Host):
    """An `open3d.geometry.TriangleMesh`: colours, texture coordinates and materials are kept, normals made anew."""

    vertex_data_name = face_data_name = "attributes"

    def __init__(self, mesh: Any) -> None:
        self._mesh = mesh
        self.vertices = np.array(mesh.vertices)
        self.faces = np.array(mesh.triangles)

    def moved(self, vertices: NDArray[Any]) -> Any:
        """A copy with other positions."""
        made = copy.deepcopy(self._mesh)
        made.vertices = self._utility.Vector3dVector(vertices)
        self._renew(made)
        return made

    def rebuilt(self, change: Change) -> Any:
        """A mesh with other vertices and faces."""
        given, vectors = self._mesh, self._utility
        made = copy.deepcopy(given)
        made.vertices = vectors.Vector3dVector(change.vertices)
        made.triangles = vectors.Vector3iVector(change.faces.astype(np.int32))
        if given.has_vertex_colors():
            made.vertex_colors = vectors.Vector3dVector(change.of_vertices(np.asarray(given.vertex_colors)))
        if given.has_vertex_normals():
            made.vertex_normals = vectors.Vector3dVector(change.of_vertices(np.asarray(given.vertex_normals)))
        if given.has_triangle_uvs():
            corners = np.asarray(given.triangle_uvs).reshape(-1, 3, 2)
            made.triangle_uvs = vectors.Vector2dVector(change.of_corners(corners).reshape(-1, 2))
        if len(given.triangle_material_ids):
            ids = change.of_faces(np.asarray(given.triangle_material_ids))
            made.triangle_material_ids = vectors.IntVector(ids.astype(np.int32))
        if given.has_adjacency_list():
            made.compute_adjacency_list()
        self._renew(made)
        return made

    @property
    def _utility(self) -> Any:
        return package("open3d").utility

    def _renew(self, made: Any) -> None:
        if made.has_vertex_normals():
            normals = self.renewed(made.vertex_normals, np.asarray(made.vertices), np.asarray(made.triangles))
            made.vertex_normals = self._utility.Vector3dVector(normals)
        if self._mesh.has_triangle_normals():
            made.compute_triangle_normals()


class TensorMesh(Host):
    """An `open3d.t.geometry.TriangleMesh`: all of its attributes are kept, normals made anew, on the same device."""

    vertex_data_name = "vertex"
    face_data_name = "triangle"

    def __init__(self, mesh: Any) -> None:
        self._mesh = mesh
        self.vertices = mesh.vertex.positions.cpu().numpy().copy()
        self.faces = mesh.triangle.indices.cpu().numpy().copy()

    def vertex_data(self, name: str) -> Any:
        """An attribute of the vertices."""
        return self._mesh.vertex[name].cpu().numpy() if name in self._mesh.vertex else None

    def face_data(self, name: str) -> Any:
        """An attribute of the triangles."""
        return self._mesh.triangle[name].cpu().numpy() if name in self._mesh.triangle else None

    def moved(self, vertices: NDArray[Any]) -> Any:
        """A copy with other positions."""
        made = self._mesh.clone()
        made.vertex.positions = self._tensor(vertices)
        self._renew(made, vertices, self.faces)
        return made

    def rebuilt(self, change: Change) -> Any:
        """A mesh with other vertices and faces."""
        made = self._mesh.clone()
        for name in list(self._mesh.vertex):
            values = self._mesh.vertex[name].cpu().numpy()
            made.vertex[name] = self._tensor(change.vertices if name == "positions" else change.of_vertices(values))
        for name in list(self._mesh.triangle):
            values = self._mesh.triangle[name].cpu().numpy()
            if name == "indices":
                values = change.faces.astype(values.dtype)
            elif name == "texture_uvs":
                values = change.of_corners(values)
            else:
                values = change.of_faces(values)
            made.triangle[name] = self._tensor(values)
        self._renew(made, change.vertices, change.faces)
        return made

    def _tensor(self, values: NDArray[Any]) -> Any:
        core = package("open3d").core
        return core.Tensor(np.ascontiguousarray(values), device=self._mesh.device)

    def _renew(self, made: Any, vertices: NDArray[Any], faces: NDArray[Any]) -> None:
        if "normals" in made.vertex:
            normals = made.vertex["normals"].cpu().numpy()
            made.vertex["normals"] = self._tensor(self.renewed(normals, vertices, faces).astype(normals.dtype))
        if "normals" in made.triangle:
            # Of each face alone: as if it had its corners for itself.
            dtype = made.triangle["normals"].cpu().numpy().dtype
            alone = vertex_normals(vertices[faces].reshape(-1, 3), np.arange(3 * len(faces)).reshape(-1, 3))
            made.triangle["normals"] = self._tensor(alone[::3].astype(dtype))
