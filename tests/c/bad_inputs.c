/* Bad inputs in classes: each has its exact status and element, and leaves every output as it was. */
#include "common.h"

enum { FAIR = 1, SOLVER = 2, REMESH = 4, FILL = 8, LOOPS = 16, CURVATURE = 32, SUGGEST = 64, ERASE = 128, COMPONENTS = 256 };
enum { ROUGHNESS = 512, TRIM = 1024, REFILL = 2048, CARRY = 4096, SELECT = 8192, LAST = SELECT };
#define REGION (FAIR | SOLVER | REMESH | REFILL)
#define ALL (REGION | FILL | LOOPS | CURVATURE | SUGGEST | ERASE | COMPONENTS | ROUGHNESS | TRIM | CARRY | SELECT)
#define SIDE 9
#define NONE FAIRMESH_NO_ELEMENT

/* Everything that a call takes and gives. */
typedef struct {
    Cap cap;
    fairmesh_mesh mesh;
    fairmesh_selection selection;
    fairmesh_options options;
    fairmesh_fill_options fill;
    fairmesh_remesh_options remesh;
    fairmesh_indices erased;
    fairmesh_region_step steps[2];
    size_t step_count;
    double area;
    fairmesh_points points;
    fairmesh_points_out out;
    fairmesh_scalars_out numbers;
    double *outputs;
    fairmesh_report report;
    fairmesh_result *result;
    fairmesh_solver *solver;
    uint32_t list[8];
    double normals[3 * SIDE * SIDE];
    /* What is handed over; NULL where a mutation says so. */
    const fairmesh_mesh *p_mesh;
    const fairmesh_selection *p_selection;
    const fairmesh_options *p_options;
    const fairmesh_fill_options *p_fill;
    const fairmesh_remesh_options *p_remesh;
    const fairmesh_points_out *p_out;
    const fairmesh_points *p_points;
    const fairmesh_region_step *p_steps;
    const fairmesh_scalars_out *p_numbers;
    fairmesh_report *p_report;
    fairmesh_result **p_result;
    fairmesh_solver **p_solver;
} Call;

/* What has to come of it. */
typedef struct {
    int32_t status;
    uint32_t kind;
    uint64_t element, other;
} Expected;

static Expected expect(int32_t status, uint32_t kind, uint64_t element, uint64_t other) {
    Expected e;
    e.status = status;
    e.kind = kind;
    e.element = element;
    e.other = other;
    return e;
}

static Expected argument(int32_t status, uint64_t number, uint64_t offset) {
    return expect(status, FAIRMESH_ELEMENT_ARGUMENT, number, offset);
}

/* The numbers of the arguments: 1 is the mesh, 2 a selection. */
static uint64_t options_argument(int function) { return function == REFILL ? 4 : 3; }

static uint64_t fill_argument(int function) { return function == REFILL ? 3 : 2; }

#define OFFSET(type, a) ((uint64_t)offsetof(type, a))
#define OFFSET2(type, a, inner, b) ((uint64_t)(offsetof(type, a) + offsetof(inner, b)))

static void call_init(Call *call) {
    memset(call, 0, sizeof *call);
    call->cap = cap_new(SIDE);
    call->mesh = call->cap.mesh;
    call->selection = call->cap.selection;
    OK(fairmesh_options_init(&call->options, sizeof call->options));
    call->options.threads = 1;
    OK(fairmesh_fill_options_init(&call->fill, sizeof call->fill));
    OK(fairmesh_remesh_options_init(&call->remesh, sizeof call->remesh));
    call->outputs = (double *)must(malloc(3 * SIDE * SIDE * sizeof(double)));
    memset(call->outputs, 0x5a, 3 * SIDE * SIDE * sizeof(double));
    call->out = points_out_of(call->outputs, SIDE * SIDE);
    call->numbers = scalars_out_of(call->outputs, SIDE * SIDE);
    memset(&call->report, 0x5a, sizeof call->report);
    call->report.struct_size = sizeof call->report;
    call->result = (fairmesh_result *)(uintptr_t)0x5a5a;
    call->solver = (fairmesh_solver *)(uintptr_t)0x5a5a;
    call->p_mesh = &call->mesh;
    call->p_selection = &call->selection;
    call->p_options = &call->options;
    call->p_fill = &call->fill;
    call->p_remesh = &call->remesh;
    call->p_out = &call->out;
    call->points = points_of(call->normals, 2);
    call->p_points = &call->points;
    call->p_steps = call->steps;
    call->step_count = 2;
    call->p_numbers = &call->numbers;
    call->p_report = &call->report;
    call->p_result = &call->result;
    call->p_solver = &call->solver;
}

static void call_free(Call *call) {
    cap_free(&call->cap);
    free(call->outputs);
}

static int32_t call_run(Call *c, int function, fairmesh_error *error) {
    switch (function) {
    case FAIR:
        return fairmesh_fair(c->p_mesh, c->p_selection, c->p_options, c->p_out, c->p_report, c->p_result, error);
    case SOLVER: return fairmesh_solver_new(c->p_mesh, c->p_selection, c->p_options, c->p_solver, error);
    case REMESH: return fairmesh_remesh(c->p_mesh, c->p_selection, c->p_remesh, c->p_result, error);
    case FILL: return fairmesh_fill_holes(c->p_mesh, c->p_fill, c->p_options, c->p_result, error);
    case LOOPS: return fairmesh_boundary_loops(c->p_mesh, c->p_result, error);
    case SUGGEST: return fairmesh_suggest_joins(c->p_mesh, c->p_fill, c->p_result, error);
    case ERASE: return fairmesh_erase(c->p_mesh, &c->erased, 3, c->p_result, error);
    case ROUGHNESS: return fairmesh_rim_roughness(c->p_mesh, c->p_result, error);
    case TRIM: return fairmesh_trim_boundary(c->p_mesh, &c->erased, 3, c->area, c->p_result, error);
    case REFILL: return fairmesh_refill(c->p_mesh, c->p_selection, c->p_fill, c->p_options, c->p_result, error);
    case CARRY: return fairmesh_carry_over(c->p_mesh, &c->erased, c->p_points, NULL, NULL, c->p_result, error);
    case SELECT: return fairmesh_select_region(c->p_mesh, c->p_steps, c->step_count, NULL, NULL, c->p_result, error);
    case COMPONENTS: return fairmesh_components(c->p_mesh, c->p_result, error);
    default: return fairmesh_mean_curvature(c->p_mesh, c->p_numbers, error);
    }
}

/* Mutations. Each gets the function and the number of its variant, and says what has to come of it. */
typedef Expected (*Mutation)(Call *c, int function, int k);
#define MUTATION(name) static Expected name(Call *c, COMMON_MAY_STAY_UNUSED int f, COMMON_MAY_STAY_UNUSED int k)

/* So many given normals, the first ones for the vertices of the list. */
static void give_normals(Call *c, const double *data, size_t count, size_t listed) {
    fairmesh_boundary_normals *normals = &c->options.boundary_normals;
    normals->kind = FAIRMESH_BOUNDARY_NORMALS_KIND_GIVEN;
    normals->vectors = points_of(data, count);
    if (listed) normals->vertices = indices_of(c->list, listed);
}

static void give_curvature(Call *c, const double *data, size_t count, size_t listed) {
    fairmesh_boundary_curvature *curvature = &c->options.boundary_curvature;
    curvature->kind = FAIRMESH_BOUNDARY_CURVATURE_KIND_GIVEN;
    curvature->values = numbers_of(data, count);
    if (listed) curvature->vertices = indices_of(c->list, listed);
}

static void select_two(Call *c, uint32_t kind, const void *entries) {
    c->selection.kind = kind;
    c->selection.data = entries;
    c->selection.count = 2;
}

