// SPDX-License-Identifier: MIT OR Apache-2.0
#include "charts.h"
#include "filled.h"
#include "patch.h"
#include "report.h"
#include "work.h"
#include "write.h"

#include <algorithm>
#include <optional>

namespace fairmesh_meshlab {

namespace {

using Triangle = std::array<std::uint32_t, 3>;

/** What takes the place of which triangles. */
struct Change {
    /** Triangles of the view that stay, and that go, ascending. */
    std::vector<std::uint32_t> kept, gone;
    Patch patch;
};

Triangle in_order(Triangle triangle) {
    std::sort(triangle.begin(), triangle.end());
    return triangle;
}

/** The middles of triangles. */
std::vector<std::array<double, 3>> middles(const std::vector<std::array<double, 3>> &positions, const Triangle *first, std::size_t count) {
    std::vector<std::array<double, 3>> made(count);
    for (std::size_t i = 0; i < count; ++i)
        for (std::uint32_t v : first[i])
            for (int c = 0; c < 3; ++c) made[i][c] += positions[v][c] / 3;
    return made;
}

Change change(const CMeshO &mesh, const MeshView &view, const fairmesh::result &rounded) {
    const auto positions = rounded.positions();
    const auto triangles = rounded.triangles();
    const auto vertices = rounded.list(FAIRMESH_LIST_KEPT_VERTICES), sources = rounded.list(FAIRMESH_LIST_KEPT_TRIANGLES);
    auto number = [&](std::uint32_t v) {
        return v < vertices.size() ? vertices[v] : static_cast<std::uint32_t>(mesh.vert.size() + v - vertices.size());
    };
    Change made;
    made.patch = new_vertices(rounded, vertices.size());
    for (const CVertexO &vertex : mesh.vert) made.patch.old_positions.push_back(vertex.cP());
    // Triangles like which the new ones are, of the view.
    std::vector<std::uint32_t> like;
    std::vector<bool> stays(view.triangles().size(), false);
    for (std::size_t i = 0; i < sources.size(); ++i) {
        const Triangle now = {number(triangles[i][0]), number(triangles[i][1]), number(triangles[i][2])};
        if (in_order(now) == in_order(view.triangles()[sources[i]])) {
            stays[sources[i]] = true;
            continue;
        }
        made.patch.triangles.push_back(now);
        like.push_back(sources[i]);
    }
    for (std::uint32_t t = 0; t < stays.size(); ++t) (stays[t] ? made.kept : made.gone).push_back(t);
    const std::size_t blends = triangles.size() - sources.size();
    const auto centres = middles(positions, triangles.data() + sources.size(), blends);
    const auto nearest = fairmesh::carry_over(view.mesh(), made.gone, fairmesh::points(centres.data()->data(), centres.size()));
    for (std::size_t i = 0; i < blends; ++i) {
        const Triangle &now = triangles[sources.size() + i];
        made.patch.triangles.push_back({number(now[0]), number(now[1]), number(now[2])});
        like.push_back(nearest.triangles[i]);
    }
    for (std::uint32_t t : like) made.patch.like.push_back(view.face(t));
    if (!mesh.face.IsWedgeTexCoordEnabled()) return made;
    const double *first = positions.data()->data() + 3 * vertices.size();
    const auto places = fairmesh::carry_over(view.mesh(), made.gone, fairmesh::points(first, positions.size() - vertices.size()));
    const Charts charts(mesh, view, made.gone, places);
    for (std::size_t i = 0; i < made.patch.triangles.size(); ++i) {
        made.patch.wedges.emplace_back();
        for (int k = 0; k < 3; ++k) {
            const std::uint32_t v = made.patch.triangles[i][k];
            const std::size_t at = v - mesh.vert.size();
            made.patch.wedges[i][k] =
                v < mesh.vert.size() ? charts.at_old(v, like[i]) : charts.at_new(at, positions[vertices.size() + at], like[i]);
        }
    }
    return made;
}

/** The blends are selected then. `blends`: how many of the new triangles they are. */
void write(MeshModel &model, const MeshView &view, const Change &made, std::size_t blends) {
    CMeshO &mesh = model.cm;
    const int topology = model.dataMask() & (MeshModel::MM_FACEFACETOPO | MeshModel::MM_VERTFACETOPO);
    model.clearDataMask(topology);
    const Mask changed = add(mesh, made.patch);
    // New faces are made like those that go.
    Mask loose = delete_faces(mesh, view, made.kept);
    for (const Triangle &triangle : made.patch.triangles)
        for (std::uint32_t v : triangle)
            if (v < loose.size()) loose[v] = 0;
    select_new(mesh, blends, SelectionAfter::NewOnly);
    update_normals(mesh, changed, false);
    delete_vertices(mesh, loose);
    model.updateDataMask(topology);
}

/** How it went, in the log and as values. */
Values told(const fairmesh::result &made, double continuity, const Host &host) {
    const fairmesh_info info = made.info();
    const fairmesh_report report = made.report();
    int done = 0, unsolved = 0, narrow = 0;
    for (std::uint64_t i = 0; i < info.crease_count; ++i) {
        const fairmesh_crease crease = made.crease(i);
        done += crease.is_rounded != 0;
        unsolved += crease.is_unsolved != 0;
        if (crease.is_unsolved)
            host.warn(text("Warning, an edge stays sharp, as no sound blend was found: at (%.6g, %.6g, %.6g)", crease.unsolved[0],
                           crease.unsolved[1], crease.unsolved[2]));
        if (!crease.is_rounded || crease.part >= 1) continue;
        ++narrow;
        host.log(text("Narrower than asked, where there is less room: %.0f %% at (%.6g, %.6g, %.6g)", 100 * crease.part,
                      crease.narrowest[0], crease.narrowest[1], crease.narrowest[2]));
    }
    const auto corners = made.list(FAIRMESH_LIST_SHARP_CORNERS);
    for (std::uint32_t v : corners) host.warn(text("Warning, the corner at vertex %u stays sharp; blends end before it", v));
    const std::string but = reservation(report);
    if (!but.empty()) host.warn("Warning, the blends: " + but);
    log_continuity(made, continuity, host);
    log_sharp_edges(made, host, 0);
    host.log(text("Sharp edges from %.4g degrees on: %llu from corner to corner, %d of them rounded; new vertices %llu, new faces %llu",
                  info.crease_angle, static_cast<unsigned long long>(info.crease_count), done,
                  static_cast<unsigned long long>(info.new_vertex_count), static_cast<unsigned long long>(info.new_triangle_count)));
    return {{"converged", info.is_success != 0},
            {"outcome", static_cast<int>(report.outcome)},
            {"creases", static_cast<int>(info.crease_count)},
            {"rounded", done},
            {"unsolved", unsolved},
            {"narrowed", narrow},
            {"sharp_corners", static_cast<int>(corners.size())},
            {"angle", info.crease_angle},
            {"new_vertices", static_cast<int>(info.new_vertex_count)},
            {"new_faces", static_cast<int>(info.new_triangle_count)},
            {"defect", report.defect},
            {"iterations", static_cast<int>(report.iterations)},
            {"seconds_solve", report.seconds_total}};
}

} // namespace

Values round_edges(MeshModel &model, const MeshView &view, RoundParameters asked, const Host &host) {
    if (asked.which == Rounded::SelectedEdges) {
        if (view.selected_edges().empty()) throw Failure("No edge is selected. Apply 'Select Crease Edges', or round all sharp edges.");
        asked.how.only_edges = view.selected_edges();
    }
    bool cancelled = false;
    asked.options.on_progress = shown(host, cancelled);
    std::optional<fairmesh::result> rounded;
    try {
        rounded = fairmesh::round(view.mesh(), asked.how, asked.options);
    } catch (const fairmesh::error &) {
        if (cancelled) throw Failure(CANCELLED);
        throw;
    }
    const Change made = change(model.cm, view, *rounded);
    write(model, view, made, rounded->info().new_triangle_count);
    return told(*rounded, asked.options.continuity, host);
}

} // namespace fairmesh_meshlab
