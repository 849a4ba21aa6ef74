/* Calls every function of the header with good arguments, and checks the answers. Compiled as C99, C11 and C++17. */
#include "common.h"

/* Of the last call. */
static fairmesh_error error;

static fairmesh_info info_of(const fairmesh_result *result) {
    SIZED(fairmesh_info, info);
    OK(fairmesh_result_info(result, &info, &error));
    return info;
}

static fairmesh_report report_of(const fairmesh_result *result, uint64_t index) {
    SIZED(fairmesh_report, report);
    OK(fairmesh_result_report(result, index, &report, &error));
    return report;
}

static fairmesh_fill_report fill_report_of(const fairmesh_result *result, uint64_t index) {
    SIZED(fairmesh_fill_report, report);
    OK(fairmesh_result_fill_report(result, index, &report, &error));
    return report;
}

static size_t size_of_list(const fairmesh_result *result, uint32_t which, uint64_t index) {
    size_t size = 0;
    OK(fairmesh_result_list(result, which, index, NULL, 0, &size, &error));
    return size;
}

/* To be freed; `size` may be NULL. */
static uint32_t *list_of(const fairmesh_result *result, uint32_t which, uint64_t index, size_t *size) {
    size_t count = size_of_list(result, which, index);
    uint32_t *list = (uint32_t *)must(malloc(4 * count + 4));
    OK(fairmesh_result_list(result, which, index, list, count, &count, &error));
    if (size) *size = count;
    return list;
}

static double *positions_of(const fairmesh_result *result) {
    size_t count = (size_t)info_of(result).vertex_count;
    double *positions = (double *)must(malloc(24 * count));
    fairmesh_points_out to = points_out_of(positions, count);
    OK(fairmesh_result_positions(result, &to, &error));
    return positions;
}

static double *vectors_of(const fairmesh_result *result, uint32_t which, size_t count) {
    double *vectors = (double *)must(malloc(24 * count));
    fairmesh_points_out to = points_out_of(vectors, count);
    OK(fairmesh_result_vectors(result, which, &to, &error));
    return vectors;
}

static uint32_t *triangles_of(const fairmesh_result *result) {
    fairmesh_indices_out into = {NULL, (size_t)info_of(result).triangle_count, 0};
    uint32_t *corners = into.data = (uint32_t *)must(malloc(12 * into.count));
    OK(fairmesh_result_triangles(result, &into, &error));
    return corners;
}

static void versions(void) {
    uint32_t version = fairmesh_version();
    char text[32];
    CHECK(version >> 16 == FAIRMESH_VERSION_MAJOR && (version >> 8 & 255) == FAIRMESH_VERSION_MINOR);
    CHECK((version & 255) == FAIRMESH_VERSION_PATCH);
    sprintf(text, "%d.%d.%d", FAIRMESH_VERSION_MAJOR, FAIRMESH_VERSION_MINOR, FAIRMESH_VERSION_PATCH);
    CHECK(strcmp(text, fairmesh_version_string()) == 0);
    CHECK(strcmp(fairmesh_describe(FAIRMESH_ANSWER_STATUS, FAIRMESH_STATUS_BUSY, FAIRMESH_TEXT_NAME), "busy") == 0);
    CHECK(strcmp(fairmesh_describe(FAIRMESH_ANSWER_STATUS, -7, FAIRMESH_TEXT_NAME), "unknown") == 0);
    CHECK(strcmp(fairmesh_describe(FAIRMESH_ANSWER_OUTCOME, FAIRMESH_OUTCOME_CONVERGED, FAIRMESH_TEXT_NAME), "converged") == 0);
    CHECK(strcmp(fairmesh_describe(FAIRMESH_ANSWER_OUTCOME, 999, FAIRMESH_TEXT_NAME), "unknown") == 0);
    CHECK(strcmp(fairmesh_describe(FAIRMESH_ANSWER_OUTCOME, FAIRMESH_OUTCOME_CONVERGED, FAIRMESH_TEXT_MEANING), "tolerance met, and the surface is sound") == 0);
    CHECK(fairmesh_describe(FAIRMESH_ANSWER_OUTCOME, FAIRMESH_OUTCOME_CONVERGED, FAIRMESH_TEXT_REMEDY)[0] == 0 && fairmesh_describe(FAIRMESH_ANSWER_OUTCOME, 999, FAIRMESH_TEXT_MEANING)[0] == 0);
    CHECK(fairmesh_describe(FAIRMESH_ANSWER_OUTCOME, FAIRMESH_OUTCOME_ITERATION_LIMIT, FAIRMESH_TEXT_REMEDY)[0] != 0);
    CHECK(strcmp(fairmesh_describe(FAIRMESH_ANSWER_STATUS, FAIRMESH_STATUS_OK, FAIRMESH_TEXT_MEANING), "done") == 0);
    CHECK(fairmesh_describe(FAIRMESH_ANSWER_STATUS, FAIRMESH_STATUS_NOTHING_FIXED, FAIRMESH_TEXT_REMEDY)[0] != 0);
    CHECK(strcmp(fairmesh_describe(FAIRMESH_ANSWER_LOOSE_REASON, FAIRMESH_LOOSE_REASON_BUMP, FAIRMESH_TEXT_NAME), "bump") == 0);
    CHECK(fairmesh_describe(FAIRMESH_ANSWER_LOOSE_REASON, FAIRMESH_LOOSE_REASON_BUMP, FAIRMESH_TEXT_MEANING)[0] != 0);
    CHECK(strcmp(fairmesh_describe(FAIRMESH_ANSWER_LOOSE_REASON, FAIRMESH_LOOSE_REASON_BUMP, FAIRMESH_TEXT_REMEDY),
                 fairmesh_describe(FAIRMESH_ANSWER_LOOSE_REASON, FAIRMESH_LOOSE_REASON_SUSPICIOUS_NORMALS, FAIRMESH_TEXT_REMEDY)) != 0);
    CHECK(strcmp(fairmesh_describe(FAIRMESH_ANSWER_FILL_OUTCOME, FAIRMESH_FILL_OUTCOME_LEFT_OPEN, FAIRMESH_TEXT_NAME), "left_open") == 0);
    CHECK(fairmesh_describe(FAIRMESH_ANSWER_FILL_OUTCOME, FAIRMESH_FILL_OUTCOME_FAIRED, FAIRMESH_TEXT_MEANING)[0] != 0);
    CHECK(fairmesh_describe(FAIRMESH_ANSWER_FILL_OUTCOME, FAIRMESH_FILL_OUTCOME_FAIRED, FAIRMESH_TEXT_REMEDY)[0] == 0);
    CHECK(strcmp(fairmesh_describe(FAIRMESH_ANSWER_ATTEMPT_END, FAIRMESH_ATTEMPT_END_UNSOUND, FAIRMESH_TEXT_NAME), "unsound") == 0);
    CHECK(fairmesh_describe(FAIRMESH_ANSWER_ATTEMPT_END, FAIRMESH_ATTEMPT_END_SOUND, FAIRMESH_TEXT_MEANING)[0] != 0);
    CHECK(fairmesh_describe(FAIRMESH_ANSWER_ATTEMPT_END, FAIRMESH_ATTEMPT_END_SOUND, FAIRMESH_TEXT_REMEDY)[0] == 0);
    CHECK(strcmp(fairmesh_describe(FAIRMESH_ANSWER_FILL_REASON, FAIRMESH_FILL_REASON_UNSOUND, FAIRMESH_TEXT_NAME), "unsound") == 0);
    CHECK(fairmesh_describe(FAIRMESH_ANSWER_FILL_REASON, FAIRMESH_FILL_REASON_NOT_FINITE, FAIRMESH_TEXT_MEANING)[0] != 0);
    CHECK(fairmesh_describe(FAIRMESH_ANSWER_FILL_REASON, FAIRMESH_FILL_REASON_NOT_FINITE, FAIRMESH_TEXT_REMEDY)[0] != 0);
}

typedef struct {
    uint64_t calls, stop_at, last;
    double fraction;
} Watch;

static int32_t watch(const fairmesh_progress *progress, void *user_data) {
    Watch *w = (Watch *)user_data;
    CHECK(progress->struct_size == sizeof *progress);
    CHECK(progress->fraction >= w->fraction && progress->fraction <= 1.0);
    CHECK(progress->iterations >= w->last && strlen(progress->phase) > 3);
    w->fraction = progress->fraction;
    w->last = progress->iterations;
    w->calls++;
    return w->stop_at != 0 && progress->iterations >= w->stop_at;
}

static fairmesh_options quick(void) {
    fairmesh_options options;
    OK(fairmesh_options_init(&options, sizeof options));
    CHECK(options.struct_size == sizeof options && options.tolerance == 1e-8 && options.max_iterations == 500);
    options.threads = 2;
    return options;
}

static fairmesh_fill_options filling(void) {
    fairmesh_fill_options fill;
    OK(fairmesh_fill_options_init(&fill, sizeof fill));
    return fill;
}

/* A cap whose dent was made fair in one call, and what was used at its boundary. */
typedef struct {
    Cap cap;
    double *out, *normals;
    uint32_t *boundary;
    size_t bytes, boundary_count;
    fairmesh_report report;
    fairmesh_result *result;
} Faired;

static Faired one_call(void) {
    Faired made;
    fairmesh_options options = quick();
    fairmesh_points_out to;
    size_t v;
    ZERO(Watch, w);
    memset(&made, 0, sizeof made);
    made.cap = cap_new(15);
    made.bytes = 3 * made.cap.vertices * sizeof(double);
    made.out = (double *)must(malloc(made.bytes));
    to = points_out_of(made.out, made.cap.vertices);
    made.report.struct_size = sizeof made.report;
    options.progress = watch;
    options.user_data = &w;
    OK(fairmesh_fair(&made.cap.mesh, &made.cap.selection, &options, &to, &made.report, &made.result, &error));
    CHECK(error.status == 0 && error.element == FAIRMESH_NO_ELEMENT && error.message[0] == 0);
    CHECK(made.report.outcome == FAIRMESH_OUTCOME_CONVERGED && made.report.reached == 1.0);
    CHECK(made.report.loose_reason == FAIRMESH_LOOSE_REASON_NONE);
    CHECK(made.report.iterations > 2 && w.last == made.report.iterations && w.calls >= w.last);
    CHECK(off_sphere(made.out, made.cap.vertices) < 2e-3);
    for (v = 0; v < made.cap.vertices; v++) {
        if (!made.cap.free_mask[v]) CHECK(memcmp(made.out + 3 * v, made.cap.positions + 3 * v, 24) == 0);
    }
    return made;
}

static void curvatures_of_result(const Faired *made) {
    const Cap *cap = &made->cap;
    double *h = (double *)must(malloc(cap->vertices * sizeof(double)));
    double *k = (double *)must(malloc(cap->vertices * sizeof(double)));
    fairmesh_scalars_out numbers = scalars_out_of(h, cap->vertices);
    size_t v;
    fairmesh_info info = info_of(made->result);
    CHECK(info.kind == FAIRMESH_RESULT_KIND_FAIRED && info.vertex_count == cap->vertices);
    OK(fairmesh_result_scalars(made->result, FAIRMESH_SCALARS_MEAN_CURVATURE, &numbers, &error));
    numbers.data = k;
    OK(fairmesh_result_scalars(made->result, FAIRMESH_SCALARS_GAUSSIAN_CURVATURE, &numbers, &error));
    for (v = 0; v < cap->vertices; v++) {
        if (cap->free_mask[v]) {
            CHECK(fabs(h[v] + 1.0) < 0.02 && fabs(k[v] - 1.0) < 0.05);
        } else {
            CHECK(h[v] != h[v] && k[v] != k[v]);
        }
    }
    free(h);
    free(k);
}

static void boundary_of_result(Faired *made) {
    const Cap *cap = &made->cap;
    size_t v;
    made->boundary = list_of(made->result, FAIRMESH_LIST_BOUNDARY_VERTICES, 0, &made->boundary_count);
    CHECK(made->boundary_count > 0 && made->boundary_count == info_of(made->result).boundary_vertex_count);
    made->normals = vectors_of(made->result, FAIRMESH_VECTORS_BOUNDARY_NORMALS, made->boundary_count);
    for (v = 0; v < made->boundary_count; v++) {
        const double *p = cap->positions + 3 * made->boundary[v], *n = made->normals + 3 * v;
        CHECK(!cap->free_mask[made->boundary[v]]);
        CHECK(p[0] * n[0] + p[1] * n[1] + p[2] * n[2] > 0.999);
    }
}

/* The report and the positions are those of the call; then the result is freed. */
static void rest_of_result(const Faired *made) {
    double *copy = positions_of(made->result);
    fairmesh_report again = report_of(made->result, 0);
    CHECK(memcmp(&again, &made->report, sizeof again) == 0);
    CHECK(size_of_list(made->result, FAIRMESH_LIST_NEEDLES, 0) == again.needle_count);
    CHECK(memcmp(copy, made->out, made->bytes) == 0);
    free(copy);
    OK(fairmesh_result_free(made->result));
    CHECK(fairmesh_result_free(made->result) == FAIRMESH_STATUS_BAD_HANDLE);
    OK(fairmesh_result_free(NULL));
}

