"""Meshes of meshio."""

from __future__ import annotations

import copy
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ._carry import NORMALS, Change
from ._hosts import Host

#: Cells that may be beside the triangles: they have no area.
_BESIDE = ("vertex", "line", "line3")


class Mesh(Host):
    """A `meshio.Mesh`: data, sets, and cells that are vertices or lines are kept; normals are made anew."""

    vertex_data_name = "point_data"
    face_data_name = "cell_data"

    def __init__(self, mesh: Any) -> None:
        self._mesh = mesh
        self._blocks = [number for number, block in enumerate(mesh.cells) if block.type == "triangle"]
        others = sorted({block.type for block in mesh.cells} - {"triangle", *_BESIDE})
        if others:
            raise ValueError(f"the mesh has cells of type {others[0]!r}: all faces have to be triangles")
        # A copy: what is told to be changed is what differs from it.
        self.vertices = np.array(mesh.points)
        self.faces = self._joined([block.data for block in mesh.cells])
        if len(self._blocks) == 0:
            raise ValueError("the mesh has no triangles")

    def _joined(self, per_block: list[Any]) -> NDArray[Any]:
        """Of the blocks that are triangles, one after the other."""
        return np.concatenate([np.asarray(per_block[number]) for number in self._blocks] or [np.empty((0, 3), int)])

    def vertex_data(self, name: str) -> Any:
        """An array of the points, or a set of them."""
        return self._mesh.point_data.get(name, self._mesh.point_sets.get(name))

    def face_data(self, name: str) -> Any:
        """An array of the cells, as far as they are triangles."""
        if name in self._mesh.cell_data:
            return self._joined(self._mesh.cell_data[name])
        return None

    def moved(self, vertices: NDArray[Any]) -> Any:
        """A copy with other positions."""
        made = copy.deepcopy(self._mesh)
        made.points = vertices
        self._renew(made, vertices, self.faces)
        return made

    def rebuilt(self, change: Change) -> Any:
        """A mesh with other vertices and faces: new faces are in the last block of triangles."""
        made = copy.deepcopy(self._mesh)
        made.points = change.vertices
        made.point_data = {name: change.of_vertices(np.asarray(v)) for name, v in self._mesh.point_data.items()}
        now = change.numbers_now()
        made.point_sets = {name: _still_there(now[np.asarray(of)]) for name, of in self._mesh.point_sets.items()}
        rows = self._rows(change)
        for number, block in enumerate(made.cells):
            if number in rows:
                block.data = change.faces[rows[number]].astype(block.data.dtype)
            else:
                block.data = now[block.data]
                if (block.data < 0).any():
                    raise ValueError(f"the mesh has cells of type {block.type!r} at vertices that are replaced")
        for name, per_block in self._mesh.cell_data.items():
            of_faces = change.of_faces(self._joined(per_block))
            made.cell_data[name] = [
                of_faces[rows[number]] if number in rows else values for number, values in enumerate(per_block)
            ]
        faces_now = change.face_numbers_now()
        for name, per_block in self._mesh.cell_sets.items():
            made.cell_sets[name] = list(per_block)
            start = 0
            for number in self._blocks:
                if per_block[number] is not None:
                    still = _still_there(faces_now[start + np.asarray(per_block[number], int)])
                    made.cell_sets[name][number] = np.searchsorted(rows[number], still)
                start += len(self._mesh.cells[number].data)
        self._renew(made, change.vertices, change.faces)
        return made

    def _rows(self, change: Change) -> dict[int, NDArray[np.intp]]:
        """Per block of triangles which of the faces now are its, ascending."""
        ends = np.cumsum([len(self._mesh.cells[number].data) for number in self._blocks])
        block = np.searchsorted(ends, change.kept_faces, side="right")
        block = np.concatenate([block, np.full(len(change.faces) - len(block), len(self._blocks) - 1)])
        return {number: np.flatnonzero(block == k) for k, number in enumerate(self._blocks)}

    def _renew(self, made: Any, vertices: NDArray[Any], faces: NDArray[Any]) -> None:
        for name, values in made.point_data.items():
            if name.lower() in NORMALS and np.shape(values) == (len(vertices), 3):
                made.point_data[name] = self.renewed(values, vertices, faces)
        for name in [name for name in made.cell_data if name.lower() in NORMALS]:
            del made.cell_data[name]


def _still_there(numbers: NDArray[Any]) -> NDArray[Any]:
    return numbers[numbers >= 0]
