"""Faces taken away: erased, trimmed; and what was there carried over to what takes their place."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING, Any, Generic, overload

import numpy as np
from numpy.typing import NDArray

from . import _abi, _arrays
from ._calls import of_mesh
from ._carry import Change, blended
from ._forms import ArrayLike
from ._handles import result_of
from ._hosts import Arrays, M, MeshLike
from ._keywords import MeshKeywords, TrimKeywords, WatchKeywords
from ._options import real, whole
from ._runs import watched

if TYPE_CHECKING:
    from typing_extensions import Unpack

_lists = _abi.fairmesh_list


class Left(Generic[M]):
    """A mesh without some of its faces. Its vertices are those given, used or not."""

    def __init__(self, given: _arrays.Mesh, kept: NDArray[np.intp]) -> None:
        self._given = given
        #: The faces that are left, in the type given.
        self.faces: NDArray[Any] = given.faces[kept].astype(given.index_type, copy=False)
        #: Their numbers before, ascending.
        self.kept_faces = kept

    @cached_property
    def mesh(self) -> M:
        """What is left, of the kind given, with what belonged to it. Of two arrays, a pair of arrays."""
        given = self._given
        every = np.arange(len(given.vertices))
        none = np.empty((0, 3))
        faces = given.faces.astype(np.intp)
        change = Change(given.vertices, self.faces, faces, every, self.kept_faces, none.astype(np.intp), none)
        made: M = given.host.same(lambda: given.host.rebuilt(change))
        return made


class Erased(Left[M]):
    """A mesh without faces that were named."""

    def __init__(
        self, given: _arrays.Mesh, kept: NDArray[np.intp], loops: NDArray[np.intp], dropped: int, cleaned: int
    ) -> None:
        super().__init__(given, kept)
        #: The loops that the deleted faces leave, as `boundary_loops` numbers those of the mesh that is left.
        self.loops = loops
        #: How many faces were dropped besides those named: they hung at the mesh by one edge or by a vertex.
        self.dropped_count = dropped
        #: How many faces were dropped because they would spoil the boundary of a patch.
        self.cleaned_count = cleaned

    def __repr__(self) -> str:
        return f"<fairmesh.Erased: {len(self.faces)} faces left, {len(self.loops)} loops>"


class Trimmed(Left[M]):
    """A mesh without the faces that would spoil patches."""

    def __init__(self, given: _arrays.Mesh, kept: NDArray[np.intp], dropped: int, area: float) -> None:
        super().__init__(given, kept)
        #: How many faces were taken away.
        self.dropped_count = dropped
        #: Their area.
        self.dropped_area = area

    def __repr__(self) -> str:
        return f"<fairmesh.Trimmed: {len(self.faces)} faces left, {self.dropped_count} dropped>"


@dataclass(frozen=True)
class Carried:
    """Where points lie on the faces of a mesh."""

    #: The nearest face of each point, (k,); -1 where there is none.
    faces: NDArray[np.intp]
    #: Its corners, (k, 3); -1 where there is none.
    corners: NDArray[np.intp]
    #: Their weights, (k, 3), at the nearest place.
    weights: NDArray[np.float64]

    def of_vertices(self, values: ArrayLike) -> NDArray[Any]:
        """Values at the vertices of the mesh, (n, ...), at the points: real numbers and colours of 8 bits by the
        weights, anything else of the nearest corner.
        """
        self._check()
        return blended(np.asarray(values), self.corners, self.weights)

    def of_faces(self, values: ArrayLike) -> NDArray[Any]:
        """Values of the faces of the mesh, (m, ...), at the points."""
        self._check()
        found: NDArray[Any] = np.asarray(values)[self.faces]
        return found

    def _check(self) -> None:
        lost = np.flatnonzero(self.faces < 0)
        if len(lost):
            raise ValueError(f"point {lost[0]} is on no face: it is not finite, or there are no faces")


@overload
def erase(
    mesh: M, /, erased: ArrayLike | str, *, clean: int | None = ..., **keywords: Unpack[MeshKeywords]
) -> Erased[M]: ...
@overload
def erase(
    vertices: ArrayLike,
    faces: ArrayLike,
    erased: ArrayLike,
    *,
    clean: int | None = ...,
    **keywords: Unpack[MeshKeywords],
) -> Erased[Arrays]: ...
@of_mesh()
def erase(mesh: _arrays.Mesh, erased: ArrayLike | str, *, clean: int | None = 0) -> Erased[Any]:
    """Deletes faces, and what would hang loose where they were, so that new patches can take their place:

    ``left = erase(mesh, faces); fill_holes(left.mesh, loops=left.loops)``.

    Args:
        mesh, coincident: As in `fair`.
        erased: A mask (m,) or indices of faces, or the name of a mask that the mesh has at its faces.
        clean: So many faces more may be dropped beside them, those that would spoil the boundary of a patch: with an
            angle below 5 degrees, or turned by more than 100 degrees against one beside them. Default 0.

    """
    listed = _arrays.chosen_faces(mesh, erased, "erased")
    arguments = (_arrays.indices_view(listed), whole(clean or 0, "clean"))
    handle = result_of("fairmesh_erase", mesh.struct, *arguments)
    info = handle.info()
    loops = handle.list(_lists.ERASED_LOOPS)
    return Erased(mesh, handle.list(_lists.KEPT_TRIANGLES), loops, info.dropped_count, info.cleaned_count)


@overload
def trim_boundary(mesh: M, /, most: int, **keywords: Unpack[TrimKeywords]) -> Trimmed[M]: ...
@overload
def trim_boundary(
    vertices: ArrayLike, faces: ArrayLike, most: int, **keywords: Unpack[TrimKeywords]
) -> Trimmed[Arrays]: ...
@of_mesh(TrimKeywords)
def trim_boundary(mesh: _arrays.Mesh, most: int, **keywords: Unpack[TrimKeywords]) -> Trimmed[Any]:
    """Takes away faces at holes that would spoil a patch: slender ones, spikes, fins, and those that hang by one edge.

    Slender is an angle below 5 degrees, a fin is turned by more than 100 degrees against a face beside it. The worst go
    first, then those that this lays bare, in no more than eight passes: ``fill_holes(trim_boundary(mesh, 100).mesh)``.

    Args:
        mesh, coincident: As in `fair`.
        most: No more faces than this.
        loops: At these loops, as `boundary_loops` numbers them. Default: at all holes.
        max_area: No more area than this. Default: any.

    """
    loops, max_area = keywords.get("loops"), keywords.get("max_area")
    listed = None if loops is None else _arrays.indices(loops, "loops")
    if max_area is not None and not real(max_area, "max_area") > 0.0:
        raise ValueError("max_area: it has to be positive")
    bounds = (whole(most, "most"), 0.0 if max_area is None else float(max_area))
    handle = result_of("fairmesh_trim_boundary", mesh.struct, _arrays.list_view(listed), *bounds)
    info = handle.info()
    return Trimmed(mesh, handle.list(_lists.KEPT_TRIANGLES), info.dropped_count, info.dropped_area)


@overload
def carry_over(
    mesh: MeshLike, /, points: ArrayLike, among: ArrayLike | str | None = None, **keywords: Unpack[WatchKeywords]
) -> Carried: ...
@overload
def carry_over(
    vertices: ArrayLike,
    faces: ArrayLike,
    points: ArrayLike,
    among: ArrayLike | None = None,
    **keywords: Unpack[WatchKeywords],
) -> Carried: ...
@of_mesh(WatchKeywords)
def carry_over(
    mesh: _arrays.Mesh, points: ArrayLike, among: ArrayLike | str | None = None, **keywords: Unpack[WatchKeywords]
) -> Carried:
    """Finds the nearest face of a mesh for each point: colours of what was erased go to what took its place.

    ``carry_over(mesh, filled.vertices[filled.new_vertices], erased).of_vertices(colours)``.

    Args:
        mesh: As in `fair`.
        points: (k, 3).
        among: Indices of faces, a mask, or the name of one that the mesh has: only these. Default: all.
        progress, cancel: As in `fair`.

    """
    listed = None if among is None else _arrays.chosen_faces(mesh, among, "among")
    asked = _arrays.points(points, "points")
    views = (_arrays.list_view(listed), _arrays.points_view(asked))
    handle = watched(keywords, "fairmesh_carry_over", mesh.struct, *views)
    none = 2**32 - 1
    on = handle.list(_lists.CARRIED_TRIANGLES)
    corners = handle.list(_lists.PARENTS).reshape(-1, 3)
    weights = handle.vectors(_abi.fairmesh_vectors.PARENT_WEIGHTS, len(asked))
    return Carried(np.where(on == none, -1, on), np.where(corners == none, -1, corners), weights)
