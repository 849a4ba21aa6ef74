"""Boundary loops, filling of holes, remeshing of regions."""

from __future__ import annotations

import math
from functools import cached_property
from typing import TYPE_CHECKING, Any, Generic, overload

import numpy as np
from numpy.typing import NDArray

from . import _abi, _arrays
from ._calls import of_mesh
from ._carry import Change
from ._choice import loop_choice
from ._enums import FillOutcome, FillReason, Status
from ._forms import ArrayLike
from ._handles import ResultHandle, result_of
from ._hosts import Arrays, M, MeshLike
from ._keywords import FillKeywords, MeshKeywords
from ._options import set_options
from ._pickling import Picklable
from ._records import Bends, Loop, Moved, Report, bends_of, loop_of, moved_of, roughness_of
from ._reports import sized
from ._runs import Run

if TYPE_CHECKING:
    from typing_extensions import Unpack

_lists = _abi.fairmesh_list


@overload
def boundary_loops(mesh: MeshLike, /, *, roughness: bool = ..., **keywords: Unpack[MeshKeywords]) -> list[Loop]: ...
@overload
def boundary_loops(
    vertices: ArrayLike, faces: ArrayLike, *, roughness: bool = ..., **keywords: Unpack[MeshKeywords]
) -> list[Loop]: ...
@of_mesh()
def boundary_loops(mesh: _arrays.Mesh, *, roughness: bool = False) -> list[Loop]:
    """The boundary loops of a mesh: holes and outer boundaries. Arguments as in `fair`.

    Of a vertex with several copies a loop names the one in the triangle at its edge.

    Only indices and coordinates have to be sound: a flaw of the mesh elsewhere does not matter. With ``roughness`` each
    loop tells how rough the mesh is along it, and what `fill_holes` can do about it; that takes longer.
    """
    handle = result_of("fairmesh_rim_roughness" if roughness else "fairmesh_boundary_loops", mesh.struct)
    return [_loop(handle, index) for index in range(handle.info().loop_count)]


def _loop(handle: ResultHandle, index: int) -> Loop:
    loop = sized(_abi.fairmesh_loop)
    handle.read("fairmesh_result_loop", index, loop)
    return loop_of(
        loop,
        vertices=handle.list(_lists.LOOP_VERTICES, index),
        touching=handle.list(_lists.LOOP_TOUCHING, index),
        edge=(loop.edge_a, loop.edge_b) if loop.kind == _abi.fairmesh_loop_kind.NON_MANIFOLD else None,
        roughness=roughness_of(loop) if loop.has_roughness else None,
    )


