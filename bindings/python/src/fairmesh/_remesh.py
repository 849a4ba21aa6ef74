"""Regions that get other vertices: triangulated anew, or deleted and filled."""

from __future__ import annotations

from functools import cached_property
from typing import TYPE_CHECKING, Any, overload

import numpy as np
from numpy.typing import NDArray

from . import _abi, _arrays
from ._calls import of_mesh
from ._forms import ArrayLike
from ._handles import result_of
from ._holes import PartlyNewMesh
from ._hosts import Arrays, M
from ._keywords import RefillKeywords, RemeshKeywords
from ._options import options_of
from ._progress import Relay
from ._runs import Run, region_of
from ._seams import seams_told

if TYPE_CHECKING:
    from typing_extensions import Unpack

_lists = _abi.fairmesh_list


class Remeshed(PartlyNewMesh[M]):
    """A mesh with a new triangulation of a region."""

    @cached_property
    def free_vertices(self) -> NDArray[np.intp]:
        """The free vertices of the new mesh: give them to `fair` as ``free``."""
        return self._handle.list(_lists.FREE_VERTICES)

    def __repr__(self) -> str:
        return f"<fairmesh.Remeshed: {len(self.vertices)} vertices, {self.new_vertex_count} of them new>"


@overload
def remesh(mesh: M, /, free: _arrays.Selection = None, **keywords: Unpack[RemeshKeywords]) -> Remeshed[M]: ...
@overload
def remesh(
    vertices: ArrayLike, faces: ArrayLike, free: _arrays.Selection = None, **keywords: Unpack[RemeshKeywords]
) -> Remeshed[Arrays]: ...
@of_mesh(RemeshKeywords)
def remesh(mesh: _arrays.Mesh, free: _arrays.Selection = None, **keywords: Unpack[RemeshKeywords]) -> Remeshed[Any]:
    """Triangulates a region anew, by edge lengths as beside it, without moving the surface.

    To fair the new mesh: ``fair(new.mesh, new.free_vertices)``.

    Args:
        mesh, free, fixed, free_faces, coincident, progress, cancel: As in `fair`.
        **options: Density and number of the vertices: `RemeshOptions`.

    Returns:
        `Remeshed`: the mesh in the types given, and where its vertices and faces come from.

    Raises:
        InputError and the others of `fair`.

    """
    region = region_of(mesh, free, keywords)
    options = options_of(_abi.fairmesh_remesh_options, keywords)
    relay = Relay(keywords.get("progress"), keywords.get("cancel"))
    relay.install(options)
    with seams_told(mesh), relay:
        return Remeshed(result_of("fairmesh_remesh", mesh.struct, region.struct, options), mesh)


@overload
def refill(mesh: M, /, free: _arrays.Selection = None, **keywords: Unpack[RefillKeywords]) -> Remeshed[M]: ...
@overload
def refill(
    vertices: ArrayLike, faces: ArrayLike, free: _arrays.Selection = None, **keywords: Unpack[RefillKeywords]
) -> Remeshed[Arrays]: ...
@of_mesh(RefillKeywords)
def refill(mesh: _arrays.Mesh, free: _arrays.Selection = None, **keywords: Unpack[RefillKeywords]) -> Remeshed[Any]:
    """Deletes a region and fills what is left open, each component of it with one patch, which is fair already.

    Where the shape that the region has is of no use, such as an ear of many vertices behind a short boundary.

    Args:
        mesh, free, fixed, free_faces, coincident: As in `fair`.
        **options: Those of `fair` and of patches: `PatchOptions`.
        progress, cancel: As in `fair`.

    Returns:
        `Remeshed`: the mesh in the types given, and where its vertices and faces come from.

    Raises:
        FairmeshError: With `Status.NO_FAIR_PATCH` where that leads to no fair patch, where a fixed vertex would be
            lost, where the region lies at a boundary of the mesh, and where the run was stopped. And the others of
            `fair`.

    """
    region = region_of(mesh, free, keywords)
    filling = options_of(_abi.fairmesh_fill_options, keywords)
    run = Run(mesh, keywords)
    return Remeshed(run.result("fairmesh_refill", region.struct, filling, run.options), mesh)
