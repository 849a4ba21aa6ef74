"""What the library answers with. Made of the library's tables by src/declarations when the package is built."""

# ruff: noqa: E501
from __future__ import annotations

from ._named import Named, Numbered


class Status(Numbered):
    """Whether a call did what it was asked. How a solve ended is another matter, see `Outcome`. After any status but OK no output was written, except for the error."""

    #: Done.
    OK = (
        0,
        "done",
        "",
    )
    #: A pointer is NULL that may not be.
    NULL_POINTER = (
        1,
        "a pointer is NULL that may not be",
        "",
    )
    #: A pointer or a stride does not have the alignment of what it points to.
    MISALIGNED = (
        2,
        "a pointer or a stride does not have the alignment of what it points to",
        "",
    )
    #: Struct_size is not one that this library knows.
    BAD_STRUCT_SIZE = (
        3,
        "struct_size is not one that this library knows",
        "set it to the size of the struct, or use a library as new as the header",
    )
    #: An option is out of its range.
    BAD_OPTION = (
        4,
        "an option is out of its range",
        "",
    )
    #: A number is not one of the enumeration that is meant.
    BAD_ENUM = (
        5,
        "a number is not one of the enumeration that is meant",
        "",
    )
    #: A stride is smaller than what it steps over.
    BAD_STRIDE = (
        6,
        "a stride is smaller than what it steps over",
        "",
    )
    #: A count times its stride exceeds the address space.
    COUNT_OVERFLOW = (
        7,
        "a count times its stride exceeds the address space",
        "",
    )
    #: Two counts differ that have to be the same.
    COUNT_MISMATCH = (
        8,
        "two counts differ that have to be the same",
        "",
    )
    #: An output overlaps an input or another output.
    ALIASING = (
        9,
        "an output overlaps an input or another output",
        "only positions may be written over those that were read, with the same address, stride and scalar",
    )
    #: Not a living handle of the kind that is meant: never made, or freed before.
    BAD_HANDLE = (
        10,
        "not a living handle of the kind that is meant: never made, or freed before",
        "",
    )
    #: The handle is in use: by another thread, or by the call whose callback this call comes from.
    BUSY = (
        11,
        "the handle is in use: by another thread, or by the call whose callback this call comes from",
        "wait until that call has returned",
    )
    #: Memory ran out; everything that the call had allocated is free again, and a solver stays usable.
    OUT_OF_MEMORY = (
        12,
        "memory ran out; everything that the call had allocated is free again, and a solver stays usable",
        "select a smaller region, or close other programs",
    )
    #: The system gave no more threads.
    THREADS = (
        13,
        "the system gave no more threads",
        "ask for fewer, or close other programs",
    )
    #: More vertices or triangles than 32-bit indices can name.
    TOO_LARGE = (
        14,
        "more vertices or triangles than 32-bit indices can name",
        "",
    )
    #: A coordinate that is needed is NaN or infinite, or does not fit a float on its way out.
    NOT_FINITE = (
        15,
        "a coordinate that is needed is NaN or infinite, or does not fit a float on its way out",
        "repair the vertex, or choose a region away from it",
    )
    #: A triangle names a vertex that does not exist.
    INDEX_OUT_OF_RANGE = (
        16,
        "a triangle names a vertex that does not exist",
        "repair the mesh",
    )
    #: A triangle names a vertex twice.
    REPEATED_INDEX = (
        17,
        "a triangle names a vertex twice",
        "remove the degenerate triangles first",
    )
    #: Two triangles have the same vertices.
    DUPLICATE_TRIANGLE = (
        18,
        "two triangles have the same vertices",
        "remove the duplicate triangles first",
    )
    #: More than two triangles share an edge.
    NON_MANIFOLD_EDGE = (
        19,
        "more than two triangles share an edge",
        "repair the mesh there, or choose a region away from it",
    )
    #: The triangles around a vertex are not one fan.
    NON_MANIFOLD_VERTEX = (
        20,
        "the triangles around a vertex are not one fan",
        "repair the mesh there, or choose a region away from it",
    )
    #: Two triangles run through an edge in the same direction.
    INCONSISTENT_ORIENTATION = (
        21,
        "two triangles run through an edge in the same direction",
        "orient all triangles coherently first",
    )
    #: A free vertex is on the boundary of the mesh.
    FREE_VERTEX_ON_BOUNDARY = (
        22,
        "a free vertex is on the boundary of the mesh",
        "leave it out of the selection",
    )
    #: A free vertex has no triangle.
    FREE_VERTEX_WITHOUT_TRIANGLE = (
        23,
        "a free vertex has no triangle",
        "leave it out of the selection",
    )
    #: A component of the region has no fixed vertex.
    NOTHING_FIXED = (
        24,
        "a component of the region has no fixed vertex",
        "leave some of its vertices out of the selection",
    )
    #: No vertex is free.
    EMPTY_REGION = (
        25,
        "no vertex is free",
        "select more faces: a vertex is free if all faces around it are selected",
    )
    #: The selection names what does not exist.
    SELECTION_OUT_OF_RANGE = (
        26,
        "the selection names what does not exist",
        "",
    )
    #: A normal is not a finite vector of length one (to 0.001), or contradicts that of a coincident vertex.
    BAD_NORMAL = (
        27,
        "a normal is not a finite vector of length one (to 0.001), or contradicts that of a coincident vertex",
        "",
    )
    #: No normal can be found for a boundary vertex.
    NO_NORMAL = (
        28,
        "no normal can be found for a boundary vertex",
        "give one",
    )
    #: The result has nothing of this kind, or nothing with this index.
    NOT_AVAILABLE = (
        29,
        "the result has nothing of this kind, or nothing with this index",
        "",
    )
    #: The buffer is too small; the size needed has been told.
    BUFFER_TOO_SMALL = (
        30,
        "the buffer is too small; the size needed has been told",
        "",
    )
    #: A number is not what this version asks for: reserved fields have to be zero.
    BAD_RESERVED = (
        31,
        "a number is not what this version asks for: reserved fields have to be zero",
        "",
    )
    #: A coordinate is so large that lengths exceed the range of doubles.
    COORDINATE_TOO_LARGE = (
        32,
        "a coordinate is so large that lengths exceed the range of doubles",
        "scale the mesh down",
    )
    #: A vertex has more than 1,000 triangles in the region.
    VALENCE_TOO_LARGE = (
        33,
        "a vertex has more than 1,000 triangles in the region",
        "split some of its edges, or leave its neighbours out of the selection",
    )
    #: A vertex is on no boundary loop of the region.
    NOT_ON_LOOP = (
        34,
        "a vertex is on no boundary loop of the region",
        "name a fixed vertex beside a free one",
    )
    #: A guide does not join two vertices of the boundary that one patch can have an edge between.
    BAD_GUIDE = (
        35,
        "a guide does not join two vertices of the boundary that one patch can have an edge between",
        "name two vertices of one loop that are no neighbours, or of two loops that are joined, each in one guide",
    )
    #: Two guides cross each other.
    GUIDES_CROSS = (
        36,
        "two guides cross each other",
        "leave one of them out",
    )
    #: A chain is no run of edges of one boundary loop.
    BAD_CHAIN = (
        37,
        "a chain is no run of edges of one boundary loop",
        "name the vertices of a run of boundary edges, one after the other",
    )
    #: Deleted and filled, a region gets no fair patch that intersects nothing, or it cannot be deleted, or the run was stopped.
    NO_FAIR_PATCH = (
        38,
        "deleted and filled, a region gets no fair patch that intersects nothing, or it cannot be deleted, or the run was stopped",
        "remesh the region, or fair it as it is; or erase it, and fill the holes with what there is",
    )
    #: The curvature does not tell where a bump ends.
    NO_BUMP = (
        39,
        "the curvature does not tell where a bump ends",
        "say the region by its radius or by a list",
    )
    #: An edit of a session has a number that is not finite, or moves a free vertex.
    BAD_EDIT = (
        40,
        "an edit of a session has a number that is not finite, or moves a free vertex",
        "name fixed vertices",
    )
    #: A bug of fairmesh, caught; the handle, if there was one, answers so from now on.
    INTERNAL = (
        99,
        "a bug of fairmesh, caught; the handle, if there was one, answers so from now on",
        "free the handle, and report the bug",
    )


