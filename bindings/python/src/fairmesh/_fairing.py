"""Fairing of a region: at once, and in steps."""

from __future__ import annotations

import ctypes
import weakref
from functools import cached_property
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _abi, _arrays
from ._errors import FairmeshError, Status, call
from ._handles import ResultHandle, sized
from ._library import load
from ._options import Normals, NormalsView, Options, Target, target_struct, whole
from ._progress import Event, ProgressCallback, Relay
from ._reports import Level, Outcome, Report, report_of

if TYPE_CHECKING:
    from typing_extensions import Unpack

    from ._options import FairingOptions

_lists = _abi.fairmesh_list


class Result:
    """A faired mesh. Arrays are made when they are first asked for, and then kept."""

    def __init__(self, handle: ResultHandle, vertices: NDArray[Any]) -> None:
        self._handle = handle
        #: All vertices, (n, 3), in the type given; fixed ones have their bits.
        self.vertices = vertices
        #: How it went.
        self.report: Report = handle.report()

    @property
    def outcome(self) -> Outcome:
        """How it ended; the same as ``report.outcome``."""
        return self.report.outcome

    @cached_property
    def mean_curvature(self) -> NDArray[np.float64]:
        """Mean curvature H, (n,), in 1 / length: negative on a sphere with outward normals. NaN where no vertex is free."""
        return self._handle.scalars(_abi.fairmesh_scalars.MEAN_CURVATURE, len(self.vertices))

    @cached_property
    def gaussian_curvature(self) -> NDArray[np.float64]:
        """Gaussian curvature, (n,), in 1 / length^2. NaN where no vertex is free."""
        return self._handle.scalars(_abi.fairmesh_scalars.GAUSSIAN_CURVATURE, len(self.vertices))

    @cached_property
    def border_vertices(self) -> NDArray[np.intp]:
        """The fixed vertices around and in the region, ascending, (b,)."""
        return self._handle.list(_lists.BORDER_VERTICES)

    @cached_property
    def border_normals(self) -> NDArray[np.float64]:
        """The unit normals that were used there, (b, 3)."""
        return self._handle.vectors(_abi.fairmesh_vectors.BORDER_NORMALS, len(self.border_vertices))

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
    def suspicious_normals(self) -> NDArray[np.intp]:
        """Border vertices whose normal contradicts the surface or its neighbours'."""
        return self._handle.list(_lists.SUSPICIOUS_NORMALS)

    @cached_property
    def unreached_vertices(self) -> NDArray[np.intp]:
        """Border vertices whose normals stood farthest away, worst first."""
        return self._handle.list(_lists.UNREACHED_VERTICES)

    @cached_property
    def levels(self) -> list[Level]:
        """What the solver "paper" did on each level, from the base to the mesh given."""
        made = []
        for index in range(self.report.level_count):
            level = sized(_abi.fairmesh_level)
            self._handle.read("fairmesh_result_level", index, ctypes.byref(level))
            made.append(Level(level.vertices, level.triangles, level.updates, level.defect))
        return made

    def __repr__(self) -> str:
        report = self.report
        return f"<fairmesh.Result: {report.outcome}, {report.free_vertices} free vertices, {report.iterations} iterations>"


def fair(
    vertices: ArrayLike,
    faces: ArrayLike,
    *,
    free: _arrays.Selection = None,
    fixed: _arrays.Selection = None,
    free_faces: _arrays.Selection = None,
    progress: ProgressCallback | None = None,
    cancel: Event | None = None,
    **options: Unpack[FairingOptions],
) -> Result:
    """TODO."""
    library = load()
    mesh = _arrays.Mesh(vertices, faces)
    region = _arrays.Region(mesh, free, fixed, free_faces)
    asked = Options(library, len(mesh.vertices), options)
    relay = Relay(progress, cancel)
    relay.install(asked.struct)
    address = ctypes.c_void_p()
    positions = np.empty(mesh.vertices.shape, mesh.vertices.dtype)
    call(
        library,
        "fairmesh_fair",
        ctypes.byref(mesh.struct),
        ctypes.byref(region.struct),
        ctypes.byref(asked.struct),
        ctypes.byref(_arrays.points_out(positions)),
        None,
        ctypes.byref(address),
    )
    handle = ResultHandle(library, address)
    relay.rethrow()
    return Result(handle, positions)


