/* One task for each thing that the library does, in a table: both targets choose one of them and what it is given. */
#ifndef TASKS_H
#define TASKS_H

#include "answers.h"
#include "given.h"

/* What a callback and a task know of the run. */
typedef struct {
    const Given *given;
    Handed handed;
    Bytes script;
    fairmesh_result *result;
    fairmesh_error error;
    /* Of the callback, which may be NULL. */
    fairmesh_progress_fn progress;
    fairmesh_solver *solver;
    unsigned calls;
    double fraction;
} Run;

/* Its own solver is busy; other calls work. */
static inline void call_from_callback(const Run *run) {
    const fairmesh_mesh *mesh = run->handed.mesh;
    fairmesh_result *loops = NULL;
    fairmesh_scalars_out out;
    fairmesh_error error;
    if (run->solver) MUST(fairmesh_solver_free(run->solver) == FAIRMESH_STATUS_BUSY);
    if (run->calls == 1) {
        checked(fairmesh_boundary_loops(mesh, &loops, &error), &error);
        MUST(fairmesh_result_free(loops) == FAIRMESH_STATUS_OK);
    }
    if (run->calls == 2) {
        memset(&out, 0, sizeof out);
        out.count = run->given->mesh.positions.count;
        out.scalar = FAIRMESH_SCALAR_FLOAT64;
        out.data = malloc(8 * out.count + 1);
        MUST(out.data != NULL);
        checked(fairmesh_mean_curvature(mesh, &out, &error), &error);
        free(out.data);
    }
}

static inline int32_t watch(const fairmesh_progress *progress, void *user_data) {
    Run *run = user_data;
    MUST(progress->struct_size >= sizeof *progress && progress->phase != NULL);
    MUST(progress->fraction >= run->fraction && progress->fraction <= 1.0);
    run->fraction = progress->fraction;
    run->calls++;
    call_from_callback(run);
    return run->calls >= run->given->patience;
}

/* Progress begins anew with each call. */
static inline fairmesh_error *anew(Run *run) {
    run->fraction = 0.0;
    run->calls = 0;
    return run->handed.error;
}

/* The bytes of positions that lie side by side, which a failed call does not write. Positions of a mesh may be fewer than are asked for in their place. */
static inline size_t size_of_out(const fairmesh_points_out *out, const fairmesh_points *given) {
    enum { MOST = 100000 };
    if (out->stride != 0 || !out->data || out->count > MOST) return 0;
    if (out->data == given->data && (out->count > given->count || out->scalar != given->scalar)) return 0;
    return out->count * 3 * (out->scalar == FAIRMESH_SCALAR_FLOAT32 ? 4 : 8);
}

/* A coordinate of points that were taken for right. */
static inline double coordinate(const fairmesh_points *points, size_t k, size_t i) {
    size_t size = points->scalar == FAIRMESH_SCALAR_FLOAT32 ? 4 : 8;
    const uint8_t *from = (const uint8_t *)points->data + k * (points->stride ? points->stride : 3 * size) + i * size;
    float single;
    double value;
    if (size == 8) return memcpy(&value, from, 8), value;
    return memcpy(&single, from, 4), single;
}

static inline int is_same(double a, double b) { return a == b || (a != a && b != b); }

/* What is not free stays, where the mask alone says what is free. */
static void check_fixed(const Run *run) {
    const fairmesh_mesh *mesh = run->handed.mesh;
    const fairmesh_selection *selection = run->handed.selection;
    const fairmesh_points_out *out = run->handed.out;
    fairmesh_points moved;
    size_t k, i;
    if (!selection || selection->kind != FAIRMESH_SELECTION_KIND_FREE_MASK || mesh->coincident != FAIRMESH_COINCIDENT_SEPARATE) return;
    if (!out || out->data == mesh->positions.data) return;
    memcpy(&moved, out, sizeof moved);
    for (k = 0; k < moved.count; k++) {
        if (((const uint8_t *)selection->data)[k * (selection->stride ? selection->stride : 1)]) continue;
        for (i = 0; i < 3; i++) {
            double was = coordinate(&mesh->positions, k, i);
            MUST(is_same(coordinate(&moved, k, i), out->scalar == FAIRMESH_SCALAR_FLOAT32 ? (double)(float)was : was));
        }
    }
}

