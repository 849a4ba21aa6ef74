"""Fill holes, remove bumps, blend and join on triangle meshes, exactly smooth."""

from __future__ import annotations

from . import _abi
from ._bridge import Bridged, bridge
from ._curvature import mean_curvature
from ._edits import Bulge, Frame, Move, Tilt, Twist
from ._enums import AttemptEnd, FillOutcome, FillReason, LoopKind, LooseReason, Outcome, SharpFate, Status
from ._erase import Carried, Erased, Trimmed, carry_over, erase, trim_boundary
from ._errors import ElementKind, FairmeshError, InputError, OutOfMemoryError
from ._fairing import Result, Solver, fair
from ._holes import Filled, LoopReport, boundary_loops, fill_holes
from ._intersections import self_intersections
from ._joins import JoinSuggestion, components, suggest_joins
from ._keywords import LoopChoice
from ._library import LibraryError, load, version
from ._options import default_fill_options, default_options, default_remesh_options
from ._progress import Monitor, Progress
from ._records import (
    Attempt,
    Bends,
    Component,
    Continuity,
    Crease,
    CreaseEnd,
    Loop,
    Moved,
    Report,
    Roughness,
    SharpEdge,
)
from ._region import (
    grow,
    select_ball,
    select_box,
    select_bump,
    select_component,
    select_geodesic,
    select_halfspace,
    select_patch,
    shrink,
)
from ._remesh import Remeshed, refill, remesh
from ._round import Rounded, round_edges
from ._schema import FairingOptions
from ._seams import SeamWarning

__all__ = [
    "Attempt",
    "AttemptEnd",
    "Bends",
    "Bridged",
    "Bulge",
    "Carried",
    "Component",
    "Continuity",
    "Crease",
    "CreaseEnd",
    "ElementKind",
    "Erased",
    "FairingOptions",
    "FairmeshError",
    "FillOutcome",
    "FillReason",
    "Filled",
    "Frame",
    "InputError",
    "JoinSuggestion",
    "LibraryError",
    "Loop",
    "LoopChoice",
    "LoopKind",
    "LoopReport",
    "LooseReason",
    "Monitor",
    "Move",
    "Moved",
    "OutOfMemoryError",
    "Outcome",
    "Progress",
    "Remeshed",
    "Report",
    "Result",
    "Roughness",
    "Rounded",
    "SeamWarning",
    "SharpEdge",
    "SharpFate",
    "Solver",
    "Status",
    "Tilt",
    "Trimmed",
    "Twist",
    "boundary_loops",
    "bridge",
    "carry_over",
    "components",
    "default_fill_options",
    "default_options",
    "default_remesh_options",
    "erase",
    "fair",
    "fill_holes",
    "grow",
    "load",
    "mean_curvature",
    "refill",
    "remesh",
    "round_edges",
    "select_ball",
    "select_box",
    "select_bump",
    "select_component",
    "select_geodesic",
    "select_halfspace",
    "select_patch",
    "self_intersections",
    "shrink",
    "suggest_joins",
    "trim_boundary",
    "version",
]
#: The version of this package, which is that of the library it was written for.
__version__ = f"{_abi.VERSION_MAJOR}.{_abi.VERSION_MINOR}.{_abi.VERSION_PATCH}"