class Solver:
    """TODO."""

    def __init__(
        self,
        vertices: ArrayLike,
        faces: ArrayLike,
        *,
        free: _arrays.Selection = None,
        fixed: _arrays.Selection = None,
        free_faces: _arrays.Selection = None,
        progress: ProgressCallback | None = None,
        cancel: Event | None = None,
        **options: Unpack[FairingOptions],
    ) -> None:
        self._library = load()
        mesh = _arrays.Mesh(vertices, faces)
        region = _arrays.Region(mesh, free, fixed, free_faces)
        asked = Options(self._library, len(mesh.vertices), options)
        self._relay = Relay(progress, cancel)
        self._relay.install(asked.struct)
        self._shape = mesh.vertices.shape
        self._dtype = mesh.vertices.dtype
        self._address = ctypes.c_void_p()
        call(
            self._library,
            "fairmesh_solver_new",
            ctypes.byref(mesh.struct),
            ctypes.byref(region.struct),
            ctypes.byref(asked.struct),
            ctypes.byref(self._address),
        )
        self._finalizer = weakref.finalize(self, self._library.fairmesh_solver_free, self._address)
        self._finalizer.atexit = False
        self._relay.rethrow()

    def _call(self, function: str, *arguments: Any) -> None:
        if not self._finalizer.alive:
            raise FairmeshError(Status.BAD_HANDLE, "the solver is closed")
        call(self._library, function, self._address, *arguments)

    def run(self, iterations: int | None = None) -> Report:
        """Runs at most so many nonlinear iterations, at least one; None: to the end."""
        report = sized(_abi.fairmesh_report)
        count = _abi.NO_ELEMENT if iterations is None else whole(iterations, "iterations")
        try:
            self._call("fairmesh_solver_run", count, ctypes.byref(report))
        except FairmeshError as why:
            if why.status is not Status.BUSY:  # else it is another thread's
                self._relay.take()
            raise
        self._relay.rethrow()
        return report_of(report)

    def set_normals(self, normals: Normals) -> None:
        """Asks for other border normals from now on."""
        view = NormalsView(normals, self._shape[0])
        self._call("fairmesh_solver_set_normals", ctypes.byref(view.struct))

    def set_target(self, target: Target) -> None:
        """Asks for another target from now on."""
        self._call("fairmesh_solver_set_target", ctypes.byref(target_struct(target)))

    @property
    def vertices(self) -> NDArray[Any]:
        """All vertices as they stand."""
        made = np.empty(self._shape, self._dtype)
        self._call("fairmesh_solver_positions", ctypes.byref(_arrays.points_out(made)))
        return made

    @property
    def mean_curvature(self) -> NDArray[np.float64]:
        """The mean curvature of the surface as it stands, (n,); NaN where no vertex is free."""
        made = np.empty(self._shape[0])
        self._call("fairmesh_solver_mean_curvature", ctypes.byref(_arrays.scalars_out(made)))
        return made

    @property
    def report(self) -> Report:
        """The report of the last run; before the first one, of the input."""
        made = sized(_abi.fairmesh_report)
        self._call("fairmesh_solver_report", ctypes.byref(made))
        return report_of(made)

    def result(self) -> Result:
        """A copy of everything that is known of the surface as it stands."""
        address = ctypes.c_void_p()
        self._call("fairmesh_solver_result", ctypes.byref(address))
        handle = ResultHandle(self._library, address)
        return Result(handle, handle.positions(self._shape[0], self._dtype))

    def close(self) -> None:
        """Frees the solver's memory and threads. Closing twice is allowed."""
        self._finalizer()

    def __enter__(self) -> Solver:
        return self

    def __exit__(self, *_: object) -> None:
        self.close()
