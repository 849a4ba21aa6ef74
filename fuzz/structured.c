/* libFuzzer: small meshes that are nearly right, with options that are nearly right. A byte stream says what is done to them. */
#include <fairmesh.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

typedef struct {
    const uint8_t *data;
    size_t size;
} Bytes;

static uint8_t next(Bytes *bytes) {
    if (bytes->size == 0) return 0;
    bytes->size--;
    return *bytes->data++;
}

static double unit(Bytes *bytes) { return (next(bytes) - 128) / 128.0; }

/* Lists of small numbers, some of them wrong. */
enum { LISTED = 12 };
typedef struct {
    uint32_t numbers[LISTED];
} List;

static fairmesh_indices list(Bytes *bytes, List *room, uint32_t below, size_t most, size_t width) {
    fairmesh_indices made;
    size_t k;
    memset(&made, 0, sizeof made);
    made.count = next(bytes) % (most + 1);
    made.data = room->numbers;
    for (k = 0; k < LISTED; k++) room->numbers[k] = k < made.count * width ? next(bytes) % (below + 1) : 0;
    return made;
}

/* What is asked about holes. */
typedef struct {
    fairmesh_fill_options fill;
    List loops, joined, starts, guides, components;
} Asked;

static void ask(Bytes *bytes, Asked *asked, uint32_t vertices) {
    fairmesh_fill_options *fill = &asked->fill;
    uint8_t flags = next(bytes), more = next(bytes);
    fairmesh_fill_options_init(fill, sizeof *fill);
    fill->max_new_vertices = 200;
    fill->fair = !(more & 1);
    fill->on_failure = more / 2u % 3u;
    if (flags & 1) fill->loops = list(bytes, &asked->loops, 4, 3, 1);
    fill->only_listed = flags / 2u % 2u;
    if (flags & 4) {
        fill->join.kind = FAIRMESH_JOIN_KIND_GROUPS;
        fill->join.loops = list(bytes, &asked->joined, 4, 5, 1);
        fill->join.starts = list(bytes, &asked->starts, 3, 3, 1);
        if (more & 8) fill->join.starts.count = 0;
    } else if (flags & 8) {
        fill->join.kind = FAIRMESH_JOIN_KIND_AUTO;
    }
    if (flags & 16) fill->guides = list(bytes, &asked->guides, vertices, 4, 2);
    if (flags & 32) {
        fill->relax_rim = next(bytes) % 5u;
        fill->relax_within = more & 16 ? 0.2 * unit(bytes) : 0.0;
    }
    if (flags & 64) {
        fill->max_edges = next(bytes);
        fill->filter.max_length = more & 32 ? 3.0 + 3.0 * unit(bytes) : 0.0;
        fill->filter.max_area = more & 64 ? 0.5 + 0.5 * unit(bytes) : 0.0;
        fill->filter.except_longest = next(bytes) % 3u;
        fill->filter.components = list(bytes, &asked->components, 2, 2, 1);
        fill->filter.within.kind = next(bytes) % 3u;
        fill->filter.within.radius = unit(bytes);
        fill->filter.within.low[0] = unit(bytes);
        fill->filter.within.high[0] = fill->filter.within.high[1] = fill->filter.within.high[2] = unit(bytes);
    }
    if (flags & 128) fill->density = 1.5 + 1.4 * unit(bytes);
}

/* A region, step by step. */
static fairmesh_status choose(Bytes *bytes, const fairmesh_mesh *mesh, fairmesh_result **result, fairmesh_error *error) {
    enum { STEPS = 4 };
    fairmesh_region_step steps[STEPS];
    List lists[STEPS];
    size_t k, i, count = next(bytes) % (STEPS + 1);
    uint32_t elements = (uint32_t)(mesh->positions.count + mesh->triangles.count);
    memset(steps, 0, sizeof steps);
    for (k = 0; k < count; k++) {
        fairmesh_region_step *step = &steps[k];
        uint8_t flags = next(bytes);
        /* Those that name triangles, then those that change them, from GROW on. */
        step->kind = flags % 16u <= 10u ? flags % 16u : FAIRMESH_REGION_KIND_GROW + flags % 16u - 11u;
        step->combine = flags / 16u % 4u;
        step->seed_kind = flags / 64u;
        step->seed_vertex = next(bytes);
        for (i = 0; i < 3; i++) step->point[i] = unit(bytes);
        for (i = 0; i < 3; i++) step->vector[i] = unit(bytes);
        flags = next(bytes);
        step->value = flags % 8u == 0 ? NAN : flags % 8u == 1 ? 90.0 * unit(bytes) : unit(bytes);
        step->rings = flags % 16u == 8 ? UINT64_MAX : flags / 8u;
        step->list = list(bytes, &lists[k], elements, LISTED, 1);
    }
    return fairmesh_select_region(mesh, steps, count, NULL, NULL, result, error);
}

