// SPDX-License-Identifier: MIT OR Apache-2.0
/** What is said of filled holes, and selected afterwards. */
#ifndef FAIRMESH_MESHLAB_FILLED_H
#define FAIRMESH_MESHLAB_FILLED_H

#include "host.h"
#include "mesh_view.h"
#include "parameters.h"
#include "write.h"

#include <fairmesh.hpp>

namespace fairmesh_meshlab {

/** What became of the holes, in the log and as values. `loops`: those of the mesh that was filled. */
Values told(const fairmesh::result &filled, const fairmesh::result &loops, double continuity, const Host &host);

/** Said after `told` where faces were deleted: the host has numbered its vertices anew since. */
constexpr char OLD_NUMBERS[] = "Vertices in these warnings have the numbers that they had before faces were deleted.";

/** Selects as the user wishes. The last `count` faces are new. */
void select_new(CMeshO &mesh, std::size_t count, SelectionAfter wish);

/** Some of the triangles of a view, and the mesh of the same vertices with such triangles, which it does not keep. */
using Triangles = std::vector<std::array<std::uint32_t, 3>>;
Triangles some_of(const MeshView &view, const std::vector<std::uint32_t> &kept);
fairmesh_mesh with_triangles(const MeshView &view, const Triangles &triangles);

/** Deletes the faces that are not kept (triangles of the view, ascending); tells which vertices only they had, and keeps these for now. */
Mask delete_faces(CMeshO &mesh, const MeshView &view, const std::vector<std::uint32_t> &kept);
/** Deletes vertices, then closes the gaps: as the host's own filters that delete, whose scripts read compact meshes only. */
void delete_vertices(CMeshO &mesh, const Mask &loose);

/** Puts the patches of holes or of a bridge into a mesh of which these triangles were kept, ascending, and deletes the others with the
 *  vertices that only they had. Throws Failure, before anything has changed, if a number exceeds the host's range. */
void write_patches(MeshModel &model, const MeshView &view, const std::vector<std::uint32_t> &kept, const fairmesh::result &filled,
                   SelectionAfter wish);
/** The same where all triangles were kept. */
void write_patches(MeshModel &model, const MeshView &view, const fairmesh::result &filled, SelectionAfter wish);

} // namespace fairmesh_meshlab

#endif
