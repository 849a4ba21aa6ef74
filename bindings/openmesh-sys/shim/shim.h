/* The smoother of OpenMesh for C: what the comparison with fairmesh needs. No exception leaves; a call that can fail returns
 * false or NULL, and om_last_error() says why. One mesh is used by one thread at a time. */
#ifndef OPENMESH_SHIM_H
#define OPENMESH_SHIM_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

/** A TriMesh_ArrayKernelT of doubles. */
typedef struct om_mesh om_mesh;

/** What the last call on this thread failed with. Never NULL; valid until the next call. */
const char *om_last_error(void);

/** `3 * vertices` coordinates, `3 * faces` indices. */
om_mesh *om_mesh_build(const double *positions, size_t vertices, const uint32_t *triangles, size_t faces);
/** NULL is allowed. */
void om_mesh_free(om_mesh *mesh);
/** Three coordinates per vertex. */
void om_mesh_positions(const om_mesh *mesh, double *out);
/** Selects the vertices whose flag is set, and no others. */
void om_mesh_select(om_mesh *mesh, const bool *vertices);
/** JacobiLaplaceSmootherT with C1, tangential and normal: selected vertices move, or all where none is selected; not those of
 * the boundary. */
bool om_mesh_smooth(om_mesh *mesh, uint32_t iterations);

#ifdef __cplusplus
}
#endif

#endif
