/* Several threads on handles of their own get the same bits; on one handle they get OK or BUSY, and nothing else. */
#define _POSIX_C_SOURCE 200809L
#include "common.h"
#include <dirent.h>
#include <pthread.h>
#include <sys/wait.h>
#include <time.h>
#include <unistd.h>

#define THREADS 4
#define ROUNDS 30

static Cap cap;
static double *expected;
static fairmesh_solver *shared;
static fairmesh_result *common;

static fairmesh_options options_of(uint32_t threads) {
    fairmesh_options options;
    OK(fairmesh_options_init(&options, sizeof options));
    options.threads = threads;
    return options;
}

/* Its own: one call, and in steps. */
static void *alone(void *nothing) {
    size_t bytes = 24 * cap.vertices;
    double *out = (double *)must(malloc(bytes));
    fairmesh_points_out to = points_out_of(out, cap.vertices);
    fairmesh_options options = options_of(2);
    fairmesh_solver *solver = NULL;
    int k;
    (void)nothing;
    for (k = 0; k < 3; k++) {
        OK(fairmesh_fair(&cap.mesh, &cap.selection, &options, &to, NULL, NULL, NULL));
        CHECK(memcmp(out, expected, bytes) == 0);
        OK(fairmesh_solver_new(&cap.mesh, &cap.selection, &options, &solver, NULL));
        OK(fairmesh_solver_run(solver, 3, NULL, NULL));
        OK(fairmesh_solver_run(solver, 1000, NULL, NULL));
        OK(fairmesh_solver_positions(solver, &to, NULL));
        CHECK(memcmp(out, expected, bytes) == 0);
        OK(fairmesh_solver_free(solver));
    }
    free(out);
    return NULL;
}

/* One handle for all; returns how often it was busy. */
static void *together(void *counts) {
    size_t *count = (size_t *)counts;
    double *out = (double *)must(malloc(24 * cap.vertices));
    fairmesh_points_out to = points_out_of(out, cap.vertices);
    SIZED(fairmesh_report, report);
    int k, which;
    for (k = 0; k < ROUNDS; k++) {
        for (which = 0; which < 4; which++) {
            fairmesh_options asked = options_of(2);
            fairmesh_result *made = NULL;
            fairmesh_error error;
            int32_t status;
            asked.target.kind = FAIRMESH_TARGET_KIND_CONSTANT;
            asked.target.constant = 0.1 * k;
            switch (which) {
            case 0: status = fairmesh_solver_run(shared, 2, &report, &error); break;
            case 1: status = fairmesh_solver_positions(shared, &to, &error); break;
            case 2: status = fairmesh_solver_set(shared, FAIRMESH_SETTING_TARGET, &asked, &error); break;
            default: status = fairmesh_solver_result(shared, &made, &error);
            }
            CHECK(status == FAIRMESH_STATUS_OK || status == FAIRMESH_STATUS_BUSY);
            CHECK(error.status == status);
            count[status == FAIRMESH_STATUS_BUSY]++;
            OK(fairmesh_result_free(made));
            OK(fairmesh_result_positions(common, &to, &error));
        }
    }
    free(out);
    return NULL;
}

typedef struct {
    fairmesh_solver *solver;
    int calls;
} Inside;

/* From the callback of a solver, that solver is busy; everything else is not. */
static int32_t inside(const fairmesh_progress *progress, void *user_data) {
    Inside *in = (Inside *)user_data;
    double number[3];
    fairmesh_points_out to = points_out_of(number, 1);
    fairmesh_error error;
    fairmesh_result *result = NULL;
    (void)progress;
    in->calls++;
    CHECK(fairmesh_solver_run(in->solver, 1, NULL, &error) == FAIRMESH_STATUS_BUSY);
    CHECK(fairmesh_solver_positions(in->solver, &to, &error) == FAIRMESH_STATUS_BUSY);
    CHECK(fairmesh_solver_result(in->solver, &result, &error) == FAIRMESH_STATUS_BUSY);
    CHECK(fairmesh_solver_free(in->solver) == FAIRMESH_STATUS_BUSY);
    OK(fairmesh_boundary_loops(&cap.mesh, &result, &error));
    OK(fairmesh_result_free(result));
    return 0;
}

static void start(void *(*work)(void *), size_t counts[THREADS][2]) {
    pthread_t threads[THREADS];
    int k;
    for (k = 0; k < THREADS; k++) CHECK(pthread_create(&threads[k], NULL, work, counts[k]) == 0);
    for (k = 0; k < THREADS; k++) CHECK(pthread_join(threads[k], NULL) == 0);
}

