/* Lets every allocation in turn fail, once and for ever (feature capi-hooks): a status, no abort, no leak, inputs as before;
 * and panics on purpose: INTERNAL, and a poisoned solver. */
#define _POSIX_C_SOURCE 200809L
#include "common.h"
#include <time.h>

extern uint64_t fairmesh_test_refuse(int64_t after, int64_t refusals);
extern uint64_t fairmesh_test_reserve_blocks(void);
extern int64_t fairmesh_test_blocks(void);
extern uint64_t fairmesh_test_reserve_peak(uint64_t *aside);
extern void fairmesh_test_panic(int64_t after);

#define SIDE 9

typedef struct {
    Cap cap;
    fairmesh_options options;
    double *out, *kept;
    uint32_t *kept_corners;
    size_t out_of_memory, good;
    int joins_itself, relaxes;
} Scene;

static const uint32_t both[2] = {0, 1};

/* Of the last call. */
static fairmesh_error error;
static fairmesh_result *result;

/* The good and the expected end; anything else is a failure of the test. */
static int passed(Scene *s, int32_t status) {
    CHECK(error.status == status);
    if (status == FAIRMESH_STATUS_OK) {
        s->good++;
        return 1;
    }
    if (status != FAIRMESH_STATUS_OUT_OF_MEMORY) {
        fprintf(stderr, "status %d: %s\n", (int)status, error.message);
        exit(1);
    }
    s->out_of_memory++;
    return 0;
}

/* The same with a result, which is freed: whether there was one. */
static int made(Scene *s, int32_t status) {
    if (!passed(s, status)) {
        CHECK(result == NULL);
        return 0;
    }
    OK(fairmesh_result_free(result));
    result = NULL;
    return 1;
}

static void fair_once(Scene *s) {
    fairmesh_points_out out = points_out_of(s->out, s->cap.vertices);
    memset(s->out, 0x5a, 24 * s->cap.vertices);
    if (!made(s, fairmesh_fair(&s->cap.mesh, &s->cap.selection, &s->options, &out, NULL, &result, &error))) {
        size_t k;
        for (k = 0; k < 24 * s->cap.vertices; k++) CHECK(((unsigned char *)s->out)[k] == 0x5a);
    }
}

static void steps(Scene *s) {
    fairmesh_solver *solver = NULL;
    fairmesh_options asked = s->options;
    fairmesh_points_out out = points_out_of(s->out, s->cap.vertices);
    if (!passed(s, fairmesh_solver_new(&s->cap.mesh, &s->cap.selection, &s->options, &solver, &error))) {
        CHECK(solver == NULL);
        return;
    }
    asked.target.kind = FAIRMESH_TARGET_KIND_CONSTANT;
    asked.target.constant = 1.0;
    passed(s, fairmesh_solver_run(solver, 2, NULL, &error));
    passed(s, fairmesh_solver_set(solver, FAIRMESH_SETTING_TARGET, &asked, &error));
    passed(s, fairmesh_solver_run(solver, 100, NULL, &error));
    OK(fairmesh_solver_positions(solver, &out, &error));
    made(s, fairmesh_solver_result(solver, &result, &error));
    OK(fairmesh_solver_free(solver));
}

static void live(Scene *s) {
    fairmesh_solver *solver = NULL;
    fairmesh_edit edits[2];
    SIZED(fairmesh_frame, frame);
    SIZED(fairmesh_bulge_range, range);
    uint32_t fixed = 0;
    memset(edits, 0, sizeof edits);
    edits[0].kind = FAIRMESH_EDIT_KIND_BULGE;
    edits[0].amount = 0.02;
    edits[1].kind = FAIRMESH_EDIT_KIND_MOVE;
    edits[1].vertices = indices_of(&fixed, 1);
    edits[1].translation[2] = 1e-3;
    edits[1].falloff = 0.1;
    if (!passed(s, fairmesh_solver_new(&s->cap.mesh, &s->cap.selection, &s->options, &solver, &error))) return;
    passed(s, fairmesh_solver_edit(solver, edits, 2, &error));
    passed(s, fairmesh_solver_update(solver, NULL, &frame, &error));
    passed(s, fairmesh_solver_edit(solver, edits, 1, &error));
    passed(s, fairmesh_solver_update(solver, NULL, &frame, &error));
    passed(s, fairmesh_solver_bulge_range(solver, &range, &error));
    passed(s, fairmesh_solver_finish(solver, NULL, &error));
    OK(fairmesh_solver_free(solver));
}