MUTATION(null_mesh) {
    c->p_mesh = NULL;
    return argument(FAIRMESH_STATUS_NULL_POINTER, 1, NONE);
}
MUTATION(null_result) {
    c->p_result = NULL;
    c->p_solver = NULL;
    return argument(FAIRMESH_STATUS_NULL_POINTER, f == LOOPS || f == ROUGHNESS ? 2 : f == TRIM || f == REFILL ? 5 : f == CARRY || f == SELECT ? 6 : 4, NONE);
}
MUTATION(null_selection_data) {
    c->selection.kind = (uint32_t)(k + 1);
    c->selection.data = NULL;
    return argument(FAIRMESH_STATUS_NULL_POINTER, 2, OFFSET(fairmesh_selection, data));
}
MUTATION(null_numbers) {
    c->p_numbers = NULL;
    return argument(FAIRMESH_STATUS_NULL_POINTER, 2, NONE);
}
MUTATION(null_points) {
    c->p_points = NULL;
    return argument(FAIRMESH_STATUS_NULL_POINTER, 3, NONE);
}
MUTATION(null_normals) {
    give_normals(c, NULL, SIDE * SIDE, 0);
    return argument(FAIRMESH_STATUS_NULL_POINTER, options_argument(f),
                    OFFSET2(fairmesh_options, boundary_normals, fairmesh_boundary_normals, vectors));
}

MUTATION(null_curvature) {
    give_curvature(c, NULL, SIDE * SIDE, 0);
    return argument(FAIRMESH_STATUS_NULL_POINTER, options_argument(f),
                    OFFSET2(fairmesh_options, boundary_curvature, fairmesh_boundary_curvature, values));
}

MUTATION(misaligned_struct) {
    static union { double align; char bytes[1024]; } room;
    int off = 1 + k % 7;
    memcpy(room.bytes + off, &c->mesh, sizeof c->mesh);
    c->p_mesh = (const fairmesh_mesh *)(const void *)(room.bytes + off);
    return argument(FAIRMESH_STATUS_MISALIGNED, 1, NONE);
}
MUTATION(misaligned_options) {
    c->p_options = (const fairmesh_options *)(const void *)((const char *)&c->options + 1 + k % 7);
    return argument(FAIRMESH_STATUS_MISALIGNED, options_argument(f), NONE);
}
MUTATION(misaligned_positions) {
    c->mesh.positions.data = (const char *)c->mesh.positions.data + 1 + k % 7;
    c->mesh.positions.count--;
    return argument(FAIRMESH_STATUS_MISALIGNED, 1, OFFSET2(fairmesh_mesh, positions, fairmesh_points, data));
}
MUTATION(misaligned_triangles) {
    c->mesh.triangles.data = (const uint32_t *)(const void *)((const char *)c->cap.corners + 1 + k % 3);
    return argument(FAIRMESH_STATUS_MISALIGNED, 1, OFFSET2(fairmesh_mesh, triangles, fairmesh_indices, data));
}
MUTATION(misaligned_output) {
    c->out.data = (char *)c->out.data + 1 + k % 7;
    c->numbers.data = c->out.data;
    return argument(FAIRMESH_STATUS_MISALIGNED, f == FAIR ? 4 : 2, OFFSET(fairmesh_points_out, data));
}
MUTATION(misaligned_selection) {
    select_two(c, k % 2 ? FAIRMESH_SELECTION_KIND_FACES : FAIRMESH_SELECTION_KIND_FREE_VERTICES, (const char *)c->list + 1 + k / 2);
    return argument(FAIRMESH_STATUS_MISALIGNED, 2, OFFSET(fairmesh_selection, data));
}

MUTATION(short_stride_of_selection) {
    select_two(c, FAIRMESH_SELECTION_KIND_FACES, c->list);
    c->selection.stride = 2;
    return argument(FAIRMESH_STATUS_BAD_STRIDE, 2, OFFSET(fairmesh_selection, stride));
}

MUTATION(overflow) {
    static const size_t counts[] = {SIZE_MAX, SIZE_MAX / 2, SIZE_MAX / 8, SIZE_MAX / 12, SIZE_MAX / 24, (size_t)1 << 62};
    if (k % 2) {
        c->mesh.triangles.count = counts[k / 2];
        if (k / 2 == 4) c->mesh.triangles.count *= 3;
        return argument(FAIRMESH_STATUS_COUNT_OVERFLOW, 1, OFFSET2(fairmesh_mesh, triangles, fairmesh_indices, count));
    }
    c->mesh.positions.count = counts[k / 2];
    return argument(FAIRMESH_STATUS_COUNT_OVERFLOW, 1, OFFSET2(fairmesh_mesh, positions, fairmesh_points, count));
}
MUTATION(overflow_stride) {
    c->mesh.positions.stride = (SIZE_MAX >> (k % 6)) & ~(size_t)7;
    return argument(FAIRMESH_STATUS_COUNT_OVERFLOW, 1, OFFSET2(fairmesh_mesh, positions, fairmesh_points, count));
}
MUTATION(too_large) {
    if (k) c->mesh.triangles.count = 0xffffffff;
    else c->mesh.positions.count = 0xffffffff;
    return expect(FAIRMESH_STATUS_TOO_LARGE, FAIRMESH_ELEMENT_NONE, NONE, NONE);
}

MUTATION(count_mismatch) {
    static const int by[] = {-81, -1, 1, 80, 1000};
    if (k < 10) {
        c->selection.kind = (uint32_t)(1 + k % 2);
        c->selection.count += (size_t)by[k / 2];
        return argument(FAIRMESH_STATUS_COUNT_MISMATCH, 2, OFFSET(fairmesh_selection, count));
    }
    c->selection.kind = FAIRMESH_SELECTION_KIND_INTERIOR;
    return argument(FAIRMESH_STATUS_COUNT_MISMATCH, 2, OFFSET(fairmesh_selection, count));
}
MUTATION(count_mismatch_normals) {
    give_normals(c, c->normals, (size_t)(k > 2 ? k : SIDE * SIDE - 1 - k), k > 2 ? 2 : 0);
    return argument(FAIRMESH_STATUS_COUNT_MISMATCH, options_argument(f),
                    OFFSET2(fairmesh_options, boundary_normals, fairmesh_boundary_normals, vectors) + offsetof(fairmesh_points, count));
}

MUTATION(count_mismatch_curvature) {
    give_curvature(c, c->normals, (size_t)(k > 2 ? k : SIDE * SIDE - 1 - k), k > 2 ? 2 : 0);
    return argument(FAIRMESH_STATUS_COUNT_MISMATCH, options_argument(f),
                    OFFSET2(fairmesh_options, boundary_curvature, fairmesh_boundary_curvature, values) +
                        offsetof(fairmesh_numbers, count));
}

