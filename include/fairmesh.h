/* fairmesh - intrinsic fairing of triangle meshes: Delta_B H = 0 with G1 boundary conditions.
 * R. Schneider, L. Kobbelt, "Geometric fairing of irregular meshes for free-form surface design", CAGD 18, 2001.
 *
 * What most programs need:
 *
 *     // A mesh: two arrays of yours, three coordinates for each vertex and three indices for each triangle.
 *     fairmesh_mesh mesh = {.struct_size = sizeof mesh,
 *                           .positions = {xyz, vertex_count, 0, FAIRMESH_SCALAR_FLOAT64, 0},
 *                           .triangles = {corners, triangle_count, 0}};
 *     fairmesh_error error;                                       // names the vertex, the triangle or the field
 *
 *     // Fair: vertices whose byte is not 0 move, here in place; all others stay, to the last bit.
 *     fairmesh_selection selection = {sizeof selection, FAIRMESH_SELECTION_KIND_FREE_MASK, is_free, vertex_count, 0};
 *     fairmesh_points_out out = {xyz, vertex_count, 0, FAIRMESH_SCALAR_FLOAT64, 0};
 *     fairmesh_report report = {.struct_size = sizeof report};
 *     if (fairmesh_fair(&mesh, &selection, NULL, &out, &report, NULL, &error) != FAIRMESH_STATUS_OK) puts(error.message);
 *     puts(fairmesh_describe(FAIRMESH_ANSWER_OUTCOME, report.outcome, FAIRMESH_TEXT_MEANING));
 *
 *     // Fill all holes: what is made is kept in a result, to be asked for its sizes, read, and freed.
 *     fairmesh_result *result = NULL;
 *     fairmesh_info info = {.struct_size = sizeof info};
 *     if (fairmesh_fill_holes(&mesh, NULL, NULL, &result, &error) != FAIRMESH_STATUS_OK) puts(error.message);
 *     fairmesh_result_info(result, &info, &error);                // is_success, vertex_count, triangle_count
 *     fairmesh_points_out points = {malloc(24 * info.vertex_count), info.vertex_count, 0, FAIRMESH_SCALAR_FLOAT64, 0};
 *     fairmesh_indices_out triangles = {malloc(12 * info.triangle_count), info.triangle_count, 0};
 *     fairmesh_result_positions(result, &points, &error);         // those given come first, with their numbers
 *     fairmesh_result_triangles(result, &triangles, &error);
 *     fairmesh_result_free(result);
 *
 * Options are filled in by fairmesh_options_init and fairmesh_fill_options_init; then change fields. The rest, by what it is for:
 *   in steps, and live    fairmesh_solver_...
 *   holes                 fairmesh_boundary_loops, _rim_roughness, _suggest_joins, _bridge
 *   sharp edges           fairmesh_round
 *   regions               fairmesh_select_region, _refill, _remesh, _erase, _trim_boundary, _components, _carry_over
 *   measures              fairmesh_mean_curvature, _self_intersections, _memory_needed
 *   what a result has     fairmesh_result_...
 *
 * Arrays are the caller's: read or written during the call, never kept, never freed. Inputs are never written. Outputs
 * are written last, and only if the status is FAIRMESH_STATUS_OK; the fairmesh_error is written by every call.
 * A pointer is an error when NULL, unless its description says that it may be.
 * Any function may be called from any thread at any time. One solver is used by one call at a time, others are answered
 * FAIRMESH_STATUS_BUSY; a result may be read by any number of threads.
 * No function lets a panic or an exception escape; callbacks must not throw.
 * Structs begin with their size, so that programs and libraries of different versions understand each other.
 *
 * Made by cbindgen of src/capi: do not edit. */

#ifndef FAIRMESH_H
#define FAIRMESH_H

#include <stddef.h>
#include <stdint.h>

/* Static builds need nothing; Windows programs that use the DLL define FAIRMESH_DLL. */
#if defined(_WIN32) && defined(FAIRMESH_DLL)
#define FAIRMESH_API __declspec(dllimport)
#else
#define FAIRMESH_API
#endif


/**
 * In place of an index: there is none.
 */
#define FAIRMESH_NO_ELEMENT UINT64_MAX

/**
 * The value of the option `sharp` at which only edges that are certain go on, in degrees.
 */
#define FAIRMESH_SHARP_AUTO 20.0

/**
 * The value of the option `continuity` at which curvature is continued where it is certain.
 */
#define FAIRMESH_CONTINUITY_AUTO -1.0

/**
 * The value of the option `relax_rim` at which as many rings may move as are advised.
 */
#define FAIRMESH_RELAX_AUTO 4294967295

/**
 * Major version of the interface: it changes when something does that programs rely on.
 */
#define FAIRMESH_VERSION_MAJOR 0

/**
 * Minor version: it grows when something is added; while the major version is 0, also when something changes.
 */
#define FAIRMESH_VERSION_MINOR 1

/**
 * Patch version.
 */
#define FAIRMESH_VERSION_PATCH 0

/**
 * Whether a call did what it was asked. How a solve ended is another matter, see `fairmesh_outcome`. After any status but OK no output was written, except for the `fairmesh_error`. Numbers are never reused.
 */
enum fairmesh_status
#if defined(__cplusplus) || __STDC_VERSION__ >= 202311L
  : int32_t
#endif // defined(__cplusplus) || __STDC_VERSION__ >= 202311L
 {
    /**
     * Done.
     */
    FAIRMESH_STATUS_OK = 0,
    /**
     * A pointer is NULL that may not be.
     */
    FAIRMESH_STATUS_NULL_POINTER = 1,
    /**
     * A pointer or a stride does not have the alignment of what it points to.
     */
    FAIRMESH_STATUS_MISALIGNED = 2,
    /**
     * Struct_size is not one that this library knows.
     */
    FAIRMESH_STATUS_BAD_STRUCT_SIZE = 3,
    /**
     * An option is out of its range.
     */
    FAIRMESH_STATUS_BAD_OPTION = 4,
    /**
     * A number is not one of the enumeration that is meant.
     */
    FAIRMESH_STATUS_BAD_ENUM = 5,
    /**
     * A stride is smaller than what it steps over.
     */
    FAIRMESH_STATUS_BAD_STRIDE = 6,
    /**
     * A count times its stride exceeds the address space.
     */
    FAIRMESH_STATUS_COUNT_OVERFLOW = 7,
    /**
     * Two counts differ that have to be the same.
     */
    FAIRMESH_STATUS_COUNT_MISMATCH = 8,
    /**
     * An output overlaps an input or another output.
     */
    FAIRMESH_STATUS_ALIASING = 9,
    /**
     * Not a living handle of the kind that is meant: never made, or freed before.
     */
    FAIRMESH_STATUS_BAD_HANDLE = 10,
    /**
     * The handle is in use: by another thread, or by the call whose callback this call comes from.
     */
    FAIRMESH_STATUS_BUSY = 11,
    /**
     * Memory ran out; everything that the call had allocated is free again, and a solver stays usable.
     */
    FAIRMESH_STATUS_OUT_OF_MEMORY = 12,
    /**
     * The system gave no more threads.
     */
    FAIRMESH_STATUS_THREADS = 13,
    /**
     * More vertices or triangles than 32-bit indices can name.
     */
    FAIRMESH_STATUS_TOO_LARGE = 14,
    /**
     * A coordinate that is needed is NaN or infinite, or does not fit a float on its way out.
     */
    FAIRMESH_STATUS_NOT_FINITE = 15,
    /**
     * A triangle names a vertex that does not exist.
     */
    FAIRMESH_STATUS_INDEX_OUT_OF_RANGE = 16,
    /**
     * A triangle names a vertex twice.
     */
    FAIRMESH_STATUS_REPEATED_INDEX = 17,
    /**
     * Two triangles have the same vertices.
     */
    FAIRMESH_STATUS_DUPLICATE_TRIANGLE = 18,
    /**
     * More than two triangles share an edge.
     */
    FAIRMESH_STATUS_NON_MANIFOLD_EDGE = 19,
    /**
     * The triangles around a vertex are not one fan.
     */
    FAIRMESH_STATUS_NON_MANIFOLD_VERTEX = 20,
    /**
     * Two triangles run through an edge in the same direction.
     */
    FAIRMESH_STATUS_INCONSISTENT_ORIENTATION = 21,
    /**
     * A free vertex is on the boundary of the mesh.
     */
    FAIRMESH_STATUS_FREE_VERTEX_ON_BOUNDARY = 22,
    /**
     * A free vertex has no triangle.
     */
    FAIRMESH_STATUS_FREE_VERTEX_WITHOUT_TRIANGLE = 23,
    /**
     * A component of the region has no fixed vertex.
     */
    FAIRMESH_STATUS_NOTHING_FIXED = 24,
    /**
     * No vertex is free.
     */
    FAIRMESH_STATUS_EMPTY_REGION = 25,
    /**
     * The selection names what does not exist.
     */
    FAIRMESH_STATUS_SELECTION_OUT_OF_RANGE = 26,
    /**
     * A normal is not a finite vector of length one (to 0.001), or contradicts that of a coincident vertex.
     */
    FAIRMESH_STATUS_BAD_NORMAL = 27,
    /**
     * No normal can be found for a boundary vertex.
     */
    FAIRMESH_STATUS_NO_NORMAL = 28,
    /**
     * The result has nothing of this kind, or nothing with this index.
     */
    FAIRMESH_STATUS_NOT_AVAILABLE = 29,
    /**
     * The buffer is too small; the size needed has been told.
     */
    FAIRMESH_STATUS_BUFFER_TOO_SMALL = 30,
    /**
     * A number is not what this version asks for: reserved fields have to be zero.
     */
    FAIRMESH_STATUS_BAD_RESERVED = 31,
    /**
     * A coordinate is so large that lengths exceed the range of doubles.
     */
    FAIRMESH_STATUS_COORDINATE_TOO_LARGE = 32,
    /**
     * A vertex has more than 1,000 triangles in the region.
     */
    FAIRMESH_STATUS_VALENCE_TOO_LARGE = 33,
    /**
     * A vertex is on no boundary loop of the region.
     */
    FAIRMESH_STATUS_NOT_ON_LOOP = 34,
    /**
     * A guide does not join two vertices of the boundary that one patch can have an edge between.
     */
    FAIRMESH_STATUS_BAD_GUIDE = 35,
    /**
     * Two guides cross each other.
     */
    FAIRMESH_STATUS_GUIDES_CROSS = 36,
    /**
     * A chain is no run of edges of one boundary loop.
     */
    FAIRMESH_STATUS_BAD_CHAIN = 37,
    /**
     * Deleted and filled, a region gets no fair patch that intersects nothing, or it cannot be deleted, or the run was stopped.
     */
    FAIRMESH_STATUS_NO_FAIR_PATCH = 38,
    /**
     * Nothing tells where a bump ends.
     */
    FAIRMESH_STATUS_NO_BUMP = 39,
    /**
     * An edit of a solver has a number that is not finite, or moves a free vertex.
     */
    FAIRMESH_STATUS_BAD_EDIT = 40,
    /**
     * A component has one side only, as a Moebius strip.
     */
    FAIRMESH_STATUS_NOT_ORIENTABLE = 41,
    /**
     * The callback has stopped the call, which has no result then.
     */
    FAIRMESH_STATUS_CANCELLED = 42,
    /**
     * Two vertices are named as an edge between two triangles, and are none.
     */
    FAIRMESH_STATUS_NOT_AN_EDGE = 43,
    /**
     * No edge bends enough to be rounded.
     */
    FAIRMESH_STATUS_NO_CREASE = 44,
    /**
     * A bug of fairmesh, caught; the handle, if there was one, answers so from now on.
     */
    FAIRMESH_STATUS_INTERNAL = 99,
};
#ifndef __cplusplus
#if __STDC_VERSION__ >= 202311L
typedef enum fairmesh_status fairmesh_status;
#else
typedef int32_t fairmesh_status;
#endif // __STDC_VERSION__ >= 202311L
#endif // __cplusplus

/**
 * The kind of numbers in an array.
 */
enum fairmesh_scalar
#if defined(__cplusplus) || __STDC_VERSION__ >= 202311L
  : uint32_t
#endif // defined(__cplusplus) || __STDC_VERSION__ >= 202311L
 {
    /**
     * `float`.
     */
    FAIRMESH_SCALAR_FLOAT32 = 1,
    /**
     * `double`.
     */
    FAIRMESH_SCALAR_FLOAT64 = 2,
};
#ifndef __cplusplus
#if __STDC_VERSION__ >= 202311L
typedef enum fairmesh_scalar fairmesh_scalar;
#else
typedef uint32_t fairmesh_scalar;
#endif // __STDC_VERSION__ >= 202311L
#endif // __cplusplus

/**
 * What `fairmesh_selection` holds.
 */
enum fairmesh_selection_kind
#if defined(__cplusplus) || __STDC_VERSION__ >= 202311L
  : uint32_t
#endif // defined(__cplusplus) || __STDC_VERSION__ >= 202311L
 {
    /**
     * Nothing: free are all vertices that are not on the boundary of the mesh. `data` is NULL, `count` and `stride` 0.
     */
    FAIRMESH_SELECTION_KIND_INTERIOR = 0,
    /**
     * `uint8_t`, one per vertex: not zero is free.
     */
    FAIRMESH_SELECTION_KIND_FREE_MASK = 1,
    /**
     * `uint8_t`, one per vertex: not zero is fixed.
     */
    FAIRMESH_SELECTION_KIND_FIXED_MASK = 2,
    /**
     * `uint32_t`: the free vertices, in any order.
     */
    FAIRMESH_SELECTION_KIND_FREE_VERTICES = 3,
    /**
     * `uint32_t`: triangles. Free are the vertices that have no other triangles and are not on the boundary of the mesh.
     */
    FAIRMESH_SELECTION_KIND_FACES = 4,
};
#ifndef __cplusplus
#if __STDC_VERSION__ >= 202311L
typedef enum fairmesh_selection_kind fairmesh_selection_kind;
#else
typedef uint32_t fairmesh_selection_kind;
#endif // __STDC_VERSION__ >= 202311L
#endif // __cplusplus

/**
 * Where the normals at the boundary of the region come from. Numbers are never reused.
 */
enum fairmesh_boundary_normals_kind
#if defined(__cplusplus) || __STDC_VERSION__ >= 202311L
  : uint32_t
#endif // defined(__cplusplus) || __STDC_VERSION__ >= 202311L
 {
    /**
     * Fitted to the surface outside the region, to second or third order; where there is no outside, averaged.
     */
    FAIRMESH_BOUNDARY_NORMALS_KIND_FITTED = 0,
    /**
     * The average of the triangles outside the region.
     */
    FAIRMESH_BOUNDARY_NORMALS_KIND_AVERAGED = 1,
    /**
     * Given, for some or all boundary vertices; fitted for the others.
     */
    FAIRMESH_BOUNDARY_NORMALS_KIND_GIVEN = 2,
};
#ifndef __cplusplus
#if __STDC_VERSION__ >= 202311L
typedef enum fairmesh_boundary_normals_kind fairmesh_boundary_normals_kind;
#else
typedef uint32_t fairmesh_boundary_normals_kind;
#endif // __STDC_VERSION__ >= 202311L
#endif // __cplusplus

/**
 * Where the mean curvature comes from that the surface is to continue.
 */
enum fairmesh_boundary_curvature_kind
#if defined(__cplusplus) || __STDC_VERSION__ >= 202311L
  : uint32_t
#endif // defined(__cplusplus) || __STDC_VERSION__ >= 202311L
 {
    /**
     * Fitted to the surface outside the region.
     */
    FAIRMESH_BOUNDARY_CURVATURE_KIND_ESTIMATED = 0,
    /**
     * Given, for some or all boundary vertices; fitted for the others.
     */
    FAIRMESH_BOUNDARY_CURVATURE_KIND_GIVEN = 1,
};
#ifndef __cplusplus
#if __STDC_VERSION__ >= 202311L
typedef enum fairmesh_boundary_curvature_kind fairmesh_boundary_curvature_kind;
#else
typedef uint32_t fairmesh_boundary_curvature_kind;
#endif // __STDC_VERSION__ >= 202311L
#endif // __cplusplus

/**
 * Normals of fixed vertices inside the region that have none given. Numbers are never reused.
 */
enum fairmesh_interior_normals
#if defined(__cplusplus) || __STDC_VERSION__ >= 202311L
  : uint32_t
#endif // defined(__cplusplus) || __STDC_VERSION__ >= 202311L
 {
    /**
     * Those of the surface itself, found with it: it passes the vertices smoothly; only their positions are prescribed.
     */
    FAIRMESH_INTERIOR_NORMALS_SMOOTH = 0,
    /**
     * The average of their triangles in the input, or of the surroundings where they are near (paper 7.5).
     */
    FAIRMESH_INTERIOR_NORMALS_INPUT = 1,
};
#ifndef __cplusplus
#if __STDC_VERSION__ >= 202311L
typedef enum fairmesh_interior_normals fairmesh_interior_normals;
#else
typedef uint32_t fairmesh_interior_normals;
#endif // __STDC_VERSION__ >= 202311L
#endif // __cplusplus

