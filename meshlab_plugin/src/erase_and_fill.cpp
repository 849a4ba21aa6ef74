// SPDX-License-Identifier: MIT OR Apache-2.0
#include "filled.h"
#include "patch.h"
#include "report.h"
#include "work.h"
#include "write.h"

#include <vcg/complex/allocate.h>

namespace fairmesh_meshlab {

namespace {

using Allocator = vcg::tri::Allocator<CMeshO>;

/** Deletes the faces that are not kept; their vertices that no face has any more, too, but not yet. */
Mask delete_faces(CMeshO &mesh, const MeshView &view, const std::vector<std::uint32_t> &kept) {
    Mask loose(mesh.vert.size(), 0);
    auto next = kept.begin();
    for (std::uint32_t t = 0; t < view.triangles().size(); ++t) {
        if (next != kept.end() && *next == t) {
            ++next;
            continue;
        }
        Allocator::DeleteFace(mesh, mesh.face[view.face(t)]);
        for (std::uint32_t v : view.triangles()[t]) loose[v] = 1;
    }
    for (std::uint32_t t : kept)
        for (std::uint32_t v : view.triangles()[t]) loose[v] = 0;
    return loose;
}

/** Nothing is filled that would be left open, or would close an open surface. */
void object(const fairmesh::result &loops, const std::vector<std::uint32_t> &left, bool outer_boundaries) {
    if (left.empty()) throw Failure("Nothing is left around the selected faces that a new surface could go on from.");
    for (std::uint32_t loop : left)
        if (!outer_boundaries && loops.loop(loop).kind == FAIRMESH_LOOP_KIND_OUTER_BOUNDARY)
            throw Failure("The selected faces lie at the outer boundary of an open surface, which would be closed: deselect those there, "
                          "or check 'Outer boundaries of open surfaces, too'.");
}

} // namespace

Values erase_and_fill(MeshModel &model, const MeshView &view, CloseParameters asked, const Host &host) {
    CMeshO &mesh = model.cm;
    if (view.selected().empty()) throw Failure("No face is selected. Select the faces that are to be replaced.");
    const auto left = fairmesh::erase(view.mesh(), view.selected());
    std::vector<std::array<std::uint32_t, 3>> triangles;
    triangles.reserve(left.kept.size());
    for (std::uint32_t t : left.kept) triangles.push_back(view.triangles()[t]);
    fairmesh_mesh open = view.mesh();
    open.triangles = fairmesh::indices(triangles.empty() ? nullptr : triangles.front().data(), triangles.size());
    const auto loops = fairmesh::boundary_loops(open);
    object(loops, left.loops, asked.outer_boundaries);
    asked.fill.only(left.loops);
    bool cancelled = false;
    asked.options.on_progress = shown(host, cancelled);
    const auto filled = fairmesh::fill_holes(open, asked.fill, asked.options);
    if (cancelled) throw Failure(CANCELLED);
    for (std::uint64_t i = 0; i < filled.info().loop_count; ++i) {
        const fairmesh_fill_report hole = filled.fill_report(i);
        // The old faces are better than none.
        if (hole.outcome == FAIRMESH_FILL_OUTCOME_LEFT_OPEN)
            throw Failure(text("The hole of %llu edges where the faces are would be %s", static_cast<unsigned long long>(hole.edge_count),
                               reservation(hole).c_str()));
    }

    const Patch patch = patch_of(filled, triangles.size(), mesh);
    const int topology = model.dataMask() & (MeshModel::MM_FACEFACETOPO | MeshModel::MM_VERTFACETOPO);
    model.clearDataMask(topology);
    const Mask loose = delete_faces(mesh, view, left.kept);
    const Mask made = add(mesh, patch);
    select_new(mesh, patch.triangles.size(), SelectionAfter::NewOnly);
    update_normals(mesh, made, false);
    for (std::size_t v = 0; v < loose.size(); ++v)
        if (loose[v] && !mesh.vert[v].IsD()) Allocator::DeleteVertex(mesh, mesh.vert[v]);
    // As the host's own filters that delete: its scripts read compact meshes only.
    Allocator::CompactEveryVector(mesh);
    model.updateDataMask(topology);
    Values values = told(filled, loops, asked.options.continuity > 0, host);
    const std::size_t erased = view.triangles().size() - triangles.size();
    host.log(text("Faces erased: %zu, of which %llu were not selected and would have hung loose", erased,
                  static_cast<unsigned long long>(left.dropped)));
    values["erased_faces"] = static_cast<int>(erased);
    return values;
}

} // namespace fairmesh_meshlab