MUTATION(index_out_of_range) {
    static const uint32_t wrong[] = {SIDE * SIDE, SIDE * SIDE + 1, 0x7fffffff, 0xffffffff};
    uint64_t t = (uint64_t)(k * 17) % c->cap.triangles;
    c->cap.corners[3 * t + (uint64_t)(k % 3)] = wrong[k % 4];
    return expect(FAIRMESH_STATUS_INDEX_OUT_OF_RANGE, FAIRMESH_ELEMENT_TRIANGLE, t, wrong[k % 4]);
}
MUTATION(selection_out_of_range) {
    uint32_t count = k % 2 ? (uint32_t)c->cap.triangles : SIDE * SIDE;
    uint32_t wrong = k / 2 % 2 ? 0xffffffff - (uint32_t)k : count + (uint32_t)k;
    select_two(c, k % 2 ? FAIRMESH_SELECTION_KIND_FACES : FAIRMESH_SELECTION_KIND_FREE_VERTICES, c->list);
    c->list[0] = 40;
    c->list[1] = wrong;
    return expect(FAIRMESH_STATUS_SELECTION_OUT_OF_RANGE, k % 2 ? FAIRMESH_ELEMENT_TRIANGLE : FAIRMESH_ELEMENT_VERTEX,
                  wrong, NONE);
}
MUTATION(loop_out_of_range) {
    c->list[0] = 0;
    c->list[1] = (uint32_t)(1 + 1000 * k);
    c->fill.loops = indices_of(c->list, 2);
    return expect(FAIRMESH_STATUS_SELECTION_OUT_OF_RANGE, FAIRMESH_ELEMENT_LOOP, c->list[1], NONE);
}
MUTATION(normal_out_of_range) {
    c->list[0] = (uint32_t)(SIDE * SIDE + 100 * k);
    c->normals[2] = 1.0;
    give_normals(c, c->normals, 1, 1);
    return expect(FAIRMESH_STATUS_SELECTION_OUT_OF_RANGE, FAIRMESH_ELEMENT_VERTEX, c->list[0], NONE);
}

MUTATION(curvature_out_of_range) {
    c->list[0] = (uint32_t)(SIDE * SIDE + 100 * k);
    give_curvature(c, c->normals, 1, 1);
    return expect(FAIRMESH_STATUS_SELECTION_OUT_OF_RANGE, FAIRMESH_ELEMENT_VERTEX, c->list[0], NONE);
}

/* Free vertices of the grid of 9: 3 to 5 in both directions; 2 and 6 are their boundary. */
static uint64_t inner(int k) { return (uint64_t)((2 + k % 5) + SIDE * (2 + k / 5 % 5)); }

MUTATION(not_finite) {
    uint64_t v = inner(k);
    c->cap.positions[3 * v + (uint64_t)(k % 3)] = k % 2 ? NAN : k % 4 ? INFINITY : -INFINITY;
    return expect(FAIRMESH_STATUS_NOT_FINITE, FAIRMESH_ELEMENT_VERTEX, v, NONE);
}
MUTATION(bad_normal) {
    static const double wrong[] = {2.0, 0.5, 0.99, 1.01, 1e300, 1e-300, NAN, INFINITY, -2.0};
    uint32_t v = 2 + SIDE * 3;
    c->list[0] = v;
    c->normals[2] = wrong[k];
    give_normals(c, c->normals, 1, 1);
    return expect(FAIRMESH_STATUS_BAD_NORMAL, FAIRMESH_ELEMENT_VERTEX, v, NONE);
}

MUTATION(bad_curvature) {
    static const double wrong[] = {INFINITY, -INFINITY, NAN};
    uint32_t v = 2 + SIDE * 3;
    if (k < 2) {
        c->normals[v] = wrong[k];
        give_curvature(c, c->normals, SIDE * SIDE, 0);
    } else {
        c->list[0] = v;
        c->normals[0] = wrong[k - 2];
        give_curvature(c, c->normals, 1, 1);
    }
    return expect(FAIRMESH_STATUS_BAD_OPTION, FAIRMESH_ELEMENT_VERTEX, v, NONE);
}

/* A triangle of the region. */
static uint64_t region_triangle(int k) {
    return (uint64_t)(2 * ((3 + k % 3) + (SIDE - 1) * (3 + k / 3 % 3)) + k % 2);
}

MUTATION(repeated_index) {
    uint64_t t = region_triangle(k);
    uint32_t *corner = c->cap.corners + 3 * t;
    uint32_t v = corner[(k + 1) % 3];
    /* It has to keep a free vertex, or nobody looks at it. */
    if (!c->cap.free_mask[v] && !c->cap.free_mask[corner[(k + 2) % 3]]) v = corner[(k + 1) % 3] = corner[k % 3];
    else corner[k % 3] = v;
    return expect(FAIRMESH_STATUS_REPEATED_INDEX, FAIRMESH_ELEMENT_TRIANGLE, t, v);
}
MUTATION(duplicate_triangle) {
    uint64_t t = region_triangle(k);
    uint32_t *corners = c->cap.corners;
    uint64_t last = c->cap.triangles - 1;
    int r;
    /* In the place of the last triangle, turned. */
    for (r = 0; r < 3; r++) corners[3 * last + (uint64_t)r] = corners[3 * t + (uint64_t)((r + k) % 3)];
    return expect(FAIRMESH_STATUS_DUPLICATE_TRIANGLE, FAIRMESH_ELEMENT_TRIANGLE, last, t);
}
MUTATION(non_manifold_edge) {
    uint64_t t = region_triangle(k), last = c->cap.triangles - 1;
    uint32_t *corners = c->cap.corners, a = corners[3 * t], b = corners[3 * t + 1];
    uint32_t *extra = corners + 3 * last;
    extra[0] = a, extra[1] = b, extra[2] = SIDE * SIDE - 1;
    return expect(FAIRMESH_STATUS_NON_MANIFOLD_EDGE, FAIRMESH_ELEMENT_EDGE, a < b ? a : b, a < b ? b : a);
}
MUTATION(orientation) {
    uint64_t t = region_triangle(k);
    uint32_t *corner = c->cap.corners + 3 * t, swap = corner[1];
    corner[1] = corner[2];
    corner[2] = swap;
    /* Which of its edges is told is not said: a later check. */
    return expect(FAIRMESH_STATUS_INCONSISTENT_ORIENTATION, FAIRMESH_ELEMENT_EDGE, NONE - 1, NONE - 1);
}
MUTATION(non_manifold_vertex) {
    /* The last triangle hangs at a boundary vertex of the region by its corner alone. */
    uint32_t *extra = c->cap.corners + 3 * (c->cap.triangles - 1);
    uint32_t v = (uint32_t)((k % 2 ? 2 : 6) + SIDE * (3 + k / 2));
    extra[0] = v, extra[1] = SIDE * SIDE - 1, extra[2] = SIDE - 1;
    return expect(FAIRMESH_STATUS_NON_MANIFOLD_VERTEX, FAIRMESH_ELEMENT_VERTEX, v, NONE);
}
MUTATION(free_on_boundary) {
    uint64_t v = (uint64_t)(k % 4 == 0 ? k + 1 : k % 4 == 1 ? SIDE * (1 + k % 7) : k % 4 == 2 ? SIDE * (2 + k % 6) - 1
                                                                            : SIDE * (SIDE - 1) + 1 + k % 6);
    c->cap.free_mask[v] = 1;
    return expect(FAIRMESH_STATUS_FREE_VERTEX_ON_BOUNDARY, FAIRMESH_ELEMENT_VERTEX, v, NONE);
}
MUTATION(free_without_triangle) {
    uint64_t v = (uint64_t)(1 + k), t;
    c->cap.free_mask[v] = 1;
    for (t = 0; t < 3 * c->cap.triangles; t++) {
        /* Its triangles become others, far away and the same as none. */
        if (c->cap.corners[t] == v) {
            c->mesh.triangles.data = c->cap.corners + 3 * 2 * (SIDE - 1);
            c->mesh.triangles.count = c->cap.triangles - 2 * (SIDE - 1);
            break;
        }
    }
    return expect(FAIRMESH_STATUS_FREE_VERTEX_WITHOUT_TRIANGLE, FAIRMESH_ELEMENT_VERTEX, v, NONE);
}
MUTATION(empty_region) {
    if (k == 0) memset(c->cap.free_mask, 0, SIDE * SIDE);
    else if (k == 1) c->selection.kind = FAIRMESH_SELECTION_KIND_FACES, c->selection.count = 0;
    else if (k == 2) c->selection.kind = FAIRMESH_SELECTION_KIND_FREE_VERTICES, c->selection.count = 0;
    else c->selection.kind = FAIRMESH_SELECTION_KIND_FIXED_MASK, memset(c->cap.free_mask, 1, SIDE * SIDE);
    return expect(FAIRMESH_STATUS_EMPTY_REGION, FAIRMESH_ELEMENT_NONE, NONE, NONE);
}
MUTATION(nothing_fixed) {
    /* An octahedron, all of it free, at the beginning of the vertices. */
    static const double at[18] = {1, 0, 0, -1, 0, 0, 0, 1, 0, 0, -1, 0, 0, 0, 1, 0, 0, -1};
    static const uint32_t faces[24] = {0, 2, 4, 2, 1, 4, 1, 3, 4, 3, 0, 4, 2, 0, 5, 1, 2, 5, 3, 1, 5, 0, 3, 5};
    int i;
    memcpy(c->cap.positions, at, sizeof at);
    for (i = 0; i < 24; i++) c->cap.corners[i] = faces[(i + 3 * k) % 24];
    c->mesh.triangles.count = 8;
    memset(c->cap.free_mask, 0, SIDE * SIDE);
    memset(c->cap.free_mask, 1, 6);
    return expect(FAIRMESH_STATUS_NOTHING_FIXED, FAIRMESH_ELEMENT_VERTEX, 0, NONE);
}