/* The boundary normals as used, given back: the same surface. */
static void normals_given_back(const Faired *made) {
    const Cap *cap = &made->cap;
    double *again = (double *)must(malloc(made->bytes));
    fairmesh_points_out into = points_out_of(again, cap->vertices);
    fairmesh_options options = quick();
    size_t v;
    options.boundary_normals.kind = FAIRMESH_BOUNDARY_NORMALS_KIND_GIVEN;
    options.boundary_normals.vectors = points_of(made->normals, made->boundary_count);
    options.boundary_normals.vertices = indices_of(made->boundary, made->boundary_count);
    OK(fairmesh_fair(&cap->mesh, &cap->selection, &options, &into, NULL, NULL, NULL));
    for (v = 0; v < 3 * cap->vertices; v++) CHECK(fabs(again[v] - made->out[v]) < 1e-7);
    free(again);
}

/* In place, with a list of what is free. */
static void in_place_by_list(const Faired *made) {
    const Cap *cap = &made->cap;
    fairmesh_mesh mesh = cap->mesh;
    fairmesh_selection list = cap->selection;
    double *in_place = (double *)must(malloc(made->bytes));
    fairmesh_points_out same = points_out_of(in_place, cap->vertices);
    uint32_t *vertices = (uint32_t *)must(malloc(cap->vertices * 4));
    size_t v;
    memcpy(in_place, cap->positions, made->bytes);
    mesh.positions.data = in_place;
    list.kind = FAIRMESH_SELECTION_KIND_FREE_VERTICES;
    list.data = vertices;
    list.count = 0;
    for (v = 0; v < cap->vertices; v++) {
        if (cap->free_mask[v]) vertices[list.count++] = (uint32_t)v;
    }
    OK(fairmesh_fair(&mesh, &list, NULL, &same, NULL, NULL, &error));
    CHECK(memcmp(in_place, made->out, made->bytes) == 0);
    free(vertices);
    free(in_place);
}

/* A soup: every corner is a vertex of its own. */
static void soup(const Faired *made) {
    const Cap *cap = &made->cap;
    fairmesh_mesh mesh = cap->mesh;
    fairmesh_selection corners = cap->selection;
    size_t count = 3 * cap->triangles, v;
    double *at = (double *)must(malloc(3 * count * sizeof *at));
    uint32_t *rows = (uint32_t *)must(malloc(count * sizeof *rows));
    uint8_t *mask = (uint8_t *)must(malloc(count));
    fairmesh_points_out same = points_out_of(at, count);
    for (v = 0; v < count; v++) {
        memcpy(at + 3 * v, cap->positions + 3 * cap->corners[v], 3 * sizeof *at);
        rows[v] = (uint32_t)v;
        mask[v] = cap->free_mask[cap->corners[v]];
    }
    mesh.positions = points_of(at, count);
    mesh.triangles.data = rows;
    corners.data = mask;
    corners.count = count;
    mesh.coincident = FAIRMESH_COINCIDENT_SEPARATE;
    CHECK(fairmesh_fair(&mesh, &corners, NULL, &same, NULL, NULL, &error) == FAIRMESH_STATUS_FREE_VERTEX_ON_BOUNDARY);
    mesh.coincident = FAIRMESH_COINCIDENT_JOIN;
    OK(fairmesh_fair(&mesh, &corners, NULL, &same, NULL, NULL, &error));
    for (v = 0; v < count; v++) {
        const double *joined = made->out + 3 * cap->corners[v];
        CHECK(fabs(at[3 * v] - joined[0]) + fabs(at[3 * v + 1] - joined[1]) + fabs(at[3 * v + 2] - joined[2]) < 1e-6);
    }
    free(at);
    free(rows);
    free(mask);
}

/* A vertex as programs hold it: a position as floats among other things. */
typedef struct {
    uint16_t colour[2];
    float at[3];
    float weight;
} Vertex;

/* Floats with a stride, rows of triangles with one, and a mask of what is fixed. */
static void strided_floats(const Faired *made) {
    const Cap *cap = &made->cap;
    Vertex *vs = (Vertex *)must(malloc(cap->vertices * sizeof *vs));
    uint32_t *rows = (uint32_t *)must(malloc(cap->triangles * 20));
    uint8_t *fixed = (uint8_t *)must(malloc(cap->vertices * 3));
    SIZED(fairmesh_mesh, mesh);
    fairmesh_selection others = cap->selection;
    ZERO(fairmesh_points_out, floats);
    size_t v, c;
    mesh.positions.data = vs[0].at;
    mesh.positions.count = cap->vertices;
    mesh.positions.stride = sizeof *vs;
    mesh.positions.scalar = FAIRMESH_SCALAR_FLOAT32;
    mesh.triangles.data = rows + 1;
    mesh.triangles.count = cap->triangles;
    mesh.triangles.stride = 20;
    for (v = 0; v < cap->vertices; v++) {
        for (c = 0; c < 3; c++) vs[v].at[c] = (float)cap->positions[3 * v + c];
        vs[v].colour[0] = vs[v].colour[1] = (uint16_t)v;
        vs[v].weight = 0.5f;
        fixed[3 * v] = !cap->free_mask[v];
    }
    for (v = 0; v < cap->triangles; v++) memcpy(rows + 5 * v + 1, cap->corners + 3 * v, 12);
    others.kind = FAIRMESH_SELECTION_KIND_FIXED_MASK;
    others.data = fixed;
    others.stride = 3;
    floats.data = vs[0].at;
    floats.count = cap->vertices;
    floats.stride = sizeof *vs;
    floats.scalar = FAIRMESH_SCALAR_FLOAT32;
    OK(fairmesh_fair(&mesh, &others, NULL, &floats, NULL, NULL, &error));
    for (v = 0; v < cap->vertices; v++) {
        CHECK(vs[v].weight == 0.5f && vs[v].colour[0] == (uint16_t)v);
        for (c = 0; c < 3; c++) CHECK(fabs(vs[v].at[c] - made->out[3 * v + c]) < 2e-6);
    }
    free(vs);
    free(rows);
    free(fixed);
}

/* Everything but the outer boundary is free, cancelled after one iteration. */
static void cancelled(const Cap *cap) {
    fairmesh_options options = quick();
    SIZED(fairmesh_report, report);
    ZERO(Watch, w);
    w.stop_at = 1;
    options.progress = watch;
    options.user_data = &w;
    OK(fairmesh_fair(&cap->mesh, NULL, &options, NULL, &report, NULL, &error));
    CHECK(report.outcome == FAIRMESH_OUTCOME_CANCELLED && report.iterations == 1);
    CHECK(report.free_vertices == 13 * 13);
}

/* Two free vertices that nothing connects. */
static void two_apart(const Cap *cap) {
    const uint32_t two[2] = {2 * 15 + 2, 12 * 15 + 12};
    fairmesh_options options = quick();
    SIZED(fairmesh_selection, apart);
    SIZED(fairmesh_component, part);
    fairmesh_attempt attempt;
    SIZED(fairmesh_report, report);
    fairmesh_result *result = NULL;
    size_t v;
    apart.kind = FAIRMESH_SELECTION_KIND_FREE_VERTICES;
    apart.data = two;
    apart.count = 2;
    OK(fairmesh_fair(&cap->mesh, &apart, &options, NULL, &report, &result, &error));
    CHECK(report.free_vertices == 2 && report.component_count == 2);
    for (v = 0; v < 2; v++) {
        OK(fairmesh_result_component(result, 0, v, &part, &error));
        CHECK(part.vertex == two[v] && part.free_vertices == 1 && part.outcome == FAIRMESH_OUTCOME_CONVERGED);
        CHECK(part.iterations <= report.iterations && part.diagonal <= report.diagonal);
        CHECK(part.bending_energy > 0 && part.bending_energy < report.bending_energy && part.member_weight == 0);
        CHECK(part.attempt_count == 1 && part.continuity_count == 0);
        attempt.struct_size = sizeof attempt;
        OK(fairmesh_result_attempt(result, 0, v, 0, &attempt, &error));
        CHECK(strcmp(attempt.name, "direct") == 0 && attempt.end == FAIRMESH_ATTEMPT_END_SOUND);
        CHECK(attempt.free_vertices == 1 && attempt.iterations == part.iterations);
        CHECK(fabs(attempt.bending_energy - part.bending_energy) <= 1e-6 * part.bending_energy);
        CHECK(fairmesh_result_attempt(result, 0, v, 1, &attempt, &error) == FAIRMESH_STATUS_NOT_AVAILABLE);
    }
    CHECK(fairmesh_result_attempt(result, 0, 2, 0, &attempt, &error) == FAIRMESH_STATUS_NOT_AVAILABLE);
    CHECK(fairmesh_result_attempt(result, 1, 0, 0, &attempt, &error) == FAIRMESH_STATUS_NOT_AVAILABLE);
    CHECK(fairmesh_result_component(result, 0, 2, &part, &error) == FAIRMESH_STATUS_NOT_AVAILABLE);
    CHECK(fairmesh_result_component(result, 1, 0, &part, &error) == FAIRMESH_STATUS_NOT_AVAILABLE);
    OK(fairmesh_result_free(result));
}

static void curvature_of_mesh(const Cap *cap) {
    double *h = (double *)must(malloc(cap->vertices * sizeof(double)));
    fairmesh_scalars_out numbers = scalars_out_of(h, cap->vertices);
    size_t v;
    OK(fairmesh_mean_curvature(&cap->mesh, &numbers, &error));
    for (v = 0; v < cap->vertices; v++) CHECK(h[v] == h[v]);
    free(h);
}

static void one_shot(void) {
    Faired made = one_call();
    curvatures_of_result(&made);
    boundary_of_result(&made);
    rest_of_result(&made);
    normals_given_back(&made);
    in_place_by_list(&made);
    soup(&made);
    strided_floats(&made);
    cancelled(&made.cap);
    two_apart(&made.cap);
    curvature_of_mesh(&made.cap);
    free(made.out);
    free(made.normals);
    free(made.boundary);
    cap_free(&made.cap);
}

/* A triangle that stands in one that lies: alone, they touch nothing. */
static void intersections(void) {
    static const double x[] = {0, 0, 0, 2, 0, 0, 0, 2, 0, 0.5, 0.5, -1, 0.5, 0.5, 1, 3, 3, 0};
    static const uint32_t corners[] = {0, 1, 2, 3, 4, 5, 1, 5, 2};
    static const uint32_t expected[] = {0, 1, 1, 2};
    uint32_t pairs[4], first = 0;
    size_t size = 0;
    const fairmesh_mesh mesh = mesh_of(x, 6, corners, 3);
    const fairmesh_indices among = indices_of(&first, 1);
    fairmesh_result *result = NULL;
    OK(fairmesh_self_intersections(&mesh, NULL, NULL, NULL, &result, &error));
    OK(fairmesh_result_list(result, FAIRMESH_LIST_INTERSECTIONS, 0, pairs, 4, &size, &error));
    CHECK(size == 4 && memcmp(pairs, expected, sizeof pairs) == 0);
    CHECK(info_of(result).kind == FAIRMESH_RESULT_KIND_INTERSECTIONS);
    OK(fairmesh_result_free(result));
    OK(fairmesh_self_intersections(&mesh, &among, NULL, NULL, &result, &error));
    OK(fairmesh_result_list(result, FAIRMESH_LIST_INTERSECTIONS, 0, pairs, 4, &size, &error));
    CHECK(size == 2 && pairs[0] == 0 && pairs[1] == 1);
    OK(fairmesh_result_free(result));
    first = 3;
    CHECK(fairmesh_self_intersections(&mesh, &among, NULL, NULL, &result, &error) == FAIRMESH_STATUS_SELECTION_OUT_OF_RANGE);
    CHECK(fairmesh_self_intersections(&mesh, NULL, NULL, NULL, NULL, &error) == FAIRMESH_STATUS_NULL_POINTER);
}

/* A solver for a cap, what it reported last, and where its positions go. */
typedef struct {
    Cap cap;
    fairmesh_solver *solver;
    fairmesh_report report;
    double *steps;
    fairmesh_points_out to;
} Stepped;

/* Single iterations end where one call does. */
static void one_iteration_at_a_time(Stepped *at) {
    const Cap *cap = &at->cap;
    fairmesh_options options = quick();
    size_t bytes = 3 * cap->vertices * sizeof(double), v;
    double *whole = (double *)must(malloc(bytes)), *h = (double *)must(malloc(cap->vertices * sizeof(double)));
    fairmesh_points_out to = points_out_of(whole, cap->vertices);
    fairmesh_scalars_out numbers = scalars_out_of(h, cap->vertices);
    fairmesh_result *result = NULL;
    uint64_t runs = 0;
    OK(fairmesh_fair(&cap->mesh, &cap->selection, &options, &to, NULL, NULL, &error));
    OK(fairmesh_solver_new(&cap->mesh, &cap->selection, &options, &at->solver, &error));
    OK(fairmesh_solver_positions(at->solver, &at->to, &error));
    CHECK(memcmp(at->steps, cap->positions, bytes) == 0);
    do {
        OK(fairmesh_solver_run(at->solver, 1, &at->report, &error));
        runs++;
    } while (at->report.outcome == FAIRMESH_OUTCOME_ITERATION_LIMIT);
    CHECK(at->report.outcome == FAIRMESH_OUTCOME_CONVERGED && runs >= at->report.iterations);
    OK(fairmesh_solver_positions(at->solver, &at->to, &error));
    CHECK(memcmp(at->steps, whole, bytes) == 0);
    OK(fairmesh_solver_result(at->solver, &result, &error));
    OK(fairmesh_result_scalars(result, FAIRMESH_SCALARS_MEAN_CURVATURE, &numbers, &error));
    OK(fairmesh_result_free(result));
    for (v = 0; v < cap->vertices; v++) {
        if (cap->free_mask[v]) CHECK(fabs(h[v] + 1.0) < 0.02);
    }
    free(whole);
    free(h);
}