static void loops(Scene *s) {
    made(s, fairmesh_boundary_loops(&s->cap.mesh, &result, &error));
}

static void roughness(Scene *s) {
    made(s, fairmesh_rim_roughness(&s->cap.mesh, &result, &error));
}

static void remesh(Scene *s) {
    fairmesh_remesh_options options;
    OK(fairmesh_remesh_options_init(&options, sizeof options));
    options.density *= 2.0;
    made(s, fairmesh_remesh(&s->cap.mesh, &s->cap.selection, &options, &result, &error));
}

static void fill(Scene *s) {
    fairmesh_fill_options options;
    fairmesh_mesh mesh = s->cap.mesh;
    uint32_t *holed = (uint32_t *)must(malloc(12 * s->cap.triangles));
    size_t t, kept = 0;
    for (t = 0; t < s->cap.triangles; t++) {
        const uint32_t *c = s->cap.corners + 3 * t;
        if (!s->cap.free_mask[c[0]] && !s->cap.free_mask[c[1]] && !s->cap.free_mask[c[2]]) {
            memcpy(holed + 3 * kept++, c, 12);
        }
    }
    mesh.triangles.data = holed;
    mesh.triangles.count = kept;
    OK(fairmesh_fill_options_init(&options, sizeof options));
    options.relax_rim = s->relaxes ? 3 : 0;
    made(s, fairmesh_fill_holes(&mesh, &options, &s->options, &result, &error));
    free(holed);
}

/* Both caps of a sphere, joined. */
static void join(Scene *s) {
    fairmesh_fill_options options;
    static Ball ball;
    ball_make(&ball);
    OK(fairmesh_fill_options_init(&options, sizeof options));
    options.join.kind = s->joins_itself ? FAIRMESH_JOIN_KIND_AUTO : FAIRMESH_JOIN_KIND_GROUPS;
    options.join.loops = indices_of(both, 2);
    made(s, fairmesh_fill_holes(&ball.mesh, &options, &s->options, &result, &error));
}

static void bridge(Scene *s) {
    static const uint32_t ends[2][2] = {{BALL_CAP - BALL_ROUND, BALL_CAP - BALL_ROUND + 1},
                                        {BALL_VERTICES - BALL_ROUND, BALL_VERTICES - BALL_ROUND + 1}};
    fairmesh_bridge_options how;
    const fairmesh_indices from = indices_of(ends[0], 2), to = indices_of(ends[1], 2);
    static Ball ball;
    ball_make(&ball);
    OK(fairmesh_bridge_options_init(&how, sizeof how));
    how.fill = 1;
    made(s, fairmesh_bridge(&ball.mesh, &from, &to, &how, NULL, &s->options, &result, &error));
}

/* One edge of a box. */
static void rounding(Scene *s) {
    static double corners[24];
    static const uint32_t faces[36] = {0, 2, 3, 0, 3, 1, 4, 5, 7, 4, 7, 6, 0, 1, 5, 0, 5, 4,
                                       2, 6, 7, 2, 7, 3, 0, 4, 6, 0, 6, 2, 1, 3, 7, 1, 7, 5};
    fairmesh_round_options how;
    SIZED(fairmesh_mesh, box);
    size_t k;
    for (k = 0; k < 24; k++) corners[k] = (k / 3) >> (k % 3) & 1 ? 1 : -1;
    box.positions = points_of(corners, 8);
    box.triangles = indices_of(faces, 12);
    OK(fairmesh_round_options_init(&how, sizeof how));
    how.width = 0.6;
    how.edges = indices_of(both, 1);
    made(s, fairmesh_round(&box, &how, &s->options, &result, &error));
}

static void suggest(Scene *s) {
    static Ball ball;
    ball_make(&ball);
    made(s, fairmesh_suggest_joins(&ball.mesh, NULL, &result, &error));
}

static void erase(Scene *s) {
    const fairmesh_indices faces = indices_of(both, 2);
    made(s, fairmesh_erase(&s->cap.mesh, &faces, 3, &result, &error));
    made(s, fairmesh_trim_boundary(&s->cap.mesh, NULL, 3, 0.0, &result, &error));
    made(s, fairmesh_components(&s->cap.mesh, &result, &error));
}

