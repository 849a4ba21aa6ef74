"""Fairing of a region: at once, and in steps."""

from __future__ import annotations

import ctypes
import os
import weakref
from functools import cached_property
from typing import TYPE_CHECKING, Any, Generic, overload

import numpy as np
from numpy.typing import NDArray

from . import _abi, _arrays
from ._calls import of_mesh
from ._edits import Edit, Frame, edit_struct
from ._enums import Outcome, Status
from ._errors import FairmeshError, call
from ._handles import ResultHandle
from ._hosts import Arrays, M
from ._keywords import FairKeywords
from ._library import Library, load
from ._options import curvature_view, how_far, loops_view, normals_view, real, target_struct, whole
from ._pickling import Picklable
from ._records import Report
from ._reports import sized
from ._runs import Run, region_of
from ._seams import seams_told, warn_of_seams

if TYPE_CHECKING:
    from collections.abc import Sequence

    from typing_extensions import Unpack

    from ._forms import ArrayLike, Curvature, HowFar, LoopContinuity, Normals, Target

_lists = _abi.fairmesh_list


class Result(Picklable, Generic[M]):
    """A faired mesh. Arrays are made when they are first asked for, and then kept."""

    def __init__(self, handle: ResultHandle, vertices: NDArray[Any], given: _arrays.Mesh) -> None:
        self._handle = handle
        self._given = given.host
        #: All vertices, (n, 3), in the type given; fixed ones have their bits.
        self.vertices = vertices
        #: How it went.
        self.report: Report = handle.report()

    @property
    def outcome(self) -> Outcome:
        """How it ended; the same as ``report.outcome``."""
        return self.report.outcome

    @cached_property
    def mesh(self) -> M:
        """The faired mesh, of the kind given: a copy with these vertices and with all that belonged to the mesh.

        Of two arrays, a pair of arrays. Made when first asked for, of the mesh as it is then: ask before you change it.
        """
        made: M = self._given.same(lambda: self._given.moved(self.vertices))
        return made

    @cached_property
    def mean_curvature(self) -> NDArray[np.float64]:
        """Mean curvature H, (n,), in 1 / length: negative on a sphere with outward normals. NaN at vertices not in the
        region.
        """
        return self._handle.scalars(_abi.fairmesh_scalars.MEAN_CURVATURE, len(self.vertices))

    @cached_property
    def gaussian_curvature(self) -> NDArray[np.float64]:
        """Gaussian curvature, (n,), in 1 / length^2. NaN where no vertex is free."""
        return self._handle.scalars(_abi.fairmesh_scalars.GAUSSIAN_CURVATURE, len(self.vertices))

    @cached_property
    def boundary_vertices(self) -> NDArray[np.intp]:
        """The fixed vertices around and in the region, ascending, (b,)."""
        return self._handle.list(_lists.BOUNDARY_VERTICES)

    @cached_property
    def boundary_normals(self) -> NDArray[np.float64]:
        """The unit normals that were used there, (b, 3)."""
        return self._handle.vectors(_abi.fairmesh_vectors.BOUNDARY_NORMALS, len(self.boundary_vertices))

    @cached_property
    def poor_triangles(self) -> NDArray[np.intp]:
        """Triangles that are flipped or have an angle below one degree, where the outcome is about them."""
        return self._handle.list(_lists.POOR_TRIANGLES)

    @cached_property
    def flipped_triangles(self) -> NDArray[np.intp]:
        """Triangles whose normal points away from those of their vertices."""
        return self._handle.list(_lists.FLIPPED_TRIANGLES)

    @cached_property
    def needles(self) -> NDArray[np.intp]:
        """Triangles with an angle below one degree."""
        return self._handle.list(_lists.NEEDLES)

    @cached_property
    def intersections(self) -> NDArray[np.intp]:
        """Pairs of triangles that intersect, (p, 2), the smaller index first; one or both have a free vertex."""
        return self._handle.list(_lists.INTERSECTIONS).reshape(-1, 2)

    @cached_property
    def suspicious_normals(self) -> NDArray[np.intp]:
        """Boundary vertices whose normal contradicts the surface or its neighbours'."""
        return self._handle.list(_lists.SUSPICIOUS_NORMALS)

    @cached_property
    def creased_vertices(self) -> NDArray[np.intp]:
        """Boundary vertices where the surface has a crease, where the outcome is about them."""
        return self._handle.list(_lists.CREASED_VERTICES)

    def __repr__(self) -> str:
        report = self.report
        return (
            f"<fairmesh.Result: {report.outcome}, {report.free_vertices} free vertices, {report.iterations} iterations>"
        )