/* Another curvature inside, and then the normals of the sphere, one vector per vertex. */
static void another_target_and_normals(Stepped *at) {
    const Cap *cap = &at->cap;
    fairmesh_options asked = quick();
    size_t bytes = 3 * cap->vertices * sizeof(double), v;
    double *unit = (double *)must(malloc(bytes));
    asked.target.kind = FAIRMESH_TARGET_KIND_CONSTANT;
    asked.target.constant = 2.0;
    OK(fairmesh_solver_set(at->solver, FAIRMESH_SETTING_TARGET, &asked, &error));
    OK(fairmesh_solver_run(at->solver, 1000, &at->report, &error));
    CHECK(at->report.outcome == FAIRMESH_OUTCOME_CONVERGED);
    OK(fairmesh_solver_positions(at->solver, &at->to, &error));
    CHECK(off_sphere(at->steps, cap->vertices) > 1e-4);
    /* The default is the harmonic one. */
    OK(fairmesh_solver_set(at->solver, FAIRMESH_SETTING_TARGET, NULL, &error));
    asked.boundary_normals.kind = FAIRMESH_BOUNDARY_NORMALS_KIND_GIVEN;
    memcpy(unit, cap->positions, bytes);
    for (v = 0; v < cap->vertices; v++) {
        if (cap->free_mask[v]) memset(unit + 3 * v, 0, 24);
    }
    asked.boundary_normals.vectors = points_of(unit, cap->vertices);
    OK(fairmesh_solver_set(at->solver, FAIRMESH_SETTING_BOUNDARY_NORMALS, &asked, &error));
    free(unit);
    OK(fairmesh_solver_run(at->solver, 1000, &at->report, &error));
    CHECK(at->report.outcome == FAIRMESH_OUTCOME_CONVERGED);
    OK(fairmesh_solver_positions(at->solver, &at->to, &error));
    CHECK(off_sphere(at->steps, cap->vertices) < 2e-3);
}

static void reports_of_solver(const Stepped *at) {
    SIZED(fairmesh_report, again);
    SIZED(fairmesh_component, all);
    SIZED(fairmesh_attempt, attempt);
    fairmesh_result *result = NULL;
    OK(fairmesh_solver_result(at->solver, &result, &error));
    OK(fairmesh_result_report(result, 0, &again, &error));
    CHECK(memcmp(&again, &at->report, sizeof again) == 0);
    OK(fairmesh_result_component(result, 0, 0, &all, &error));
    CHECK(all.free_vertices == again.free_vertices && all.outcome == again.outcome);
    CHECK(all.bending_energy == again.bending_energy && all.attempt_count >= 1);
    OK(fairmesh_result_attempt(result, 0, 0, all.attempt_count - 1, &attempt, &error));
    CHECK(attempt.name[0] != 0 && attempt.free_vertices == again.free_vertices);
    OK(fairmesh_result_free(result));
}

static void in_steps(void) {
    Stepped at;
    fairmesh_result *result = NULL;
    memset(&at, 0, sizeof at);
    at.cap = cap_new(15);
    at.report.struct_size = sizeof at.report;
    at.steps = (double *)must(malloc(3 * at.cap.vertices * sizeof(double)));
    at.to = points_out_of(at.steps, at.cap.vertices);
    one_iteration_at_a_time(&at);
    another_target_and_normals(&at);
    reports_of_solver(&at);
    OK(fairmesh_solver_result(at.solver, &result, &error));
    OK(fairmesh_solver_free(at.solver));
    CHECK(fairmesh_solver_free(at.solver) == FAIRMESH_STATUS_BAD_HANDLE);
    CHECK(fairmesh_solver_run(at.solver, 1, NULL, NULL) == FAIRMESH_STATUS_BAD_HANDLE);
    OK(fairmesh_result_positions(result, &at.to, &error));
    CHECK(off_sphere(at.steps, at.cap.vertices) < 2e-3);
    OK(fairmesh_result_free(result));
    OK(fairmesh_solver_free(NULL));
    free(at.steps);
    cap_free(&at.cap);
}

/* The number of the loop that is a hole, of two. */
static uint32_t loop_of_hole(const fairmesh_mesh *mesh) {
    fairmesh_result *loops = NULL;
    SIZED(fairmesh_loop, boundary);
    uint64_t l, hole = 99;
    OK(fairmesh_boundary_loops(mesh, &loops, &error));
    fairmesh_info info = info_of(loops);
    CHECK(info.kind == FAIRMESH_RESULT_KIND_LOOPS && info.loop_count == 2);
    for (l = 0; l < 2; l++) {
        OK(fairmesh_result_loop(loops, l, &boundary, &error));
        CHECK(size_of_list(loops, FAIRMESH_LIST_LOOP_VERTICES, l) == boundary.vertex_count && boundary.edge_a == UINT32_MAX);
        if (boundary.kind == FAIRMESH_LOOP_KIND_HOLE) hole = l;
        CHECK(size_of_list(loops, FAIRMESH_LIST_LOOP_TOUCHING, l) == 0);
    }
    CHECK(hole < 2);
    OK(fairmesh_result_free(loops));
    return (uint32_t)hole;
}

static void reports_of_filling(const Cap *cap, const fairmesh_result *filled, uint32_t hole) {
    fairmesh_info info = info_of(filled);
    CHECK(info.kind == FAIRMESH_RESULT_KIND_FILLED && info.loop_count == 1);
    CHECK(info.new_vertex_count > 5 && info.new_triangle_count > 20);
    fairmesh_fill_report what = fill_report_of(filled, 0);
    CHECK(what.outcome == FAIRMESH_FILL_OUTCOME_FAIRED && what.loop_index == hole && what.has_report);
    CHECK(what.first_vertex == cap->vertices && what.vertex_count == info.new_vertex_count);
    CHECK(report_of(filled, 0).outcome == FAIRMESH_OUTCOME_CONVERGED);
    CHECK(size_of_list(filled, FAIRMESH_LIST_OUTSIDE_VERTICES, 0) == what.outside_count);
}

/* What was there stands before what is new, which is on the sphere. */
static void mesh_of_filling(const Cap *cap, const fairmesh_result *filled, size_t kept) {
    double *positions = positions_of(filled);
    uint32_t *corners = triangles_of(filled);
    CHECK(memcmp(corners, cap->corners, kept * 12) == 0);
    CHECK(memcmp(positions, cap->positions, cap->vertices * 24) == 0);
    CHECK(off_sphere(positions + 3 * cap->vertices, (size_t)info_of(filled).new_vertex_count) < 5e-3);
    free(positions);
    free(corners);
}

static void parents_of_filling(const Cap *cap, const fairmesh_result *filled) {
    size_t size, v;
    uint32_t *list = list_of(filled, FAIRMESH_LIST_PARENTS, 0, &size);
    double *weights = vectors_of(filled, FAIRMESH_VECTORS_PARENT_WEIGHTS, size / 3);
    CHECK(size == 3 * info_of(filled).new_vertex_count);
    for (v = 0; v < size; v += 3) {
        CHECK(list[v] < cap->vertices && fabs(weights[v] + weights[v + 1] + weights[v + 2] - 1.0) < 1e-9);
    }
    free(list);
    free(weights);
}

static void holes(void) {
    Cap cap = cap_new(15);
    fairmesh_mesh mesh = cap.mesh;
    fairmesh_options options = quick();
    fairmesh_fill_options fill = filling();
    fairmesh_result *filled = NULL;
    size_t t, kept = 0;
    uint32_t hole;
    /* The dent goes, and leaves a hole. */
    for (t = 0; t < cap.triangles; t++) {
        const uint32_t *c = cap.corners + 3 * t;
        if (!cap.free_mask[c[0]] && !cap.free_mask[c[1]] && !cap.free_mask[c[2]]) {
            memmove(cap.corners + 3 * kept++, c, 12);
        }
    }
    mesh.triangles.count = kept;
    hole = loop_of_hole(&mesh);
    fill.loops = indices_of(&hole, 1);
    OK(fairmesh_fill_holes(&mesh, &fill, &options, &filled, &error));
    reports_of_filling(&cap, filled, hole);
    mesh_of_filling(&cap, filled, kept);
    parents_of_filling(&cap, filled);
    OK(fairmesh_result_free(filled));
    cap_free(&cap);
}

static void remeshing(void) {
    Cap cap = cap_new(15);
    fairmesh_remesh_options again;
    fairmesh_result *remeshed = NULL;
    OK(fairmesh_remesh_options_init(&again, sizeof again));
    again.density *= 1.5;
    OK(fairmesh_remesh(&cap.mesh, &cap.selection, &again, &remeshed, &error));
    fairmesh_info info = info_of(remeshed);
    CHECK(info.kind == FAIRMESH_RESULT_KIND_REMESHED && info.vertex_count > cap.vertices);
    CHECK(size_of_list(remeshed, FAIRMESH_LIST_KEPT_VERTICES, 0) + info.new_vertex_count == info.vertex_count);
    CHECK(size_of_list(remeshed, FAIRMESH_LIST_KEPT_TRIANGLES, 0) + info.new_triangle_count == info.triangle_count);
    CHECK(size_of_list(remeshed, FAIRMESH_LIST_FREE_VERTICES, 0) > 25);
    OK(fairmesh_result_free(remeshed));
    cap_free(&cap);
}

/* Whether a filled mesh is closed, of genus 0, and its new vertices on the unit sphere. */
static void check_whole_sphere(const fairmesh_result *filled) {
    const fairmesh_info info = info_of(filled);
    double *positions = positions_of(filled);
    uint32_t *corners = triangles_of(filled);
    const fairmesh_mesh mesh = mesh_of(positions, (size_t)info.vertex_count, corners, (size_t)info.triangle_count);
    fairmesh_result *loops = NULL;
    CHECK(info.vertex_count - info.triangle_count / 2 == 2);
    CHECK(info.new_vertex_count > 30 && off_sphere(positions, (size_t)info.vertex_count) < 1e-8);
    OK(fairmesh_boundary_loops(&mesh, &loops, NULL));
    CHECK(info_of(loops).loop_count == 0);
    OK(fairmesh_result_free(loops));
    free(positions);
    free(corners);
}

static void two_components(const Ball *ball) {
    fairmesh_result *result = NULL;
    SIZED(fairmesh_loop, boundary);
    uint32_t *of;
    size_t t;
    OK(fairmesh_components(&ball->mesh, &result, &error));
    fairmesh_info info = info_of(result);
    CHECK(info.kind == FAIRMESH_RESULT_KIND_COMPONENTS && info.component_count == 2);
    CHECK(info.vertex_count == BALL_VERTICES && info.triangle_count == BALL_TRIANGLES);
    of = list_of(result, FAIRMESH_LIST_TRIANGLE_COMPONENTS, 0, NULL);
    for (t = 0; t < BALL_TRIANGLES; t++) CHECK(of[t] == t / BALL_CAP_TRIANGLES);
    OK(fairmesh_result_free(result));
    free(of);
    OK(fairmesh_boundary_loops(&ball->mesh, &result, &error));
    OK(fairmesh_result_loop(result, 1, &boundary, &error));
    CHECK(boundary.component == 1 && boundary.vertex_count == BALL_ROUND);
    OK(fairmesh_result_free(result));
}

static void first_two_are_joined(const fairmesh_result *result) {
    uint32_t list[2] = {9, 9};
    size_t size = 0;
    OK(fairmesh_result_list(result, FAIRMESH_LIST_JOINED_LOOPS, 0, list, 2, &size, &error));
    CHECK(size == 2 && list[0] == 0 && list[1] == 1);
}

