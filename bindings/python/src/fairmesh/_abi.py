"""The C interface, declared: every enumeration, struct and function of ``include/fairmesh.h``, under its C name.

Made of src/capi by src/declarations when the package is built.
"""

from __future__ import annotations

import enum
from ctypes import (
    CFUNCTYPE,
    POINTER,
    Structure,
    c_char,
    c_char_p,
    c_double,
    c_int32,
    c_size_t,
    c_uint32,
    c_uint64,
    c_void_p,
)
from typing import Any

NO_ELEMENT = 2**64 - 1
VERSION_MAJOR = 0
VERSION_MINOR = 1
VERSION_PATCH = 0


class fairmesh_status(enum.IntEnum):
    OK = 0
    NULL_POINTER = 1
    MISALIGNED = 2
    BAD_STRUCT_SIZE = 3
    BAD_OPTION = 4
    BAD_ENUM = 5
    BAD_STRIDE = 6
    COUNT_OVERFLOW = 7
    COUNT_MISMATCH = 8
    ALIASING = 9
    BAD_HANDLE = 10
    BUSY = 11
    OUT_OF_MEMORY = 12
    THREADS = 13
    TOO_LARGE = 14
    NOT_FINITE = 15
    INDEX_OUT_OF_RANGE = 16
    REPEATED_INDEX = 17
    DUPLICATE_TRIANGLE = 18
    NON_MANIFOLD_EDGE = 19
    NON_MANIFOLD_VERTEX = 20
    INCONSISTENT_ORIENTATION = 21
    FREE_VERTEX_ON_BOUNDARY = 22
    FREE_VERTEX_WITHOUT_TRIANGLE = 23
    NOTHING_FIXED = 24
    EMPTY_REGION = 25
    SELECTION_OUT_OF_RANGE = 26
    BAD_NORMAL = 27
    NO_NORMAL = 28
    NOT_AVAILABLE = 29
    BUFFER_TOO_SMALL = 30
    BAD_RESERVED = 31
    COORDINATE_TOO_LARGE = 32
    VALENCE_TOO_LARGE = 33
    NOT_ON_LOOP = 34
    BAD_GUIDE = 35
    GUIDES_CROSS = 36
    BAD_CHAIN = 37
    NO_FAIR_PATCH = 38
    NO_BUMP = 39
    BAD_EDIT = 40
    INTERNAL = 99


class fairmesh_outcome(enum.IntEnum):
    CONVERGED = 0
    CONVERGED_POOR_TRIANGLES = 1
    CONVERGED_LOOSELY = 2
    TARGET_NOT_REACHABLE = 4
    NOT_CONVERGED = 5
    ITERATION_LIMIT = 6
    CANCELLED = 7
    BOUNDARY_CREASE = 8
    SELF_INTERSECTING = 9
    POOR_WHEN_ROUNDED = 10
    NEAREST_MEMBER = 11


class fairmesh_loose_reason(enum.IntEnum):
    NONE = 0
    SUSPICIOUS_NORMALS = 1
    ROUNDING = 2
    BUMP = 4
    TOLERANCE = 5
    DRAWN_NORMALS = 6


class fairmesh_attempt_end(enum.IntEnum):
    SOUND = 0
    UNSOUND = 1
    NOT_CONVERGED = 2
    STOPPED = 3


class fairmesh_fill_outcome(enum.IntEnum):
    FAIRED = 0
    LINEAR = 1
    FLAT = 2
    LEFT_OPEN = 3
    SELF_INTERSECTING = 4


class fairmesh_fill_reason(enum.IntEnum):
    NONE = 0
    NON_MANIFOLD = 1
    OUTER_BOUNDARY = 2
    TOO_MANY_EDGES = 3
    NO_TRIANGULATION = 4
    NOT_FINITE = 5
    CANCELLED = 6
    OPPOSITE_SIDES = 7
    SHARED_VERTEX = 8
    NOT_ASKED_FOR = 9
    NOT_FAIR = 10
    INTERSECTS = 11
    NOT_ASKED = 32
    NO_INNER_VERTEX = 33
    REFUSED = 34
    UNSOUND = 35
    INTERSECTING = 36


class fairmesh_loop_kind(enum.IntEnum):
    HOLE = 0
    OUTER_BOUNDARY = 1
    NON_MANIFOLD = 2


class fairmesh_join_kind(enum.IntEnum):
    NONE = 0
    GROUPS = 1
    AUTO = 2


class fairmesh_gap_kind(enum.IntEnum):
    GAP = 0
    TUNNEL = 1
    ISLAND = 2


class fairmesh_on_failure(enum.IntEnum):
    LINEAR = 0
    FLAT = 1
    OPEN = 2


