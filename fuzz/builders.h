/* What the structured target makes of bytes: options, lists, steps and edits that are nearly right. A byte 0 is what is usual. */
#ifndef BUILDERS_H
#define BUILDERS_H

#include "given.h"

#include <float.h>

/* Between -1 and 1. */
static inline double unit(Bytes *bytes) { return (int8_t)next(bytes) / 128.0; }

/* Between two bounds, seldom at them, beyond them, or no number at all. */
static inline double between(Bytes *bytes, double low, double high) {
    const double odd[16] = {NAN,   INFINITY, -INFINITY, 0.0,     -0.0, -1.0, 5e-324,      1e-200,
                            1e-15, 1e300,    -1e300,    DBL_MAX, low,  high, 0.999 * low, 1.001 * high};
    uint8_t what = next(bytes);
    return what < 240 ? low + (high - low) * what / 239.0 : odd[what - 240];
}

/* The same by equal factors. */
static inline double factor(Bytes *bytes, double low, double high) {
    double power = between(bytes, 0.0, 1.0);
    return power >= 0.0 && power <= 1.0 ? low * pow(high / low, power) : power;
}

/* One of so many, seldom one more. */
static inline uint32_t one_of(Bytes *bytes, uint32_t count) {
    uint8_t what = next(bytes);
    return what < 250 ? what % count : count + what - 250u;
}

/* Small, seldom large, and the largest that there is. */
static inline uint64_t amount(Bytes *bytes, uint64_t large) {
    uint8_t what = next(bytes);
    return what < 200 ? what : what < 250 ? large * (what - 199u) / 50u : what < 255 ? what - 250u : UINT64_MAX;
}

/* The size of a struct: seldom larger or smaller than it is. */
static inline uint32_t size_like(Bytes *bytes, size_t known) {
    uint8_t what = next(bytes);
    return what < 200 ? (uint32_t)known : what < 250 ? (uint32_t)known + 8u * (what - 225u) : what * 16777u;
}

/* Indices, few of them wrong, with gaps or without, in memory of their own. */
static inline fairmesh_indices list(Bytes *bytes, uint32_t below, size_t most, size_t width) {
    fairmesh_indices made;
    size_t gap = next(bytes), count = next(bytes) % (most + 1), k, i;
    uint32_t *data;
    made.stride = gap % 8u == 7 ? 4 * (width + gap / 64u) : 0;
    gap = made.stride ? made.stride / 4 : width;
    data = block(count ? 4 * ((count - 1) * gap + width) : 0);
    for (k = 0; k < count; k++)
        for (i = 0; i < width; i++) data[k * gap + i] = one_of(bytes, below > 0 ? below : 1);
    made.data = data;
    made.count = count;
    return made;
}

/* Numbers or points of doubles as they are asked for: floats or doubles, with gaps or without. */
typedef struct {
    void *data;
    size_t count, stride;
    uint32_t scalar;
} View;

static inline View view_of(Bytes *bytes, const double *rows, size_t count, size_t width) {
    View view;
    uint8_t how = next(bytes);
    size_t size = how & 1 ? 4 : 8, stride = size * (width + how / 2u % 4u), k, i;
    view.scalar = how & 1 ? FAIRMESH_SCALAR_FLOAT32 : FAIRMESH_SCALAR_FLOAT64;
    view.count = count;
    view.stride = how / 2u % 4u ? stride : 0;
    view.data = block(count ? (count - 1) * stride + size * width : 0);
    for (k = 0; k < count; k++)
        for (i = 0; i < width; i++) {
            uint8_t *to = (uint8_t *)view.data + k * stride + i * size;
            float single = (float)rows[k * width + i];
            memcpy(to, size == 4 ? (const void *)&single : (const void *)&rows[k * width + i], size);
        }
    return view;
}

#define SEE(to, view) ((to).data = (view).data, (to).count = (view).count, (to).stride = (view).stride, (to).scalar = (view).scalar)

/* Vectors of about unit length, for the vertices of a list or for all. */
static inline void give_normals(Bytes *bytes, fairmesh_boundary_normals *normals, uint32_t vertices) {
    enum { MOST = 1024 };
    double rows[MOST][3];
    size_t count, k;
    uint8_t how = next(bytes);
    View view;
    normals->kind = one_of(bytes, 3);
    if (how & 1) normals->vertices = list(bytes, vertices, 12, 1);
    count = how & 1 ? normals->vertices.count : vertices < MOST ? vertices : MOST;
    for (k = 0; k < count; k++) {
        double x = how & 2 ? 0.7 * unit(bytes) : 0.0, y = how & 2 ? 0.7 * unit(bytes) : 0.0;
        rows[k][0] = x;
        rows[k][1] = y;
        rows[k][2] = (how & 4 ? -1.0 : 1.0) * sqrt(fmax(1.0 - x * x - y * y, 0.0));
    }
    view = view_of(bytes, rows[0], count, 3);
    SEE(normals->vectors, view);
}