/* What is suggested is what is done without being told. */
static void joined_by_themselves(const Ball *ball) {
    fairmesh_options options = quick();
    fairmesh_fill_options fill = filling();
    SIZED(fairmesh_join_suggestion, suggestion);
    fairmesh_result *result = NULL;
    OK(fairmesh_suggest_joins(&ball->mesh, NULL, &result, &error));
    fairmesh_info info = info_of(result);
    CHECK(info.kind == FAIRMESH_RESULT_KIND_JOINS && info.loop_count == 1);
    OK(fairmesh_result_suggestion(result, 0, &suggestion, &error));
    CHECK(suggestion.loop_count == 2 && suggestion.joint_bend < 0.9 * suggestion.separate_bend);
    CHECK(suggestion.joint_area > 0 && suggestion.separate_area > 0);
    CHECK(fairmesh_result_suggestion(result, 1, &suggestion, &error) == FAIRMESH_STATUS_NOT_AVAILABLE);
    first_two_are_joined(result);
    OK(fairmesh_result_free(result));

    CHECK(fill.join.kind == FAIRMESH_JOIN_KIND_NONE && fill.on_failure == FAIRMESH_ON_FAILURE_BEST && fill.only_listed == 0);
    fill.join.kind = FAIRMESH_JOIN_KIND_AUTO;
    OK(fairmesh_fill_holes(&ball->mesh, &fill, &options, &result, &error));
    check_whole_sphere(result);
    fairmesh_fill_report what = fill_report_of(result, 0);
    CHECK(what.outcome == FAIRMESH_FILL_OUTCOME_FAIRED && what.joined_count == 2 && what.edge_count == 2 * BALL_ROUND);
    CHECK(what.joint_bend == suggestion.joint_bend && what.separate_area == suggestion.separate_area);
    CHECK(what.reason_element == FAIRMESH_NO_ELEMENT && what.reason_other == FAIRMESH_NO_ELEMENT);
    first_two_are_joined(result);
    OK(fairmesh_result_free(result));
}

/* By their numbers, and no other loop; a third one is not there; a group for each is as no group. */
static void joined_by_number(Ball *ball) {
    fairmesh_options options = quick();
    fairmesh_fill_options fill = filling();
    fairmesh_result *result = NULL;
    uint32_t loops[3] = {1, 0, 2}, starts[2] = {0, 2};
    size_t t;
    fill.join.kind = FAIRMESH_JOIN_KIND_GROUPS;
    fill.join.loops = indices_of(loops, 2);
    fill.only_listed = 1;
    OK(fairmesh_fill_holes(&ball->mesh, &fill, &options, &result, &error));
    check_whole_sphere(result);
    fairmesh_fill_report what = fill_report_of(result, 0);
    CHECK(info_of(result).loop_count == 1 && what.joined_count == 2 && what.joint_bend != what.joint_bend);
    OK(fairmesh_result_free(result));
    fill.join.starts = indices_of(starts, 1);
    fill.join.loops.count = 3;
    CHECK(fairmesh_fill_holes(&ball->mesh, &fill, &options, &result, &error) == FAIRMESH_STATUS_SELECTION_OUT_OF_RANGE);
    CHECK(error.element_kind == FAIRMESH_ELEMENT_LOOP && error.element == 2);
    starts[1] = 1;
    fill.join.starts.count = 2;
    fill.join.loops.count = 2;
    OK(fairmesh_fill_holes(&ball->mesh, &fill, &options, &result, &error));
    CHECK(info_of(result).loop_count == 2);
    OK(fairmesh_result_free(result));

    /* One cap turned around: refused, with the two loops. */
    for (t = BALL_CAP_TRIANGLES; t < BALL_TRIANGLES; t++) {
        uint32_t *c = ball->corners + 3 * t, kept = c[1];
        c[1] = c[2];
        c[2] = kept;
    }
    fill.join.starts.count = 0;
    OK(fairmesh_fill_holes(&ball->mesh, &fill, &options, &result, &error));
    what = fill_report_of(result, 0);
    CHECK(what.outcome == FAIRMESH_FILL_OUTCOME_LEFT_OPEN && what.reason == FAIRMESH_FILL_REASON_OPPOSITE_SIDES);
    CHECK(what.reason_element == 0 && what.reason_other == 1 && what.triangle_count == 0);
    OK(fairmesh_result_free(result));
}

/* Two caps of a sphere, joined: by themselves, by their numbers, not if one of them is turned around. */
static void joins(void) {
    Ball *ball = (Ball *)must(malloc(sizeof *ball));
    ball_make(ball);
    two_components(ball);
    joined_by_themselves(ball);
    joined_by_number(ball);
    free(ball);
}

static void strip_alone(const Ball *ball, const fairmesh_indices *from, const fairmesh_indices *to) {
    fairmesh_options options = quick();
    SIZED(fairmesh_bridge_report, told);
    SIZED(fairmesh_report, report);
    fairmesh_result *result = NULL;
    size_t size;
    OK(fairmesh_bridge(&ball->mesh, from, to, NULL, NULL, &options, &result, &error));
    OK(fairmesh_result_bridge(result, &told, &error));
    CHECK(!told.has_whole && told.rest_count == 0 && fabs(told.twist) < 20);
    fairmesh_fill_report strip = fill_report_of(result, 0);
    CHECK(strip.outcome == FAIRMESH_FILL_OUTCOME_FAIRED && strip.triangle_count > 10);
    CHECK(size_of_list(result, FAIRMESH_LIST_BRIDGE_CHAIN, 1) == 3);
    CHECK(size_of_list(result, FAIRMESH_LIST_BRIDGE_SIDE, 0) > 0);
    CHECK(fairmesh_result_list(result, FAIRMESH_LIST_BRIDGE_SIDE, 2, NULL, 0, &size, &error) == FAIRMESH_STATUS_NOT_AVAILABLE);
    CHECK(fairmesh_result_report(result, 1, &report, &error) == FAIRMESH_STATUS_NOT_AVAILABLE);
    OK(fairmesh_result_free(result));
}

static void strip_and_rest(const Ball *ball, const fairmesh_indices *from, const fairmesh_indices *to) {
    fairmesh_options options = quick();
    fairmesh_bridge_options how;
    SIZED(fairmesh_bridge_report, told);
    fairmesh_result *result = NULL;
    OK(fairmesh_bridge_options_init(&how, sizeof how));
    CHECK(how.fill == 0 && how.width == 0);
    how.fill = 1;
    OK(fairmesh_bridge(&ball->mesh, from, to, &how, NULL, &options, &result, &error));
    OK(fairmesh_result_bridge(result, &told, &error));
    CHECK(told.has_whole && told.rest_count == 1);
    fairmesh_info info = info_of(result);
    CHECK(info.kind == FAIRMESH_RESULT_KIND_BRIDGED && info.loop_count == 2);
    CHECK(report_of(result, 2).outcome == FAIRMESH_OUTCOME_CONVERGED);
    check_whole_sphere(result);
    OK(fairmesh_result_free(result));
    how.width = -1;
    CHECK(fairmesh_bridge(&ball->mesh, from, to, &how, NULL, &options, &result, &error) == FAIRMESH_STATUS_BAD_OPTION);
    CHECK(error.element == 4 && error.other == offsetof(fairmesh_bridge_options, width));
}

/* Guides from these two vertices and from those across. */
static void guides(const Ball *ball, uint32_t from, uint32_t to) {
    fairmesh_options options = quick();
    fairmesh_fill_options fill = filling();
    fairmesh_result *result = NULL;
    uint32_t guide[4];
    fill.join.kind = FAIRMESH_JOIN_KIND_AUTO;
    fill.guides = indices_of(guide, 2);
    guide[0] = from, guide[1] = to;
    guide[2] = from + BALL_ROUND / 2, guide[3] = to + BALL_ROUND / 2;
    OK(fairmesh_fill_holes(&ball->mesh, &fill, &options, &result, &error));
    check_whole_sphere(result);
    OK(fairmesh_result_free(result));
    guide[3] = 0;
    CHECK(fairmesh_fill_holes(&ball->mesh, &fill, &options, &result, &error) == FAIRMESH_STATUS_BAD_GUIDE);
    CHECK(error.element_kind == FAIRMESH_ELEMENT_EDGE);
}

/* Every list and struct that a call can have, at once: there is room for them. */
static void all_lists_at_once(const Ball *ball, const fairmesh_indices *from, const fairmesh_indices *to) {
    static const uint32_t zero[1] = {0}, pair[2] = {0, 1};
    const uint32_t *rim = from->data;
    const double one = 1.0;
    fairmesh_options options = quick();
    fairmesh_fill_options fill = filling();
    fairmesh_bridge_options how;
    fairmesh_result *result = NULL;
    OK(fairmesh_bridge_options_init(&how, sizeof how));
    fill.loops = fill.join.loops = fill.join.starts = fill.filter.components = indices_of(zero, 1);
    fill.join.kind = FAIRMESH_JOIN_KIND_GROUPS;
    fill.guides = options.marked_edges = indices_of(pair, 1);
    options.boundary_normals.kind = FAIRMESH_BOUNDARY_NORMALS_KIND_GIVEN;
    options.boundary_normals.vectors = points_of(ball->positions + 3 * rim[0], 1);
    options.boundary_curvature.kind = FAIRMESH_BOUNDARY_CURVATURE_KIND_GIVEN;
    options.boundary_curvature.values = options.loop_continuity.values = numbers_of(&one, 1);
    options.boundary_normals.vertices = options.boundary_curvature.vertices = options.loop_continuity.vertices = indices_of(rim, 1);
    OK(fairmesh_bridge(&ball->mesh, from, to, &how, &fill, &options, &result, &error));
    OK(fairmesh_result_free(result));
}

/* A strip between the two caps, and the rest filled; guides; chains that are none. */
static void bridges(void) {
    Ball *ball = (Ball *)must(malloc(sizeof *ball));
    fairmesh_options options = quick();
    fairmesh_result *result = NULL;
    uint32_t ends[2][3];
    const fairmesh_indices from = indices_of(ends[0], 3), to = indices_of(ends[1], 3);
    size_t k;
    ball_make(ball);
    for (k = 0; k < 3; k++) {
        ends[0][k] = (uint32_t)(BALL_CAP - BALL_ROUND + k);
        ends[1][k] = (uint32_t)(BALL_VERTICES - BALL_ROUND + k);
    }
    strip_alone(ball, &from, &to);
    strip_and_rest(ball, &from, &to);
    all_lists_at_once(ball, &from, &to);
    ends[1][1] = 0;
    CHECK(fairmesh_bridge(&ball->mesh, &from, &to, NULL, NULL, &options, &result, &error) == FAIRMESH_STATUS_BAD_CHAIN);
    CHECK(error.element_kind == FAIRMESH_ELEMENT_VERTEX && error.element == 0);
    guides(ball, ends[0][0], ends[1][0]);
    free(ball);
}

/* A crease of a box that was rounded: the edge from one corner to another. */
static void check_crease(const fairmesh_result *result, uint64_t index) {
    SIZED(fairmesh_crease, crease);
    size_t size;
    uint32_t *along = list_of(result, FAIRMESH_LIST_CREASE_VERTICES, index, &size);
    OK(fairmesh_result_crease(result, index, &crease, &error));
    CHECK(crease.vertex_count == 2 && size == 2 && along[0] != along[1]);
    CHECK(fabs(crease.bend - 90) < 1e-9 && !crease.is_unsolved && crease.part == 1);
    free(along);
}

/* An edge of a box; what cannot be. */
static void rounding(void) {
    static double corners[24];
    static const uint32_t faces[36] = {0, 2, 3, 0, 3, 1, 4, 5, 7, 4, 7, 6, 0, 1, 5, 0, 5, 4,
                                       2, 6, 7, 2, 7, 3, 0, 4, 6, 0, 6, 2, 1, 3, 7, 1, 7, 5};
    static const uint32_t edge[2] = {0, 1}, nowhere[2] = {0, 8};
    fairmesh_options options = quick();
    fairmesh_round_options how;
    fairmesh_result *result = NULL;
    SIZED(fairmesh_mesh, box);
    SIZED(fairmesh_crease, crease);
    size_t k, size;
    for (k = 0; k < 24; k++) corners[k] = (k / 3) >> (k % 3) & 1 ? 1 : -1;
    box.positions = points_of(corners, 8);
    box.triangles = indices_of(faces, 12);
    OK(fairmesh_round_options_init(&how, sizeof how));
    CHECK(how.width == 0 && how.radius == 0 && how.creases == FAIRMESH_CREASES_ALL);
    CHECK(fairmesh_round(&box, &how, &options, &result, &error) == FAIRMESH_STATUS_BAD_OPTION);
    CHECK(error.element == 2 && error.other == offsetof(fairmesh_round_options, width));
    how.width = 0.6;
    how.edges = indices_of(edge, 1);
    OK(fairmesh_round(&box, &how, &options, &result, &error));
    fairmesh_info info = info_of(result);
    CHECK(info.kind == FAIRMESH_RESULT_KIND_ROUNDED && info.is_success && info.crease_count == 12 && info.crease_angle < 90);
    CHECK(info.triangle_count > info.new_triangle_count && report_of(result, 0).outcome == FAIRMESH_OUTCOME_CONVERGED);
    for (k = size = 0; k < 12; k++) {
        check_crease(result, k);
        OK(fairmesh_result_crease(result, k, &crease, &error));
        size += crease.is_rounded;
    }
    CHECK(size == 1 && size_of_list(result, FAIRMESH_LIST_KEPT_VERTICES, 0) >= 6);
    CHECK(fairmesh_result_crease(result, 12, &crease, &error) == FAIRMESH_STATUS_NOT_AVAILABLE);
    CHECK(size_of_list(result, FAIRMESH_LIST_SHARP_CORNERS, 0) == 0);
    CHECK(size_of_list(result, FAIRMESH_LIST_FREE_VERTICES, 0) > 50);
    CHECK(size_of_list(result, FAIRMESH_LIST_KEPT_TRIANGLES, 0) == info.triangle_count - info.new_triangle_count);
    OK(fairmesh_result_free(result));
    how.edges = indices_of(nowhere, 1);
    CHECK(fairmesh_round(&box, &how, &options, &result, &error) == FAIRMESH_STATUS_NOT_AN_EDGE);
    CHECK(error.element_kind == FAIRMESH_ELEMENT_EDGE && error.element == 0 && error.other == 8);
    how.edges = indices_of(NULL, 0);
    how.creases = FAIRMESH_CREASES_CONCAVE;
    CHECK(fairmesh_round(&box, &how, &options, &result, &error) == FAIRMESH_STATUS_NO_CREASE);
    how.creases = 3;
    CHECK(fairmesh_round(&box, &how, &options, &result, &error) == FAIRMESH_STATUS_BAD_ENUM);
}