class fairmesh_place_kind(enum.IntEnum):
    EVERYWHERE = 0
    BALL = 1
    BOX = 2


class fairmesh_boundary_normals_kind(enum.IntEnum):
    FITTED = 0
    AVERAGED = 1
    GIVEN = 2


class fairmesh_interior_normals(enum.IntEnum):
    SMOOTH = 0
    INPUT = 1


class fairmesh_coincident(enum.IntEnum):
    JOIN = 0
    SEPARATE = 1


class fairmesh_target_kind(enum.IntEnum):
    HARMONIC = 0
    CONSTANT = 1
    MINIMAL_ENERGY = 2


class fairmesh_inner_fairness(enum.IntEnum):
    UNIFORM = 0
    CONFORMAL = 1
    CONVEX = 2


class fairmesh_output_precision(enum.IntEnum):
    DOUBLE = 0
    SINGLE = 1


class fairmesh_discretization(enum.IntEnum):
    SECOND_ORDER = 0
    PAPER = 1


class fairmesh_solver_kind(enum.IntEnum):
    FAST = 0
    PAPER = 1


class fairmesh_estimate(enum.IntEnum):
    ALTERNATING = 0
    GAUSS_SEIDEL = 1
    CONJUGATE_GRADIENTS = 2


class fairmesh_intersections(enum.IntEnum):
    CHECK = 0
    SKIP = 1


class fairmesh_element(enum.IntEnum):
    NONE = 0
    VERTEX = 1
    TRIANGLE = 2
    EDGE = 3
    ARGUMENT = 4
    LOOP = 5


class fairmesh_scalar(enum.IntEnum):
    FLOAT32 = 1
    FLOAT64 = 2


class fairmesh_selection_kind(enum.IntEnum):
    INTERIOR = 0
    FREE_MASK = 1
    FIXED_MASK = 2
    FREE_VERTICES = 3
    FACES = 4


class fairmesh_boundary_curvature_kind(enum.IntEnum):
    ESTIMATED = 0
    GIVEN = 1


class fairmesh_result_kind(enum.IntEnum):
    FAIRED = 0
    LOOPS = 1
    FILLED = 2
    REMESHED = 3
    INTERSECTIONS = 4
    JOINS = 5
    ERASED = 6
    COMPONENTS = 7
    BRIDGED = 8
    TRIMMED = 9
    CARRIED = 10
    REGION = 11


class fairmesh_list(enum.IntEnum):
    POOR_TRIANGLES = 0
    FLIPPED_TRIANGLES = 1
    NEEDLES = 2
    SUSPICIOUS_NORMALS = 3
    INTERSECTIONS = 5
    CREASED_VERTICES = 6
    BOUNDARY_VERTICES = 16
    LOOP_VERTICES = 32
    LOOP_TOUCHING = 33
    OUTSIDE_VERTICES = 48
    PARENTS = 49
    JOINED_LOOPS = 50
    FREE_VERTICES = 64
    KEPT_VERTICES = 65
    KEPT_TRIANGLES = 66
    ERASED_LOOPS = 80
    TRIANGLE_COMPONENTS = 96
    BRIDGE_CHAIN = 112
    BRIDGE_SIDE = 113
    CARRIED_TRIANGLES = 128
    REGION_TRIANGLES = 144
    REGION_COUNTS = 145


class fairmesh_vectors(enum.IntEnum):
    BOUNDARY_NORMALS = 0
    PARENT_WEIGHTS = 1


class fairmesh_scalars(enum.IntEnum):
    MEAN_CURVATURE = 0
    GAUSSIAN_CURVATURE = 1


class fairmesh_edit_kind(enum.IntEnum):
    TILT = 1
    TWIST = 2
    BULGE = 3
    MOVE = 4


class fairmesh_region_kind(enum.IntEnum):
    ALL = 0
    TRIANGLES = 1
    VERTICES = 2
    BALL = 3
    BOX = 4
    HALF_SPACE = 5
    GEODESIC = 6
    COMPONENT = 7
    PATCH = 8
    BUMP = 9
    GROW = 32
    SHRINK = 33
    INVERT = 34


class fairmesh_combine(enum.IntEnum):
    ADD = 0
    REMOVE = 1
    INTERSECT = 2


class fairmesh_seed_kind(enum.IntEnum):
    POINT = 0
    VERTEX = 1


class fairmesh_error(Structure):
    _fields_ = (
        ("status", c_int32),
        ("element_kind", c_uint32),
        ("element", c_uint64),
        ("other", c_uint64),
        ("message", c_char * 232),
    )


