// SPDX-License-Identifier: MIT OR Apache-2.0
#include "charts.h"

#include <algorithm>
#include <utility>

namespace fairmesh_meshlab {

namespace {

using Vector = vcg::Point3<double>;

Vector vector(const Point &p) { return {static_cast<double>(p[0]), static_cast<double>(p[1]), static_cast<double>(p[2])}; }

} // namespace

Charts::Charts(const CMeshO &mesh, const MeshView &view, const std::vector<std::uint32_t> &gone, const fairmesh::carried_points &places)
    : mesh_(mesh), view_(view), places_(places) {
    for (std::uint32_t t : gone) next_[t] = t;
    using End = std::pair<std::uint32_t, Coordinates>;
    std::map<std::pair<End, End>, std::uint32_t> sides;
    for (std::uint32_t t : gone)
        for (int k = 0; k < 3; ++k) {
            const End from = {view.triangles()[t][k], corner(t, k)}, to = {view.triangles()[t][(k + 1) % 3], corner(t, (k + 1) % 3)};
            const auto [side, is_new] = sides.emplace(std::minmax(from, to), t);
            if (!is_new) join(side->second, t);
        }
    for (std::uint32_t t : gone)
        for (int k = 0; k < 3; ++k) at_.emplace(std::array<std::uint32_t, 2>{view.triangles()[t][k], chart(t)}, corner(t, k));
}

Charts::Coordinates Charts::at_old(std::uint32_t v, std::uint32_t triangle) const {
    const auto known = at_.find({v, chart(triangle)});
    if (known != at_.end()) return known->second;
    const Vector place = vector(mesh_.vert[v].cP());
    return continued(triangle, {place[0], place[1], place[2]});
}

Charts::Coordinates Charts::at_new(std::size_t i, const std::array<double, 3> &place, std::uint32_t triangle) const {
    const std::uint32_t on = places_.triangles[i];
    if (next_.count(on) != 0 && chart(on) == chart(triangle)) return mixed(on, places_.weights[i]);
    return continued(triangle, place);
}

Charts::Coordinates Charts::corner(std::uint32_t triangle, int k) const {
    const auto &there = mesh_.face[view_.face(triangle)].cWT(k);
    return {static_cast<double>(there.u()), static_cast<double>(there.v())};
}

Charts::Coordinates Charts::mixed(std::uint32_t triangle, const std::array<double, 3> &weights) const {
    Coordinates sum = {0, 0};
    for (int k = 0; k < 3; ++k)
        for (int c = 0; c < 2; ++c) sum[c] += weights[k] * corner(triangle, k)[c];
    return sum;
}

Charts::Coordinates Charts::continued(std::uint32_t triangle, const std::array<double, 3> &place) const {
    std::array<Vector, 3> p;
    for (int k = 0; k < 3; ++k) p[k] = vector(mesh_.vert[view_.triangles()[triangle][k]].cP());
    const Vector at(place[0], place[1], place[2]), normal = (p[1] - p[0]) ^ (p[2] - p[0]);
    const double area = normal.SquaredNorm();
    std::array<double, 3> weights = {1, 0, 0};
    for (int k = 0; area > 0 && k < 3; ++k) weights[k] = (((p[(k + 2) % 3] - p[(k + 1) % 3]) ^ (at - p[(k + 1) % 3])) * normal) / area;
    return mixed(triangle, weights);
}

std::uint32_t Charts::chart(std::uint32_t triangle) const {
    std::uint32_t at = triangle;
    while (next_[at] != at) at = next_[at] = next_[next_[at]];
    return at;
}

void Charts::join(std::uint32_t a, std::uint32_t b) {
    const std::uint32_t first = chart(a), second = chart(b);
    next_[std::max(first, second)] = std::min(first, second);
}

} // namespace fairmesh_meshlab