class Outcome(Named):
    """How a run ended that did what it was asked. The positions are usable in every case."""

    #: Tolerance met, and the surface is sound.
    CONVERGED = (
        0,
        "converged",
        "tolerance met, and the surface is sound",
        "",
    )
    #: Tolerance met, but triangles are flipped or have an angle below one degree.
    CONVERGED_POOR_TRIANGLES = (
        1,
        "converged_poor_triangles",
        "tolerance met, but triangles are flipped or have an angle below one degree",
        "look at these triangles; remeshing the region, or uniform inner fairness, usually cures them",
    )
    #: Tolerance met, and no triangle is poor, but the surface has a reservation, which the reason names.
    CONVERGED_LOOSELY = (
        2,
        "converged_loosely",
        "tolerance met, and no triangle is poor, but the surface has a reservation, which the reason names",
        "see the remedy of the reason",
    )
    #: A surface was found for a part of the target only; that of the linear problem is returned.
    TARGET_NOT_REACHABLE = (
        4,
        "target_not_reachable",
        "a surface was found for a part of the target only; that of the linear problem is returned",
        "ask for a smaller constant, or select a smaller region",
    )
    #: No sound surface was found; that of the linear problem is returned.
    NOT_CONVERGED = (
        5,
        "not_converged",
        "no sound surface was found; that of the linear problem is returned",
        "select more, check the boundary normals (flipped? noise?) or average them, or remesh the region",
    )
    #: The iterations ran out; the best surface so far is returned.
    ITERATION_LIMIT = (
        6,
        "iteration_limit",
        "the iterations ran out; the best surface so far is returned",
        "allow more iterations, or fair the result once more",
    )
    #: The progress callback stopped the run; the best surface so far is returned, before there is one the input.
    CANCELLED = (
        7,
        "cancelled",
        "the progress callback stopped the run; the best surface so far is returned, before there is one the input",
        "run it again, to its end",
    )
    #: Tolerance met, but the surface has a crease along the boundary, at the vertices that the report names.
    BOUNDARY_CREASE = (
        8,
        "boundary_crease",
        "tolerance met, but the surface has a crease along the boundary, at the vertices that the report names",
        "move the boundary away from sharp features or noise: select more or less there; or refine the mesh there",
    )
    #: Tolerance met, and no triangle is poor, but triangles of the surface intersect each other or the rest of the mesh.
    SELF_INTERSECTING = (
        9,
        "self_intersecting",
        "tolerance met, and no triangle is poor, but triangles of the surface intersect each other or the rest of the mesh",
        "look at these triangles; select more, prescribe other normals, or fill the region as a hole",
    )
    #: Tolerance met, but rounding the positions to the numbers that are written flips triangles or leaves them without angles.
    POOR_WHEN_ROUNDED = (
        10,
        "poor_when_rounded",
        "tolerance met, but rounding the positions to the numbers that are written flips triangles or leaves them without angles",
        "write the mesh in double precision, or move it near to the origin",
    )
    #: No harmonic surface was found; a smooth one with the same normals, between harmonic and minimal energy, is returned.
    NEAREST_MEMBER = (
        11,
        "nearest_member",
        "no harmonic surface was found; a smooth one with the same normals, between harmonic and minimal energy, is returned",
        "look at it: it is fair, but bends by another equation; less extreme normals, or another region, may have a harmonic surface",
    )
    #: A value that this version of the package does not know.
    OTHER = (
        4294967295,
        "other",
        "a value that this version of the package does not know",
        "",
    )

    @property
    def is_success(self) -> bool:
        """Whether the tolerance is met and the surface is sound, without reservation."""
        return self in (Outcome.CONVERGED,)