class fairmesh_points(Structure):
    _fields_ = (
        ("data", c_void_p),
        ("count", c_size_t),
        ("stride", c_size_t),
        ("scalar", c_uint32),
        ("reserved", c_uint32),
    )


class fairmesh_numbers(Structure):
    _fields_ = (
        ("data", c_void_p),
        ("count", c_size_t),
        ("stride", c_size_t),
        ("scalar", c_uint32),
        ("reserved", c_uint32),
    )


class fairmesh_points_out(Structure):
    _fields_ = (
        ("data", c_void_p),
        ("count", c_size_t),
        ("stride", c_size_t),
        ("scalar", c_uint32),
        ("reserved", c_uint32),
    )


class fairmesh_scalars_out(Structure):
    _fields_ = (
        ("data", c_void_p),
        ("count", c_size_t),
        ("stride", c_size_t),
        ("scalar", c_uint32),
        ("reserved", c_uint32),
    )


class fairmesh_indices(Structure):
    _fields_ = (
        ("data", c_void_p),
        ("count", c_size_t),
        ("stride", c_size_t),
    )


class fairmesh_indices_out(Structure):
    _fields_ = (
        ("data", c_void_p),
        ("count", c_size_t),
        ("stride", c_size_t),
    )


class fairmesh_mesh(Structure):
    _fields_ = (
        ("struct_size", c_uint32),
        ("coincident", c_uint32),
        ("positions", fairmesh_points),
        ("triangles", fairmesh_indices),
        ("coincident_within", c_double),
    )


class fairmesh_selection(Structure):
    _fields_ = (
        ("struct_size", c_uint32),
        ("kind", c_uint32),
        ("data", c_void_p),
        ("count", c_size_t),
        ("stride", c_size_t),
    )


class fairmesh_boundary_normals(Structure):
    _fields_ = (
        ("kind", c_uint32),
        ("reserved", c_uint32),
        ("vectors", fairmesh_points),
        ("vertices", fairmesh_indices),
    )


class fairmesh_boundary_curvature(Structure):
    _fields_ = (
        ("kind", c_uint32),
        ("reserved", c_uint32),
        ("values", fairmesh_numbers),
        ("vertices", fairmesh_indices),
    )


class fairmesh_loop_continuity(Structure):
    _fields_ = (
        ("values", fairmesh_numbers),
        ("vertices", fairmesh_indices),
    )


class fairmesh_target(Structure):
    _fields_ = (
        ("kind", c_uint32),
        ("reserved", c_uint32),
        ("constant", c_double),
    )


class fairmesh_report(Structure):
    _fields_ = (
        ("struct_size", c_uint32),
        ("outcome", c_uint32),
        ("loose_reason", c_uint32),
        ("linear_surface", c_uint32),
        ("iterations", c_uint64),
        ("defect", c_double),
        ("step", c_double),
        ("diagonal", c_double),
        ("reached", c_double),
        ("free_vertices", c_uint64),
        ("level_count", c_uint64),
        ("fallback_weights", c_uint64),
        ("poor_triangle_count", c_uint64),
        ("flipped_count", c_uint64),
        ("needle_count", c_uint64),
        ("suspicious_normal_count", c_uint64),
        ("worst_angle", c_double),
        ("worst_triangle", c_uint64),
        ("h_inside", c_double * 2),
        ("h_boundary", c_double * 2),
        ("normal_deviation", c_double),
        ("normal_deviation_vertex", c_uint64),
        ("normal_deviation_rms", c_double),
        ("seconds_setup", c_double),
        ("seconds_start", c_double),
        ("seconds_iterate", c_double),
        ("seconds_quality", c_double),
        ("seconds_total", c_double),
        ("intersection_count", c_uint64),
        ("intersections_in_input", c_uint64),
        ("intersections_checked", c_uint32),
        ("reserved", c_uint32),
        ("boundary_kink", c_double),
        ("boundary_kink_before", c_double),
        ("boundary_kink_vertex", c_uint64),
        ("creased_vertex_count", c_uint64),
        ("component_count", c_uint64),
        ("member_weight", c_double),
        ("bending_energy", c_double),
    )


class fairmesh_component(Structure):
    _fields_ = (
        ("struct_size", c_uint32),
        ("outcome", c_uint32),
        ("loose_reason", c_uint32),
        ("linear_surface", c_uint32),
        ("vertex", c_uint64),
        ("free_vertices", c_uint64),
        ("iterations", c_uint64),
        ("defect", c_double),
        ("step", c_double),
        ("diagonal", c_double),
        ("reached", c_double),
        ("flipped_count", c_uint64),
        ("needle_count", c_uint64),
        ("worst_angle", c_double),
        ("worst_triangle", c_uint64),
        ("h_inside", c_double * 2),
        ("h_boundary", c_double * 2),
        ("normal_deviation", c_double),
        ("normal_deviation_vertex", c_uint64),
        ("normal_deviation_rms", c_double),
        ("member_weight", c_double),
        ("bending_energy", c_double),
        ("attempt_count", c_uint64),
        ("continuity_count", c_uint64),
    )


