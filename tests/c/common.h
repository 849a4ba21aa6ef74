/* What the C tests share: a mesh whose answer is known, and checks. Valid C99 and C++17. */
#ifndef COMMON_H
#define COMMON_H

#include <fairmesh.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#if defined(__GNUC__)
#define COMMON_MAY_STAY_UNUSED __attribute__((unused))
#else
#define COMMON_MAY_STAY_UNUSED
#endif

#define CHECK(condition)                                                                    \
    do {                                                                                    \
        if (!(condition)) {                                                                 \
            fprintf(stderr, "%s:%d: failed: %s\n", __FILE__, __LINE__, #condition);         \
            exit(1);                                                                        \
        }                                                                                   \
    } while (0)

#define OK(call)                                                                            \
    do {                                                                                    \
        int32_t status_ = (int32_t)(call);                                                  \
        if (status_ != FAIRMESH_STATUS_OK) {                                                \
            fprintf(stderr, "%s:%d: %s: %s\n", __FILE__, __LINE__, #call,                   \
                    fairmesh_describe(FAIRMESH_ANSWER_STATUS, status_, FAIRMESH_TEXT_NAME));        \
            exit(1);                                                                        \
        }                                                                                   \
    } while (0)

/* Declares a struct that is all zero, and one that begins with its size, too. */
#define ZERO(type, name)                                                                    \
    type name;                                                                              \
    memset(&name, 0, sizeof name)
#define SIZED(type, name)                                                                   \
    ZERO(type, name);                                                                       \
    name.struct_size = sizeof name

/* A grid on the unit sphere, side * side vertices; the middle, which is free, is dented. */
typedef struct {
    size_t side, vertices, triangles;
    double *positions;
    uint32_t *corners;
    uint8_t *free_mask;
    fairmesh_mesh mesh;
    fairmesh_selection selection;
} Cap;

static void *must(void *block) {
    CHECK(block != NULL);
    return block;
}

/* Whether a vertex is in the dent; a few rows around it stay. */
static int cap_is_free(size_t side, size_t v) {
    size_t i = v % side, j = v / side, frame = side / 4;
    return i > frame && i + frame + 1 < side && j > frame && j + frame + 1 < side;
}

/* Views of arrays of doubles. */
#define VIEW(name, type, pointer)                                                           \
    COMMON_MAY_STAY_UNUSED static type name(pointer data, size_t count) {                   \
        ZERO(type, view);                                                                   \
        view.data = data;                                                                   \
        view.count = count;                                                                 \
        view.scalar = FAIRMESH_SCALAR_FLOAT64;                                              \
        return view;                                                                        \
    }
VIEW(points_of, fairmesh_points, const double *)
VIEW(points_out_of, fairmesh_points_out, double *)
VIEW(numbers_of, fairmesh_numbers, const double *)
VIEW(scalars_out_of, fairmesh_scalars_out, double *)

COMMON_MAY_STAY_UNUSED static fairmesh_indices indices_of(const uint32_t *data, size_t count) {
    ZERO(fairmesh_indices, view);
    view.data = data;
    view.count = count;
    return view;
}

COMMON_MAY_STAY_UNUSED static fairmesh_mesh mesh_of(const double *positions, size_t vertices, const uint32_t *corners, size_t triangles) {
    SIZED(fairmesh_mesh, mesh);
    mesh.positions = points_of(positions, vertices);
    mesh.triangles = indices_of(corners, triangles);
    return mesh;
}

/* The unit sphere without a band around its equator: two caps of rows of vertices around the poles. */
enum { BALL_ROUND = 24, BALL_ROWS = 5, BALL_CAP = 1 + BALL_ROUND * BALL_ROWS, BALL_VERTICES = 2 * BALL_CAP };
enum { BALL_CAP_TRIANGLES = BALL_ROUND * (2 * BALL_ROWS - 1), BALL_TRIANGLES = 2 * BALL_CAP_TRIANGLES };
typedef struct {
    double positions[3 * BALL_VERTICES];
    uint32_t corners[3 * BALL_TRIANGLES];
    fairmesh_mesh mesh;
} Ball;

COMMON_MAY_STAY_UNUSED static void ball_make(Ball *ball) {
    const double degree = 3.14159265358979323846 / 180;
    uint32_t *t = ball->corners;
    int side, i, j;
    for (side = 0; side < 2; side++) {
        uint32_t pole = (uint32_t)(side * BALL_CAP), flip = (uint32_t)side;
        double *p = ball->positions + 3 * pole;
        p[0] = p[1] = 0;
        p[2] = side ? -1 : 1;
        for (i = 0; i < BALL_ROWS; i++) {
            for (j = 0; j < BALL_ROUND; j++) {
                double tilt = 14 * (i + 1) * degree, turn = (15 * (j + 0.5 * i) + 4 * side) * degree;
                uint32_t v = pole + 1 + (uint32_t)(BALL_ROUND * i + j), w = pole + 1 + (uint32_t)(BALL_ROUND * i + (j + 1) % BALL_ROUND);
                p = ball->positions + 3 * v;
                p[0] = sin(tilt) * cos(turn);
                p[1] = sin(tilt) * sin(turn);
                p[2] = (side ? -1 : 1) * cos(tilt);
                if (i == 0) {
                    t[0] = pole;
                    t[1 + flip] = v;
                    t[2 - flip] = w;
                    t += 3;
                }
                if (i + 1 < BALL_ROWS) {
                    t[0] = v;
                    t[1 + flip] = v + BALL_ROUND;
                    t[2 - flip] = w;
                    t[3] = w;
                    t[4 + flip] = v + BALL_ROUND;
                    t[5 - flip] = w + BALL_ROUND;
                    t += 6;
                }
            }
        }
    }
    ball->mesh = mesh_of(ball->positions, BALL_VERTICES, ball->corners, BALL_TRIANGLES);
}

static Cap cap_new(size_t side) {
    Cap cap;
    size_t v, i, j, t = 0;
    memset(&cap, 0, sizeof cap);
    cap.side = side;
    cap.vertices = side * side;
    cap.triangles = 2 * (side - 1) * (side - 1);
    cap.positions = (double *)must(malloc(3 * cap.vertices * sizeof(double)));
    cap.corners = (uint32_t *)must(malloc(3 * cap.triangles * sizeof(uint32_t)));
    cap.free_mask = (uint8_t *)must(malloc(cap.vertices));
    for (v = 0; v < cap.vertices; v++) {
        double x = 0.8 * (double)(v % side) / (double)(side - 1) - 0.4;
        double y = 0.8 * (double)(v / side) / (double)(side - 1) - 0.4;
        double z = sqrt(1.0 - x * x - y * y), dent = 1.0;
        cap.free_mask[v] = (uint8_t)cap_is_free(side, v);
        if (cap.free_mask[v]) dent = 0.9 + 0.004 * (double)(v % 7);
        cap.positions[3 * v] = x * dent;
        cap.positions[3 * v + 1] = y * dent;
        cap.positions[3 * v + 2] = z * dent;
    }
    for (j = 0; j + 1 < side; j++) {
        for (i = 0; i + 1 < side; i++) {
            uint32_t a = (uint32_t)(j * side + i), s = (uint32_t)side;
            uint32_t quad[6] = {a, a + 1, a + s + 1, a, a + s + 1, a + s};
            memcpy(cap.corners + 3 * t, quad, sizeof quad);
            t += 2;
        }
    }
    cap.mesh = mesh_of(cap.positions, cap.vertices, cap.corners, cap.triangles);
    cap.selection.struct_size = sizeof cap.selection;
    cap.selection.kind = FAIRMESH_SELECTION_KIND_FREE_MASK;
    cap.selection.data = cap.free_mask;
    cap.selection.count = cap.vertices;
    return cap;
}

static void cap_free(Cap *cap) {
    free(cap->positions);
    free(cap->corners);
    free(cap->free_mask);
}

/* A roof of the same vertices and triangles instead, whose ridge is flattened where they are free. */
COMMON_MAY_STAY_UNUSED static void cap_as_roof(Cap *cap) {
    size_t v;
    for (v = 0; v < cap->vertices; v++) {
        double middle = (double)(cap->side - 1) / 2, *p = cap->positions + 3 * v;
        p[0] = (double)(v % cap->side) - middle;
        p[1] = (double)(v / cap->side) - middle;
        p[2] = cap->free_mask[v] ? -middle / 2 : -fabs(p[1]);
    }
}

/* The largest distance from the unit sphere. */
COMMON_MAY_STAY_UNUSED static double off_sphere(const double *positions, size_t vertices) {
    double worst = 0.0;
    size_t v;
    for (v = 0; v < vertices; v++) {
        const double *p = positions + 3 * v;
        double off = fabs(sqrt(p[0] * p[0] + p[1] * p[1] + p[2] * p[2]) - 1.0);
        if (!(off <= worst)) worst = off;
    }
    return worst;
}

#endif
