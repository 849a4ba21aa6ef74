"""Edges that are rounded: blends in their place."""

from __future__ import annotations

from functools import cached_property
from typing import TYPE_CHECKING, Any, overload

import numpy as np
from numpy.typing import NDArray

from . import _abi, _arrays
from ._calls import of_mesh
from ._forms import ArrayLike
from ._holes import PartlyNewMesh
from ._hosts import Arrays, M
from ._keywords import RoundKeywords
from ._options import options_of
from ._records import Crease, Report, crease_of
from ._reports import sized
from ._runs import Run

if TYPE_CHECKING:
    from typing_extensions import Unpack

_lists = _abi.fairmesh_list


class Rounded(PartlyNewMesh[M]):
    """A mesh with blends in place of sharp edges. First what is left of the mesh given, then what is new."""

    @cached_property
    def report(self) -> Report:
        """How the fairing of all blends went."""
        return self._handle.report()

    @cached_property
    def is_success(self) -> bool:
        """Whether the blends are sound, and every edge that was to be rounded is."""
        return bool(self._handle.info().is_success)

    @cached_property
    def angle(self) -> float:
        """Edges that bend by more than so many degrees were taken for creases."""
        return float(self._handle.info().crease_angle)

    @cached_property
    def creases(self) -> list[Crease]:
        """The creases of the mesh given, and what became of each."""
        return [self._crease(index) for index in range(self._handle.info().crease_count)]

    @cached_property
    def sharp_corners(self) -> NDArray[np.intp]:
        """Vertices of the mesh given that stay sharp, as no sound blend was found there."""
        return self._handle.list(_lists.SHARP_CORNERS)

    def _crease(self, index: int) -> Crease:
        struct = sized(_abi.fairmesh_crease)
        self._handle.read("fairmesh_result_crease", index, struct)
        return crease_of(struct, vertices=self._handle.list(_lists.CREASE_VERTICES, index))

    def __repr__(self) -> str:
        rounded = sum(crease.is_rounded for crease in self.creases)
        return f"<fairmesh.Rounded: {rounded} of {len(self.creases)} creases, {self.report.outcome}>"


@overload
def round_edges(mesh: M, /, **keywords: Unpack[RoundKeywords]) -> Rounded[M]: ...
@overload
def round_edges(vertices: ArrayLike, faces: ArrayLike, **keywords: Unpack[RoundKeywords]) -> Rounded[Arrays]: ...
@of_mesh(RoundKeywords)
def round_edges(mesh: _arrays.Mesh, **keywords: Unpack[RoundKeywords]) -> Rounded[Any]:
    """Rounds the sharp edges of a mesh: in place of each there is a blend, tangent to the faces beside it.

    Outside of the blends the surface stays where it is; faces that reach into one are cut.

    Args:
        mesh, coincident, progress, cancel, continuity, tolerance, max_iterations, threads, intersections: As in `fair`.
        **options: ``width`` or ``radius`` is needed: `RoundOptions`.

    Returns:
        `Rounded`: the mesh in the types given, what became of its edges, and where vertices and faces come from.

    Raises:
        FairmeshError: With `Status.NO_CREASE` where there is nothing to be rounded, with `Status.NOT_AN_EDGE` for
            one of ``edges`` that is none. And the others of `fair`.

    """
    options = options_of(_abi.fairmesh_round_options, keywords)
    run = Run(mesh, keywords)
    return Rounded(run.result("fairmesh_round", options, run.options), mesh)