/**
 * Whether vertices at the same place are one vertex of the surface. Numbers are never reused.
 */
enum fairmesh_coincident
#if defined(__cplusplus) || __STDC_VERSION__ >= 202311L
  : uint32_t
#endif // defined(__cplusplus) || __STDC_VERSION__ >= 202311L
 {
    /**
     * Boundary edges with coincident ends are one edge of the surface.
     */
    FAIRMESH_COINCIDENT_JOIN = 0,
    /**
     * The mesh is as its triangles say.
     */
    FAIRMESH_COINCIDENT_SEPARATE = 1,
};
#ifndef __cplusplus
#if __STDC_VERSION__ >= 202311L
typedef enum fairmesh_coincident fairmesh_coincident;
#else
typedef uint32_t fairmesh_coincident;
#endif // __STDC_VERSION__ >= 202311L
#endif // __cplusplus

/**
 * What the Laplacian of the mean curvature H has to be. Numbers are never reused.
 */
enum fairmesh_target_kind
#if defined(__cplusplus) || __STDC_VERSION__ >= 202311L
  : uint32_t
#endif // defined(__cplusplus) || __STDC_VERSION__ >= 202311L
 {
    /**
     * Zero: spheres, cylinders and all surfaces of constant mean curvature are kept.
     */
    FAIRMESH_TARGET_KIND_HARMONIC = 0,
    /**
     * The constant, in 1 / length^3: a positive one pushes the surface out along its normals.
     */
    FAIRMESH_TARGET_KIND_CONSTANT = 1,
    /**
     * -2 H (H^2 - K): minimal total curvature.
     */
    FAIRMESH_TARGET_KIND_MINIMAL_ENERGY = 2,
};
#ifndef __cplusplus
#if __STDC_VERSION__ >= 202311L
typedef enum fairmesh_target_kind fairmesh_target_kind;
#else
typedef uint32_t fairmesh_target_kind;
#endif // __STDC_VERSION__ >= 202311L
#endif // __cplusplus

/**
 * How vertices are distributed within the surface. Numbers are never reused.
 */
enum fairmesh_inner_fairness
#if defined(__cplusplus) || __STDC_VERSION__ >= 202311L
  : uint32_t
#endif // defined(__cplusplus) || __STDC_VERSION__ >= 202311L
 {
    /**
     * Equal weights: a regular distribution.
     */
    FAIRMESH_INNER_FAIRNESS_UNIFORM = 0,
    /**
     * Cotangents of the input mesh: least distortion of the input triangles.
     */
    FAIRMESH_INNER_FAIRNESS_CONFORMAL = 1,
    /**
     * Mean-value weights of the input mesh (Floater): near conformal, but positive for any input, and exact on a plane.
     */
    FAIRMESH_INNER_FAIRNESS_CONVEX = 2,
};
#ifndef __cplusplus
#if __STDC_VERSION__ >= 202311L
typedef enum fairmesh_inner_fairness fairmesh_inner_fairness;
#else
typedef uint32_t fairmesh_inner_fairness;
#endif // __STDC_VERSION__ >= 202311L
#endif // __cplusplus

/**
 * How normals and mean curvature are discretized. Numbers are never reused.
 */
enum fairmesh_discretization
#if defined(__cplusplus) || __STDC_VERSION__ >= 202311L
  : uint32_t
#endif // defined(__cplusplus) || __STDC_VERSION__ >= 202311L
 {
    /**
     * Max's normals and the gradient-corrected curvature: second order on irregular meshes.
     */
    FAIRMESH_DISCRETIZATION_SECOND_ORDER = 0,
    /**
     * The paper's: normals from summed cross products, plain Moreton-Sequin curvature.
     */
    FAIRMESH_DISCRETIZATION_PAPER = 1,
};
#ifndef __cplusplus
#if __STDC_VERSION__ >= 202311L
typedef enum fairmesh_discretization fairmesh_discretization;
#else
typedef uint32_t fairmesh_discretization;
#endif // __STDC_VERSION__ >= 202311L
#endif // __cplusplus

/**
 * Whether a surface is checked for triangles that intersect each other or the rest of the mesh. Numbers are never reused.
 */
enum fairmesh_intersections
#if defined(__cplusplus) || __STDC_VERSION__ >= 202311L
  : uint32_t
#endif // defined(__cplusplus) || __STDC_VERSION__ >= 202311L
 {
    /**
     * The surface is checked against itself and the rest of the mesh; one that intersects is no success.
     */
    FAIRMESH_INTERSECTIONS_CHECK = 0,
    /**
     * Not checked: a surface that intersects may count as a success.
     */
    FAIRMESH_INTERSECTIONS_SKIP = 1,
};
#ifndef __cplusplus
#if __STDC_VERSION__ >= 202311L
typedef enum fairmesh_intersections fairmesh_intersections;
#else
typedef uint32_t fairmesh_intersections;
#endif // __STDC_VERSION__ >= 202311L
#endif // __cplusplus

/**
 * The precision of the numbers that a result will be written in. Numbers are never reused.
 */
enum fairmesh_output_precision
#if defined(__cplusplus) || __STDC_VERSION__ >= 202311L
  : uint32_t
#endif // defined(__cplusplus) || __STDC_VERSION__ >= 202311L
 {
    /**
     * Double: 53 bits.
     */
    FAIRMESH_OUTPUT_PRECISION_DOUBLE = 0,
    /**
     * Single: 24 bits; far from the origin that is coarse.
     */
    FAIRMESH_OUTPUT_PRECISION_SINGLE = 1,
};
#ifndef __cplusplus
#if __STDC_VERSION__ >= 202311L
typedef enum fairmesh_output_precision fairmesh_output_precision;
#else
typedef uint32_t fairmesh_output_precision;
#endif // __STDC_VERSION__ >= 202311L
#endif // __cplusplus

/**
 * How a run ended that did what it was asked. The positions are usable in every case. Numbers are never reused.
 */
enum fairmesh_outcome
#if defined(__cplusplus) || __STDC_VERSION__ >= 202311L
  : uint32_t
#endif // defined(__cplusplus) || __STDC_VERSION__ >= 202311L
 {
    /**
     * Tolerance met, and the surface is sound.
     */
    FAIRMESH_OUTCOME_CONVERGED = 0,
    /**
     * Tolerance met, but triangles are flipped or have an angle below one degree.
     */
    FAIRMESH_OUTCOME_CONVERGED_POOR_TRIANGLES = 1,
    /**
     * Tolerance met, and no triangle is poor, but the surface has a reservation, which the reason names.
     */
    FAIRMESH_OUTCOME_CONVERGED_LOOSELY = 2,
    /**
     * A surface was found for a part of the target only; that of least bending is returned.
     */
    FAIRMESH_OUTCOME_TARGET_NOT_REACHABLE = 4,
    /**
     * No sound surface was found; that of least bending is returned.
     */
    FAIRMESH_OUTCOME_NOT_CONVERGED = 5,
    /**
     * The iterations ran out; the best surface so far is returned.
     */
    FAIRMESH_OUTCOME_ITERATION_LIMIT = 6,
    /**
     * The progress callback stopped the run; the best surface so far is returned, before there is one the input.
     */
    FAIRMESH_OUTCOME_CANCELLED = 7,
    /**
     * Tolerance met, but the surface has a crease along the boundary, at the vertices that the report names.
     */
    FAIRMESH_OUTCOME_BOUNDARY_CREASE = 8,
    /**
     * Tolerance met, and no triangle is poor, but triangles of the surface intersect each other or the rest of the mesh.
     */
    FAIRMESH_OUTCOME_SELF_INTERSECTING = 9,
    /**
     * Tolerance met, but rounding the positions to the numbers that are written flips triangles or leaves them without angles.
     */
    FAIRMESH_OUTCOME_POOR_WHEN_ROUNDED = 10,
    /**
     * No harmonic surface was found; a smooth one with the same normals, between harmonic and minimal energy, is returned.
     */
    FAIRMESH_OUTCOME_NEAREST_MEMBER = 11,
};
#ifndef __cplusplus
#if __STDC_VERSION__ >= 202311L
typedef enum fairmesh_outcome fairmesh_outcome;
#else
typedef uint32_t fairmesh_outcome;
#endif // __STDC_VERSION__ >= 202311L
#endif // __cplusplus

/**
 * What is to be said of a surface that converged loosely. Numbers are never reused.
 */
enum fairmesh_loose_reason
#if defined(__cplusplus) || __STDC_VERSION__ >= 202311L
  : uint32_t
#endif // defined(__cplusplus) || __STDC_VERSION__ >= 202311L
 {
    /**
     * There is nothing to say.
     */
    FAIRMESH_LOOSE_REASON_NONE = 0,
    /**
     * Boundary normals point against the surface beside them: probably flipped.
     */
    FAIRMESH_LOOSE_REASON_SUSPICIOUS_NORMALS = 1,
    /**
     * Max |Delta_B H| is as small as the rounding of the positions allows, but above its limit.
     */
    FAIRMESH_LOOSE_REASON_ROUNDING = 2,
    /**
     * The surface has a bump: its curvature inside exceeds what the boundary allows, or it folds at single edges or leaves single normals.
     */
    FAIRMESH_LOOSE_REASON_BUMP = 4,
    /**
     * The steps have become as small as double precision allows here, but stay above the tolerance.
     */
    FAIRMESH_LOOSE_REASON_TOLERANCE = 5,
    /**
     * No sound surface over this hole has the normals of the mesh: they were drawn towards those of a membrane.
     */
    FAIRMESH_LOOSE_REASON_DRAWN_NORMALS = 6,
    /**
     * Less than half of the curvature asked for was continued: the surroundings are too rough, or no sound surface has it.
     */
    FAIRMESH_LOOSE_REASON_CURVATURE = 7,
    /**
     * A sharp edge of the surroundings ends at the boundary, at the vertices that the report names, and does not go on.
     */
    FAIRMESH_LOOSE_REASON_SHARP_EDGE = 8,
};
#ifndef __cplusplus
#if __STDC_VERSION__ >= 202311L
typedef enum fairmesh_loose_reason fairmesh_loose_reason;
#else
typedef uint32_t fairmesh_loose_reason;
#endif // __STDC_VERSION__ >= 202311L
#endif // __cplusplus

/**
 * How an attempt at a surface ended. Numbers are never reused.
 */
enum fairmesh_attempt_end
#if defined(__cplusplus) || __STDC_VERSION__ >= 202311L
  : uint32_t
#endif // defined(__cplusplus) || __STDC_VERSION__ >= 202311L
 {
    /**
     * A sound surface that meets the tolerance of the attempt.
     */
    FAIRMESH_ATTEMPT_END_SOUND = 0,
    /**
     * A surface that meets the tolerance, but has poor triangles, a bump or a crease.
     */
    FAIRMESH_ATTEMPT_END_UNSOUND = 1,
    /**
     * No surface that meets the tolerance.
     */
    FAIRMESH_ATTEMPT_END_NOT_CONVERGED = 2,
    /**
     * Stopped by the limit of iterations or by the caller.
     */
    FAIRMESH_ATTEMPT_END_STOPPED = 3,
};
#ifndef __cplusplus
#if __STDC_VERSION__ >= 202311L
typedef enum fairmesh_attempt_end fairmesh_attempt_end;
#else
typedef uint32_t fairmesh_attempt_end;
#endif // __STDC_VERSION__ >= 202311L
#endif // __cplusplus

/**
 * What kind of gap a boundary loop is. Numbers are never reused.
 */
enum fairmesh_loop_kind
#if defined(__cplusplus) || __STDC_VERSION__ >= 202311L
  : uint32_t
#endif // defined(__cplusplus) || __STDC_VERSION__ >= 202311L
 {
    /**
     * A gap in the surface.
     */
    FAIRMESH_LOOP_KIND_HOLE = 0,
    /**
     * The outer boundary of an open surface: filled only if it is named.
     */
    FAIRMESH_LOOP_KIND_OUTER_BOUNDARY = 1,
    /**
     * It meets an edge with more than two triangles, which is told: never filled.
     */
    FAIRMESH_LOOP_KIND_NON_MANIFOLD = 2,
    /**
     * It meets an edge, which is told, whose two triangles face opposite ways: never filled.
     */
    FAIRMESH_LOOP_KIND_INCONSISTENT = 3,
};
#ifndef __cplusplus
#if __STDC_VERSION__ >= 202311L
typedef enum fairmesh_loop_kind fairmesh_loop_kind;
#else
typedef uint32_t fairmesh_loop_kind;
#endif // __STDC_VERSION__ >= 202311L
#endif // __cplusplus

/**
 * How the filling of a loop ended. Numbers are never reused.
 */
enum fairmesh_fill_outcome
#if defined(__cplusplus) || __STDC_VERSION__ >= 202311L
  : uint32_t
#endif // defined(__cplusplus) || __STDC_VERSION__ >= 202311L
 {
    /**
     * Filled with a faired surface; its report says with which reservations.
     */
    FAIRMESH_FILL_OUTCOME_FAIRED = 0,
    /**
     * Filled with the surface of least bending, or the best one when the iterations ran out.
     */
    FAIRMESH_FILL_OUTCOME_LEAST_BENDING = 1,
    /**
     * Filled with the triangulation, refined, but not faired; the reason says why.
     */
    FAIRMESH_FILL_OUTCOME_FLAT = 2,
    /**
     * Left as it was; the reason says why.
     */
    FAIRMESH_FILL_OUTCOME_LEFT_OPEN = 3,
    /**
     * Filled, but the patch intersects itself or the mesh, as did all others that were tried.
     */
    FAIRMESH_FILL_OUTCOME_SELF_INTERSECTING = 4,
};
#ifndef __cplusplus
#if __STDC_VERSION__ >= 202311L
typedef enum fairmesh_fill_outcome fairmesh_fill_outcome;
#else
typedef uint32_t fairmesh_fill_outcome;
#endif // __STDC_VERSION__ >= 202311L
#endif // __cplusplus

/**
 * Why a loop was left open (numbers below 32) or a patch is flat. Numbers are never reused.
 */
enum fairmesh_fill_reason
#if defined(__cplusplus) || __STDC_VERSION__ >= 202311L
  : uint32_t
#endif // defined(__cplusplus) || __STDC_VERSION__ >= 202311L
 {
    /**
     * There is nothing to say.
     */
    FAIRMESH_FILL_REASON_NONE = 0,
    /**
     * The boundary runs into an edge with more than two triangles.
     */
    FAIRMESH_FILL_REASON_NON_MANIFOLD = 1,
    /**
     * It is the outer boundary of an open surface, and was not named.
     */
    FAIRMESH_FILL_REASON_OUTER_BOUNDARY = 2,
    /**
     * It has more edges than asked for.
     */
    FAIRMESH_FILL_REASON_TOO_MANY_EDGES = 3,
    /**
     * Every triangulation has an edge or a triangle that the mesh has already.
     */
    FAIRMESH_FILL_REASON_NO_TRIANGULATION = 4,
    /**
     * A vertex of the boundary is NaN or infinite, or all of them are the same point.
     */
    FAIRMESH_FILL_REASON_NOT_FINITE = 5,
    /**
     * The run was stopped before this loop was done.
     */
    FAIRMESH_FILL_REASON_CANCELLED = 6,
    /**
     * Two of the loops to be joined fit only if the triangles at one of them faced the other way.
     */
    FAIRMESH_FILL_REASON_OPPOSITE_SIDES = 7,
    /**
     * Two of the loops to be joined have a vertex in common.
     */
    FAIRMESH_FILL_REASON_SHARED_VERTEX = 8,
    /**
     * It is not one of those that were asked for.
     */
    FAIRMESH_FILL_REASON_NOT_ASKED_FOR = 9,
    /**
     * No patch was found that is fair and without reservations, and such loops were to stay open.
     */
    FAIRMESH_FILL_REASON_NOT_FAIR = 10,
    /**
     * Every patch that was tried intersects itself or the mesh, and such loops were to stay open.
     */
    FAIRMESH_FILL_REASON_INTERSECTS = 11,
    /**
     * It is the outer boundary of triangles that hang at the rest of the mesh by single vertices only, one of which is told.
     */
    FAIRMESH_FILL_REASON_HANGING = 12,
    /**
     * The boundary runs into an edge whose two triangles face opposite ways: they are oriented inconsistently.
     */
    FAIRMESH_FILL_REASON_INCONSISTENT = 13,
    /**
     * Fairing was not asked for.
     */
    FAIRMESH_FILL_REASON_NOT_ASKED = 32,
    /**
     * The patch has no inner vertex: nothing can move.
     */
    FAIRMESH_FILL_REASON_NO_INNER_VERTEX = 33,
    /**
     * The fairing was refused, because the mesh around the hole is defective.
     */
    FAIRMESH_FILL_REASON_REFUSED = 34,
    /**
     * The fairing found no sound surface; its report says how it ended.
     */
    FAIRMESH_FILL_REASON_UNSOUND = 35,
    /**
     * Faired, the patch would intersect itself or the mesh.
     */
    FAIRMESH_FILL_REASON_INTERSECTING = 36,
    /**
     * The boundary lies in a plane, which closes it, as asked.
     */
    FAIRMESH_FILL_REASON_PLANAR = 37,
};
#ifndef __cplusplus
#if __STDC_VERSION__ >= 202311L
typedef enum fairmesh_fill_reason fairmesh_fill_reason;
#else
typedef uint32_t fairmesh_fill_reason;
#endif // __STDC_VERSION__ >= 202311L
#endif // __cplusplus

