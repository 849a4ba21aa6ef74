"""Keyword arguments to the library's options. Defaults are the library's: what is None is not touched."""

from __future__ import annotations

import ctypes
from collections import abc
from typing import TYPE_CHECKING, Any, Literal, TypedDict, TypeVar, Union

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _abi, _arrays
from ._calls import of_mesh, of_names
from ._enums import Status
from ._errors import error_of
from ._library import Library, load

if TYPE_CHECKING:
    from collections.abc import Mapping

InnerFairness = Literal["uniform", "conformal", "convex"]
InteriorNormals = Literal["smooth", "input"]
Discretization = Literal["second_order", "paper"]
OutputPrecision = Literal["double", "single"]
SolverKind = Literal["fast", "paper"]
Intersections = Literal["check", "skip"]
Estimate = Literal["alternating", "gauss_seidel", "conjugate_gradients"]
#: "fitted", "averaged", (n, 3) unit vectors with rows of zeros or NaN where none is given, or (indices, (k, 3)).
Normals = Union[Literal["fitted", "averaged"], ArrayLike, tuple[ArrayLike, ArrayLike]]
#: "g1", "g2", or a number from 0 (g1) to 1 (g2).
HowFar = Union[Literal["g1", "g2"], float]
#: "estimated", {index: H}, (indices, (k,)), or (n,) numbers with NaN where none is given.
Curvature = Union[Literal["estimated"], abc.Mapping[int, float], ArrayLike, tuple[ArrayLike, ArrayLike]]
#: {index of a vertex of the loop: "g1", "g2" or a number}.
LoopContinuity = abc.Mapping[int, HowFar]
#: "harmonic", "minimal_energy", or a constant in 1 / length^3.
Target = Union[Literal["harmonic", "minimal_energy"], float]


class FairingOptions(TypedDict, total=False):
    """How fairing is done: the keywords that `fair`, `fill_holes` and `Solver` have in common. None is the default.

    Keywords:
        boundary_normals: Unit normals at the boundary of the region, pointing to the side that faces are
            counter-clockwise seen from: "fitted" (default) to second or third order to the surface outside;
            "averaged" over the faces outside; an array (n, 3), one row per vertex, zeros or NaN where none is given; or
            a pair (indices (k,), vectors (k, 3)). Where none is given they are fitted. Length 1 to 0.001.
        continuity: How far the surface continues the mean curvature of its surroundings: "g1" or 0, tangent planes
            alone; "g2" or 1, curvature, too; or a number between, part of the way. Default 0.0. Only as far as the
            surroundings are smooth enough to tell their curvature: `Component.continuity` of the report says how far.
            For the solver "fast".
        loop_continuity: The same for single boundary loops: a mapping from a vertex of the loop to "g1", "g2" or a
            number, in place of ``continuity`` there. Of several for one loop the last one holds. Default: {}.
        boundary_curvature: The mean curvature to be continued, in 1 / length, negative where the normals point outward
            of a sphere; "estimated" (default) from the surface outside; a mapping from vertices to numbers; a pair
            (indices (k,), values (k,)); or an array (n,), one number per vertex, NaN where none is given. Where none is
            given it is estimated.
        target: The Laplacian of the mean curvature: "harmonic" (default), zero; a number in 1 / length^3, a
            positive one pushes the surface out along its normals; or "minimal_energy", -2 H (H^2 - K).
        inner_fairness: How vertices are distributed within the surface: "uniform" (default), evenly; "conformal",
            with the least distortion of the input's triangles; "convex", near conformal with positive weights for
            any input.
        interior_normals: Normals of fixed vertices inside the region that have none given: "smooth" (default), the
            surface's own; "input", the average of their faces in the input.
        tolerance: Stop when the step norm (rms normal step + rms tangential step, over the diagonal of the component's
            bounding box) is below this; from 1e-15, below 1. Default 1e-8; 1e-6 is enough for interactive use.
        max_iterations: At most this many nonlinear iterations for each component, at least 1. Default 500.
        threads: Worker threads, at most 1024; 0 (default): as many as the machine has. Any number gives the same
            bits.
        intersections: "check" (default): the final surface is searched for triangles that intersect each other or the
            rest of the mesh, and is no success if there are any; "skip": not searched. About a tenth of the run.
        discretization: Of normals and mean curvature: "second_order" (default) on irregular meshes; "paper", that
            of Schneider and Kobbelt (2001).
        solver: "fast" (default); "paper", the scheme of Schneider and Kobbelt (2001): slow, a yardstick.
        paper_estimate: Of the solver "paper", as all that follow: how it estimates the mean curvature:
            "alternating" (default), "gauss_seidel" or "conjugate_gradients".
        paper_estimate_iterations: Iterations of the estimate. Default 10.
        paper_damping: The part of each normal step that is taken, in (0, 1]. Default 0.9.
        paper_levels: Levels of the hierarchy; 1: none; 0 (default): as many as make each level four times as large.
        paper_base: Vertices of the base mesh; 0 (default): two and a half times the boundary.
        paper_defect: Stop when ``defect`` of the report is at most this. Default 1e-6.
        paper_laplacian: And when max |Delta_B H| times the cube of the diagonal is at most this. Default: infinite.
        paper_max_updates: At most this many updates on all levels. Default 20000.
        output_precision: What the result will be written in, "double" or "single": new positions are rounded to it, and
            the report is of the rounded surface. Default: None; then that of the array of vertices.
    """

    boundary_normals: Normals | None
    continuity: HowFar | None
    loop_continuity: LoopContinuity | None
    boundary_curvature: Curvature | None
    target: Target | None
    inner_fairness: InnerFairness | None
    interior_normals: InteriorNormals | None
    tolerance: float | None
    max_iterations: int | None
    threads: int | None
    intersections: Intersections | None
    discretization: Discretization | None
    solver: SolverKind | None
    paper_estimate: Estimate | None
    paper_estimate_iterations: int | None
    paper_damping: float | None
    paper_levels: int | None
    paper_base: int | None
    paper_defect: float | None
    paper_laplacian: float | None
    paper_max_updates: int | None
    output_precision: OutputPrecision | None


