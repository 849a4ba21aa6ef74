// SPDX-License-Identifier: MIT OR Apache-2.0
#include "filled.h"
#include "report.h"
#include "work.h"
#include "write.h"

#include <algorithm>

namespace fairmesh_meshlab {

namespace {

/** Vertices of a boundary, one after the other. */
using Stretch = std::vector<std::uint32_t>;

/** The boundary vertices that are selected; where there are none, those of selected faces. */
Mask marked(const CMeshO &mesh, const MeshView &view, const fairmesh::result &loops) {
    Mask vertices(mesh.vert.size(), 0);
    bool any = false;
    for (std::uint64_t i = 0; i < loops.info().loop_count; ++i)
        for (std::uint32_t v : loops.list(FAIRMESH_LIST_LOOP_VERTICES, i)) {
            vertices[v] = mesh.vert[v].IsS();
            any = any || vertices[v];
        }
    if (any) return vertices;
    for (std::uint32_t triangle : view.selected())
        for (std::uint32_t v : view.triangles()[triangle]) vertices[v] = 1;
    return vertices;
}

/** The stretches of marked vertices of a loop. */
std::vector<Stretch> stretches_of(const std::vector<std::uint32_t> &loop, const Mask &marked) {
    const auto gap = std::find_if(loop.begin(), loop.end(), [&](std::uint32_t v) { return !marked[v]; });
    if (gap == loop.end())
        throw Failure(text("All of the boundary at vertex %u is selected. Select a part of it, or apply 'Fairmesh: Close Holes' with 'Join "
                           "loops' to connect whole boundaries.",
                           loop.front()));
    std::vector<Stretch> found;
    bool open = false;
    const std::size_t start = gap - loop.begin();
    for (std::size_t k = 0; k < loop.size(); ++k) {
        const std::uint32_t v = loop[(start + k) % loop.size()];
        if (marked[v] && !open) found.push_back({});
        if (marked[v]) found.back().push_back(v);
        open = marked[v] != 0;
    }
    return found;
}

/** The two stretches that the selection means. */
std::array<Stretch, 2> chosen(const CMeshO &mesh, const MeshView &view, bool has_width) {
    const auto loops = fairmesh::boundary_loops(view.mesh());
    const Mask vertices = marked(mesh, view, loops);
    std::vector<Stretch> edges, all;
    for (std::uint64_t i = 0; i < loops.info().loop_count; ++i)
        for (Stretch &stretch : stretches_of(loops.list(FAIRMESH_LIST_LOOP_VERTICES, i), vertices)) {
            if (stretch.size() > 1) edges.push_back(stretch);
            all.push_back(std::move(stretch));
        }
    // A selected face may touch the boundary in a vertex only. With a width one vertex is enough.
    const auto &meant = edges.size() == 2 || !has_width ? edges : all;
    if (meant.size() == 2) return {meant[0], meant[1]};
    throw Failure(text("Select two stretches of boundary, by their vertices or by the faces there: %zu %s selected. They may be on one "
                       "boundary or on two.",
                       meant.size(), meant.size() == 1 ? "is" : "are"));
}

/** How it went, in the log and as values. */
Values told(const fairmesh::result &bridged, const Host &host) {
    const fairmesh_bridge_report bridge = bridged.bridge_report();
    const fairmesh_fill_report strip = bridged.fill_report(0);
    const fairmesh_info info = bridged.info();
    int closed = 0, open = 0;
    double seconds = strip.seconds;
    for (std::uint64_t i = 1; i <= bridge.rest_count; ++i) {
        const fairmesh_fill_report hole = bridged.fill_report(i);
        (hole.outcome == FAIRMESH_FILL_OUTCOME_LEFT_OPEN ? open : closed) += 1;
        seconds += hole.seconds;
        const std::string but = info.is_success ? "" : reservation(hole);
        if (!but.empty())
            host.warn(text("Warning, beside the bridge, hole of %llu edges: ", static_cast<unsigned long long>(hole.edge_count)) + but);
    }
    Values values = {{"converged", info.is_success != 0},
                     {"fill_outcome", static_cast<int>(strip.outcome)},
                     {"twist", bridge.twist},
                     {"closed", closed},
                     {"left_open", open},
                     {"new_vertices", static_cast<int>(info.new_vertex_count)},
                     {"new_faces", static_cast<int>(info.new_triangle_count)},
                     {"seconds_solve", seconds}};
    host.log(text("Bridge from %zu vertices to %zu, twisted by %.1f degrees: %llu new vertices and %llu new faces; holes closed beside "
                  "it: %d; left open: %d",
                  bridged.list(FAIRMESH_LIST_BRIDGE_CHAIN, 0).size(), bridged.list(FAIRMESH_LIST_BRIDGE_CHAIN, 1).size(), bridge.twist,
                  static_cast<unsigned long long>(info.new_vertex_count), static_cast<unsigned long long>(info.new_triangle_count), closed,
                  open));
    if (bridge.has_whole || strip.has_report) {
        const fairmesh_report report = bridged.report(bridge.has_whole ? 1 + bridge.rest_count : 0);
        values["outcome"] = static_cast<int>(report.outcome);
        values["defect"] = report.defect;
        values["iterations"] = static_cast<int>(report.iterations);
        const std::string but = info.is_success ? "" : reservation(report);
        if (!but.empty()) host.warn(std::string("Warning, ") + (bridge.has_whole ? "all of it together: " : "the bridge: ") + but);
    }
    const std::string but = info.is_success ? "" : reservation(strip);
    if (!but.empty()) host.warn("Warning, the bridge: " + but);
    return values;
}

} // namespace

Values bridge_boundaries(MeshModel &model, const MeshView &view, BridgeParameters asked, const Host &host) {
    const auto ends = chosen(model.cm, view, asked.how.width > 0);
    std::vector<std::uint32_t> both = ends[0];
    both.insert(both.end(), ends[1].begin(), ends[1].end());
    scale_bulge(asked.options, view.diagonal(both));
    view.mark_edges(asked.options);
    bool cancelled = false;
    asked.options.on_progress = shown(host, cancelled);
    const auto bridged = fairmesh::bridge(view.mesh(), ends[0], ends[1], asked.how, asked.fill, asked.options);
    if (cancelled) throw Failure(CANCELLED);
    const fairmesh_fill_report strip = bridged.fill_report(0);
    if (strip.outcome == FAIRMESH_FILL_OUTCOME_LEFT_OPEN) {
        const bool turned = strip.reason == FAIRMESH_FILL_REASON_OPPOSITE_SIDES;
        throw Failure(text("No bridge was made: %s.%s", fairmesh::meaning(FAIRMESH_ANSWER_FILL_REASON, strip.reason),
                           turned ? " Select the faces of one of the two parts and apply 'Invert Faces Orientation'." : ""));
    }
    write_patches(model, view, bridged, SelectionAfter::NewOnly);
    return told(bridged, host);
}

} // namespace fairmesh_meshlab