/**
 * Which loops get one patch together. Numbers are never reused.
 */
enum fairmesh_join_kind
#if defined(__cplusplus) || __STDC_VERSION__ >= 202311L
  : uint32_t
#endif // defined(__cplusplus) || __STDC_VERSION__ >= 202311L
 {
    /**
     * Every loop gets a patch of its own.
     */
    FAIRMESH_JOIN_KIND_NONE = 0,
    /**
     * The loops of each group get one patch.
     */
    FAIRMESH_JOIN_KIND_GROUPS = 1,
    /**
     * Loops whose joint patch bends less than patches of their own would get one patch.
     */
    FAIRMESH_JOIN_KIND_AUTO = 2,
};
#ifndef __cplusplus
#if __STDC_VERSION__ >= 202311L
typedef enum fairmesh_join_kind fairmesh_join_kind;
#else
typedef uint32_t fairmesh_join_kind;
#endif // __STDC_VERSION__ >= 202311L
#endif // __cplusplus

/**
 * What lies between loops that are joined. Numbers are never reused.
 */
enum fairmesh_gap_kind
#if defined(__cplusplus) || __STDC_VERSION__ >= 202311L
  : uint32_t
#endif // defined(__cplusplus) || __STDC_VERSION__ >= 202311L
 {
    /**
     * A gap between parts.
     */
    FAIRMESH_GAP_KIND_GAP = 0,
    /**
     * A tunnel: the part gets a handle.
     */
    FAIRMESH_GAP_KIND_TUNNEL = 1,
    /**
     * A hole with an island in it.
     */
    FAIRMESH_GAP_KIND_ISLAND = 2,
};
#ifndef __cplusplus
#if __STDC_VERSION__ >= 202311L
typedef enum fairmesh_gap_kind fairmesh_gap_kind;
#else
typedef uint32_t fairmesh_gap_kind;
#endif // __STDC_VERSION__ >= 202311L
#endif // __cplusplus

/**
 * What became of ends of sharp edges that belong together. Numbers are never reused.
 */
enum fairmesh_sharp_fate
#if defined(__cplusplus) || __STDC_VERSION__ >= 202311L
  : uint32_t
#endif // defined(__cplusplus) || __STDC_VERSION__ >= 202311L
 {
    /**
     * The crease goes on through the region, from end to end.
     */
    FAIRMESH_SHARP_FATE_GOES_ON = 0,
    /**
     * Creases go on to a corner in the region, or to two that a crease joins.
     */
    FAIRMESH_SHARP_FATE_CORNER = 1,
    /**
     * No other end fits it: the region is smooth there.
     */
    FAIRMESH_SHARP_FATE_ALONE = 2,
    /**
     * No path of edges, or no sound patch, can follow the crease: the surface is smooth there.
     */
    FAIRMESH_SHARP_FATE_NO_PATH = 3,
};
#ifndef __cplusplus
#if __STDC_VERSION__ >= 202311L
typedef enum fairmesh_sharp_fate fairmesh_sharp_fate;
#else
typedef uint32_t fairmesh_sharp_fate;
#endif // __STDC_VERSION__ >= 202311L
#endif // __cplusplus

/**
 * What a loop gets whose patch is no success: not fair, creased, intersecting, or with any other reservation. Numbers are never reused.
 */
enum fairmesh_on_failure
#if defined(__cplusplus) || __STDC_VERSION__ >= 202311L
  : uint32_t
#endif // defined(__cplusplus) || __STDC_VERSION__ >= 202311L
 {
    /**
     * The best surface that there is: that of least bending, or the faired one that intersects where all do.
     */
    FAIRMESH_ON_FAILURE_BEST = 0,
    /**
     * The triangulation, refined.
     */
    FAIRMESH_ON_FAILURE_FLAT = 1,
    /**
     * None: it is left open.
     */
    FAIRMESH_ON_FAILURE_OPEN = 2,
};
#ifndef __cplusplus
#if __STDC_VERSION__ >= 202311L
typedef enum fairmesh_on_failure fairmesh_on_failure;
#else
typedef uint32_t fairmesh_on_failure;
#endif // __STDC_VERSION__ >= 202311L
#endif // __cplusplus

/**
 * What closes a loop that lies in a plane. Numbers are never reused.
 */
enum fairmesh_cap
#if defined(__cplusplus) || __STDC_VERSION__ >= 202311L
  : uint32_t
#endif // defined(__cplusplus) || __STDC_VERSION__ >= 202311L
 {
    /**
     * A fair patch, which continues the surroundings and bulges as they do.
     */
    FAIRMESH_CAP_FAIR = 0,
    /**
     * The plane, with a sharp edge along the loop; loops that are in no plane get a fair patch.
     */
    FAIRMESH_CAP_FLAT = 1,
};
#ifndef __cplusplus
#if __STDC_VERSION__ >= 202311L
typedef enum fairmesh_cap fairmesh_cap;
#else
typedef uint32_t fairmesh_cap;
#endif // __STDC_VERSION__ >= 202311L
#endif // __cplusplus

/**
 * Which creases are rounded. Numbers are never reused.
 */
enum fairmesh_creases
#if defined(__cplusplus) || __STDC_VERSION__ >= 202311L
  : uint32_t
#endif // defined(__cplusplus) || __STDC_VERSION__ >= 202311L
 {
    /**
     * All.
     */
    FAIRMESH_CREASES_ALL = 0,
    /**
     * Edges that stand out.
     */
    FAIRMESH_CREASES_CONVEX = 1,
    /**
     * Edges that lie in a fold.
     */
    FAIRMESH_CREASES_CONCAVE = 2,
};
#ifndef __cplusplus
#if __STDC_VERSION__ >= 202311L
typedef enum fairmesh_creases fairmesh_creases;
#else
typedef uint32_t fairmesh_creases;
#endif // __STDC_VERSION__ >= 202311L
#endif // __cplusplus

/**
 * A part of space. Numbers are never reused.
 */
enum fairmesh_place_kind
#if defined(__cplusplus) || __STDC_VERSION__ >= 202311L
  : uint32_t
#endif // defined(__cplusplus) || __STDC_VERSION__ >= 202311L
 {
    /**
     * Anywhere.
     */
    FAIRMESH_PLACE_KIND_EVERYWHERE = 0,
    /**
     * Not further than a radius from a centre.
     */
    FAIRMESH_PLACE_KIND_BALL = 1,
    /**
     * Between two corners, the faces included.
     */
    FAIRMESH_PLACE_KIND_BOX = 2,
};
#ifndef __cplusplus
#if __STDC_VERSION__ >= 202311L
typedef enum fairmesh_place_kind fairmesh_place_kind;
#else
typedef uint32_t fairmesh_place_kind;
#endif // __STDC_VERSION__ >= 202311L
#endif // __cplusplus

/**
 * What a result is of.
 */
enum fairmesh_result_kind
#if defined(__cplusplus) || __STDC_VERSION__ >= 202311L
  : uint32_t
#endif // defined(__cplusplus) || __STDC_VERSION__ >= 202311L
 {
    /**
     * A faired mesh.
     */
    FAIRMESH_RESULT_KIND_FAIRED = 0,
    /**
     * Boundary loops.
     */
    FAIRMESH_RESULT_KIND_LOOPS = 1,
    /**
     * A mesh with filled holes.
     */
    FAIRMESH_RESULT_KIND_FILLED = 2,
    /**
     * A mesh with a new triangulation of a region.
     */
    FAIRMESH_RESULT_KIND_REMESHED = 3,
    /**
     * Pairs of intersecting triangles.
     */
    FAIRMESH_RESULT_KIND_INTERSECTIONS = 4,
    /**
     * Groups of loops that would be joined.
     */
    FAIRMESH_RESULT_KIND_JOINS = 5,
    /**
     * A mesh without some of its triangles.
     */
    FAIRMESH_RESULT_KIND_ERASED = 6,
    /**
     * The components of a mesh.
     */
    FAIRMESH_RESULT_KIND_COMPONENTS = 7,
    /**
     * A mesh with a bridge.
     */
    FAIRMESH_RESULT_KIND_BRIDGED = 8,
    /**
     * A mesh without the triangles that spoil the boundaries of holes.
     */
    FAIRMESH_RESULT_KIND_TRIMMED = 9,
    /**
     * Points on the triangles of a mesh.
     */
    FAIRMESH_RESULT_KIND_CARRIED = 10,
    /**
     * Triangles chosen by place and shape.
     */
    FAIRMESH_RESULT_KIND_REGION = 11,
    /**
     * A mesh with blends in place of creases.
     */
    FAIRMESH_RESULT_KIND_ROUNDED = 12,
};
#ifndef __cplusplus
#if __STDC_VERSION__ >= 202311L
typedef enum fairmesh_result_kind fairmesh_result_kind;
#else
typedef uint32_t fairmesh_result_kind;
#endif // __STDC_VERSION__ >= 202311L
#endif // __cplusplus

/**
 * Lists of indices in a result. The first block is of faired meshes, and of loops of filled ones.
 */
enum fairmesh_list
#if defined(__cplusplus) || __STDC_VERSION__ >= 202311L
  : uint32_t
#endif // defined(__cplusplus) || __STDC_VERSION__ >= 202311L
 {
    /**
     * Triangles that are flipped or have an angle below one degree, where the outcome is about them.
     */
    FAIRMESH_LIST_POOR_TRIANGLES = 0,
    /**
     * Triangles whose normal points away from those of their vertices.
     */
    FAIRMESH_LIST_FLIPPED_TRIANGLES = 1,
    /**
     * Triangles with an angle below one degree.
     */
    FAIRMESH_LIST_NEEDLES = 2,
    /**
     * Boundary vertices whose normal contradicts the surface or its neighbours'.
     */
    FAIRMESH_LIST_SUSPICIOUS_NORMALS = 3,
    /**
     * Intersecting triangles, two for each pair, the smaller number first; of a filled mesh those of the loop.
     */
    FAIRMESH_LIST_INTERSECTIONS = 5,
    /**
     * Boundary vertices where the surface has a crease, where the outcome is about them.
     */
    FAIRMESH_LIST_CREASED_VERTICES = 6,
    /**
     * The vertices along sharp edges, one edge after the other. Those that were free have been placed on them.
     */
    FAIRMESH_LIST_SHARP_VERTICES = 7,
    /**
     * Faired meshes: the boundary vertices, ascending. A vertex where components have different normals stands there with each.
     */
    FAIRMESH_LIST_BOUNDARY_VERTICES = 16,
    /**
     * Loops: the vertices in the direction of triangles that fill it.
     */
    FAIRMESH_LIST_LOOP_VERTICES = 32,
    /**
     * Loops: vertices that belong to another loop, too.
     */
    FAIRMESH_LIST_LOOP_TOUCHING = 33,
    /**
     * Filled meshes: new vertices of the loop far outside its bounding box.
     */
    FAIRMESH_LIST_OUTSIDE_VERTICES = 48,
    /**
     * Filled, bridged, remeshed and rounded meshes: per new vertex three vertices of the mesh given that it comes from. Carried points: per
     * point the corners of the triangle that it is on.
     */
    FAIRMESH_LIST_PARENTS = 49,
    /**
     * Filled meshes: the loops that the patch is for, ascending. Joins: the loops of the group with this index, ascending.
     */
    FAIRMESH_LIST_JOINED_LOOPS = 50,
    /**
     * Remeshed meshes: the free vertices. Rounded ones: those of the blends, without their rails.
     */
    FAIRMESH_LIST_FREE_VERTICES = 64,
    /**
     * Remeshed and rounded meshes: per vertex that is left its number before.
     */
    FAIRMESH_LIST_KEPT_VERTICES = 65,
    /**
     * Remeshed, erased and trimmed meshes: per triangle that is left its number before. Rounded ones: per triangle outside the blends, which come
     * last, that of the one that it is, or is a part of.
     */
    FAIRMESH_LIST_KEPT_TRIANGLES = 66,
    /**
     * Erased meshes: the loops that the deleted triangles leave, as `fairmesh_boundary_loops` numbers those of the mesh that is left.
     */
    FAIRMESH_LIST_ERASED_LOOPS = 80,
    /**
     * Components: per triangle the number of its component.
     */
    FAIRMESH_LIST_TRIANGLE_COMPONENTS = 96,
    /**
     * Bridged meshes: the vertices of the chain that the strip begins (0) or ends (1) at, in the direction in which its triangles run
     * through them.
     */
    FAIRMESH_LIST_BRIDGE_CHAIN = 112,
    /**
     * Bridged meshes: the new vertices on one side of the strip (0: from the first chain to the second; 1: back).
     */
    FAIRMESH_LIST_BRIDGE_SIDE = 113,
    /**
     * Carried points: per point the triangle that it is on.
     */
    FAIRMESH_LIST_CARRIED_TRIANGLES = 128,
    /**
     * Regions: the triangles, ascending.
     */
    FAIRMESH_LIST_REGION_TRIANGLES = 144,
    /**
     * Regions: per step how many triangles it named, or how many there were after it.
     */
    FAIRMESH_LIST_REGION_COUNTS = 145,
    /**
     * Rounded meshes: the vertices of the crease with this index, one after the other, in the mesh given; those of a closed one end with the first.
     */
    FAIRMESH_LIST_CREASE_VERTICES = 160,
    /**
     * Rounded meshes: the corners, vertices of the mesh given, that stay sharp, as no sound blend was found there: blends fade out towards them.
     */
    FAIRMESH_LIST_SHARP_CORNERS = 161,
};
#ifndef __cplusplus
#if __STDC_VERSION__ >= 202311L
typedef enum fairmesh_list fairmesh_list;
#else
typedef uint32_t fairmesh_list;
#endif // __STDC_VERSION__ >= 202311L
#endif // __cplusplus

/**
 * What a step of `fairmesh_select_region` names, or does.
 */
enum fairmesh_region_kind
#if defined(__cplusplus) || __STDC_VERSION__ >= 202311L
  : uint32_t
#endif // defined(__cplusplus) || __STDC_VERSION__ >= 202311L
 {
    /**
     * The whole mesh.
     */
    FAIRMESH_REGION_KIND_ALL = 0,
    /**
     * The triangles of `list`.
     */
    FAIRMESH_REGION_KIND_TRIANGLES = 1,
    /**
     * The triangles all of whose corners are vertices of `list`, or copies of them.
     */
    FAIRMESH_REGION_KIND_VERTICES = 2,
    /**
     * The triangles that lie in a ball with all corners: around `point`, of radius `value`.
     */
    FAIRMESH_REGION_KIND_BALL = 3,
    /**
     * The triangles that lie in a box with all corners: `point` has its smallest, `vector` its largest coordinates.
     */
    FAIRMESH_REGION_KIND_BOX = 4,
    /**
     * The triangles all of whose corners lie on a plane through `point`, or on the side that `vector` points to.
     */
    FAIRMESH_REGION_KIND_HALF_SPACE = 5,
    /**
     * The triangles all of whose corners are no further than `value` from the seed, along the surface.
     */
    FAIRMESH_REGION_KIND_GEODESIC = 6,
    /**
     * The triangles that hang together with the seed by edges.
     */
    FAIRMESH_REGION_KIND_COMPONENT = 7,
    /**
     * The triangles around the seed, up to edges at which the surface bends by more than `value`, in degrees from 0 to 180.
     */
    FAIRMESH_REGION_KIND_PATCH = 8,
    /**
     * The bump or dent at the seed: the least region whose fair surface stays what it is when the region grows, see `fairmesh_bump`; the one
     * that reaches about as far as `value`, or at 0 the smallest. NO_BUMP where none is found.
     */
    FAIRMESH_REGION_KIND_BUMP = 9,
    /**
     * Adds the triangles that have a vertex in common with the region so far, `rings` times.
     */
    FAIRMESH_REGION_KIND_GROW = 32,
    /**
     * Takes the triangles away that have a vertex in common with the rest, `rings` times.
     */
    FAIRMESH_REGION_KIND_SHRINK = 33,
    /**
     * Takes the rest instead.
     */
    FAIRMESH_REGION_KIND_INVERT = 34,
};
#ifndef __cplusplus
#if __STDC_VERSION__ >= 202311L
typedef enum fairmesh_region_kind fairmesh_region_kind;
#else
typedef uint32_t fairmesh_region_kind;
#endif // __STDC_VERSION__ >= 202311L
#endif // __cplusplus

