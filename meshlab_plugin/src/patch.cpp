// SPDX-License-Identifier: MIT OR Apache-2.0
#include "patch.h"

#include <algorithm>
#include <cmath>
#include <typeindex>

namespace fairmesh_meshlab {

namespace {

using Allocator = vcg::tri::Allocator<CMeshO>;
constexpr std::uint32_t NONE = UINT32_MAX;

/** The parent of a new vertex with the largest weight. */
std::uint32_t nearest(const Patch &patch, std::size_t i) {
    const auto &w = patch.weights[i];
    return patch.parents[i][std::max_element(w.begin(), w.end()) - w.begin()];
}

/** For every old vertex one of its faces: the first one. */
std::vector<std::uint32_t> first_faces(const CMeshO &mesh) {
    std::vector<std::uint32_t> faces(mesh.vert.size(), NONE);
    for (std::size_t i = mesh.face.size(); i-- > 0;) {
        if (mesh.face[i].IsD()) continue;
        for (int k = 0; k < 3; ++k) faces[mesh.face[i].cV(k) - mesh.vert.data()] = static_cast<std::uint32_t>(i);
    }
    return faces;
}

/** The sum of something over the parents, as numbers. */
template <class Value, class Get> Value mean(const Patch &patch, std::size_t i, Value zero, Get get) {
    for (int k = 0; k < 3; ++k) zero += get(patch.parents[i][k]) * patch.weights[i][k];
    return zero;
}

vcg::Color4b mean_color(const CMeshO &mesh, const Patch &patch, std::size_t i) {
    vcg::Color4b color;
    for (int c = 0; c < 4; ++c) {
        const double value = mean(patch, i, 0.0, [&](std::uint32_t v) { return double(mesh.vert[v].cC()[c]); });
        color[c] = static_cast<unsigned char>(std::lround(std::clamp(value, 0.0, 255.0)));
    }
    return color;
}

/** Texture coordinates of a new vertex; those of a parent on a seam belong to one side of it. */
template <class TexCoord, class Get> TexCoord mean_tex_coord(const Patch &patch, std::size_t i, const TexCoord &like, Get get) {
    using Number = std::decay_t<decltype(like.u())>;
    TexCoord made = like;
    made.u() = static_cast<Number>(mean(patch, i, 0.0, [&](std::uint32_t v) { return double(get(v).u()); }));
    made.v() = static_cast<Number>(mean(patch, i, 0.0, [&](std::uint32_t v) { return double(get(v).v()); }));
    return made;
}

void set_vertex(CMeshO &mesh, const Patch &patch, std::size_t first, std::size_t i) {
    CVertexO &vertex = mesh.vert[first + i];
    const CVertexO &like = mesh.vert[nearest(patch, i)];
    vertex.ImportData(like);
    vertex.ClearS();
    vertex.ClearV();
    vertex.P() = patch.positions[i];
    vertex.C() = mean_color(mesh, patch, i);
    vertex.Q() = static_cast<CVertexO::QualityType>(mean(patch, i, 0.0, [&](std::uint32_t v) { return double(mesh.vert[v].cQ()); }));
    if (mesh.vert.IsTexCoordEnabled()) vertex.T() = mean_tex_coord(patch, i, like.cT(), [&](std::uint32_t v) { return mesh.vert[v].cT(); });
}

/** Custom attributes of any type: that of the nearest parent. */
void copy_attributes(CMeshO &mesh, const Patch &patch, std::size_t first) {
    for (const auto &attribute : mesh.vert_attr)
        for (std::size_t i = 0; i < patch.positions.size(); ++i)
            attribute._handle->CopyValue(first + i, nearest(patch, i), attribute._handle);
}

/** Interpolates the attributes whose type is `Type`, a number or a point of such. */
template <class Type, class Number> void mix_attributes(CMeshO &mesh, const Patch &patch, std::size_t first) {
    for (const auto &attribute : mesh.vert_attr) {
        if (attribute._type != std::type_index(typeid(Type)) || attribute._padding != 0) continue;
        auto at = [&](std::size_t v) -> Type & { return *static_cast<Type *>(attribute._handle->At(v)); };
        for (std::size_t i = 0; i < patch.positions.size(); ++i) {
            auto part = [&](int k) -> Type { return at(patch.parents[i][k]) * static_cast<Number>(patch.weights[i][k]); };
            at(first + i) = part(0) + part(1) + part(2);
        }
    }
}

/** The wedge of an old vertex: in its first face. */
CFaceO::TexCoordType wedge(const CMeshO &mesh, const std::vector<std::uint32_t> &faces, std::uint32_t v) {
    const CFaceO &face = mesh.face[faces[v]];
    for (int k = 0; k < 2; ++k)
        if (face.cV(k) == &mesh.vert[v]) return face.cWT(k);
    return face.cWT(2);
}

void set_face(CMeshO &mesh, const Patch &patch, const std::vector<std::uint32_t> &faces, std::size_t first, std::size_t i) {
    const std::size_t old_vertices = faces.size();
    const auto &corners = patch.triangles[i];
    auto old = [&](std::uint32_t v) { return v < old_vertices ? v : nearest(patch, v - old_vertices); };
    CFaceO &face = mesh.face[first + i];
    const std::uint32_t beside = patch.like.empty() ? faces[old(corners[0])] : patch.like[i];
    if (beside != NONE) {
        face.ImportData(mesh.face[beside]);
        for (const auto &attribute : mesh.face_attr) attribute._handle->CopyValue(first + i, beside, attribute._handle);
    }
    face.ClearS();
    face.ClearV();
    for (int k = 0; k < 3; ++k) {
        face.V(k) = &mesh.vert[corners[k]];
        face.ClearF(k);
        face.ClearB(k);
        if (!mesh.face.IsWedgeTexCoordEnabled()) continue;
        const std::uint32_t v = corners[k];
        if (!patch.wedges.empty()) {
            // The number of the texture is the face's.
            face.WT(k).u() = static_cast<std::decay_t<decltype(face.WT(k).u())>>(patch.wedges[i][k][0]);
            face.WT(k).v() = static_cast<std::decay_t<decltype(face.WT(k).v())>>(patch.wedges[i][k][1]);
        } else if (v < old_vertices) face.WT(k) = wedge(mesh, faces, v);
        else
            face.WT(k) = mean_tex_coord(patch, v - old_vertices, wedge(mesh, faces, old(v)),
                                        [&](std::uint32_t parent) { return wedge(mesh, faces, parent); });
    }
}

} // namespace

Patch new_vertices(const fairmesh::result &made, std::size_t first_new) {
    const fairmesh_info info = made.info();
    const auto positions = made.positions();
    const auto parents = made.list(FAIRMESH_LIST_PARENTS);
    Patch patch;
    patch.weights = made.vectors(FAIRMESH_VECTORS_PARENT_WEIGHTS);
    for (std::size_t i = 0; i < info.new_vertex_count; ++i) {
        const auto &p = positions[first_new + i];
        patch.positions.emplace_back(static_cast<Scalar>(p[0]), static_cast<Scalar>(p[1]), static_cast<Scalar>(p[2]));
        for (double x : p)
            if (!std::isfinite(static_cast<Scalar>(x))) throw Failure("A new position exceeds this MeshLab's range of numbers.");
        patch.parents.push_back({parents[3 * i], parents[3 * i + 1], parents[3 * i + 2]});
    }
    return patch;
}

Patch patch_of(const fairmesh::result &filled, std::size_t old_triangles, const CMeshO &mesh) {
    const auto triangles = filled.triangles();
    Patch patch = new_vertices(filled, mesh.vert.size());
    patch.old_positions = rounded(mesh, filled.positions());
    patch.triangles.assign(triangles.begin() + static_cast<std::ptrdiff_t>(old_triangles), triangles.end());
    return patch;
}

Mask add(CMeshO &mesh, const Patch &patch) {
    const std::vector<std::uint32_t> faces = first_faces(mesh);
    const std::size_t first_vertex = mesh.vert.size(), first_face = mesh.face.size();
    Mask made = write_positions(mesh, patch.old_positions);
    made.resize(first_vertex + patch.positions.size(), 1);
    if (!patch.positions.empty()) Allocator::AddVertices(mesh, patch.positions.size());
    if (!patch.triangles.empty()) Allocator::AddFaces(mesh, patch.triangles.size());
    for (std::size_t i = 0; i < patch.positions.size(); ++i) set_vertex(mesh, patch, first_vertex, i);
    copy_attributes(mesh, patch, first_vertex);
    mix_attributes<float, float>(mesh, patch, first_vertex);
    mix_attributes<double, double>(mesh, patch, first_vertex);
    mix_attributes<vcg::Point3<float>, float>(mesh, patch, first_vertex);
    mix_attributes<vcg::Point3<double>, double>(mesh, patch, first_vertex);
    for (std::size_t i = 0; i < patch.triangles.size(); ++i) set_face(mesh, patch, faces, first_face, i);
    return made;
}

} // namespace fairmesh_meshlab
