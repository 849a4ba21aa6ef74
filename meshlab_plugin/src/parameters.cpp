// SPDX-License-Identifier: MIT OR Apache-2.0
#include "parameters.h"
#include "report.h"

#include <QRegularExpression>

#include <algorithm>
#include <climits>
#include <type_traits>

namespace fairmesh_meshlab {

namespace {

/** The library's density of edges that are as long as those beside the boundary. */
constexpr double SAME_LENGTH = 1.4142135623730951;

/** A parameter that is rarely needed. Later dialogs fold it away. Those of MeshLab 2020.09 neither fold nor scroll, and with it they would
 * not fit a screen of 768 rows: there it has its default. */
template <class Parameter, class... Arguments> void add_advanced(RichParameterList &list, const Arguments &...arguments) {
#ifndef FAIRMESH_MESHLAB_2020
    list.addParam(Parameter(arguments..., true));
#else
    static_cast<void>(list);
    (static_cast<void>(arguments), ...);
#endif
}

int in_list(const RichParameterList &list, const char *name, int count) {
    const int choice = list.getEnum(name);
    if (choice < 0 || choice >= count)
        throw Failure(std::string("Parameter ") + name + " is " + std::to_string(choice) + ": it must be between 0 and " +
                      std::to_string(count - 1) + ".");
    return choice;
}

std::uint64_t at_least(const RichParameterList &list, const char *name, int least) {
    const int number = list.getInt(name);
    if (number < least)
        throw Failure(std::string("Parameter ") + name + " is " + std::to_string(number) + ": it must be at least " +
                      std::to_string(least) + ".");
    return static_cast<std::uint64_t>(number);
}

double number_or_zero(const RichParameterList &list, const char *name) { return list.hasParameter(name) ? list.getFloat(name) : 0; }

double not_negative(const RichParameterList &list, const char *name) {
    const double number = number_or_zero(list, name);
    if (!(number >= 0)) throw Failure(std::string("Parameter ") + name + " is negative.");
    return number;
}

int as_int(std::uint64_t number) { return static_cast<int>(std::min<std::uint64_t>(number, INT_MAX)); }

/** Dialogs of 2020.09 have room for it in that of fairing alone. */
void add_sharp(RichParameterList &list, bool is_fairing) {
    const auto standard = static_cast<Scalar>(fairmesh::options().sharp);
    const char *label = "Sharp edges from (degrees)";
    const std::string help = text("Sharper ones around, and selected ones, go on. %.0f: certain ones. 0: none.", FAIRMESH_SHARP_AUTO);
    if (is_fairing) list.addParam(RichFloat("sharp", standard, label, help.c_str()));
    else add_advanced<RichFloat>(list, "sharp", standard, label, help.c_str());
}

/** What both ways of fairing have. */
void add_solver_parameters(RichParameterList &list, bool is_fairing = false) {
    const fairmesh::options standard;
    list.addParam(RichFloat("continuity", static_cast<Scalar>(standard.continuity), "Match curvature",
                            "0: tangent to its surroundings. 1: as curved as they are. -1: 1 where they tell it."));
    add_sharp(list, is_fairing);
    list.addParam(RichEnum("target", static_cast<int>(standard.target.kind), {"Natural", "Bulged", "Elastic sheet"}, "Shape",
                           "Natural: spheres come back. Bulged: pushed out. Elastic sheet: least bent."));
    list.addParam(RichFloat("bulge", 100, "Bulge", "For 'Bulged': 100 raises a flat disc by a seventh of its radius. Below 0: in."));
    list.addParam(RichEnum("inner_fairness", static_cast<int>(standard.inner_fairness), {"Even", "Keep shapes", "Keep shapes, robust"},
                           "Vertex distribution", "How vertices are spread in the surface. Keep shapes: as triangles are now."));
    add_advanced<RichFloat>(list, "tolerance", static_cast<Scalar>(standard.tolerance), "Accuracy",
                            "At the end vertices move by less than this, in sizes of the region.");
    add_advanced<RichBool>(list, "check_intersections", standard.intersections == FAIRMESH_INTERSECTIONS_CHECK,
                           "Check for self-intersections", "The log says how many pairs of triangles of the result intersect.");
    list.addParam(RichInt("max_iterations", as_int(standard.max_iterations), "Iterations, at most",
                          "Most regions need 10 to 20. After so many the best surface so far is kept."));
    add_advanced<RichFloat>(list, "join_distance", 0, "Join vertices within",
                            "Vertices this near are one, as along texture seams. Negative: none are.");
}

void read_solver_parameters(const RichParameterList &list, fairmesh::options &options) {
    // Positions are written in MeshLab's own numbers.
    if (std::is_same_v<Scalar, float>) options.output_precision = FAIRMESH_OUTPUT_PRECISION_SINGLE;
    options.inner_fairness = static_cast<std::uint32_t>(in_list(list, "inner_fairness", 3));
    options.target.kind = static_cast<std::uint32_t>(in_list(list, "target", 3));
    options.target.constant = list.getFloat("bulge");
    options.continuity = list.getFloat("continuity");
    if (list.hasParameter("sharp")) options.sharp = list.getFloat("sharp");
    if (list.hasParameter("tolerance")) options.tolerance = list.getFloat("tolerance");
    options.max_iterations = at_least(list, "max_iterations", 1);
    if (list.hasParameter("check_intersections"))
        options.intersections = list.getBool("check_intersections") ? FAIRMESH_INTERSECTIONS_CHECK : FAIRMESH_INTERSECTIONS_SKIP;
}

/** What all ways of filling have. */
void add_patch_parameters(RichParameterList &list) {
    const fairmesh::fill_options standard;
    list.addParam(RichFloat("density", static_cast<Scalar>(standard.density / SAME_LENGTH), "Density",
                            "1: edges are as long as those beside the boundary. 2: half as long."));
    add_advanced<RichInt>(list, "max_new_vertices", as_int(standard.max_new_vertices), "New vertices, at most",
                          "Larger patches become coarser, and the log says so.");
    list.addParam(RichEnum("on_failure", static_cast<int>(standard.on_failure), {"Best there is", "Flat", "Nothing"}, "If not fair",
                           "What a hole gets whose patch is creased, intersects something or is not fair."));
    add_advanced<RichEnum>(list, "cap", static_cast<int>(standard.cap), QStringList{"Fair", "Plane"}, "Flat holes",
                           "Plane: a boundary in a plane is closed by it, with a sharp edge.");
}

/** What filling has that bridging has not. */
void add_rim_parameters(RichParameterList &list) {
    list.addParam(RichInt("relax_rim", 0, "Rough boundary: rings that may move",
                          "For ragged scans: rings of old vertices that may move. Good: 3. -1: where rough."));
    add_advanced<RichFloat>(list, "relax_within", 0, "Rough boundary: no further than",
                            "No old vertex moves further than this. 0: the mean length of the edges there.");
}

void read_rim_parameters(const RichParameterList &list, fairmesh::fill_options &fill) {
    const std::uint64_t rings = at_least(list, "relax_rim", -1);
    fill.relax_rim = list.getInt("relax_rim") < 0 ? FAIRMESH_RELAX_AUTO : rings;
    if (list.hasParameter("relax_within")) fill.relax_within = list.getFloat("relax_within");
}

/** Pairs of numbers, "12 57; 80 3". */
std::vector<std::array<std::uint32_t, 2>> read_guides(const QString &text) {
    std::vector<std::array<std::uint32_t, 2>> guides;
    for (const QString &part : text.split(';', Qt::SkipEmptyParts)) {
        if (part.trimmed().isEmpty()) continue;
        const QStringList numbers = part.split(QRegularExpression("[,\\s]+"), Qt::SkipEmptyParts);
        bool good = numbers.size() == 2;
        std::array<std::uint32_t, 2> pair{};
        for (int k = 0; good && k < 2; ++k) pair[k] = numbers[k].toUInt(&good);
        if (!good)
            throw Failure("Parameter guides: '" + part.trimmed().toStdString() +
                          "' is no pair of vertices. Write pairs of numbers as in 12 57; 80 3.");
        guides.push_back(pair);
    }
    return guides;
}

void read_patch_parameters(const RichParameterList &list, fairmesh::fill_options &fill) {
    fill.density = SAME_LENGTH * list.getFloat("density");
    if (list.hasParameter("max_new_vertices")) fill.max_new_vertices = at_least(list, "max_new_vertices", 0);
    if (list.hasParameter("cap")) fill.cap = static_cast<std::uint32_t>(in_list(list, "cap", 2));
    fill.on_failure = static_cast<std::uint32_t>(in_list(list, "on_failure", 3));
}

} // namespace

void scale_bulge(fairmesh::options &options, double diagonal) {
    options.target.constant = diagonal > 0 ? options.target.constant / (diagonal * diagonal * diagonal) : 0;
}

void add_fair_parameters(RichParameterList &list) {
    list.addParam(RichEnum("boundary_normals", static_cast<int>(BoundaryNormals::Fitted),
                           {"Fitted", "Averaged", "Vertex normals", "Attribute"}, "Boundary normals",
                           "Directions of the surface at its boundary. Averaged: for noisy surroundings."));
    list.addParam(RichString("normal_attribute", "", "Attribute of normals",
                             "For 'Attribute': of points, or three of numbers that end with _x, _y, _z."));
    add_solver_parameters(list, true);
    list.addParam(RichBool("curvature_to_quality", false, "Curvature to quality",
                           "Mean curvature of the region's vertices: 1 / length, negative on a sphere."));
}

void add_close_parameters(RichParameterList &list) {
    list.addParam(RichInt("max_edges", 0, "Edges of a hole, at most", "Holes of more edges stay open. 0: holes of any size are closed."));
    add_advanced<RichFloat>(list, "max_length", 0, "Length of a boundary, at most",
                            "Holes with a longer boundary stay open. 0: holes of any length are closed.");
    add_advanced<RichFloat>(list, "max_diagonal", 0, "Width of a hole, at most",
                            "Holes whose box has a longer diagonal stay open. 0: of any width are closed.");
    add_advanced<RichFloat>(list, "max_area", 0, "Area of a hole, at most",
                            "Holes that span a larger area stay open. 0: holes of any area are closed.");
    list.addParam(
        RichInt("except_longest", 0, "All but the longest", "So many holes of the mesh stay open: those with the longest boundaries."));
    list.addParam(
        RichBool("touching_selection", false, "Only holes at the selection", "Closes the holes that a selected face or vertex touches."));
    list.addParam(RichBool("outer_boundaries", false, "Outer boundaries of open surfaces, too",
                           "The outer boundary of an open sheet is no hole, unless this is checked."));
    list.addParam(RichEnum("join", static_cast<int>(JoinLoops::None), {"None", "What belongs together", "All loops at the selection"},
                           "Join loops", "Loops that get one patch together, as the sides of a gap or ends of tubes."));
    list.addParam(RichBool("guide_selected", false, "Edge between the two selected vertices",
                           "Across a long tear: which points of its two sides belong together."));
    add_advanced<RichString>(list, "guides", "", "Edges between vertices",
                             "The same for pairs of vertices, by their numbers, as in: 12 57; 80 3.");
    list.addParam(RichInt("trim", 0, "Trim: faces, at most", "So many slivers, spikes and fins at a hole are taken away before. 0: none."));
    add_advanced<RichFloat>(list, "trim_area", 0, "Trim: area, at most", "Of all faces together that are trimmed away. 0: of any area.");
    add_rim_parameters(list);
    add_patch_parameters(list);
    add_advanced<RichEnum>(list, "selection_after", static_cast<int>(SelectionAfter::OldAndNew),
                           QStringList{"Old and new faces", "New faces", "As before"}, "Selected afterwards",
                           "Which faces are selected when holes have been closed.");
    add_solver_parameters(list);
}

void add_erase_parameters(RichParameterList &list) {
    list.addParam(RichBool("outer_boundaries", false, "Outer boundaries of open surfaces, too",
                           "Also where the selected faces lie at the outer boundary: it is closed then."));
    list.addParam(RichInt("clean_boundary", 0, "Clean the boundary: faces, at most",
                          "So many slivers and fins beside the selected faces go, too. 0: none."));
    add_rim_parameters(list);
    add_patch_parameters(list);
    add_solver_parameters(list);
}

void add_bridge_parameters(RichParameterList &list) {
    list.addParam(RichFloat("width", 0, "Width", "Stretches become as long as this, about their middles. 0: as selected."));
    list.addParam(RichBool("fill_rest", false, "Fill the rest", "Also closes the holes beside the bridge, as one smooth surface with it."));
    add_patch_parameters(list);
    add_solver_parameters(list);
}

void add_round_parameters(RichParameterList &list) {
    list.addParam(RichFloat("width", 0, "Width", "How far blends reach from the edge, on both sides. 0: the radius says it."));
    list.addParam(RichFloat("radius", 0, "Radius", "Of a ball that touches both sides where the blend begins. 0: the width says it."));
    list.addParam(RichFloat("taper", 1, "Taper", "So many times as large at one end of the edges as at the other. 1: alike."));
    list.addParam(RichEnum("creases", static_cast<int>(Rounded::All), {"All", "That stand out", "In folds", "Selected edges"},
                           "Sharp edges", "Which are rounded. Selected ones: as by 'Select Crease Edges'."));
    list.addParam(RichFloat("continuity", 0, "Match curvature", "0: tangent to the faces beside. 1: as curved as they are."));
    list.addParam(RichFloat("angle", 0, "Sharp from (degrees)", "Edges that bend by more are sharp. 0: by the gap between bends."));
    add_advanced<RichBool>(list, "check_intersections", true, "Check for self-intersections",
                           "Blends that intersect anything are not made. Off: this is not looked for.");
    add_advanced<RichFloat>(list, "join_distance", 0, "Join vertices within",
                            "Vertices this near are one, as along texture seams. Negative: none are.");
}

FairParameters read_fair_parameters(const RichParameterList &list) {
    FairParameters asked;
    asked.normals = static_cast<BoundaryNormals>(in_list(list, "boundary_normals", 4));
    asked.attribute = list.getString("normal_attribute").trimmed().toStdString();
    asked.join_distance = number_or_zero(list, "join_distance");
    read_solver_parameters(list, asked.options);
    asked.curvature_to_quality = list.getBool("curvature_to_quality");
    return asked;
}

CloseParameters read_close_parameters(const RichParameterList &list) {
    CloseParameters asked;
    if (list.getInt("max_edges") != 0) asked.fill.max_edges = at_least(list, "max_edges", 3);
    asked.touching_selection = list.getBool("touching_selection");
    asked.outer_boundaries = list.getBool("outer_boundaries");
    asked.join = static_cast<JoinLoops>(in_list(list, "join", 3));
    asked.trim.triangles = at_least(list, "trim", 0);
    asked.trim.area = number_or_zero(list, "trim_area");
    asked.guide_selected = list.getBool("guide_selected");
    if (list.hasParameter("guides")) asked.guides = read_guides(list.getString("guides"));
    read_rim_parameters(list, asked.fill);
    asked.max_length = not_negative(list, "max_length");
    asked.max_diagonal = not_negative(list, "max_diagonal");
    asked.max_area = not_negative(list, "max_area");
    asked.except_longest = at_least(list, "except_longest", 0);
    read_patch_parameters(list, asked.fill);
    if (list.hasParameter("selection_after")) asked.selection = static_cast<SelectionAfter>(in_list(list, "selection_after", 3));
    asked.join_distance = number_or_zero(list, "join_distance");
    read_solver_parameters(list, asked.options);
    return asked;
}

CloseParameters read_erase_parameters(const RichParameterList &list) {
    CloseParameters asked;
    read_rim_parameters(list, asked.fill);
    asked.clean = at_least(list, "clean_boundary", 0);
    asked.outer_boundaries = list.getBool("outer_boundaries");
    read_patch_parameters(list, asked.fill);
    asked.join_distance = number_or_zero(list, "join_distance");
    read_solver_parameters(list, asked.options);
    return asked;
}

BridgeParameters read_bridge_parameters(const RichParameterList &list) {
    BridgeParameters asked;
    asked.how.width = list.getFloat("width");
    asked.how.fill = list.getBool("fill_rest");
    read_patch_parameters(list, asked.fill);
    asked.join_distance = number_or_zero(list, "join_distance");
    read_solver_parameters(list, asked.options);
    return asked;
}

RoundParameters read_round_parameters(const RichParameterList &list) {
    RoundParameters asked;
    asked.how.width = not_negative(list, "width");
    asked.how.radius = not_negative(list, "radius");
    if ((asked.how.width > 0) == (asked.how.radius > 0)) throw Failure("Give a width or a radius.");
    asked.how.taper = list.getFloat("taper");
    asked.how.angle = not_negative(list, "angle");
    asked.options.continuity = list.getFloat("continuity");
    asked.which = static_cast<Rounded>(in_list(list, "creases", 4));
    if (asked.which == Rounded::Convex) asked.how.creases = FAIRMESH_CREASES_CONVEX;
    if (asked.which == Rounded::Concave) asked.how.creases = FAIRMESH_CREASES_CONCAVE;
    asked.join_distance = number_or_zero(list, "join_distance");
    if (std::is_same_v<Scalar, float>) asked.options.output_precision = FAIRMESH_OUTPUT_PRECISION_SINGLE;
    const bool skips = list.hasParameter("check_intersections") && !list.getBool("check_intersections");
    if (skips) asked.options.intersections = FAIRMESH_INTERSECTIONS_SKIP;
    return asked;
}

} // namespace fairmesh_meshlab
