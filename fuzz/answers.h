/* What is asked of every answer, and the reading of results by all their getters. */
#ifndef ANSWERS_H
#define ANSWERS_H

#include "bytes.h"

/* Ends the run, which is what libFuzzer takes for a finding. */
#define MUST(condition)                                                            \
    do {                                                                           \
        if (!(condition)) {                                                        \
            fprintf(stderr, "%s:%d: not so: %s\n", __FILE__, __LINE__, #condition); \
            abort();                                                               \
        }                                                                          \
    } while (0)

/* A bug that the library has caught: the stack is still that of its place. */
static inline void found_bug(const char *message, void *user_data) {
    (void)user_data;
    fprintf(stderr, "%s\n", message);
    abort();
}

/* A status, with what was told of it. `error` may be NULL. */
static inline fairmesh_status checked(fairmesh_status status, const fairmesh_error *error) {
    MUST(status != FAIRMESH_STATUS_INTERNAL);
    if (!error) return status;
    MUST(error->status == (int32_t)status);
    MUST(memchr(error->message, 0, sizeof error->message) != NULL);
    MUST((status == FAIRMESH_STATUS_OK) == (error->message[0] == 0));
    MUST(status != FAIRMESH_STATUS_OK || error->element == FAIRMESH_NO_ELEMENT);
    return status;
}

/* A result that is read, with structs of a size of their own. */
typedef struct {
    const fairmesh_result *result;
    fairmesh_info info;
    int growth;
} Reading;

static fairmesh_error told;

#define READ(call) checked((call), &told)
#define ROOM(reading, type) ((type *)room_of(sizeof(type), (reading)->growth))

/* Indices up to the count, the one behind it, and the last that there can be; of many the first few. */
static inline uint64_t index_at(uint64_t k, uint64_t count) {
    enum { FEW = 6 };
    if (k < FEW) return k;
    return k == FEW ? count : k == FEW + 1 ? count + 1 : UINT64_MAX;
}
enum { INDICES = 9 };

/* The components of a report, their attempts, and how curvature is continued. */
static inline void read_components(const Reading *reading, uint64_t index, uint64_t count) {
    uint64_t k, i;
    for (k = 0; k < INDICES; k++) {
        uint64_t number = index_at(k, count);
        fairmesh_component component;
        memset(&component, 0, sizeof component);
        component.struct_size = sizeof component;
        if (READ(fairmesh_result_component(reading->result, index, number, &component, &told)) == FAIRMESH_STATUS_OK) MUST(number < count);
        READ(fairmesh_result_component(reading->result, index, number, ROOM(reading, fairmesh_component), &told));
        for (i = 0; i < INDICES; i++) {
            uint64_t attempt = index_at(i, component.attempt_count), loop = index_at(i, component.continuity_count);
            if (READ(fairmesh_result_attempt(reading->result, index, number, attempt, ROOM(reading, fairmesh_attempt), &told)) == FAIRMESH_STATUS_OK)
                MUST(attempt < component.attempt_count);
            if (READ(fairmesh_result_continuity(reading->result, index, number, loop, ROOM(reading, fairmesh_continuity), &told)) == FAIRMESH_STATUS_OK)
                MUST(loop < component.continuity_count);
        }
    }
}

/* What became of sharp edges, and where they arrive. */
static inline void read_sharp_edges(const Reading *reading, uint64_t index, uint64_t count) {
    uint64_t k, i;
    for (k = 0; k < INDICES; k++) {
        uint64_t number = index_at(k, count);
        fairmesh_sharp_edge edge;
        memset(&edge, 0, sizeof edge);
        edge.struct_size = sizeof edge;
        if (READ(fairmesh_result_sharp_edge(reading->result, index, number, &edge, &told)) == FAIRMESH_STATUS_OK) MUST(number < count);
        READ(fairmesh_result_sharp_edge(reading->result, index, number, ROOM(reading, fairmesh_sharp_edge), &told));
        for (i = 0; i < INDICES; i++) {
            uint64_t end = index_at(i, edge.end_count);
            if (READ(fairmesh_result_crease_end(reading->result, index, number, end, ROOM(reading, fairmesh_crease_end), &told)) == FAIRMESH_STATUS_OK)
                MUST(end < edge.end_count);
        }
    }
}

/* A list: its size, then all of it, then with one place less than it needs. */
static inline void read_list(const Reading *reading, uint32_t which, uint64_t index) {
    size_t size = 0, again = 0;
    uint32_t *list;
    if (READ(fairmesh_result_list(reading->result, which, index, NULL, 0, &size, &told)) != FAIRMESH_STATUS_OK) return;
    list = malloc(size ? 4 * size : 1);
    MUST(list != NULL);
    MUST(READ(fairmesh_result_list(reading->result, which, index, list, size, &again, &told)) == FAIRMESH_STATUS_OK && again == size);
    if (size > 1) MUST(READ(fairmesh_result_list(reading->result, which, index, list, size - 1, &again, &told)) == FAIRMESH_STATUS_BUFFER_TOO_SMALL);
    free(list);
}

/* What there is one of for each report, loop, group or bump. */
static inline void read_index(const Reading *reading, uint64_t index) {
    uint32_t which;
    fairmesh_report report;
    report.struct_size = sizeof report;
    if (READ(fairmesh_result_report(reading->result, index, &report, &told)) == FAIRMESH_STATUS_OK) {
        read_components(reading, index, report.component_count);
        read_sharp_edges(reading, index, report.sharp_edge_count);
    }
    READ(fairmesh_result_report(reading->result, index, ROOM(reading, fairmesh_report), &told));
    READ(fairmesh_result_fill_report(reading->result, index, ROOM(reading, fairmesh_fill_report), &told));
    READ(fairmesh_result_bump(reading->result, index, ROOM(reading, fairmesh_bump), &told));
    if (READ(fairmesh_result_loop(reading->result, index, ROOM(reading, fairmesh_loop), &told)) == FAIRMESH_STATUS_OK)
        MUST(index < reading->info.loop_count);
    if (READ(fairmesh_result_suggestion(reading->result, index, ROOM(reading, fairmesh_join_suggestion), &told)) == FAIRMESH_STATUS_OK)
        MUST(index < reading->info.loop_count);
    /* They are numbered in blocks of sixteen, of which the first few are there. */
    for (which = 0; which <= FAIRMESH_LIST_REGION_COUNTS + 1; which++)
        if (which % 16 < 8) read_list(reading, which, index);
}

/* Vectors or positions, in doubles or floats, with the count that is asked for and another one. */
static inline void read_vectors(const Reading *reading, uint64_t count, uint32_t scalar, uint32_t which, int are_positions) {
    uint64_t more;
    for (more = 0; more < 2; more++) {
        size_t rows = (size_t)(count + more), size = rows * 3 * (scalar == FAIRMESH_SCALAR_FLOAT32 ? 4 : 8);
        fairmesh_points_out out;
        memset(&out, 0, sizeof out);
        out.data = malloc(size ? size : 1);
        MUST(out.data != NULL);
        out.count = rows;
        out.scalar = scalar;
        READ(are_positions ? fairmesh_result_positions(reading->result, &out, &told) : fairmesh_result_vectors(reading->result, which, &out, &told));
        free(out.data);
    }
}

static inline void read_scalars(const Reading *reading, uint32_t scalar, uint32_t which) {
    size_t count = (size_t)reading->info.vertex_count;
    fairmesh_scalars_out out;
    memset(&out, 0, sizeof out);
    out.data = malloc(count ? 8 * count : 1);
    MUST(out.data != NULL);
    out.count = count;
    out.scalar = scalar;
    READ(fairmesh_result_scalars(reading->result, which, &out, &told));
    free(out.data);
}

/* Triangles name vertices that there are. */
static inline void read_triangles(const Reading *reading) {
    size_t count = (size_t)reading->info.triangle_count, k;
    fairmesh_indices_out out;
    out.data = malloc(count ? 12 * count : 1);
    MUST(out.data != NULL);
    out.count = count;
    out.stride = 0;
    if (READ(fairmesh_result_triangles(reading->result, &out, &told)) == FAIRMESH_STATUS_OK)
        for (k = 0; k < 3 * count; k++) MUST(out.data[k] < reading->info.vertex_count);
    out.count++;
    out.stride = 4;
    READ(fairmesh_result_triangles(reading->result, &out, &told));
    free(out.data);
}

/* Reads all that a result has, and asks for what it has not. */
static inline void read_all(const fairmesh_result *result, int growth) {
    Reading reading;
    size_t blocks_before = block_count;
    uint64_t k;
    uint32_t which, scalar;
    memset(&reading, 0, sizeof reading);
    reading.result = result;
    reading.growth = growth;
    reading.info.struct_size = sizeof reading.info;
    MUST(READ(fairmesh_result_info(result, &reading.info, &told)) == FAIRMESH_STATUS_OK);
    READ(fairmesh_result_info(result, ROOM(&reading, fairmesh_info), &told));
    READ(fairmesh_result_bridge(result, ROOM(&reading, fairmesh_bridge_report), &told));
    READ(fairmesh_result_crease(result, index_at(growth & 3, reading.info.crease_count), ROOM(&reading, fairmesh_crease), &told));
    for (k = 0; k < INDICES; k++) read_index(&reading, index_at(k, reading.info.loop_count));
    for (scalar = FAIRMESH_SCALAR_FLOAT32; scalar <= FAIRMESH_SCALAR_FLOAT64; scalar++) {
        read_vectors(&reading, reading.info.vertex_count, scalar, 0, 1);
        read_vectors(&reading, reading.info.boundary_vertex_count, scalar, FAIRMESH_VECTORS_BOUNDARY_NORMALS, 0);
        read_vectors(&reading, reading.info.new_vertex_count, scalar, FAIRMESH_VECTORS_PARENT_WEIGHTS, 0);
        read_vectors(&reading, 0, scalar, FAIRMESH_VECTORS_PARENT_WEIGHTS + 1, 0);
        for (which = 0; which <= FAIRMESH_SCALARS_GAUSSIAN_CURVATURE + 1; which++) read_scalars(&reading, scalar, which);
    }
    read_triangles(&reading);
    free_blocks(blocks_before);
}

#endif