#: The library's defaults, as `default_options` reads them.
DEFAULTS: FairingOptions = {
    "boundary_normals": "fitted",
    "continuity": 0.0,
    "loop_continuity": {},
    "boundary_curvature": "estimated",
    "target": "harmonic",
    "inner_fairness": "uniform",
    "interior_normals": "smooth",
    "tolerance": 1e-8,
    "max_iterations": 500,
    "threads": 0,
    "intersections": "check",
    "discretization": "second_order",
    "solver": "fast",
    "paper_estimate": "alternating",
    "paper_estimate_iterations": 10,
    "paper_damping": 0.9,
    "paper_levels": 0,
    "paper_base": 0,
    "paper_defect": 1e-6,
    "paper_laplacian": float("inf"),
    "paper_max_updates": 20000,
    "output_precision": None,
}
#: For functions of meshes that take the fairing options.
with_options = of_mesh(FairingOptions, DEFAULTS)


class FillOptions(TypedDict):
    """Defaults of `fill_holes`."""

    fair: bool
    join: str
    on_failure: str
    relax_rim: int
    max_edges: int | None
    except_longest: int
    density: float
    max_new_vertices: int


class RemeshOptions(TypedDict):
    """Defaults of `remesh`."""

    density: float
    max_vertices: int


_NAMED = {
    "inner_fairness": _abi.fairmesh_inner_fairness,
    "interior_normals": _abi.fairmesh_interior_normals,
    "intersections": _abi.fairmesh_intersections,
    "discretization": _abi.fairmesh_discretization,
    "output_precision": _abi.fairmesh_output_precision,
    "solver": _abi.fairmesh_solver_kind,
    "paper_estimate": _abi.fairmesh_estimate,
}
_REALS = ("tolerance", "paper_damping", "paper_defect", "paper_laplacian")
_WHOLE = {
    "max_iterations": 64,
    "threads": 32,
    "paper_estimate_iterations": 32,
    "paper_levels": 64,
    "paper_base": 64,
    "paper_max_updates": 64,
}
UINT64_MAX = 2**64 - 1

Struct = TypeVar("Struct", bound=ctypes.Structure)


def initial(library: Library, function: str, struct: type[Struct]) -> Struct:
    """A struct filled with the library's defaults."""
    made = struct()
    status = getattr(library, function)(ctypes.byref(made), ctypes.sizeof(struct))
    if status != Status.OK:
        raise error_of(function, status, _abi.fairmesh_error(status, 0, _abi.NO_ELEMENT, _abi.NO_ELEMENT))
    return made


def real(value: Any, name: str) -> float:
    """A real number."""
    if isinstance(value, (bool, np.bool_)) or not isinstance(value, (int, float, np.integer, np.floating)):
        raise TypeError(f"{name}: a number is needed, not {type(value).__name__}")
    return float(value)