class fairmesh_attempt(Structure):
    _fields_ = (
        ("struct_size", c_uint32),
        ("end", c_uint32),
        ("free_vertices", c_uint64),
        ("iterations", c_uint64),
        ("bending_energy", c_double),
        ("name", c_char * 48),
    )


class fairmesh_continuity(Structure):
    _fields_ = (
        ("struct_size", c_uint32),
        ("reserved", c_uint32),
        ("vertex", c_uint64),
        ("vertex_count", c_uint64),
        ("reached", c_double),
        ("jump_before", c_double),
        ("largest_jump_before", c_double),
        ("jump", c_double),
        ("largest_jump", c_double),
        ("curvature", c_double),
        ("uncertainty", c_double),
    )


class fairmesh_level(Structure):
    _fields_ = (
        ("struct_size", c_uint32),
        ("reserved", c_uint32),
        ("vertices", c_uint64),
        ("triangles", c_uint64),
        ("updates", c_uint64),
        ("defect", c_double),
    )


class fairmesh_info(Structure):
    _fields_ = (
        ("struct_size", c_uint32),
        ("kind", c_uint32),
        ("vertex_count", c_uint64),
        ("triangle_count", c_uint64),
        ("new_vertex_count", c_uint64),
        ("new_triangle_count", c_uint64),
        ("loop_count", c_uint64),
        ("boundary_vertex_count", c_uint64),
        ("dropped_count", c_uint64),
        ("component_count", c_uint64),
        ("cleaned_count", c_uint64),
        ("dropped_area", c_double),
    )


class fairmesh_bump(Structure):
    _fields_ = (
        ("struct_size", c_uint32),
        ("reserved", c_uint32),
        ("triangle_count", c_uint64),
        ("radius", c_double),
        ("departure", c_double),
        ("surroundings", c_double),
        ("scatter", c_double),
    )


class fairmesh_loop(Structure):
    _fields_ = (
        ("struct_size", c_uint32),
        ("kind", c_uint32),
        ("vertex_count", c_uint64),
        ("touching_count", c_uint64),
        ("length", c_double),
        ("area", c_double),
        ("turn", c_double),
        ("edge_a", c_uint32),
        ("edge_b", c_uint32),
        ("component", c_uint64),
        ("component_triangle_count", c_uint64),
        ("has_roughness", c_uint32),
        ("is_rough", c_uint32),
        ("roughness", c_double),
        ("rim_angle", c_double),
        ("rim_angle_expected", c_double),
        ("rim_noise", c_double),
        ("advised_relax_rim", c_uint64),
        ("advised_relax_within", c_double),
    )


class fairmesh_join_suggestion(Structure):
    _fields_ = (
        ("struct_size", c_uint32),
        ("gap_kind", c_uint32),
        ("loop_count", c_uint64),
        ("joint_bend", c_double),
        ("separate_bend", c_double),
        ("joint_area", c_double),
        ("separate_area", c_double),
    )


class fairmesh_fill_report(Structure):
    _fields_ = (
        ("struct_size", c_uint32),
        ("outcome", c_uint32),
        ("reason", c_uint32),
        ("refused_status", c_int32),
        ("loop_index", c_uint64),
        ("edge_count", c_uint64),
        ("first_vertex", c_uint64),
        ("vertex_count", c_uint64),
        ("first_triangle", c_uint64),
        ("triangle_count", c_uint64),
        ("worst_angle", c_double),
        ("outside_count", c_uint64),
        ("coarsened", c_uint32),
        ("has_report", c_uint32),
        ("seconds", c_double),
        ("intersection_count", c_uint64),
        ("joined_count", c_uint64),
        ("reason_element", c_uint64),
        ("reason_other", c_uint64),
        ("joint_bend", c_double),
        ("separate_bend", c_double),
        ("joint_area", c_double),
        ("separate_area", c_double),
        ("normals_reached", c_double),
        ("gap_kind", c_uint32),
        ("has_relaxed", c_uint32),
        ("moved_count", c_uint64),
        ("moved_rms", c_double),
        ("moved_largest", c_double),
        ("moved_within", c_double),
        ("moved_unsound", c_uint64),
    )


