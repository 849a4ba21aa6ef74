// SPDX-License-Identifier: MIT OR Apache-2.0
#include "report.h"

#include <cctype>
#include <cstdarg>
#include <cstdio>

namespace fairmesh_meshlab {

std::string text(const char *format, ...) {
    char line[1024];
    va_list arguments;
    va_start(arguments, format);
    std::vsnprintf(line, sizeof line, format, arguments);
    va_end(arguments);
    return line;
}

namespace {

QVariant number(std::uint64_t count) { return QVariant(static_cast<int>(count)); }

/** The face with the smallest angle; -1 where there is none. */
long long worst_face(const fairmesh_report &report, const MeshView &view) {
    return report.worst_triangle < view.triangles().size() ? view.face(report.worst_triangle) : -1;
}

} // namespace

Values values_of(const fairmesh_report &report, const MeshView &view) {
    return {
        // PyMeshLab drops texts: the outcome is a fairmesh_outcome.
        {"outcome", number(report.outcome)},
        {"converged", report.outcome == FAIRMESH_OUTCOME_CONVERGED},
        {"iterations", number(report.iterations)},
        {"step", report.step},
        {"defect", report.defect},
        {"reached", report.reached},
        {"member_weight", report.member_weight},
        {"bending_energy", report.bending_energy},
        {"free_vertices", number(report.free_vertices)},
        {"diagonal", report.diagonal},
        {"smallest_angle", report.worst_angle},
        {"smallest_angle_face", static_cast<int>(worst_face(report, view))},
        {"sharpest_edge", report.sharpest_edge},
        {"sharpest_edge_vertex", number(report.sharpest_edge_from)},
        {"flipped_faces", number(report.flipped_count)},
        {"needles", number(report.needle_count)},
        {"curvature_min", report.h_inside[0]},
        {"curvature_max", report.h_inside[1]},
        {"normal_deviation", report.normal_deviation},
        {"normal_deviation_vertex", number(report.normal_deviation_vertex)},
        {"boundary_kink", report.boundary_kink},
        {"boundary_kink_vertex", number(report.boundary_kink_vertex)},
        {"intersections", number(report.intersection_count)},
        {"creased_vertices", number(report.creased_vertex_count)},
        {"seconds_solve", report.seconds_total},
        {"components", number(report.component_count)},
        {"sharp_edges", number(report.sharp_edge_count)},
    };
}

void log_report(const fairmesh_report &report, const MeshView &view, const Host &host) {
    host.log(text("Fairing %s: %llu free vertices, %llu iterations, last step %.1e of the region's diagonal, harmonic defect %.1e",
                  fairmesh::name(FAIRMESH_ANSWER_OUTCOME, report.outcome), static_cast<unsigned long long>(report.free_vertices),
                  static_cast<unsigned long long>(report.iterations), report.step, report.defect));
    host.log(text("Smallest angle %.2f degrees (face %lld), sharpest edge %.1f degrees, flipped %llu, needles %llu; mean curvature %.4g to "
                  "%.4g; deviation from the boundary "
                  "normals at most %.2f degrees (vertex %llu)",
                  report.worst_angle, worst_face(report, view), report.sharpest_edge, static_cast<unsigned long long>(report.flipped_count),
                  static_cast<unsigned long long>(report.needle_count), report.h_inside[0], report.h_inside[1], report.normal_deviation,
                  static_cast<unsigned long long>(report.normal_deviation_vertex)));
    const std::string but = reservation(report);
    if (!but.empty()) host.warn("Warning, " + std::string(fairmesh::name(FAIRMESH_ANSWER_OUTCOME, report.outcome)) + ": " + but);
}

void log_components(const fairmesh::result &result, const Host &host) {
    const std::uint64_t count = result.report().component_count, shown = 8;
    if (count < 2) return;
    std::uint64_t failed = 0;
    for (std::uint64_t i = 0; i < count; i++) {
        const fairmesh_component part = result.component(i);
        if (part.outcome == FAIRMESH_OUTCOME_CONVERGED) continue;
        if (failed++ < shown)
            host.warn(text("Component of vertex %llu (%llu free vertices): %s", static_cast<unsigned long long>(part.vertex),
                           static_cast<unsigned long long>(part.free_vertices), fairmesh::name(FAIRMESH_ANSWER_OUTCOME, part.outcome)));
    }
    host.log(text("%llu components, %llu of them fair", static_cast<unsigned long long>(count),
                  static_cast<unsigned long long>(count - failed)));
}

void log_continuity(const fairmesh::result &result, double asked, const Host &host, std::uint64_t index) {
    if (asked == 0) return;
    const std::uint64_t components = result.report(index).component_count, shown = 8;
    std::uint64_t told = 0;
    for (std::uint64_t i = 0; i < components; i++) {
        const std::uint64_t loops = result.component(i, index).continuity_count;
        for (std::uint64_t k = 0; k < loops && told < shown; k++, told++) {
            const fairmesh_continuity loop = result.continuity(i, k, index);
            if (loop.asked == FAIRMESH_CONTINUITY_AUTO && loop.reached == 0) {
                host.log(
                    text("Tangent planes at the boundary of %llu vertices (vertex %llu): H of the surroundings %.4g, uncertain by %.2g, "
                         "jump of H %.3g",
                         static_cast<unsigned long long>(loop.vertex_count), static_cast<unsigned long long>(loop.vertex), loop.curvature,
                         loop.uncertainty, loop.jump_before));
                continue;
            }
            host.log(
                text("Curvature continuity at the boundary of %llu vertices (vertex %llu): %.2f reached, jump of H %.3g before, %.3g now "
                     "(largest %.3g, %.3g); H of the surroundings %.4g, uncertain by %.2g",
                     static_cast<unsigned long long>(loop.vertex_count), static_cast<unsigned long long>(loop.vertex), loop.reached,
                     loop.jump_before, loop.jump, loop.largest_jump_before, loop.largest_jump, loop.curvature, loop.uncertainty));
        }
    }
    if (told == 0 && asked > 0)
        host.log("Curvature continuity was not reached: no boundary has surroundings and vertices enough, or no surface was found");
}

void log_sharp_edges(const fairmesh::result &result, const Host &host, std::uint64_t index) {
    const std::uint64_t count = result.report(index).sharp_edge_count;
    for (std::uint64_t i = 0; i < count; i++) {
        const fairmesh_sharp_edge edge = result.sharp_edge(i, index);
        std::string ends;
        for (std::uint64_t k = 0; k < edge.end_count; k++) {
            const fairmesh_crease_end end = result.crease_end(i, k, index);
            ends += text("%s %llu (%.4g degrees)", k == 0 ? " vertex" : ",", static_cast<unsigned long long>(end.vertex), end.angle);
        }
        const std::string fate = fairmesh::meaning(FAIRMESH_ANSWER_SHARP_FATE, edge.fate);
        const std::string remedy = fairmesh::remedy(FAIRMESH_ANSWER_SHARP_FATE, edge.fate);
        if (remedy.empty())
            host.log("Sharp edge," + ends + ": " + fate +
                     text(", along %llu vertices", static_cast<unsigned long long>(edge.vertex_count)));
        else host.warn("Sharp edge," + ends + ": " + fate + "; " + remedy + ".");
    }
}

namespace {

/** In MeshLab's own words where it has a parameter or a filter that helps. */
std::string what_to_do(std::uint32_t outcome) {
    switch (outcome) {
    case FAIRMESH_OUTCOME_NOT_CONVERGED: return "select more, take averaged boundary normals, or apply 'Fairmesh: Erase and Fill'";
    case FAIRMESH_OUTCOME_CONVERGED_POOR_TRIANGLES:
        return "look at these triangles; the vertex distribution 'Even', or 'Fairmesh: Erase and Fill', usually cures them";
    case FAIRMESH_OUTCOME_ITERATION_LIMIT: return "allow more iterations, or fair the result once more";
    case FAIRMESH_OUTCOME_TARGET_NOT_REACHABLE: return "give a smaller bulge, or select a smaller region";
    default: return fairmesh::remedy(FAIRMESH_ANSWER_OUTCOME, outcome);
    }
}

} // namespace

std::string reservation(const fairmesh_report &report) {
    if (report.outcome == FAIRMESH_OUTCOME_CONVERGED) return "";
    const bool loosely = report.outcome == FAIRMESH_OUTCOME_CONVERGED_LOOSELY;
    const std::string what = loosely ? fairmesh::meaning(FAIRMESH_ANSWER_LOOSE_REASON, report.loose_reason)
                                     : fairmesh::meaning(FAIRMESH_ANSWER_OUTCOME, report.outcome);
    const std::string remedy = loosely ? fairmesh::remedy(FAIRMESH_ANSWER_LOOSE_REASON, report.loose_reason) : what_to_do(report.outcome);
    std::string figures;
    if (report.outcome == FAIRMESH_OUTCOME_CONVERGED_POOR_TRIANGLES || report.outcome == FAIRMESH_OUTCOME_POOR_WHEN_ROUNDED)
        figures = text(" (%llu triangles)", static_cast<unsigned long long>(report.poor_triangle_count));
    if (report.outcome == FAIRMESH_OUTCOME_BOUNDARY_CREASE)
        figures = text(" (%llu vertices, up to %.0f degrees at vertex %llu)", static_cast<unsigned long long>(report.creased_vertex_count),
                       report.boundary_kink, static_cast<unsigned long long>(report.boundary_kink_vertex));
    if (report.outcome == FAIRMESH_OUTCOME_SELF_INTERSECTING)
        figures = text(" (%llu pairs, in the input %llu)", static_cast<unsigned long long>(report.intersection_count),
                       static_cast<unsigned long long>(report.intersections_in_input));
    if (report.outcome == FAIRMESH_OUTCOME_TARGET_NOT_REACHABLE) figures = text(" (%.0f %% of the way was possible)", 100 * report.reached);
    if (report.outcome == FAIRMESH_OUTCOME_NEAREST_MEMBER)
        figures = text(" (Delta_B H = -2 w H (H^2 - K) with w = %.3g; w is 0 for harmonic, 1 for minimal energy)", report.member_weight);
    return what + figures + "; " + remedy + ".";
}

std::string reservation(const fairmesh_fill_report &report) {
    switch (report.reason) {
    case FAIRMESH_FILL_REASON_NONE: break;
    case FAIRMESH_FILL_REASON_NO_INNER_VERTEX: return ""; // A small hole: its triangulation is all that there can be.
    case FAIRMESH_FILL_REASON_REFUSED:
        return text("closed, but not faired: %s.", fairmesh::meaning(FAIRMESH_ANSWER_STATUS, report.refused_status));
    default:
        return text("%s: %s.", report.outcome == FAIRMESH_FILL_OUTCOME_LEFT_OPEN ? "left open" : "closed, but not faired",
                    fairmesh::meaning(FAIRMESH_ANSWER_FILL_REASON, report.reason));
    }
    if (report.outcome == FAIRMESH_FILL_OUTCOME_SELF_INTERSECTING)
        return text("%s (%llu pairs of triangles); %s.", fairmesh::meaning(FAIRMESH_ANSWER_FILL_OUTCOME, report.outcome),
                    static_cast<unsigned long long>(report.intersection_count),
                    fairmesh::remedy(FAIRMESH_ANSWER_FILL_OUTCOME, report.outcome));
    if (report.outcome == FAIRMESH_FILL_OUTCOME_LEAST_BENDING) return "closed with the surface of least bending, which is not fair.";
    if (report.coarsened) return "closed with a coarser patch, to keep to the number of new vertices.";
    return "";
}

std::string explained(const fairmesh::error &error, const MeshView &view) {
    std::string why = view.in_host_numbers(error.what());
    if (!why.empty()) why[0] = static_cast<char>(std::toupper(static_cast<unsigned char>(why[0])));
    // MeshLab's own words where it has a filter that helps.
    if (error.status() == FAIRMESH_STATUS_INCONSISTENT_ORIENTATION) return why + ". Apply 'Re-Orient all faces coherently' first.";
    const std::string remedy = fairmesh::remedy(FAIRMESH_ANSWER_STATUS, error.status());
    return why + (remedy.empty() ? "." : "; " + remedy + ".");
}

} // namespace fairmesh_meshlab
