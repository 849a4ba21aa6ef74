// SPDX-License-Identifier: MIT OR Apache-2.0
/** What is said of filled holes, and selected afterwards. */
#ifndef FAIRMESH_MESHLAB_FILLED_H
#define FAIRMESH_MESHLAB_FILLED_H

#include "host.h"
#include "parameters.h"

#include <fairmesh.hpp>

namespace fairmesh_meshlab {

/** What became of the holes, in the log and as values. `loops`: those of the mesh that was filled. */
Values told(const fairmesh::result &filled, const fairmesh::result &loops, bool continues_curvature, const Host &host);

/** Selects as the user wishes. The last `count` faces are new. */
void select_new(CMeshO &mesh, std::size_t count, SelectionAfter wish);

/** Puts the patches of holes or of a bridge into a mesh of so many triangles. Throws Failure, before anything has changed, if a number
 *  exceeds the host's range. */
void write_patches(MeshModel &model, const fairmesh::result &filled, std::size_t old_triangles, SelectionAfter wish);

} // namespace fairmesh_meshlab

#endif
