"""What is said of a mesh that is refused because it falls apart where it seems to hang together."""

from __future__ import annotations

import ctypes
from collections.abc import Iterator
from contextlib import contextmanager

import numpy as np

from . import _abi, _arrays
from ._errors import FairmeshError, Status
from ._handles import result_of
from ._library import Library
from ._reports import sized

#: Of the diagonal of the bounding box: what programs that write single precision leave between copies of a vertex.
_NEAR = 1e-6
#: What the boundary of the mesh has to do with.
_OF_BOUNDARIES = {Status.FREE_VERTEX_ON_BOUNDARY, Status.EMPTY_REGION}


@contextmanager
def seams_told(library: Library, mesh: _arrays.Mesh) -> Iterator[None]:
    """Adds to a refusal that vertices lie beside each other which are not joined, if that is so."""
    try:
        yield
    except FairmeshError as why:
        if why.status in _OF_BOUNDARIES:
            why.add_advice(_advice(library, mesh))
        raise


def _advice(library: Library, mesh: _arrays.Mesh) -> str:
    if len(mesh.vertices) == 0:
        return ""
    diagonal = float(np.linalg.norm(np.ptp(np.asarray(mesh.vertices, float), axis=0)))
    near = float(f"{_NEAR * diagonal:.0e}")
    if not near > mesh.struct.coincident_within:
        return ""
    before, after = (_boundary_edges(library, mesh, within) for within in (None, near))
    if after >= before:
        return ""
    return (
        f"the mesh has {before} boundary edges, {after} if vertices that lie within {near:g} of each other are joined: "
        f"coincident={near:g} does that"
    )


def _boundary_edges(library: Library, mesh: _arrays.Mesh, within: float | None) -> int:
    """Of the mesh as it was given, or joined up to a distance."""
    struct = _abi.fairmesh_mesh.from_buffer_copy(mesh.struct)
    if within is not None:
        struct.coincident, struct.coincident_within = _abi.fairmesh_coincident.JOIN, within
    handle = result_of(library, "fairmesh_boundary_loops", ctypes.byref(struct))
    loop, edges = sized(_abi.fairmesh_loop), 0
    for index in range(handle.info().loop_count):
        handle.read("fairmesh_result_loop", index, ctypes.byref(loop))
        edges += loop.vertex_count
    return edges