class LooseReason(Named):
    """What is to be said of a surface that converged loosely."""

    #: There is nothing to say.
    NONE = (
        0,
        "none",
        "there is nothing to say",
        "",
    )
    #: Boundary normals point against the surface beside them: probably flipped.
    SUSPICIOUS_NORMALS = (
        1,
        "suspicious_normals",
        "boundary normals point against the surface beside them: probably flipped",
        "check the suspicious normals that the report names: turn them around, or give none there",
    )
    #: Max |Delta_B H| is as small as the rounding of the positions allows, but above its limit.
    ROUNDING = (
        2,
        "rounding",
        "max |Delta_B H| is as small as the rounding of the positions allows, but above its limit",
        "set a larger limit, or move the mesh near to the origin and give it in double precision",
    )
    #: The surface has a bump: its curvature inside exceeds what the boundary allows, or it leaves single boundary normals.
    BUMP = (
        4,
        "bump",
        "the surface has a bump: its curvature inside exceeds what the boundary allows, or it leaves single boundary normals",
        "look at it; a larger region, or one with a smoother boundary, usually cures it",
    )
    #: The steps have become as small as double precision allows here, but stay above the tolerance.
    TOLERANCE = (
        5,
        "tolerance",
        "the steps have become as small as double precision allows here, but stay above the tolerance",
        "ask for a larger tolerance: the last step in the report is the smallest that can be met here",
    )
    #: No sound surface over this hole has the normals of the mesh: they were drawn towards those of a membrane.
    DRAWN_NORMALS = (
        6,
        "drawn_normals",
        "no sound surface over this hole has the normals of the mesh: they were drawn towards those of a membrane",
        "look at it; clean the boundary of the hole, or remove faces around it, and fill it again",
    )
    #: A value that this version of the package does not know.
    OTHER = (
        4294967295,
        "other",
        "a value that this version of the package does not know",
        "",
    )