@overload
def fair(mesh: M, /, free: _arrays.Selection = None, **keywords: Unpack[FairKeywords]) -> Result[M]: ...
@overload
def fair(
    vertices: ArrayLike, faces: ArrayLike, free: _arrays.Selection = None, **keywords: Unpack[FairKeywords]
) -> Result[Arrays]: ...
@of_mesh(FairKeywords)
def fair(mesh: _arrays.Mesh, free: _arrays.Selection = None, **keywords: Unpack[FairKeywords]) -> Result[Any]:
    """Moves the free vertices until the surface between the fixed ones solves Delta_B H = 0, or what ``target`` asks.

    The surface passes through the fixed vertices with tangent continuity, or with that of curvature as far as
    ``continuity`` asks. A run that ends badly is an `Outcome`, no exception: ``result.vertices`` is usable in every
    case. The interpreter lock is released; any number of threads may call this at once.

    ``fair(mesh, mask)`` takes a mesh of trimesh, pyvista, Open3D or meshio, and ``result.mesh`` is one of its kind;
    ``fair(vertices, faces, mask)`` takes arrays, as libigl has them.

    Args:
        mesh: Such an object, or in two arguments vertices and faces; it is not written. vertices: (n, 3) float32 or
            float64, any unit of length; other real numbers are converted to float64. faces: (m, 3) integers from 0,
            counter-clockwise seen from the side that normals point to.
        free: The vertices that may move: a mask (n,) of bool or of 0 and 1; indices in any order; or the name of such
            an array that the mesh has at its vertices.
        fixed: In its place the vertices that may not.
        free_faces: In its place a mask (m,), indices, or the name of data of faces: free are vertices that
            have no other faces and are not on the boundary of the mesh. With none of the three: all vertices that are
            not on the boundary of the mesh.
        coincident: Whether vertices at the same place are one vertex of the surface, as in triangle soups and along
            texture seams: "join" (default) where their coordinates are equal; a distance that they may be apart; or
            "separate". All copies of a free vertex move alike. Indices name a vertex by any of its copies; a mask
            frees it where it frees all of them.
        progress: Called with a `Progress` after every iteration and at phases of the preparation, on this thread. False
            stops the run; an exception stops it too, and is raised again by this function.
        cancel: A `threading.Event` or anything with ``is_set()``, or a `Monitor`: set from another thread, it stops the
            run before the next iteration, with the outcome CANCELLED.
        **options: How fairing is done: boundary_normals, continuity, target, tolerance, threads, ..., see
            `FairingOptions`. None is the default.

    Returns:
        `Result`: the vertices in the type given, the report, curvatures and lists.

    Raises:
        InputError: The mesh around the region, the selection, a normal or an option is wrong; it says which vertex or
            face.
        FairmeshError: Another refusal, see `Status`.
        TypeError, ValueError: An array has the wrong type or shape, an option is none of the known names.
        LibraryError: The shared library was not found, or is of another version.

    """
    region = region_of(mesh, free, keywords)
    run = Run(mesh, keywords)
    positions = np.empty(mesh.vertices.shape, mesh.vertices.dtype)
    handle = run.result("fairmesh_fair", region.struct, run.options, _arrays.points_out(positions), None)
    made: Result[Any] = Result(handle, positions, mesh)
    if free is None:
        warn_of_seams(mesh, made.boundary_vertices)
    return made