/**
 * How the triangles that a step names are combined with the region so far.
 */
enum fairmesh_combine
#if defined(__cplusplus) || __STDC_VERSION__ >= 202311L
  : uint32_t
#endif // defined(__cplusplus) || __STDC_VERSION__ >= 202311L
 {
    /**
     * What is in any of the two.
     */
    FAIRMESH_COMBINE_ADD = 0,
    /**
     * What is in the region and not named.
     */
    FAIRMESH_COMBINE_REMOVE = 1,
    /**
     * What is in both.
     */
    FAIRMESH_COMBINE_INTERSECT = 2,
};
#ifndef __cplusplus
#if __STDC_VERSION__ >= 202311L
typedef enum fairmesh_combine fairmesh_combine;
#else
typedef uint32_t fairmesh_combine;
#endif // __STDC_VERSION__ >= 202311L
#endif // __cplusplus

/**
 * Where a region begins.
 */
enum fairmesh_seed_kind
#if defined(__cplusplus) || __STDC_VERSION__ >= 202311L
  : uint32_t
#endif // defined(__cplusplus) || __STDC_VERSION__ >= 202311L
 {
    /**
     * At the point of the surface that is nearest to `point`.
     */
    FAIRMESH_SEED_KIND_POINT = 0,
    /**
     * At a vertex, `seed_vertex`.
     */
    FAIRMESH_SEED_KIND_VERTEX = 1,
};
#ifndef __cplusplus
#if __STDC_VERSION__ >= 202311L
typedef enum fairmesh_seed_kind fairmesh_seed_kind;
#else
typedef uint32_t fairmesh_seed_kind;
#endif // __STDC_VERSION__ >= 202311L
#endif // __cplusplus

/**
 * What an edit changes.
 */
enum fairmesh_edit_kind
#if defined(__cplusplus) || __STDC_VERSION__ >= 202311L
  : uint32_t
#endif // defined(__cplusplus) || __STDC_VERSION__ >= 202311L
 {
    /**
     * Turns the boundary normals of the loop of `vertex` about the boundary, by `amount` in radians. With a positive one the surface
     * leaves the boundary steeper to the side that normals point to.
     */
    FAIRMESH_EDIT_KIND_TILT = 1,
    /**
     * The same on one side of `vertex`, and the opposite on the other.
     */
    FAIRMESH_EDIT_KIND_TWIST = 2,
    /**
     * Bulges the region by `amount`, outward if it is positive; see `fairmesh_solver_bulge_range`.
     */
    FAIRMESH_EDIT_KIND_BULGE = 3,
    /**
     * Moves the fixed vertices of `vertices` rigidly; their normals follow, given or fitted.
     */
    FAIRMESH_EDIT_KIND_MOVE = 4,
};
#ifndef __cplusplus
#if __STDC_VERSION__ >= 202311L
typedef enum fairmesh_edit_kind fairmesh_edit_kind;
#else
typedef uint32_t fairmesh_edit_kind;
#endif // __STDC_VERSION__ >= 202311L
#endif // __cplusplus

/**
 * What `fairmesh_solver_set` changes.
 */
enum fairmesh_setting
#if defined(__cplusplus) || __STDC_VERSION__ >= 202311L
  : uint32_t
#endif // defined(__cplusplus) || __STDC_VERSION__ >= 202311L
 {
    /**
     * The field `boundary_normals`.
     */
    FAIRMESH_SETTING_BOUNDARY_NORMALS = 0,
    /**
     * The fields `continuity` and `loop_continuity`.
     */
    FAIRMESH_SETTING_CONTINUITY = 1,
    /**
     * The field `boundary_curvature`.
     */
    FAIRMESH_SETTING_BOUNDARY_CURVATURE = 2,
    /**
     * The field `target`.
     */
    FAIRMESH_SETTING_TARGET = 3,
};
#ifndef __cplusplus
#if __STDC_VERSION__ >= 202311L
typedef enum fairmesh_setting fairmesh_setting;
#else
typedef uint32_t fairmesh_setting;
#endif // __STDC_VERSION__ >= 202311L
#endif // __cplusplus

/**
 * Vectors in a result.
 */
enum fairmesh_vectors
#if defined(__cplusplus) || __STDC_VERSION__ >= 202311L
  : uint32_t
#endif // defined(__cplusplus) || __STDC_VERSION__ >= 202311L
 {
    /**
     * Faired meshes: the unit normals that were used at the boundary, in the order of the list BOUNDARY_VERTICES.
     */
    FAIRMESH_VECTORS_BOUNDARY_NORMALS = 0,
    /**
     * Filled, bridged, remeshed and rounded meshes: per new vertex the weights of its three parents; their sum is 1. Carried points: per point.
     */
    FAIRMESH_VECTORS_PARENT_WEIGHTS = 1,
};
#ifndef __cplusplus
#if __STDC_VERSION__ >= 202311L
typedef enum fairmesh_vectors fairmesh_vectors;
#else
typedef uint32_t fairmesh_vectors;
#endif // __STDC_VERSION__ >= 202311L
#endif // __cplusplus

/**
 * Numbers per vertex in a result.
 */
enum fairmesh_scalars
#if defined(__cplusplus) || __STDC_VERSION__ >= 202311L
  : uint32_t
#endif // defined(__cplusplus) || __STDC_VERSION__ >= 202311L
 {
    /**
     * Mean curvature, in 1 / length: negative on a sphere with outward normals. NaN where no vertex is free.
     */
    FAIRMESH_SCALARS_MEAN_CURVATURE = 0,
    /**
     * Gaussian curvature, in 1 / length^2. NaN where no vertex is free.
     */
    FAIRMESH_SCALARS_GAUSSIAN_CURVATURE = 1,
};
#ifndef __cplusplus
#if __STDC_VERSION__ >= 202311L
typedef enum fairmesh_scalars fairmesh_scalars;
#else
typedef uint32_t fairmesh_scalars;
#endif // __STDC_VERSION__ >= 202311L
#endif // __cplusplus

/**
 * What `element` of a `fairmesh_error` counts.
 */
enum fairmesh_element
#if defined(__cplusplus) || __STDC_VERSION__ >= 202311L
  : uint32_t
#endif // defined(__cplusplus) || __STDC_VERSION__ >= 202311L
 {
    /**
     * Nothing.
     */
    FAIRMESH_ELEMENT_NONE = 0,
    /**
     * A vertex of the mesh given.
     */
    FAIRMESH_ELEMENT_VERTEX = 1,
    /**
     * A triangle of the mesh given.
     */
    FAIRMESH_ELEMENT_TRIANGLE = 2,
    /**
     * An edge: `element` and `other` are its vertices, the smaller first.
     */
    FAIRMESH_ELEMENT_EDGE = 3,
    /**
     * An argument of the function, counted from 1; `other` is the offset of the field in the struct that it points
     * to, or FAIRMESH_NO_ELEMENT for the argument itself.
     */
    FAIRMESH_ELEMENT_ARGUMENT = 4,
    /**
     * A boundary loop.
     */
    FAIRMESH_ELEMENT_LOOP = 5,
};
#ifndef __cplusplus
#if __STDC_VERSION__ >= 202311L
typedef enum fairmesh_element fairmesh_element;
#else
typedef uint32_t fairmesh_element;
#endif // __STDC_VERSION__ >= 202311L
#endif // __cplusplus

/**
 * The enumerations that `fairmesh_describe` knows. Numbers are never reused.
 */
enum fairmesh_answer
#if defined(__cplusplus) || __STDC_VERSION__ >= 202311L
  : uint32_t
#endif // defined(__cplusplus) || __STDC_VERSION__ >= 202311L
 {
    /**
     * A `fairmesh_status`.
     */
    FAIRMESH_ANSWER_STATUS = 0,
    /**
     * A `fairmesh_outcome`.
     */
    FAIRMESH_ANSWER_OUTCOME = 1,
    /**
     * A `fairmesh_loose_reason`.
     */
    FAIRMESH_ANSWER_LOOSE_REASON = 2,
    /**
     * A `fairmesh_attempt_end`.
     */
    FAIRMESH_ANSWER_ATTEMPT_END = 3,
    /**
     * A `fairmesh_fill_outcome`.
     */
    FAIRMESH_ANSWER_FILL_OUTCOME = 4,
    /**
     * A `fairmesh_fill_reason`.
     */
    FAIRMESH_ANSWER_FILL_REASON = 5,
    /**
     * A `fairmesh_loop_kind`.
     */
    FAIRMESH_ANSWER_LOOP_KIND = 6,
    /**
     * A `fairmesh_gap_kind`.
     */
    FAIRMESH_ANSWER_GAP_KIND = 7,
    /**
     * A `fairmesh_sharp_fate`.
     */
    FAIRMESH_ANSWER_SHARP_FATE = 8,
};
#ifndef __cplusplus
#if __STDC_VERSION__ >= 202311L
typedef enum fairmesh_answer fairmesh_answer;
#else
typedef uint32_t fairmesh_answer;
#endif // __STDC_VERSION__ >= 202311L
#endif // __cplusplus

/**
 * What `fairmesh_describe` tells of a number.
 */
enum fairmesh_text
#if defined(__cplusplus) || __STDC_VERSION__ >= 202311L
  : uint32_t
#endif // defined(__cplusplus) || __STDC_VERSION__ >= 202311L
 {
    /**
     * What it is called, such as "poor_triangles".
     */
    FAIRMESH_TEXT_NAME = 0,
    /**
     * What it means.
     */
    FAIRMESH_TEXT_MEANING = 1,
    /**
     * What can be done about it; empty if there is nothing to do.
     */
    FAIRMESH_TEXT_REMEDY = 2,
};
#ifndef __cplusplus
#if __STDC_VERSION__ >= 202311L
typedef enum fairmesh_text fairmesh_text;
#else
typedef uint32_t fairmesh_text;
#endif // __STDC_VERSION__ >= 202311L
#endif // __cplusplus

/**
 * Something that was computed. It never changes, and any number of threads may read it at once.
 */
typedef struct fairmesh_result fairmesh_result;

/**
 * A fairing in steps. One thread at a time; a second one is answered BUSY.
 */
typedef struct fairmesh_solver fairmesh_solver;

/**
 * Called with a line of English, which is valid during the call. It may be called on any thread, and by several at once; it may not throw or
 * `longjmp`, and it calls no function of the library.
 */
typedef void (*fairmesh_log_fn)(const char *message, void *user_data);

/**
 * Points or vectors to be read: x, y, z, three numbers side by side at every `stride` bytes.
 */
typedef struct fairmesh_points {
    /**
     * The first x, aligned as its type. May be NULL only if `count` is 0.
     */
    const void *data;
    /**
     * How many points.
     */
    size_t count;
    /**
     * Bytes from one point to the next, a multiple of the number's size; 0: three numbers, nothing between.
     */
    size_t stride;
    /**
     * A `fairmesh_scalar`.
     */
    uint32_t scalar;
    /**
     * Zero.
     */
    uint32_t reserved;
} fairmesh_points;

/**
 * Indices to be read: one at every `stride` bytes, or three side by side where triangles are meant, two where pairs are.
 */
typedef struct fairmesh_indices {
    /**
     * The first index. May be NULL only if `count` is 0.
     */
    const uint32_t *data;
    /**
     * How many indices, or triangles, or pairs.
     */
    size_t count;
    /**
     * Bytes from one index, or triangle, to the next, a multiple of 4; 0: nothing between.
     */
    size_t stride;
} fairmesh_indices;

/**
 * Unit normals at the boundary vertices. All zero: fitted.
 */
typedef struct fairmesh_boundary_normals {
    /**
     * A `fairmesh_boundary_normals_kind`.
     */
    uint32_t kind;
    /**
     * Zero.
     */
    uint32_t reserved;
    /**
     * Given normals: unit vectors, pointing to the side that triangles are counter-clockwise seen from.
     */
    struct fairmesh_points vectors;
    /**
     * The vertex of each vector. NULL (with count 0): there is one vector per vertex of the mesh, and 0 0 0 says that
     * none is given. Vectors at vertices that are not on the boundary are ignored.
     */
    struct fairmesh_indices vertices;
} fairmesh_boundary_normals;

/**
 * Numbers to be read, one at every `stride` bytes.
 */
typedef struct fairmesh_numbers {
    /**
     * The first number, aligned as its type. May be NULL only if `count` is 0.
     */
    const void *data;
    /**
     * How many numbers.
     */
    size_t count;
    /**
     * Bytes from one number to the next, a multiple of the number's size; 0: nothing between.
     */
    size_t stride;
    /**
     * A `fairmesh_scalar`.
     */
    uint32_t scalar;
    /**
     * Zero.
     */
    uint32_t reserved;
} fairmesh_numbers;

/**
 * How far curvature is continued along single boundary loops. All zero: along all loops alike.
 */
typedef struct fairmesh_loop_continuity {
    /**
     * From 0 (tangent planes alone) to 1 (curvature) each.
     */
    struct fairmesh_numbers values;
    /**
     * For each number a vertex of the loop that it holds for. Of several numbers for one loop the last one holds.
     */
    struct fairmesh_indices vertices;
} fairmesh_loop_continuity;

/**
 * Mean curvature at the boundary vertices. All zero: fitted.
 */
typedef struct fairmesh_boundary_curvature {
    /**
     * A `fairmesh_boundary_curvature_kind`.
     */
    uint32_t kind;
    /**
     * Zero.
     */
    uint32_t reserved;
    /**
     * Given mean curvatures, in 1 / length; negative on a sphere with outward normals.
     */
    struct fairmesh_numbers values;
    /**
     * The vertex of each number, which is finite then. NULL (with count 0): there is one number per vertex of the mesh, and NaN
     * says that none is given. Numbers at vertices that are not on the boundary are ignored.
     */
    struct fairmesh_indices vertices;
} fairmesh_boundary_curvature;

/**
 * The right-hand side of the equation. All zero: harmonic.
 */
typedef struct fairmesh_target {
    /**
     * A `fairmesh_target_kind`.
     */
    uint32_t kind;
    /**
     * Zero.
     */
    uint32_t reserved;
    /**
     * Of `FAIRMESH_TARGET_KIND_CONSTANT`; otherwise not read. Finite.
     */
    double constant;
} fairmesh_target;

/**
 * How far a run is.
 */
typedef struct fairmesh_progress {
    /**
     * `sizeof(fairmesh_progress)` of the library: what is behind it does not exist.
     */
    uint32_t struct_size;
    /**
     * Zero.
     */
    uint32_t reserved;
    /**
     * Between 0 and 1, never falling.
     */
    double fraction;
    /**
     * Nonlinear iterations so far, of the component of the region that is at work.
     */
    uint64_t iterations;
    /**
     * Its last step norm, in its diagonals; NaN before the first iteration.
     */
    double step;
    /**
     * What is being done, in a word or two; English. Valid during the callback.
     */
    const char *phase;
} fairmesh_progress;

/**
 * Called after every iteration (of components that are less than a thousandth of the region, now and then), on the thread that made the call. 0 goes on, anything else stops. It may not throw or
 * `longjmp`. It may use other handles; its own solver answers BUSY.
 */
typedef int32_t (*fairmesh_progress_fn)(const struct fairmesh_progress *progress, void *user_data);

/**
 * What is asked. Fill it by `fairmesh_options_init`, then change fields: every default exists once, in the library.
 */
