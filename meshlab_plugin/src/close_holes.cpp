// SPDX-License-Identifier: MIT OR Apache-2.0
#include "filled.h"
#include "report.h"
#include "work.h"
#include "write.h"

#include <algorithm>
#include <limits>

namespace fairmesh_meshlab {

namespace {

/** The vertices that are selected or belong to a selected face. */
Mask selected_vertices(const CMeshO &mesh, const MeshView &view) {
    Mask selected(mesh.vert.size(), 0);
    for (std::size_t i = 0; i < selected.size(); ++i) selected[i] = !mesh.vert[i].IsD() && mesh.vert[i].IsS();
    for (std::uint32_t triangle : view.selected())
        for (std::uint32_t v : view.triangles()[triangle]) selected[v] = 1;
    if (std::find(selected.begin(), selected.end(), 1) == selected.end())
        throw Failure("Holes at the selection: no face and no vertex is selected.");
    return selected;
}

/** All holes of the mesh but the longest so many, by their lengths: the length that a hole has to be below. */
double longest_allowed(const fairmesh::result &loops, std::size_t except) {
    std::vector<double> lengths;
    for (std::uint64_t i = 0; i < loops.info().loop_count; ++i) {
        const fairmesh_loop loop = loops.loop(i);
        if (loop.kind == FAIRMESH_LOOP_KIND_HOLE) lengths.push_back(loop.length);
    }
    std::sort(lengths.rbegin(), lengths.rend());
    if (except == 0) return std::numeric_limits<double>::infinity();
    return except <= lengths.size() ? lengths[except - 1] : 0;
}

/** The loops that are to be closed, by their numbers. Those that stay open for a reason that is not the user's wish are warned of. */
std::vector<std::uint32_t> chosen(const fairmesh::result &loops, const Mask &selected, const CloseParameters &asked, const Host &host) {
    std::vector<std::uint32_t> close;
    const bool all_at_selection = asked.join == JoinLoops::AtSelection;
    const double below = longest_allowed(loops, asked.except_longest);
    for (std::uint32_t i = 0; i < loops.info().loop_count; ++i) {
        const fairmesh_loop loop = loops.loop(i);
        const auto vertices = loops.list(FAIRMESH_LIST_LOOP_VERTICES, i);
        if (!selected.empty() && std::none_of(vertices.begin(), vertices.end(), [&](std::uint32_t v) { return selected[v] != 0; }))
            continue;
        if (loop.kind == FAIRMESH_LOOP_KIND_NON_MANIFOLD) {
            host.warn(text("Warning, the hole at vertex %u is left open: its boundary runs into the non-manifold edge (%u, %u).",
                           vertices.front(), loop.edge_a, loop.edge_b));
            continue;
        }
        const bool is_small =
            loop.vertex_count <= asked.fill.max_edges && loop.length < below && (asked.max_length == 0 || loop.length <= asked.max_length);
        if (all_at_selection || (is_small && (asked.outer_boundaries || loop.kind == FAIRMESH_LOOP_KIND_HOLE))) close.push_back(i);
    }
    return close;
}

/** The guides that are named, and the pair that is selected. */
void set_guides(const CMeshO &mesh, CloseParameters &asked) {
    auto guides = asked.guides;
    if (asked.guide_selected) {
        std::vector<std::uint32_t> pair;
        for (std::size_t i = 0; i < mesh.vert.size(); ++i)
            if (!mesh.vert[i].IsD() && mesh.vert[i].IsS()) pair.push_back(static_cast<std::uint32_t>(i));
        if (pair.size() != 2)
            throw Failure(text("Edge between the two selected vertices: %zu %s selected.", pair.size(), pair.size() == 1 ? "is" : "are"));
        guides.push_back({pair[0], pair[1]});
    }
    asked.fill.guide(guides);
}

} // namespace

Values close_holes(MeshModel &model, const MeshView &view, CloseParameters asked, const Host &host) {
    CMeshO &mesh = model.cm;
    const bool all_at_selection = asked.join == JoinLoops::AtSelection;
    const Mask selected = asked.touching_selection || all_at_selection ? selected_vertices(mesh, view) : Mask();
    const auto loops = fairmesh::boundary_loops(view.mesh());
    const std::vector<std::uint32_t> close = chosen(loops, selected, asked, host);
    if (all_at_selection && close.size() < 2)
        throw Failure(text("Joining all loops at the selection: there %s. Select vertices or faces of two loops or more.",
                           close.empty() ? "is none" : "is one alone"));
    if (close.empty()) {
        host.warn("Warning, no hole was found that is to be closed.");
        return {{"converged", true}, {"closed", 0},    {"left_open", 0},      {"not_fair", 0},        {"joined", 0},
                {"new_vertices", 0}, {"new_faces", 0}, {"moved_vertices", 0}, {"moved_largest", 0.0}, {"seconds_solve", 0.0}};
    }
    asked.fill.only(close);
    if (asked.join == JoinLoops::Auto) asked.fill.join_auto();
    set_guides(mesh, asked);
    if (all_at_selection) {
        asked.fill.only({});
        asked.fill.join_groups({close});
    }
    bool cancelled = false;
    asked.options.on_progress = shown(host, cancelled);
    const auto filled = fairmesh::fill_holes(view.mesh(), asked.fill, asked.options);
    if (cancelled) throw Failure(CANCELLED);

    write_patches(model, filled, view.triangles().size(), asked.selection);
    return told(filled, loops, asked.options.continuity > 0, host);
}

} // namespace fairmesh_meshlab
