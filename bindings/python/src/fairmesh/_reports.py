"""How a run went."""

from __future__ import annotations

import ctypes
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from . import _abi
from ._enums import AttemptEnd, LooseReason, Outcome
from ._options import Struct

if TYPE_CHECKING:
    from collections.abc import Callable


@dataclass(frozen=True, repr=False)
class Report:
    """How a fairing went. Lengths are in the unit of the vertices, angles in degrees, times in wall seconds.

    Where the region has several components, the whole has their worst outcome and largest figures.
    """

    outcome: Outcome
    #: Nonlinear iterations: the most of any component.
    iterations: int
    #: max_i |sum_j w_ij (H_i - H_j) + (2 A_i / 3) rhs_i| / sum_j |w_ij|, times the diagonal.
    defect: float
    #: The last step norm, in diagonals; NaN if there was none.
    step: float
    #: The diagonal of the bounding box; the largest of any component.
    diagonal: float
    #: How much of the boundary normals or the target was reached, 0 to 1.
    reached: float
    free_vertices: int
    #: The surface is that of the linear problem.
    linear_surface: bool
    #: Levels of the paper's scheme; 0 for the fast solver.
    level_count: int
    #: Free vertices that inner fairness does not spread as asked.
    fallback_weights: int
    poor_triangle_count: int
    flipped_count: int
    needle_count: int
    suspicious_normal_count: int
    #: The smallest angle of a triangle of the region, and the triangle (None: there is none).
    worst_angle: float
    worst_triangle: int | None
    #: The smallest and largest mean curvature at free vertices, in 1 / length; negative on a sphere.
    h_inside: tuple[float, float]
    #: The same at boundary vertices.
    h_boundary: tuple[float, float]
    #: The largest angle between a boundary normal and the triangles of the region there, and the vertex.
    normal_deviation: float
    normal_deviation_vertex: int | None
    #: The root mean square of those angles.
    normal_deviation_rms: float
    #: Half-edges and normals.
    seconds_setup: float
    #: The start surface.
    seconds_start: float
    #: The iterations.
    seconds_iterate: float
    #: The figures of this report.
    seconds_quality: float
    seconds_total: float
    #: The largest angle at a boundary vertex between the triangles of the region and those outside (where nothing is
    #: outside, the boundary normal), the same in the input, and the vertex.
    boundary_kink: float
    boundary_kink_before: float
    boundary_kink_vertex: int | None
    creased_vertex_count: int
    #: Whether intersections were looked for: not if the options say so, nor if the run was held up.
    intersections_checked: bool
    #: Pairs of intersecting triangles, at most 10000; `Result.intersections` has them.
    intersection_count: int
    #: How many pairs there were in the input among the same triangles and the rest of the mesh; 0 if none are now.
    intersections_in_input: int
    #: What `Outcome.CONVERGED_LOOSELY` is about; otherwise NONE.
    loose_reason: LooseReason
    #: Of `Outcome.NEAREST_MEMBER` the w of its equation Delta_B H = -2 w H (H^2 - K), at most 1, of several components
    #: the largest; otherwise 0.
    member_weight: float
    #: Bending energy, the integral of H^2 over the free vertices, without unit; the sum of all components.
    bending_energy: float
    #: The components of the region, by their smallest free vertices; at least one.
    components: tuple[Component, ...]

    def __repr__(self) -> str:
        # All of the fields are more than anyone reads.
        return f"<fairmesh.Report: {self.outcome}, {self.free_vertices} free vertices, {self.iterations} iterations>"

    @property
    def text(self) -> str:
        """What the outcome means, or its reason: English, begins in lower case, ends without a full stop."""
        return self._telling.text

    @property
    def remedy(self) -> str:
        """What can be done about it, written like the text; empty if there is nothing to do."""
        return self._telling.remedy

    @property
    def _telling(self) -> Outcome | LooseReason:
        return self.loose_reason if self.outcome is Outcome.CONVERGED_LOOSELY else self.outcome


@dataclass(frozen=True)
class Component:
    """What came of one component of the region. Units are those of `Report`.

    Components are independent problems: free vertices that are connected by edges, or lie around a fixed vertex inside
    the region whose normal is not given. Each has the result that it has in a call where it alone is selected.
    """

    outcome: Outcome
    #: What `Outcome.CONVERGED_LOOSELY` is about; otherwise NONE.
    loose_reason: LooseReason
    #: The surface is that of the linear problem.
    linear_surface: bool
    #: The free vertex with the smallest index.
    vertex: int
    free_vertices: int
    iterations: int
    #: As in `Report`, with the component's diagonal.
    defect: float
    step: float
    #: The diagonal of the component's bounding box.
    diagonal: float
    #: How much of the boundary normals or the target was reached, 0 to 1.
    reached: float
    flipped_count: int
    needle_count: int
    worst_angle: float
    worst_triangle: int | None
    h_inside: tuple[float, float]
    h_boundary: tuple[float, float]
    normal_deviation: float
    normal_deviation_vertex: int | None
    normal_deviation_rms: float
    #: As in `Report`, of the component alone.
    member_weight: float
    bending_energy: float
    #: What was tried, in its order: on the coarse mesh, where the component is large, and then on its own. Empty for
    #: the paper's solver.
    attempts: tuple[Attempt, ...]
    #: What came of the option ``continuity`` along each boundary loop; empty where it is 0, no loop has surroundings
    #: and vertices enough, or no surface was found to begin with.
    continuity: tuple[Continuity, ...]


