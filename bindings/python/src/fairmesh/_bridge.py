"""Strips between two runs of boundary edges."""

from __future__ import annotations

from functools import cached_property
from typing import TYPE_CHECKING, Any, overload

import numpy as np
from numpy.typing import NDArray

from . import _abi, _arrays
from ._calls import of_mesh
from ._forms import ArrayLike
from ._handles import ResultHandle
from ._holes import LoopReport, NewMesh
from ._hosts import Arrays, M
from ._keywords import BridgeKeywords
from ._options import options_of
from ._records import Report
from ._reports import sized
from ._runs import Run

if TYPE_CHECKING:
    from typing_extensions import Unpack

_lists = _abi.fairmesh_list


class Bridged(NewMesh[M]):
    """A mesh with a bridge. Vertices and faces given keep their numbers and bits; new ones follow."""

    def __init__(self, handle: ResultHandle, mesh: _arrays.Mesh) -> None:
        super().__init__(handle, mesh)
        told = sized(_abi.fairmesh_bridge_report)
        handle.read("fairmesh_result_bridge", told)
        #: Whether there is nothing to be said of it: what was to be faired converged, and no hole that was to be filled
        #: is open.
        self.is_success = bool(handle.info().is_success)
        #: By how much the strip is twisted from one chain to the other, in degrees between -180 and 180.
        self.twist: float = told.twist
        #: What became of the strip.
        self.strip = LoopReport(handle, 0)
        #: What became of the holes beside it, if they were to be filled. Their numbers are those of the loops of the
        #: mesh with the strip.
        self.rest: list[LoopReport] = [LoopReport(handle, 1 + index) for index in range(told.rest_count)]
        #: The fairing of all new vertices together, if holes were filled. Unless its outcome is "converged", the strip
        #: and the patches are left as they were made.
        self.whole: Report | None = handle.report(1 + told.rest_count) if told.has_whole else None

    @cached_property
    def chains(self) -> tuple[NDArray[np.intp], NDArray[np.intp]]:
        """The vertices that the strip begins and ends at, in the direction in which its faces run through them."""
        return self._handle.list(_lists.BRIDGE_CHAIN, 0), self._handle.list(_lists.BRIDGE_CHAIN, 1)

    @cached_property
    def sides(self) -> tuple[NDArray[np.intp], NDArray[np.intp]]:
        """The new vertices on its two sides: from the first chain to the second, and back."""
        return self._handle.list(_lists.BRIDGE_SIDE, 0), self._handle.list(_lists.BRIDGE_SIDE, 1)

    def __repr__(self) -> str:
        return f"<fairmesh.Bridged: {self.strip.outcome}, {self.new_vertex_count} new vertices>"


@overload
def bridge(mesh: M, /, start: ArrayLike, end: ArrayLike, **keywords: Unpack[BridgeKeywords]) -> Bridged[M]: ...
@overload
def bridge(
    vertices: ArrayLike, faces: ArrayLike, start: ArrayLike, end: ArrayLike, **keywords: Unpack[BridgeKeywords]
) -> Bridged[Arrays]: ...
@of_mesh(BridgeKeywords)
def bridge(mesh: _arrays.Mesh, start: ArrayLike, end: ArrayLike, **keywords: Unpack[BridgeKeywords]) -> Bridged[Any]:
    """Connects two runs of boundary edges by a strip that is tangent to the mesh at both, and faired.

    On one loop the strip divides the hole, on two it joins the parts. Where their ends face opposite ways none is made:
    its report says "opposite_sides".

    Args:
        mesh, coincident: As in `fair`.
        start, end: The vertices of each run, one after the other, in either direction: at least two, or one if there is
            a width.
        **options: Those of `fair`, of patches and of bridges: `BridgeOptions`.
        progress, cancel: As in `fair`.

    Raises:
        InputError and the others of `fair`.

    """
    how = options_of(_abi.fairmesh_bridge_options, keywords)
    filling = options_of(_abi.fairmesh_fill_options, keywords)
    ends = [_arrays.indices(start, "start"), _arrays.indices(end, "end")]
    run = Run(mesh, keywords)
    handle = run.result("fairmesh_bridge", *map(_arrays.indices_view, ends), how, filling, run.options)
    return Bridged(handle, mesh)
