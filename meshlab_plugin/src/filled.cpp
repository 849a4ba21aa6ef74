// SPDX-License-Identifier: MIT OR Apache-2.0
#include "filled.h"

#include "patch.h"
#include "report.h"

#include <vcg/complex/allocate.h>

#include <algorithm>
#include <numeric>

namespace fairmesh_meshlab {

namespace {

using Allocator = vcg::tri::Allocator<CMeshO>;

std::uint32_t first_vertex(const fairmesh::result &loops, std::uint64_t loop) {
    return loops.list(FAIRMESH_LIST_LOOP_VERTICES, loop).front();
}

/** Which hole, or which loops, by their vertices. */
std::string name_of(const fairmesh_fill_report &hole, const std::vector<std::uint32_t> &group, const fairmesh::result &loops) {
    const auto edges = static_cast<unsigned long long>(hole.edge_count);
    std::string name = text("hole of %llu edges at vertex %u", edges, first_vertex(loops, hole.loop_index));
    if (group.size() < 2) return name;
    name = text("%zu loops of %llu edges at vertices %u", group.size(), edges, first_vertex(loops, group[0]));
    const std::size_t shown = std::min<std::size_t>(group.size(), 8);
    for (std::size_t k = 1; k < shown; ++k) name += text(", %u", first_vertex(loops, group[k]));
    return name + (shown < group.size() ? ", ..." : "");
}

/** Which two loops face opposite ways, and what to do. */
std::string opposite(const fairmesh_fill_report &hole, const fairmesh::result &loops) {
    return text(" These are the loops at vertices %u and %u: select the faces of one of the two parts and apply 'Invert Faces "
                "Orientation'.",
                first_vertex(loops, hole.reason_element), first_vertex(loops, hole.reason_other));
}

/** What is wrong with the faces around a hole whose vertices moved; empty if nothing is. */
std::string relaxed(const fairmesh_fill_report &hole) {
    if (hole.moved_unsound == 0) return "";
    return text(" %llu old faces beside it are folded or intersect since their vertices moved: let more of them move, or less far.",
                static_cast<unsigned long long>(hole.moved_unsound));
}

} // namespace

Values told(const fairmesh::result &filled, const fairmesh::result &loops, double continuity, const Host &host) {
    const fairmesh_info info = filled.info();
    int open = 0, unfair = 0, joined = 0;
    std::uint64_t moved = 0;
    double moved_largest = 0;
    // Of the first hole that did not become fair.
    std::uint32_t outcome = FAIRMESH_FILL_OUTCOME_FAIRED, fairing = FAIRMESH_OUTCOME_CONVERGED;
    double defect = 0, solve = 0;
    std::uint64_t iterations = 0;
    for (std::uint64_t i = 0; i < info.loop_count; ++i) {
        const fairmesh_fill_report hole = filled.fill_report(i);
        std::string but = reservation(hole);
        const bool fair = hole.is_success && hole.outcome != FAIRMESH_FILL_OUTCOME_LEFT_OPEN;
        if (hole.has_report) {
            const fairmesh_report report = filled.report(i);
            defect = std::max(defect, report.defect);
            iterations = std::max(iterations, report.iterations);
            if (report.outcome != FAIRMESH_OUTCOME_CONVERGED && but.empty()) but = "closed; " + reservation(report);
            if (open + unfair == 0 && !fair) fairing = report.outcome;
        }
        if (hole.has_relaxed) {
            moved += hole.moved_count;
            moved_largest = std::max(moved_largest, hole.moved_largest);
            but += relaxed(hole);
        }
        if (open + unfair == 0 && !fair) outcome = hole.outcome;
        solve += hole.seconds;
        open += hole.outcome == FAIRMESH_FILL_OUTCOME_LEFT_OPEN;
        unfair += hole.outcome != FAIRMESH_FILL_OUTCOME_LEFT_OPEN && !fair;
        const auto group = filled.list(FAIRMESH_LIST_JOINED_LOOPS, i);
        const std::string which = name_of(hole, group, loops);
        if (hole.outcome != FAIRMESH_FILL_OUTCOME_LEFT_OPEN && group.size() > 1) joined += static_cast<int>(group.size());
        if (hole.reason == FAIRMESH_FILL_REASON_OPPOSITE_SIDES) but += opposite(hole, loops);
        if (!but.empty()) host.warn("Warning, " + which + ": " + but);
        if (hole.has_report) log_continuity(filled, continuity, host, i);
        if (hole.has_report) log_sharp_edges(filled, host, i);
    }
    const int closed = static_cast<int>(info.loop_count) - open;
    if (joined > 0) host.log(text("Loops that share a patch with others: %d", joined));
    host.log(text("Holes closed: %d, with %llu new vertices and %llu new faces; left open: %d; not fair: %d", closed,
                  static_cast<unsigned long long>(info.new_vertex_count), static_cast<unsigned long long>(info.new_triangle_count), open,
                  unfair));
    if (moved > 0)
        host.log(
            text("Old vertices around the holes that moved: %llu, by %.4g at most", static_cast<unsigned long long>(moved), moved_largest));
    return {{"converged", info.is_success != 0},
            {"outcome", static_cast<int>(fairing)},
            {"fill_outcome", static_cast<int>(outcome)},
            {"closed", closed},
            {"left_open", open},
            {"not_fair", unfair},
            {"joined", joined},
            {"new_vertices", static_cast<int>(info.new_vertex_count)},
            {"new_faces", static_cast<int>(info.new_triangle_count)},
            {"moved_vertices", static_cast<int>(moved)},
            {"moved_largest", moved_largest},
            {"defect", defect},
            {"iterations", static_cast<int>(iterations)},
            {"seconds_solve", solve}};
}

Triangles some_of(const MeshView &view, const std::vector<std::uint32_t> &kept) {
    Triangles triangles;
    triangles.reserve(kept.size());
    for (std::uint32_t t : kept) triangles.push_back(view.triangles()[t]);
    return triangles;
}

fairmesh_mesh with_triangles(const MeshView &view, const Triangles &triangles) {
    fairmesh_mesh mesh = view.mesh();
    mesh.triangles = fairmesh::indices(triangles.empty() ? nullptr : triangles.front().data(), triangles.size());
    return mesh;
}

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

void delete_vertices(CMeshO &mesh, const Mask &loose) {
    for (std::size_t v = 0; v < loose.size(); ++v)
        if (loose[v] && !mesh.vert[v].IsD()) Allocator::DeleteVertex(mesh, mesh.vert[v]);
    Allocator::CompactEveryVector(mesh);
}

void write_patches(MeshModel &model, const MeshView &view, const std::vector<std::uint32_t> &kept, const fairmesh::result &filled,
                   SelectionAfter wish) {
    CMeshO &mesh = model.cm;
    const Patch patch = patch_of(filled, kept.size(), mesh);
    const bool deletes = kept.size() < view.triangles().size();
    const int topology = model.dataMask() & (MeshModel::MM_FACEFACETOPO | MeshModel::MM_VERTFACETOPO);
    if (deletes) model.clearDataMask(topology);
    const Mask loose = deletes ? delete_faces(mesh, view, kept) : Mask();
    const Mask changed = add(mesh, patch);
    select_new(mesh, patch.triangles.size(), wish);
    update_normals(mesh, changed, false);
    if (deletes) delete_vertices(mesh, loose);
    // Adjacency that the mesh carries has to know the new faces.
    model.updateDataMask(topology);
}

void write_patches(MeshModel &model, const MeshView &view, const fairmesh::result &filled, SelectionAfter wish) {
    std::vector<std::uint32_t> all(view.triangles().size());
    std::iota(all.begin(), all.end(), 0);
    write_patches(model, view, all, filled, wish);
}

void select_new(CMeshO &mesh, std::size_t count, SelectionAfter wish) {
    if (wish == SelectionAfter::AsBefore) return;
    const std::size_t first = mesh.face.size() - count;
    for (std::size_t i = 0; i < mesh.face.size(); ++i) {
        if (mesh.face[i].IsD()) continue;
        if (i >= first) mesh.face[i].SetS();
        else if (wish == SelectionAfter::NewOnly) mesh.face[i].ClearS();
    }
}

} // namespace fairmesh_meshlab
