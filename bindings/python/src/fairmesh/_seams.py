"""What is said of a mesh that falls apart where it seems to hang together."""

from __future__ import annotations

import itertools
import warnings
from collections.abc import Iterator
from contextlib import contextmanager

import numpy as np
from numpy.typing import NDArray

from . import _abi, _arrays
from ._enums import Status
from ._errors import FairmeshError
from ._handles import result_of
from ._reports import sized

#: Of the diagonal of the bounding box: what programs that write single precision leave between copies of a vertex.
_NEAR = 1e-6
#: So many are looked at: those of a seam are the first, and short edges do not take long.
_PAIRS = 16
#: What the boundary of the mesh has to do with.
_OF_BOUNDARIES = {Status.FREE_VERTEX_ON_BOUNDARY, Status.EMPTY_REGION}


@contextmanager
def seams_told(mesh: _arrays.Mesh) -> Iterator[None]:
    """Adds to a refusal that vertices lie beside each other which are not joined, if that is so."""
    try:
        yield
    except FairmeshError as why:
        if why.status in _OF_BOUNDARIES:
            why.add_advice(_advice(mesh))
        raise


class SeamWarning(UserWarning):
    """Vertices beside each other are not one vertex of the surface, and stayed where they were as its boundary."""


def warn_of_seams(mesh: _arrays.Mesh, boundary: NDArray[np.intp]) -> None:
    """Warns if boundary vertices of a region, which were not selected one by one, nearly meet."""
    near = _near(mesh)
    if len(boundary) < 2 or not near > mesh.struct.coincident_within:
        return
    places, first = np.unique(np.asarray(mesh.vertices[boundary], float), axis=0, return_index=True)
    for shift in itertools.product((0.0, near), repeat=3):
        # Whatever is within the distance is in one cell of the grid, or of one that is shifted.
        cells = np.floor((places + shift) / (2 * near))
        _, of_cell, count = np.unique(cells, axis=0, return_inverse=True, return_counts=True)
        of_cell = of_cell.reshape(-1)
        for cell in np.flatnonzero(count > 1)[:_PAIRS]:
            a, b = (int(boundary[first[i]]) for i in np.flatnonzero(of_cell == cell)[:2])
            apart = float(np.linalg.norm(np.asarray(mesh.vertices[a], float) - mesh.vertices[b]))
            if apart <= near and not ((mesh.faces == a).any(axis=1) & (mesh.faces == b).any(axis=1)).any():
                warnings.warn(
                    f"vertices {a} and {b} lie {apart:.1g} apart and are not one: as a boundary of the mesh they "
                    f"stayed where they were; coincident={near:g} joins them",
                    SeamWarning,
                    stacklevel=4,
                )
                return


def _near(mesh: _arrays.Mesh) -> float:
    """The distance within which vertices are taken for copies of one; 0 where nothing is known of it."""
    if len(mesh.vertices) == 0:
        return 0.0
    diagonal = float(np.linalg.norm(np.ptp(np.asarray(mesh.vertices, float), axis=0)))
    return float(f"{_NEAR * diagonal:.0e}") if np.isfinite(diagonal) else 0.0


def _advice(mesh: _arrays.Mesh) -> str:
    near = _near(mesh)
    if not near > mesh.struct.coincident_within:
        return ""
    before, after = (_boundary_edges(mesh, within) for within in (None, near))
    if after >= before:
        return ""
    return (
        f"the mesh has {before} boundary edges, {after} if vertices that lie within {near:g} of each other are joined: "
        f"coincident={near:g} does that"
    )


def _boundary_edges(mesh: _arrays.Mesh, within: float | None) -> int:
    """Of the mesh as it was given, or joined up to a distance."""
    struct = _abi.fairmesh_mesh.from_buffer_copy(mesh.struct)
    if within is not None:
        struct.coincident, struct.coincident_within = _abi.fairmesh_coincident.JOIN, within
    handle = result_of("fairmesh_boundary_loops", struct)
    loop, edges = sized(_abi.fairmesh_loop), 0
    for index in range(handle.info().loop_count):
        handle.read("fairmesh_result_loop", index, loop)
        edges += loop.vertex_count
    return edges
