// SPDX-License-Identifier: MIT OR Apache-2.0
#include "parameters.h"

#include <QRegularExpression>

#include <algorithm>
#include <climits>
#include <type_traits>

namespace fairmesh_meshlab {

namespace {

// Dialogs of MeshLab 2020.09 have no scroll bars, and would not fit a screen with all parameters. Later ones hide those that are advanced.
#ifdef FAIRMESH_MESHLAB_2020
constexpr bool SCROLLS = false;
#define ADVANCED
#else
constexpr bool SCROLLS = true;
#define ADVANCED , true
#endif

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

double not_negative(const RichParameterList &list, const char *name) {
    if (!list.hasParameter(name)) return 0;
    const double number = list.getFloat(name);
    if (!(number >= 0)) throw Failure(std::string("Parameter ") + name + " is negative.");
    return number;
}

int as_int(std::uint64_t number) { return static_cast<int>(std::min<std::uint64_t>(number, INT_MAX)); }

/** What both ways of fairing have. */
void add_solver_parameters(RichParameterList &list) {
    const fairmesh::options standard;
    list.addParam(
        RichFloat("continuity", static_cast<Scalar>(standard.continuity), "Match curvature",
                  "How far the surface goes on as curved as its surroundings, between 0 and 1. 0: it goes on smoothly. 1: its "
                  "curvature does, too, so that no edge shows in reflections. Only as far as the surroundings are smooth enough to "
                  "tell it; the log says how far."));
    list.addParam(RichEnum("target", static_cast<int>(standard.target.kind), {"Natural", "Bulged", "Elastic sheet"}, "Shape",
                           "Natural: curved as evenly as it can be, so that parts of spheres and cylinders come "
                           "back. Bulged: pushed out or in by the number below. Elastic sheet: bent as little as it can be."));
    list.addParam(RichFloat("target_constant", static_cast<Scalar>(standard.target.constant), "Bulge",
                            "For the shape 'Bulged' only: positive pushes the surface out, negative in. In "
                            "1 / length^3: start with 100 over the cube of the region's size."));
    list.addParam(RichEnum("inner_fairness", static_cast<int>(standard.inner_fairness), {"Even", "Keep shapes", "Keep shapes, robust"},
                           "Vertex distribution",
                           "How vertices are spread within the surface; the surface hardly depends on it. Even: evenly. Keep "
                           "shapes: with the least distortion of the present triangles. Keep shapes, robust: nearly so, and safe for "
                           "any triangles." ADVANCED));
    list.addParam(RichFloat("tolerance", static_cast<Scalar>(standard.tolerance), "Accuracy",
                            "Stop when vertices move by less than this, over the diagonal of the region's bounding box. Greater than 0, "
                            "less than 1; 1e-6 is enough to look at." ADVANCED));
    list.addParam(RichBool("check_intersections", standard.intersections == FAIRMESH_INTERSECTIONS_CHECK, "Check for self-intersections",
                           "Whether the result is searched for triangles that intersect each other or the rest of the mesh; the log says "
                           "how many pairs there are." ADVANCED));
    list.addParam(RichInt("max_iterations", as_int(standard.max_iterations), "Iterations, at most",
                          "Most regions need 10 to 20. If they run out, the best surface so far is kept, and the log says so." ADVANCED));
    list.addParam(
        RichFloat("join_distance", 0, "Join vertices within",
                  "Vertices as far apart as this are one vertex of the surface, as along texture seams: its copies move alike, and "
                  "none is removed. 0: where their coordinates are equal. Negative: none are joined." ADVANCED));
}

void read_solver_parameters(const RichParameterList &list, fairmesh::options &options) {
    // Positions are written in MeshLab's own numbers.
    if (std::is_same_v<Scalar, float>) options.output_precision = FAIRMESH_OUTPUT_PRECISION_SINGLE;
    options.inner_fairness = static_cast<std::uint32_t>(in_list(list, "inner_fairness", 3));
    options.target.kind = static_cast<std::uint32_t>(in_list(list, "target", 3));
    options.target.constant = list.getFloat("target_constant");
    options.continuity = list.getFloat("continuity");
    options.tolerance = list.getFloat("tolerance");
    options.max_iterations = at_least(list, "max_iterations", 1);
    options.intersections = list.getBool("check_intersections") ? FAIRMESH_INTERSECTIONS_CHECK : FAIRMESH_INTERSECTIONS_SKIP;
}

/** What all ways of filling have. */
void add_patch_parameters(RichParameterList &list) {
    const fairmesh::fill_options standard;
    list.addParam(RichFloat("density", static_cast<Scalar>(standard.density), "Density",
                            "How dense new vertices are. 1.414: edges are as long as those beside the boundary; twice that: half as "
                            "long. Between 0.1 and 10."));
    list.addParam(RichInt("max_new_vertices", as_int(standard.max_new_vertices), "New vertices, at most",
                          "Larger patches become coarser, and the log says so."));
    list.addParam(
        RichEnum("on_failure", static_cast<int>(standard.on_failure), {"Best there is", "Flat", "Nothing"}, "If not fair",
                 "What a hole gets whose patch is not fair, creased, intersects something or has another flaw. Best there is: the "
                 "best surface that was found. Flat: the triangulation, refined. Nothing: it stays as it is. The log says so."));
}

/** What filling has that bridging has not. */
void add_rim_parameters(RichParameterList &list) {
    list.addParam(RichInt("relax_rim", 0, "Rough boundary: rings that may move",
                          "For the ragged boundaries of scans: so many rings of old vertices around a hole, those of its boundary "
                          "counted, may move onto the surface that the mesh has there on average. 3 is a good number. 0: none."));
    list.addParam(RichFloat("relax_within", 0, "Rough boundary: no further than",
                            "No old vertex moves further than this. 0: the mean length of the edges there."));
}

void read_rim_parameters(const RichParameterList &list, fairmesh::fill_options &fill) {
    fill.relax_rim = at_least(list, "relax_rim", 0);
    fill.relax_within = list.getFloat("relax_within");
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
    fill.density = list.getFloat("density");
    fill.max_new_vertices = at_least(list, "max_new_vertices", 0);
    fill.on_failure = static_cast<std::uint32_t>(in_list(list, "on_failure", 3));
}

} // namespace

void add_fair_parameters(RichParameterList &list) {
    list.addParam(
        RichEnum("boundary_normals", static_cast<int>(BoundaryNormals::Fitted), {"Fitted", "Averaged", "Vertex normals", "Attribute"},
                 "Boundary normals",
                 "In which directions the surface leaves the unselected faces. Fitted: as these are curved, the most accurate. Averaged: "
                 "for noisy ones. Vertex normals: those that the mesh has, for instance from its file. Attribute: the custom per-vertex "
                 "attribute named below. Where a given normal is 0 0 0, it is fitted."));
    list.addParam(
        RichString("normal_attribute", "", "Attribute of normals",
                   "For boundary normals 'Attribute' only: the name of a per-vertex attribute of points. In its place three attributes of "
                   "numbers will do, whose names end with _x, _y and _z."));
    add_solver_parameters(list);
    list.addParam(
        RichBool("curvature_to_quality", false, "Curvature to quality",
                 "Writes the mean curvature of the region's vertices to their quality; all others keep theirs. Negative on a sphere with "
                 "outward normals, in 1 / length."));
}

void add_close_parameters(RichParameterList &list) {
    list.addParam(RichInt("max_edges", 0, "Edges of a hole, at most", "Holes of more edges stay open. 0: holes of any size are closed."));
    list.addParam(RichFloat("max_length", 0, "Length of a boundary, at most",
                            "Holes with a longer boundary stay open. 0: holes of any length are closed."));
    if (SCROLLS) {
        list.addParam(RichFloat("max_diagonal", 0, "Width of a hole, at most",
                                "Holes with a longer diagonal of the bounding box stay open. 0: holes of any width are closed." ADVANCED));
    }
    if (SCROLLS) {
        list.addParam(RichFloat("max_area", 0, "Area of a hole, at most",
                                "Holes that span a larger area stay open. 0: holes of any area are closed." ADVANCED));
    }
    list.addParam(
        RichInt("except_longest", 0, "All but the longest", "So many holes of the mesh stay open: those with the longest boundaries."));
    list.addParam(RichBool("touching_selection", false, "Only holes at the selection",
                           "Closes the holes that have a vertex of a selected face, or a selected vertex, on their boundary."));
    list.addParam(RichBool("outer_boundaries", false, "Outer boundaries of open surfaces, too",
                           "The outer boundary of an open sheet is no hole and stays open, unless this is checked."));
    list.addParam(
        RichEnum("join", static_cast<int>(JoinLoops::None), {"None", "What belongs together", "All loops at the selection"}, "Join loops",
                 "Which loops get one patch together. None: each has its own. What belongs together: loops whose common patch "
                 "bends less than patches of their own would, as the two sides of a gap or the ends of tubes that face each other. "
                 "All loops at the selection: one patch for all loops with a vertex of a selected face, or a selected vertex, "
                 "outer boundaries included, and nothing else."));
    list.addParam(RichBool("guide_selected", false, "Edge between the two selected vertices",
                           "The triangulation starts with an edge between the two vertices that are selected, both on the boundary: "
                           "across a long tear, it says which points of its two sides belong together. The surface has no edge there."));
    if (SCROLLS) {
        list.addParam(RichString(
            "guides", "", "Edges between vertices",
            "The same for any pairs of boundary vertices, by their numbers, as in: 12 57; 80 3. None is in two pairs." ADVANCED));
    }
    list.addParam(RichInt("trim", 0, "Trim: faces, at most",
                          "Before a hole is closed, up to so many faces at it are taken away that would spoil the result: slivers, "
                          "spikes and fins, the worst first. 0: none."));
    if (SCROLLS) {
        list.addParam(
            RichFloat("trim_area", 0, "Trim: area, at most", "Of all faces together that are trimmed away. 0: of any area." ADVANCED));
    }
    add_rim_parameters(list);
    add_patch_parameters(list);
    list.addParam(RichEnum("selection_after", static_cast<int>(SelectionAfter::OldAndNew), {"Old and new faces", "New faces", "As before"},
                           "Selected afterwards", "Which faces are selected when holes have been closed."));
    add_solver_parameters(list);
}

void add_erase_parameters(RichParameterList &list) {
    list.addParam(RichBool("outer_boundaries", false, "Outer boundaries of open surfaces, too",
                           "Also where the selected faces lie at the outer boundary of an open sheet, which is closed then."));
    list.addParam(RichInt("clean_boundary", 0, "Clean the boundary: faces, at most",
                          "Up to so many faces more beside the selected ones go that would spoil the result: slivers and fins. 0: none."));
    add_rim_parameters(list);
    add_patch_parameters(list);
    add_solver_parameters(list);
}

void add_bridge_parameters(RichParameterList &list) {
    list.addParam(RichFloat("width", 0, "Width",
                            "How long the two ends of the bridge shall be along the boundary: the selected stretches are made longer "
                            "or shorter about their middles; one vertex each is enough then. 0: as they are selected."));
    list.addParam(RichBool("fill_rest", false, "Fill the rest",
                           "Also closes the holes that the bridge leaves beside it; all that is new becomes one smooth surface."));
    add_patch_parameters(list);
    add_solver_parameters(list);
}

FairParameters read_fair_parameters(const RichParameterList &list) {
    FairParameters asked;
    asked.normals = static_cast<BoundaryNormals>(in_list(list, "boundary_normals", 4));
    asked.attribute = list.getString("normal_attribute").trimmed().toStdString();
    asked.join_distance = list.getFloat("join_distance");
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
    if (list.hasParameter("trim_area")) asked.trim.area = list.getFloat("trim_area");
    asked.guide_selected = list.getBool("guide_selected");
    if (list.hasParameter("guides")) asked.guides = read_guides(list.getString("guides"));
    read_rim_parameters(list, asked.fill);
    asked.max_length = not_negative(list, "max_length");
    asked.max_diagonal = not_negative(list, "max_diagonal");
    asked.max_area = not_negative(list, "max_area");
    asked.except_longest = at_least(list, "except_longest", 0);
    read_patch_parameters(list, asked.fill);
    asked.selection = static_cast<SelectionAfter>(in_list(list, "selection_after", 3));
    asked.join_distance = list.getFloat("join_distance");
    read_solver_parameters(list, asked.options);
    return asked;
}

CloseParameters read_erase_parameters(const RichParameterList &list) {
    CloseParameters asked;
    read_rim_parameters(list, asked.fill);
    asked.clean = at_least(list, "clean_boundary", 0);
    asked.outer_boundaries = list.getBool("outer_boundaries");
    read_patch_parameters(list, asked.fill);
    asked.join_distance = list.getFloat("join_distance");
    read_solver_parameters(list, asked.options);
    return asked;
}

BridgeParameters read_bridge_parameters(const RichParameterList &list) {
    BridgeParameters asked;
    asked.how.width = list.getFloat("width");
    asked.how.fill = list.getBool("fill_rest");
    read_patch_parameters(list, asked.fill);
    asked.join_distance = list.getFloat("join_distance");
    read_solver_parameters(list, asked.options);
    return asked;
}

} // namespace fairmesh_meshlab