MUTATION(future_fields) {
    static union { double align; struct { fairmesh_mesh mesh; char more[64]; } s; } room;
    memset(&room, 0, sizeof room);
    room.s.mesh = c->mesh;
    room.s.mesh.struct_size = sizeof(fairmesh_mesh) + 64;
    room.s.more[9 * k] = 1;
    c->p_mesh = &room.s.mesh;
    return argument(FAIRMESH_STATUS_BAD_RESERVED, 1, sizeof(fairmesh_mesh) + (uint64_t)(9 * k));
}

MUTATION(fill_place) {
    c->fill.filter.within.kind = FAIRMESH_PLACE_KIND_BALL;
    c->fill.filter.within.radius = NAN;
    return argument(FAIRMESH_STATUS_BAD_OPTION, fill_argument(f), OFFSET2(fairmesh_fill_options, filter, fairmesh_loop_filter, within));
}
/* Groups: their beginnings, and a loop that is in two of them. */
MUTATION(groups) {
    static const uint32_t starts[][2] = {{1, 1}, {0, 3}, {1, 0}};
    c->fill.join.kind = FAIRMESH_JOIN_KIND_GROUPS;
    c->fill.join.loops = indices_of(c->list, 2);
    if (k < 3) {
        c->fill.join.starts = indices_of(starts[k], 2);
        return argument(FAIRMESH_STATUS_BAD_OPTION, fill_argument(f), OFFSET2(fairmesh_fill_options, join, fairmesh_join, starts));
    }
    if (k == 3) return argument(FAIRMESH_STATUS_BAD_OPTION, fill_argument(f), OFFSET2(fairmesh_fill_options, join, fairmesh_join, loops));
    if (k == 4) {
        c->fill.join.loops.data = NULL;
        return argument(FAIRMESH_STATUS_NULL_POINTER, 2, OFFSET2(fairmesh_fill_options, join, fairmesh_join, loops));
    }
    c->list[1] = 1;
    return expect(FAIRMESH_STATUS_SELECTION_OUT_OF_RANGE, FAIRMESH_ELEMENT_LOOP, 1, NONE);
}
MUTATION(erased) {
    c->erased.count = 2;
    if (k == 0) return argument(FAIRMESH_STATUS_NULL_POINTER, 2, OFFSET(fairmesh_indices, data));
    c->erased.data = c->list;
    if (k == 1) {
        c->erased.stride = 2;
        return argument(FAIRMESH_STATUS_BAD_STRIDE, 2, OFFSET(fairmesh_indices, stride));
    }
    c->list[1] = (uint32_t)c->cap.triangles;
    return expect(FAIRMESH_STATUS_SELECTION_OUT_OF_RANGE, f == TRIM ? FAIRMESH_ELEMENT_LOOP : FAIRMESH_ELEMENT_TRIANGLE,
                  c->cap.triangles, NONE);
}
MUTATION(areas) {
    static const double wrong[] = {-1.0, NAN, -INFINITY, -1e-300};
    c->area = wrong[k];
    return argument(FAIRMESH_STATUS_BAD_OPTION, 4, NONE);
}

/* Of the second step. */
#define STEP(a) ((uint64_t)(sizeof(fairmesh_region_step) + offsetof(fairmesh_region_step, a)))

MUTATION(region_steps) {
    fairmesh_region_step *step = &c->steps[1];
    switch (k) {
    case 0: c->p_steps = NULL; return argument(FAIRMESH_STATUS_NULL_POINTER, 2, NONE);
    case 1:
        c->p_steps = (const fairmesh_region_step *)(const void *)((const char *)c->steps + 4);
        c->step_count = 1;
        return argument(FAIRMESH_STATUS_MISALIGNED, 2, NONE);
    case 2: c->step_count = SIZE_MAX / 2; return argument(FAIRMESH_STATUS_COUNT_OVERFLOW, 3, NONE);
    case 3:
        c->p_result = (fairmesh_result **)(void *)&step->point;
        return argument(FAIRMESH_STATUS_ALIASING, 6, NONE);
    default:
        step->kind = FAIRMESH_REGION_KIND_TRIANGLES;
        step->list.data = (const uint32_t *)(const void *)&c->result;
        step->list.count = 2;
        return argument(FAIRMESH_STATUS_ALIASING, 6, NONE);
    }
}
MUTATION(region_lists) {
    fairmesh_region_step *step = &c->steps[1];
    uint64_t count = k % 2 ? SIDE * SIDE : c->cap.triangles;
    step->kind = k % 2 ? FAIRMESH_REGION_KIND_VERTICES : FAIRMESH_REGION_KIND_TRIANGLES;
    step->list.count = 2;
    if (k < 2) return argument(FAIRMESH_STATUS_NULL_POINTER, 2, STEP(list));
    step->list.data = c->list;
    if (k < 4) {
        step->list.stride = 2;
        return argument(FAIRMESH_STATUS_BAD_STRIDE, 2, STEP(list) + offsetof(fairmesh_indices, stride));
    }
    c->list[1] = (uint32_t)count;
    return expect(FAIRMESH_STATUS_SELECTION_OUT_OF_RANGE, k % 2 ? FAIRMESH_ELEMENT_VERTEX : FAIRMESH_ELEMENT_TRIANGLE, count, NONE);
}
MUTATION(region_places) {
    fairmesh_region_step *step = &c->steps[1];
    Expected range = expect(FAIRMESH_STATUS_BAD_OPTION, FAIRMESH_ELEMENT_NONE, NONE, NONE);
    step->value = 1.0;
    switch (k) {
    case 0: step->kind = FAIRMESH_REGION_KIND_BALL, step->point[1] = NAN; return range;
    case 1: step->kind = FAIRMESH_REGION_KIND_BOX, step->point[1] = 2.0; return argument(FAIRMESH_STATUS_BAD_OPTION, 2, STEP(vector));
    case 2: step->kind = FAIRMESH_REGION_KIND_HALF_SPACE; return range;
    case 3: step->kind = FAIRMESH_REGION_KIND_HALF_SPACE, step->vector[0] = 1.0, step->point[2] = INFINITY; return range;
    case 4: step->kind = FAIRMESH_REGION_KIND_GEODESIC, step->point[0] = NAN; return range;
    case 5: step->kind = FAIRMESH_REGION_KIND_COMPONENT, step->point[2] = -INFINITY; return range;
    case 6: step->kind = FAIRMESH_REGION_KIND_BUMP, step->point[2] = NAN; return range;
    case 7:
        /* A sheet as small as this has none. */
        step->kind = FAIRMESH_REGION_KIND_BUMP;
        return expect(FAIRMESH_STATUS_NO_BUMP, FAIRMESH_ELEMENT_NONE, NONE, NONE);
    default:
        step->kind = FAIRMESH_REGION_KIND_GEODESIC;
        step->seed_kind = FAIRMESH_SEED_KIND_VERTEX;
        step->seed_vertex = SIDE * SIDE;
        return expect(FAIRMESH_STATUS_SELECTION_OUT_OF_RANGE, FAIRMESH_ELEMENT_VERTEX, SIDE * SIDE, NONE);
    }
}

