/* OpenMesh triangle meshes for C: what tests and measurements need. Coordinates are exchanged as doubles, whatever the
 * mesh's own numbers are. No exception leaves; a call that can fail returns false or NULL, and om_last_error() says why.
 * One mesh is used by one thread at a time. */
#ifndef OPENMESH_SHIM_H
#define OPENMESH_SHIM_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

/** A TriMesh_ArrayKernelT with status and vertex normals. */
typedef struct om_mesh om_mesh;

/** The numbers that a mesh stores. */
enum om_scalar { OM_FLOAT = 0, OM_DOUBLE = 1 };

/** What has a status. */
enum om_element { OM_VERTEX = 0, OM_EDGE = 1, OM_FACE = 2 };

/** Bits of a status. */
enum om_flag { OM_SELECTED = 0, OM_LOCKED = 1, OM_FEATURE = 2, OM_DELETED = 3 };

/** JacobiLaplaceSmootherT: which part of a step is taken. NORMAL takes cotangent weights, the others equal ones. */
enum om_component { OM_TANGENTIAL = 0, OM_NORMAL = 1, OM_TANGENTIAL_AND_NORMAL = 2 };

/** JacobiLaplaceSmootherT: the umbrella (C0) or its square (C1). */
enum om_continuity { OM_C0 = 0, OM_C1 = 1 };

/** What the last call on this thread failed with. Never NULL; valid until the next call. */
const char *om_last_error(void);

/** `3 * vertices` coordinates, `3 * faces` indices. */
om_mesh *om_mesh_build(uint32_t scalar, const double *positions, size_t vertices, const uint32_t *triangles, size_t faces);
/** Any format that OpenMesh reads, by the file's ending. */
om_mesh *om_mesh_read(uint32_t scalar, const char *path);
bool om_mesh_write(const om_mesh *mesh, const char *path);
/** NULL is allowed. */
void om_mesh_free(om_mesh *mesh);

/** Elements, deleted ones included. */
size_t om_mesh_count(const om_mesh *mesh, uint32_t element);
void om_mesh_positions(const om_mesh *mesh, double *out);
void om_mesh_set_positions(om_mesh *mesh, const double *positions);
/** Three indices per face. */
void om_mesh_triangles(const om_mesh *mesh, uint32_t *out);
/** The edge between two vertices, SIZE_MAX if there is none. */
size_t om_mesh_edge(const om_mesh *mesh, size_t a, size_t b);

bool om_mesh_status(const om_mesh *mesh, uint32_t element, size_t index, uint32_t flag);
/** OM_DELETED cannot be set here. */
void om_mesh_set_status(om_mesh *mesh, uint32_t element, size_t index, uint32_t flag, bool value);

/** Computes face and vertex normals. */
void om_mesh_update_normals(om_mesh *mesh);
/** Vertex normals, as they are stored. */
void om_mesh_normals(const om_mesh *mesh, double *out);

/** JacobiLaplaceSmootherT: selected vertices move, or all where none is selected; not those of the boundary, nor locked
 * ones; with `skip_features` not those of features either. */
bool om_mesh_smooth(om_mesh *mesh, uint32_t component, uint32_t continuity, uint32_t iterations, bool skip_features);

#ifdef __cplusplus
}
#endif

#endif
