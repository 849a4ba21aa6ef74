"""The keywords of the functions, for type checkers: the tests compare them with the functions themselves."""

from __future__ import annotations

from typing import TYPE_CHECKING, TypedDict

from ._choice import Join, LoopChoice, OnFailure
from ._options import FairingOptions

if TYPE_CHECKING:
    from numpy.typing import ArrayLike

    from ._arrays import Coincident, Selection
    from ._progress import Event, ProgressCallback


class _Region(TypedDict, total=False):
    fixed: Selection
    free_faces: Selection


class _Run(FairingOptions, total=False):
    coincident: Coincident | None
    progress: ProgressCallback | None
    cancel: Event | None


class _Patches(_Run, total=False):
    on_failure: OnFailure | None
    density: float | None
    max_new_vertices: int | None
    fair: bool | None


class FairKeywords(_Region, _Run, total=False):
    """Those of `fair` and `Solver`."""


class FillKeywords(LoopChoice, _Patches, total=False):
    """Those of `fill_holes`."""

    join: Join | None
    guides: ArrayLike | None
    relax_rim: int | None
    relax_within: float | None


class BridgeKeywords(_Patches, total=False):
    """Those of `bridge`."""

    width: float | None
    fill: bool | None


class RemeshKeywords(_Region, total=False):
    """Those of `remesh`."""

    coincident: Coincident | None
    density: float | None
    max_vertices: int | None


class RefillKeywords(_Region, _Patches, total=False):
    """Those of `refill`."""