class fairmesh_bridge_report(Structure):
    _fields_ = (
        ("struct_size", c_uint32),
        ("is_clean", c_uint32),
        ("has_whole", c_uint32),
        ("reserved", c_uint32),
        ("twist", c_double),
        ("rest_count", c_uint64),
    )


class fairmesh_progress(Structure):
    _fields_ = (
        ("struct_size", c_uint32),
        ("reserved", c_uint32),
        ("fraction", c_double),
        ("iterations", c_uint64),
        ("step", c_double),
        ("phase", c_char_p),
    )


fairmesh_progress_fn = CFUNCTYPE(c_int32, POINTER(fairmesh_progress), c_void_p)


class fairmesh_join(Structure):
    _fields_ = (
        ("kind", c_uint32),
        ("reserved", c_uint32),
        ("loops", fairmesh_indices),
        ("starts", fairmesh_indices),
    )


class fairmesh_place(Structure):
    _fields_ = (
        ("kind", c_uint32),
        ("reserved", c_uint32),
        ("centre", c_double * 3),
        ("radius", c_double),
        ("low", c_double * 3),
        ("high", c_double * 3),
    )


class fairmesh_loop_filter(Structure):
    _fields_ = (
        ("max_length", c_double),
        ("max_area", c_double),
        ("max_diagonal", c_double),
        ("except_longest", c_uint64),
        ("components", fairmesh_indices),
        ("within", fairmesh_place),
    )


class fairmesh_options(Structure):
    _fields_ = (
        ("struct_size", c_uint32),
        ("interior_normals", c_uint32),
        ("inner_fairness", c_uint32),
        ("discretization", c_uint32),
        ("solver", c_uint32),
        ("output_precision", c_uint32),
        ("threads", c_uint32),
        ("intersections", c_uint32),
        ("paper_estimate", c_uint32),
        ("paper_estimate_iterations", c_uint32),
        ("boundary_normals", fairmesh_boundary_normals),
        ("continuity", c_double),
        ("loop_continuity", fairmesh_loop_continuity),
        ("boundary_curvature", fairmesh_boundary_curvature),
        ("target", fairmesh_target),
        ("tolerance", c_double),
        ("max_iterations", c_uint64),
        ("paper_damping", c_double),
        ("paper_levels", c_uint64),
        ("paper_base", c_uint64),
        ("paper_defect", c_double),
        ("paper_laplacian", c_double),
        ("paper_max_updates", c_uint64),
        ("progress", fairmesh_progress_fn),
        ("user_data", c_void_p),
    )


class fairmesh_fill_options(Structure):
    _fields_ = (
        ("struct_size", c_uint32),
        ("on_failure", c_uint32),
        ("fair", c_uint32),
        ("only_listed", c_uint32),
        ("join", fairmesh_join),
        ("guides", fairmesh_indices),
        ("density", c_double),
        ("max_new_vertices", c_uint64),
        ("relax_rim", c_uint64),
        ("relax_within", c_double),
        ("max_edges", c_uint64),
        ("loops", fairmesh_indices),
        ("filter", fairmesh_loop_filter),
    )


class fairmesh_bridge_options(Structure):
    _fields_ = (
        ("struct_size", c_uint32),
        ("fill", c_uint32),
        ("width", c_double),
    )


class fairmesh_remesh_options(Structure):
    _fields_ = (
        ("struct_size", c_uint32),
        ("reserved", c_uint32),
        ("density", c_double),
        ("max_vertices", c_uint64),
    )


class fairmesh_edit(Structure):
    _fields_ = (
        ("kind", c_uint32),
        ("vertex", c_uint32),
        ("amount", c_double),
        ("falloff", c_double),
        ("vertices", fairmesh_indices),
        ("rotation", c_double * 3),
        ("centre", c_double * 3),
        ("translation", c_double * 3),
    )


class fairmesh_budget(Structure):
    _fields_ = (
        ("struct_size", c_uint32),
        ("reserved", c_uint32),
        ("evaluations", c_uint64),
        ("seconds", c_double),
        ("tolerance", c_double),
    )


class fairmesh_frame(Structure):
    _fields_ = (
        ("struct_size", c_uint32),
        ("is_settled", c_uint32),
        ("evaluations", c_uint64),
        ("step", c_double),
    )


class fairmesh_bulge_range(Structure):
    _fields_ = (
        ("struct_size", c_uint32),
        ("reserved", c_uint32),
        ("low", c_double),
        ("high", c_double),
    )