static void region(Scene *s) {
    fairmesh_region_step asked[6];
    int32_t status;
    memset(asked, 0, sizeof asked);
    asked[0].kind = FAIRMESH_REGION_KIND_BALL;
    asked[0].value = 0.5;
    asked[0].point[2] = 1.0;
    asked[1].kind = FAIRMESH_REGION_KIND_GEODESIC;
    asked[1].value = 0.5;
    asked[2].kind = FAIRMESH_REGION_KIND_GROW;
    asked[2].rings = 2;
    asked[3].kind = FAIRMESH_REGION_KIND_TRIANGLES;
    asked[3].combine = FAIRMESH_COMBINE_REMOVE;
    asked[3].list = indices_of(both, 2);
    asked[4].kind = FAIRMESH_REGION_KIND_PATCH;
    asked[4].combine = FAIRMESH_COMBINE_INTERSECT;
    asked[4].value = 180.0;
    made(s, fairmesh_select_region(&s->cap.mesh, asked, 5, NULL, NULL, &result, &error));
    /* Regions are faired, whether or not there is a bump; few, as each allocation of theirs is refused. */
    asked[5].kind = FAIRMESH_REGION_KIND_BUMP;
    asked[5].point[2] = 1.0;
    asked[5].value = 1.8 / (double)s->cap.side;
    status = fairmesh_select_region(&s->cap.mesh, asked, 6, NULL, NULL, &result, &error);
    if (status == FAIRMESH_STATUS_NO_BUMP) return;
    made(s, status);
}

static void refill(Scene *s) {
    made(s, fairmesh_refill(&s->cap.mesh, &s->cap.selection, NULL, &s->options, &result, &error));
}

static void carry(Scene *s) {
    fairmesh_points points = points_of(s->kept, s->cap.vertices);
    made(s, fairmesh_carry_over(&s->cap.mesh, NULL, &points, NULL, NULL, &result, &error));
}

static void curvature(Scene *s) {
    fairmesh_scalars_out out = scalars_out_of(s->out, s->cap.vertices);
    passed(s, fairmesh_mean_curvature(&s->cap.mesh, &out, &error));
}

static void intersections(Scene *s) {
    made(s, fairmesh_self_intersections(&s->cap.mesh, NULL, NULL, NULL, &result, &error));
}

