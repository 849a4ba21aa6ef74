"""Which loops to join, and the components of a mesh."""

from __future__ import annotations

import ctypes
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, overload

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _abi, _arrays
from ._calls import of_mesh
from ._choice import Choice, LoopChoice
from ._handles import ResultHandle, result_of
from ._hosts import MeshLike
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
