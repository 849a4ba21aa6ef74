"""Which loops to join, triangles erased, components."""

from __future__ import annotations

import ctypes
from dataclasses import dataclass, field
from functools import cached_property
from typing import TYPE_CHECKING, Any, Generic, overload

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _abi, _arrays
from ._calls import of_mesh
from ._carry import Change
from ._choice import Choice, LoopChoice
from ._handles import ResultHandle, result_of
from ._hosts import Arrays, M, MeshLike
from ._library import load
from ._reports import Bends, bends_of, sized

if TYPE_CHECKING:
    from typing_extensions import Unpack

_lists = _abi.fairmesh_list


@dataclass(frozen=True)
class JoinSuggestion:
    """Loops whose joint patch bends less than patches of their own would."""

    #: As `boundary_loops` numbers them, ascending.
    loops: NDArray[np.intp]
    #: Why.
    reason: Bends


@dataclass(frozen=True)
class Erased(Generic[M]):
    """A mesh without some of its triangles. Its vertices are those given, used or not."""

    #: The faces that are left, in the type given.
    faces: NDArray[Any]
    #: Their numbers before, ascending.
    kept_faces: NDArray[np.intp]
    #: The loops that the deleted faces leave, as `boundary_loops` numbers those of the mesh that is left.
    loops: NDArray[np.intp]
    #: How many faces were dropped besides those named: they hung at the mesh by one edge or by a vertex.
    dropped_count: int
    _given: _arrays.Mesh = field(repr=False, compare=False)

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


@overload
def suggest_joins(
    mesh: MeshLike, /, *, coincident: _arrays.Coincident | None = ..., **which: Unpack[LoopChoice]
) -> list[JoinSuggestion]: ...
@overload
def suggest_joins(
    vertices: ArrayLike,
    faces: ArrayLike,
    *,
    coincident: _arrays.Coincident | None = ...,
    **which: Unpack[LoopChoice],
) -> list[JoinSuggestion]: ...
@of_mesh(LoopChoice, {"except_longest": 0})
def suggest_joins(
    vertices: Any,
    faces: Any = None,
    *,
    coincident: _arrays.Coincident | None = "join",
    **which: Unpack[LoopChoice],
) -> list[JoinSuggestion]:
    """The loops that ``fill_holes(..., join="auto")`` would give one patch, and why.

    Args:
        mesh, coincident: As in `fair`.
        **which: Among which loops: ``loops`` and the bounds of `fill_holes`. Default: all.

    """
    library = load()
    mesh = _arrays.Mesh(vertices, faces, coincident)
    choice = Choice(library, which)
    handle = result_of(library, "fairmesh_suggest_joins", ctypes.byref(mesh.struct), ctypes.byref(choice.struct))
    return [_suggestion(handle, index) for index in range(handle.info().loop_count)]


def _suggestion(handle: ResultHandle, index: int) -> JoinSuggestion:
    made = sized(_abi.fairmesh_join_suggestion)
    handle.read("fairmesh_result_suggestion", index, ctypes.byref(made))
    return JoinSuggestion(handle.list(_lists.JOINED_LOOPS, index), bends_of(made))


@overload
def erase(mesh: M, /, erased: ArrayLike | str, *, coincident: _arrays.Coincident | None = ...) -> Erased[M]: ...
@overload
def erase(
    vertices: ArrayLike, faces: ArrayLike, erased: ArrayLike, *, coincident: _arrays.Coincident | None = ...
) -> Erased[Arrays]: ...
@of_mesh()
def erase(
    vertices: Any, faces: Any, erased: ArrayLike | str, *, coincident: _arrays.Coincident | None = "join"
) -> Erased[Any]:
    """Deletes faces, and what would hang loose where they were, so that new patches can take their place:

    ``left = erase(mesh, faces); fill_holes(left.mesh, loops=left.loops)``.

    Args:
        mesh, coincident: As in `fair`.
        erased: A mask (m,) or indices of faces, or the name of a mask that the mesh has at its faces.

    """
    library = load()
    mesh = _arrays.Mesh(vertices, faces, coincident)
    listed = _arrays.chosen_faces(mesh, erased, "erased")
    handle = result_of(library, "fairmesh_erase", ctypes.byref(mesh.struct), ctypes.byref(_arrays.indices_view(listed)))
    kept = handle.list(_lists.KEPT_TRIANGLES)
    left = mesh.faces[kept].astype(mesh.index_type, copy=False)
    return Erased(left, kept, handle.list(_lists.ERASED_LOOPS), handle.info().dropped_count, mesh)


@overload
def components(mesh: MeshLike, /, *, coincident: _arrays.Coincident | None = ...) -> NDArray[np.intp]: ...
@overload
def components(
    vertices: ArrayLike, faces: ArrayLike, *, coincident: _arrays.Coincident | None = ...
) -> NDArray[np.intp]: ...
@of_mesh()
def components(vertices: Any, faces: Any = None, *, coincident: _arrays.Coincident | None = "join") -> NDArray[np.intp]:
    """Per face the number of its component, (m,): faces that hang together by edges.

    Components count in the order of their first faces. Arguments as in `fair`.
    """
    library = load()
    mesh = _arrays.Mesh(vertices, faces, coincident)
    return result_of(library, "fairmesh_components", ctypes.byref(mesh.struct)).list(_lists.TRIANGLE_COMPONENTS)