/* One edit of many kinds. */
static fairmesh_edit change(Bytes *bytes, List *room, uint32_t vertices) {
    fairmesh_edit made;
    uint8_t flags = next(bytes);
    size_t i;
    memset(&made, 0, sizeof made);
    made.kind = flags % 6u;
    made.vertex = (uint32_t)(next(bytes) % (vertices + 1));
    made.amount = flags % 64u == 63 ? NAN : unit(bytes);
    made.falloff = flags & 64 ? fabs(unit(bytes)) : 0.0;
    made.vertices = list(bytes, room, vertices, LISTED, 1);
    for (i = 0; i < 3; i++) made.rotation[i] = flags & 128 ? 2.0 * unit(bytes) : 0.0;
    for (i = 0; i < 3; i++) made.translation[i] = 0.3 * unit(bytes);
    return made;
}

/* A solver that is dragged about. */
static fairmesh_status live(Bytes *bytes, const fairmesh_mesh *mesh, const fairmesh_selection *selection, const fairmesh_options *options,
                            fairmesh_result **result, fairmesh_error *error) {
    fairmesh_solver *solver = NULL;
    fairmesh_status status = fairmesh_solver_new(mesh, selection, options, &solver, error);
    fairmesh_edit edits[2];
    List lists[2];
    fairmesh_budget limit;
    fairmesh_frame frame;
    fairmesh_bulge_range range;
    size_t frames;
    memset(&limit, 0, sizeof limit);
    limit.struct_size = sizeof limit;
    frame.struct_size = sizeof frame;
    range.struct_size = sizeof range;
    if (status != FAIRMESH_STATUS_OK) return status;
    for (frames = 1 + next(bytes) % 4; frames > 0 && status != FAIRMESH_STATUS_INTERNAL; frames--) {
        uint8_t flags = next(bytes);
        size_t count = flags % 3u, k;
        for (k = 0; k < count; k++) edits[k] = change(bytes, &lists[k], (uint32_t)mesh->positions.count);
        if (fairmesh_solver_edit(solver, edits, count, error) == FAIRMESH_STATUS_INTERNAL) abort();
        limit.evaluations = 1u + flags / 4u % 16u;
        status = flags & 64    ? fairmesh_solver_run(solver, 1u + flags / 128u, NULL, error)
                 : flags & 128 ? fairmesh_solver_bulge_range(solver, &range, error)
                               : fairmesh_solver_update(solver, &limit, &frame, error);
    }
    if (status != FAIRMESH_STATUS_INTERNAL) status = fairmesh_solver_finish(solver, NULL, error);
    if (status == FAIRMESH_STATUS_OK) status = fairmesh_solver_result(solver, result, error);
    if (fairmesh_solver_free(solver) != FAIRMESH_STATUS_OK) abort();
    return status;
}

