/* A program of the first version, with a library whose structs have grown: its structs end earlier, and what lies right behind them is
 * its own, and in use. */
#include "common.h"

/* How long the structs were at first. */
enum {
    MESH = 24 + 6 * sizeof(void *),
    OPTIONS = 112 + 18 * sizeof(void *),
    FILL = 64 + 9 * sizeof(void *),
    REMESH = 24,
    REPORT = 288,
    COMPONENT = 160,
    LOOP = 56,
    FILL_REPORT = 104,
    INFO = 56,
    GUARD = 512
};

static fairmesh_error error;

/* Memory without gaps: structs of the first version one after the other, and a guard. */
typedef struct {
    unsigned char *memory;
    size_t used;
} Block;

static Block block_new(size_t more) {
    Block block = {NULL, 0};
    block.memory = (unsigned char *)must(malloc(4096 + more));
    memset(block.memory, 0x5a, 4096 + more);
    return block;
}

/* The next struct, of `first` bytes of what a program of today has; zero if it has nothing. */
static void *old(Block *block, const void *today, size_t first) {
    unsigned char *made = block->memory + block->used;
    uint32_t size = (uint32_t)first;
    if (today != NULL) memcpy(made, today, first);
    else memset(made, 0, first);
    memcpy(made, &size, sizeof size);
    block->used += first;
    return made;
}

static void check_guard(const Block *block) {
    size_t k;
    for (k = 0; k < GUARD; k++) CHECK(block->memory[block->used + k] == 0x5a);
}

/* Mesh, options, positions and report, without a byte between them. */
static void fairing(const Cap *cap) {
    size_t bytes = 24 * cap->vertices;
    double *whole = (double *)must(malloc(bytes));
    fairmesh_points_out out = points_out_of(whole, cap->vertices);
    Block block = block_new(bytes);
    fairmesh_options today;
    SIZED(fairmesh_report, report);
    const fairmesh_mesh *mesh;
    const fairmesh_options *options;
    fairmesh_report *told;
    OK(fairmesh_options_init(&today, sizeof today));
    today.target.kind = FAIRMESH_TARGET_KIND_MINIMAL_ENERGY;
    OK(fairmesh_fair(&cap->mesh, &cap->selection, &today, &out, &report, NULL, &error));

    mesh = (const fairmesh_mesh *)old(&block, &cap->mesh, MESH);
    options = (const fairmesh_options *)old(&block, &today, OPTIONS);
    out.data = block.memory + block.used;
    block.used += bytes;
    told = (fairmesh_report *)old(&block, NULL, REPORT);
    OK(fairmesh_fair(mesh, &cap->selection, options, &out, told, NULL, &error));
    CHECK(memcmp(out.data, whole, bytes) == 0);
    CHECK(told->struct_size == REPORT && told->outcome == report.outcome && told->iterations == report.iterations);
    check_guard(&block);
    /* What it fills itself ends where it ends. */
    block.used = 0;
    OK(fairmesh_options_init((fairmesh_options *)old(&block, NULL, OPTIONS), OPTIONS));
    memset(block.memory + OPTIONS, 0x5a, GUARD);
    OK(fairmesh_options_init((fairmesh_options *)(void *)block.memory, OPTIONS));
    check_guard(&block);
    free(block.memory);
    free(whole);
}

/* The slot of the result lies right behind the options, and what is read of it is not written behind its end. */
static void filling(const Cap *cap) {
    fairmesh_fill_options today;
    Block block = block_new(0), read = block_new(0);
    fairmesh_mesh holed = cap->mesh;
    uint32_t *corners = (uint32_t *)must(malloc(12 * cap->triangles));
    const fairmesh_fill_options *fill;
    fairmesh_info *info;
    fairmesh_fill_report *told;
    fairmesh_loop *loop;
    fairmesh_component *component;
    fairmesh_result **result, *loops = NULL;
    size_t t, kept = 0;
    for (t = 0; t < cap->triangles; t++) {
        const uint32_t *c = cap->corners + 3 * t;
        if (!cap->free_mask[c[0]] && !cap->free_mask[c[1]] && !cap->free_mask[c[2]]) memcpy(corners + 3 * kept++, c, 12);
    }
    holed.triangles.data = corners;
    holed.triangles.count = kept;
    OK(fairmesh_fill_options_init(&today, sizeof today));
    fill = (const fairmesh_fill_options *)old(&block, &today, FILL);
    result = (fairmesh_result **)(void *)(block.memory + block.used);
    OK(fairmesh_fill_holes(&holed, fill, NULL, result, &error));
    info = (fairmesh_info *)old(&read, NULL, INFO);
    OK(fairmesh_result_info(*result, info, &error));
    CHECK(info->struct_size == INFO && info->new_vertex_count > 0);
    check_guard(&read);
    told = (fairmesh_fill_report *)old(&read, NULL, FILL_REPORT);
    OK(fairmesh_result_fill_report(*result, info->loop_count - 1, told, &error));
    CHECK(told->struct_size == FILL_REPORT && told->edge_count > 0);
    check_guard(&read);
    component = (fairmesh_component *)old(&read, NULL, COMPONENT);
    OK(fairmesh_result_component(*result, info->loop_count - 1, 0, component, &error));
    CHECK(component->struct_size == COMPONENT && component->free_vertices > 0);
    check_guard(&read);
    OK(fairmesh_result_free(*result));
    OK(fairmesh_boundary_loops(&holed, &loops, &error));
    loop = (fairmesh_loop *)old(&read, NULL, LOOP);
    OK(fairmesh_result_loop(loops, 0, loop, &error));
    CHECK(loop->struct_size == LOOP && loop->vertex_count > 0);
    check_guard(&read);
    OK(fairmesh_result_free(loops));
    free(corners);
    free(block.memory);
    free(read.memory);
}

int main(void) {
    Cap cap = cap_new(15);
    fairing(&cap);
    filling(&cap);
    cap_free(&cap);
    puts("older: passed");
    return 0;
}