/* One number for each vertex of a list. */
static inline void give_numbers(Bytes *bytes, fairmesh_numbers *values, fairmesh_indices *at, uint32_t vertices, double low, double high) {
    double rows[12];
    size_t k;
    View view;
    *at = list(bytes, vertices, 12, 1);
    for (k = 0; k < at->count; k++) rows[k] = between(bytes, low, high);
    view = view_of(bytes, rows, at->count, 1);
    SEE(*values, view);
}

static inline void give_options(Bytes *bytes, fairmesh_options *options, uint32_t vertices) {
    uint32_t what = next_two(bytes);
    options->threads = 1;
    options->tolerance = 1e-4;
    options->max_iterations = 16;
    if (what & 1) options->struct_size = size_like(bytes, sizeof *options);
    if (what & 2) options->interior_normals = one_of(bytes, 2);
    if (what & 4) options->inner_fairness = one_of(bytes, 3);
    if (what & 8) options->discretization = one_of(bytes, 2);
    if (what & 16) options->output_precision = one_of(bytes, 2);
    if (what & 32) options->threads = next(bytes);
    if (what & 64) options->threads = 2;
    if (what & 128) options->intersections = one_of(bytes, 2);
    if (what & 256) give_normals(bytes, &options->boundary_normals, vertices);
    if (what & 512) options->continuity = between(bytes, 0.0, 1.0);
    if (what & 1024) give_numbers(bytes, &options->loop_continuity.values, &options->loop_continuity.vertices, vertices, 0.0, 1.0);
    if (what & 2048) {
        options->boundary_curvature.kind = one_of(bytes, 2);
        give_numbers(bytes, &options->boundary_curvature.values, &options->boundary_curvature.vertices, vertices, -4.0, 4.0);
    }
    if (what & 4096) options->target.kind = one_of(bytes, 3), options->target.constant = between(bytes, -20.0, 20.0);
    if (what & 8192) options->tolerance = factor(bytes, 1e-15, 1.0);
    if (what & 16384) options->max_iterations = amount(bytes, 500);
    if (what & 32768) {
        uint32_t which = next(bytes);
        options->reserved = options->target.reserved = which == 255;
        if (which & 1) options->sharp = between(bytes, 0.0, 180.0);
        if (which & 2) options->marked_edges = list(bytes, vertices, 6, 2);
    }
}

static inline void give_filter(Bytes *bytes, fairmesh_loop_filter *filter) {
    size_t i;
    filter->max_length = between(bytes, 0.0, 6.0);
    filter->max_area = between(bytes, 0.0, 1.0);
    filter->max_diagonal = between(bytes, 0.0, 2.0);
    filter->except_longest = amount(bytes, 5);
    filter->components = list(bytes, 3, 3, 1);
    filter->within.kind = one_of(bytes, 3);
    filter->within.radius = between(bytes, 0.0, 1.0);
    for (i = 0; i < 3; i++) {
        filter->within.centre[i] = unit(bytes);
        filter->within.low[i] = between(bytes, -1.0, 0.0);
        filter->within.high[i] = between(bytes, 0.0, 1.0);
    }
}

static inline void give_fill(Bytes *bytes, fairmesh_fill_options *fill, uint32_t vertices) {
    uint32_t what = next_two(bytes);
    fill->max_new_vertices = 200;
    if (what & 1) fill->struct_size = size_like(bytes, sizeof *fill);
    if (what & 2) fill->on_failure = one_of(bytes, 3);
    if (what & 4) fill->fair = next(bytes) % 3u;
    if (what & 8) fill->only_listed = 1;
    if (what & 16) {
        fill->join.kind = one_of(bytes, 3);
        fill->join.loops = list(bytes, 4, 5, 1);
        fill->join.starts = list(bytes, 3, 3, 1);
    }
    if (what & 32) fill->guides = list(bytes, vertices, 4, 2);
    if (what & 64) fill->density = factor(bytes, 0.1, 10.0);
    if (what & 128) fill->max_new_vertices = amount(bytes, 2000);
    if (what & 256 && next(bytes) % 8u == 7) fill->max_new_vertices = 20000;
    if (what & 512) fill->relax_rim = amount(bytes, 1000000), fill->relax_within = between(bytes, 0.0, 1.0);
    if (what & 1024) fill->max_edges = amount(bytes, 100);
    if (what & 2048) fill->loops = list(bytes, 4, 4, 1);
    if (what & 4096) give_filter(bytes, &fill->filter);
    if (what & 8192) fill->join.reserved = next(bytes) == 255;
    if (fill->max_new_vertices > 20000 && !(fill->density < 2.0)) fill->max_new_vertices = 20000;
}