@dataclass(frozen=True)
class Attempt:
    """An attempt at the surface of a component. Those on the coarse mesh decide where the fine one begins."""

    #: What was tried, in a few words.
    name: str
    #: The free vertices of its mesh: fewer than the component's on the coarse mesh.
    free_vertices: int
    iterations: int
    end: AttemptEnd
    #: The bending energy of its surface, without unit; NaN where it has none.
    bending_energy: float


@dataclass(frozen=True)
class Continuity:
    """How far the surface continues the mean curvature of its surroundings along one boundary loop, in 1 / length."""

    #: The boundary vertex of the loop with the smallest index.
    vertex: int
    vertex_count: int
    #: How much of the way from the mean curvature of the tangent-continuous surface to that of the surroundings was
    #: taken, in the mean along the loop, 0 to the option ``continuity``.
    reached: float
    #: The jump of the mean curvature at the loop of the tangent-continuous surface: root mean square, and the largest.
    jump_before: float
    largest_jump_before: float
    #: The same of this surface.
    jump: float
    largest_jump: float
    #: The mean curvature of the surroundings along the loop, root mean square.
    curvature: float
    #: How uncertain that is. Where it is no smaller than ``jump_before``, there is nothing to be continued.
    uncertainty: float


def sized(struct: type[Struct]) -> Struct:
    """A struct that says its size."""
    made = struct()
    made.struct_size = ctypes.sizeof(struct)
    return made


def report_of(
    struct: _abi.fairmesh_report,
    component: Callable[[int, Any], None],
    attempt: Callable[[int, int, Any], None],
    continuity: Callable[[int, int, Any], None],
) -> Report:
    """The library's report; the others write the component, attempt or loop with a number to an address."""
    components = []
    for number in range(struct.component_count):
        made = sized(_abi.fairmesh_component)
        component(number, made)
        attempts = []
        for tried in range(made.attempt_count):
            told = sized(_abi.fairmesh_attempt)
            attempt(number, tried, told)
            attempts.append(Attempt(**_fields(told, Attempt)))
        loops = []
        for loop in range(made.continuity_count):
            of_loop = sized(_abi.fairmesh_continuity)
            continuity(number, loop, of_loop)
            loops.append(Continuity(**_fields(of_loop, Continuity)))
        own = _fields(made, Component)
        components.append(Component(**own, attempts=tuple(attempts), continuity=tuple(loops)))
    return Report(**_fields(struct, Report), components=tuple(components))


def element_or_none(number: int) -> int | None:
    """None in place of the library's "no element"."""
    return None if number == _abi.NO_ELEMENT else number


#: How fields of the structs become Python's; all others are as they are.
_CONVERSIONS: dict[str, Callable[[Any], Any]] = {
    "outcome": Outcome.of,
    "end": AttemptEnd.of,
    "name": bytes.decode,
    "loose_reason": LooseReason.of,
    "linear_surface": bool,
    "intersections_checked": bool,
    "worst_triangle": element_or_none,
    "normal_deviation_vertex": element_or_none,
    "boundary_kink_vertex": element_or_none,
    "h_inside": tuple,
    "h_boundary": tuple,
}


def _fields(struct: Any, of: type[Report | Component | Attempt | Continuity]) -> dict[str, Any]:
    """The fields of a dataclass, from its struct."""
    names = [name for name in of.__dataclass_fields__ if name not in ("components", "attempts", "continuity")]
    return {name: _CONVERSIONS.get(name, _as_it_is)(getattr(struct, name)) for name in names}


def _as_it_is(value: Any) -> Any:
    return value


@dataclass(frozen=True)
class Bends:
    """Why loops are joined: sums over all edges, those of the loops included, of length times angle in radians, of
    triangulations without new vertices. Edges inside count half.
    """

    #: What lies between them: "gap" (between parts of the mesh), "tunnel" (the part gets a handle) or "island".
    kind: str
    #: Of one patch for all of the loops.
    joint_bend: float
    #: Of a patch for each.
    separate_bend: float
    #: The area of the joint patch.
    joint_area: float
    #: That of the separate ones.
    separate_area: float


@dataclass(frozen=True)
class Moved:
    """How far the vertices around a loop moved."""

    #: How many did.
    count: int
    #: How far, root mean square.
    rms: float
    #: How far the one that moved furthest did.
    largest: float
    #: The bound: none moved further.
    within: float
    #: How many triangles are folded or intersect since; none in a sound result.
    unsound: int


def moved_of(struct: _abi.fairmesh_fill_report) -> Moved:
    """The figures in a struct."""
    figures = (struct.moved_rms, struct.moved_largest, struct.moved_within)
    return Moved(struct.moved_count, *figures, struct.moved_unsound)


def bends_of(struct: _abi.fairmesh_fill_report | _abi.fairmesh_join_suggestion) -> Bends:
    """The bends in a struct."""
    kind = _abi.fairmesh_gap_kind(struct.gap_kind).name.lower()
    return Bends(kind, struct.joint_bend, struct.separate_bend, struct.joint_area, struct.separate_area)


@dataclass(frozen=True)
class Level:
    """What was done on one level of the paper's scheme."""

    #: Vertices of the region: free and boundary.
    vertices: int
    triangles: int
    #: Updates of the mesh.
    updates: int
    #: The defect at the end.
    defect: float