/* What needs no fairing of a region. */
static fairmesh_status other(Bytes *bytes, int task, const fairmesh_mesh *mesh, const fairmesh_selection *selection, const fairmesh_options *options,
                             fairmesh_result **result, fairmesh_error *error) {
    uint32_t vertices = (uint32_t)mesh->positions.count, triangles = (uint32_t)mesh->triangles.count;
    Asked asked;
    List first, second;
    fairmesh_indices from, to;
    fairmesh_bridge_options how;
    uint8_t flags;
    if (task == 10) return choose(bytes, mesh, result, error);
    memset(&asked, 0, sizeof asked);
    ask(bytes, &asked, vertices);
    from = list(bytes, &first, task == 3 || task == 6 ? triangles : task == 5 ? 3 : vertices, 6, 1);
    flags = next(bytes);
    switch (task) {
    case 1: return fairmesh_fill_holes(mesh, &asked.fill, options, result, error);
    case 2: return fairmesh_suggest_joins(mesh, &asked.fill, result, error);
    case 3: return fairmesh_erase(mesh, &from, flags & 1 ? 0 : flags / 2u, result, error);
    case 4:
        fairmesh_bridge_options_init(&how, sizeof how);
        how.fill = flags & 1;
        if (flags & 2) how.width = 0.3 + unit(bytes);
        to = list(bytes, &second, vertices, 6, 1);
        return fairmesh_bridge(mesh, &from, &to, &how, &asked.fill, options, result, error);
    case 5: return fairmesh_trim_boundary(mesh, flags & 1 ? NULL : &from, flags / 4u, flags & 2 ? unit(bytes) : 0.0, result, error);
    case 6: return fairmesh_carry_over(mesh, flags & 1 ? NULL : &from, &mesh->positions, NULL, NULL, result, error);
    case 7: return fairmesh_refill(mesh, flags & 1 ? NULL : selection, &asked.fill, options, result, error);
    case 8: return fairmesh_rim_roughness(mesh, result, error);
    default: return fairmesh_components(mesh, result, error);
    }
}