typedef struct fairmesh_options {
    /**
     * `sizeof(fairmesh_options)`.
     */
    uint32_t struct_size;
    /**
     * A `fairmesh_interior_normals`: normals of fixed vertices inside the region that have none given. Default: the surface passes smoothly.
     */
    uint32_t interior_normals;
    /**
     * A `fairmesh_inner_fairness`: how vertices are distributed within the surface. Default: uniform; where nothing leads to a sound surface so, as conformal (`fallback_weights` of the report counts such vertices).
     */
    uint32_t inner_fairness;
    /**
     * A `fairmesh_discretization`: how normals and mean curvature are discretized. Default: second order.
     */
    uint32_t discretization;
    /**
     * A `fairmesh_output_precision`: the precision of what the result will be written in; moved positions are rounded to it, and the report is of the rounded surface. Default: double.
     */
    uint32_t output_precision;
    /**
     * Worker threads, at most 1024; 0 (default): as many as the machine has. Any number gives the same bits.
     */
    uint32_t threads;
    /**
     * A `fairmesh_intersections`: whether the final surface is checked for self-intersections. Default: it is; that takes about a tenth of the run, at most a fifth.
     */
    uint32_t intersections;
    /**
     * Zero.
     */
    uint32_t reserved;
    /**
     * Normals at the boundary vertices. Default: fitted to the surroundings.
     */
    struct fairmesh_boundary_normals boundary_normals;
    /**
     * How far the surface continues the mean curvature of its surroundings: from 0 (tangent planes alone, G1) to 1 (curvature, too, G2), part of the way between those surfaces, where `Delta_B^2 H = 0`. Only as far as the surroundings are smooth enough to tell their curvature; the report says how far. Default auto, -1: 1 along loops where the curvature is certain, 0 along others. For the fast solver. Auto is 0 with the paper's, for another target, while rounding, and along loops with given normals or moved by edits that have no given curvature.
     */
    double continuity;
    /**
     * The same for single boundary loops, each named by a vertex on it, in place of `continuity`. Of several numbers for one loop the last one holds. A loop with 0 has tangent planes alone, and `Delta_B H` is zero along it. Default: none.
     */
    struct fairmesh_loop_continuity loop_continuity;
    /**
     * Where that curvature comes from. Default: fitted to the surroundings.
     */
    struct fairmesh_boundary_curvature boundary_curvature;
    /**
     * What `Delta_B H` has to be. Default: zero.
     */
    struct fairmesh_target target;
    /**
     * Stop when the step norm (rms normal step + rms tangential step, over the diagonal of the component's bounding box) is below this. Default 1e-8; 1e-6 is enough for interactive use. At least 1e-15, a few roundings, and less than 1. What the mesh allows may be a hundred times that, which the outcome says.
     */
    double tolerance;
    /**
     * At most this many nonlinear iterations for each component of the region. Default 500. At least 1.
     */
    uint64_t max_iterations;
    /**
     * Edges that are sharp however little they bend, as marked by hand: pairs of vertices. Where they reach the boundary from outside, creases arrive, too, whatever `sharp` is; inside they say which edges are to lie on one that goes on. Default: none. Two indices side by side.
     */
    struct fairmesh_indices marked_edges;
    /**
     * Called with the progress; may be NULL, the default.
     */
    fairmesh_progress_fn progress;
    /**
     * Handed to `progress`.
     */
    void *user_data;
    /**
     * Creases of the surroundings of at least so many degrees that reach the boundary go on through the region, if another one fits there: vertices are placed along them, and each side is a surface of its own. Default auto: those that are certain. 0: none. Not for fairing in steps.
     */
    double sharp;
} fairmesh_options;

/**
 * Loops that get one patch together: ends of tubes, the two sides of a gap, a hole and the island in it. All zero: none.
 */
typedef struct fairmesh_join {
    /**
     * A `fairmesh_join_kind`.
     */
    uint32_t kind;
    /**
     * Zero.
     */
    uint32_t reserved;
    /**
     * Of `FAIRMESH_JOIN_KIND_GROUPS` the loops, as `fairmesh_boundary_loops` numbers them, outer boundaries included: one group after
     * the other, no loop twice. They are filled whatever else says which loops are. Otherwise not read.
     */
    struct fairmesh_indices loops;
    /**
     * Where each group begins in `loops`, ascending from 0; a group ends where the next one begins. NULL with count 0: all of them are
     * one group.
     */
    struct fairmesh_indices starts;
} fairmesh_join;

/**
 * A part of space. All zero: everywhere.
 */
typedef struct fairmesh_place {
    /**
     * A `fairmesh_place_kind`.
     */
    uint32_t kind;
    /**
     * Zero.
     */
    uint32_t reserved;
    /**
     * The centre of a ball.
     */
    double centre[3];
    /**
     * Its radius.
     */
    double radius;
    /**
     * The smallest coordinates of a box.
     */
    double low[3];
    /**
     * The largest ones.
     */
    double high[3];
} fairmesh_place;

/**
 * Which holes, by what they are and where: those that meet every bound. All zero: all of them.
 */
typedef struct fairmesh_loop_filter {
    /**
     * Not longer than this; 0: of any length.
     */
    double max_length;
    /**
     * Of no more than this area, as `fairmesh_loop` has it; 0: of any area.
     */
    double max_area;
    /**
     * With a bounding box of no more than this diagonal; 0: of any.
     */
    double max_diagonal;
    /**
     * All but so many holes of the mesh, the longest.
     */
    uint64_t except_longest;
    /**
     * Only those of these components, as `fairmesh_components` numbers them; NULL with count 0: of all.
     */
    struct fairmesh_indices components;
    /**
     * Only those whose vertices all lie there.
     */
    struct fairmesh_place within;
} fairmesh_loop_filter;

/**
 * What hole filling does. Fill it by `fairmesh_fill_options_init`. How patches are faired is in a `fairmesh_options`.
 */
typedef struct fairmesh_fill_options {
    /**
     * `sizeof(fairmesh_fill_options)`.
     */
    uint32_t struct_size;
    /**
     * A `fairmesh_on_failure`: what a loop gets whose patch is no success. Default: the best surface there is.
     */
    uint32_t on_failure;
    /**
     * Not 0: the patches are faired. Default: yes.
     */
    uint32_t fair;
    /**
     * Not 0: the loops of the list `loops` only, also where it is empty: then nothing is filled but groups of loops that are joined.
     */
    uint32_t only_listed;
    /**
     * Which of them get one patch together. Default: none.
     */
    struct fairmesh_join join;
    /**
     * Pairs of vertices of the boundary that the triangulation shall have an edge between, before it is refined. On one loop a guide divides what is triangulated, as across a long tear; between two loops that are joined it is where their patch is cut open. No vertex is in two of them. The patch is faired as a whole: it has no crease there. Default: none. Two indices side by side.
     */
    struct fairmesh_indices guides;
    /**
     * How dense the new vertices are, Liepa's factor as in CGAL: at the default, the square root of 2, edges are as long as those of the mesh beside the boundary; at twice that, half as long, away from the boundary, whose edges stay. Between 0.1 and 10.
     */
    double density;
    /**
     * At most this many new vertices in all. Where they do not suffice, patches become coarser away from their boundaries. Smaller loops are served first. Default 200000. No loop of n edges gets more than 1000 + n^2 of them, times the square of a density above 1: a round hole takes a tenth.
     */
    uint64_t max_new_vertices;
    /**
     * For boundaries that are noise: this many rings of vertices around a loop, its own counted, may move onto the surface that the mesh has there on average, before it is filled. 0 (default): none. 4294967295 (auto): as many as are advised around loops that are rough, none around others, nor where triangles would be folded or intersect.
     */
    uint64_t relax_rim;
    /**
     * No vertex of these rings moves further than this. Default: the mean length of the edges around the loop. 0 stands for the default.
     */
    double relax_within;
    /**
     * Holes of more edges stay open. Default: UINT64_MAX.
     */
    uint64_t max_edges;
    /**
     * These loops only, as `fairmesh_boundary_loops` numbers them, outer boundaries included; NULL with count 0 (default): all holes. With a count, `max_edges` and `filter` are not read.
     */
    struct fairmesh_indices loops;
    /**
     * Which holes, if `loops` does not say it. All zero (default): all of them.
     */
    struct fairmesh_loop_filter filter;
    /**
     * A `fairmesh_cap`: what closes a loop that lies in a plane, to a thousandth of its diagonal, as where a part was cut off. Default: a fair patch.
     */
    uint32_t cap;
    /**
     * Zero.
     */
    uint32_t reserved;
} fairmesh_fill_options;

/**
 * What a bridge shall be. Fill it by `fairmesh_bridge_options_init`. How dense it is, and what becomes of one that is not fair, is in a `fairmesh_fill_options`.
 */
typedef struct fairmesh_bridge_options {
    /**
     * `sizeof(fairmesh_bridge_options)`.
     */
    uint32_t struct_size;
    /**
     * Not 0: holes that the strip leaves beside it are filled, and all new vertices, the strip's included, faired together. Default: no.
     */
    uint32_t fill;
    /**
     * How long the chains shall be: each is made longer or shorter about its middle along its loop, to the vertices where that is met best. Default: they are as given. 0 stands for the default.
     */
    double width;
} fairmesh_bridge_options;

/**
 * What rounding does. Fill it by `fairmesh_round_options_init`; then set `width` or `radius`. How blends are faired is in a `fairmesh_options`.
 */
typedef struct fairmesh_round_options {
    /**
     * `sizeof(fairmesh_round_options)`.
     */
    uint32_t struct_size;
    /**
     * A `fairmesh_creases`: which creases are rounded. Default: all.
     */
    uint32_t creases;
    /**
     * How far from a crease its blend reaches, along the surface on both sides. 0 (default): `radius` says it.
     */
    double width;
    /**
     * The radius of the ball that touches both sides where the blend begins, in place of `width`. 0 (default): the width holds.
     */
    double radius;
    /**
     * How many times as far as at its beginning the blend of a chain that is not closed reaches at its end; in between that changes evenly. A chain begins with the first of its `edges`, as it is named; else at the end whose vertex has the smaller number. 1 (default): everywhere alike.
     */
    double taper;
    /**
     * Edges that bend by more than so many degrees are creases. 0 (default): the widest gap between the bends of the mesh tells.
     */
    double angle;
    /**
     * Edges that are rounded, and no others: pairs of vertices; they are creases however little they bend. Default: none, all creases are. Two indices side by side.
     */
    struct fairmesh_indices edges;
    /**
     * Blends that would have more vertices than about so many are refused: a slip of the width, most likely. Default 1000000.
     */
    uint64_t max_blend_vertices;
    /**
     * Labels of all triangles, one for each, as the numbers of their materials: lines between labels stay where they are, inside flat faces, too. Default: none, all have the same.
     */
    struct fairmesh_indices labels;
} fairmesh_round_options;

/**
 * What remeshing does. Fill it by `fairmesh_remesh_options_init`.
 */
typedef struct fairmesh_remesh_options {
    /**
     * `sizeof(fairmesh_remesh_options)`.
     */
    uint32_t struct_size;
    /**
     * Zero.
     */
    uint32_t reserved;
    /**
     * How dense the vertices are, as in hole filling: at the default, the square root of 2, edges are as long as those beside the region; at twice that, half as long, away from the boundary, whose edges stay. Between 0.1 and 10.
     */
    double density;
    /**
     * At most this many vertices inside the region. Default 200000.
     */
    uint64_t max_vertices;
    /**
     * Called with the progress; may be NULL, the default. Where it stops the call, the status is CANCELLED.
     */
    fairmesh_progress_fn progress;
    /**
     * Handed to `progress`.
     */
    void *user_data;
} fairmesh_remesh_options;

/**
 * A triangle mesh. Set `struct_size` and the two arrays, all else to zero.
 */
typedef struct fairmesh_mesh {
    /**
     * `sizeof(fairmesh_mesh)`.
     */
    uint32_t struct_size;
    /**
     * A `fairmesh_coincident`: whether vertices at the same place are one vertex of the surface. Zero: they are. Then all copies
     * of a free vertex move alike. A list of vertices names a vertex by any of its copies; a mask frees it where it frees all.
     */
    uint32_t coincident;
    /**
     * The vertices, in any unit of length.
     */
    struct fairmesh_points positions;
    /**
     * The triangles, counter-clockwise seen from the side that normals point to. Indices count from 0.
     */
    struct fairmesh_indices triangles;
    /**
     * Vertices are at the same place up to this distance, in the unit of the positions. Zero: where their coordinates are equal.
     * Not negative, and well below the edge lengths.
     */
    double coincident_within;
} fairmesh_mesh;

/**
 * Which vertices may move. All others stay, to the last bit.
 */
typedef struct fairmesh_selection {
    /**
     * `sizeof(fairmesh_selection)`.
     */
    uint32_t struct_size;
    /**
     * A `fairmesh_selection_kind`.
     */
    uint32_t kind;
    /**
     * The first entry, of the type that the kind says.
     */
    const void *data;
    /**
     * How many entries. Of a mask as many as vertices.
     */
    size_t count;
    /**
     * Bytes from one entry to the next; 0: nothing between.
     */
    size_t stride;
} fairmesh_selection;

/**
 * Points or vectors to be written, as `fairmesh_points`. What lies between them is not touched.
 */
typedef struct fairmesh_points_out {
    /**
     * The first x, aligned as its type. May be NULL only if `count` is 0.
     */
    void *data;
    /**
     * How many points there is room for.
     */
    size_t count;
    /**
     * Bytes from one point to the next, a multiple of the number's size; 0: three numbers, nothing between.
     */
    size_t stride;
    /**
     * A `fairmesh_scalar`.
     */
    uint32_t scalar;
    /**
     * Zero.
     */
    uint32_t reserved;
} fairmesh_points_out;

/**
 * How it went. Where the region has several components, the whole has their worst outcome and largest figures. Set
 * `struct_size` before the call.
 */
typedef struct fairmesh_report {
    /**
     * `sizeof(fairmesh_report)`.
     */
    uint32_t struct_size;
    /**
     * A `fairmesh_outcome`.
     */
    uint32_t outcome;
    /**
     * A `fairmesh_loose_reason`: what the outcome CONVERGED_LOOSELY is about.
     */
    uint32_t loose_reason;
    /**
     * Not 0: the surface is that of least bending.
     */
    uint32_t least_bending;
    /**
     * Nonlinear iterations: the most of any component.
     */
    uint64_t iterations;
    /**
     * Defect of the equation: max_i |sum_j w_ij (H_i - H_j) + (2 A_i / 3) rhs_i| / sum_j |w_ij|, times the diagonal.
     */
    double defect;
    /**
     * The last step norm, in diagonals; NaN if there was none.
     */
    double step;
    /**
     * The diagonal of the bounding box, in the unit of the positions; the largest of any component.
     */
    double diagonal;
    /**
     * How much of the boundary normals or the target was reached, 0 to 1; 1 where all of it.
     */
    double reached;
    /**
     * Free vertices.
     */
    uint64_t free_vertices;
    /**
     * Free vertices that inner fairness does not spread as asked.
     */
    uint64_t fallback_weights;
    /**
     * Size of the list POOR_TRIANGLES.
     */
    uint64_t poor_triangle_count;
    /**
     * Size of the list FLIPPED_TRIANGLES.
     */
    uint64_t flipped_count;
    /**
     * Size of the list NEEDLES.
     */
    uint64_t needle_count;
    /**
     * Size of the list SUSPICIOUS_NORMALS.
     */
    uint64_t suspicious_normal_count;
    /**
     * The smallest angle of a triangle of the region, in degrees.
     */
    double worst_angle;
    /**
     * The triangle that has it.
     */
    uint64_t worst_triangle;
    /**
     * The largest angle, in degrees, between two triangles side by side of which one has a free vertex.
     */
    double sharpest_edge;
    /**
     * The vertex at one end of their edge,
     */
    uint64_t sharpest_edge_from;
    /**
     * and at the other.
     */
    uint64_t sharpest_edge_to;
    /**
     * The smallest and largest mean curvature at free vertices, in 1 / length; negative on a sphere.
     */
    double h_inside[2];
    /**
     * The same at boundary vertices.
     */
    double h_boundary[2];
    /**
     * The largest angle, in degrees, between a boundary normal and the triangles of the region there.
     */
    double normal_deviation;
    /**
     * The vertex that has it.
     */
    uint64_t normal_deviation_vertex;
    /**
     * The root mean square of those angles.
     */
    double normal_deviation_rms;
    /**
     * Wall seconds: half-edges and normals.
     */
    double seconds_setup;
    /**
     * The start surface.
     */
    double seconds_start;
    /**
     * The iterations.
     */
    double seconds_iterate;
    /**
     * The figures.
     */
    double seconds_quality;
    /**
     * All of it.
     */
    double seconds_total;
    /**
     * Pairs of intersecting triangles: the list INTERSECTIONS has two entries for each. The search ends at 10000.
     */
    uint64_t intersection_count;
    /**
     * How many pairs there were in the input among the same triangles and the rest of the mesh; 0 if there are none now.
     */
    uint64_t intersections_in_input;
    /**
     * Not 0: intersections were looked for, which is not done if the options say so or if the run was held up.
     */
    uint32_t intersections_checked;
    /**
     * Zero.
     */
    uint32_t reserved;
    /**
     * The largest kink, in degrees: the angle at a boundary vertex between the mean normals of the triangles of the region and
     * of those outside, or where nothing is outside, the boundary normal.
     */
    double boundary_kink;
    /**
     * The same in the input, at the same vertex.
     */
    double boundary_kink_before;
    /**
     * The vertex that has it; of a surface with a BOUNDARY_CREASE, the worst one of the crease.
     */
    uint64_t boundary_kink_vertex;
    /**
     * Size of the list CREASED_VERTICES.
     */
    uint64_t creased_vertex_count;
    /**
     * Components of the region, at least one; see `fairmesh_result_component`, `fairmesh_solver_component`.
     */
    uint64_t component_count;
    /**
     * Of NEAREST_MEMBER the w of its equation Delta_B H = -2 w H (H^2 - K), over 0 and at most 1, of several components the
     * largest; otherwise 0.
     */
    double member_weight;
    /**
     * Bending energy, the integral of H^2 over the free vertices, without unit; the sum of all components.
     */
    double bending_energy;
    /**
     * Sharp edges that reach the boundary, where the options' `sharp` asks for them, see `fairmesh_result_sharp_edge`.
     */
    uint64_t sharp_edge_count;
} fairmesh_report;

