// SPDX-License-Identifier: MIT OR Apache-2.0
/** Texture coordinates of faces that take the place of others. */
#ifndef FAIRMESH_MESHLAB_CHARTS_H
#define FAIRMESH_MESHLAB_CHARTS_H

#include "host.h"
#include "mesh_view.h"

#include <fairmesh.hpp>

#include <array>
#include <map>
#include <vector>

namespace fairmesh_meshlab {

/** Faces that go, of a mesh with texture coordinates at the corners of its faces. Those that have the same on both sides of their common
 *  edges are a chart. */
class Charts {
  public:
    using Coordinates = std::array<double, 2>;
    /** `gone`: triangles of the view. `places`: where new vertices lie on them. All that is named has to outlive this, and not change. */
    Charts(const CMeshO &mesh, const MeshView &view, const std::vector<std::uint32_t> &gone, const fairmesh::carried_points &places);

    /** At a corner of a new face that belongs to the chart of a triangle: at an old vertex, */
    Coordinates at_old(std::uint32_t v, std::uint32_t triangle) const;
    /** and at a new one, which is there. Where the chart has nothing, its triangle is continued. */
    Coordinates at_new(std::size_t i, const std::array<double, 3> &place, std::uint32_t triangle) const;

  private:
    Coordinates corner(std::uint32_t triangle, int k) const;
    Coordinates mixed(std::uint32_t triangle, const std::array<double, 3> &weights) const;
    Coordinates continued(std::uint32_t triangle, const std::array<double, 3> &place) const;
    std::uint32_t chart(std::uint32_t triangle) const;
    void join(std::uint32_t a, std::uint32_t b);

    const CMeshO &mesh_;
    const MeshView &view_;
    const fairmesh::carried_points &places_;
    /** The next triangle on the way to the one that speaks for its chart. */
    mutable std::map<std::uint32_t, std::uint32_t> next_;
    std::map<std::array<std::uint32_t, 2>, Coordinates> at_;
};

} // namespace fairmesh_meshlab

#endif