MUTATION(aliasing) {
    switch (k) {
    case 0: c->out.data = c->cap.positions + 3, c->out.count = SIDE * SIDE; break;
    case 1: c->out.data = c->cap.positions, c->out.stride = 32; break;
    case 2: c->out.data = c->cap.positions, c->out.scalar = FAIRMESH_SCALAR_FLOAT32; break;
    case 3: c->out.data = c->cap.corners; break;
    case 4: c->out.data = (void *)&c->mesh; break;
    case 5: c->out.data = (void *)&c->options; break;
    case 6:
        give_normals(c, c->normals, SIDE * SIDE, 0);
        c->out.data = c->normals;
        break;
    default: c->out.data = (void *)&c->selection;
    }
    return argument(FAIRMESH_STATUS_ALIASING, 4, NONE);
}
MUTATION(aliased_outputs) {
    if (k == 0) {
        c->out.data = (void *)&c->report;
        return argument(FAIRMESH_STATUS_ALIASING, 5, NONE);
    }
    if (k == 1) {
        c->p_result = (fairmesh_result **)(void *)&c->report.defect;
        return argument(FAIRMESH_STATUS_ALIASING, 6, NONE);
    }
    c->p_result = (fairmesh_result **)(void *)(c->cap.positions + k);
    return argument(FAIRMESH_STATUS_ALIASING, 6, NONE);
}
MUTATION(aliased_numbers) {
    c->numbers.data = k ? (void *)c->cap.positions : (void *)c->cap.corners;
    return argument(FAIRMESH_STATUS_ALIASING, 2, NONE);
}

typedef struct {
    const char *class_name, *name;
    Mutation mutate;
    int functions, variants;
} Row;

static const Row table[] = {
    {"null", "mesh", null_mesh, ALL, 1},
    {"null", "result slot", null_result, SOLVER | REMESH | FILL | LOOPS | ROUGHNESS | ERASE | TRIM | REFILL | CARRY | SELECT, 1},
    {"null", "selection data", null_selection_data, REGION, 4},
    {"null", "points", null_points, CARRY, 1},
    {"null", "output view", null_numbers, CURVATURE, 1},
    {"null", "normals", null_normals, FAIR | SOLVER | FILL, 1},
    {"null", "curvature", null_curvature, FAIR | SOLVER | FILL, 1},
    {"alignment", "mesh struct", misaligned_struct, ALL, 2},
    {"alignment", "options struct", misaligned_options, FAIR | SOLVER | FILL, 3},
    {"alignment", "positions", misaligned_positions, ALL, 3},
    {"alignment", "triangles", misaligned_triangles, ALL, 3},
    {"alignment", "output", misaligned_output, FAIR | CURVATURE, 7},
    {"alignment", "selection", misaligned_selection, REGION, 6},
    {"stride", "selection", short_stride_of_selection, REGION, 1},
    {"overflow", "counts", overflow, ALL, 10},
    {"overflow", "stride", overflow_stride, ALL, 4},
    {"overflow", "32 bits", too_large, ALL, 2},
    {"counts", "mask", count_mismatch, REGION, 11},
    {"counts", "normals", count_mismatch_normals, FAIR | SOLVER | FILL, 5},
    {"counts", "curvature", count_mismatch_curvature, FAIR | SOLVER | FILL, 5},
    {"index", "triangle", index_out_of_range, ALL, 12},
    {"index", "selection", selection_out_of_range, REGION, 8},
    {"index", "loop", loop_out_of_range, FILL, 3},
    {"index", "normal", normal_out_of_range, FAIR | SOLVER | FILL, 3},
    {"index", "curvature", curvature_out_of_range, FAIR | SOLVER | FILL, 3},
    {"not finite", "position", not_finite, REGION | CURVATURE | SELECT, 25},
    {"not finite", "normal", bad_normal, FAIR | SOLVER, 9},
    {"not finite", "curvature", bad_curvature, FAIR | SOLVER | FILL, 5},
    {"degenerate", "repeated index", repeated_index, REGION, 9},
    {"duplicate", "triangle", duplicate_triangle, REGION, 9},
    {"non-manifold edge", "fin", non_manifold_edge, REGION, 9},
    {"non-manifold vertex", "bow-tie", non_manifold_vertex, REGION, 6},
    {"orientation", "one turned", orientation, REGION, 9},
    {"region", "free on boundary", free_on_boundary, REGION, 8},
    {"region", "free without triangle", free_without_triangle, REGION, 7},
    {"region", "empty", empty_region, REGION, 4},
    {"region", "nothing fixed", nothing_fixed, REGION, 8},
    {"struct size", "later fields", future_fields, ALL, 7},
    {"option range", "place of holes", fill_place, FILL | SUGGEST | REFILL, 1},
    {"option range", "groups of loops", groups, FILL, 6},
    {"option range", "erased triangles", erased, ERASE | TRIM | CARRY, 3},
    {"option range", "trimmed area", areas, TRIM, 4},
    {"option range", "steps of a region", region_steps, SELECT, 5},
    {"option range", "lists of a region", region_lists, SELECT, 6},
    {"option range", "places of a region", region_places, SELECT, 9},
    {"aliasing", "positions", aliasing, FAIR, 8},
    {"aliasing", "outputs", aliased_outputs, FAIR, 4},
    {"aliasing", "numbers", aliased_numbers, CURVATURE, 2},
};

/* Single fields with values that they may not have. The message names the field. */
typedef enum { U32, U64, SIZE, F64, POINTER } Type;
typedef struct {
    const char *class_name;
    int functions;
    int32_t status;
    /* Of the call: the struct that an argument points to, and the field in it. */
    size_t part, field;
    Type type;
    const char *name;
    /* A number that is set as well, if it is not in the mesh. */
    size_t also;
    uint32_t also_is;
    int count;
    double values[10];
} Setting;

#define OF(part, field, type) offsetof(Call, part), offsetof(Call, part.field), type, #field
#define OF_STEP(field, type) offsetof(Call, steps), offsetof(Call, steps[1].field), type, #field
#define ALONE 0, 0
#define STEP_KIND(which) offsetof(Call, steps[1].kind), FAIRMESH_REGION_KIND_##which
#define SIZES 10, {0, 1, 4, 7, 8, 12, 0x10001, 0x7fffffff, 0xffffffff, 0x10008}
#define NUMBERS 5, {5, 9, 77, 0x7fffffff, 0xffffffff}
#define SCALARS 4, {0, 3, 8, 0xffffffff}
#define NULL_POINTER FAIRMESH_STATUS_NULL_POINTER
#define BAD_STRIDE FAIRMESH_STATUS_BAD_STRIDE
#define BAD_SIZE FAIRMESH_STATUS_BAD_STRUCT_SIZE
#define BAD_ENUM FAIRMESH_STATUS_BAD_ENUM
#define BAD_OPTION FAIRMESH_STATUS_BAD_OPTION
#define BAD_RESERVED FAIRMESH_STATUS_BAD_RESERVED
#define MISMATCH FAIRMESH_STATUS_COUNT_MISMATCH
#define FAIRING (FAIR | SOLVER | FILL)
#define FILLING (FILL | SUGGEST | REFILL)

