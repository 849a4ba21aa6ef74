/* A dent in a bowl is faired: the vertices in it move until the surface continues the bowl around it. */
#include <fairmesh.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

enum { SIDE = 21, VERTICES = SIDE * SIDE, TRIANGLES = 2 * (SIDE - 1) * (SIDE - 1) };

static double positions[VERTICES][3];
static uint32_t triangles[TRIANGLES][3];
static uint8_t may_move[VERTICES];

/* A grid over the bowl z = (x^2 + y^2) / 2, with a dent in the middle. */
static void make_bowl(void) {
    uint32_t v = 0, t = 0;
    for (uint32_t j = 0; j < SIDE; j++) {
        for (uint32_t i = 0; i < SIDE; i++, v++) {
            double x = i / 10.0 - 1.0, y = j / 10.0 - 1.0;
            may_move[v] = fabs(x) < 0.55 && fabs(y) < 0.55;
            positions[v][0] = x;
            positions[v][1] = y;
            positions[v][2] = 0.5 * (x * x + y * y) - (may_move[v] ? 0.2 : 0.0);
            if (i + 1 < SIDE && j + 1 < SIDE) {
                uint32_t quad[2][3] = {{v, v + 1, v + SIDE + 1}, {v, v + SIDE + 1, v + SIDE}};
                memcpy(triangles[t], quad, sizeof quad);
                t += 2;
            }
        }
    }
}

static int32_t show(const fairmesh_progress *progress, void *user_data) {
    (void)user_data;
    printf("%3.0f %%  %s\n", 100.0 * progress->fraction, progress->phase);
    return 0; /* anything else would stop the run */
}

int main(void) {
    make_bowl();

    fairmesh_mesh mesh = {0};
    mesh.struct_size = sizeof mesh;
    mesh.positions.data = positions;
    mesh.positions.count = VERTICES;
    mesh.positions.scalar = FAIRMESH_SCALAR_FLOAT64;
    mesh.triangles.data = triangles[0];
    mesh.triangles.count = TRIANGLES;

    fairmesh_selection selection = {0};
    selection.struct_size = sizeof selection;
    selection.kind = FAIRMESH_SELECTION_KIND_FREE_MASK;
    selection.data = may_move;
    selection.count = VERTICES;

    fairmesh_options options;
    fairmesh_options_init(&options, sizeof options);
    options.tolerance = 1e-6;
    options.progress = show;

    /* The result goes over the input. */
    fairmesh_points_out out = {0};
    out.data = positions;
    out.count = VERTICES;
    out.scalar = FAIRMESH_SCALAR_FLOAT64;

    fairmesh_report report;
    report.struct_size = sizeof report;
    fairmesh_error error;
    fairmesh_status status = fairmesh_fair(&mesh, &selection, &options, &out, &report, NULL, &error);
    if (status != FAIRMESH_STATUS_OK) {
        fprintf(stderr, "%s: %s\n", fairmesh_describe(FAIRMESH_ANSWER_STATUS, status, FAIRMESH_TEXT_NAME), error.message);
        return 1;
    }
    printf("%s after %u iterations; the middle is at z = %.4f\n", fairmesh_describe(FAIRMESH_ANSWER_OUTCOME, report.outcome, FAIRMESH_TEXT_NAME),
           (unsigned)report.iterations, positions[VERTICES / 2][2]);
    return report.outcome == FAIRMESH_OUTCOME_CONVERGED ? 0 : 2;
}