/* What stays of the mesh when these faces are erased, and the loop that they leave. */
static size_t erased_from(const Cap *cap, const fairmesh_indices *faces, uint32_t *hole, uint32_t *corners) {
    fairmesh_result *erased = NULL;
    uint32_t *left, *found;
    size_t t, size;
    OK(fairmesh_erase(&cap->mesh, faces, 0, &erased, &error));
    fairmesh_info info = info_of(erased);
    CHECK(info.kind == FAIRMESH_RESULT_KIND_ERASED && info.loop_count == 1 && info.vertex_count == cap->vertices);
    CHECK(info.triangle_count + info.dropped_count + faces->count == cap->triangles);
    found = list_of(erased, FAIRMESH_LIST_ERASED_LOOPS, 0, &size);
    CHECK(size == 1);
    *hole = found[0];
    left = list_of(erased, FAIRMESH_LIST_KEPT_TRIANGLES, 0, &size);
    CHECK(size == info.triangle_count);
    for (t = 0; t < size; t++) memcpy(corners + 3 * t, cap->corners + 3 * left[t], 12);
    OK(fairmesh_result_free(erased));
    free(found);
    free(left);
    return size;
}

static void filled_where_erased(const Cap *cap, const fairmesh_mesh *left, uint32_t hole) {
    fairmesh_options options = quick();
    fairmesh_fill_options fill = filling();
    fairmesh_result *filled = NULL;
    double *positions;
    fill.loops = indices_of(&hole, 1);
    fill.on_failure = FAIRMESH_ON_FAILURE_OPEN;
    OK(fairmesh_fill_holes(left, &fill, &options, &filled, &error));
    fairmesh_fill_report what = fill_report_of(filled, 0);
    CHECK(what.outcome == FAIRMESH_FILL_OUTCOME_FAIRED && what.loop_index == hole);
    positions = positions_of(filled);
    CHECK(off_sphere(positions + 3 * cap->vertices, (size_t)info_of(filled).new_vertex_count) < 5e-3);
    free(positions);
    OK(fairmesh_result_free(filled));
    /* One iteration is not enough, and such loops stay open. */
    options.max_iterations = 1;
    OK(fairmesh_fill_holes(left, &fill, &options, &filled, &error));
    what = fill_report_of(filled, 0);
    CHECK(what.outcome == FAIRMESH_FILL_OUTCOME_LEFT_OPEN && what.reason == FAIRMESH_FILL_REASON_NOT_FAIR);
    OK(fairmesh_result_free(filled));
}

/* A dent erased and filled. */
static void erasing(void) {
    Cap cap = cap_new(15);
    ZERO(fairmesh_indices, faces);
    fairmesh_mesh left = cap.mesh;
    fairmesh_result *erased = NULL;
    uint32_t *list = (uint32_t *)must(malloc(cap.triangles * 4)), *corners = (uint32_t *)must(malloc(cap.triangles * 12));
    uint32_t hole;
    size_t t;
    faces.data = list;
    for (t = 0; t < cap.triangles; t++) {
        const uint32_t *c = cap.corners + 3 * t;
        if (cap.free_mask[c[0]] || cap.free_mask[c[1]] || cap.free_mask[c[2]]) list[faces.count++] = (uint32_t)t;
    }
    left.triangles.data = corners;
    left.triangles.count = erased_from(&cap, &faces, &hole, corners);
    filled_where_erased(&cap, &left, hole);
    list[0] = (uint32_t)cap.triangles;
    CHECK(fairmesh_erase(&cap.mesh, &faces, 0, &erased, &error) == FAIRMESH_STATUS_SELECTION_OUT_OF_RANGE);
    CHECK(error.element_kind == FAIRMESH_ELEMENT_TRIANGLE && error.element == cap.triangles);
    CHECK(fairmesh_erase(&cap.mesh, NULL, 0, &erased, &error) == FAIRMESH_STATUS_NULL_POINTER);
    free(corners);
    free(list);
    cap_free(&cap);
}

/* A sheet of squares without those in the middle, with a tooth that hangs in the hole by one edge; `rough` high its vertices go up and down. */
enum { SHEET = 16, SHEET_VERTICES = (SHEET + 1) * (SHEET + 1) + 1 };
typedef struct {
    double positions[3 * SHEET_VERTICES];
    uint32_t corners[6 * SHEET * SHEET + 3];
    fairmesh_mesh mesh;
} Sheet;

static void sheet_make(Sheet *sheet, double rough) {
    uint32_t i, j, side = SHEET + 1, first = SHEET / 2 - 2, *t = sheet->corners;
    for (i = 0; i <= SHEET; i++) {
        for (j = 0; j <= SHEET; j++) {
            double *p = sheet->positions + 3 * (side * i + j);
            p[0] = i;
            p[1] = j;
            p[2] = rough * ((7 * i * i + 5 * j * i + 3 * j) % 5);
        }
    }
    sheet->positions[3 * SHEET_VERTICES - 3] = first + 0.6;
    sheet->positions[3 * SHEET_VERTICES - 2] = first + 0.5;
    sheet->positions[3 * SHEET_VERTICES - 1] = 0.4;
    for (i = 0; i < SHEET; i++) {
        for (j = 0; j < SHEET; j++) {
            uint32_t a = side * i + j;
            if (i >= first && i < first + 4 && j >= first && j < first + 4) continue;
            t[0] = t[3] = a;
            t[1] = a + side;
            t[2] = t[4] = a + side + 1;
            t[5] = a + 1;
            t += 6;
        }
    }
    t[0] = side * first + first + 1;
    t[1] = side * first + first;
    t[2] = SHEET_VERTICES - 1;
    sheet->mesh = mesh_of(sheet->positions, SHEET_VERTICES, sheet->corners, (size_t)(t + 3 - sheet->corners) / 3);
}

static void trimming(void) {
    Sheet *sheet = (Sheet *)must(malloc(sizeof *sheet));
    uint32_t outer = 0, hole = 1, k;
    fairmesh_indices loops = indices_of(&hole, 1);
    fairmesh_info info;
    fairmesh_result *trimmed = NULL;
    size_t count, size;
    sheet_make(sheet, 0.0);
    count = sheet->mesh.triangles.count;
    for (k = 0; k < 2; k++) {
        uint32_t *kept;
        /* All holes, or this one: the tooth is gone, whose area is that of its two sides. */
        OK(fairmesh_trim_boundary(&sheet->mesh, k ? &loops : NULL, 100, 0.0, &trimmed, &error));
        info = info_of(trimmed);
        CHECK(info.kind == FAIRMESH_RESULT_KIND_TRIMMED && info.vertex_count == SHEET_VERTICES);
        CHECK(info.triangle_count == count - 1 && info.dropped_count == 1);
        CHECK(fabs(info.dropped_area - 0.5 * sqrt(0.36 + 0.16)) < 1e-12);
        kept = list_of(trimmed, FAIRMESH_LIST_KEPT_TRIANGLES, 0, &size);
        CHECK(size == count - 1 && kept[0] == 0 && kept[size - 1] == count - 2);
        free(kept);
        CHECK(fairmesh_result_triangles(trimmed, NULL, &error) != FAIRMESH_STATUS_OK);
        OK(fairmesh_result_free(trimmed));
    }
    /* Too small a limit, and the other loop. */
    OK(fairmesh_trim_boundary(&sheet->mesh, NULL, 100, 0.1, &trimmed, &error));
    info = info_of(trimmed);
    CHECK(info.dropped_count == 0 && info.dropped_area == 0.0);
    OK(fairmesh_result_free(trimmed));
    loops.data = &outer;
    OK(fairmesh_trim_boundary(&sheet->mesh, &loops, 2, 0.0, &trimmed, NULL));
    info = info_of(trimmed);
    CHECK(info.dropped_count == 2 && fabs(info.dropped_area - 1.0) < 1e-12);
    OK(fairmesh_result_free(trimmed));
    free(sheet);
}

/* What is advised can be handed over as it is; and more rings than any mesh has. */
static void relaxed_as_advised(const fairmesh_mesh *mesh, const fairmesh_loop *rough) {
    fairmesh_options options = quick();
    fairmesh_fill_options fill = filling();
    fairmesh_result *filled = NULL;
    fill.relax_rim = rough->advised_relax_rim;
    fill.relax_within = rough->advised_relax_within;
    OK(fairmesh_fill_holes(mesh, &fill, &options, &filled, &error));
    fairmesh_fill_report what = fill_report_of(filled, 1);
    CHECK(what.has_relaxed && what.moved_count > 16 && what.moved_within == rough->advised_relax_within);
    OK(fairmesh_result_free(filled));
    fill.relax_rim = UINT64_MAX;
    OK(fairmesh_fill_holes(mesh, &fill, &options, &filled, &error));
    what = fill_report_of(filled, 1);
    CHECK(what.has_relaxed && what.moved_count == SHEET_VERTICES - 1 - 9);
    OK(fairmesh_result_free(filled));
}

static void roughness(void) {
    Sheet *sheet = (Sheet *)must(malloc(sizeof *sheet));
    fairmesh_loop plain, of;
    fairmesh_result *loops = NULL, *rough = NULL;
    int k;
    plain.struct_size = of.struct_size = sizeof of;
    for (k = 0; k < 2; k++) {
        sheet_make(sheet, 0.05 * k);
        sheet->mesh.triangles.count--; /* without the tooth */
        OK(fairmesh_boundary_loops(&sheet->mesh, &loops, &error));
        OK(fairmesh_rim_roughness(&sheet->mesh, &rough, &error));
        OK(fairmesh_result_loop(loops, 1, &plain, &error));
        OK(fairmesh_result_loop(rough, 1, &of, &error));
        CHECK(plain.kind == of.kind && plain.vertex_count == 16 && of.vertex_count == 16 && plain.length == of.length);
        CHECK(!plain.has_roughness && !plain.is_rough && plain.roughness == 0.0 && plain.advised_relax_rim == 0);
        CHECK(of.has_roughness && (of.is_rough != 0) == (k == 1) && (of.rim_angle > 1.0) == (k == 1));
        CHECK((of.roughness > 2.0) == (k == 1) && (of.rim_noise > 0.02) == (k == 1) && of.rim_angle_expected < of.rim_angle + 1e-6);
        OK(fairmesh_result_free(loops));
        OK(fairmesh_result_free(rough));
    }
    CHECK(of.advised_relax_rim == 3 && fabs(of.advised_relax_within - 1.0) < 0.3);
    relaxed_as_advised(&sheet->mesh, &of);
    free(sheet);
}

/* Squares beside a narrow column are erased: up to so many of its triangles go with them. */
static void erasing_and_cleaning(void) {
    static double positions[3 * 49];
    static uint32_t corners[6 * 36];
    static const double x[] = {0.0, 1.0, 2.0, 2.02, 3.0, 4.0, 5.0};
    static const uint32_t gone[] = {40, 41, 42, 43};
    const fairmesh_mesh mesh = mesh_of(positions, 49, corners, 72);
    const fairmesh_indices faces = indices_of(gone, 4);
    fairmesh_info info;
    fairmesh_result *erased = NULL;
    uint32_t i, j, *t = corners;
    for (i = 0; i < 49; i++) {
        positions[3 * i] = x[i / 7];
        positions[3 * i + 1] = i % 7;
    }
    for (i = 0; i < 6; i++) {
        for (j = 0; j < 6; j++) {
            t[0] = t[3] = 7 * i + j;
            t[1] = t[0] + 7;
            t[2] = t[4] = t[0] + 8;
            t[5] = t[0] + 1;
            t += 6;
        }
    }
    for (i = 0; i <= 4; i += 2) {
        OK(fairmesh_erase(&mesh, &faces, i, &erased, &error));
        info = info_of(erased);
        CHECK(info.kind == FAIRMESH_RESULT_KIND_ERASED && info.cleaned_count == i && info.loop_count == 1);
        CHECK(info.triangle_count == 72 - 4 - info.cleaned_count - info.dropped_count);
        OK(fairmesh_result_free(erased));
    }
    CHECK(info.dropped_count == 1);
}

static int32_t stop_at_once(const fairmesh_progress *progress, void *user_data) {
    (void)progress;
    (void)user_data;
    return 1;
}