/* Reads all that a result has. */
static void read_all(const fairmesh_result *result) {
    static uint32_t indices[1 << 16];
    fairmesh_info info;
    fairmesh_fill_report filled;
    fairmesh_loop boundary;
    fairmesh_bump bump;
    uint64_t k;
    uint32_t which;
    size_t count;
    info.struct_size = sizeof info;
    filled.struct_size = sizeof filled;
    boundary.struct_size = sizeof boundary;
    bump.struct_size = sizeof bump;
    if (fairmesh_result_info(result, &info, NULL) != FAIRMESH_STATUS_OK) abort();
    for (k = 0; k < 5; k++) {
        if (fairmesh_result_bump(result, k, &bump, NULL) == FAIRMESH_STATUS_INTERNAL) abort();
    }
    for (k = 0; k <= info.loop_count; k++) {
        if (fairmesh_result_fill_report(result, k, &filled, NULL) == FAIRMESH_STATUS_INTERNAL) abort();
        if (fairmesh_result_loop(result, k, &boundary, NULL) == FAIRMESH_STATUS_INTERNAL) abort();
        for (which = 0; which <= FAIRMESH_LIST_REGION_COUNTS; which++) {
            if (fairmesh_result_list(result, which, k, indices, 1 << 16, &count, NULL) == FAIRMESH_STATUS_INTERNAL) abort();
        }
    }
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
    Bytes bytes = {data, size};
    enum { MOST = 9 };
    double positions[MOST * MOST][3], before[MOST * MOST][3], out[MOST * MOST][3];
    uint32_t triangles[2 * MOST * MOST][3];
    uint8_t mask[MOST * MOST];
    size_t side = 3 + next(&bytes) % (MOST - 2), vertices = side * side, count = 0, v, edits;
    double bend = unit(&bytes), bump = unit(&bytes);
    fairmesh_options options;
    fairmesh_mesh mesh;
    fairmesh_selection selection;
    int task;
    fairmesh_points_out to;
    fairmesh_report report;
    fairmesh_error error;
    fairmesh_result *result = NULL;
    fairmesh_status status;
    uint32_t on_loop;
    double how_far;
    uint8_t what;
    memset(&mesh, 0, sizeof mesh);
    memset(&selection, 0, sizeof selection);
    memset(&to, 0, sizeof to);
    for (v = 0; v < vertices; v++) {
        double x = (double)(v % side) / (double)(side - 1) - 0.5, y = (double)(v / side) / (double)(side - 1) - 0.5;
        positions[v][0] = x;
        positions[v][1] = y;
        positions[v][2] = bend * (x * x + y * y) + bump * 0.1 * (double)(v * 7 % 5);
        mask[v] = v % side > 0 && v % side + 1 < side && v / side > 0 && v / side + 1 < side;
        if (v % side + 1 < side && v / side + 1 < side) {
            uint32_t a = (uint32_t)v, s = (uint32_t)side;
            uint32_t quad[2][3] = {{a, a + 1, a + s + 1}, {a, a + s + 1, a + s}};
            memcpy(triangles[count], quad, sizeof quad);
            count += 2;
        }
    }
    for (edits = next(&bytes) % 24; edits > 0; edits--) {
        size_t at = next(&bytes);
        switch (next(&bytes) % 8) {
        case 0: triangles[at % count][next(&bytes) % 3] = (uint32_t)(next(&bytes) % (vertices + 2)); break;
        case 1: memcpy(triangles[at % count], triangles[next(&bytes) % count], 12); break;
        case 2: positions[at % vertices][next(&bytes) % 3] += unit(&bytes); break;
        case 3: memcpy(positions[at % vertices], positions[next(&bytes) % vertices], 24); break;
        case 4: positions[at % vertices][next(&bytes) % 3] = at % 2 ? NAN : 1e300 * unit(&bytes); break;
        case 5: mask[at % vertices] ^= 1; break;
        case 6:
            /* A hole. */
            if (count > 2) memcpy(triangles[at % count], triangles[count - 1], 12), count--;
            break;
        default: positions[at % vertices][next(&bytes) % 3] *= 1e-200; break;
        }
    }
    memcpy(before, positions, sizeof before);
    fairmesh_options_init(&options, sizeof options);
    options.threads = 1;
    options.tolerance = 1e-4;
    what = next(&bytes);
    options.max_iterations = 1u + what % 16u;
    options.inner_fairness = what / 16u % 4u;
    options.discretization = what / 64u % 2u;
    what = next(&bytes);
    options.target.kind = what % 4u;
    options.target.constant = 20.0 * unit(&bytes);
    options.boundary_normals.kind = what / 4u % 2u;
    options.interior_normals = what / 8u % 2u;
    options.continuity = what / 16u % 2u;
    if (what & 128) {
        on_loop = (uint32_t)(next(&bytes) % (vertices + 1));
        how_far = 0.5 + 0.5 * unit(&bytes);
        options.loop_continuity.values.data = &how_far;
        options.loop_continuity.values.count = 1;
        options.loop_continuity.values.scalar = FAIRMESH_SCALAR_FLOAT64;
        options.loop_continuity.vertices.data = &on_loop;
        options.loop_continuity.vertices.count = 1;
    }
    mesh.struct_size = sizeof mesh;
    mesh.positions.data = positions;
    mesh.positions.count = vertices;
    mesh.positions.scalar = FAIRMESH_SCALAR_FLOAT64;
    mesh.triangles.data = triangles[0];
    mesh.triangles.count = count;
    selection.struct_size = sizeof selection;
    selection.kind = FAIRMESH_SELECTION_KIND_FREE_MASK;
    selection.data = mask;
    selection.count = vertices;
    to.data = out;
    to.count = vertices;
    to.scalar = FAIRMESH_SCALAR_FLOAT64;
    report.struct_size = sizeof report;
    /* 0 where the bytes have run out. */
    task = next(&bytes) % 16;
    if (task > 0 || what & 64) {
        status = task == 11 ? live(&bytes, &mesh, &selection, &options, &result, &error)
                            : other(&bytes, task > 10 || task == 0 ? 1 : task, &mesh, &selection, &options, &result, &error);
    } else {
        status = fairmesh_fair(&mesh, what & 32 ? NULL : &selection, &options, &to, &report, &result, &error);
    }
    if (status == FAIRMESH_STATUS_INTERNAL || error.status != (int32_t)status) abort();
    if (memcmp(before, positions, sizeof(double) * 3 * vertices) != 0) abort();
    if (status == FAIRMESH_STATUS_OK) read_all(result);
    if (fairmesh_result_free(result) != FAIRMESH_STATUS_OK) abort();
    return 0;
}