static double seconds(void) {
    struct timespec now;
    clock_gettime(CLOCK_MONOTONIC, &now);
    return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

static void every_allocation(Scene *s, void (*work)(Scene *), const char *name, int64_t by) {
    int64_t count, n;
    uint64_t peak, aside, most = 0, of = 1;
    int64_t before;
    double start = seconds();
    int mode;
    work(s);
    s->good = s->out_of_memory = 0;
    fairmesh_test_refuse(-1, 0);
    work(s);
    count = (int64_t)fairmesh_test_refuse(-1, 0);
    CHECK(s->out_of_memory == 0);
    fairmesh_test_reserve_peak(&aside);
    before = fairmesh_test_blocks();
    for (mode = 0; mode < 2; mode++) {
        for (n = 0; n < count; n += by) {
            fairmesh_test_refuse(n, mode == 0 ? 1 : INT64_MAX);
            work(s);
            fairmesh_test_refuse(-1, 0);
            CHECK(fairmesh_test_reserve_blocks() == 0);
            /* The collector of the threads' queues holds a few blocks back for later. */
            CHECK(fairmesh_test_blocks() <= before + 16);
            CHECK(memcmp(s->kept, s->cap.positions, 24 * s->cap.vertices) == 0);
            CHECK(memcmp(s->kept_corners, s->cap.corners, 12 * s->cap.triangles) == 0);
            peak = fairmesh_test_reserve_peak(&aside);
            if (aside > 0 && peak * of >= most * aside) most = peak, of = aside;
        }
    }
    printf("%s: %d allocations failing, %u times out of memory, %u calls good, reserve %.1f of %.1f kB (%.0f %%), %.1f s\n",
           name, (int)count, (unsigned)s->out_of_memory, (unsigned)s->good, (double)most / 1e3, (double)of / 1e3,
           100.0 * (double)most / (double)of, seconds() - start);
    CHECK(s->out_of_memory > 0);
}

static void keep(const char *message, void *kept) {
    strncpy((char *)kept, message, 255);
}

static void panics(Scene *s) {
    ZERO(fairmesh_region_step, all);
    SIZED(fairmesh_info, info);
    fairmesh_solver *solver = NULL;
    fairmesh_points_out out = points_out_of(s->out, s->cap.vertices);
    char told[256] = "";
    memset(s->out, 0x5a, 24 * s->cap.vertices);
    /* In place of stderr. */
    OK(fairmesh_set_log(keep, told));
    fairmesh_test_panic(0);
    CHECK(fairmesh_fair(&s->cap.mesh, &s->cap.selection, &s->options, &out, NULL, &result, &error) ==
          FAIRMESH_STATUS_INTERNAL);
    CHECK(result == NULL && strstr(error.message, "a test asked for this") != NULL && s->out[0] == s->out[1]);
    CHECK(strstr(told, "a test asked for this") != NULL && strstr(told, "hooks.rs:") != NULL);
    OK(fairmesh_set_log(NULL, NULL));
    memset(told, 0, sizeof told);
    OK(fairmesh_solver_new(&s->cap.mesh, &s->cap.selection, &s->options, &solver, &error));
    fairmesh_test_panic(0);
    CHECK(fairmesh_solver_run(solver, 1, NULL, &error) == FAIRMESH_STATUS_INTERNAL);
    CHECK(fairmesh_solver_run(solver, 1, NULL, &error) == FAIRMESH_STATUS_INTERNAL);
    CHECK(fairmesh_solver_positions(solver, &out, &error) == FAIRMESH_STATUS_INTERNAL);
    CHECK(strstr(error.message, "free it") != NULL);
    OK(fairmesh_solver_free(solver));
    fairmesh_test_panic(0);
    CHECK(fairmesh_select_region(&s->cap.mesh, &all, 1, NULL, NULL, &result, &error) == FAIRMESH_STATUS_INTERNAL && result == NULL);
    OK(fairmesh_boundary_loops(&s->cap.mesh, &result, &error));
    fairmesh_test_panic(0);
    CHECK(fairmesh_result_info(result, &info, &error) == FAIRMESH_STATUS_INTERNAL);
    OK(fairmesh_result_info(result, &info, &error));
    OK(fairmesh_result_free(result));
    result = NULL;
    CHECK(told[0] == 0);
}

int main(int count, char **arguments) {
    Scene s;
    /* Every how manieth; a large mesh tests the size of the reserve. */
    int64_t by = count > 1 ? atoi(arguments[1]) : 1;
    size_t side = count > 2 ? (size_t)atoi(arguments[2]) : SIDE;
    memset(&s, 0, sizeof s);
    s.cap = cap_new(side);
    OK(fairmesh_options_init(&s.options, sizeof s.options));
    s.options.threads = count > 3 ? (uint32_t)atoi(arguments[3]) : 1;
    s.out = (double *)must(malloc(24 * s.cap.vertices));
    s.kept = (double *)must(malloc(24 * s.cap.vertices));
    s.kept_corners = (uint32_t *)must(malloc(12 * s.cap.triangles));
    memcpy(s.kept, s.cap.positions, 24 * s.cap.vertices);
    memcpy(s.kept_corners, s.cap.corners, 12 * s.cap.triangles);
    panics(&s);
    s.options.continuity = 0.0;
    every_allocation(&s, fair_once, "fair", by);
    s.options.continuity = 1.0;
    every_allocation(&s, fair_once, "fair, continuous curvature", count > 2 ? 7 * by : by);
    s.options.continuity = 0.0;
    every_allocation(&s, steps, "solver", by);
    every_allocation(&s, live, "live", 97 * by);
    every_allocation(&s, erase, "erase, trim, components", by);
    /* Each region that is faired takes some, and each point. */
    every_allocation(&s, region, "region", count > 2 ? 97 * by : by);
    every_allocation(&s, carry, "carry over", count > 2 ? 97 * by : by);
    if (count > 4) return 0;
    every_allocation(&s, loops, "loops", by);
    every_allocation(&s, curvature, "mean curvature", by);
    every_allocation(&s, intersections, "self-intersections", by);
    every_allocation(&s, remesh, "remesh", by);
    every_allocation(&s, fill, "fill", by);
    s.relaxes = 1;
    every_allocation(&s, fill, "fill, boundaries relaxed", by);
    every_allocation(&s, roughness, "roughness", by);
    every_allocation(&s, refill, "refill", 3 * by);
    every_allocation(&s, suggest, "suggest joins", 7 * by);
    every_allocation(&s, join, "join", 29 * by);
    every_allocation(&s, bridge, "bridge", 97 * by);
    every_allocation(&s, rounding, "round", 997 * by);
    s.joins_itself = 1;
    every_allocation(&s, join, "join by itself", 97 * by);
    free(s.out);
    free(s.kept);
    free(s.kept_corners);
    cap_free(&s.cap);
    puts("memory: passed");
    return 0;
}
