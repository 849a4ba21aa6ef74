"""The keywords of the functions: for type checkers, for ``help``, and for what refuses all others."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any, Literal, TypedDict, Union

from ._forms import ArrayLike, HowFar
from ._schema import (
    BRIDGE_DEFAULTS,
    FILLING_DEFAULTS,
    REMESH_DEFAULTS,
    ROUND_DEFAULTS,
    BridgeOptions,
    FairingOptions,
    FillingOptions,
    PatchOptions,
    RemeshOptions,
    RoundOptions,
)

if TYPE_CHECKING:
    from ._arrays import Coincident, Selection
    from ._progress import Event, ProgressCallback

#: "none", "auto", or groups of loops.
Join = Union[Literal["none", "auto"], Sequence[ArrayLike]]
#: A ball (centre, radius), or a box (lowest corner, highest corner).
Place = tuple[ArrayLike, Union[ArrayLike, float]]

#: What all keywords are by default; those that are not here, None.
DEFAULTS: dict[str, Any] = {
    **ROUND_DEFAULTS,
    **FILLING_DEFAULTS,
    **BRIDGE_DEFAULTS,
    **REMESH_DEFAULTS,
    "coincident": "join",
    "join": "none",
    "except_longest": 0,
}


class LoopChoice(TypedDict, total=False):
    """Which holes are filled, or looked at: those that meet every bound. None is no bound.

    Keywords:
        loops: These loops only, as `boundary_loops` numbers them, outer boundaries included; what follows is not read
            then. "all": all holes. Default: all holes; with groups in ``join``, none but these.
        max_edges: Of at most this many edges.
        max_length: Not longer than this.
        max_area: Of no more than this `Loop.area`.
        max_diagonal: With a bounding box of no more than this diagonal.
        except_longest: All but so many holes of the mesh, the longest. Default 0.
        of_components: Only those of these components, as `components` numbers them.
        within: Only those whose vertices all lie in a ball ``(centre, radius)`` or a box ``(low, high)``, two corners.
    """

    loops: ArrayLike | Literal["all"] | None
    max_edges: int | None
    max_length: float | None
    max_area: float | None
    max_diagonal: float | None
    except_longest: int | None
    of_components: ArrayLike | None
    within: Place | None


class _Region(TypedDict, total=False):
    fixed: Selection
    free_faces: Selection


class _Joins(TypedDict, total=False):
    join: Join | None


class MeshKeywords(TypedDict, total=False):
    """Those of all functions of meshes."""

    coincident: Coincident | None


class TrimKeywords(MeshKeywords, total=False):
    """Those of `trim_boundary`."""

    loops: ArrayLike | None
    max_area: float | None


class WatchKeywords(TypedDict, total=False):
    """Those of functions that may take long: as in `fair`. Where they are stopped, the error's status is CANCELLED."""

    progress: ProgressCallback | None
    cancel: Event | None


class _Run(MeshKeywords, WatchKeywords, total=False):
    pass


class SelectKeywords(_Run, total=False):
    """Those of functions that choose faces."""


class FairKeywords(_Region, _Run, FairingOptions, total=False):
    """Those of `fair` and `Solver`."""


class FillKeywords(LoopChoice, _Joins, _Run, FillingOptions, total=False):
    """Those of `fill_holes`."""


class JoinKeywords(MeshKeywords, LoopChoice, total=False):
    """Those of `suggest_joins`."""


class BridgeKeywords(_Run, BridgeOptions, total=False):
    """Those of `bridge`."""


class RemeshKeywords(_Region, _Run, RemeshOptions, total=False):
    """Those of `remesh`."""


class RefillKeywords(_Region, _Run, PatchOptions, total=False):
    """Those of `refill`."""


class RoundKeywords(_Run, RoundOptions, total=False):
    """Those of `round_edges`."""

    continuity: HowFar | None
    tolerance: float | None
    max_iterations: int | None
    threads: int | None
    intersections: Literal["check", "skip"] | None