class AttemptEnd(Named):
    """How an attempt at a surface ended."""

    #: A sound surface that meets the tolerance of the attempt.
    SOUND = (
        0,
        "sound",
        "a sound surface that meets the tolerance of the attempt",
        "",
    )
    #: A surface that meets the tolerance, but has poor triangles, a bump or a crease.
    UNSOUND = (
        1,
        "unsound",
        "a surface that meets the tolerance, but has poor triangles, a bump or a crease",
        "",
    )
    #: No surface that meets the tolerance.
    NOT_CONVERGED = (
        2,
        "not_converged",
        "no surface that meets the tolerance",
        "",
    )
    #: Stopped by the limit of iterations or by the caller.
    STOPPED = (
        3,
        "stopped",
        "stopped by the limit of iterations or by the caller",
        "",
    )
    #: A value that this version of the package does not know.
    OTHER = (
        4294967295,
        "other",
        "a value that this version of the package does not know",
        "",
    )


class FillOutcome(Named):
    """How the filling of a loop ended."""

    #: Filled with a faired surface; its report says with which reservations.
    FAIRED = (
        0,
        "faired",
        "filled with a faired surface; its report says with which reservations",
        "",
    )
    #: Filled with the surface of the linear problem, or the best one when the iterations ran out.
    LINEAR = (
        1,
        "linear",
        "filled with the surface of the linear problem, or the best one when the iterations ran out",
        "see the remedy of the fairing's outcome",
    )
    #: Filled with the triangulation, refined, but not faired; the reason says why.
    FLAT = (
        2,
        "flat",
        "filled with the triangulation, refined, but not faired; the reason says why",
        "see the remedy of the reason",
    )
    #: Left as it was; the reason says why.
    LEFT_OPEN = (
        3,
        "left_open",
        "left as it was; the reason says why",
        "see the remedy of the reason",
    )
    #: Filled, but the patch intersects itself or the mesh, as did all others that were tried.
    SELF_INTERSECTING = (
        4,
        "self_intersecting",
        "filled, but the patch intersects itself or the mesh, as did all others that were tried",
        "look at these triangles; clean the boundary of the hole, or remove faces around it, and fill it again",
    )
    #: A value that this version of the package does not know.
    OTHER = (
        4294967295,
        "other",
        "a value that this version of the package does not know",
        "",
    )


