// SPDX-License-Identifier: MIT OR Apache-2.0
#include "mesh_view.h"

#include <QRegularExpression>

namespace fairmesh_meshlab {

MeshView::MeshView(const CMeshO &mesh) : host_(mesh) {
    if (mesh.fn <= 0 || mesh.vn <= 0) throw Failure("The mesh has no faces.");
    if (mesh.vert.size() > UINT32_MAX || mesh.face.size() > UINT32_MAX)
        throw Failure("The mesh has more vertices or faces than 32-bit indices can name.");
    triangles_.reserve(mesh.fn);
    faces_.reserve(mesh.fn);
    const CVertexO *first = mesh.vert.data();
    for (std::size_t i = 0; i < mesh.face.size(); ++i) {
        const CFaceO &face = mesh.face[i];
        if (face.IsD()) continue;
        if (face.IsS()) selected_.push_back(static_cast<std::uint32_t>(triangles_.size()));
        faces_.push_back(static_cast<std::uint32_t>(i));
        triangles_.push_back({});
        auto &triangle = triangles_.back();
        for (int k = 0; k < 3; ++k) triangle[k] = static_cast<std::uint32_t>(face.cV(k) - first);
        for (int k = 0; k < 3; ++k)
            if (face.IsFaceEdgeS(k)) selected_edges_.push_back({triangle[k], triangle[(k + 1) % 3]});
    }
}

fairmesh_mesh MeshView::mesh() const {
    auto positions = fairmesh::points(host_.vert.front().P().V(), host_.vert.size(), sizeof(CVertexO));
    auto made = fairmesh::mesh(positions, fairmesh::indices(triangles_.front().data(), triangles_.size()));
    if (join_ < 0) made.coincident = FAIRMESH_COINCIDENT_SEPARATE;
    else made.coincident_within = join_;
    return made;
}

void MeshView::mark_edges(fairmesh_options &options) const {
    if (options.sharp > 0 && !selected_edges_.empty())
        options.marked_edges = fairmesh::indices(selected_edges_.front().data(), selected_edges_.size());
}

double MeshView::diagonal(const std::vector<std::uint32_t> &vertices) const {
    vcg::Box3<Scalar> box;
    for (std::uint32_t v : vertices) box.Add(host_.vert[v].cP());
    return vertices.empty() ? 0 : box.Diag();
}

std::string MeshView::in_host_numbers(const char *text) const {
    static const QRegularExpression number("triangles? (\\d+)(?: and (\\d+))?");
    const QString theirs = QString::fromUtf8(text);
    auto face_of = [this](const QString &digits) {
        const qulonglong triangle = digits.toULongLong();
        return triangle < faces_.size() ? QString::number(faces_[triangle]) : digits;
    };
    QString ours;
    int end = 0;
    for (auto matches = number.globalMatch(theirs); matches.hasNext();) {
        const auto match = matches.next();
        const bool two = !match.captured(2).isEmpty();
        ours += theirs.mid(end, match.capturedStart() - end);
        ours += (two ? "faces " : "face ") + face_of(match.captured(1));
        if (two) ours += " and " + face_of(match.captured(2));
        end = match.capturedEnd();
    }
    return (ours + theirs.mid(end)).toStdString();
}

} // namespace fairmesh_meshlab
