// SPDX-License-Identifier: MIT OR Apache-2.0
/** What is written to a mesh of the host. */
#ifndef FAIRMESH_MESHLAB_WRITE_H
#define FAIRMESH_MESHLAB_WRITE_H

#include "host.h"

#include <array>
#include <cstdint>
#include <vector>

namespace fairmesh_meshlab {

/** Vertices, one byte each. */
using Mask = std::vector<std::uint8_t>;

/** Positions as the host rounds them. Throws Failure if one of a vertex that moves is not a finite number then. */
std::vector<Point> rounded(const CMeshO &mesh, const std::vector<std::array<double, 3>> &positions);

/** Writes positions and tells which vertices they move. All others keep their bits. */
Mask write_positions(CMeshO &mesh, const std::vector<Point> &positions);

/** Computes the normals again that depend on the moved vertices, of faces and of vertices, and the bounding box. With `keep_fixed` vertices
 *  that have not moved keep theirs. Normals of faces get length one, those of vertices the length that they had. */
void update_normals(CMeshO &mesh, const Mask &moved, bool keep_fixed);

/** Writes numbers to the vertices' quality, except for NaN, and counts what was written. */
std::size_t write_quality(MeshModel &model, const std::vector<double> &numbers);

} // namespace fairmesh_meshlab

#endif