/* What these points, of which the first one is not finite, take over: they lie near the dent, a twelfth of the radius below them. */
static void carried_to(const Cap *cap, const double *positions, size_t count) {
    fairmesh_points points = points_of(positions, count);
    fairmesh_result *carried = NULL;
    uint32_t *triangles, *corners;
    double *weights;
    size_t k, i;
    OK(fairmesh_carry_over(&cap->mesh, NULL, &points, NULL, NULL, &carried, &error));
    fairmesh_info info = info_of(carried);
    CHECK(info.kind == FAIRMESH_RESULT_KIND_CARRIED && info.new_vertex_count == count);
    triangles = list_of(carried, FAIRMESH_LIST_CARRIED_TRIANGLES, 0, &k);
    CHECK(k == count);
    corners = list_of(carried, FAIRMESH_LIST_PARENTS, 0, &k);
    CHECK(k == 3 * count);
    weights = vectors_of(carried, FAIRMESH_VECTORS_PARENT_WEIGHTS, count);
    OK(fairmesh_result_free(carried));
    CHECK(triangles[0] == UINT32_MAX && corners[2] == UINT32_MAX && weights[0] == 0.0);
    for (k = 1; k < count; k++) {
        double at[3] = {0.0, 0.0, 0.0}, sum = 0.0, far = 0.0;
        for (i = 0; i < 9; i++) at[i % 3] += weights[3 * k + i / 3] * cap->positions[3 * corners[3 * k + i / 3] + i % 3];
        for (i = 0; i < 3; i++) sum += weights[3 * k + i], far += pow(at[i] - positions[3 * k + i], 2);
        CHECK(fabs(sum - 1.0) < 1e-12 && far < 0.15 * 0.15);
        CHECK(memcmp(corners + 3 * k, cap->corners + 3 * triangles[k], 12) == 0);
    }
    free(weights);
    free(triangles);
    free(corners);
}

/* A dent deleted and filled; colours carried over from what was there. */
static void refilling(void) {
    Cap cap = cap_new(15);
    fairmesh_options options = quick();
    fairmesh_result *refilled = NULL;
    double *positions;
    uint32_t *kept;
    size_t size, k;
    OK(fairmesh_refill(&cap.mesh, &cap.selection, NULL, &options, &refilled, &error));
    fairmesh_info info = info_of(refilled);
    CHECK(info.kind == FAIRMESH_RESULT_KIND_REMESHED && info.new_vertex_count > 10 && info.new_triangle_count > 20);
    kept = list_of(refilled, FAIRMESH_LIST_KEPT_VERTICES, 0, &size);
    CHECK(size == info.vertex_count - info.new_vertex_count);
    for (k = 0; k < size; k++) CHECK(!cap.free_mask[kept[k]]);
    positions = positions_of(refilled);
    CHECK(off_sphere(positions, (size_t)info.vertex_count) < 5e-3);
    OK(fairmesh_result_free(refilled));
    positions[3 * size] = NAN;
    carried_to(&cap, positions + 3 * size, (size_t)info.new_vertex_count);

    /* Stopped; and a region at the boundary of the mesh. */
    options.progress = stop_at_once;
    refilled = NULL;
    CHECK(fairmesh_refill(&cap.mesh, &cap.selection, NULL, &options, &refilled, &error) == FAIRMESH_STATUS_NO_FAIR_PATCH);
    CHECK(refilled == NULL && strstr(error.message, "no fair patch") != NULL);
    options.progress = NULL;
    CHECK(fairmesh_refill(&cap.mesh, NULL, NULL, &options, &refilled, NULL) == FAIRMESH_STATUS_NO_FAIR_PATCH);
    free(positions);
    free(kept);
    cap_free(&cap);
}

/* The triangles that steps choose. */
static size_t select_of(const fairmesh_mesh *mesh, const fairmesh_region_step *asked, size_t count, uint32_t *list, size_t room) {
    fairmesh_result *chosen = NULL;
    size_t size = 0;
    OK(fairmesh_select_region(mesh, asked, count, NULL, NULL, &chosen, &error));
    fairmesh_info info = info_of(chosen);
    CHECK(info.kind == FAIRMESH_RESULT_KIND_REGION && info.vertex_count == mesh->positions.count);
    OK(fairmesh_result_list(chosen, FAIRMESH_LIST_REGION_TRIANGLES, 0, list, room, &size, &error));
    CHECK(size == info.triangle_count);
    OK(fairmesh_result_free(chosen));
    return size;
}

/* A wide sheet with a bump in the middle. */
enum { WIDE = 81 };

static Cap wide_sheet(void) {
    Cap cap = cap_new(WIDE);
    size_t v;
    for (v = 0; v < cap.vertices; v++) {
        double x = (double)(v % WIDE) - WIDE / 2, y = (double)(v / WIDE) - WIDE / 2, r = (x * x + y * y) / 64.0;
        cap.positions[3 * v] = x;
        cap.positions[3 * v + 1] = y;
        cap.positions[3 * v + 2] = r < 1.0 ? 3.0 * (1.0 - r) * (1.0 - r) * (1.0 - r) : 0.0;
    }
    return cap;
}

/* A box, half of it, without one triangle, and all others. */
static void combined_regions(const Cap *cap, uint32_t *list) {
    fairmesh_result *chosen = NULL;
    fairmesh_region_step asked[4];
    SIZED(fairmesh_bump, bump);
    uint32_t counts[4], one;
    size_t size;
    memset(asked, 0, sizeof asked);
    CHECK(select_of(&cap->mesh, NULL, 0, list, cap->triangles) == 0);
    CHECK(select_of(&cap->mesh, asked, 1, list, cap->triangles) == cap->triangles);
    asked[0].kind = FAIRMESH_REGION_KIND_BOX;
    asked[0].point[0] = asked[0].point[1] = -2.0;
    asked[0].vector[0] = asked[0].vector[1] = 2.0;
    asked[0].vector[2] = 9.0;
    asked[1].kind = FAIRMESH_REGION_KIND_HALF_SPACE;
    asked[1].combine = FAIRMESH_COMBINE_INTERSECT;
    asked[1].vector[0] = 1.0;
    asked[2].kind = FAIRMESH_REGION_KIND_TRIANGLES;
    asked[2].combine = FAIRMESH_COMBINE_REMOVE;
    OK(fairmesh_select_region(&cap->mesh, asked, 2, NULL, NULL, &chosen, &error));
    OK(fairmesh_result_list(chosen, FAIRMESH_LIST_REGION_COUNTS, 0, counts, 4, &size, &error));
    CHECK(size == 2 && counts[0] == 32 && counts[1] == cap->triangles / 2);
    CHECK(fairmesh_result_list(chosen, FAIRMESH_LIST_KEPT_TRIANGLES, 0, NULL, 0, &size, &error) == FAIRMESH_STATUS_NOT_AVAILABLE);
    CHECK(fairmesh_result_bump(chosen, 0, &bump, &error) == FAIRMESH_STATUS_NOT_AVAILABLE);
    OK(fairmesh_result_free(chosen));
    CHECK(select_of(&cap->mesh, asked, 2, list, cap->triangles) == 16);
    one = list[0];
    asked[2].list = indices_of(&one, 1);
    CHECK(select_of(&cap->mesh, asked, 3, list, cap->triangles) == 15);
    asked[3].kind = FAIRMESH_REGION_KIND_INVERT;
    CHECK(select_of(&cap->mesh, asked, 4, list, cap->triangles) == cap->triangles - 15);
}

/* The bump, from the vertex at its top. */
static void bump_from_its_top(const Cap *cap, uint32_t *list) {
    fairmesh_result *chosen = NULL;
    ZERO(fairmesh_region_step, asked);
    SIZED(fairmesh_bump, bump);
    size_t size;
    asked.kind = FAIRMESH_REGION_KIND_BUMP;
    asked.seed_kind = FAIRMESH_SEED_KIND_VERTEX;
    asked.seed_vertex = WIDE * (WIDE / 2) + WIDE / 2;
    OK(fairmesh_select_region(&cap->mesh, &asked, 1, NULL, NULL, &chosen, &error));
    OK(fairmesh_result_bump(chosen, 0, &bump, &error));
    OK(fairmesh_result_list(chosen, FAIRMESH_LIST_REGION_TRIANGLES, 0, list, cap->triangles, &size, &error));
    CHECK(bump.triangle_count == size && bump.radius > 6.0 && bump.radius < 16.0);
    CHECK(bump.height > 0.1 && bump.uncertainty < 0.3);
    OK(fairmesh_result_free(chosen));
}

/* Around a corner of the sheet, where it is flat: grown and shrunk again. */
static void grown_and_shrunk(const Cap *cap, uint32_t *list) {
    const uint32_t corner[3] = {0, 1, WIDE + 1};
    fairmesh_region_step asked[2];
    memset(asked, 0, sizeof asked);
    asked[0].kind = FAIRMESH_REGION_KIND_VERTICES;
    asked[0].list = indices_of(corner, 3);
    CHECK(select_of(&cap->mesh, asked, 1, list, cap->triangles) == 1 && list[0] == 0);
    asked[1].kind = FAIRMESH_REGION_KIND_GROW;
    asked[1].rings = 1;
    CHECK(select_of(&cap->mesh, asked, 2, list, cap->triangles) > 5);
    asked[1].rings = UINT64_MAX;
    CHECK(select_of(&cap->mesh, asked, 2, list, cap->triangles) == cap->triangles);
    asked[1].kind = FAIRMESH_REGION_KIND_SHRINK;
    CHECK(select_of(&cap->mesh, asked, 2, list, cap->triangles) == 0);
}

static void no_bump_far_away(const Cap *cap) {
    fairmesh_result *chosen = NULL;
    ZERO(fairmesh_region_step, asked);
    asked.kind = FAIRMESH_REGION_KIND_BUMP;
    asked.seed_kind = FAIRMESH_SEED_KIND_VERTEX;
    asked.seed_vertex = 12 * WIDE + 12;
    CHECK(fairmesh_select_region(&cap->mesh, &asked, 1, NULL, NULL, &chosen, &error) == FAIRMESH_STATUS_NO_BUMP);
}

static void regions(void) {
    static uint32_t list[2 * WIDE * WIDE];
    Cap cap = wide_sheet();
    combined_regions(&cap, list);
    bump_from_its_top(&cap, list);
    grown_and_shrunk(&cap, list);
    no_bump_far_away(&cap);
    cap_free(&cap);
}

/* A fixed vertex with a free one next to it. */
static uint32_t on_boundary(const Cap *cap) {
    size_t t;
    for (t = 0; t < cap->triangles; t++) {
        const uint32_t *corner = cap->corners + 3 * t;
        int k;
        for (k = 0; k < 3; k++) {
            if (!cap->free_mask[corner[k]] && cap->free_mask[corner[(k + 1) % 3]]) return corner[k];
        }
    }
    CHECK(0);
    return 0;
}

static double farthest(const double *a, const double *b, size_t numbers) {
    double most = 0.0;
    size_t k;
    for (k = 0; k < numbers; k++) most = fmax(most, fabs(a[k] - b[k]));
    return most;
}

/* A solver that is edited: its first surface, the one it has now, and the edits in force. */
typedef struct {
    Cap cap;
    fairmesh_solver *solver;
    fairmesh_edit edits[2];
    size_t numbers;
    double *first, *now;
    uint32_t *list;
    fairmesh_points_out to;
} Live;

/* Finds the surface of the edits that are set: how far its farthest coordinate is from the first one's. */
static double finished(Live *at) {
    OK(fairmesh_solver_finish(at->solver, NULL, &error));
    OK(fairmesh_solver_positions(at->solver, &at->to, &error));
    return farthest(at->first, at->now, at->numbers);
}

/* Frames of few evaluations until one says that the surface is found; then the edits in force are all that count. */
static void frames_of_a_tilt(Live *at) {
    SIZED(fairmesh_budget, limit);
    SIZED(fairmesh_frame, frame);
    size_t frames = 0;
    at->edits[0].kind = FAIRMESH_EDIT_KIND_TILT;
    at->edits[0].vertex = on_boundary(&at->cap);
    at->edits[0].amount = 0.1;
    OK(fairmesh_solver_edit(at->solver, at->edits, 1, &error));
    limit.evaluations = 2;
    do {
        OK(fairmesh_solver_update(at->solver, &limit, &frame, &error));
        CHECK(frame.evaluations >= 1 && frame.evaluations <= 2 && ++frames < 100);
    } while (!frame.is_settled);
    CHECK(frame.step <= 1e-6 && frames > 1);
    CHECK(finished(at) > 1e-3);
    OK(fairmesh_solver_edit(at->solver, NULL, 0, &error));
    CHECK(finished(at) < 1e-8);
}

/* With all that is fixed the surface moves as a whole. */
static void moved_as_a_whole(Live *at) {
    SIZED(fairmesh_frame, frame);
    size_t v, fixed = 0;
    for (v = 0; v < at->cap.vertices; v++) {
        if (!at->cap.free_mask[v]) at->list[fixed++] = (uint32_t)v;
    }
    at->edits[0].kind = FAIRMESH_EDIT_KIND_MOVE;
    at->edits[0].vertices = indices_of(at->list, fixed);
    at->edits[0].translation[1] = 0.5;
    OK(fairmesh_solver_edit(at->solver, at->edits, 1, &error));
    OK(fairmesh_solver_update(at->solver, NULL, &frame, &error));
    CHECK(frame.is_settled);
    (void)finished(at);
    for (v = 0; v < at->cap.vertices; v++) at->now[3 * v + 1] -= 0.5;
    CHECK(farthest(at->first, at->now, at->numbers) < 1e-8);
}

