"""Meshes of trimesh."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from ._carry import Change
from ._hosts import Host


class Trimesh(Host):
    """A `trimesh.Trimesh`: colours, texture coordinates, attributes and metadata are kept; normals are made anew."""

    vertex_data_name = "vertex_attributes"
    face_data_name = "face_attributes"

    def __init__(self, mesh: Any) -> None:
        # A primitive has no vertices of its own.
        self._mesh = mesh.to_mesh() if hasattr(mesh, "primitive") else mesh
        self.vertices = np.asarray(self._mesh.vertices)
        self.faces = np.asarray(self._mesh.faces)

    def vertex_data(self, name: str) -> Any:
        """A vertex attribute."""
        return self._mesh.vertex_attributes.get(name)

    def face_data(self, name: str) -> Any:
        """A face attribute."""
        return self._mesh.face_attributes.get(name)

    def moved(self, vertices: NDArray[Any]) -> Any:
        """A copy with other positions."""
        made = self._mesh.copy()
        made.vertices = vertices
        return made

    def rebuilt(self, change: Change) -> Any:
        """A copy with other vertices and faces."""
        made = self._mesh.copy()
        visual = self._visual(change)
        made.vertices, made.faces = change.vertices, change.faces
        made.vertex_attributes.clear()
        made.face_attributes.clear()
        for name, values in self._mesh.vertex_attributes.items():
            made.vertex_attributes[name] = change.of_vertices(np.asarray(values))
        for name, values in self._mesh.face_attributes.items():
            made.face_attributes[name] = change.of_faces(np.asarray(values))
        made.visual = visual
        return made

    def _visual(self, change: Change) -> Any:
        visual = self._mesh.visual
        if visual.kind == "texture":
            uv = None if visual.uv is None else change.of_vertices(np.asarray(visual.uv))
            per_face = visual.face_materials
            materials = None if per_face is None else change.of_faces(np.asarray(per_face))
            return type(visual)(uv=uv, material=visual.material, face_materials=materials)
        if visual.kind == "vertex":
            return type(visual)(vertex_colors=change.of_vertices(np.asarray(visual.vertex_colors)))
        if visual.kind == "face":
            return type(visual)(face_colors=change.of_faces(np.asarray(visual.face_colors)))
        return visual.copy()