def whole(value: Any, name: str, bits: int = 64) -> int:
    """A number without sign of so many bits."""
    if isinstance(value, (bool, np.bool_)) or not isinstance(value, (int, np.integer)):
        raise TypeError(f"{name}: an integer is needed, not {type(value).__name__}")
    if not 0 <= value < 2**bits:
        raise ValueError(f"{name}: {value} is not between 0 and 2**{bits} - 1")
    return int(value)


class Options:
    """The library's options. Keeps the arrays of normals, curvatures and loops alive."""

    def __init__(self, library: Library, vertices: NDArray[Any], given: Mapping[str, Any]) -> None:
        self.struct = initial(library, "fairmesh_options_init", _abi.fairmesh_options)
        if vertices.dtype == np.float32:
            self.struct.output_precision = _abi.fairmesh_output_precision.SINGLE
        self.alive: list[NormalsView | CurvatureView | LoopsView] = []
        for name, value in given.items():
            if value is not None:
                self._set(name, value, len(vertices))

    def _set(self, name: str, value: Any, vertex_count: int) -> None:
        if name == "boundary_normals":
            normals = NormalsView(value, vertex_count)
            self.alive.append(normals)
            self.struct.boundary_normals = normals.struct
        elif name == "boundary_curvature":
            curvature = CurvatureView(value, vertex_count)
            self.alive.append(curvature)
            self.struct.boundary_curvature = curvature.struct
        elif name == "continuity":
            self.struct.continuity = how_far(value, name)
        elif name == "loop_continuity":
            loops = LoopsView(value)
            self.alive.append(loops)
            self.struct.loop_continuity = loops.struct
        elif name == "target":
            self.struct.target = target_struct(value)
        elif name in _NAMED:
            setattr(self.struct, name, _number(value, name))
        elif name in _REALS:
            setattr(self.struct, name, real(value, name))
        else:
            setattr(self.struct, name, whole(value, name, _WHOLE[name]))


def _number(value: Any, name: str) -> int:
    names = {member.name.lower(): member for member in _NAMED[name]}
    if not isinstance(value, str) or value not in names:
        raise ValueError(of_names(value, name, names))
    return names[value]


def how_far(value: HowFar, name: str) -> float:
    """From 0 to 1, if the library agrees."""
    names = {"g1": 0.0, "g2": 1.0}
    if not isinstance(value, str):
        return real(value, name)
    if value not in names:
        raise ValueError(f"{name}: {value!r} is neither 'g1' nor 'g2' nor a number")
    return names[value]


def target_struct(value: Target) -> _abi.fairmesh_target:
    """The right-hand side of the equation, as the library reads it."""
    kinds = _abi.fairmesh_target_kind
    if isinstance(value, str):
        if value == "harmonic":
            return _abi.fairmesh_target(kinds.HARMONIC, 0, 0.0)
        if value == "minimal_energy":
            return _abi.fairmesh_target(kinds.MINIMAL_ENERGY, 0, 0.0)
        raise ValueError(f"target: {value!r} is neither 'harmonic' nor 'minimal_energy' nor a number")
    return _abi.fairmesh_target(kinds.CONSTANT, 0, real(value, "target"))


class NormalsView:
    """Boundary normals, as the library reads them. Keeps the arrays alive."""

    def __init__(self, given: Normals, vertex_count: int) -> None:
        kinds = _abi.fairmesh_boundary_normals_kind
        self.vectors: NDArray[Any] | None = None
        self.indices: NDArray[np.uint32] | None = None
        if isinstance(given, str):
            if given not in ("fitted", "averaged"):
                raise ValueError(f"boundary_normals: {given!r} is neither 'fitted' nor 'averaged' nor an array")
            self.struct = _abi.fairmesh_boundary_normals(kinds[given.upper()], 0)
            return
        if isinstance(given, tuple) and len(given) == 2:
            self.indices = _arrays.indices(given[0], "boundary_normals")
            self.vectors = _arrays.points(given[1], "boundary_normals", rows=len(self.indices))
        else:
            self.vectors = _none_as_zero(_arrays.points(given, "boundary_normals", rows=vertex_count))
        self.struct = _abi.fairmesh_boundary_normals(kinds.GIVEN, 0, _arrays.points_view(self.vectors))
        if self.indices is not None:
            self.struct.vertices = _arrays.indices_view(self.indices)