class LoopReport(Picklable):
    """What became of a loop that was to be filled, or of several that are joined."""

    def __init__(self, handle: ResultHandle, index: int) -> None:
        struct = sized(_abi.fairmesh_fill_report)
        handle.read("fairmesh_result_fill_report", index, struct)
        self._handle = handle
        self._index = index
        self.outcome: FillOutcome = FillOutcome.of(struct.outcome)
        #: Whether there is nothing to be said of it: a patch that converged without reservation, or was not to be
        #: faired; or a loop that stayed open because it was not asked for.
        self.is_success = bool(struct.is_success)
        #: Why it is flat or open.
        self.reason: FillReason = FillReason.of(struct.reason)
        #: The status that the fairing was refused with, or None.
        self.refused: Status | None = Status.of(struct.refused_status) if struct.refused_status else None
        #: What the reason is about: of OPPOSITE_SIDES two loops, of NON_MANIFOLD and INCONSISTENT the ends of an edge,
        #: of SHARED_VERTEX, HANGING and NOT_FINITE a vertex; otherwise empty.
        self.reason_elements: tuple[int, ...] = tuple(
            element for element in (struct.reason_element, struct.reason_other) if element != _abi.NO_ELEMENT
        )
        #: The loop, as `boundary_loops` numbers it; of several the first.
        self.loop_index: int = struct.loop_index
        #: Why loops were joined, if that was left to ``join="auto"``.
        self.joined: Bends | None = None if math.isnan(struct.joint_bend) else bends_of(struct)
        #: 1.0 where the boundary normals are those asked for. Less where no sound patch has them: so much of the way
        #: from the normals of a membrane to the averages of the mesh's.
        self.normals_reached: float = struct.normals_reached
        #: What became of the vertices around the loop, if ``relax_rim`` let them move.
        self.moved: Moved | None = moved_of(struct) if struct.has_relaxed else None
        #: The number of edges, of all loops together.
        self.edge_count: int = struct.edge_count
        #: Its new vertices and triangles, in the arrays of the filled mesh.
        self.vertices = slice(struct.first_vertex, struct.first_vertex + struct.vertex_count)
        self.faces = slice(struct.first_triangle, struct.first_triangle + struct.triangle_count)
        #: The smallest angle of the new triangles, in degrees.
        self.worst_angle: float = struct.worst_angle
        #: ``max_new_vertices`` made the patch coarser.
        self.coarsened = bool(struct.coarsened)
        #: The report of the fairing, if there was one.
        self.report: Report | None = handle.report(index) if struct.has_report else None
        #: Wall seconds.
        self.seconds: float = struct.seconds

    @cached_property
    def loop_indices(self) -> NDArray[np.intp]:
        """All the loops that the patch is for, ascending: more than one if they are joined."""
        return self._handle.list(_lists.JOINED_LOOPS, self._index)

    @cached_property
    def outside_vertices(self) -> NDArray[np.intp]:
        """New vertices that lie far outside the loop's bounding box."""
        return self._handle.list(_lists.OUTSIDE_VERTICES, self._index)

    @cached_property
    def intersections(self) -> NDArray[np.intp]:
        """Pairs of triangles that intersect, (p, 2), the smaller index first; at least one of each is of this patch."""
        return self._handle.list(_lists.INTERSECTIONS, self._index).reshape(-1, 2)

    def __repr__(self) -> str:
        why = "" if self.reason is FillReason.NONE else f" ({self.reason})"
        loops = self.loop_indices
        which = f"loop {self.loop_index}" if len(loops) == 1 else f"loops {', '.join(map(str, loops))}"
        return f"<fairmesh.LoopReport: {which}, {self.edge_count} edges, {self.outcome}{why}>"


class NewMesh(Picklable, Generic[M]):
    """A mesh with new vertices at the end of its arrays."""

    def __init__(self, handle: ResultHandle, mesh: _arrays.Mesh) -> None:
        self._handle = handle
        self._given = mesh
        info = handle.info()
        #: All vertices, in the type given.
        self.vertices: NDArray[Any] = handle.positions(info.vertex_count, mesh.vertices.dtype)
        #: All triangles, in the type given.
        self.faces: NDArray[Any] = handle.triangles(info.triangle_count, mesh.index_type)
        #: The new ones among the vertices and faces.
        self.new_vertices = slice(info.vertex_count - info.new_vertex_count, info.vertex_count)
        self.new_faces = slice(info.triangle_count - info.new_triangle_count, info.triangle_count)

    @cached_property
    def mesh(self) -> M:
        """The new mesh, of the kind given, with what can be carried over: of new vertices colours, texture coordinates
        and other real numbers are interpolated, whole numbers and what belongs to new faces is that of the nearest
        ones, normals are made anew. Of two arrays, a pair of arrays.

        Made when first asked for, of the mesh as it is then: ask before you change it.
        """
        given = self._given
        kept_vertices, kept_faces = self._kept()
        change = Change(
            self.vertices,
            self.faces,
            given.faces.astype(np.intp),
            kept_vertices,
            kept_faces,
            self.parents,
            self.parent_weights,
        )
        made: M = given.host.same(lambda: given.host.rebuilt(change))
        return made

    def _kept(self) -> tuple[NDArray[np.intp], NDArray[np.intp]]:
        """The numbers before of the vertices and faces that come before the new ones."""
        return np.arange(self.new_vertices.start), np.arange(self.new_faces.start)

    @property
    def new_vertex_count(self) -> int:
        """The last so many of the vertices are new."""
        return int(self.new_vertices.stop - self.new_vertices.start)

    @property
    def new_face_count(self) -> int:
        """The last so many of the faces are new."""
        return int(self.new_faces.stop - self.new_faces.start)

    @cached_property
    def parents(self) -> NDArray[np.intp]:
        """Per new vertex the three vertices of the mesh given that it comes from, (k, 3)."""
        return self._handle.list(_lists.PARENTS).reshape(-1, 3)

    @cached_property
    def parent_weights(self) -> NDArray[np.float64]:
        """Their weights, (k, 3); the sum of each row is 1."""
        return self._handle.vectors(_abi.fairmesh_vectors.PARENT_WEIGHTS, self.new_vertex_count)


