// SPDX-License-Identifier: MIT OR Apache-2.0
#include "filled.h"
#include "report.h"
#include "work.h"
#include "write.h"

#include <algorithm>
#include <limits>
#include <numeric>

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

/** The largest of the loops, or that of all of them together. */
double size_of(const fairmesh::result &loops, const std::vector<std::uint32_t> &close, bool together, const MeshView &view) {
    double largest = 0;
    std::vector<std::uint32_t> all;
    for (std::uint32_t i : close) {
        const auto vertices = loops.list(FAIRMESH_LIST_LOOP_VERTICES, i);
        largest = std::max(largest, view.diagonal(vertices));
        all.insert(all.end(), vertices.begin(), vertices.end());
    }
    return together ? view.diagonal(all) : largest;
}

/** The loops that are to be closed, by their numbers. Those that stay open for a reason that is not the user's wish are warned of and
 * counted. */
std::vector<std::uint32_t> chosen(const fairmesh::result &loops, const Mask &selected, const CloseParameters &asked, const MeshView &view,
                                  const Host &host, int &passed_over) {
    std::vector<std::uint32_t> close;
    const bool all_at_selection = asked.join == JoinLoops::AtSelection;
    const double below = longest_allowed(loops, asked.except_longest);
    for (std::uint32_t i = 0; i < loops.info().loop_count; ++i) {
        const fairmesh_loop loop = loops.loop(i);
        const auto vertices = loops.list(FAIRMESH_LIST_LOOP_VERTICES, i);
        if (!selected.empty() && std::none_of(vertices.begin(), vertices.end(), [&](std::uint32_t v) { return selected[v] != 0; }))
            continue;
        if (loop.kind == FAIRMESH_LOOP_KIND_NON_MANIFOLD) {
            host.warn(text("Warning, the hole at vertex %u is left open: its boundary runs into the edge (%u, %u), where faces do not fit.",
                           vertices.front(), loop.edge_a, loop.edge_b));
            ++passed_over;
            continue;
        }
        const auto within = [](double is, double most) { return most == 0 || is <= most; };
        const bool is_small = loop.vertex_count <= asked.fill.max_edges && loop.length < below && within(loop.length, asked.max_length) &&
                              within(loop.area, asked.max_area) && within(view.diagonal(vertices), asked.max_diagonal);
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

/** The holes that are to be closed, on what is left of the mesh after trimming. */
struct Opened {
    std::vector<std::uint32_t> kept;
    Triangles triangles;
    fairmesh::result loops;
    std::vector<std::uint32_t> close;
    double area = 0;
    /** Holes that no patch can close. */
    int passed_over = 0;
};

/** The loops that became of others, by their vertices and those of the triangles that were trimmed away there. */
std::vector<std::uint32_t> successors(const fairmesh::result &loops, const std::vector<std::uint32_t> &close, const MeshView &view,
                                      const std::vector<std::uint32_t> &kept, const fairmesh::result &trimmed) {
    Mask is_at_loop(view.mesh().positions.count, 0);
    for (std::uint32_t i : close)
        for (std::uint32_t v : loops.list(FAIRMESH_LIST_LOOP_VERTICES, i)) is_at_loop[v] = 1;
    std::size_t next = 0;
    for (std::uint32_t t = 0; t < view.triangles().size(); ++t) {
        if (next < kept.size() && kept[next] == t) {
            ++next;
            continue;
        }
        for (std::uint32_t v : view.triangles()[t]) is_at_loop[v] = 1;
    }
    std::vector<std::uint32_t> found;
    for (std::uint32_t i = 0; i < trimmed.info().loop_count; ++i) {
        const auto vertices = trimmed.list(FAIRMESH_LIST_LOOP_VERTICES, i);
        const bool is_near = std::all_of(vertices.begin(), vertices.end(), [&](std::uint32_t v) { return is_at_loop[v] != 0; });
        if (is_near && trimmed.loop(i).kind != FAIRMESH_LOOP_KIND_NON_MANIFOLD) found.push_back(i);
    }
    return found;
}

/** Chooses the holes, and trims the mesh there. */
Opened opened(const MeshView &view, const Mask &selected, const CloseParameters &asked, const Host &host) {
    Opened made;
    made.loops = fairmesh::boundary_loops(view.mesh());
    made.close = chosen(made.loops, selected, asked, view, host, made.passed_over);
    if (asked.trim.triangles > 0 && !made.close.empty()) {
        auto trimmed = fairmesh::trim_boundary(view.mesh(), made.close, asked.trim);
        made.kept = std::move(trimmed.kept);
        made.area = trimmed.area;
        made.triangles = some_of(view, made.kept);
        auto loops = fairmesh::boundary_loops(with_triangles(view, made.triangles));
        made.close = successors(made.loops, made.close, view, made.kept, loops);
        made.loops = std::move(loops);
        if (trimmed.dropped > 0)
            host.log(text("Faces at the holes that were taken away: %llu, of area %.4g", static_cast<unsigned long long>(trimmed.dropped),
                          trimmed.area));
    } else {
        made.kept.resize(view.triangles().size());
        std::iota(made.kept.begin(), made.kept.end(), 0);
        made.triangles = view.triangles();
    }
    return made;
}

} // namespace

Values close_holes(MeshModel &model, const MeshView &view, CloseParameters asked, const Host &host) {
    CMeshO &mesh = model.cm;
    const bool all_at_selection = asked.join == JoinLoops::AtSelection;
    const Mask selected = asked.touching_selection || all_at_selection ? selected_vertices(mesh, view) : Mask();
    const Opened open = opened(view, selected, asked, host);
    const std::vector<std::uint32_t> &close = open.close;
    if (all_at_selection && close.size() < 2)
        throw Failure(text("Joining all loops at the selection: there %s. Select vertices or faces of two loops or more.",
                           close.empty() ? "is none" : "is one alone"));
    if (close.empty()) {
        host.warn("Warning, no hole was found that is to be closed.");
        return {{"converged", open.passed_over == 0},
                {"closed", 0},
                {"left_open", open.passed_over},
                {"not_fair", 0},
                {"joined", 0},
                {"new_vertices", 0},
                {"new_faces", 0},
                {"moved_vertices", 0},
                {"moved_largest", 0.0},
                {"seconds_solve", 0.0}};
    }
    asked.fill.only(close);
    if (asked.join == JoinLoops::Auto) asked.fill.join_auto();
    set_guides(mesh, asked);
    if (all_at_selection) {
        asked.fill.only({});
        asked.fill.join_groups({close});
    }
    scale_bulge(asked.options, size_of(open.loops, close, all_at_selection, view));
    view.mark_edges(asked.options);
    bool cancelled = false;
    asked.options.on_progress = shown(host, cancelled);
    const auto filled = fairmesh::fill_holes(with_triangles(view, open.triangles), asked.fill, asked.options);
    if (cancelled) throw Failure(CANCELLED);

    write_patches(model, view, open.kept, filled, asked.selection);
    Values values = told(filled, open.loops, asked.options.continuity, host);
    if (open.passed_over > 0) {
        values["converged"] = false;
        values["left_open"] = values["left_open"].toInt() + open.passed_over;
        host.log(text("Holes left open besides, as no patch can close them: %d", open.passed_over));
    }
    if (open.kept.size() < view.triangles().size() && !values["converged"].toBool()) host.log(OLD_NUMBERS);
    values["trimmed_faces"] = static_cast<int>(view.triangles().size() - open.kept.size());
    values["trimmed_area"] = open.area;
    return values;
}

} // namespace fairmesh_meshlab