class CurvatureView:
    """Mean curvature at the boundary, as the library reads it. Keeps the arrays alive."""

    def __init__(self, given: Curvature, vertex_count: int) -> None:
        kinds, name = _abi.fairmesh_boundary_curvature_kind, "boundary_curvature"
        self.values: NDArray[Any] | None = None
        self.indices: NDArray[np.uint32] | None = None
        if isinstance(given, str):
            if given != "estimated":
                raise ValueError(f"{name}: {given!r} is neither 'estimated' nor a mapping nor an array")
            self.struct = _abi.fairmesh_boundary_curvature(kinds.ESTIMATED, 0)
            return
        if isinstance(given, abc.Mapping):
            given = (list(given), list(given.values()))
        if isinstance(given, tuple) and len(given) == 2:
            self.indices = _arrays.indices(given[0], name)
            self.values = _arrays.numbers(given[1], name, count=len(self.indices))
            if len(self.indices) == 0:
                # For the library, no list of vertices is one number for each.
                self.struct = _abi.fairmesh_boundary_curvature(kinds.ESTIMATED, 0)
                return
        else:
            self.values = _arrays.numbers(given, name, count=vertex_count)
        self.struct = _abi.fairmesh_boundary_curvature(kinds.GIVEN, 0, _arrays.numbers_view(self.values))
        if self.indices is not None:
            self.struct.vertices = _arrays.indices_view(self.indices)


class LoopsView:
    """How far single loops are continued, as the library reads it. Keeps the arrays alive."""

    def __init__(self, given: LoopContinuity) -> None:
        name = "loop_continuity"
        if not isinstance(given, abc.Mapping):
            raise TypeError(f"{name}: a mapping from vertices to numbers is needed, not {type(given).__name__}")
        self.struct = _abi.fairmesh_loop_continuity()
        if not given:
            return
        self.indices = _arrays.indices(list(given), name)
        self.values = np.array([how_far(value, name) for value in given.values()])
        self.struct.values = _arrays.numbers_view(self.values)
        self.struct.vertices = _arrays.indices_view(self.indices)


def _none_as_zero(vectors: NDArray[Any]) -> NDArray[Any]:
    """Rows of NaN say that no normal is given: for the library, zeros do."""
    empty = np.isnan(vectors).all(axis=1)
    if not empty.any():
        return vectors
    copy = np.array(vectors, order="C")
    copy[empty] = 0.0
    return copy


def default_options() -> FairingOptions:
    """All fairing options with their defaults, read from the library: ``fair(v, f, **default_options())`` is
    ``fair(v, f)``.
    """
    struct = initial(load(), "fairmesh_options_init", _abi.fairmesh_options)
    options: dict[str, Any] = {
        "boundary_normals": _abi.fairmesh_boundary_normals_kind(struct.boundary_normals.kind).name.lower(),
        "continuity": struct.continuity,
        "loop_continuity": {},
        "boundary_curvature": _abi.fairmesh_boundary_curvature_kind(struct.boundary_curvature.kind).name.lower(),
        "target": _abi.fairmesh_target_kind(struct.target.kind).name.lower(),
    }
    for name in FairingOptions.__annotations__:
        if name in _NAMED:
            options[name] = _NAMED[name](getattr(struct, name)).name.lower()
        elif name not in options:
            options[name] = getattr(struct, name)
    # That of the vertices.
    options["output_precision"] = None
    return options  # type: ignore[return-value]


def default_fill_options() -> FillOptions:
    """The defaults of `fill_holes`, read from the library."""
    struct = initial(load(), "fairmesh_fill_options_init", _abi.fairmesh_fill_options)
    return {
        "fair": bool(struct.fair),
        "join": _abi.fairmesh_join_kind(struct.join.kind).name.lower(),
        "on_failure": _abi.fairmesh_on_failure(struct.on_failure).name.lower(),
        "relax_rim": struct.relax_rim,
        "max_edges": None if struct.max_edges == UINT64_MAX else struct.max_edges,
        "except_longest": struct.filter.except_longest,
        "density": struct.density,
        "max_new_vertices": struct.max_new_vertices,
    }


def default_remesh_options() -> RemeshOptions:
    """The defaults of `remesh`, read from the library."""
    struct = initial(load(), "fairmesh_remesh_options_init", _abi.fairmesh_remesh_options)
    return {"density": struct.density, "max_vertices": struct.max_vertices}
