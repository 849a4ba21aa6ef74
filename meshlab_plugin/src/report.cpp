// SPDX-License-Identifier: MIT OR Apache-2.0
#include "report.h"

#include <cctype>
#include <cstdarg>
#include <cstddef>
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

/** The parameters that the library checks: its argument (of fair and fill_holes alike), the field's offset there, our name. */
struct Field {
    std::uint64_t argument, offset;
    const char *name;
};
constexpr std::uint64_t FILL = 2, OPTIONS = 3;
constexpr Field FIELDS[] = {
    {OPTIONS, offsetof(fairmesh_options, tolerance), "tolerance"},
    {OPTIONS, offsetof(fairmesh_options, max_iterations), "max_iterations"},
    {OPTIONS, offsetof(fairmesh_options, target) + offsetof(fairmesh_target, constant), "target_constant"},
    {FILL, offsetof(fairmesh_fill_options, density), "density"},
    {FILL, offsetof(fairmesh_fill_options, max_new_vertices), "max_new_vertices"},
};

/** "Argument 3, field at offset 104: has to be ..." with the parameter's name. */
std::string with_parameter(const fairmesh_error &detail) {
    for (const Field &field : FIELDS)
        if (field.argument == detail.element && field.offset == detail.other) {
            const std::string why = detail.message;
            const auto colon = why.find(": ");
            return std::string("Parameter ") + field.name + (colon == std::string::npos ? " is wrong" : why.substr(colon));
        }
    return detail.message;
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
        {"free_vertices", number(report.free_vertices)},
        {"diagonal", report.diagonal},
        {"smallest_angle", report.worst_angle},
        {"smallest_angle_face", static_cast<int>(worst_face(report, view))},
        {"flipped_faces", number(report.flipped_count)},
        {"needles", number(report.needle_count)},
        {"curvature_min", report.h_inside[0]},
        {"curvature_max", report.h_inside[1]},
        {"normal_deviation", report.normal_deviation},
        {"normal_deviation_vertex", number(report.normal_deviation_vertex)},
        {"seconds_solve", report.seconds_total},
    };
}

void log_report(const fairmesh_report &report, const MeshView &view, const Host &host) {
    host.log(text("Fairing %s: %llu free vertices, %llu iterations, last step %.1e of the region's diagonal, harmonic defect %.1e",
                  fairmesh_outcome_name(report.outcome), static_cast<unsigned long long>(report.free_vertices),
                  static_cast<unsigned long long>(report.iterations), report.step, report.defect));
    host.log(
        text("Smallest angle %.2f degrees (face %lld), flipped %llu, needles %llu; mean curvature %.4g to %.4g; deviation from the boundary "
             "normals at most %.2f degrees (vertex %llu)",
             report.worst_angle, worst_face(report, view), static_cast<unsigned long long>(report.flipped_count),
             static_cast<unsigned long long>(report.needle_count), report.h_inside[0], report.h_inside[1], report.normal_deviation,
             static_cast<unsigned long long>(report.normal_deviation_vertex)));
    const std::string but = reservation(report);
    if (!but.empty()) host.warn("Warning, " + std::string(fairmesh_outcome_name(report.outcome)) + ": " + but);
}

std::string reservation(const fairmesh_report &report) {
    switch (report.outcome) {
    case FAIRMESH_OUTCOME_CONVERGED: return "";
    case FAIRMESH_OUTCOME_CONVERGED_POOR_TRIANGLES:
        return text("the surface is fair, but %llu triangles are flipped or have an angle below one degree.",
                    static_cast<unsigned long long>(report.poor_triangle_count));
    case FAIRMESH_OUTCOME_CONVERGED_LOOSELY: return report.reason;
    case FAIRMESH_OUTCOME_NORMALS_NOT_REACHABLE:
        return text(
            "no surface with these boundary normals was found (%.0f %% of the way was possible). The surface of a linear problem with the "
            "same boundary was taken, which is not fair.",
            100 * report.reached);
    case FAIRMESH_OUTCOME_TARGET_NOT_REACHABLE:
        return text("a surface was found for %.0f %% of the target only. The surface of a linear problem was taken, which is not fair.",
                    100 * report.reached);
    case FAIRMESH_OUTCOME_NOT_CONVERGED:
        return "no sound surface was found. The surface of a linear problem with the same boundary was taken, which is not fair.";
    case FAIRMESH_OUTCOME_ITERATION_LIMIT: return "the iterations ran out. The best surface so far was taken.";
    default: return "an outcome that this plugin does not know.";
    }
}

std::string reservation(const fairmesh_fill_report &report) {
    switch (report.reason) {
    case FAIRMESH_FILL_REASON_NONE: break;
    case FAIRMESH_FILL_REASON_NON_MANIFOLD: return "left open: its boundary runs into a non-manifold edge.";
    case FAIRMESH_FILL_REASON_OUTER_BOUNDARY: return "left open: it is the outer boundary of an open surface.";
    case FAIRMESH_FILL_REASON_TOO_MANY_EDGES: return "left open: it has too many edges.";
    case FAIRMESH_FILL_REASON_NO_TRIANGULATION: return "left open: every triangulation has an edge or face that the mesh has already.";
    case FAIRMESH_FILL_REASON_NOT_FINITE: return "left open: a coordinate of its boundary is not a finite number, or all are the same point.";
    case FAIRMESH_FILL_REASON_CANCELLED: return "left open: cancelled.";
    case FAIRMESH_FILL_REASON_NO_INNER_VERTEX: return ""; // A small hole: its triangulation is all that there can be.
    case FAIRMESH_FILL_REASON_REFUSED: return text("closed, but not faired: %s.", fairmesh_status_name(report.refused_status));
    case FAIRMESH_FILL_REASON_UNSOUND: return "closed, but not faired: no sound surface was found.";
    default: return "closed, but not faired.";
    }
    if (report.outcome == FAIRMESH_FILL_OUTCOME_LINEAR) return "closed with the surface of a linear problem, which is not fair.";
    if (report.coarsened) return "closed with a coarser patch, to keep to the number of new vertices.";
    return "";
}

std::string explained(const fairmesh::error &error, const MeshView &view) {
    const bool parameter = error.detail().element_kind == FAIRMESH_ELEMENT_ARGUMENT;
    std::string why = parameter ? with_parameter(error.detail()) : view.in_host_numbers(error.what());
    if (!why.empty()) why[0] = static_cast<char>(std::toupper(static_cast<unsigned char>(why[0])));
    if (!why.empty() && why.back() != '.') why += '.';
    switch (error.status()) {
    case FAIRMESH_STATUS_EMPTY_REGION:
        return "No vertex may move: a vertex moves if all its faces are selected and it is not on the boundary of the mesh. Select "
               "more faces.";
    case FAIRMESH_STATUS_NOTHING_FIXED: return why + " Leave a part of it unselected: the surface needs a boundary.";
    case FAIRMESH_STATUS_NON_MANIFOLD_EDGE:
    case FAIRMESH_STATUS_NON_MANIFOLD_VERTEX: return why + " Select another region, or clean the mesh there (Cleaning and Repairing).";
    case FAIRMESH_STATUS_INCONSISTENT_ORIENTATION: return why + " Apply 'Re-Orient all faces coherently' first.";
    default: return why;
    }
}

} // namespace fairmesh_meshlab