class FillReason(Named):
    """Why a loop was left open (numbers below 32) or a patch is flat."""

    #: There is nothing to say.
    NONE = (
        0,
        "none",
        "there is nothing to say",
        "",
    )
    #: The boundary runs into an edge with more than two triangles, or with inconsistent ones.
    NON_MANIFOLD = (
        1,
        "non_manifold",
        "the boundary runs into an edge with more than two triangles, or with inconsistent ones",
        "repair the mesh there",
    )
    #: It is the outer boundary of an open surface, and was not named.
    OUTER_BOUNDARY = (
        2,
        "outer_boundary",
        "it is the outer boundary of an open surface, and was not named",
        "name the loop to have it filled all the same",
    )
    #: It has more edges than asked for.
    TOO_MANY_EDGES = (
        3,
        "too_many_edges",
        "it has more edges than asked for",
        "allow more edges, or name the loop",
    )
    #: Every triangulation has an edge or a triangle that the mesh has already.
    NO_TRIANGULATION = (
        4,
        "no_triangulation",
        "every triangulation has an edge or a triangle that the mesh has already",
        "remove the triangles that span the hole",
    )
    #: A vertex of the boundary is NaN or infinite, or all of them are the same point.
    NOT_FINITE = (
        5,
        "not_finite",
        "a vertex of the boundary is NaN or infinite, or all of them are the same point",
        "repair or remove these vertices",
    )
    #: The run was stopped before this loop was done.
    CANCELLED = (
        6,
        "cancelled",
        "the run was stopped before this loop was done",
        "run it again, to its end",
    )
    #: Two of the loops to be joined fit only if the triangles at one of them faced the other way.
    OPPOSITE_SIDES = (
        7,
        "opposite_sides",
        "two of the loops to be joined fit only if the triangles at one of them faced the other way",
        "turn the triangles of one of the two parts around, or leave its loop out",
    )
    #: Two of the loops to be joined have a vertex in common.
    SHARED_VERTEX = (
        8,
        "shared_vertex",
        "two of the loops to be joined have a vertex in common",
        "fill them by themselves, or give each a vertex of its own",
    )
    #: It is not one of those that were asked for.
    NOT_ASKED_FOR = (
        9,
        "not_asked_for",
        "it is not one of those that were asked for",
        "name the loop, or ask for more of them",
    )
    #: No fair patch was found, and such loops were to stay open.
    NOT_FAIR = (
        10,
        "not_fair",
        "no fair patch was found, and such loops were to stay open",
        "fill it with a patch that is not fair, or join it to its neighbours, or remove faces around it",
    )
    #: Every patch that was tried intersects itself or the mesh, and such loops were to stay open.
    INTERSECTS = (
        11,
        "intersects",
        "every patch that was tried intersects itself or the mesh, and such loops were to stay open",
        "join the loop to its neighbours, clean its boundary, or remove faces around it",
    )
    #: Fairing was not asked for.
    NOT_ASKED = (
        32,
        "not_asked",
        "fairing was not asked for",
        "",
    )
    #: The patch has no inner vertex: nothing can move.
    NO_INNER_VERTEX = (
        33,
        "no_inner_vertex",
        "the patch has no inner vertex: nothing can move",
        "",
    )
    #: The fairing was refused, because the mesh around the hole is defective.
    REFUSED = (
        34,
        "refused",
        "the fairing was refused, because the mesh around the hole is defective",
        "repair the mesh there",
    )
    #: The fairing found no sound surface; its report says how it ended.
    UNSOUND = (
        35,
        "unsound",
        "the fairing found no sound surface; its report says how it ended",
        "see the remedy of the fairing's outcome",
    )
    #: Faired, the patch would intersect itself or the mesh.
    INTERSECTING = (
        36,
        "intersecting",
        "faired, the patch would intersect itself or the mesh",
        "clean the boundary of the hole, or remove faces around it",
    )
    #: A value that this version of the package does not know.
    OTHER = (
        4294967295,
        "other",
        "a value that this version of the package does not know",
        "",
    )


class LoopKind(Named):
    """What kind of gap a boundary loop is."""

    #: A gap in the surface.
    HOLE = (
        0,
        "hole",
        "a gap in the surface",
        "",
    )
    #: The outer boundary of an open surface: filled only if it is named.
    OUTER_BOUNDARY = (
        1,
        "outer_boundary",
        "the outer boundary of an open surface: filled only if it is named",
        "",
    )
    #: It meets a bad edge, which is told: never filled.
    NON_MANIFOLD = (
        2,
        "non_manifold",
        "it meets a bad edge, which is told: never filled",
        "",
    )
    #: A value that this version of the package does not know.
    OTHER = (
        4294967295,
        "other",
        "a value that this version of the package does not know",
        "",
    )