static fairmesh_status fair(Run *run) {
    const Handed *to = &run->handed;
    size_t size = to->out ? size_of_out(to->out, &run->given->mesh.positions) : 0;
    void *before = block(size);
    fairmesh_status status;
    if (size) memcpy(before, to->out->data, size);
    status = fairmesh_fair(to->mesh, to->selection, to->options, to->out, to->report, to->result, anew(run));
    if (status == FAIRMESH_STATUS_OK) check_fixed(run);
    if (status != FAIRMESH_STATUS_OK && size) MUST(memcmp(before, to->out->data, size) == 0);
    return status;
}

/* A solver that runs to the end. */
static fairmesh_status fair_in_steps(const Run *run, const fairmesh_options *options) {
    const Handed *to = &run->handed;
    fairmesh_solver *made = NULL;
    fairmesh_status status = fairmesh_solver_new(to->mesh, to->selection, options, &made, to->error);
    if (status == FAIRMESH_STATUS_OK) status = fairmesh_solver_run(made, UINT64_MAX, NULL, to->error);
    if (status == FAIRMESH_STATUS_OK) status = fairmesh_solver_positions(made, to->out, to->error);
    MUST(fairmesh_solver_free(made) == FAIRMESH_STATUS_OK);
    return status;
}

/* Any number of threads gives the same bits, and so does a solver. */
static fairmesh_status fair_again(Run *run) {
    const Handed *to = &run->handed;
    size_t size = to->out ? size_of_out(to->out, &run->given->mesh.positions) : 0;
    void *one = block(size);
    fairmesh_options options = run->given->options;
    fairmesh_status status;
    options.struct_size = sizeof options;
    options.progress = NULL;
    options.threads = 1;
    if (to->out && to->out->scalar == FAIRMESH_SCALAR_FLOAT32) options.output_precision = FAIRMESH_OUTPUT_PRECISION_SINGLE;
    status = checked(fairmesh_fair(to->mesh, to->selection, &options, to->out, NULL, NULL, to->error), to->error);
    if (status != FAIRMESH_STATUS_OK || size == 0 || to->out->data == run->given->mesh.positions.data) return status;
    memcpy(one, to->out->data, size);
    options.threads = 2;
    status = checked(fairmesh_fair(to->mesh, to->selection, &options, to->out, NULL, NULL, to->error), to->error);
    MUST(status == FAIRMESH_STATUS_OK && memcmp(one, to->out->data, size) == 0);
    status = checked(fair_in_steps(run, &options), to->error);
    MUST(status == FAIRMESH_STATUS_OK && memcmp(one, to->out->data, size) == 0);
    return status;
}

static fairmesh_status mean_curvature(Run *run) {
    fairmesh_scalars_out out;
    memset(&out, 0, sizeof out);
    out.count = run->given->points.count % 4096;
    out.scalar = run->given->points.scalar;
    out.data = block(8 * out.count);
    return fairmesh_mean_curvature(run->handed.mesh, &out, run->handed.error);
}

static fairmesh_status self_intersections(Run *run) {
    const Handed *to = &run->handed;
    return fairmesh_self_intersections(to->mesh, to->first, run->progress, run, to->result, anew(run));
}

static fairmesh_status boundary_loops(Run *run) { return fairmesh_boundary_loops(run->handed.mesh, run->handed.result, run->handed.error); }

static fairmesh_status rim_roughness(Run *run) { return fairmesh_rim_roughness(run->handed.mesh, run->handed.result, run->handed.error); }

static fairmesh_status components(Run *run) { return fairmesh_components(run->handed.mesh, run->handed.result, run->handed.error); }

static inline fairmesh_info info_of(const fairmesh_result *result) {
    fairmesh_info info;
    info.struct_size = sizeof info;
    MUST(fairmesh_result_info(result, &info, NULL) == FAIRMESH_STATUS_OK);
    return info;
}

/* No more are made than may be. */
static fairmesh_status at_most(uint64_t most, fairmesh_status status, const Run *run) {
    if (status == FAIRMESH_STATUS_OK && run->result) MUST(info_of(run->result).new_vertex_count <= most);
    return status;
}

/* How many that are by the options of hole filling. */
static inline uint64_t most_of(const Run *run) { return run->handed.fill ? run->given->fill.max_new_vertices : UINT64_MAX; }

