"""The keywords of the functions, for type checkers: the tests compare them with the functions themselves."""

from __future__ import annotations

from typing import TYPE_CHECKING, TypedDict

from ._choice import Join, LoopChoice
from ._schema import BridgeOptions, FairingOptions, FillingOptions, PatchOptions, RemeshOptions

if TYPE_CHECKING:
    from ._arrays import Coincident, Selection
    from ._progress import Event, ProgressCallback


class _Region(TypedDict, total=False):
    fixed: Selection
    free_faces: Selection


class _Mesh(TypedDict, total=False):
    coincident: Coincident | None


class _Run(_Mesh, total=False):
    progress: ProgressCallback | None
    cancel: Event | None


class FairKeywords(_Region, _Run, FairingOptions, total=False):
    """Those of `fair` and `Solver`."""


class FillKeywords(LoopChoice, _Run, FillingOptions, total=False):
    """Those of `fill_holes`."""

    join: Join | None


class BridgeKeywords(_Run, BridgeOptions, total=False):
    """Those of `bridge`."""


class RemeshKeywords(_Region, _Mesh, RemeshOptions, total=False):
    """Those of `remesh`."""


class RefillKeywords(_Region, _Run, PatchOptions, total=False):
    """Those of `refill`."""
