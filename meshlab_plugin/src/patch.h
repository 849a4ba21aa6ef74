// SPDX-License-Identifier: MIT OR Apache-2.0
/** New vertices and faces for a mesh of the host, with what the old ones around them carry. */
#ifndef FAIRMESH_MESHLAB_PATCH_H
#define FAIRMESH_MESHLAB_PATCH_H

#include "host.h"
#include "write.h"

#include <fairmesh.hpp>

#include <array>
#include <vector>

namespace fairmesh_meshlab {

/** What is to be added, and where the old vertices are then. New ones are numbered on from those of the host. */
struct Patch {
    std::vector<Point> old_positions;
    std::vector<Point> positions;
    /** Per new vertex three old ones, and their weights, whose sum is 1. */
    std::vector<std::array<std::uint32_t, 3>> parents;
    std::vector<std::array<double, 3>> weights;
    std::vector<std::array<std::uint32_t, 3>> triangles;
    /** Per triangle an old face whose values it has; empty: that beside its first corner. */
    std::vector<std::uint32_t> like;
    /** With `like` and where the mesh has them, the texture coordinates of corners. */
    std::vector<std::array<std::array<double, 2>, 3>> wedges;
};

/** The new vertices of a result whose positions from `first_new` on are new, with their parents. Throws Failure as below. */
Patch new_vertices(const fairmesh::result &made, std::size_t first_new);

/** What filled holes add to a mesh of so many triangles. Throws Failure if a number exceeds the host's range. */
Patch patch_of(const fairmesh::result &filled, std::size_t old_triangles, const CMeshO &mesh);

/** Adds it. Colours, quality, texture coordinates, normals and attributes of numbers and points are interpolated; everything else comes
 * from the nearest parent, or the old face there. Returns the vertices that are new or have moved. */
Mask add(CMeshO &mesh, const Patch &patch);

} // namespace fairmesh_meshlab

#endif