static inline void give_bridge(Bytes *bytes, fairmesh_bridge_options *bridge) {
    uint8_t what = next(bytes);
    if (what & 1) bridge->struct_size = size_like(bytes, sizeof *bridge);
    if (what & 2) bridge->fill = next(bytes) % 3u;
    if (what & 4) bridge->width = between(bytes, 0.0, 4.0);
}

/* Blends much smaller than the mesh take long. */
static inline double size_of_blend(double size) {
    return size > 0.0 && size < 0.05 ? 0.05 : size;
}

/* One of a few labels for each triangle; at times one too many. */
static inline fairmesh_indices labels_of(Bytes *bytes, size_t triangles) {
    fairmesh_indices labels;
    uint8_t what = next(bytes);
    uint32_t *numbers = block(4 * (triangles + 1));
    size_t k;
    for (k = 0; k <= triangles; k++) numbers[k] = (uint32_t)(k / (1u + what % 8u) % 3u);
    memset(&labels, 0, sizeof labels);
    labels.data = numbers;
    labels.count = triangles + (what >= 250);
    return labels;
}

static inline void give_round(Bytes *bytes, fairmesh_round_options *round, uint32_t vertices, size_t triangles) {
    uint8_t what = next(bytes);
    round->width = 0.25;
    round->max_blend_vertices = 2000;
    if (what & 1) round->struct_size = size_like(bytes, sizeof *round);
    if (what & 2) round->width = size_of_blend(between(bytes, 0.0, 4.0));
    if (what & 4) round->radius = size_of_blend(between(bytes, 0.0, 4.0));
    if (what & 8) round->angle = between(bytes, 0.0, 180.0);
    if (what & 16) round->creases = next(bytes) % 4u;
    if (what & 32) round->edges = list(bytes, vertices, 4, 2);
    if (what & 64) round->labels = labels_of(bytes, triangles);
}

static inline void give_remesh(Bytes *bytes, fairmesh_remesh_options *remesh) {
    uint8_t what = next(bytes);
    remesh->max_vertices = 500;
    if (what & 1) remesh->struct_size = size_like(bytes, sizeof *remesh);
    if (what & 2) remesh->density = factor(bytes, 0.1, 10.0);
    if (what & 4) remesh->max_vertices = amount(bytes, 20000);
    if (what & 8) remesh->reserved = next(bytes) == 255;
    if (remesh->max_vertices > 20000 && !(remesh->density < 2.0)) remesh->max_vertices = 20000;
}

static inline void give_step(Bytes *bytes, fairmesh_region_step *step, uint32_t elements) {
    uint8_t what = next(bytes);
    size_t i;
    /* Those that name triangles, then those that change them, from GROW on. */
    step->kind = what % 16u <= 10u ? what % 16u : FAIRMESH_REGION_KIND_GROW + what % 16u - 11u;
    step->combine = what / 16u % 4u;
    step->seed_kind = one_of(bytes, 2);
    step->seed_vertex = one_of(bytes, elements);
    for (i = 0; i < 3; i++) step->point[i] = unit(bytes);
    for (i = 0; i < 3; i++) step->vector[i] = unit(bytes);
    step->value = what & 64 ? between(bytes, 0.0, 180.0) : between(bytes, 0.0, 1.0);
    step->rings = amount(bytes, 100000);
    step->list = list(bytes, elements, 12, 1);
    step->reserved = what == 255;
}

static inline void give_edit(Bytes *bytes, fairmesh_edit *edit, uint32_t vertices) {
    size_t i;
    edit->kind = one_of(bytes, 5);
    edit->vertex = one_of(bytes, vertices);
    edit->amount = between(bytes, -1.0, 1.0);
    edit->falloff = between(bytes, 0.0, 1.0);
    edit->vertices = list(bytes, vertices, 12, 1);
    for (i = 0; i < 3; i++) edit->rotation[i] = 2.0 * unit(bytes);
    for (i = 0; i < 3; i++) edit->centre[i] = unit(bytes);
    for (i = 0; i < 3; i++) edit->translation[i] = 0.3 * unit(bytes);
}

static inline void give_limit(Bytes *bytes, fairmesh_budget *limit) {
    uint8_t what = next(bytes);
    limit->evaluations = 1u + what % 16u;
    if (what & 16) limit->struct_size = size_like(bytes, sizeof *limit);
    if (what & 32) limit->evaluations = amount(bytes, 100);
    if (what & 64) limit->seconds = between(bytes, 0.0, 0.1);
    if (what & 128) limit->tolerance = factor(bytes, 1e-12, 1.0);
}

#endif
