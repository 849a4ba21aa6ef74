/* Prints the positions that the library finds for one of ten inputs, in hexadecimal: `answers 3`. check.sh compares what the
 * targets print. The inputs are made by + - * / alone, which are the same everywhere; sines need not be. Compile it without
 * contraction (-ffp-contract=off). */
#include <fairmesh.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { CASES = 10, MOST = 151 * 151 };

static double positions[3 * MOST];
static float single[3 * MOST];
static uint32_t corners[6 * MOST];
static uint8_t is_free[MOST];
static size_t vertices, triangles;
static uint32_t seed;

static void stop(const char *where, int32_t status, const fairmesh_error *error) {
    fprintf(stderr, "%s: %s: %s\n", where, fairmesh_describe(FAIRMESH_ANSWER_STATUS, status, FAIRMESH_TEXT_NAME), error->message);
    exit(1);
}

/* Between -1 and 1. */
static double noise(void) {
    seed = seed * 1664525u + 1013904223u;
    return (double)(seed >> 8) / 8388608.0 - 1;
}

typedef struct {
    double reach;      /* the chart is the square between -reach and reach */
    double shaken;     /* by so many edges in the chart */
    double dent;       /* how far the free vertices are moved */
    int shape;         /* 0: the unit sphere, stereographically; 1: a saddle; 2: a bowl of the fourth degree */
    int turned;        /* triangles look down */
    size_t side, frame;
    double height;     /* of the origin */
} Sheet;

static void place(const Sheet *s, double u, double v, int dented, double *p) {
    double q = u * u + v * v, z = dented ? s->dent * (1 + 0.3 * noise()) : 0;
    if (s->shape == 0) {
        p[0] = 2 * u / (1 + q);
        p[1] = 2 * v / (1 + q);
        p[2] = (1 - q) / (1 + q) - z;
    } else {
        p[0] = u;
        p[1] = v;
        p[2] = (s->shape == 1 ? 0.4 * (u * u - v * v) + 0.1 * u * v * v : 0.3 * q + 0.1 * q * q) - z;
    }
    if (s->turned) p[2] = -p[2];
    p[2] += s->height;
}

/* Adds a square sheet, whose vertices are free where they are not in the frame; `hole`: without the triangles there. */
static void sheet(const Sheet *s, int hole) {
    size_t i, j, n = s->side, base = vertices;
    double step = 2 * s->reach / (double)(n - 1);
    for (j = 0; j < n; j++) {
        for (i = 0; i < n; i++) {
            int outer = i == 0 || j == 0 || i == n - 1 || j == n - 1;
            int inner = i >= s->frame && j >= s->frame && i + s->frame < n && j + s->frame < n;
            double u = step * (double)i - s->reach, v = step * (double)j - s->reach;
            if (!outer) {
                u += s->shaken * step * noise();
                v += s->shaken * step * noise();
            }
            is_free[vertices] = (uint8_t)(inner && !hole);
            place(s, u, v, inner && !hole, positions + 3 * vertices);
            vertices++;
        }
    }
    for (j = 0; j + 1 < n; j++) {
        for (i = 0; i + 1 < n; i++) {
            uint32_t a = (uint32_t)(base + n * j + i), b = a + 1, c = b + (uint32_t)n, d = a + (uint32_t)n, *t = corners + 3 * triangles;
            if (hole && i >= s->frame && j >= s->frame && i + 1 + s->frame < n && j + 1 + s->frame < n) continue;
            t[0] = t[3] = a;
            t[1] = s->turned ? c : b;
            t[2] = s->turned ? b : c;
            t[4] = s->turned ? d : c;
            t[5] = s->turned ? c : d;
            triangles += 2;
        }
    }
}

static fairmesh_mesh whole(void) {
    fairmesh_mesh mesh;
    memset(&mesh, 0, sizeof mesh);
    mesh.struct_size = sizeof mesh;
    mesh.positions.data = positions;
    mesh.positions.count = vertices;
    mesh.positions.scalar = FAIRMESH_SCALAR_FLOAT64;
    mesh.triangles.data = corners;
    mesh.triangles.count = triangles;
    return mesh;
}

static void print_bits(const double *values, size_t count) {
    size_t k;
    for (k = 0; k < count; k++) {
        uint64_t bits;
        memcpy(&bits, values + k, 8);
        printf("%08lx%08lx%c", (unsigned long)(bits >> 32), (unsigned long)(bits & 0xffffffffu), k % 3 == 2 ? '\n' : ' ');
    }
}