class PartlyNewMesh(NewMesh[M]):
    """A mesh of which a part was left out: first what is left of it, with other numbers, then what is new."""

    @cached_property
    def kept_vertices(self) -> NDArray[np.intp]:
        """Per vertex that is left its number before."""
        return self._handle.list(_lists.KEPT_VERTICES)

    @cached_property
    def kept_faces(self) -> NDArray[np.intp]:
        """Per face that is left, or a part of one, the number before of that."""
        return self._handle.list(_lists.KEPT_TRIANGLES)

    def _kept(self) -> tuple[NDArray[np.intp], NDArray[np.intp]]:
        return self.kept_vertices, self.kept_faces


class Filled(NewMesh[M]):
    """A mesh with filled holes. Vertices and faces given keep their numbers and bits; new ones follow.

    Vertices that ``relax_rim`` let move have other bits.
    """

    @cached_property
    def loops(self) -> list[LoopReport]:
        """What became of each loop."""
        return [LoopReport(self._handle, index) for index in range(self._handle.info().loop_count)]

    @cached_property
    def is_success(self) -> bool:
        """Whether there is nothing to be said of the result: all loops are successes, and not all of them were passed
        over as outer boundaries. Where it is not, the command line ends with exit code 3.
        """
        return bool(self._handle.info().is_success)

    @property
    def outcomes(self) -> list[FillOutcome]:
        """How the filling of each loop ended."""
        return [loop.outcome for loop in self.loops]

    def __repr__(self) -> str:
        return f"<fairmesh.Filled: {len(self.loops)} loops, {self.new_vertex_count} new vertices>"


@overload
def fill_holes(mesh: M, /, **keywords: Unpack[FillKeywords]) -> Filled[M]: ...
@overload
def fill_holes(vertices: ArrayLike, faces: ArrayLike, **keywords: Unpack[FillKeywords]) -> Filled[Arrays]: ...
@of_mesh(FillKeywords)
def fill_holes(mesh: _arrays.Mesh, **keywords: Unpack[FillKeywords]) -> Filled[Any]:
    """Fills holes: triangulates, refines and fairs each, or several together.

    Vertices and faces given keep their numbers and bits (but for ``relax_rim``); new ones follow. A loop that cannot
    be filled says so in its `LoopReport` and does not affect the others. Outer boundaries of open
    surfaces are filled only if they are named.

    Args:
        mesh, coincident: As in `fair`. New faces name of each vertex the copy in the face beside them.
        loops: These loops only, as `boundary_loops` numbers them, outer boundaries included; bounds are not read then.
            "all": all holes. Default: all holes; with groups in ``join``, none but these.
        join: Which loops get one patch together: "none" (default); groups of them, ``[[0, 1], [2, 5]]``; or "auto",
            those whose joint patch bends less than patches of their own would, see `suggest_joins`.
        max_edges, max_length, max_area, max_diagonal: Holes of more stay open: of more edges, longer, of a larger
            `Loop.area`, with a longer diagonal of the bounding box. Default: no bound.
        except_longest: So many holes, the longest, stay open. Default 0.
        of_components: Only holes of these components of the mesh, as `components` numbers them. Default: of all.
        within: Only holes whose vertices all lie in a ball ``(centre, radius)`` or a box ``(low, high)``, two corners.
            Default: everywhere.
        **options: Those of `fair`, of patches and of rims: `FillingOptions`.
        progress, cancel: As in `fair`.

    Returns:
        `Filled`: the mesh in the types given, and what became of each loop.

    Raises:
        InputError and the others of `fair`.

    """
    filling = loop_choice(keywords, keywords.get("join"))
    set_options(filling, keywords)
    run = Run(mesh, keywords)
    return Filled(run.result("fairmesh_fill_holes", filling, run.options), mesh)
