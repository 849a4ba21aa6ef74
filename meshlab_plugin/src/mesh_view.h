// SPDX-License-Identifier: MIT OR Apache-2.0
/** A mesh of the host as the arrays that the library reads. */
#ifndef FAIRMESH_MESHLAB_MESH_VIEW_H
#define FAIRMESH_MESHLAB_MESH_VIEW_H

#include "host.h"

#include <fairmesh.hpp>

#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace fairmesh_meshlab {

/** Positions are read where they are. Vertices keep their numbers: deleted ones take part as vertices without triangles, which the
 *  library ignores. Deleted faces are left out, so triangles have numbers of their own. */
class MeshView {
  public:
    /** Throws Failure if there is no face. The mesh must outlive the view and not change. */
    explicit MeshView(const CMeshO &mesh);

    /** Vertices up to this distance are one vertex of the surface: 0 where their coordinates are equal, negative nowhere. */
    void join(double distance) { join_ = distance; }
    fairmesh_mesh mesh() const;
    /** Three vertices per triangle. */
    const std::vector<std::array<std::uint32_t, 3>> &triangles() const { return triangles_; }
    /** The face of the host that a triangle is. */
    std::uint32_t face(std::size_t triangle) const { return faces_[triangle]; }
    /** The selected triangles. */
    const std::vector<std::uint32_t> &selected() const { return selected_; }
    /** The selected edges, as by 'Select Crease Edges', each once or twice. */
    const std::vector<std::array<std::uint32_t, 2>> &selected_edges() const { return selected_edges_; }
    /** Those of the selected edges, as by 'Select Crease Edges', that sharp edges outside may be, if any are asked for. */
    void mark_edges(fairmesh_options &options) const;
    /** The diagonal of the bounding box of vertices. */
    double diagonal(const std::vector<std::uint32_t> &vertices) const;
    /** A text of the library with its triangles' numbers replaced by those of the host's faces. */
    std::string in_host_numbers(const char *text) const;

  private:
    const CMeshO &host_;
    double join_ = 0;
    std::vector<std::array<std::uint32_t, 3>> triangles_;
    std::vector<std::uint32_t> faces_;
    std::vector<std::uint32_t> selected_;
    std::vector<std::array<std::uint32_t, 2>> selected_edges_;
};

} // namespace fairmesh_meshlab

#endif
