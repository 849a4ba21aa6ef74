"""Meshes of pyvista."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from ._carry import NORMALS, Change
from ._hosts import Host, package


class PolyData(Host):
    """A `pyvista.PolyData`: all of its data are kept; normals at its points are made anew where the surface changes."""

    vertex_data_name = "point_data"
    face_data_name = "cell_data"

    def __init__(self, mesh: Any) -> None:
        if mesh.n_strips:
            raise ValueError("the PolyData has triangle strips: give mesh.triangulate()")
        padded = np.asarray(mesh.faces)
        if len(padded) % 4 or (padded[::4] != 3).any():
            raise ValueError("the PolyData has faces that are no triangles: give mesh.triangulate()")
        self._mesh = mesh
        self._others = mesh.n_verts + mesh.n_lines
        # Copies: what is told to be changed is what differs from them.
        self.vertices = np.array(mesh.points)
        self.faces = np.array(padded.reshape(-1, 4)[:, 1:], order="C")

    def vertex_data(self, name: str) -> Any:
        """An array of the points."""
        return np.asarray(self._mesh.point_data[name]) if name in self._mesh.point_data else None

    def face_data(self, name: str) -> Any:
        """An array of the cells, as far as they are faces: vertices and lines come before them."""
        return np.asarray(self._mesh.cell_data[name])[self._others :] if name in self._mesh.cell_data else None

    def moved(self, vertices: NDArray[Any]) -> Any:
        """A copy with other positions."""
        made = self._mesh.copy(deep=True)
        made.points = vertices
        self._renew(made, vertices, self.faces)
        for name in list(made.cell_data):
            if name.lower() in NORMALS:
                del made.cell_data[name]
        return made

    def rebuilt(self, change: Change) -> Any:
        """A mesh with other vertices and faces."""
        if self._others:
            raise ValueError(
                "the PolyData has vertices or lines beside its faces: give one of its faces alone, "
                "pyvista.PolyData.from_regular_faces(mesh.points, mesh.regular_faces)"
            )
        given = self._mesh
        made = package("pyvista").PolyData.from_regular_faces(change.vertices, change.faces)
        for name, values in given.point_data.items():
            made.point_data[name] = change.of_vertices(np.asarray(values))
        for name, values in given.cell_data.items():
            if name.lower() not in NORMALS:
                made.cell_data[name] = change.of_faces(np.asarray(values))
        for name, values in given.field_data.items():
            made.field_data[name] = values
        for of, to in ((given.point_data, made.point_data), (given.cell_data, made.cell_data)):
            for active in ("active_scalars_name", "active_vectors_name", "active_texture_coordinates_name"):
                if getattr(of, active, None) in to:
                    setattr(to, active, getattr(of, active))
        self._renew(made, change.vertices, change.faces)
        return made

    def _renew(self, made: Any, vertices: NDArray[Any], faces: NDArray[Any]) -> None:
        active = self._mesh.point_data.active_normals_name
        for name in list(made.point_data):
            values = np.asarray(made.point_data[name])
            if (name == active or name.lower() in NORMALS) and values.ndim == 2 and values.shape[1] == 3:
                made.point_data[name] = self.renewed(values, vertices, faces)
        if active in made.point_data:
            made.point_data.active_normals_name = active
