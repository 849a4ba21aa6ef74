"""Which loops to join, and the components of a mesh."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, overload

import numpy as np
from numpy.typing import NDArray

from . import _abi, _arrays
from ._calls import of_mesh
from ._choice import loop_choice
from ._forms import ArrayLike
from ._handles import ResultHandle, result_of
from ._hosts import MeshLike
from ._keywords import JoinKeywords, MeshKeywords
from ._records import Bends, bends_of
from ._reports import sized

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
def suggest_joins(mesh: MeshLike, /, **which: Unpack[JoinKeywords]) -> list[JoinSuggestion]: ...
@overload
def suggest_joins(vertices: ArrayLike, faces: ArrayLike, **which: Unpack[JoinKeywords]) -> list[JoinSuggestion]: ...
@of_mesh(JoinKeywords)
def suggest_joins(mesh: _arrays.Mesh, **which: Unpack[JoinKeywords]) -> list[JoinSuggestion]:
    """The loops that ``fill_holes(..., join="auto")`` would give one patch, and why.

    Args:
        mesh, coincident: As in `fair`.
        **which: Among which loops: ``loops`` and the bounds of `fill_holes`. Default: all.

    """
    handle = result_of("fairmesh_suggest_joins", mesh.struct, loop_choice(which))
    return [_suggestion(handle, index) for index in range(handle.info().loop_count)]


def _suggestion(handle: ResultHandle, index: int) -> JoinSuggestion:
    made = sized(_abi.fairmesh_join_suggestion)
    handle.read("fairmesh_result_suggestion", index, made)
    return JoinSuggestion(handle.list(_lists.JOINED_LOOPS, index), bends_of(made))


@overload
def components(mesh: MeshLike, /, **keywords: Unpack[MeshKeywords]) -> NDArray[np.intp]: ...
@overload
def components(vertices: ArrayLike, faces: ArrayLike, **keywords: Unpack[MeshKeywords]) -> NDArray[np.intp]: ...
@of_mesh()
def components(mesh: _arrays.Mesh) -> NDArray[np.intp]:
    """Per face the number of its component, (m,): faces that hang together by edges.

    Components count in the order of their first faces. Arguments as in `fair`.
    """
    return result_of("fairmesh_components", mesh.struct).list(_lists.TRIANGLE_COMPONENTS)