static const Setting settings[] = {
    {"null", ALL, NULL_POINTER, OF(mesh, positions.data, POINTER), ALONE, 1, {0}},
    {"null", ALL, NULL_POINTER, OF(mesh, triangles.data, POINTER), ALONE, 1, {0}},
    {"null", FAIR, NULL_POINTER, OF(out, data, POINTER), ALONE, 1, {0}},
    {"null", CURVATURE, NULL_POINTER, OF(numbers, data, POINTER), ALONE, 1, {0}},
    {"null", CARRY, NULL_POINTER, OF(points, data, POINTER), ALONE, 1, {0}},
    {"alignment", ALL, FAIRMESH_STATUS_MISALIGNED, OF(mesh, positions.stride, SIZE), ALONE, 3, {25, 26, 27}},
    {"stride", ALL, BAD_STRIDE, OF(mesh, positions.stride, SIZE), ALONE, 2, {8, 16}},
    {"stride", ALL, BAD_STRIDE, OF(mesh, triangles.stride, SIZE), ALONE, 2, {4, 8}},
    {"stride", FAIR, BAD_STRIDE, OF(out, stride, SIZE), ALONE, 1, {16}},
    {"stride", CURVATURE, BAD_STRIDE, OF(numbers, stride, SIZE), ALONE, 1, {4}},
    {"stride", CARRY, BAD_STRIDE, OF(points, stride, SIZE), ALONE, 1, {12}},
    {"counts", FAIR, MISMATCH, OF(out, count, SIZE), ALONE, 5, {0, 1, 80, 82, 88}},
    {"counts", CURVATURE, MISMATCH, OF(numbers, count, SIZE), ALONE, 5, {0, 1, 80, 82, 88}},
    {"struct size", ALL, BAD_SIZE, OF(mesh, struct_size, U32), ALONE, SIZES},
    {"struct size", REGION, BAD_SIZE, OF(selection, struct_size, U32), ALONE, SIZES},
    {"struct size", FAIRING, BAD_SIZE, OF(options, struct_size, U32), ALONE, SIZES},
    {"struct size", FAIRING, BAD_SIZE, OF(options, struct_size, U32), ALONE, 2, {sizeof(fairmesh_options) + 1, offsetof(fairmesh_options, continuity) - 8}},
    {"struct size", FAIR, BAD_SIZE, OF(report, struct_size, U32), ALONE, SIZES},
    {"struct size", FILL, BAD_SIZE, OF(fill, struct_size, U32), ALONE, SIZES},
    {"struct size", REMESH, BAD_SIZE, OF(remesh, struct_size, U32), ALONE, SIZES},
    {"reserved", ALL, BAD_RESERVED, OF(mesh, positions.reserved, U32), ALONE, 1, {7}},
    {"reserved", SELECT, BAD_RESERVED, OF_STEP(reserved, U32), ALONE, 1, {1}},
    {"reserved", SELECT, BAD_RESERVED, OF_STEP(reserved_too, U32), ALONE, 1, {1}},
    {"enum", ALL, BAD_ENUM, OF(mesh, positions.scalar, U32), ALONE, SCALARS},
    {"enum", ALL, BAD_ENUM, OF(mesh, coincident, U32), ALONE, 1, {2}},
    {"enum", FAIR, BAD_ENUM, OF(out, scalar, U32), ALONE, SCALARS},
    {"enum", CURVATURE, BAD_ENUM, OF(numbers, scalar, U32), ALONE, SCALARS},
    {"enum", CARRY, BAD_ENUM, OF(points, scalar, U32), ALONE, SCALARS},
    {"enum", REGION, BAD_ENUM, OF(selection, kind, U32), ALONE, NUMBERS},
    {"enum", FAIRING, BAD_ENUM, OF(options, inner_fairness, U32), ALONE, NUMBERS},
    {"enum", FAIRING, BAD_ENUM, OF(options, boundary_normals.kind, U32), ALONE, NUMBERS},
    {"enum", FAIRING, BAD_ENUM, OF(options, target.kind, U32), ALONE, NUMBERS},
    {"enum", FAIRING, BAD_ENUM, OF(options, interior_normals, U32), ALONE, NUMBERS},
    {"enum", FAIRING, BAD_ENUM, OF(options, discretization, U32), ALONE, NUMBERS},
    {"enum", FAIRING, BAD_ENUM, OF(options, intersections, U32), ALONE, NUMBERS},
    {"enum", FAIRING, BAD_ENUM, OF(options, boundary_curvature.kind, U32), ALONE, NUMBERS},
    {"enum", FILLING, BAD_ENUM, OF(fill, on_failure, U32), ALONE, NUMBERS},
    {"enum", FILLING, BAD_ENUM, OF(fill, join.kind, U32), ALONE, NUMBERS},
    {"enum", FILLING, BAD_ENUM, OF(fill, filter.within.kind, U32), ALONE, NUMBERS},
    {"enum", SELECT, BAD_ENUM, OF_STEP(kind, U32), ALONE, 2, {10, 35}},
    {"enum", SELECT, BAD_ENUM, OF_STEP(combine, U32), ALONE, 1, {3}},
    {"enum", SELECT, BAD_ENUM, OF_STEP(seed_kind, U32), STEP_KIND(PATCH), 1, {2}},
    {"option range", ALL, BAD_OPTION, OF(mesh, coincident_within, F64), ALONE, 3, {-1, NAN, INFINITY}},
    {"option range", FAIRING, BAD_OPTION, OF(options, tolerance, F64), ALONE, 8, {0, -1, 1, 2, NAN, INFINITY, -INFINITY, -1e-300}},
    {"option range", FAIRING, BAD_OPTION, OF(options, max_iterations, U64), ALONE, 1, {0}},
    {"option range", FAIRING, BAD_OPTION, OF(options, threads, U32), ALONE, 3, {1025, 0x7fffffff, 0xffffffff}},
    {"option range", FAIRING, BAD_OPTION, OF(options, continuity, F64), ALONE, 5, {-0.1, 1.01, NAN, INFINITY, -INFINITY}},
    {"option range", FAIRING, BAD_OPTION, OF(options, target.constant, F64), offsetof(Call, options.target.kind), FAIRMESH_TARGET_KIND_CONSTANT, 3, {NAN, INFINITY, -INFINITY}},
    {"option range", FILLING, BAD_OPTION, OF(fill, density, F64), ALONE, 8, {0, -1, 0.09, 10.1, NAN, INFINITY, -INFINITY, 1e-300}},
    {"option range", REMESH, BAD_OPTION, OF(remesh, density, F64), ALONE, 8, {0, -1, 0.09, 10.1, NAN, INFINITY, -INFINITY, 1e-300}},
    {"option range", FILLING, BAD_OPTION, OF(fill, relax_within, F64), ALONE, 4, {-1, NAN, INFINITY, -INFINITY}},
    {"option range", FILLING, BAD_OPTION, OF(fill, filter.max_length, F64), ALONE, 3, {-1, NAN, -INFINITY}},
    {"option range", FILLING, BAD_OPTION, OF(fill, filter.max_area, F64), ALONE, 3, {-1, NAN, -INFINITY}},
    {"option range", FILLING, BAD_OPTION, OF(fill, filter.max_diagonal, F64), ALONE, 3, {-1, NAN, -INFINITY}},
    {"option range", SELECT, BAD_OPTION, OF_STEP(value, F64), STEP_KIND(BALL), 2, {-1, NAN}},
    {"option range", SELECT, BAD_OPTION, OF_STEP(value, F64), STEP_KIND(GEODESIC), 2, {-1, NAN}},
    {"option range", SELECT, BAD_OPTION, OF_STEP(value, F64), STEP_KIND(PATCH), 2, {181, NAN}},
};