/**
 * What went wrong. 256 bytes for ever; the caller's. A parameter of this type may be NULL. Every call writes it (unless it
 * overlaps something else), with
 * status OK, NO_ELEMENT and an empty message when it succeeds.
 */
typedef struct fairmesh_error {
    /**
     * The status that the call returned.
     */
    int32_t status;
    /**
     * A `fairmesh_element`: what the next two numbers count.
     */
    uint32_t element_kind;
    /**
     * The offending element, or FAIRMESH_NO_ELEMENT.
     */
    uint64_t element;
    /**
     * A second one, or FAIRMESH_NO_ELEMENT: of a triangle the index or the vertex that it names wrongly, or the earlier
     * triangle; of an edge its other end; of an argument the offset of the field.
     */
    uint64_t other;
    /**
     * A sentence in English, ending with a NUL; UTF-8.
     */
    char message[232];
} fairmesh_error;

/**
 * One number per vertex to be written.
 */
typedef struct fairmesh_scalars_out {
    /**
     * The first number, aligned as its type. May be NULL only if `count` is 0.
     */
    void *data;
    /**
     * How many numbers there is room for.
     */
    size_t count;
    /**
     * Bytes from one number to the next, a multiple of the number's size; 0: nothing between.
     */
    size_t stride;
    /**
     * A `fairmesh_scalar`.
     */
    uint32_t scalar;
    /**
     * Zero.
     */
    uint32_t reserved;
} fairmesh_scalars_out;

/**
 * A change of what is asked at the boundary. Set it to zero first; what its kind does not need is not read. It never grows.
 */
typedef struct fairmesh_edit {
    /**
     * A `fairmesh_edit_kind`.
     */
    uint32_t kind;
    /**
     * A boundary vertex of the region: which loop a tilt or twist concerns, and where it is strongest.
     */
    uint32_t vertex;
    /**
     * An angle in radians, or the amount of a bulge.
     */
    double amount;
    /**
     * Tilt and twist: how far along the loop from `vertex` they reach, falling off smoothly; 0: the whole loop. Moves: how far along
     * the mesh other fixed vertices follow in part; 0: none does.
     */
    double falloff;
    /**
     * The fixed vertices that are moved, in any order.
     */
    struct fairmesh_indices vertices;
    /**
     * The axis of a rotation, times its angle in radians.
     */
    double rotation[3];
    /**
     * A point on the axis.
     */
    double centre[3];
    /**
     * A translation, after the rotation.
     */
    double translation[3];
} fairmesh_edit;

/**
 * What a frame may cost. Set `struct_size`, all else to zero: no limit.
 */
typedef struct fairmesh_budget {
    /**
     * `sizeof(fairmesh_budget)`.
     */
    uint32_t struct_size;
    /**
     * Zero.
     */
    uint32_t reserved;
    /**
     * Evaluations of the equations at most; 0: no limit.
     */
    uint64_t evaluations;
    /**
     * Seconds, about; 0: no limit. With a limit of seconds the surface depends on the machine.
     */
    double seconds;
    /**
     * The step norm at which a frame is settled, in diagonals; 0: 1e-6.
     */
    double tolerance;
} fairmesh_budget;

/**
 * The surface of a frame. Set `struct_size` before the call.
 */
typedef struct fairmesh_frame {
    /**
     * `sizeof(fairmesh_frame)`.
     */
    uint32_t struct_size;
    /**
     * 1 if its step norm is within the tolerance everywhere, else 0: further updates go on from here.
     */
    uint32_t is_settled;
    /**
     * Evaluations of the equations that it has cost.
     */
    uint64_t evaluations;
    /**
     * Its step norm, in diagonals of the bounding box: how far from the end it is, about. NaN before there is one.
     */
    double step;
} fairmesh_frame;

/**
 * The amounts of a bulge between which sound surfaces were found. Set `struct_size` before the call.
 */
typedef struct fairmesh_bulge_range {
    /**
     * `sizeof(fairmesh_bulge_range)`.
     */
    uint32_t struct_size;
    /**
     * Zero.
     */
    uint32_t reserved;
    /**
     * The smallest, not positive.
     */
    double low;
    /**
     * The largest, not negative.
     */
    double high;
} fairmesh_bulge_range;

/**
 * A step of `fairmesh_select_region`. Set it to zero first; what its kind does not need is not read. It never grows.
 */
typedef struct fairmesh_region_step {
    /**
     * A `fairmesh_region_kind`.
     */
    uint32_t kind;
    /**
     * A `fairmesh_combine`, where the kind names triangles.
     */
    uint32_t combine;
    /**
     * A `fairmesh_seed_kind`, where there is a seed.
     */
    uint32_t seed_kind;
    /**
     * The seed, if it is a vertex.
     */
    uint32_t seed_vertex;
    /**
     * The seed, if it is a point; the centre of a ball, the smallest coordinates of a box, a point of a plane.
     */
    double point[3];
    /**
     * The largest coordinates of a box, the normal of a plane.
     */
    double vector[3];
    /**
     * A radius, an angle in degrees, or about how far a bump reaches.
     */
    double value;
    /**
     * How many rings to grow or shrink by.
     */
    uint64_t rings;
    /**
     * Triangles or vertices, in any order.
     */
    struct fairmesh_indices list;
    /**
     * Zero.
     */
    uint32_t reserved;
    /**
     * Zero.
     */
    uint32_t reserved_too;
} fairmesh_region_step;

/**
 * The sizes of a result. Set `struct_size` before the call.
 */
typedef struct fairmesh_info {
    /**
     * `sizeof(fairmesh_result_info)`.
     */
    uint32_t struct_size;
    /**
     * A `fairmesh_result_kind`.
     */
    uint32_t kind;
    /**
     * Vertices of the mesh; 0 for loops, and for groups of them.
     */
    uint64_t vertex_count;
    /**
     * Triangles of the mesh; 0 for loops and groups of them, and where they are those given.
     */
    uint64_t triangle_count;
    /**
     * The last so many of the vertices are new. Of carried points how many there are.
     */
    uint64_t new_vertex_count;
    /**
     * The last so many of the triangles are new.
     */
    uint64_t new_triangle_count;
    /**
     * Loops found, or filled (those that are joined count once), or left where triangles were erased; of
     * joins the groups, of a bridged mesh the strip and the holes beside it.
     */
    uint64_t loop_count;
    /**
     * Boundary vertices with their normals, see FAIRMESH_VECTORS_BOUNDARY_NORMALS.
     */
    uint64_t boundary_vertex_count;
    /**
     * Of an erased mesh the triangles that were dropped besides those named, because they hung loose; of a trimmed one all that were
     * taken away.
     */
    uint64_t dropped_count;
    /**
     * Of components how many there are.
     */
    uint64_t component_count;
    /**
     * Of an erased mesh the triangles that were dropped because they would spoil the boundary of a patch.
     */
    uint64_t cleaned_count;
    /**
     * Of a trimmed mesh the area of what was taken away.
     */
    double dropped_area;
    /**
     * Not 0: there is nothing to be said of the whole result: what was to be faired converged without reservation, holes that were to be
     * filled are, and not all loops were passed over as outer boundaries; all that was to be rounded is.
     */
    uint32_t is_success;
    /**
     * Zero.
     */
    uint32_t reserved;
    /**
     * Of a rounded mesh its creases before, see `fairmesh_result_crease`.
     */
    uint64_t crease_count;
    /**
     * Of a rounded mesh: edges that bend by more than so many degrees were taken for creases.
     */
    double crease_angle;
} fairmesh_info;

/**
 * What came of one component of the region: free vertices that are connected by edges, or lie around a fixed vertex inside
 * the region whose normal is not given. Components are independent problems, each with the result that it has in a call
 * where it alone is selected, but that sharp edges and curvatures are looked for outside of all. Set `struct_size` before
 * the call.
 */
typedef struct fairmesh_component {
    /**
     * `sizeof(fairmesh_component)`.
     */
    uint32_t struct_size;
    /**
     * A `fairmesh_outcome`.
     */
    uint32_t outcome;
    /**
     * A `fairmesh_loose_reason`: what the outcome CONVERGED_LOOSELY is about.
     */
    uint32_t loose_reason;
    /**
     * Not 0: its surface is that of least bending.
     */
    uint32_t least_bending;
    /**
     * Its free vertex with the smallest index.
     */
    uint64_t vertex;
    /**
     * Its free vertices.
     */
    uint64_t free_vertices;
    /**
     * Nonlinear iterations.
     */
    uint64_t iterations;
    /**
     * Defect of the equation, times its diagonal.
     */
    double defect;
    /**
     * The last step norm, in its diagonals; NaN if there was none.
     */
    double step;
    /**
     * The diagonal of its bounding box, in the unit of the positions.
     */
    double diagonal;
    /**
     * How much of the boundary normals or the target was reached, 0 to 1; 1 where all of it.
     */
    double reached;
    /**
     * Its flipped triangles.
     */
    uint64_t flipped_count;
    /**
     * Its triangles with an angle below one degree.
     */
    uint64_t needle_count;
    /**
     * The smallest angle of its triangles, in degrees.
     */
    double worst_angle;
    /**
     * The triangle that has it.
     */
    uint64_t worst_triangle;
    /**
     * The largest angle, in degrees, between two triangles side by side of which one has a free vertex.
     */
    double sharpest_edge;
    /**
     * The vertex at one end of their edge,
     */
    uint64_t sharpest_edge_from;
    /**
     * and at the other.
     */
    uint64_t sharpest_edge_to;
    /**
     * The smallest and largest mean curvature at its free vertices, in 1 / length; negative on a sphere.
     */
    double h_inside[2];
    /**
     * The same at its boundary vertices.
     */
    double h_boundary[2];
    /**
     * The largest angle, in degrees, between a boundary normal and its triangles there.
     */
    double normal_deviation;
    /**
     * The vertex that has it.
     */
    uint64_t normal_deviation_vertex;
    /**
     * The root mean square of those angles.
     */
    double normal_deviation_rms;
    /**
     * Of NEAREST_MEMBER the w of its equation Delta_B H = -2 w H (H^2 - K), over 0 and at most 1; otherwise 0.
     */
    double member_weight;
    /**
     * Its bending energy, the integral of H^2 over its free vertices, without unit.
     */
    double bending_energy;
    /**
     * Attempts at its surface, see `fairmesh_result_attempt`.
     */
    uint64_t attempt_count;
    /**
     * Boundary loops whose curvature was to be continued, see `fairmesh_result_continuity`, `fairmesh_solver_continuity`; 0 where the
     * options' `continuity` is 0, no loop has surroundings and vertices enough, or no surface was found to begin with.
     */
    uint64_t continuity_count;
} fairmesh_component;

/**
 * An attempt at the surface of a component. Those on the coarse mesh decide where the fine one begins; of two sound surfaces
 * there that differ the one of less bending energy is taken. Set `struct_size` before the call.
 */
typedef struct fairmesh_attempt {
    /**
     * `sizeof(fairmesh_attempt)`.
     */
    uint32_t struct_size;
    /**
     * A `fairmesh_attempt_end`.
     */
    uint32_t end;
    /**
     * The free vertices of its mesh: fewer than the component's on the coarse mesh.
     */
    uint64_t free_vertices;
    /**
     * Nonlinear iterations.
     */
    uint64_t iterations;
    /**
     * The bending energy of its surface, without unit; NaN where it has none.
     */
    double bending_energy;
    /**
     * What was tried, in a few words of English, ending with a NUL.
     */
    char name[48];
} fairmesh_attempt;

/**
 * How far the surface continues the mean curvature of its surroundings along one boundary loop; curvatures in 1 / length. Set
 * `struct_size` before the call.
 */
typedef struct fairmesh_continuity {
    /**
     * `sizeof(fairmesh_continuity)`.
     */
    uint32_t struct_size;
    /**
     * Zero.
     */
    uint32_t reserved;
    /**
     * The boundary vertex of the loop with the smallest index.
     */
    uint64_t vertex;
    /**
     * The vertices of the loop.
     */
    uint64_t vertex_count;
    /**
     * How much of the way to the curvature of the surroundings was asked for; FAIRMESH_CONTINUITY_AUTO: all of it, if it is certain.
     */
    double asked;
    /**
     * How much of the way from the tangent-continuous surface's mean curvature to that of the surroundings was taken, in the mean
     * along the loop: from 0 to `continuity` of the options.
     */
    double reached;
    /**
     * The jump of the mean curvature at the loop of the tangent-continuous surface, root mean square.
     */
    double jump_before;
    /**
     * The largest such jump.
     */
    double largest_jump_before;
    /**
     * The jump of the mean curvature at the loop, root mean square.
     */
    double jump;
    /**
     * The largest jump.
     */
    double largest_jump;
    /**
     * The root mean square of the mean curvature of the surroundings along the loop.
     */
    double curvature;
    /**
     * How uncertain that is, root mean square. Where it is no smaller than `jump_before`, there is nothing to be continued; it is infinite
     * where less than seven rings of triangles are outside to tell it by. Along loops whose jump is too small for
     * `FAIRMESH_CONTINUITY_AUTO` it is what estimates differ by from each other.
     */
    double uncertainty;
} fairmesh_continuity;

/**
 * Ends of sharp edges that belong together, and what became of them. Set `struct_size` before the call.
 */
typedef struct fairmesh_sharp_edge {
    /**
     * `sizeof(fairmesh_sharp_edge)`.
     */
    uint32_t struct_size;
    /**
     * A `fairmesh_sharp_fate`.
     */
    uint32_t fate;
    /**
     * Its ends, one to three, see `fairmesh_result_crease_end`.
     */
    uint64_t end_count;
    /**
     * The vertices along it, from end to end, or from each end to the corner one after the other; 0 where it does not go on. They
     * stand in the list SHARP_VERTICES,
     */
    uint64_t vertex_count;
    /**
     * from this place on.
     */
    uint64_t first_vertex;
} fairmesh_sharp_edge;

/**
 * Where a sharp edge of the surroundings arrives at the boundary of the region. Set `struct_size` before the call.
 */
typedef struct fairmesh_crease_end {
    /**
     * `sizeof(fairmesh_crease_end)`.
     */
    uint32_t struct_size;
    /**
     * Zero.
     */
    uint32_t reserved;
    /**
     * The boundary vertex at which it arrives.
     */
    uint64_t vertex;
    /**
     * The angle between the normals, in degrees: above 0 on a ridge, below on a groove.
     */
    double angle;
    /**
     * The standard error of the angle, in degrees.
     */
    double error;
    /**
     * Unit tangent, into the region.
     */
    double direction[3];
    /**
     * Unit normal of the surface left of it,
     */
    double normal_left[3];
    /**
     * and right of it.
     */
    double normal_right[3];
} fairmesh_crease_end;

/**
 * A boundary loop. Set `struct_size` before the call.
 */
typedef struct fairmesh_loop {
    /**
     * `sizeof(fairmesh_loop)`.
     */
    uint32_t struct_size;
    /**
     * A `fairmesh_loop_kind`.
     */
    uint32_t kind;
    /**
     * Size of the list LOOP_VERTICES.
     */
    uint64_t vertex_count;
    /**
     * Size of the list LOOP_TOUCHING.
     */
    uint64_t touching_count;
    /**
     * The sum of the edge lengths.
     */
    double length;
    /**
     * The length of the vector area.
     */
    double area;
    /**
     * The mean angle, in degrees, by which a smooth surface over the loop has to turn back: 0 for a hole in a plane, 90 for
     * the end of a tube, 180 for the outer boundary of a plane sheet.
     */
    double turn;
    /**
     * The bad edge of a non-manifold or inconsistent loop, otherwise UINT32_MAX.
     */
    uint32_t edge_a;
    /**
     * Its other end.
     */
    uint32_t edge_b;
    /**
     * The component of the mesh that the loop is on, as `fairmesh_components` numbers them.
     */
    uint64_t component;
    /**
     * How many triangles that has.
     */
    uint64_t component_triangle_count;
    /**
     * Not 0: how rough the rim is was asked for (`fairmesh_rim_roughness`) and could be told, as the next seven say; otherwise these are 0.
     * Where the mesh around the loop is too small, it cannot be told.
     */
    uint32_t has_roughness;
    /**
     * Not 0: the rim is noise, and the two advised options below draw it to the surface that the mesh has there on average.
     */
    uint32_t is_rough;
    /**
     * `rim_angle` over `rim_angle_expected`, or over a degree or so, if that is more: about 1 where the mesh is clean.
     */
    double roughness;
    /**
     * The angle between the normals of the triangles at consecutive edges of the loop, in degrees, root mean square.
     */
    double rim_angle;
    /**
     * The angle that is expected there, by the surface fitted to what is around.
     */
    double rim_angle_expected;
    /**
     * The distance of the mesh around from that surface, root mean square.
     */
    double rim_noise;
    /**
     * What is advised for `relax_rim` of the fill options; 0: nothing.
     */
    uint64_t advised_relax_rim;
    /**
     * What is advised for `relax_within`; 0 where nothing is.
     */
    double advised_relax_within;
} fairmesh_loop;

