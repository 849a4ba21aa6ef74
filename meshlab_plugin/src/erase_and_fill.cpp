// SPDX-License-Identifier: MIT OR Apache-2.0
#include "filled.h"
#include "report.h"
#include "work.h"

namespace fairmesh_meshlab {

namespace {

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
    if (view.selected().empty()) throw Failure("No face is selected. Select the faces that are to be replaced.");
    const auto left = fairmesh::erase(view.mesh(), view.selected(), asked.clean);
    const auto triangles = some_of(view, left.kept);
    const fairmesh_mesh open = with_triangles(view, triangles);
    const auto loops = fairmesh::boundary_loops(open);
    object(loops, left.loops, asked.outer_boundaries);
    asked.fill.only(left.loops);
    std::vector<std::uint32_t> rim;
    for (std::uint32_t loop : left.loops)
        for (std::uint32_t v : loops.list(FAIRMESH_LIST_LOOP_VERTICES, loop)) rim.push_back(v);
    scale_bulge(asked.options, view.diagonal(rim));
    view.mark_edges(asked.options);
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

    write_patches(model, view, left.kept, filled, SelectionAfter::NewOnly);
    Values values = told(filled, loops, asked.options.continuity, host);
    const std::size_t erased = view.triangles().size() - triangles.size();
    host.log(text("Faces erased: %zu, of which %llu were not selected and would have hung loose", erased,
                  static_cast<unsigned long long>(left.dropped)));
    if (left.cleaned > 0)
        host.log(text("Faces beside them that would have spoilt the boundary: %llu", static_cast<unsigned long long>(left.cleaned)));
    if (!values["converged"].toBool()) host.log(OLD_NUMBERS);
    values["erased_faces"] = static_cast<int>(erased);
    values["cleaned_faces"] = static_cast<int>(left.cleaned);
    return values;
}

} // namespace fairmesh_meshlab