static Expected set(Call *c, int function, const Setting *row, double value) {
    const uint64_t numbers[] = {offsetof(Call, mesh), 1, offsetof(Call, selection), 2, offsetof(Call, options), options_argument(function),
                                offsetof(Call, fill), fill_argument(function), offsetof(Call, remesh), 3, offsetof(Call, steps), 2,
                                offsetof(Call, points), 3, offsetof(Call, out), 4, offsetof(Call, numbers), 2, offsetof(Call, report), 5};
    char *field = (char *)c + row->field;
    size_t k = 0;
    while (numbers[k] != row->part) k += 2;
    switch (row->type) {
    case U32: *(uint32_t *)(void *)field = (uint32_t)value; break;
    case U64: *(uint64_t *)(void *)field = (uint64_t)value; break;
    case SIZE: *(size_t *)(void *)field = (size_t)value; break;
    case F64: *(double *)(void *)field = value; break;
    case POINTER: memset(field, 0, sizeof(void *));
    }
    if (row->also) *(uint32_t *)(void *)((char *)c + row->also) = row->also_is;
    return argument(row->status, numbers[k + 1], row->field - row->part);
}

static size_t failures, cases;

static void complain(const char *class_name, const char *name, int function, int variant, const char *what) {
    fprintf(stderr, "%s, %s, function %d, variant %d: %s\n", class_name, name, function, variant, what);
    failures++;
}

static uint64_t digest_of(uint64_t digest, const void *bytes, size_t count) {
    const unsigned char *byte = (const unsigned char *)bytes;
    for (; count > 0; count--) digest = (digest ^ *byte++) * 1099511628211u;
    return digest;
}

/* Of every byte that the library could reach. */
static uint64_t digest_of_call(const Call *call) {
    size_t bytes = 3 * SIDE * SIDE * sizeof(double);
    uint64_t digest = digest_of(0, call, sizeof *call);
    digest = digest_of(digest, call->cap.positions, bytes);
    digest = digest_of(digest, call->outputs, bytes);
    digest = digest_of(digest, call->cap.corners, 12 * call->cap.triangles);
    return digest_of(digest, call->cap.free_mask, SIDE * SIDE);
}

/* One case: status and element are as expected, the message has this word, and nothing was written. */
static void check_case(Call *call, int function, Expected expected, const char *word, const char *class_name, const char *name, int variant) {
    const uint64_t before = digest_of_call(call);
    int any = expected.element == NONE - 1;
    fairmesh_error error;
    int32_t status;
    char text[400];
    memset(&error, 0x5a, sizeof error);
    status = call_run(call, function, &error);
    cases++;
    if (status != expected.status) {
        sprintf(text, "status %d (%.150s), not %d", (int)status, error.message, (int)expected.status);
        complain(class_name, name, function, variant, text);
    }
    if (error.status != status || error.element_kind != expected.kind ||
        (!any && (error.element != expected.element || error.other != expected.other))) {
        sprintf(text, "kind %u element %llu other %llu (%.150s)", (unsigned)error.element_kind,
                (unsigned long long)error.element, (unsigned long long)error.other, error.message);
        complain(class_name, name, function, variant, text);
    }
    if (strlen(error.message) < 5 || strlen(error.message) >= sizeof error.message || !strstr(error.message, word)) {
        complain(class_name, name, function, variant, error.message);
    }
    if (digest_of_call(call) != before) complain(class_name, name, function, variant, "something was written");
    /* The same without an error detail. */
    if (status != call_run(call, function, NULL)) {
        complain(class_name, name, function, variant, "another status without error detail");
    }
    call_free(call);
}

static void expect_handle(int32_t status, const fairmesh_error *error, int32_t wanted, const char *what) {
    cases++;
    if (status != wanted || error->status != wanted || error->element_kind != FAIRMESH_ELEMENT_ARGUMENT ||
        error->element != 1 || error->other != NONE) {
        fprintf(stderr, "handles, %s: %d (%s)\n", what, (int)status, error->message);
        failures++;
    }
}

/* Every function that takes a solver gets it; the outputs stay as they are. */
static void check_solver(fairmesh_solver *s, int32_t wanted, const char *what) {
    fairmesh_points_out points = points_out_of(NULL, 0);
    fairmesh_report report, report_before;
    fairmesh_error e;
    SIZED(fairmesh_frame, frame);
    SIZED(fairmesh_bulge_range, range);
    fairmesh_result *result = NULL;
    memset(&report, 0x5a, sizeof report);
    report.struct_size = sizeof report;
    report_before = report;
    expect_handle(fairmesh_solver_run(s, 1, &report, &e), &e, wanted, what);
    expect_handle(fairmesh_solver_set(s, FAIRMESH_SETTING_TARGET, NULL, &e), &e, wanted, what);
    expect_handle(fairmesh_solver_edit(s, NULL, 0, &e), &e, wanted, what);
    expect_handle(fairmesh_solver_update(s, NULL, &frame, &e), &e, wanted, what);
    expect_handle(fairmesh_solver_finish(s, &report, &e), &e, wanted, what);
    expect_handle(fairmesh_solver_bulge_range(s, &range, &e), &e, wanted, what);
    expect_handle(fairmesh_solver_positions(s, &points, &e), &e, wanted, what);
    expect_handle(fairmesh_solver_result(s, &result, &e), &e, wanted, what);
    if (s != NULL) {
        cases++;
        CHECK(fairmesh_solver_free(s) == wanted);
    }
    CHECK(result == NULL);
    CHECK(memcmp(&report, &report_before, sizeof report) == 0);
}

/* The same with a result. */
static void check_result(fairmesh_result *r, int32_t wanted, const char *what) {
    double number = 0.25;
    uint32_t index = 7;
    size_t size = 99;
    fairmesh_points_out points = points_out_of(NULL, 0);
    fairmesh_scalars_out scalars = scalars_out_of(&number, 1);
    fairmesh_indices_out triangles = {NULL, 0, 0};
    fairmesh_report report, report_before;
    SIZED(fairmesh_info, info);
    SIZED(fairmesh_component, component);
    SIZED(fairmesh_attempt, attempt);
    SIZED(fairmesh_continuity, continuity);
    SIZED(fairmesh_sharp_edge, edge);
    SIZED(fairmesh_crease_end, end);
    SIZED(fairmesh_loop, boundary);
    SIZED(fairmesh_fill_report, filled);
    SIZED(fairmesh_join_suggestion, suggestion);
    SIZED(fairmesh_bridge_report, bridged);
    SIZED(fairmesh_crease, crease);
    fairmesh_error e;
    memset(&report, 0x5a, sizeof report);
    report.struct_size = sizeof report;
    report_before = report;
    expect_handle(fairmesh_result_info(r, &info, &e), &e, wanted, what);
    expect_handle(fairmesh_result_report(r, 0, &report, &e), &e, wanted, what);
    expect_handle(fairmesh_result_component(r, 0, 0, &component, &e), &e, wanted, what);
    expect_handle(fairmesh_result_attempt(r, 0, 0, 0, &attempt, &e), &e, wanted, what);
    expect_handle(fairmesh_result_continuity(r, 0, 0, 0, &continuity, &e), &e, wanted, what);
    expect_handle(fairmesh_result_sharp_edge(r, 0, 0, &edge, &e), &e, wanted, what);
    expect_handle(fairmesh_result_crease_end(r, 0, 0, 0, &end, &e), &e, wanted, what);
    expect_handle(fairmesh_result_loop(r, 0, &boundary, &e), &e, wanted, what);
    expect_handle(fairmesh_result_fill_report(r, 0, &filled, &e), &e, wanted, what);
    expect_handle(fairmesh_result_suggestion(r, 0, &suggestion, &e), &e, wanted, what);
    expect_handle(fairmesh_result_bridge(r, &bridged, &e), &e, wanted, what);
    expect_handle(fairmesh_result_crease(r, 0, &crease, &e), &e, wanted, what);
    expect_handle(fairmesh_result_positions(r, &points, &e), &e, wanted, what);
    expect_handle(fairmesh_result_triangles(r, &triangles, &e), &e, wanted, what);
    expect_handle(fairmesh_result_scalars(r, 0, &scalars, &e), &e, wanted, what);
    expect_handle(fairmesh_result_vectors(r, 0, &points, &e), &e, wanted, what);
    expect_handle(fairmesh_result_list(r, 0, 0, &index, 1, &size, &e), &e, wanted, what);
    if (r != NULL) {
        cases++;
        CHECK(fairmesh_result_free(r) == wanted);
    }
    CHECK(number == 0.25 && index == 7 && size == 99);
    CHECK(memcmp(&report, &report_before, sizeof report) == 0);
}

