/* libFuzzer: small meshes that are nearly right, with options that are nearly right. A byte stream says what is done to them. */
#include <fairmesh.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

typedef struct {
    const uint8_t *data;
    size_t size;
} Bytes;

static uint8_t next(Bytes *bytes) {
    if (bytes->size == 0) return 0;
    bytes->size--;
    return *bytes->data++;
}

static double unit(Bytes *bytes) { return (next(bytes) - 128) / 128.0; }

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
    Bytes bytes = {data, size};
    enum { MOST = 9 };
    double positions[MOST * MOST][3], before[MOST * MOST][3], out[MOST * MOST][3];
    uint32_t triangles[2 * MOST * MOST][3];
    uint8_t mask[MOST * MOST];
    size_t side = 3 + next(&bytes) % (MOST - 2), vertices = side * side, count = 0, v, edits;
    double bend = unit(&bytes), bump = unit(&bytes);
    fairmesh_options options;
    fairmesh_fill_options fill;
    fairmesh_mesh mesh;
    fairmesh_selection selection;
    fairmesh_points_out to;
    fairmesh_report report;
    fairmesh_error error;
    fairmesh_result *result = NULL;
    fairmesh_status status;
    uint32_t on_loop;
    double how_far;
    uint8_t what;
    memset(&mesh, 0, sizeof mesh);
    memset(&selection, 0, sizeof selection);
    memset(&to, 0, sizeof to);
    for (v = 0; v < vertices; v++) {
        double x = (double)(v % side) / (double)(side - 1) - 0.5, y = (double)(v / side) / (double)(side - 1) - 0.5;
        positions[v][0] = x;
        positions[v][1] = y;
        positions[v][2] = bend * (x * x + y * y) + bump * 0.1 * (double)(v * 7 % 5);
        mask[v] = v % side > 0 && v % side + 1 < side && v / side > 0 && v / side + 1 < side;
        if (v % side + 1 < side && v / side + 1 < side) {
            uint32_t a = (uint32_t)v, s = (uint32_t)side;
            uint32_t quad[2][3] = {{a, a + 1, a + s + 1}, {a, a + s + 1, a + s}};
            memcpy(triangles[count], quad, sizeof quad);
            count += 2;
        }
    }
    for (edits = next(&bytes) % 24; edits > 0; edits--) {
        size_t at = next(&bytes);
        switch (next(&bytes) % 8) {
        case 0: triangles[at % count][next(&bytes) % 3] = (uint32_t)(next(&bytes) % (vertices + 2)); break;
        case 1: memcpy(triangles[at % count], triangles[next(&bytes) % count], 12); break;
        case 2: positions[at % vertices][next(&bytes) % 3] += unit(&bytes); break;
        case 3: memcpy(positions[at % vertices], positions[next(&bytes) % vertices], 24); break;
        case 4: positions[at % vertices][next(&bytes) % 3] = at % 2 ? NAN : 1e300 * unit(&bytes); break;
        case 5: mask[at % vertices] ^= 1; break;
        case 6: count = count > 2 ? count - 1 : count; break;
        default: positions[at % vertices][next(&bytes) % 3] *= 1e-200; break;
        }
    }
    memcpy(before, positions, sizeof before);
    fairmesh_options_init(&options, sizeof options);
    options.threads = 1;
    options.tolerance = 1e-4;
    what = next(&bytes);
    options.max_iterations = 1u + what % 16u;
    options.inner_fairness = what / 16u % 4u;
    options.discretization = what / 64u % 2u;
    what = next(&bytes);
    options.target.kind = what % 4u;
    options.target.constant = 20.0 * unit(&bytes);
    options.boundary_normals.kind = what / 4u % 2u;
    options.interior_normals = what / 8u % 2u;
    options.continuity = what / 16u % 2u;
    if (what & 128) {
        on_loop = (uint32_t)(next(&bytes) % (vertices + 1));
        how_far = 0.5 + 0.5 * unit(&bytes);
        options.loop_continuity.values.data = &how_far;
        options.loop_continuity.values.count = 1;
        options.loop_continuity.values.scalar = FAIRMESH_SCALAR_FLOAT64;
        options.loop_continuity.vertices.data = &on_loop;
        options.loop_continuity.vertices.count = 1;
    }
    mesh.struct_size = sizeof mesh;
    mesh.positions.data = positions;
    mesh.positions.count = vertices;
    mesh.positions.scalar = FAIRMESH_SCALAR_FLOAT64;
    mesh.triangles.data = triangles[0];
    mesh.triangles.count = count;
    selection.struct_size = sizeof selection;
    selection.kind = FAIRMESH_SELECTION_KIND_FREE_MASK;
    selection.data = mask;
    selection.count = vertices;
    to.data = out;
    to.count = vertices;
    to.scalar = FAIRMESH_SCALAR_FLOAT64;
    report.struct_size = sizeof report;
    if (what & 64) {
        fairmesh_fill_options_init(&fill, sizeof fill);
        fill.max_new_vertices = 200;
        status = fairmesh_fill_holes(&mesh, &fill, &options, &result, &error);
    } else {
        status = fairmesh_fair(&mesh, what & 32 ? NULL : &selection, &options, &to, &report, &result, &error);
    }
    if (status == FAIRMESH_STATUS_INTERNAL || error.status != (int32_t)status) abort();
    if (memcmp(before, positions, sizeof(double) * 3 * vertices) != 0) abort();
    if (fairmesh_result_free(result) != FAIRMESH_STATUS_OK) abort();
    return 0;
}
