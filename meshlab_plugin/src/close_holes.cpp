// SPDX-License-Identifier: MIT OR Apache-2.0
#include "patch.h"
#include "report.h"
#include "work.h"
#include "write.h"

#include <algorithm>

namespace fairmesh_meshlab {

namespace {

/** The vertices that are selected or belong to a selected face. */
Mask selected_vertices(const CMeshO &mesh, const MeshView &view) {
    Mask selected(mesh.vert.size(), 0);
    for (std::size_t i = 0; i < selected.size(); ++i) selected[i] = !mesh.vert[i].IsD() && mesh.vert[i].IsS();
    for (std::uint32_t triangle : view.selected())
        for (std::uint32_t v : view.triangles()[triangle]) selected[v] = 1;
    if (std::find(selected.begin(), selected.end(), 1) == selected.end())
        throw Failure("Only holes at the selection: no face and no vertex is selected.");
    return selected;
}

/** The loops that are to be closed, by their numbers. Those that stay open for a reason that is not the user's wish are warned of. */
std::vector<std::uint32_t> chosen(const fairmesh::result &loops, const Mask &selected, const CloseParameters &asked, const Host &host) {
    std::vector<std::uint32_t> close;
    for (std::uint32_t i = 0; i < loops.info().loop_count; ++i) {
        const fairmesh_loop loop = loops.loop(i);
        const auto vertices = loops.list(FAIRMESH_LIST_LOOP_VERTICES, i);
        if (asked.touching_selection && std::none_of(vertices.begin(), vertices.end(), [&](std::uint32_t v) { return selected[v] != 0; }))
            continue;
        if (loop.kind == FAIRMESH_LOOP_KIND_NON_MANIFOLD)
            host.warn(text("Warning, the hole at vertex %u is left open: its boundary runs into the non-manifold edge (%u, %u).",
                           vertices.front(), loop.edge_a, loop.edge_b));
        else if (loop.vertex_count <= asked.fill.max_edges && (asked.outer_boundaries || loop.kind == FAIRMESH_LOOP_KIND_HOLE))
            close.push_back(i);
    }
    return close;
}

/** What became of the holes, in the log and as values. */
Values told(const fairmesh::result &filled, const fairmesh::result &loops, bool continues_curvature, const Host &host) {
    const fairmesh_info info = filled.info();
    int open = 0, unfair = 0;
    // Of the first hole that did not become fair.
    std::uint32_t outcome = FAIRMESH_FILL_OUTCOME_FAIRED, fairing = FAIRMESH_OUTCOME_CONVERGED;
    double defect = 0, solve = 0;
    std::uint64_t iterations = 0;
    for (std::uint64_t i = 0; i < info.loop_count; ++i) {
        const fairmesh_fill_report hole = filled.fill_report(i);
        std::string but = reservation(hole);
        bool fair = hole.outcome == FAIRMESH_FILL_OUTCOME_FAIRED || hole.reason == FAIRMESH_FILL_REASON_NO_INNER_VERTEX;
        if (hole.has_report) {
            const fairmesh_report report = filled.report(i);
            defect = std::max(defect, report.defect);
            iterations = std::max(iterations, report.iterations);
            if (report.outcome != FAIRMESH_OUTCOME_CONVERGED && but.empty()) but = "closed; " + reservation(report);
            fair = fair && report.outcome == FAIRMESH_OUTCOME_CONVERGED;
            if (open + unfair == 0 && !fair) fairing = report.outcome;
        }
        if (open + unfair == 0 && !fair) outcome = hole.outcome;
        solve += hole.seconds;
        open += hole.outcome == FAIRMESH_FILL_OUTCOME_LEFT_OPEN;
        unfair += hole.outcome != FAIRMESH_FILL_OUTCOME_LEFT_OPEN && !fair;
        const auto boundary = loops.list(FAIRMESH_LIST_LOOP_VERTICES, hole.loop_index);
        const std::string which =
            text("hole of %llu edges at vertex %u", static_cast<unsigned long long>(hole.edge_count), boundary.front());
        if (!but.empty()) host.warn("Warning, " + which + ": " + but);
        if (continues_curvature && hole.has_report) log_continuity(filled, host, i);
    }
    const int closed = static_cast<int>(info.loop_count) - open;
    host.log(text("Holes closed: %d, with %llu new vertices and %llu new faces; left open: %d; not fair: %d", closed,
                  static_cast<unsigned long long>(info.new_vertex_count), static_cast<unsigned long long>(info.new_triangle_count), open,
                  unfair));
    return {{"converged", open + unfair == 0},
            {"outcome", static_cast<int>(fairing)},
            {"fill_outcome", static_cast<int>(outcome)},
            {"closed", closed},
            {"left_open", open},
            {"not_fair", unfair},
            {"new_vertices", static_cast<int>(info.new_vertex_count)},
            {"new_faces", static_cast<int>(info.new_triangle_count)},
            {"defect", defect},
            {"iterations", static_cast<int>(iterations)},
            {"seconds_solve", solve}};
}

/** Selects as the user wishes. The last `count` faces are new. */
void select(CMeshO &mesh, std::size_t count, SelectionAfter wish) {
    if (wish == SelectionAfter::AsBefore) return;
    const std::size_t first = mesh.face.size() - count;
    for (std::size_t i = 0; i < mesh.face.size(); ++i) {
        if (mesh.face[i].IsD()) continue;
        if (i >= first) mesh.face[i].SetS();
        else if (wish == SelectionAfter::NewOnly) mesh.face[i].ClearS();
    }
}

} // namespace

Values close_holes(MeshModel &model, const MeshView &view, CloseParameters asked, const Host &host) {
    CMeshO &mesh = model.cm;
    const Mask selected = asked.touching_selection ? selected_vertices(mesh, view) : Mask();
    const auto loops = fairmesh::boundary_loops(view.mesh());
    const std::vector<std::uint32_t> close = chosen(loops, selected, asked, host);
    if (close.empty()) {
        host.warn("Warning, no hole was found that is to be closed.");
        return {{"converged", true}, {"closed", 0},    {"left_open", 0},      {"not_fair", 0},
                {"new_vertices", 0}, {"new_faces", 0}, {"seconds_solve", 0.0}};
    }
    asked.fill.loops = fairmesh::indices(close.data(), close.size());
    bool cancelled = false;
    asked.options.on_progress = shown(host, cancelled);
    const auto filled = fairmesh::fill_holes(view.mesh(), asked.fill, asked.options);
    if (cancelled) throw Failure(CANCELLED);

    const Patch patch = patch_of(filled, view, mesh);
    const Mask made = add(mesh, patch);
    select(mesh, patch.triangles.size(), asked.selection);
    // Adjacency that the mesh carries has to know the new faces.
    model.updateDataMask(model.dataMask() & (MeshModel::MM_FACEFACETOPO | MeshModel::MM_VERTFACETOPO));
    update_normals(mesh, made, false);
    return told(filled, loops, asked.options.continuity > 0, host);
}

} // namespace fairmesh_meshlab
