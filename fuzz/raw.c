/* libFuzzer: the bytes are the arrays and the numbers in the structs. Only what the contract asks for is kept: arrays lie
 * within their memory. */
#include <fairmesh.h>
#include <stdlib.h>
#include <string.h>

/* What concerns holes, with lists that are the bytes of the head and of the mask. */
static fairmesh_status holes(const uint8_t *head, const uint8_t *bytes, const fairmesh_mesh *mesh, const fairmesh_selection *selection,
                             const fairmesh_options *options, fairmesh_result **result, fairmesh_error *error) {
    fairmesh_fill_options fill;
    fairmesh_bridge_options how;
    fairmesh_indices list;
    double number;
    uint64_t most;
    memcpy(&number, head + 48, 8);
    memcpy(&most, head + 56, 8);
    list.data = (const uint32_t *)(const void *)(bytes + (head[25] & 1 ? head[26] % 8 : 0));
    list.stride = head[27] % 16;
    list.count = head[28] % 40;
    fairmesh_fill_options_init(&fill, sizeof fill);
    fill.max_new_vertices = 100;
    fill.fair = head[29] & 1;
    fill.on_failure = head[29] / 2u % 4u;
    if (head[30] & 1) fill.loops = list;
    if (head[30] & 2) fill.join.loops = list;
    if (head[30] & 4) fill.join.starts = list;
    if (head[30] & 8) fill.guides = list, fill.guides.count = list.count / 2;
    if (head[30] & 16) fill.filter.components = list;
    if (head[30] & 32) fill.relax_rim = most, fill.relax_within = number;
    if (head[30] & 64) fill.density = number;
    if (head[30] & 128) fill.max_edges = most, fill.filter.max_length = fill.filter.max_area = fill.filter.within.radius = number;
    fill.join.kind = head[31] % 4u;
    fill.filter.within.kind = head[31] / 4u % 4u;
    fairmesh_bridge_options_init(&how, sizeof how);
    how.width = head[31] & 128 ? number : 0.0;
    how.fill = head[31] & 64;
    switch (head[24] % 10u) {
    case 0: return fairmesh_fill_holes(mesh, &fill, options, result, error);
    case 1: return fairmesh_suggest_joins(mesh, &fill, result, error);
    case 2: return fairmesh_erase(mesh, &list, 0, result, error);
    case 3: return fairmesh_erase(mesh, &list, most, result, error);
    case 4: return fairmesh_trim_boundary(mesh, head[31] & 32 ? NULL : &list, most, number, result, error);
    case 5: return fairmesh_bridge(mesh, &list, &list, &how, &fill, options, result, error);
    case 6: return fairmesh_refill(mesh, selection, &fill, options, result, error);
    case 7: return fairmesh_carry_over(mesh, head[31] & 32 ? NULL : &list, &mesh->positions, NULL, NULL, result, error);
    case 8: return fairmesh_rim_roughness(mesh, result, error);
    default: return fairmesh_components(mesh, result, error);
    }
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
    enum { HEAD = 64, ARRAYS = 1536 };
    union {
        double align;
        uint8_t bytes[ARRAYS];
    } positions, corners, mask, out;
    uint8_t head[HEAD];
    fairmesh_options options;
    /* The size that the struct claims lies within its memory, too. */
    union {
        fairmesh_mesh mesh;
        uint8_t room[256];
    } sized;
    fairmesh_selection selection;
    fairmesh_points_out to;
    fairmesh_error error;
    fairmesh_status status;
    size_t k, room, number;
    memset(head, 0, sizeof head);
    memcpy(head, data, size < HEAD ? size : HEAD);
    data += size < HEAD ? size : HEAD;
    size -= size < HEAD ? size : HEAD;
    memset(&positions, 0, sizeof positions);
    memset(&corners, 0, sizeof corners);
    memset(&mask, 1, sizeof mask);
    for (k = 0; k < size && k < 3 * ARRAYS; k++) {
        uint8_t *to_array = k % 3 == 0 ? positions.bytes : k % 3 == 1 ? corners.bytes : mask.bytes;
        to_array[k / 3] = data[k];
    }
    fairmesh_options_init(&options, sizeof options);
    memset(&sized, 0, sizeof sized);
    memset(&selection, 0, sizeof selection);
    memset(&to, 0, sizeof to);
    sized.mesh.struct_size = head[0] & 1 ? sizeof sized.mesh : head[1];
    sized.mesh.positions.data = positions.bytes + (head[0] & 2 ? head[2] % 16 : 0);
    sized.mesh.positions.scalar = head[3] % 4;
    sized.mesh.positions.stride = head[4] % 64;
    number = sized.mesh.positions.scalar == 2 ? 8 : 4;
    room = sized.mesh.positions.stride > 3 * number ? sized.mesh.positions.stride : 3 * number;
    sized.mesh.positions.count = head[5] % ((ARRAYS - 16) / room + 1);
    sized.mesh.triangles.data = (const uint32_t *)(const void *)(corners.bytes + (head[0] & 4 ? head[6] % 8 : 0));
    sized.mesh.triangles.stride = head[7] % 32;
    room = sized.mesh.triangles.stride > 12 ? sized.mesh.triangles.stride : 12;
    sized.mesh.triangles.count = head[8] % ((ARRAYS - 8) / room + 1);
    selection.struct_size = sizeof selection;
    selection.kind = head[9] % 6;
    selection.data = mask.bytes + (head[0] & 8 ? head[10] % 8 : 0);
    selection.stride = head[11] % 16;
    room = selection.stride > 4 ? selection.stride : 4;
    selection.count = head[12] & 1 ? sized.mesh.positions.count : head[13] % ((ARRAYS - 8) / room + 1);
    if (selection.count * room > ARRAYS - 8) selection.count = (ARRAYS - 8) / room;
    to.data = head[0] & 16 ? (void *)(uintptr_t)sized.mesh.positions.data : out.bytes;
    to.scalar = sized.mesh.positions.scalar;
    to.stride = sized.mesh.positions.stride;
    to.count = sized.mesh.positions.count;
    options.inner_fairness = head[14] % 4;
    options.boundary_normals.kind = head[15] % 3;
    options.target.kind = head[16] % 4;
    memcpy(&options.target.constant, head + 24, 8);
    memcpy(&options.tolerance, head + 32, 8);
    if (head[17] & 1) options.tolerance = 1e-3;
    options.boundary_normals.vectors = sized.mesh.positions;
    options.interior_normals = head[18] % 3;
    memcpy(&options.continuity, head + 40, 8);
    if (head[22] & 1) options.continuity = 1.0;
    options.boundary_curvature.kind = head[23] % 3;
    options.boundary_curvature.values.data = sized.mesh.positions.data;
    options.boundary_curvature.values.count = sized.mesh.positions.count;
    options.boundary_curvature.values.stride = sized.mesh.positions.stride;
    options.boundary_curvature.values.scalar = sized.mesh.positions.scalar;
    options.discretization = head[19] % 3;
    options.threads = 1;
    options.max_iterations = head[20] % 8;
    if (head[0] & 32) {
        fairmesh_result *result = NULL;
        status = holes(head, mask.bytes, &sized.mesh, head[21] & 1 ? NULL : &selection, &options, &result, &error);
        if (status == FAIRMESH_STATUS_INTERNAL || error.status != (int32_t)status) abort();
        if (fairmesh_result_free(result) != FAIRMESH_STATUS_OK) abort();
        return 0;
    }
    status = fairmesh_fair(&sized.mesh, head[21] & 1 ? NULL : &selection, &options, &to, NULL, NULL, &error);
    if (status == FAIRMESH_STATUS_INTERNAL) abort();
    if (error.status != (int32_t)status) abort();
    return 0;
}