/* Vertices given come first, as they were. */
static void check_kept(const fairmesh_mesh *mesh, const fairmesh_result *result) {
    fairmesh_points_out out;
    fairmesh_points filled;
    size_t k, i;
    memset(&out, 0, sizeof out);
    out.count = (size_t)info_of(result).vertex_count;
    MUST(out.count >= mesh->positions.count);
    out.data = block(24 * out.count);
    out.scalar = FAIRMESH_SCALAR_FLOAT64;
    MUST(fairmesh_result_positions(result, &out, NULL) == FAIRMESH_STATUS_OK);
    memcpy(&filled, &out, sizeof filled);
    for (k = 0; k < mesh->positions.count; k++)
        for (i = 0; i < 3; i++) MUST(is_same(coordinate(&mesh->positions, k, i), coordinate(&filled, k, i)));
}

static fairmesh_status fill_holes(Run *run) {
    const Handed *to = &run->handed;
    fairmesh_status status = fairmesh_fill_holes(to->mesh, to->fill, to->options, to->result, anew(run));
    if (status == FAIRMESH_STATUS_OK && run->given->fill.relax_rim == 0) check_kept(to->mesh, run->result);
    return at_most(most_of(run), status, run);
}

static fairmesh_status suggest_joins(Run *run) {
    return fairmesh_suggest_joins(run->handed.mesh, run->handed.fill, run->handed.result, run->handed.error);
}

static fairmesh_status remesh(Run *run) {
    const Handed *to = &run->handed;
    fairmesh_status status = fairmesh_remesh(to->mesh, to->selection, to->remesh, to->result, anew(run));
    return at_most(to->remesh ? run->given->remesh.max_vertices : UINT64_MAX, status, run);
}

static fairmesh_status refill(Run *run) {
    const Handed *to = &run->handed;
    fairmesh_status status = fairmesh_refill(to->mesh, to->selection, to->fill, to->options, to->result, anew(run));
    return at_most(most_of(run), status, run);
}

static fairmesh_status erase(Run *run) {
    return fairmesh_erase(run->handed.mesh, run->handed.first, run->given->most, run->handed.result, run->handed.error);
}

static fairmesh_status trim_boundary(Run *run) {
    const Handed *to = &run->handed;
    return fairmesh_trim_boundary(to->mesh, to->first, run->given->most, run->given->number, to->result, to->error);
}

static fairmesh_status carry_over(Run *run) {
    const Handed *to = &run->handed;
    return fairmesh_carry_over(to->mesh, to->first, &run->given->points, run->progress, run, to->result, anew(run));
}

static fairmesh_status select_region(Run *run) {
    const Given *given = run->given;
    return fairmesh_select_region(run->handed.mesh, given->steps, given->step_count, run->progress, run, run->handed.result, anew(run));
}

static fairmesh_status bridge(Run *run) {
    const Handed *to = &run->handed;
    const fairmesh_indices *second = &run->given->second;
    fairmesh_status status = fairmesh_bridge(to->mesh, to->first, second, to->bridge, to->fill, to->options, to->result, anew(run));
    return at_most(most_of(run), status, run);
}

static fairmesh_status round_creases(Run *run) {
    const Handed *to = &run->handed;
    return fairmesh_round(to->mesh, to->round, to->options, to->result, anew(run));
}

static fairmesh_status memory_needed(Run *run) {
    const Handed *to = &run->handed;
    uint64_t bytes = 0;
    fairmesh_status status = fairmesh_memory_needed(to->mesh, to->selection, to->fill, to->options, &bytes, to->error);
    MUST((status == FAIRMESH_STATUS_OK) == (bytes > 0));
    return status;
}

/* One call to a solver. */
static fairmesh_status solver_step(Run *run, uint8_t what) {
    const Given *given = run->given;
    const Handed *to = &run->handed;
    fairmesh_result *result = NULL;
    fairmesh_status status;
    fairmesh_error *error = anew(run);
    switch (what % 9u) {
    case 0: return fairmesh_solver_run(run->solver, 1u + what / 9u, to->report, error);
    case 1: return fairmesh_solver_edit(run->solver, given->edits, given->edit_count, error);
    case 2: return fairmesh_solver_update(run->solver, to->limit, room_of(sizeof(fairmesh_frame), given->growth), error);
    case 3: return fairmesh_solver_set(run->solver, what / 9u % 5u, to->options, error);
    case 4: return fairmesh_solver_positions(run->solver, to->out, error);
    case 5:
        status = fairmesh_solver_result(run->solver, &result, error);
        if (status == FAIRMESH_STATUS_OK) read_all(result, given->growth);
        MUST(fairmesh_result_free(result) == FAIRMESH_STATUS_OK);
        return status;
    case 6: return fairmesh_solver_bulge_range(run->solver, room_of(sizeof(fairmesh_bulge_range), given->growth), error);
    case 7: return fairmesh_solver_finish(run->solver, to->report, error);
    default: return fairmesh_solver_edit(run->solver, NULL, 0, error);
    }
}

