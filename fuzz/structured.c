/* libFuzzer: small meshes that are nearly right, with options that are nearly right. A byte stream says what is done to them: the task,
 * the mesh, what spoils it, and what is asked. */
#include "builders.h"
#include "tasks.h"

/* Vertices of a side: of most meshes, and of the largest. */
enum { SIDE = 9, LARGE = 21, MOST_VERTICES = 2 * LARGE * LARGE, MOST_TRIANGLES = 4 * LARGE * LARGE };
typedef struct {
    double positions[MOST_VERTICES][3];
    uint32_t triangles[MOST_TRIANGLES][3];
    size_t vertices, count, side;
} Shape;

/* What sheets are bent to. */
enum { PLAIN, TUBE, TWO, PILLOW, KINDS };

static void place(double *at, unsigned kind, double x, double y, double bend, double height) {
    const double turn = 6.283185307179586 * x;
    at[0] = kind == TUBE ? 0.3 * cos(turn) : x;
    at[1] = kind == TUBE ? 0.3 * sin(turn) : y;
    at[2] = kind == TUBE ? y : height + bend * (kind == PILLOW ? 4.0 * (0.25 - x * x) * (0.25 - y * y) : x * x + y * y);
}

static void add_triangle(Shape *shape, size_t a, size_t b, size_t c, int is_flipped) {
    uint32_t corners[3] = {(uint32_t)a, (uint32_t)(is_flipped ? c : b), (uint32_t)(is_flipped ? b : c)};
    memcpy(shape->triangles[shape->count++], corners, sizeof corners);
}

/* A sheet of side * side vertices, the unit square; the ends of a tube's rows are the same vertices. */
static void add_sheet(Shape *shape, unsigned kind, double bend, double height, int is_flipped) {
    size_t side = shape->side, first = shape->vertices, round = kind == TUBE ? side - 1 : side, i, j;
    for (j = 0; j < side; j++)
        for (i = 0; i < round; i++)
            place(shape->positions[shape->vertices++], kind, (double)i / (double)(side - 1) - 0.5, (double)j / (double)(side - 1) - 0.5, bend, height);
    for (j = 0; j + 1 < side; j++)
        for (i = 0; i + 1 < side; i++) {
            size_t a = first + j * round + i, b = first + j * round + (i + 1) % round;
            add_triangle(shape, a, b, b + round, is_flipped);
            add_triangle(shape, a, b + round, a + round, is_flipped);
        }
}

static void drop_triangle(Shape *shape, size_t t) {
    if (shape->count > 1) memcpy(shape->triangles[t], shape->triangles[--shape->count], 12);
}

/* A hole: a vertex loses its triangles. */
static void drop_star(Shape *shape, uint32_t vertex) {
    size_t t;
    for (t = shape->count; t-- > 0;) {
        const uint32_t *c = shape->triangles[t];
        if (c[0] == vertex || c[1] == vertex || c[2] == vertex) drop_triangle(shape, t);
    }
}

/* One thing that is not as it was. */
static void change(Bytes *bytes, Shape *shape) {
    uint8_t what = next(bytes);
    size_t at = next(bytes), vertex = at % shape->vertices, triangle = at % shape->count;
    double *point = shape->positions[vertex];
    switch (what % 10u) {
    case 0: drop_star(shape, (uint32_t)vertex); break;
    case 1: point[2] += 0.3 * unit(bytes); break;
    case 2: point[next(bytes) % 3u] += unit(bytes); break;
    case 3: drop_triangle(shape, triangle); break;
    case 4: memcpy(point, shape->positions[next(bytes) % shape->vertices], 24); break;
    case 5: shape->triangles[triangle][next(bytes) % 3u] = one_of(bytes, (uint32_t)shape->vertices); break;
    case 6: memcpy(shape->triangles[triangle], shape->triangles[next(bytes) % shape->count], 12); break;
    case 7: point[next(bytes) % 3u] = between(bytes, -1e6, 1e6); break;
    case 8: point[next(bytes) % 3u] *= 1e-200; break;
    default: add_triangle(shape, vertex, next(bytes) % shape->vertices, next(bytes) % shape->vertices, 0); break;
    }
}

static Shape shape_of(Bytes *bytes) {
    enum { CHANGES = 16 };
    Shape shape;
    uint8_t what = next(bytes);
    unsigned kind = what % 4u;
    double bend = unit(bytes);
    size_t changes;
    memset(&shape, 0, sizeof shape);
    shape.side = what / 4u == 63 ? LARGE : 3 + (what / 4u + 3u) % (SIDE - 2);
    add_sheet(&shape, kind, bend, 0.0, 0);
    if (kind >= TWO) add_sheet(&shape, kind, kind == PILLOW ? -bend : bend, kind == PILLOW ? 0.0 : -0.3, what < 128 || kind == PILLOW);
    for (changes = next(bytes) % CHANGES; changes > 0; changes--) change(bytes, &shape);
    return shape;
}