static void bulged(Live *at) {
    SIZED(fairmesh_bulge_range, range);
    SIZED(fairmesh_report, report);
    OK(fairmesh_solver_edit(at->solver, NULL, 0, &error));
    OK(fairmesh_solver_bulge_range(at->solver, &range, &error));
    CHECK(range.low < 0.0 && range.high > 0.0 && isfinite(range.low) && isfinite(range.high));
    at->edits[0].kind = FAIRMESH_EDIT_KIND_BULGE;
    at->edits[0].amount = 0.5 * range.high;
    OK(fairmesh_solver_edit(at->solver, at->edits, 1, &error));
    OK(fairmesh_solver_finish(at->solver, &report, &error));
    CHECK(report.outcome == FAIRMESH_OUTCOME_CONVERGED);
}

static void refused_edits(Live *at) {
    fairmesh_edit *edits = at->edits;
    uint32_t *list = at->list;
    edits[1].kind = 5;
    CHECK(fairmesh_solver_edit(at->solver, edits, 2, &error) == FAIRMESH_STATUS_BAD_ENUM);
    CHECK(error.element_kind == FAIRMESH_ELEMENT_ARGUMENT && error.element == 2);
    CHECK(error.other == sizeof *edits + offsetof(fairmesh_edit, kind));
    edits[1].kind = FAIRMESH_EDIT_KIND_TILT;
    edits[1].vertex = (uint32_t)at->cap.vertices;
    CHECK(fairmesh_solver_edit(at->solver, edits, 2, &error) == FAIRMESH_STATUS_SELECTION_OUT_OF_RANGE);
    CHECK(error.element_kind == FAIRMESH_ELEMENT_VERTEX && error.element == at->cap.vertices);
    edits[1].vertex = 0;
    CHECK(fairmesh_solver_edit(at->solver, edits, 2, &error) == FAIRMESH_STATUS_NOT_ON_LOOP && error.element == 0);
    edits[1].vertex = on_boundary(&at->cap);
    edits[1].amount = NAN;
    CHECK(fairmesh_solver_edit(at->solver, edits, 2, &error) == FAIRMESH_STATUS_BAD_EDIT);
    edits[1].kind = FAIRMESH_EDIT_KIND_MOVE;
    edits[1].vertices = indices_of(list, 1);
    for (list[0] = 0; !at->cap.free_mask[list[0]]; list[0]++) {}
    CHECK(fairmesh_solver_edit(at->solver, edits, 2, &error) == FAIRMESH_STATUS_BAD_EDIT);
    CHECK(error.element_kind == FAIRMESH_ELEMENT_VERTEX && error.element == list[0]);
    edits[1].vertices.data = (const uint32_t *)(const void *)&error;
    CHECK(fairmesh_solver_edit(at->solver, edits, 2, &error) == FAIRMESH_STATUS_ALIASING);
    CHECK(fairmesh_solver_edit(at->solver, NULL, 1, &error) == FAIRMESH_STATUS_NULL_POINTER);
    CHECK(fairmesh_solver_edit(at->solver, edits, SIZE_MAX / 2, &error) == FAIRMESH_STATUS_COUNT_OVERFLOW && error.element == 3);
}

/* After what is refused the surface is still found. */
static void refused_budgets(fairmesh_solver *solver) {
    SIZED(fairmesh_budget, limit);
    SIZED(fairmesh_frame, frame);
    limit.evaluations = 2;
    limit.reserved = 1;
    CHECK(fairmesh_solver_update(solver, &limit, &frame, &error) == FAIRMESH_STATUS_BAD_RESERVED);
    limit.reserved = 0;
    limit.seconds = -1.0;
    CHECK(fairmesh_solver_update(solver, &limit, &frame, &error) == FAIRMESH_STATUS_BAD_OPTION);
    CHECK(fairmesh_solver_update(solver, NULL, NULL, &error) == FAIRMESH_STATUS_NULL_POINTER);
    limit.seconds = 10.0;
    OK(fairmesh_solver_update(solver, &limit, &frame, &error));
    CHECK(frame.is_settled);
}

static void live(void) {
    Live at;
    fairmesh_options options = quick();
    SIZED(fairmesh_report, report);
    memset(&at, 0, sizeof at);
    at.cap = cap_new(21);
    at.numbers = 3 * at.cap.vertices;
    at.first = (double *)must(malloc(at.numbers * sizeof(double)));
    at.now = (double *)must(malloc(at.numbers * sizeof(double)));
    at.list = (uint32_t *)must(malloc(at.cap.vertices * sizeof(uint32_t)));
    at.to = points_out_of(at.first, at.cap.vertices);
    options.tolerance = 1e-10;
    OK(fairmesh_solver_new(&at.cap.mesh, &at.cap.selection, &options, &at.solver, &error));
    OK(fairmesh_solver_finish(at.solver, &report, &error));
    CHECK(report.outcome == FAIRMESH_OUTCOME_CONVERGED);
    OK(fairmesh_solver_positions(at.solver, &at.to, &error));
    at.to.data = at.now;
    frames_of_a_tilt(&at);
    moved_as_a_whole(&at);
    bulged(&at);
    refused_edits(&at);
    refused_budgets(at.solver);
    OK(fairmesh_solver_free(at.solver));
    free(at.first);
    free(at.now);
    free(at.list);
    cap_free(&at.cap);
}

/* A cap, what is asked at its boundary, and the surfaces that this gives. */
typedef struct {
    Cap cap;
    fairmesh_options options;
    size_t size, bytes;
    uint32_t *boundary;
    double *by_list, *by_vertex;
    float *all;
    fairmesh_continuity loop;
} Continued;

/* Half of the way to a given mean curvature by a list: another surface than by the fitted one. */
static void curvature_by_list(Continued *at) {
    const Cap *cap = &at->cap;
    SIZED(fairmesh_component, whole);
    SIZED(fairmesh_continuity, again);
    fairmesh_result *result;
    double *fitted = (double *)must(malloc(at->bytes)), *given = (double *)must(malloc(cap->vertices * sizeof(double)));
    fairmesh_points_out into = points_out_of(fitted, cap->vertices);
    size_t v;
    OK(fairmesh_fair(&cap->mesh, &cap->selection, &at->options, &into, NULL, &result, &error));
    OK(fairmesh_result_list(result, FAIRMESH_LIST_BOUNDARY_VERTICES, 0, at->boundary, cap->vertices, &at->size, &error));
    OK(fairmesh_result_component(result, 0, 0, &whole, &error));
    CHECK(whole.continuity_count == 1);
    OK(fairmesh_result_free(result));

    for (v = 0; v < at->size; v++) given[v] = -1.25;
    at->options.boundary_curvature.kind = FAIRMESH_BOUNDARY_CURVATURE_KIND_GIVEN;
    at->options.boundary_curvature.values = numbers_of(given, at->size);
    at->options.boundary_curvature.vertices = indices_of(at->boundary, at->size);
    into.data = at->by_list;
    OK(fairmesh_fair(&cap->mesh, &cap->selection, &at->options, &into, NULL, &result, &error));
    CHECK(memcmp(at->by_list, fitted, at->bytes) != 0);
    OK(fairmesh_result_continuity(result, 0, 0, 0, &at->loop, &error));
    CHECK(at->loop.struct_size == sizeof at->loop && at->loop.reserved == 0);
    CHECK(at->loop.vertex == at->boundary[0] && at->loop.vertex_count == at->size);
    CHECK(fabs(at->loop.curvature - 1.25) < 1e-9 && at->loop.uncertainty >= 0.0);
    CHECK(at->loop.reached > 0.0 && at->loop.reached <= 0.5 && at->loop.jump < at->loop.jump_before);
    CHECK(at->loop.largest_jump_before >= at->loop.jump_before && at->loop.largest_jump >= at->loop.jump);
    CHECK(fairmesh_result_continuity(result, 0, 0, 1, &again, &error) == FAIRMESH_STATUS_NOT_AVAILABLE);
    CHECK(fairmesh_result_continuity(result, 0, 1, 0, &again, &error) == FAIRMESH_STATUS_NOT_AVAILABLE);
    CHECK(fairmesh_result_continuity(result, 1, 0, 0, &again, &error) == FAIRMESH_STATUS_NOT_AVAILABLE);
    OK(fairmesh_result_free(result));
    free(fitted);
    free(given);
}

/* How many loops of the first component have their curvature continued, and what came of the first of them. */
static uint64_t loops_of(fairmesh_solver *solver, fairmesh_continuity *first) {
    SIZED(fairmesh_component, whole);
    fairmesh_result *result = NULL;
    int32_t status;
    OK(fairmesh_solver_result(solver, &result, &error));
    OK(fairmesh_result_component(result, 0, 0, &whole, &error));
    status = fairmesh_result_continuity(result, 0, 0, 0, first, &error);
    CHECK(status == (whole.continuity_count == 0 ? FAIRMESH_STATUS_NOT_AVAILABLE : FAIRMESH_STATUS_OK));
    OK(fairmesh_result_free(result));
    return whole.continuity_count;
}

/* One number per vertex, as a float, with NaN where none is given; the solver that is returned finds the same. */
static fairmesh_solver *curvature_by_vertex(Continued *at) {
    const Cap *cap = &at->cap;
    fairmesh_boundary_curvature *curvature = &at->options.boundary_curvature;
    SIZED(fairmesh_continuity, again);
    fairmesh_solver *solver;
    fairmesh_points_out into = points_out_of(at->by_vertex, cap->vertices);
    size_t v;
    for (v = 0; v < cap->vertices; v++) at->all[v] = NAN;
    for (v = 0; v < at->size; v++) at->all[at->boundary[v]] = -1.25f;
    memset(curvature, 0, sizeof *curvature);
    curvature->kind = FAIRMESH_BOUNDARY_CURVATURE_KIND_GIVEN;
    curvature->values.data = at->all;
    curvature->values.count = cap->vertices;
    curvature->values.scalar = FAIRMESH_SCALAR_FLOAT32;
    OK(fairmesh_fair(&cap->mesh, &cap->selection, &at->options, &into, NULL, NULL, &error));
    CHECK(memcmp(at->by_list, at->by_vertex, at->bytes) == 0);

    OK(fairmesh_solver_new(&cap->mesh, &cap->selection, &at->options, &solver, &error));
    CHECK(loops_of(solver, &again) == 0);
    OK(fairmesh_solver_run(solver, UINT64_MAX, NULL, &error));
    CHECK(loops_of(solver, &again) == 1);
    CHECK(memcmp(&again, &at->loop, sizeof again) == 0);
    return solver;
}

/* Tangent planes alone, then half of the way for the loop alone, by one of its vertices, then to the fitted curvature. */
static void continuity_of_solver(const Continued *at, fairmesh_solver *solver) {
    SIZED(fairmesh_continuity, again);
    fairmesh_options asked = at->options;
    double half = 0.5;
    asked.continuity = 0;
    asked.loop_continuity.values.count = asked.loop_continuity.vertices.count = 0;
    OK(fairmesh_solver_set(solver, FAIRMESH_SETTING_CONTINUITY, &asked, &error));
    OK(fairmesh_solver_run(solver, UINT64_MAX, NULL, &error));
    CHECK(loops_of(solver, &again) == 0);
    asked.loop_continuity = at->options.loop_continuity;
    asked.loop_continuity.values = numbers_of(&half, 1);
    OK(fairmesh_solver_set(solver, FAIRMESH_SETTING_CONTINUITY, &asked, &error));
    OK(fairmesh_solver_run(solver, UINT64_MAX, NULL, &error));
    CHECK(loops_of(solver, &again) == 1);
    CHECK(fabs(again.reached - at->loop.reached) < 1e-4 && fabs(again.jump - at->loop.jump) < 1e-4);
    asked.continuity = 1.5;
    CHECK(fairmesh_solver_set(solver, FAIRMESH_SETTING_CONTINUITY, &asked, &error) == FAIRMESH_STATUS_BAD_OPTION);
    CHECK(error.element_kind == FAIRMESH_ELEMENT_ARGUMENT && error.element == 3);
    CHECK(error.other == offsetof(fairmesh_options, continuity));
    asked.continuity = 0;
    half = 1.5;
    CHECK(fairmesh_solver_set(solver, FAIRMESH_SETTING_CONTINUITY, &asked, &error) == FAIRMESH_STATUS_BAD_OPTION);
    CHECK(error.element_kind == FAIRMESH_ELEMENT_VERTEX && error.element == at->boundary[3]);
    CHECK(fairmesh_solver_set(solver, 99, &asked, &error) == FAIRMESH_STATUS_BAD_ENUM && error.element == 2);
    OK(fairmesh_solver_set(solver, FAIRMESH_SETTING_BOUNDARY_CURVATURE, NULL, &error));
    OK(fairmesh_solver_run(solver, UINT64_MAX, NULL, &error));
    CHECK(loops_of(solver, &again) == 1);
    CHECK(fabs(again.curvature - 1.25) > 1e-3);
}