/**
 * What became of a loop. Set `struct_size` before the call.
 */
typedef struct fairmesh_fill_report {
    /**
     * `sizeof(fairmesh_fill_report)`.
     */
    uint32_t struct_size;
    /**
     * A `fairmesh_fill_outcome`.
     */
    uint32_t outcome;
    /**
     * A `fairmesh_fill_reason`.
     */
    uint32_t reason;
    /**
     * The `fairmesh_status` that the fairing was refused with, or OK.
     */
    int32_t refused_status;
    /**
     * The loop, as `fairmesh_boundary_loops` numbers it; of several that are joined the first.
     */
    uint64_t loop_index;
    /**
     * Its edges; of loops that are joined those of all.
     */
    uint64_t edge_count;
    /**
     * The first new vertex, as an index of the filled mesh.
     */
    uint64_t first_vertex;
    /**
     * New vertices.
     */
    uint64_t vertex_count;
    /**
     * The first new triangle, as an index of the filled mesh.
     */
    uint64_t first_triangle;
    /**
     * New triangles.
     */
    uint64_t triangle_count;
    /**
     * The smallest angle of the new triangles, in degrees.
     */
    double worst_angle;
    /**
     * New vertices that lie far outside the loop's bounding box: size of the list OUTSIDE_VERTICES.
     */
    uint64_t outside_count;
    /**
     * Not 0: `max_new_vertices` made the patch coarser.
     */
    uint32_t coarsened;
    /**
     * Not 0: there is a report of the fairing, see `fairmesh_result_report`.
     */
    uint32_t has_report;
    /**
     * Not 0: there is nothing to be said of it: a patch that converged without reservation, or was not to be faired; or a loop that stayed open
     * because it was not asked for.
     */
    uint32_t is_success;
    /**
     * Zero.
     */
    uint32_t reserved;
    /**
     * Wall seconds.
     */
    double seconds;
    /**
     * Pairs of intersecting triangles, at least one of each of this patch: the list INTERSECTIONS has two entries for each.
     */
    uint64_t intersection_count;
    /**
     * The loops that the patch is for: size of the list JOINED_LOOPS, 1 if the loop is not joined to others.
     */
    uint64_t joined_count;
    /**
     * What the reason names: of NON_MANIFOLD and INCONSISTENT one end of the edge, of NOT_FINITE, SHARED_VERTEX and HANGING the vertex, of OPPOSITE_SIDES one of
     * the two loops; otherwise FAIRMESH_NO_ELEMENT.
     */
    uint64_t reason_element;
    /**
     * Of NON_MANIFOLD and INCONSISTENT the other end, of OPPOSITE_SIDES the other loop; otherwise FAIRMESH_NO_ELEMENT.
     */
    uint64_t reason_other;
    /**
     * Where loops were joined by `FAIRMESH_JOIN_KIND_AUTO`, the bend of the joint patch, as in `fairmesh_join_suggestion`; otherwise
     * NaN, as the next three.
     */
    double joint_bend;
    /**
     * That of a patch for each loop.
     */
    double separate_bend;
    /**
     * The area of the joint patch.
     */
    double joint_area;
    /**
     * That of a patch for each loop.
     */
    double separate_area;
    /**
     * 1 where the boundary normals are those asked for. Less where no sound patch has them: so much of the way from the normals of a
     * membrane to the averages of the mesh's.
     */
    double normals_reached;
    /**
     * Where loops were joined by `FAIRMESH_JOIN_KIND_AUTO`, a `fairmesh_gap_kind`: what lies between them.
     */
    uint32_t gap_kind;
    /**
     * Not 0: vertices around the loop were allowed to move (`relax_rim`), and the next five say how far they did; otherwise these are 0.
     */
    uint32_t has_relaxed;
    /**
     * How many vertices of the mesh moved.
     */
    uint64_t moved_count;
    /**
     * How far, root mean square.
     */
    double moved_rms;
    /**
     * How far the one that moved furthest did.
     */
    double moved_largest;
    /**
     * The bound: none moved further.
     */
    double moved_within;
    /**
     * How many triangles at vertices that moved are folded or, of the mesh, intersect since: none in a sound result.
     */
    uint64_t moved_unsound;
} fairmesh_fill_report;

/**
 * Loops whose joint patch bends less than patches of their own would. Bends are sums over all edges of triangulations without new
 * vertices, those of the loops included, of length times angle (radians); edges inside count half. Set `struct_size` before the call.
 */
typedef struct fairmesh_join_suggestion {
    /**
     * `sizeof(fairmesh_join_suggestion)`.
     */
    uint32_t struct_size;
    /**
     * A `fairmesh_gap_kind`: what lies between the loops.
     */
    uint32_t gap_kind;
    /**
     * Size of the list JOINED_LOOPS.
     */
    uint64_t loop_count;
    /**
     * The bend of one patch for all of the loops.
     */
    double joint_bend;
    /**
     * That of a patch for each.
     */
    double separate_bend;
    /**
     * The area of the joint patch.
     */
    double joint_area;
    /**
     * That of the separate ones.
     */
    double separate_area;
} fairmesh_join_suggestion;

/**
 * What became of a bridge. Set `struct_size` before the call.
 */
typedef struct fairmesh_bridge_report {
    /**
     * `sizeof(fairmesh_bridge_report)`.
     */
    uint32_t struct_size;
    /**
     * Not 0: there is a report of the fairing of all that is new together. Unless its outcome is CONVERGED, the strip and the patches
     * beside it are left as they were made.
     */
    uint32_t has_whole;
    /**
     * By how much the strip is twisted from one chain to the other, in degrees between -180 and 180.
     */
    double twist;
    /**
     * Holes beside the strip that were filled, or tried.
     */
    uint64_t rest_count;
} fairmesh_bridge_report;

/**
 * A crease of a mesh that was rounded, from one corner or end to the next. Set `struct_size` before the call.
 */
typedef struct fairmesh_crease {
    /**
     * `sizeof(fairmesh_crease)`.
     */
    uint32_t struct_size;
    /**
     * Not 0: it was rounded.
     */
    uint32_t is_rounded;
    /**
     * Not 0: it was to be rounded and stays sharp, as no sound blend was found.
     */
    uint32_t is_unsolved;
    /**
     * Zero.
     */
    uint32_t reserved;
    /**
     * Size of the list CREASE_VERTICES.
     */
    uint64_t vertex_count;
    /**
     * By how many degrees the surface bends there, in the mean; positive where it is convex.
     */
    double bend;
    /**
     * The least part of the width asked that there is room for along it; 1: all of it.
     */
    double part;
    /**
     * Where that is, on the crease; zero where there is room for all.
     */
    double narrowest[3];
    /**
     * Of an unsolved one the worst place of what was tried, otherwise zero.
     */
    double unsolved[3];
} fairmesh_crease;

/**
 * What was taken for a bump or dent. Set `struct_size` before the call.
 */
typedef struct fairmesh_bump {
    /**
     * `sizeof(fairmesh_bump)`.
     */
    uint32_t struct_size;
    /**
     * Zero.
     */
    uint32_t reserved;
    /**
     * How many triangles it has.
     */
    uint64_t triangle_count;
    /**
     * How far its farthest corner is from the seed, along the surface.
     */
    double radius;
    /**
     * How far the surface lies above the fair one at most, along the normal; a dent's is negative.
     */
    double height;
    /**
     * By how much the fair surface disagrees with that of a slightly larger region and with what surrounds it, over the root mean square of the
     * height: near 0 the bump is told from all around it, from 0.5 on there is none.
     */
    double uncertainty;
} fairmesh_bump;

/**
 * Triangles to be written: three indices at every `stride` bytes.
 */
typedef struct fairmesh_indices_out {
    /**
     * The first index. May be NULL only if `count` is 0.
     */
    uint32_t *data;
    /**
     * How many triangles there is room for.
     */
    size_t count;
    /**
     * Bytes from one triangle to the next, a multiple of 4; 0: nothing between.
     */
    size_t stride;
} fairmesh_indices_out;

