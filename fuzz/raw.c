/* libFuzzer: a call that is right, of whose arguments the bytes change any byte: of the structs, lists and arrays. Only what the contract asks
 * for is kept: arrays lie within their memory. The bytes are the task, then patches: where (two bytes), how many, what. */
#include "tasks.h"

#include <stddef.h>

enum { SIDE = 5, VERTICES = SIDE * SIDE, TRIANGLES = 2 * (SIDE - 1) * (SIDE - 1), LIST = 16 };

/* The arrays. Nothing is at 0, which stands for NULL. */
typedef struct {
    double nothing;
    double positions[VERTICES][3];
    uint32_t triangles[TRIANGLES][3];
    uint32_t list[LIST];
    double out[VERTICES][4];
    uint8_t mask[VERTICES];
} Arrays;

typedef struct {
    Given given;
    Arrays arrays;
} All;

/* An array is where it begins in the arrays, until its pointer is made of that. */
#define AT(array) ((void *)(uintptr_t)offsetof(Arrays, array))

static void make_grid(Arrays *arrays) {
    uint32_t (*t)[3] = arrays->triangles;
    size_t v;
    for (v = 0; v < VERTICES; v++) {
        double x = (double)(v % SIDE) / (SIDE - 1) - 0.5, y = (double)(v / SIDE) / (SIDE - 1) - 0.5;
        uint32_t a = (uint32_t)v, quad[2][3] = {{a, a + 1, a + SIDE + 1}, {a, a + SIDE + 1, a + SIDE}};
        arrays->positions[v][0] = x;
        arrays->positions[v][1] = y;
        arrays->positions[v][2] = 0.4 * x * x;
        arrays->mask[v] = v % SIDE > 0 && v % SIDE + 1 < SIDE && v / SIDE > 0 && v / SIDE + 1 < SIDE;
        if (v % SIDE + 1 < SIDE && v / SIDE + 1 < SIDE) memcpy(t, quad, sizeof quad), t += 2;
    }
    for (v = 0; v < LIST; v++) arrays->list[v] = (uint32_t)v;
}

static void make_right(All *all) {
    Given *given = &all->given;
    memset(all, 0, sizeof *all);
    give_nothing(given);
    make_grid(&all->arrays);
    given->mesh.positions.data = AT(positions);
    given->mesh.positions.count = VERTICES;
    given->mesh.positions.scalar = FAIRMESH_SCALAR_FLOAT64;
    given->mesh.triangles.data = AT(triangles);
    given->mesh.triangles.count = TRIANGLES;
    given->selection.kind = FAIRMESH_SELECTION_KIND_FREE_MASK;
    given->selection.data = AT(mask);
    given->selection.count = VERTICES;
    given->points = given->mesh.positions;
    given->out.data = AT(out);
    given->out.count = VERTICES;
    given->out.scalar = FAIRMESH_SCALAR_FLOAT64;
    given->first.data = given->second.data = AT(list);
    given->first.count = given->second.count = 2;
    given->options.tolerance = 1e-4;
    given->options.max_iterations = 16;
    given->options.threads = 1;
    given->fill.max_new_vertices = 200;
    given->remesh.max_vertices = 500;
    given->round.width = 0.25;
    given->round.max_blend_vertices = 2000;
    given->step_count = given->edit_count = 1;
}

static void patch(Bytes *bytes, All *all) {
    while (bytes->size > 0) {
        size_t at = next_two(bytes), count = next(bytes);
        for (; count > 0 && bytes->size > 0; count--, at++) ((uint8_t *)all)[at % sizeof *all] = next(bytes);
    }
}

/* An array within memory: rows of at most 32 bytes. Counts that no memory can have stay. */
static void *within(const void *at, size_t *count, size_t stride, uint8_t *memory) {
    enum { ROW = 32 };
    size_t begin = (uintptr_t)at % (sizeof(Arrays) - ROW), step = stride > ROW ? stride : ROW;
    size_t most = (sizeof(Arrays) - ROW - begin) / step + 1;
    if (*count > most && *count - 1 <= (size_t)PTRDIFF_MAX / (stride ? stride : 1)) *count = 1 + *count % most;
    return begin == 0 ? NULL : memory + begin;
}

#define WITHIN(view) ((view).data = within((view).data, &(view).count, (view).stride, memory))

static void point_within(Given *given, uint8_t *memory) {
    size_t k;
    WITHIN(given->mesh.positions);
    WITHIN(given->mesh.triangles);
    WITHIN(given->selection);
    WITHIN(given->options.boundary_normals.vectors);
    WITHIN(given->options.boundary_normals.vertices);
    WITHIN(given->options.loop_continuity.values);
    WITHIN(given->options.loop_continuity.vertices);
    WITHIN(given->options.boundary_curvature.values);
    WITHIN(given->options.boundary_curvature.vertices);
    WITHIN(given->options.marked_edges);
    WITHIN(given->fill.join.loops);
    WITHIN(given->fill.join.starts);
    WITHIN(given->fill.guides);
    WITHIN(given->fill.loops);
    WITHIN(given->fill.filter.components);
    WITHIN(given->first);
    WITHIN(given->second);
    WITHIN(given->points);
    WITHIN(given->out);
    for (k = 0; k < STEPS; k++) WITHIN(given->steps[k].list);
    for (k = 0; k < EDITS; k++) WITHIN(given->edits[k].vertices);
    if (given->step_count <= SIZE_MAX / 64) given->step_count %= STEPS + 1u;
    if (given->edit_count <= SIZE_MAX / 64) given->edit_count %= EDITS + 1u;
}

int LLVMFuzzerInitialize(int *argc, char ***argv);

int LLVMFuzzerInitialize(int *argc, char ***argv) {
    (void)argc, (void)argv;
    return fairmesh_set_log(found_bug, NULL);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
    Bytes bytes = {data, size};
    All all;
    Task task = TASKS[next(&bytes) % TASK_COUNT];
    make_right(&all);
    patch(&bytes, &all);
    /* Of its own, so that its ends are known. */
    point_within(&all.given, memcpy(block(sizeof(Arrays)), &all.arrays, sizeof(Arrays)));
    do_task(task, &all.given);
    return 0;
}
