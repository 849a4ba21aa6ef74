// SPDX-License-Identifier: MIT OR Apache-2.0
#include "given_normals.h"
#include "report.h"
#include "work.h"
#include "write.h"

namespace fairmesh_meshlab {

fairmesh::progress shown(const Host &host, bool &cancelled) {
    if (!host.progress) return {};
    return [progress = host.progress, &cancelled](const fairmesh_progress &how_far) {
        // The library may tell more before it ends; a host that has once said no is not asked again.
        cancelled = cancelled || !progress(static_cast<int>(100 * how_far.fraction), how_far.phase);
        return !cancelled;
    };
}

namespace {

/** Sets the boundary normals of the options; `given` keeps the vectors. */
void choose_normals(CMeshO &mesh, FairParameters &asked, Vectors &given) {
    auto &normals = asked.options.boundary_normals;
    switch (asked.normals) {
    case BoundaryNormals::Fitted: normals.kind = FAIRMESH_BOUNDARY_NORMALS_KIND_FITTED; return;
    case BoundaryNormals::Averaged: normals.kind = FAIRMESH_BOUNDARY_NORMALS_KIND_AVERAGED; return;
    case BoundaryNormals::VertexNormals: given = vertex_normals(mesh); break;
    case BoundaryNormals::Attribute: given = attribute_normals(mesh, asked.attribute); break;
    }
    normals.kind = FAIRMESH_BOUNDARY_NORMALS_KIND_GIVEN;
    normals.vectors = fairmesh::points(given.front().data(), given.size());
}

} // namespace

Values fair_selection(MeshModel &model, const MeshView &view, FairParameters asked, const Host &host) {
    CMeshO &mesh = model.cm;
    if (view.selected().empty())
        throw Failure("No face is selected. Select the faces of the region to be faired, or close a hole with its faces selected.");
    Vectors given;
    choose_normals(mesh, asked, given);
    std::vector<std::uint32_t> corners;
    for (std::uint32_t triangle : view.selected())
        for (std::uint32_t v : view.triangles()[triangle]) corners.push_back(v);
    scale_bulge(asked.options, view.diagonal(corners));
    view.mark_edges(asked.options);
    bool cancelled = false;
    asked.options.on_progress = shown(host, cancelled);

    const auto result = fairmesh::fair(view.mesh(), fairmesh::faces(view.selected()), asked.options);
    if (cancelled) throw Failure(CANCELLED);
    const fairmesh_report report = result.report();
    const auto positions = rounded(mesh, result.positions());
    std::vector<double> curvature;
    if (asked.curvature_to_quality) curvature = result.scalars(FAIRMESH_SCALARS_MEAN_CURVATURE);

    const Mask moved = write_positions(mesh, positions);
    update_normals(mesh, moved, asked.normals == BoundaryNormals::VertexNormals);
    if (asked.curvature_to_quality) write_quality(model, curvature);
    log_report(report, view, host);
    log_components(result, host);
    log_continuity(result, asked.options.continuity, host);
    log_sharp_edges(result, host);
    return values_of(report, view);
}

} // namespace fairmesh_meshlab