def _free(library: Library, address: ctypes.c_void_p, process: int) -> int:
    """Frees a solver; not in a forked process, where its threads do not exist and would be waited for."""
    return library.fairmesh_solver_free(address) if os.getpid() == process else int(Status.OK)


class Solver(Generic[M]):
    """Fairing in steps: run some iterations, look, change the normals, the continuity or the target, go on.

    For a live surface, `edit` the boundary, show a frame after each `update`, and `finish`.

    Everything is copied when the solver is made. Runs without changes find what `fair` finds, to the last bit. A solver
    is used by one thread at a time; others get a FairmeshError with `Status.BUSY`, and so does its own callback. It
    holds memory and idle threads until it is closed, also by ``with``, or collected. A forked process cannot use it.

    Arguments and errors are those of `fair`.
    """

    @overload
    def __init__(self, mesh: M, /, free: _arrays.Selection = None, **keywords: Unpack[FairKeywords]) -> None: ...
    @overload
    def __init__(
        self: Solver[Arrays],
        vertices: ArrayLike,
        faces: ArrayLike,
        free: _arrays.Selection = None,
        **keywords: Unpack[FairKeywords],
    ) -> None: ...
    @of_mesh(FairKeywords)
    def __init__(self, mesh: _arrays.Mesh, free: _arrays.Selection = None, **keywords: Unpack[FairKeywords]) -> None:
        self._library = load()
        region = region_of(mesh, free, keywords)
        run = Run(mesh, keywords)
        self._relay = run.relay
        self._given = mesh
        self._shape = mesh.vertices.shape
        self._dtype = mesh.vertices.dtype
        self._address = ctypes.c_void_p()
        with seams_told(mesh), self._relay:
            call(self._library, "fairmesh_solver_new", mesh.struct, region.struct, run.options, self._address)
            self._process = os.getpid()
            self._finalizer = weakref.finalize(self, _free, self._library, self._address, self._process)
            self._finalizer.atexit = False

    def _call(self, function: str, *arguments: Any) -> None:
        if not self._finalizer.alive:
            raise FairmeshError(Status.BAD_HANDLE, "the solver is closed")
        if self._process != os.getpid():
            raise FairmeshError(Status.BAD_HANDLE, "the solver belongs to the process that this one was forked from")
        call(self._library, function, self._address, *arguments)

    def run(self, iterations: int | None = None) -> Report:
        """Runs at most so many nonlinear iterations of each component, at least one; None: to the end.

        The outcome ITERATION_LIMIT or CANCELLED says that a further run goes on from here; after any other one the end
        is reached, and a further run does nothing until something is changed.
        """
        count = _abi.NO_ELEMENT if iterations is None else whole(iterations, "iterations")
        with self._relay:
            self._call("fairmesh_solver_run", count, None)
        return self.report

    def set_boundary_normals(self, normals: Normals) -> None:
        """Asks for other boundary normals from now on, as in `fair`. The next run starts at the surface at hand."""
        view = normals_view(normals, self._shape[0])
        self._set(_abi.fairmesh_setting.BOUNDARY_NORMALS, boundary_normals=view)

    def set_continuity(self, continuity: HowFar, loops: LoopContinuity | None = None) -> None:
        """Asks for another ``continuity`` from now on, and with ``loops`` for a ``loop_continuity``, as in `fair`.

        The next run starts at the surface at hand.
        """
        view, asked = loops_view(loops or {}), how_far(continuity, "continuity")
        self._set(_abi.fairmesh_setting.CONTINUITY, continuity=asked, loop_continuity=view)

    def set_boundary_curvature(self, curvature: Curvature) -> None:
        """Asks for the continuation of another curvature from now on, as in `fair`.

        The next run starts at the surface at hand.
        """
        view = curvature_view(curvature, self._shape[0])
        self._set(_abi.fairmesh_setting.BOUNDARY_CURVATURE, boundary_curvature=view)

    def set_target(self, target: Target) -> None:
        """Asks for another target from now on, given as in `fair`. The next run starts at the surface at hand."""
        self._set(_abi.fairmesh_setting.TARGET, target=target_struct(target))

    def _set(self, setting: _abi.fairmesh_setting, **fields: Any) -> None:
        options = sized(_abi.fairmesh_options)
        for name, value in fields.items():
            setattr(options, name, value)
        self._call("fairmesh_solver_set", setting, options)

    def edit(self, edits: Sequence[Edit]) -> None:
        """Asks for these changes of the boundary: `Tilt`, `Twist`, `Bulge`, `Move`.

        They take the place of the edits before, and are all relative to what was asked otherwise: no edits, and nothing
        is changed of that. The next update or run starts at the surface at hand, with the matrices at hand.
        """
        structs = [edit_struct(edit, self._shape[0]) for edit in edits]
        self._call("fairmesh_solver_edit", (_abi.fairmesh_edit * len(structs))(*structs), len(structs))

    def update(self, *, evaluations: int = 0, seconds: float = 0.0, tolerance: float = 0.0) -> Frame:
        """One frame: goes on until the surface is settled, or the limit is used up. `vertices` has the surface.

        Args:
            evaluations: Evaluations of the equations at most; 0: no limit.
            seconds: About; 0: no limit. With a limit of seconds the surface depends on the machine.
            tolerance: The step norm at which a frame is settled, in diagonals; 0: 1e-6.

        """
        limit, made = sized(_abi.fairmesh_budget), sized(_abi.fairmesh_frame)
        limit.evaluations = whole(evaluations, "evaluations")
        limit.seconds, limit.tolerance = real(seconds, "seconds"), real(tolerance, "tolerance")
        self._call("fairmesh_solver_update", limit, made)
        return Frame(made.step, made.evaluations, bool(made.is_settled))

    def finish(self) -> Report:
        """The converged surface with its report, checked: to the tolerance what `fair` finds for what is asked."""
        with self._relay:
            self._call("fairmesh_solver_finish", None)
        return self.report

    def bulge_range(self) -> tuple[float, float]:
        """Between which amounts of a `Bulge`, beside the other edits in force, sound surfaces are found.

        It costs some tens of frames; the surface at hand stays.
        """
        made = sized(_abi.fairmesh_bulge_range)
        with self._relay:
            self._call("fairmesh_solver_bulge_range", made)
        return made.low, made.high

    @property
    def vertices(self) -> NDArray[Any]:
        """All vertices as they stand, (n, 3), in the type given; before the first run or update, those given."""
        made = np.empty(self._shape, self._dtype)
        self._call("fairmesh_solver_positions", _arrays.points_out(made))
        return made

    @property
    def mesh(self) -> M:
        """The mesh as it stands, of the kind given, as `Result.mesh` is."""
        host = self._given.host
        made: M = host.same(lambda: host.moved(self.vertices))
        return made

    @property
    def mean_curvature(self) -> NDArray[np.float64]:
        """The mean curvature of the surface as it stands, (n,); NaN where no vertex is free."""
        return self._handle().scalars(_abi.fairmesh_scalars.MEAN_CURVATURE, self._shape[0])

    @property
    def report(self) -> Report:
        """The report of the last run; before the first one, of the input."""
        return self._handle().report()

    def _handle(self) -> ResultHandle:
        address = ctypes.c_void_p()
        self._call("fairmesh_solver_result", address)
        return ResultHandle(self._library, address)

    def result(self) -> Result[M]:
        """A copy of everything that is known of the surface as it stands."""
        handle = self._handle()
        return Result(handle, handle.positions(self._shape[0], self._dtype), self._given)

    def close(self) -> None:
        """Frees the solver's memory and threads. Closing twice is allowed; while it runs, it is refused with BUSY."""
        if self._finalizer.alive:
            if _free(self._library, self._address, self._process) == Status.BUSY:
                raise FairmeshError(Status.BUSY, "the solver is in use")
            self._finalizer.detach()

    def __enter__(self) -> Solver[M]:
        return self

    def __exit__(self, *_: object) -> None:
        self.close()