static void *nothing(void *data) { return data; }

/* Threads of this process. */
static int running(void) {
    DIR *tasks = opendir("/proc/self/task");
    int count = -2; /* "." and ".." */
    CHECK(tasks != NULL);
    while (readdir(tasks) != NULL) count++;
    closedir(tasks);
    return count;
}

/* Who has ended may be listed for a moment. */
static int settled(void) {
    const struct timespec moment = {0, 5000000};
    int least = running(), k;
    for (k = 0; k < 20; k++) {
        int now;
        nanosleep(&moment, NULL);
        now = running();
        if (now < least) least = now;
    }
    return least;
}

/* A thread that outlives its call would run on in a library that is unloaded. */
static void none_is_left(int before) {
    double *numbers = (double *)must(malloc(24 * cap.vertices));
    fairmesh_scalars_out h = scalars_out_of(numbers, cap.vertices);
    fairmesh_result *result = NULL;
    OK(fairmesh_mean_curvature(&cap.mesh, &h, NULL));
    OK(fairmesh_self_intersections(&cap.mesh, NULL, NULL, NULL, &result, NULL));
    OK(fairmesh_result_free(result));
    OK(fairmesh_fill_holes(&cap.mesh, NULL, NULL, &result, NULL));
    OK(fairmesh_result_free(result));
    free(numbers);
    CHECK(settled() == before);
}

/* A forked process has a solver's memory, and not its threads: a call would wait for them for ever. */
static void a_forked_process_has_no_solvers(fairmesh_solver *solver) {
    int status = 0;
    pid_t child = fork();
    CHECK(child >= 0);
    if (child == 0) {
        double *out = (double *)must(malloc(24 * cap.vertices));
        fairmesh_points_out to = points_out_of(out, cap.vertices);
        fairmesh_options options = options_of(2);
        alarm(20);
        (void)options;
        CHECK(fairmesh_solver_run(solver, 3, NULL, NULL) == FAIRMESH_STATUS_BAD_HANDLE);
        CHECK(fairmesh_solver_free(solver) == FAIRMESH_STATUS_BAD_HANDLE);
        OK(fairmesh_result_positions(common, &to, NULL));
#ifndef __SANITIZE_THREAD__ /* which allows no threads there */
        OK(fairmesh_fair(&cap.mesh, &cap.selection, &options, &to, NULL, NULL, NULL));
#endif
        CHECK(memcmp(out, expected, 24 * cap.vertices) == 0);
        _exit(0);
    }
    CHECK(waitpid(child, &status, 0) == child && WIFEXITED(status) && WEXITSTATUS(status) == 0);
    OK(fairmesh_solver_run(solver, 1, NULL, NULL));
}

int main(void) {
    fairmesh_options options = options_of(1);
    fairmesh_points_out to;
    size_t counts[THREADS][2], good = 0, busy = 0;
    Inside in = {NULL, 0};
    int k, before;
    pthread_t first;
    /* A sanitizer has one of its own from the first one on. */
    CHECK(pthread_create(&first, NULL, nothing, NULL) == 0 && pthread_join(first, NULL) == 0);
    before = settled();
    cap = cap_new(21);
    expected = (double *)must(malloc(24 * cap.vertices));
    to = points_out_of(expected, cap.vertices);
    OK(fairmesh_fair(&cap.mesh, &cap.selection, &options, &to, NULL, &common, NULL));
    memset(counts, 0, sizeof counts);
    start(alone, counts);
    OK(fairmesh_solver_new(&cap.mesh, &cap.selection, &options, &shared, NULL));
    start(together, counts);
    for (k = 0; k < THREADS; k++) good += counts[k][0], busy += counts[k][1];
    printf("threads: %u calls on one handle good, %u busy\n", (unsigned)good, (unsigned)busy);
    CHECK(good > 0 && busy > 0);
    a_forked_process_has_no_solvers(shared);
    OK(fairmesh_solver_free(shared));
    options.progress = inside;
    options.user_data = &in;
    OK(fairmesh_solver_new(&cap.mesh, &cap.selection, &options, &in.solver, NULL));
    OK(fairmesh_solver_run(in.solver, 1000, NULL, NULL));
    CHECK(in.calls > 3);
    OK(fairmesh_solver_free(in.solver));
    OK(fairmesh_result_free(common));
    free(expected);
    none_is_left(before);
    cap_free(&cap);
    puts("threads: passed");
    return 0;
}