/* A solver that is run, changed and read as the script says; once freed it is known no more. */
static fairmesh_status solver(Run *run) {
    const Handed *to = &run->handed;
    fairmesh_solver *made = NULL;
    fairmesh_status status = checked(fairmesh_solver_new(to->mesh, to->selection, to->options, &made, to->error), to->error);
    size_t steps;
    if (status != FAIRMESH_STATUS_OK) return status;
    run->solver = made;
    for (steps = next(&run->script) % 12u; steps > 0; steps--) checked(solver_step(run, next(&run->script)), to->error);
    status = fairmesh_solver_result(made, to->result, to->error);
    run->solver = NULL;
    MUST(fairmesh_solver_free(made) == FAIRMESH_STATUS_OK);
    MUST(fairmesh_solver_free(made) == FAIRMESH_STATUS_BAD_HANDLE);
    return status;
}

/* Options of another version get the defaults that this has. */
static fairmesh_status initialize(Run *run) {
    size_t size = next(&run->script) + 256u * (next(&run->script) % 8u);
    void *options = block(size);
    switch (next(&run->script) % 5u) {
    case 0: return fairmesh_options_init(options, size);
    case 1: return fairmesh_fill_options_init(options, size);
    case 2: return fairmesh_bridge_options_init(options, size);
    case 3: return fairmesh_round_options_init(options, size);
    default: return fairmesh_remesh_options_init(options, size);
    }
}

/* Words for any number. */
static fairmesh_status describe(Run *run) {
    uint32_t answer = next(&run->script) % (FAIRMESH_ANSWER_GAP_KIND + 3u), text = next(&run->script) % 5u, sign = next(&run->script);
    int64_t number = next(&run->script);
    const char *words = fairmesh_describe(answer, sign & 1 ? -number : sign & 2 ? number * (INT64_MAX / 255) : number, text);
    MUST(words != NULL && strlen(words) < 1000);
    MUST(fairmesh_version() > 0 && fairmesh_version_string()[0] != 0);
    return FAIRMESH_STATUS_OK;
}

typedef fairmesh_status (*Task)(Run *);
static const Task TASKS[] = {
    fair,        fill_holes,    solver,        remesh,     bridge,             refill,         select_region,
    suggest_joins, erase,       trim_boundary, carry_over, rim_roughness,      boundary_loops, components,
    self_intersections, mean_curvature, memory_needed, fair_again, round_creases, initialize, describe,
};
enum { TASK_COUNT = sizeof TASKS / sizeof TASKS[0] };

/* These two have no error detail. */
static inline int tells_error(Task task) { return task != initialize && task != describe; }

/* Whether a struct of the size that it says has this field. */
#define REACHES(options, field) ((options).struct_size >= offsetof(__typeof__(options), field) + sizeof(options).field)

/* Does a task, and reads its result. After a failure there is none. */
static inline void do_task(Task task, Given *given) {
    Run run;
    fairmesh_status status;
    memset(&run, 0, sizeof run);
    run.progress = given->options.progress = given->remesh.progress = given->patience ? watch : NULL;
    given->options.user_data = given->remesh.user_data = &run;
    /* Options that end between both have a callback that is told nothing to find its run by. */
    if (!REACHES(given->options, user_data)) given->options.progress = NULL;
    if (!REACHES(given->remesh, user_data)) given->remesh.progress = NULL;
    run.given = given;
    run.handed = hand_over(given, &run.result, &run.error);
    run.script.data = given->script;
    run.script.size = SCRIPT;
    status = task(&run);
    checked(status, tells_error(task) ? run.handed.error : NULL);
    if (status != FAIRMESH_STATUS_OK) MUST(run.result == NULL);
    /* A callback that did not stop the run has been told of its end; a solver may have been held up before. */
    if (status == FAIRMESH_STATUS_OK && run.calls > 0 && run.calls < given->patience && task != solver) MUST(run.fraction == 1.0);
    if (status == FAIRMESH_STATUS_CANCELLED) MUST(run.calls >= given->patience && given->patience > 0);
    if (run.result) read_all(run.result, given->growth);
    MUST(fairmesh_result_free(run.result) == FAIRMESH_STATUS_OK);
    if (run.result) MUST(fairmesh_result_free(run.result) == FAIRMESH_STATUS_BAD_HANDLE);
    free_blocks(0);
}

#endif
