// SPDX-License-Identifier: MIT OR Apache-2.0
#include "write.h"

#include <vcg/complex/algorithms/update/bounding.h>

#include <cmath>

namespace fairmesh_meshlab {

namespace {

bool finite(const Point &p) { return std::isfinite(p[0]) && std::isfinite(p[1]) && std::isfinite(p[2]); }

/** The angle of a face at its corner `k`. */
Scalar angle(const CFaceO &face, int k) {
    const Point a = face.cP1(k) - face.cP(k), b = face.cP2(k) - face.cP(k);
    return static_cast<Scalar>(std::atan2((a ^ b).Norm(), a * b));
}

bool any(const Mask &mask, const std::uint32_t (&corners)[3]) { return mask[corners[0]] || mask[corners[1]] || mask[corners[2]]; }

} // namespace

std::vector<Point> rounded(const CMeshO &mesh, const std::vector<std::array<double, 3>> &positions) {
    std::vector<Point> points(mesh.vert.size());
    for (std::size_t i = 0; i < points.size(); ++i) {
        const auto &p = positions[i];
        points[i] = Point(static_cast<Scalar>(p[0]), static_cast<Scalar>(p[1]), static_cast<Scalar>(p[2]));
        if (!finite(points[i]) && finite(mesh.vert[i].cP()))
            throw Failure("The new position of vertex " + std::to_string(i) + " exceeds this MeshLab's range of numbers.");
    }
    return points;
}

Mask write_positions(CMeshO &mesh, const std::vector<Point> &positions) {
    Mask moved(mesh.vert.size(), 0);
    for (std::size_t i = 0; i < moved.size(); ++i) {
        if (mesh.vert[i].IsD() || !finite(positions[i]) || positions[i] == mesh.vert[i].cP()) continue;
        mesh.vert[i].P() = positions[i];
        moved[i] = 1;
    }
    return moved;
}

void update_normals(CMeshO &mesh, const Mask &moved, bool keep_fixed) {
    const CVertexO *first = mesh.vert.data();
    Mask stale = moved;
    std::vector<Point> sums(mesh.vert.size(), Point(0, 0, 0));
    auto for_faces_at = [&](const Mask &vertices, auto &&work) {
        for (CFaceO &face : mesh.face) {
            if (face.IsD()) continue;
            const std::uint32_t corners[3] = {static_cast<std::uint32_t>(face.cV(0) - first),
                                              static_cast<std::uint32_t>(face.cV(1) - first),
                                              static_cast<std::uint32_t>(face.cV(2) - first)};
            if (any(vertices, corners)) work(face, corners);
        }
    };
    for_faces_at(moved, [&](CFaceO &face, const std::uint32_t(&corners)[3]) {
        face.N() = vcg::TriangleNormal(face).Normalize();
        for (std::uint32_t v : corners) stale[v] |= !keep_fixed;
    });
    for_faces_at(stale, [&](CFaceO &face, const std::uint32_t(&corners)[3]) {
        const Point normal = vcg::TriangleNormal(face).Normalize();
        for (int k = 0; k < 3; ++k)
            if (stale[corners[k]]) sums[corners[k]] += normal * angle(face, k);
    });
    for (std::size_t i = 0; i < sums.size(); ++i) {
        if (!stale[i]) continue;
        const Scalar length = mesh.vert[i].cN().Norm();
        mesh.vert[i].N() = sums[i].Normalize() * (length > 0 ? length : 1);
    }
    vcg::tri::UpdateBounding<CMeshO>::Box(mesh);
}

std::size_t write_quality(MeshModel &model, const std::vector<double> &numbers) {
    model.updateDataMask(MeshModel::MM_VERTQUALITY);
    std::size_t written = 0;
    for (std::size_t i = 0; i < numbers.size(); ++i) {
        if (model.cm.vert[i].IsD() || std::isnan(numbers[i])) continue;
        model.cm.vert[i].Q() = static_cast<CVertexO::QualityType>(numbers[i]);
        ++written;
    }
    return written;
}

} // namespace fairmesh_meshlab