class fairmesh_region_step(Structure):
    _fields_ = (
        ("kind", c_uint32),
        ("combine", c_uint32),
        ("seed_kind", c_uint32),
        ("seed_vertex", c_uint32),
        ("point", c_double * 3),
        ("vector", c_double * 3),
        ("value", c_double),
        ("rings", c_uint64),
        ("list", fairmesh_indices),
        ("reserved", c_uint32),
        ("reserved_too", c_uint32),
    )


# A function's name: what it returns, and its parameters. Handles, and arrays in parameters, are plain addresses.
FUNCTIONS: dict[str, tuple[Any, tuple[Any, ...]]] = {
    "fairmesh_status_name": (c_char_p, (c_int32,)),
    "fairmesh_status_text": (c_char_p, (c_int32,)),
    "fairmesh_status_remedy": (c_char_p, (c_int32,)),
    "fairmesh_outcome_name": (c_char_p, (c_uint32,)),
    "fairmesh_outcome_text": (c_char_p, (c_uint32,)),
    "fairmesh_outcome_remedy": (c_char_p, (c_uint32,)),
    "fairmesh_loose_reason_name": (c_char_p, (c_uint32,)),
    "fairmesh_loose_reason_text": (c_char_p, (c_uint32,)),
    "fairmesh_loose_reason_remedy": (c_char_p, (c_uint32,)),
    "fairmesh_attempt_end_name": (c_char_p, (c_uint32,)),
    "fairmesh_attempt_end_text": (c_char_p, (c_uint32,)),
    "fairmesh_attempt_end_remedy": (c_char_p, (c_uint32,)),
    "fairmesh_fill_outcome_name": (c_char_p, (c_uint32,)),
    "fairmesh_fill_outcome_text": (c_char_p, (c_uint32,)),
    "fairmesh_fill_outcome_remedy": (c_char_p, (c_uint32,)),
    "fairmesh_fill_reason_name": (c_char_p, (c_uint32,)),
    "fairmesh_fill_reason_text": (c_char_p, (c_uint32,)),
    "fairmesh_fill_reason_remedy": (c_char_p, (c_uint32,)),
    "fairmesh_version": (c_uint32, ()),
    "fairmesh_version_string": (c_char_p, ()),
    "fairmesh_options_init": (
        c_int32,
        (
            POINTER(fairmesh_options),
            c_size_t,
        ),
    ),
    "fairmesh_fill_options_init": (
        c_int32,
        (
            POINTER(fairmesh_fill_options),
            c_size_t,
        ),
    ),
    "fairmesh_bridge_options_init": (
        c_int32,
        (
            POINTER(fairmesh_bridge_options),
            c_size_t,
        ),
    ),
    "fairmesh_remesh_options_init": (
        c_int32,
        (
            POINTER(fairmesh_remesh_options),
            c_size_t,
        ),
    ),
    "fairmesh_fair": (
        c_int32,
        (
            POINTER(fairmesh_mesh),
            POINTER(fairmesh_selection),
            POINTER(fairmesh_options),
            POINTER(fairmesh_points_out),
            POINTER(fairmesh_report),
            POINTER(c_void_p),
            POINTER(fairmesh_error),
        ),
    ),
    "fairmesh_mean_curvature": (
        c_int32,
        (
            POINTER(fairmesh_mesh),
            POINTER(fairmesh_scalars_out),
            POINTER(fairmesh_error),
        ),
    ),
    "fairmesh_self_intersections": (
        c_int32,
        (
            POINTER(fairmesh_mesh),
            POINTER(fairmesh_indices),
            POINTER(c_void_p),
            POINTER(fairmesh_error),
        ),
    ),
    "fairmesh_solver_new": (
        c_int32,
        (
            POINTER(fairmesh_mesh),
            POINTER(fairmesh_selection),
            POINTER(fairmesh_options),
            POINTER(c_void_p),
            POINTER(fairmesh_error),
        ),
    ),
    "fairmesh_solver_run": (
        c_int32,
        (
            c_void_p,
            c_uint64,
            POINTER(fairmesh_report),
            POINTER(fairmesh_error),
        ),
    ),
    "fairmesh_solver_set_boundary_normals": (
        c_int32,
        (
            c_void_p,
            POINTER(fairmesh_boundary_normals),
            POINTER(fairmesh_error),
        ),
    ),
    "fairmesh_solver_set_target": (
        c_int32,
        (
            c_void_p,
            POINTER(fairmesh_target),
            POINTER(fairmesh_error),
        ),
    ),
    "fairmesh_solver_set_continuity": (
        c_int32,
        (
            c_void_p,
            c_double,
            POINTER(fairmesh_loop_continuity),
            POINTER(fairmesh_error),
        ),
    ),
    "fairmesh_solver_set_boundary_curvature": (
        c_int32,
        (
            c_void_p,
            POINTER(fairmesh_boundary_curvature),
            POINTER(fairmesh_error),
        ),
    ),
    "fairmesh_solver_positions": (
        c_int32,
        (
            c_void_p,
            POINTER(fairmesh_points_out),
            POINTER(fairmesh_error),
        ),
    ),
    "fairmesh_solver_mean_curvature": (
        c_int32,
        (
            c_void_p,
            POINTER(fairmesh_scalars_out),
            POINTER(fairmesh_error),
        ),
    ),
    "fairmesh_solver_report": (
        c_int32,
        (
            c_void_p,
            POINTER(fairmesh_report),
            POINTER(fairmesh_error),
        ),
    ),
    "fairmesh_solver_component": (
        c_int32,
        (
            c_void_p,
            c_uint64,
            POINTER(fairmesh_component),
            POINTER(fairmesh_error),
        ),
    ),
    "fairmesh_solver_attempt": (
        c_int32,
        (
            c_void_p,
            c_uint64,
            c_uint64,
            POINTER(fairmesh_attempt),
            POINTER(fairmesh_error),
        ),
    ),
    "fairmesh_solver_continuity": (
        c_int32,
        (
            c_void_p,
            c_uint64,
            c_uint64,
            POINTER(fairmesh_continuity),
            POINTER(fairmesh_error),
        ),
    ),
    "fairmesh_solver_result": (
        c_int32,
        (
            c_void_p,
            POINTER(c_void_p),
            POINTER(fairmesh_error),
        ),
    ),
    "fairmesh_solver_free": (c_int32, (c_void_p,)),
    "fairmesh_solver_edit": (
        c_int32,
        (
            c_void_p,
            POINTER(fairmesh_edit),
            c_size_t,
            POINTER(fairmesh_error),
        ),
    ),
    "fairmesh_solver_update": (
        c_int32,
        (
            c_void_p,
            POINTER(fairmesh_budget),
            POINTER(fairmesh_frame),
            POINTER(fairmesh_error),
        ),
    ),
    "fairmesh_solver_finish": (
        c_int32,
        (
            c_void_p,
            POINTER(fairmesh_report),
            POINTER(fairmesh_error),
        ),
    ),
    "fairmesh_solver_bulge_range": (
        c_int32,
        (
            c_void_p,
            POINTER(fairmesh_bulge_range),
            POINTER(fairmesh_error),
        ),
    ),
    "fairmesh_boundary_loops": (
        c_int32,
        (
            POINTER(fairmesh_mesh),
            POINTER(c_void_p),
            POINTER(fairmesh_error),
        ),
    ),
    "fairmesh_rim_roughness": (
        c_int32,
        (
            POINTER(fairmesh_mesh),
            POINTER(c_void_p),
            POINTER(fairmesh_error),
        ),
    ),
    "fairmesh_fill_holes": (
        c_int32,
        (
            POINTER(fairmesh_mesh),
            POINTER(fairmesh_fill_options),
            POINTER(fairmesh_options),
            POINTER(c_void_p),
            POINTER(fairmesh_error),
        ),
    ),
    "fairmesh_suggest_joins": (
        c_int32,
        (
            POINTER(fairmesh_mesh),
            POINTER(fairmesh_fill_options),
            POINTER(c_void_p),
            POINTER(fairmesh_error),
        ),
    ),
    "fairmesh_remesh": (
        c_int32,
        (
            POINTER(fairmesh_mesh),
            POINTER(fairmesh_selection),
            POINTER(fairmesh_remesh_options),
            POINTER(c_void_p),
            POINTER(fairmesh_error),
        ),
    ),
    "fairmesh_refill": (
        c_int32,
        (
            POINTER(fairmesh_mesh),
            POINTER(fairmesh_selection),
            POINTER(fairmesh_fill_options),
            POINTER(fairmesh_options),
            POINTER(c_void_p),
            POINTER(fairmesh_error),
        ),
    ),
    "fairmesh_erase": (
        c_int32,
        (
            POINTER(fairmesh_mesh),
            POINTER(fairmesh_indices),
            POINTER(c_void_p),
            POINTER(fairmesh_error),
        ),
    ),
    "fairmesh_erase_and_clean": (
        c_int32,
        (
            POINTER(fairmesh_mesh),
            POINTER(fairmesh_indices),
            c_uint64,
            POINTER(c_void_p),
            POINTER(fairmesh_error),
        ),
    ),
    "fairmesh_trim_boundary": (
        c_int32,
        (
            POINTER(fairmesh_mesh),
            POINTER(fairmesh_indices),
            c_uint64,
            c_double,
            POINTER(c_void_p),
            POINTER(fairmesh_error),
        ),
    ),
    "fairmesh_components": (
        c_int32,
        (
            POINTER(fairmesh_mesh),
            POINTER(c_void_p),
            POINTER(fairmesh_error),
        ),
    ),
    "fairmesh_carry_over": (
        c_int32,
        (
            POINTER(fairmesh_mesh),
            POINTER(fairmesh_indices),
            POINTER(fairmesh_points),
            POINTER(c_void_p),
            POINTER(fairmesh_error),
        ),
    ),
    "fairmesh_select_region": (
        c_int32,
        (
            POINTER(fairmesh_mesh),
            POINTER(fairmesh_region_step),
            c_size_t,
            POINTER(c_void_p),
            POINTER(fairmesh_error),
        ),
    ),
    "fairmesh_bridge": (
        c_int32,
        (
            POINTER(fairmesh_mesh),
            POINTER(fairmesh_indices),
            POINTER(fairmesh_indices),
            POINTER(fairmesh_bridge_options),
            POINTER(fairmesh_fill_options),
            POINTER(fairmesh_options),
            POINTER(c_void_p),
            POINTER(fairmesh_error),
        ),
    ),
    "fairmesh_result_info": (
        c_int32,
        (
            c_void_p,
            POINTER(fairmesh_info),
            POINTER(fairmesh_error),
        ),
    ),
    "fairmesh_result_report": (
        c_int32,
        (
            c_void_p,
            c_uint64,
            POINTER(fairmesh_report),
            POINTER(fairmesh_error),
        ),
    ),
    "fairmesh_result_level": (
        c_int32,
        (
            c_void_p,
            c_uint64,
            POINTER(fairmesh_level),
            POINTER(fairmesh_error),
        ),
    ),
    "fairmesh_result_component": (
        c_int32,
        (
            c_void_p,
            c_uint64,
            c_uint64,
            POINTER(fairmesh_component),
            POINTER(fairmesh_error),
        ),
    ),
    "fairmesh_result_attempt": (
        c_int32,
        (
            c_void_p,
            c_uint64,
            c_uint64,
            c_uint64,
            POINTER(fairmesh_attempt),
            POINTER(fairmesh_error),
        ),
    ),
    "fairmesh_result_continuity": (
        c_int32,
        (
            c_void_p,
            c_uint64,
            c_uint64,
            c_uint64,
            POINTER(fairmesh_continuity),
            POINTER(fairmesh_error),
        ),
    ),
    "fairmesh_result_loop": (
        c_int32,
        (
            c_void_p,
            c_uint64,
            POINTER(fairmesh_loop),
            POINTER(fairmesh_error),
        ),
    ),
    "fairmesh_result_fill_report": (
        c_int32,
        (
            c_void_p,
            c_uint64,
            POINTER(fairmesh_fill_report),
            POINTER(fairmesh_error),
        ),
    ),
    "fairmesh_result_suggestion": (
        c_int32,
        (
            c_void_p,
            c_uint64,
            POINTER(fairmesh_join_suggestion),
            POINTER(fairmesh_error),
        ),
    ),
    "fairmesh_result_bridge": (
        c_int32,
        (
            c_void_p,
            POINTER(fairmesh_bridge_report),
            POINTER(fairmesh_error),
        ),
    ),
    "fairmesh_result_bump": (
        c_int32,
        (
            c_void_p,
            c_uint64,
            POINTER(fairmesh_bump),
            POINTER(fairmesh_error),
        ),
    ),
    "fairmesh_result_positions": (
        c_int32,
        (
            c_void_p,
            POINTER(fairmesh_points_out),
            POINTER(fairmesh_error),
        ),
    ),
    "fairmesh_result_triangles": (
        c_int32,
        (
            c_void_p,
            POINTER(fairmesh_indices_out),
            POINTER(fairmesh_error),
        ),
    ),
    "fairmesh_result_scalars": (
        c_int32,
        (
            c_void_p,
            c_uint32,
            POINTER(fairmesh_scalars_out),
            POINTER(fairmesh_error),
        ),
    ),
    "fairmesh_result_vectors": (
        c_int32,
        (
            c_void_p,
            c_uint32,
            POINTER(fairmesh_points_out),
            POINTER(fairmesh_error),
        ),
    ),
    "fairmesh_result_list": (
        c_int32,
        (
            c_void_p,
            c_uint32,
            c_uint64,
            c_void_p,
            c_size_t,
            POINTER(c_size_t),
            POINTER(fairmesh_error),
        ),
    ),
    "fairmesh_result_free": (c_int32, (c_void_p,)),
}