static void fair(const fairmesh_options *options, int in_single) {
    fairmesh_mesh mesh = whole();
    fairmesh_selection selection;
    fairmesh_points_out out;
    fairmesh_report report;
    fairmesh_error error;
    int32_t status;
    size_t k;
    memset(&selection, 0, sizeof selection);
    memset(&out, 0, sizeof out);
    selection.struct_size = sizeof selection;
    selection.kind = FAIRMESH_SELECTION_KIND_FREE_MASK;
    selection.data = is_free;
    selection.count = vertices;
    out.data = positions;
    out.count = vertices;
    out.scalar = FAIRMESH_SCALAR_FLOAT64;
    if (in_single) {
        for (k = 0; k < 3 * vertices; k++) single[k] = (float)positions[k];
        out.data = single;
        mesh.positions.data = single;
        out.scalar = mesh.positions.scalar = FAIRMESH_SCALAR_FLOAT32;
    }
    report.struct_size = sizeof report;
    status = fairmesh_fair(&mesh, &selection, options, &out, &report, NULL, &error);
    if (status) stop("fair", status, &error);
    if (in_single) {
        for (k = 0; k < 3 * vertices; k++) positions[k] = single[k];
    }
    printf("%s, %u iterations\n", fairmesh_describe(FAIRMESH_ANSWER_OUTCOME, report.outcome, FAIRMESH_TEXT_NAME), (unsigned)report.iterations);
    print_bits(positions, 3 * vertices);
}

static void fill(const fairmesh_options *options, int join) {
    fairmesh_mesh mesh = whole();
    fairmesh_fill_options filling;
    fairmesh_result *result = NULL;
    fairmesh_info info;
    fairmesh_points_out out;
    fairmesh_error error;
    int32_t status;
    fairmesh_fill_options_init(&filling, sizeof filling);
    if (join) filling.join.kind = FAIRMESH_JOIN_KIND_AUTO;
    status = fairmesh_fill_holes(&mesh, &filling, options, &result, &error);
    if (status) stop("fill", status, &error);
    info.struct_size = sizeof info;
    status = fairmesh_result_info(result, &info, &error);
    if (status || info.vertex_count > MOST) stop("info", status, &error);
    memset(&out, 0, sizeof out);
    out.data = positions;
    out.count = (size_t)info.vertex_count;
    out.scalar = FAIRMESH_SCALAR_FLOAT64;
    status = fairmesh_result_positions(result, &out, &error);
    if (status) stop("positions", status, &error);
    printf("%u new vertices\n", (unsigned)(out.count - vertices));
    print_bits(positions, 3 * out.count);
    fairmesh_result_free(result);
}

int main(int count, char **arguments) {
    /*                      reach shaken dent shape turned side frame height */
    const Sheet sheets[] = {{0.4, 0.0, 0.10, 0, 0, 25, 6, 0},  {0.4, 0.2, 0.10, 0, 0, 151, 10, 0}, {0.5, 0.3, 0.10, 0, 0, 41, 6, 0},
                            {1.0, 0.2, 0.20, 1, 0, 33, 6, 0},  {0.6, 0.1, 0.10, 2, 0, 37, 10, 0},   {0.4, 0.1, 0.05, 0, 0, 33, 7, 1000},
                            {0.4, 0.1, 0.05, 0, 0, 21, 5, 0},  {0.5, 0.0, 0.00, 0, 0, 25, 9, 0},    {1.0, 0.3, 0.00, 1, 0, 33, 11, 0},
                            {0.3, 0.05, 0.0, 0, 0, 21, 8, -0.2}};
    int which = count > 1 ? atoi(arguments[1]) : 0;
    fairmesh_options options;
    Sheet s;
    if (which < 1 || which > CASES) {
        fprintf(stderr, "usage: answers 1...%d\n", CASES);
        return 2;
    }
    s = sheets[which - 1];
    seed = (uint32_t)which;
    fairmesh_options_init(&options, sizeof options);
    sheet(&s, which > 7);
    if (which == 4) options.inner_fairness = FAIRMESH_INNER_FAIRNESS_CONFORMAL;
    if (which == 5) options.continuity = 1;
    if (which == 7) options.discretization = FAIRMESH_DISCRETIZATION_PAPER;
    if (which == 10) {
        /* A second one below it, face to face with a hole each: a tube is made between them. */
        Sheet below = s;
        below.turned = 1;
        below.height = 0.2 - 0.5;
        s.height = 0.2;
        sheet(&below, 1);
    }
    if (which <= 7) fair(&options, which == 6);
    else fill(&options, which == 10);
    return 0;
}