/* The same in one call, and vertices that name no loop. */
static void continuity_of_loop(Continued *at) {
    const Cap *cap = &at->cap;
    fairmesh_options *options = &at->options;
    fairmesh_points_out into = points_out_of(at->by_list, cap->vertices);
    uint32_t astray = (uint32_t)cap->vertices;
    options->continuity = 0.0;
    OK(fairmesh_fair(&cap->mesh, &cap->selection, options, &into, NULL, NULL, &error));
    CHECK(memcmp(at->by_list, at->by_vertex, at->bytes) == 0);
    options->loop_continuity.vertices.data = &astray;
    CHECK(fairmesh_fair(&cap->mesh, &cap->selection, options, &into, NULL, NULL, &error) ==
          FAIRMESH_STATUS_SELECTION_OUT_OF_RANGE);
    astray = 0;
    CHECK(fairmesh_fair(&cap->mesh, &cap->selection, options, &into, NULL, NULL, &error) == FAIRMESH_STATUS_NOT_ON_LOOP);
    CHECK(error.element_kind == FAIRMESH_ELEMENT_VERTEX && error.element == 0);
    options->loop_continuity.values.count = 2;
    CHECK(fairmesh_fair(&cap->mesh, &cap->selection, options, &into, NULL, NULL, &error) == FAIRMESH_STATUS_COUNT_MISMATCH);
}

static void continuity(void) {
    Continued at;
    fairmesh_solver *solver;
    const double half = 0.5;
    memset(&at, 0, sizeof at);
    at.cap = cap_new(31);
    at.options = quick();
    at.bytes = 24 * at.cap.vertices;
    at.boundary = (uint32_t *)must(malloc(at.cap.vertices * sizeof(uint32_t)));
    at.all = (float *)must(malloc(at.cap.vertices * sizeof(float)));
    at.by_list = (double *)must(malloc(at.bytes));
    at.by_vertex = (double *)must(malloc(at.bytes));
    at.loop.struct_size = sizeof at.loop;
    CHECK(at.options.continuity == FAIRMESH_CONTINUITY_AUTO);
    CHECK(at.options.boundary_curvature.kind == FAIRMESH_BOUNDARY_CURVATURE_KIND_ESTIMATED);
    at.options.continuity = 0.5;
    curvature_by_list(&at);
    solver = curvature_by_vertex(&at);
    at.options.loop_continuity.values = numbers_of(&half, 1);
    at.options.loop_continuity.vertices = indices_of(at.boundary + 3, 1);
    continuity_of_solver(&at, solver);
    OK(fairmesh_solver_free(solver));
    continuity_of_loop(&at);
    free(at.boundary);
    free(at.all);
    free(at.by_list);
    free(at.by_vertex);
    cap_free(&at.cap);
}

/* Where the ridge of the roof arrives at the flattened part. */
static void ends_of_the_ridge(const fairmesh_result *result, size_t side) {
    uint64_t k;
    SIZED(fairmesh_crease_end, end);
    for (k = 0; k < 2; k++) {
        double dot;
        OK(fairmesh_result_crease_end(result, 0, 0, k, &end, &error));
        dot = end.normal_left[0] * end.normal_right[0] + end.normal_left[1] * end.normal_right[1] + end.normal_left[2] * end.normal_right[2];
        CHECK(end.vertex / side == side / 2 && end.reserved == 0);
        CHECK(fabs(end.angle - 90) < 1e-6 && end.error < 1 && fabs(dot) < 1e-6);
        CHECK(fabs(fabs(end.direction[0]) - 1) < 1e-6);
    }
    CHECK(fairmesh_result_crease_end(result, 0, 0, 2, &end, &error) == FAIRMESH_STATUS_NOT_AVAILABLE);
    CHECK(fairmesh_result_crease_end(result, 0, 1, 0, &end, &error) == FAIRMESH_STATUS_NOT_AVAILABLE);
}

/* The ridge of a roof goes on through the flattened part, if that is asked for. */
static void sharp_edges(void) {
    Cap roof = cap_new(15);
    uint32_t along[15];
    size_t size, k;
    fairmesh_result *result;
    fairmesh_options options = quick();
    double *fair = (double *)must(malloc(24 * roof.vertices));
    fairmesh_points_out into = points_out_of(fair, roof.vertices);
    SIZED(fairmesh_report, report);
    SIZED(fairmesh_sharp_edge, edge);
    cap_as_roof(&roof);
    options.sharp = 120;
    OK(fairmesh_fair(&roof.mesh, &roof.selection, &options, &into, &report, NULL, &error));
    CHECK(report.sharp_edge_count == 0);
    options.sharp = FAIRMESH_SHARP_AUTO;
    OK(fairmesh_fair(&roof.mesh, &roof.selection, &options, &into, &report, &result, &error));
    CHECK(report.sharp_edge_count == 1);
    OK(fairmesh_result_sharp_edge(result, 0, 0, &edge, &error));
    CHECK(edge.fate == FAIRMESH_SHARP_FATE_GOES_ON && edge.end_count == 2 && edge.first_vertex == 0);
    CHECK(strcmp(fairmesh_describe(FAIRMESH_ANSWER_SHARP_FATE, (int32_t)edge.fate, FAIRMESH_TEXT_NAME), "goes_on") == 0);
    ends_of_the_ridge(result, roof.side);
    OK(fairmesh_result_list(result, FAIRMESH_LIST_SHARP_VERTICES, 0, along, 15, &size, &error));
    CHECK(size == edge.vertex_count && size > 2);
    for (k = 0; k < size; k++) CHECK(fabs(fair[3 * along[k] + 1]) < 1e-9 && fabs(fair[3 * along[k] + 2]) < 1e-9);
    CHECK(fairmesh_result_sharp_edge(result, 0, 1, &edge, &error) == FAIRMESH_STATUS_NOT_AVAILABLE);
    CHECK(fairmesh_result_sharp_edge(result, 1, 0, &edge, &error) == FAIRMESH_STATUS_NOT_AVAILABLE);
    OK(fairmesh_result_free(result));
    free(fair);
    cap_free(&roof);
}

static void count_lines(const char *message, void *lines) {
    CHECK(message[0] != 0);
    ++*(int *)lines;
}

/* Stops at the third call. */
typedef struct {
    int calls;
    double last;
} Few;

static int32_t few(const fairmesh_progress *progress, void *few_) {
    Few *so_far = (Few *)few_;
    CHECK(progress->fraction >= so_far->last && progress->fraction <= 1);
    so_far->last = progress->fraction;
    return ++so_far->calls >= 3;
}

static int32_t to_the_end(const fairmesh_progress *progress, void *last) {
    *(double *)last = progress->fraction;
    return 0;
}

/* What is neither faired nor filled can be stopped, too, and has no result then. */
static void stopped(void) {
    Cap cap = cap_new(151);
    fairmesh_points points = points_of(cap.positions, cap.vertices);
    ZERO(fairmesh_region_step, step);
    fairmesh_remesh_options remesh;
    int which, ends;
    OK(fairmesh_remesh_options_init(&remesh, sizeof remesh));
    /* A small one, as all around it is dents. */
    step.kind = FAIRMESH_REGION_KIND_BUMP;
    step.point[2] = 1.0;
    step.value = 0.03;
    for (which = 0; which < 4; which++) {
        for (ends = 0; ends < 2; ends++) {
            Few so_far = {0, 0};
            double last = 0;
            fairmesh_progress_fn tell = ends ? to_the_end : few;
            void *with = ends ? (void *)&last : (void *)&so_far;
            fairmesh_result *result = NULL;
            int32_t status;
            remesh.progress = tell;
            remesh.user_data = with;
            switch (which) {
            case 0: status = fairmesh_remesh(&cap.mesh, &cap.selection, &remesh, &result, &error); break;
            case 1: status = fairmesh_carry_over(&cap.mesh, NULL, &points, tell, with, &result, &error); break;
            case 2: status = fairmesh_self_intersections(&cap.mesh, NULL, tell, with, &result, &error); break;
            default: status = fairmesh_select_region(&cap.mesh, &step, 1, tell, with, &result, &error);
            }
            if (ends) {
                CHECK(status == FAIRMESH_STATUS_OK ? last == 1 : status == FAIRMESH_STATUS_NO_BUMP);
            } else {
                CHECK(status == FAIRMESH_STATUS_CANCELLED && result == NULL && so_far.calls == 3);
            }
            OK(fairmesh_result_free(result));
        }
    }
    cap_free(&cap);
}

/* What is set aside grows with the region and with the holes; a log that nothing is written to. */
static void hosts(void) {
    Cap cap = cap_new(31);
    fairmesh_fill_options fill = filling();
    uint64_t small = 0, large = 0;
    int lines = 0;
    OK(fairmesh_set_log(count_lines, &lines));
    OK(fairmesh_memory_needed(&cap.mesh, NULL, NULL, NULL, &large, &error));
    OK(fairmesh_memory_needed(&cap.mesh, &cap.selection, NULL, NULL, &small, &error));
    CHECK(small > 24 * cap.vertices && small < large);
    OK(fairmesh_memory_needed(&cap.mesh, NULL, &fill, NULL, &small, &error));
    fill.density *= 2;
    OK(fairmesh_memory_needed(&cap.mesh, NULL, &fill, NULL, &large, &error));
    CHECK(small <= large);
    CHECK(fairmesh_memory_needed(&cap.mesh, NULL, &fill, NULL, NULL, &error) == FAIRMESH_STATUS_NULL_POINTER && error.element == 5);
    OK(fairmesh_set_log(NULL, NULL));
    CHECK(lines == 0);
    cap_free(&cap);
}

/* A vertex of a host: what the library reads and writes stands side by side. */
typedef struct {
    float position[3];
    float normal[3];
    uint8_t is_free, unused[3];
    float curvature;
} HostVertex;

/* Positions are faired in place, with normals and a mask of the same structs, and the curvature goes there, too. */
static void fields_of_a_host(void) {
    Cap cap = cap_new(15);
    HostVertex *host = (HostVertex *)must(calloc(cap.vertices, sizeof *host));
    float *apart = (float *)must(malloc(12 * cap.vertices)), *normals = (float *)must(malloc(12 * cap.vertices));
    fairmesh_options options = quick();
    fairmesh_mesh mesh = cap.mesh;
    fairmesh_selection selection = cap.selection;
    fairmesh_points_out out = points_out_of(NULL, 0);
    fairmesh_scalars_out curvature = scalars_out_of(NULL, 0);
    SIZED(fairmesh_report, report);
    size_t v, k;
    for (v = 0; v < cap.vertices; v++) {
        host[v].is_free = cap.free_mask[v];
        for (k = 0; k < 3; k++) {
            host[v].position[k] = apart[3 * v + k] = (float)cap.positions[3 * v + k];
            host[v].normal[k] = normals[3 * v + k] = cap.free_mask[v] ? 0.0f : (float)cap.positions[3 * v + k];
        }
    }
    options.boundary_normals.kind = FAIRMESH_BOUNDARY_NORMALS_KIND_GIVEN;
    mesh.positions.scalar = options.boundary_normals.vectors.scalar = out.scalar = curvature.scalar = FAIRMESH_SCALAR_FLOAT32;
    mesh.positions.stride = 0;
    out.count = options.boundary_normals.vectors.count = curvature.count = cap.vertices;
    mesh.positions.data = out.data = apart;
    options.boundary_normals.vectors.data = normals;
    OK(fairmesh_fair(&mesh, &selection, &options, &out, &report, NULL, &error));

    mesh.positions.stride = out.stride = curvature.stride = selection.stride = sizeof *host;
    options.boundary_normals.vectors.stride = sizeof *host;
    mesh.positions.data = out.data = host[0].position;
    options.boundary_normals.vectors.data = host[0].normal;
    selection.data = &host[0].is_free;
    OK(fairmesh_fair(&mesh, &selection, &options, &out, &report, NULL, &error));
    CHECK(report.outcome == FAIRMESH_OUTCOME_CONVERGED);
    for (v = 0; v < cap.vertices; v++) CHECK(memcmp(host[v].position, apart + 3 * v, 12) == 0);
    curvature.data = &host[0].curvature;
    OK(fairmesh_mean_curvature(&mesh, &curvature, &error));
    CHECK(fabs((double)host[cap.vertices / 2].curvature + 1.0) < 0.1);
    curvature.data = &host[0].position[2];
    CHECK(fairmesh_mean_curvature(&mesh, &curvature, &error) == FAIRMESH_STATUS_ALIASING && error.element == 2);
    free(host);
    free(apart);
    free(normals);
    cap_free(&cap);
}

int main(void) {
    versions();
    one_shot();
    hosts();
    stopped();
    fields_of_a_host();
    intersections();
    in_steps();
    live();
    continuity();
    sharp_edges();
    holes();
    remeshing();
    joins();
    bridges();
    rounding();
    erasing();
    erasing_and_cleaning();
    trimming();
    roughness();
    refilling();
    regions();
    puts("calls: passed");
    return 0;
}