/* The mesh: its arrays, and whether what is at one place is one vertex. */
static void give_mesh(Bytes *bytes, Given *given, const Shape *shape) {
    uint8_t what = next(bytes);
    size_t gap = what / 64u, t;
    View view = view_of(bytes, shape->positions[0], shape->vertices, 3);
    uint32_t *corners = block(4 * (3 + gap) * shape->count);
    for (t = 0; t < shape->count; t++) memcpy(corners + (3 + gap) * t, shape->triangles[t], 12);
    SEE(given->mesh.positions, view);
    given->mesh.triangles.data = corners;
    given->mesh.triangles.count = shape->count;
    given->mesh.triangles.stride = gap ? 4 * (3 + gap) : 0;
    /* The gap behind the last one is not the mesh's. */
    if (what & 1) given->mesh.coincident = one_of(bytes, 2);
    if (what & 2) given->mesh.coincident_within = between(bytes, 0.0, 0.1);
    if (what & 4) given->mesh.struct_size = size_like(bytes, sizeof given->mesh);
}

/* Which vertices move: without a byte, all that are not on the boundary. */
static void give_selection(Bytes *bytes, Given *given) {
    fairmesh_selection *selection = &given->selection;
    size_t vertices = given->mesh.positions.count, k;
    uint8_t what = next(bytes), *mask;
    fairmesh_indices listed;
    selection->kind = what < 250 ? what % 5u : what % 8u;
    if (what & 128) selection->struct_size = size_like(bytes, sizeof *selection);
    if (selection->kind == FAIRMESH_SELECTION_KIND_FREE_MASK || selection->kind == FAIRMESH_SELECTION_KIND_FIXED_MASK) {
        mask = block(vertices);
        for (k = 0; k < vertices; k++) mask[k] = (uint8_t)((k * 7 + what / 8u) % 11u < 5);
        for (k = next(bytes) % 16u; k > 0; k--) mask[next(bytes) % vertices] ^= 1;
        selection->data = mask;
        selection->count = vertices;
    } else if (selection->kind != FAIRMESH_SELECTION_KIND_INTERIOR) {
        listed = list(bytes, (uint32_t)(selection->kind == FAIRMESH_SELECTION_KIND_FACES ? given->mesh.triangles.count : vertices), 40, 1);
        selection->data = listed.data;
        selection->count = listed.count;
        selection->stride = listed.stride;
    }
}

/* Points, and where positions go: another array, or the mesh's own. */
static void give_points(Bytes *bytes, Given *given) {
    uint8_t what = next(bytes);
    size_t size = given->mesh.positions.count * 24;
    given->points = given->mesh.positions;
    given->out.count = given->mesh.positions.count + (what >= 250);
    given->out.scalar = what & 1 ? FAIRMESH_SCALAR_FLOAT32 : FAIRMESH_SCALAR_FLOAT64;
    given->out.data = memset(block(size + 24), 0x5a, size + 24);
    if (what % 8u == 6) {
        given->out.scalar = given->mesh.positions.scalar;
        given->out.stride = given->mesh.positions.stride;
        given->out.data = (void *)(uintptr_t)given->mesh.positions.data;
    }
}

/* What the task is about, besides the mesh: first what few tasks need not, last what few need. */
static void give_all(Bytes *bytes, Given *given) {
    uint32_t vertices = (uint32_t)given->mesh.positions.count, elements = vertices + (uint32_t)given->mesh.triangles.count;
    size_t k;
    give_selection(bytes, given);
    given->missing = next_two(bytes);
    given->patience = next(bytes);
    given->growth = (int8_t)(next(bytes) % 16u - next(bytes) % 16u);
    given->first = list(bytes, vertices, 12, 1);
    given->second = list(bytes, vertices, 12, 1);
    given->most = amount(bytes, 1000);
    given->number = between(bytes, 0.0, 1.0);
    for (k = 0; k < SCRIPT; k++) given->script[k] = next(bytes);
    give_options(bytes, &given->options, vertices);
    give_fill(bytes, &given->fill, vertices);
    give_bridge(bytes, &given->bridge);
    give_round(bytes, &given->round, vertices, given->mesh.triangles.count);
    give_remesh(bytes, &given->remesh);
    give_points(bytes, given);
    give_limit(bytes, &given->limit);
    given->edit_count = next(bytes) % (EDITS + 1u);
    for (k = 0; k < given->edit_count; k++) give_edit(bytes, &given->edits[k], vertices);
    given->step_count = next(bytes) % (STEPS + 1u);
    for (k = 0; k < given->step_count; k++) give_step(bytes, &given->steps[k], elements);
}

int LLVMFuzzerInitialize(int *argc, char ***argv);

int LLVMFuzzerInitialize(int *argc, char ***argv) {
    (void)argc, (void)argv;
    return fairmesh_set_log(found_bug, NULL);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
    Bytes bytes = {data, size};
    Given given;
    Shape shape;
    Task task = TASKS[next(&bytes) % TASK_COUNT];
    give_nothing(&given);
    shape = shape_of(&bytes);
    give_mesh(&bytes, &given, &shape);
    give_all(&bytes, &given);
    do_task(task, &given);
    return 0;
}