#ifdef __cplusplus
extern "C" {
#endif // __cplusplus

/**
 * Hands what the library would write to stderr to a function, for the whole process: the words of a bug that was caught, for which the call
 * answers INTERNAL. `log` may be NULL: to stderr again.
 */
FAIRMESH_API
fairmesh_status fairmesh_set_log(fairmesh_log_fn log,
                                 void *user_data);

/**
 * The version of the library that runs: 65536 major + 256 minor + patch. Compare it with `FAIRMESH_VERSION_MAJOR` and so on,
 * which are those of the header.
 */
FAIRMESH_API
uint32_t fairmesh_version(void);

/**
 * The same as text, such as "0.1.0". Static; never NULL.
 */
FAIRMESH_API const char *fairmesh_version_string(void);

/**
 * Fills options with the defaults. `struct_size` is `sizeof(fairmesh_options)`.
 */
FAIRMESH_API fairmesh_status fairmesh_options_init(struct fairmesh_options *options, size_t struct_size);

/**
 * Fills options of hole filling with the defaults. `struct_size` is `sizeof(fairmesh_fill_options)`.
 */
FAIRMESH_API
fairmesh_status fairmesh_fill_options_init(struct fairmesh_fill_options *options,
                                           size_t struct_size);

/**
 * Fills options of bridges with the defaults. `struct_size` is `sizeof(fairmesh_bridge_options)`.
 */
FAIRMESH_API
fairmesh_status fairmesh_bridge_options_init(struct fairmesh_bridge_options *options,
                                             size_t struct_size);

/**
 * Fills options of rounding with the defaults. `struct_size` is `sizeof(fairmesh_round_options)`.
 */
FAIRMESH_API
fairmesh_status fairmesh_round_options_init(struct fairmesh_round_options *options,
                                            size_t struct_size);

/**
 * Fills options of remeshing with the defaults. `struct_size` is `sizeof(fairmesh_remesh_options)`.
 */
FAIRMESH_API
fairmesh_status fairmesh_remesh_options_init(struct fairmesh_remesh_options *options,
                                             size_t struct_size);

/**
 * What a number that the library answers with is called, what it means, or what can be done about it: English; meanings and remedies
 * begin in lower case and end without a full stop. `answer` is a `fairmesh_answer`, the enumeration of `number`, and `text` a
 * `fairmesh_text`. "unknown" and empty for other numbers. Static; never NULL.
 */
FAIRMESH_API
const char *fairmesh_describe(uint32_t answer,
                              int64_t number,
                              uint32_t text);

/**
 * Moves the free vertices of a mesh until the surface solves Delta_B H = 0, or what the options' target asks, between the
 * fixed vertices, with tangent continuity there.
 *
 * `selection` may be NULL: all vertices that are not on the boundary of the mesh are free. `options` may be NULL: the
 * defaults. `positions_out` gets all vertices, as many as the mesh has; it may be the mesh's own positions (same address,
 * stride and scalar), then only free vertices are written. `report` may be NULL. `result`, which may be NULL, gets a handle with
 * everything else that was found; free it. `positions_out` may be NULL; where it has floats, the output precision is single.
 *
 * The outcome in the report says how it ended; the positions are usable in every case.
 */
FAIRMESH_API
fairmesh_status fairmesh_fair(const struct fairmesh_mesh *mesh,
                              const struct fairmesh_selection *selection,
                              const struct fairmesh_options *options,
                              const struct fairmesh_points_out *positions_out,
                              struct fairmesh_report *report,
                              struct fairmesh_result **result,
                              struct fairmesh_error *error);

/**
 * Mean curvature at every vertex of a mesh, in 1 / length; negative on a sphere with outward normals. `out` gets as many numbers
 * as there are vertices, NaN at vertices without triangles. The mesh need not be a manifold.
 */
FAIRMESH_API
fairmesh_status fairmesh_mean_curvature(const struct fairmesh_mesh *mesh,
                                        const struct fairmesh_scalars_out *out,
                                        struct fairmesh_error *error);

/**
 * Pairs of triangles of a mesh that intersect: that have more in common than a vertex of both or an edge of both, where
 * vertices at the same position are one; also if they only touch. Exact for the positions given. Triangles without area take
 * no part. The mesh need not be a manifold.
 *
 * `among` may be NULL: all pairs. Otherwise triangles, and only pairs with at least one of them. `progress` may be NULL; it gets `user_data`,
 * and where it stops the call the status is CANCELLED. `result` gets a handle, whose list INTERSECTIONS has two entries for each pair, the
 * smaller number first, ascending; free it.
 */
FAIRMESH_API
fairmesh_status fairmesh_self_intersections(const struct fairmesh_mesh *mesh,
                                            const struct fairmesh_indices *among,
                                            fairmesh_progress_fn progress,
                                            void *user_data,
                                            struct fairmesh_result **result,
                                            struct fairmesh_error *error);

/**
 * Makes a solver, which fairs in steps: run some iterations, look, change the normals, the continuity or the target, go on. Arguments as in
 * `fairmesh_fair`; everything is copied except for the callback, which `fairmesh_solver_run` calls. Runs without changes
 * find what `fairmesh_fair` finds, to the last bit. `solver` gets a handle; free it by `fairmesh_solver_free`.
 */
FAIRMESH_API
fairmesh_status fairmesh_solver_new(const struct fairmesh_mesh *mesh,
                                    const struct fairmesh_selection *selection,
                                    const struct fairmesh_options *options,
                                    struct fairmesh_solver **solver,
                                    struct fairmesh_error *error);

/**
 * Runs at most `iterations` nonlinear iterations of each component (at least one), and tells how it stands: the outcome ITERATION_LIMIT or
 * CANCELLED says that a further run goes on from here; after any other one the end is reached, and a further run
 * does nothing until something is changed. `report` may be NULL. On OUT_OF_MEMORY the solver has stopped early; it can go on.
 */
FAIRMESH_API
fairmesh_status fairmesh_solver_run(struct fairmesh_solver *solver,
                                    uint64_t iterations,
                                    struct fairmesh_report *report,
                                    struct fairmesh_error *error);

/**
 * Asks for another value of one option from now on: `setting` is a `fairmesh_setting`, and nothing else of `options` is looked at. NULL: the
 * default. The next run starts at the surface at hand, with the matrices at hand.
 */
FAIRMESH_API
fairmesh_status fairmesh_solver_set(struct fairmesh_solver *solver,
                                    uint32_t setting,
                                    const struct fairmesh_options *options,
                                    struct fairmesh_error *error);

/**
 * All positions as they stand: of the last iteration or frame; before the first one, the input's.
 */
FAIRMESH_API
fairmesh_status fairmesh_solver_positions(const struct fairmesh_solver *solver,
                                          const struct fairmesh_points_out *out,
                                          struct fairmesh_error *error);

/**
 * A copy of everything that is known of the surface as it stands: its report, curvatures, lists, boundary normals. Before the first run the
 * report is of the input. `result` gets a
 * handle of its own; free it.
 */
FAIRMESH_API
fairmesh_status fairmesh_solver_result(const struct fairmesh_solver *solver,
                                       struct fairmesh_result **result,
                                       struct fairmesh_error *error);

/**
 * Frees a solver. NULL is allowed. BUSY while it is in use, also from its own callback; nothing is freed then. In a forked process the solvers of
 * its parent are BAD_HANDLE to all functions, this one too.
 */
FAIRMESH_API
fairmesh_status fairmesh_solver_free(struct fairmesh_solver *solver);

/**
 * Asks for these changes of the boundary: of its normals, and of where fixed vertices are. `edits` are `edit_count` edits, one after the
 * other in memory; NULL only if there are none. They take the place of the edits before and are all relative to what was asked when
 * the solver was made and by the other calls since; no edits: nothing is changed of that. The next update or run starts at the
 * surface at hand, with the matrices at hand.
 */
FAIRMESH_API
fairmesh_status fairmesh_solver_edit(struct fairmesh_solver *solver,
                                     const struct fairmesh_edit *edits,
                                     size_t edit_count,
                                     struct fairmesh_error *error);

/**
 * One frame: goes on until the surface is settled to the tolerance of `limit` or that is used up, and tells how it stands; whether the
 * surface is sound is not looked at. `limit` may be NULL: no limit. With a limit of evaluations alone, the same calls
 * find the same bits. `fairmesh_solver_positions` has the surface. The callback is not called.
 */
FAIRMESH_API
fairmesh_status fairmesh_solver_update(struct fairmesh_solver *solver,
                                       const struct fairmesh_budget *limit,
                                       struct fairmesh_frame *frame,
                                       struct fairmesh_error *error);

/**
 * The converged surface with its report, checked, as a run to the end: within the tolerance that of `fairmesh_fair` with what is asked
 * and edited. `report` may be NULL.
 */
FAIRMESH_API
fairmesh_status fairmesh_solver_finish(struct fairmesh_solver *solver,
                                       struct fairmesh_report *report,
                                       struct fairmesh_error *error);

/**
 * Between which amounts of a bulge, beside the other edits in force, sound surfaces are found: by steps outward from 0. It costs some
 * tens of frames; the surface at hand stays.
 */
FAIRMESH_API
fairmesh_status fairmesh_solver_bulge_range(struct fairmesh_solver *solver,
                                            struct fairmesh_bulge_range *range,
                                            struct fairmesh_error *error);

/**
 * Finds the boundary loops of a mesh: holes and outer boundaries. `result` gets a handle; free it.
 */
FAIRMESH_API
fairmesh_status fairmesh_boundary_loops(const struct fairmesh_mesh *mesh,
                                        struct fairmesh_result **result,
                                        struct fairmesh_error *error);

/**
 * Finds the boundary loops of a mesh as `fairmesh_boundary_loops` does, and how rough their rims are, which takes longer: each
 * `fairmesh_loop` of the result has it, with what is advised for `relax_rim` and `relax_within` of the fill options. `result` gets a handle;
 * free it.
 */
FAIRMESH_API
fairmesh_status fairmesh_rim_roughness(const struct fairmesh_mesh *mesh,
                                       struct fairmesh_result **result,
                                       struct fairmesh_error *error);

/**
 * Fills holes: triangulates, refines and fairs each, or several together. Vertices and triangles given keep their numbers and bits, but for
 * vertices that `relax_rim` lets move; new ones follow. A loop that cannot be filled says so in its report and does not affect the others.
 *
 * `fill` may be NULL: all holes, edges as long as those beside the boundaries. `options` may be NULL: the defaults of the fairing;
 * given normals and curvatures are those of boundary vertices. `result` gets a handle; free it.
 */
FAIRMESH_API
fairmesh_status fairmesh_fill_holes(const struct fairmesh_mesh *mesh,
                                    const struct fairmesh_fill_options *fill,
                                    const struct fairmesh_options *options,
                                    struct fairmesh_result **result,
                                    struct fairmesh_error *error);

/**
 * Finds the loops that `FAIRMESH_JOIN_KIND_AUTO` would give one patch, of those that `fill` asks for, whatever its `join` is. `result` gets
 * a handle with `loop_count` groups, see `fairmesh_result_suggestion` and the list JOINED_LOOPS; free it. `fill` may be NULL.
 */
FAIRMESH_API
fairmesh_status fairmesh_suggest_joins(const struct fairmesh_mesh *mesh,
                                       const struct fairmesh_fill_options *fill,
                                       struct fairmesh_result **result,
                                       struct fairmesh_error *error);

/**
 * Triangulates a region anew, by edge lengths as beside it, without moving the surface. To fair the new mesh, take the list
 * FREE_VERTICES of the result as selection. `selection` and `options` may be NULL. `result` gets a handle; free it.
 */
FAIRMESH_API
fairmesh_status fairmesh_remesh(const struct fairmesh_mesh *mesh,
                                const struct fairmesh_selection *selection,
                                const struct fairmesh_remesh_options *options,
                                struct fairmesh_result **result,
                                struct fairmesh_error *error);

/**
 * How much memory a call takes at most, about, in bytes: `fairmesh_fill_holes` with these arguments, or where `fill` is NULL `fairmesh_fair`,
 * whose `selection` may be NULL, too. As much again is set aside before it works, as address space that is not touched while there is
 * memory; in WebAssembly, where address space is memory, at most 256 MB. What the caller's own arrays take comes on top.
 */
FAIRMESH_API
fairmesh_status fairmesh_memory_needed(const struct fairmesh_mesh *mesh,
                                       const struct fairmesh_selection *selection,
                                       const struct fairmesh_fill_options *fill,
                                       const struct fairmesh_options *options,
                                       uint64_t *bytes,
                                       struct fairmesh_error *error);

/**
 * Deletes a region, and fills the loops that are left, those of each component of the region with one patch: where the shape that it has is of no
 * use, such as an ear of many vertices behind a short boundary. The result is read like that of `fairmesh_remesh`; its new vertices are fair
 * already.
 *
 * NO_FAIR_PATCH where that leads to no fair patch that intersects nothing, where a vertex would be lost that is fixed (inside the region, or
 * without another triangle), where the region lies at a boundary of the mesh, and where the run was stopped.
 *
 * `selection`, `fill` and `options` may be NULL; of `fill` the loops, groups and guides are not looked at. `result` gets a handle; free it.
 */
FAIRMESH_API
fairmesh_status fairmesh_refill(const struct fairmesh_mesh *mesh,
                                const struct fairmesh_selection *selection,
                                const struct fairmesh_fill_options *fill,
                                const struct fairmesh_options *options,
                                struct fairmesh_result **result,
                                struct fairmesh_error *error);

/**
 * Deletes triangles, and what would hang loose where they were, so that new patches can take their place. The list KEPT_TRIANGLES of
 * the result is the mesh that is left, its vertices being those given, used or not; the list ERASED_LOOPS has the loops to be filled
 * there, or joined. `triangles` are the triangles to be deleted.
 *
 * Up to `cleaned` triangles more go with them, those beside what is erased that would spoil the boundary of a patch: with an angle below 5
 * degrees, or turned by more than 100 degrees against a triangle beside them; 0: none. `cleaned_count` of the info says how many did.
 * `result` gets a handle; free it.
 */
FAIRMESH_API
fairmesh_status fairmesh_erase(const struct fairmesh_mesh *mesh,
                               const struct fairmesh_indices *triangles,
                               uint64_t cleaned,
                               struct fairmesh_result **result,
                               struct fairmesh_error *error);

/**
 * Takes away triangles at boundary loops that would spoil a patch: slender ones, with an angle below 5 degrees, spikes and fins, turned by more than
 * 100 degrees against one beside them, and single triangles that hang at the others by one edge; the worst first, then those that this lays
 * bare, in no more than eight passes. No more than `most` triangles, and of no more area than `most_area` together; 0: of any area.
 *
 * `loops` are the loops, as `fairmesh_boundary_loops` numbers them; it may be NULL: all holes, not the outer boundaries. The list KEPT_TRIANGLES
 * of the result is the mesh that is left, its vertices being those given, used or not; loops count anew there. `dropped_count` and
 * `dropped_area` of the info say what was taken away. `result` gets a handle; free it.
 */
FAIRMESH_API
fairmesh_status fairmesh_trim_boundary(const struct fairmesh_mesh *mesh,
                                       const struct fairmesh_indices *loops,
                                       uint64_t most,
                                       double most_area,
                                       struct fairmesh_result **result,
                                       struct fairmesh_error *error);

/**
 * Finds the components of a mesh: triangles that hang together by edges. They count in the order of their first triangles; the list
 * TRIANGLE_COMPONENTS of the result says of each triangle which one it is of. `result` gets a handle; free it.
 */
FAIRMESH_API
fairmesh_status fairmesh_components(const struct fairmesh_mesh *mesh,
                                    struct fairmesh_result **result,
                                    struct fairmesh_error *error);

/**
 * Finds per point the nearest one of some triangles of a mesh: to carry colours and the like over from triangles that were erased to the
 * vertices that took their place. The list CARRIED_TRIANGLES of the result has the triangles, the list PARENTS their corners, and the vectors
 * PARENT_WEIGHTS the weights of these; for a point that is not finite, and where no triangle is, UINT32_MAX, and weights of 0.
 *
 * `among` are the triangles, by their numbers; it may be NULL: all of them. `progress` may be NULL; it gets `user_data`, and where it stops the
 * call the status is CANCELLED. `result` gets a handle, whose `new_vertex_count` is the number of points;
 * free it.
 */
FAIRMESH_API
fairmesh_status fairmesh_carry_over(const struct fairmesh_mesh *mesh,
                                    const struct fairmesh_indices *among,
                                    const struct fairmesh_points *points,
                                    fairmesh_progress_fn progress,
                                    void *user_data,
                                    struct fairmesh_result **result,
                                    struct fairmesh_error *error);

/**
 * Chooses triangles of a mesh by place, distance and shape, step by step, beginning with none; the mesh need not be a manifold.
 * `steps` are `step_count` steps, one after the other in memory; NULL only if there are none. The list REGION_TRIANGLES of the result
 * has the triangles, REGION_COUNTS says per step how many it named by itself, or, of GROW, SHRINK and INVERT, how many there were after
 * it; `fairmesh_result_bump` tells what was taken for bumps. `progress` may be NULL; it gets `user_data`, and where it stops the call the
 * status is CANCELLED. `result` gets a handle; free it.
 */
FAIRMESH_API
fairmesh_status fairmesh_select_region(const struct fairmesh_mesh *mesh,
                                       const struct fairmesh_region_step *steps,
                                       size_t step_count,
                                       fairmesh_progress_fn progress,
                                       void *user_data,
                                       struct fairmesh_result **result,
                                       struct fairmesh_error *error);

/**
 * Connects two runs of boundary edges by a strip that is tangent to the mesh at both, and faired. Each chain is given by its vertices,
 * one after the other, in either direction: at least two, or one if the options have a width. They may be on one loop or on two.
 *
 * `bridge`, `fill` and `options` may be NULL; of `fill` the loops, groups, guides and `relax_rim` are not looked at. `result` gets a handle, whose
 * reports count on from that of the strip, 0, to those of the holes beside it; with `loop_count` of the info
 * `fairmesh_result_report` tells how the fairing of all that is new together went. Free it.
 */
FAIRMESH_API
fairmesh_status fairmesh_bridge(const struct fairmesh_mesh *mesh,
                                const struct fairmesh_indices *from,
                                const struct fairmesh_indices *to,
                                const struct fairmesh_bridge_options *bridge,
                                const struct fairmesh_fill_options *fill,
                                const struct fairmesh_options *options,
                                struct fairmesh_result **result,
                                struct fairmesh_error *error);

/**
 * Rounds the creases of a mesh: in place of each there is a blend, tangent to the faces beside it. Outside of the blends the surface stays where it
 * is; triangles that reach into one are cut. Vertices that are left come first, in their order, then new ones; triangles outside the blends, then
 * those of the blends.
 *
 * `round` needs a width or a radius. `options` may be NULL; its normals, curvature, target, `sharp` and marked edges are not looked at. `result` gets a
 * handle, with one report, 0, of the fairing of all blends. Free it. NO_CREASE where there is nothing to be rounded.
 */
FAIRMESH_API
fairmesh_status fairmesh_round(const struct fairmesh_mesh *mesh,
                               const struct fairmesh_round_options *round,
                               const struct fairmesh_options *options,
                               struct fairmesh_result **result,
                               struct fairmesh_error *error);

/**
 * The sizes of a result.
 */
FAIRMESH_API
fairmesh_status fairmesh_result_info(const struct fairmesh_result *result,
                                     struct fairmesh_info *info,
                                     struct fairmesh_error *error);

/**
 * The report of the fairing: of a faired mesh with `index` 0, of a filled one that of the loop with this number in the result.
 */
FAIRMESH_API
fairmesh_status fairmesh_result_report(const struct fairmesh_result *result,
                                       uint64_t index,
                                       struct fairmesh_report *report,
                                       struct fairmesh_error *error);

/**
 * One component of the region, by its number: they are sorted by their smallest free vertices, and the report with this `index`
 * has `component_count` of them.
 */
FAIRMESH_API
fairmesh_status fairmesh_result_component(const struct fairmesh_result *result,
                                          uint64_t index,
                                          uint64_t number,
                                          struct fairmesh_component *component,
                                          struct fairmesh_error *error);

/**
 * One attempt at the surface of a component, by its number, in the order in which they were made: the component has `attempt_count`
 * of them. `index` and `component` are those of `fairmesh_result_component`.
 */
FAIRMESH_API
fairmesh_status fairmesh_result_attempt(const struct fairmesh_result *result,
                                        uint64_t index,
                                        uint64_t component,
                                        uint64_t number,
                                        struct fairmesh_attempt *attempt,
                                        struct fairmesh_error *error);

/**
 * How far the surface continues the curvature of its surroundings along one boundary loop of a component, by its number: the
 * component has `continuity_count` of them. `index` and `component` are those of `fairmesh_result_component`.
 */
FAIRMESH_API
fairmesh_status fairmesh_result_continuity(const struct fairmesh_result *result,
                                           uint64_t index,
                                           uint64_t component,
                                           uint64_t number,
                                           struct fairmesh_continuity *continuity,
                                           struct fairmesh_error *error);

/**
 * What became of one of the sharp edges that reach the boundary, by its number: the report with this `index` has
 * `sharp_edge_count` of them.
 */
FAIRMESH_API
fairmesh_status fairmesh_result_sharp_edge(const struct fairmesh_result *result,
                                           uint64_t index,
                                           uint64_t number,
                                           struct fairmesh_sharp_edge *edge,
                                           struct fairmesh_error *error);

/**
 * Where a sharp edge arrives at the boundary, by the number of this end: the edge has `end_count` of them. `index` and `edge` are
 * those of `fairmesh_result_sharp_edge`.
 */
FAIRMESH_API
fairmesh_status fairmesh_result_crease_end(const struct fairmesh_result *result,
                                           uint64_t index,
                                           uint64_t edge,
                                           uint64_t number,
                                           struct fairmesh_crease_end *end,
                                           struct fairmesh_error *error);

/**
 * One of the boundary loops.
 */
FAIRMESH_API
fairmesh_status fairmesh_result_loop(const struct fairmesh_result *result,
                                     uint64_t index,
                                     struct fairmesh_loop *boundary_loop,
                                     struct fairmesh_error *error);

/**
 * What became of a loop that was to be filled.
 */
FAIRMESH_API
fairmesh_status fairmesh_result_fill_report(const struct fairmesh_result *result,
                                            uint64_t index,
                                            struct fairmesh_fill_report *report,
                                            struct fairmesh_error *error);

/**
 * One of the groups of loops that would be joined.
 */
FAIRMESH_API
fairmesh_status fairmesh_result_suggestion(const struct fairmesh_result *result,
                                           uint64_t index,
                                           struct fairmesh_join_suggestion *suggestion,
                                           struct fairmesh_error *error);

/**
 * What became of a bridge; its strip's report is that of `fairmesh_result_fill_report` with index 0.
 */
FAIRMESH_API
fairmesh_status fairmesh_result_bridge(const struct fairmesh_result *result,
                                       struct fairmesh_bridge_report *report,
                                       struct fairmesh_error *error);

/**
 * A crease of a mesh that was rounded, by its number, and what became of it: `crease_count` of the info.
 */
FAIRMESH_API
fairmesh_status fairmesh_result_crease(const struct fairmesh_result *result,
                                       uint64_t index,
                                       struct fairmesh_crease *crease,
                                       struct fairmesh_error *error);

/**
 * What was taken for a bump, by its number: one for each step BUMP of `fairmesh_select_region`, in their order.
 */
FAIRMESH_API
fairmesh_status fairmesh_result_bump(const struct fairmesh_result *result,
                                     uint64_t index,
                                     struct fairmesh_bump *bump,
                                     struct fairmesh_error *error);

/**
 * The positions of all vertices: `vertex_count` of the info.
 */
FAIRMESH_API
fairmesh_status fairmesh_result_positions(const struct fairmesh_result *result,
                                          const struct fairmesh_points_out *out,
                                          struct fairmesh_error *error);

/**
 * All triangles of a filled or remeshed mesh: `triangle_count` of the info.
 */
FAIRMESH_API
fairmesh_status fairmesh_result_triangles(const struct fairmesh_result *result,
                                          const struct fairmesh_indices_out *out,
                                          struct fairmesh_error *error);

/**
 * Numbers per vertex, `which` being a `fairmesh_scalars`: `vertex_count` of the info.
 */
FAIRMESH_API
fairmesh_status fairmesh_result_scalars(const struct fairmesh_result *result,
                                        uint32_t which,
                                        const struct fairmesh_scalars_out *out,
                                        struct fairmesh_error *error);

/**
 * Vectors, `which` being a `fairmesh_vectors`: as many as the list that they belong to has vertices.
 */
FAIRMESH_API
fairmesh_status fairmesh_result_vectors(const struct fairmesh_result *result,
                                        uint32_t which,
                                        const struct fairmesh_points_out *out,
                                        struct fairmesh_error *error);

/**
 * A list of indices, `which` being a `fairmesh_list`, of the report or loop with this index (0 where there is one). `size` gets
 * its size. With `out` NULL and `capacity` 0 that is all; otherwise BUFFER_TOO_SMALL if it does not fit into `capacity`.
 */
FAIRMESH_API
fairmesh_status fairmesh_result_list(const struct fairmesh_result *result,
                                     uint32_t which,
                                     uint64_t index,
                                     uint32_t *out,
                                     size_t capacity,
                                     size_t *size,
                                     struct fairmesh_error *error);

/**
 * Frees a result. NULL is allowed.
 */
FAIRMESH_API fairmesh_status fairmesh_result_free(struct fairmesh_result *result);

#ifdef __cplusplus
}  // extern "C"
#endif  // __cplusplus

#endif  /* FAIRMESH_H */