static void handles(void) {
    Cap cap = cap_new(SIDE);
    fairmesh_solver *solver = NULL;
    fairmesh_result *result = NULL;
    fairmesh_error error;
    char thing[64] = {0};
    fairmesh_options options;
    OK(fairmesh_options_init(&options, sizeof options));
    options.threads = 1;
    OK(fairmesh_solver_new(&cap.mesh, &cap.selection, &options, &solver, &error));
    OK(fairmesh_solver_result(solver, &result, &error));
    check_solver(NULL, FAIRMESH_STATUS_NULL_POINTER, "NULL solver");
    check_result(NULL, FAIRMESH_STATUS_NULL_POINTER, "NULL result");
    check_solver((fairmesh_solver *)thing, FAIRMESH_STATUS_BAD_HANDLE, "any pointer as solver");
    check_result((fairmesh_result *)thing, FAIRMESH_STATUS_BAD_HANDLE, "any pointer as result");
    check_solver((fairmesh_solver *)(void *)(uintptr_t)1, FAIRMESH_STATUS_BAD_HANDLE, "1 as solver");
    check_result((fairmesh_result *)(void *)UINTPTR_MAX, FAIRMESH_STATUS_BAD_HANDLE, "-1 as result");
    check_solver((fairmesh_solver *)result, FAIRMESH_STATUS_BAD_HANDLE, "a result as solver");
    check_result((fairmesh_result *)solver, FAIRMESH_STATUS_BAD_HANDLE, "a solver as result");
    OK(fairmesh_solver_free(solver));
    OK(fairmesh_result_free(result));
    check_solver(solver, FAIRMESH_STATUS_BAD_HANDLE, "a freed solver");
    check_result(result, FAIRMESH_STATUS_BAD_HANDLE, "a freed result");
    cap_free(&cap);
}

/* Results are asked for what they do not have. */
static void not_available(void) {
    Cap cap = cap_new(SIDE);
    fairmesh_result *result = NULL;
    fairmesh_error error;
    SIZED(fairmesh_loop, boundary);
    SIZED(fairmesh_report, report);
    uint32_t which, index = 7;
    size_t size = 99;
    OK(fairmesh_boundary_loops(&cap.mesh, &result, &error));
    CHECK(fairmesh_result_loop(result, 1, &boundary, &error) == FAIRMESH_STATUS_NOT_AVAILABLE);
    CHECK(fairmesh_result_loop(result, UINT64_MAX, &boundary, &error) == FAIRMESH_STATUS_NOT_AVAILABLE);
    CHECK(fairmesh_result_report(result, 0, &report, &error) == FAIRMESH_STATUS_NOT_AVAILABLE);
    CHECK(fairmesh_result_list(result, FAIRMESH_LIST_LOOP_VERTICES, 0, &index, 1, &size, &error) ==
          FAIRMESH_STATUS_BUFFER_TOO_SMALL);
    CHECK(index == 7 && size == 4 * (SIDE - 1));
    cases += 4;
    for (which = 0; which < 100; which++) {
        int32_t status = fairmesh_result_list(result, which, 0, NULL, 0, &size, &error);
        int known = (which <= 7 && which != 4) || which == 16 || (which >= 48 && which <= 50) || (which >= 64 && which <= 66) ||
                    which == 80 || which == 96;
        int mine = which == 32 || which == 33;
        cases++;
        CHECK(status == (mine ? FAIRMESH_STATUS_OK : known ? FAIRMESH_STATUS_NOT_AVAILABLE : FAIRMESH_STATUS_BAD_ENUM));
    }
    OK(fairmesh_result_free(result));
    cap_free(&cap);
}

/* The error detail itself may not lie in what is read: then nothing is written at all. */
static void error_in_the_way(void) {
    Cap cap = cap_new(SIDE);
    size_t bytes = 24 * cap.vertices;
    double *kept = (double *)must(malloc(bytes));
    fairmesh_result *result = NULL;
    union {
        fairmesh_mesh mesh;
        fairmesh_error error;
    } over;
    memcpy(kept, cap.positions, bytes);
    CHECK(fairmesh_boundary_loops(&cap.mesh, &result, (fairmesh_error *)(void *)cap.positions) == FAIRMESH_STATUS_ALIASING);
    CHECK(fairmesh_boundary_loops(&cap.mesh, &result, (fairmesh_error *)(void *)((char *)cap.positions + 1)) ==
          FAIRMESH_STATUS_MISALIGNED);
    /* Also where another argument is wrong: what is known to be read by then stays. */
    CHECK(fairmesh_boundary_loops(&cap.mesh, NULL, (fairmesh_error *)(void *)cap.positions) == FAIRMESH_STATUS_ALIASING);
    memset(&over, 0, sizeof over);
    over.mesh = cap.mesh;
    over.mesh.coincident = 77;
    CHECK(fairmesh_boundary_loops(&over.mesh, &result, &over.error) == FAIRMESH_STATUS_ALIASING && over.mesh.coincident == 77);
    CHECK(memcmp(kept, cap.positions, bytes) == 0 && result == NULL);
    cases += 4;
    free(kept);
    cap_free(&cap);
}

int main(void) {
    size_t k, classes = 2;
    int function, variant;
    Call call;
    for (k = 0; k < sizeof table / sizeof *table; k++) {
        const Row *row = &table[k];
        for (function = 1; function <= LAST; function *= 2) {
            for (variant = 0; variant < row->variants && row->functions & function; variant++) {
                call_init(&call);
                Expected expected = row->mutate(&call, function, variant);
                check_case(&call, function, expected, "", row->class_name, row->name, variant);
            }
        }
        classes += k == 0 || strcmp(row->class_name, table[k - 1].class_name) != 0;
    }
    for (k = 0; k < sizeof settings / sizeof *settings; k++) {
        const Setting *row = &settings[k];
        const char *name = strrchr(row->name, '.');
        for (function = 1; function <= LAST; function *= 2) {
            for (variant = 0; variant < row->count && row->functions & function; variant++) {
                call_init(&call);
                Expected expected = set(&call, function, row, row->values[variant]);
                check_case(&call, function, expected, name ? name + 1 : row->name, row->class_name, row->name, variant);
            }
        }
    }
    handles();
    not_available();
    error_in_the_way();
    printf("bad inputs: %u cases in %u classes, %u failures\n", (unsigned)cases, (unsigned)classes, (unsigned)failures);
    CHECK(cases >= 500 && classes >= 12 && failures == 0);
    return 0;
}
