// SPDX-License-Identifier: MIT OR Apache-2.0
/** Names and help texts. */
#include "filters.h"

namespace fairmesh_meshlab {

namespace {

const char PAPER[] = "<br>See:<br><i>Robert Schneider and Leif Kobbelt</i><br>"
                     "<b>\"Geometric fairing of irregular meshes for free-form surface design\"</b><br>"
                     "Computer Aided Geometric Design, volume 18, issue 4, 2001, pages 359-379.<br>";

const char FAIR[] =
    "Moves the vertices inside the selected faces until the surface between the unselected ones solves &Delta;<sub>B</sub>H = 0: the mean "
    "curvature H is a harmonic function on the surface. It passes through the boundary of the selection with the tangent planes of the "
    "surroundings (G<sup>1</sup>), or with given normals. Spheres, cylinders and all surfaces of constant mean curvature are solutions.<br>"
    "The equation is intrinsic: the shape follows from the boundary alone, not from what was inside the selection, and hardly from the "
    "triangulation.<br><br>"
    "A vertex moves if all its faces are selected and it is not on the boundary of the mesh. Connectivity, colours, texture "
    "coordinates and the selection stay. To fill a hole smoothly, apply 'Close Holes' first, which leaves the new faces selected, or use "
    "'Close "
    "holes and fair (G1)', which makes better triangles, too.<br>";

const char CLOSE[] =
    "Closes holes with new triangles as large as those beside the boundary, whose vertices lie on a fair surface: the mean curvature is "
    "harmonic "
    "(&Delta;<sub>B</sub>H = 0) and the tangent planes at the boundary are those of the surroundings (G<sup>1</sup>). A piece that was cut "
    "out "
    "of a "
    "sphere is put back.<br><br>"
    "New vertices get colours, quality, texture coordinates and attributes interpolated from the boundary. Old vertices and faces stay as "
    "they are.<br><br>"
    "Several loops can get one patch ('Join loops'): the two sides of a gap, ends of tubes, a hole and the island in it. All parts have to "
    "face the same way.<br>";

const char ERASE[] =
    "Deletes the selected faces and closes the hole with new triangles on a fair surface, as 'Close holes and fair (G1)' does: for bumps, "
    "noise and tangles whose old shape is of no use. Faces that would hang loose at the rest go, too. Where the hole would stay open, "
    "nothing is changed.<br>";

const char BRIDGE[] =
    "Connects two selected stretches of boundary by a strip of new triangles that goes on smoothly from both: across a hole, which it "
    "divides, or between two parts. Select the vertices or the faces there. Its two free sides are curves, unless the rest is filled, "
    "too.<br>";

const char CURVATURE[] =
    "Writes the mean curvature H of every vertex to its quality, in 1 / length. It is fitted to the normal curvatures towards the "
    "neighbours "
    "(Moreton and S&eacute;quin's method). H is negative on a sphere with outward normals. Vertices without faces get 0. To see it, apply "
    "'Colorize by vertex quality'.<br>"
    "<br>See:<br><i>Henry P. Moreton and Carlo H. S&eacute;quin</i><br><b>\"Functional optimization for fair surface design\"</b><br>"
    "SIGGRAPH 1992, pages 167-176.<br>";

} // namespace

QString name(int filter) {
    switch (filter) {
    case FairSelection: return "Fair selection (G1, intrinsic)";
    case CloseHoles: return "Close holes and fair (G1)";
    case EraseAndFill: return "Erase selected faces and fill (G1)";
    case BridgeBoundaries: return "Bridge Boundaries Smoothly";
    case MeanCurvature: return "Mean curvature (Moreton-Sequin) to quality";
    default: return "";
    }
}

QString python_name(int filter) {
    switch (filter) {
    case FairSelection: return "apply_coord_fairing_to_selection";
    case CloseHoles: return "meshing_close_holes_and_fair";
    case EraseAndFill: return "meshing_erase_and_fill_selection";
    case BridgeBoundaries: return "meshing_bridge_boundaries";
    case MeanCurvature: return "compute_scalar_by_moreton_sequin_mean_curvature_per_vertex";
    default: return "";
    }
}

QString help(int filter) {
    switch (filter) {
    case FairSelection: return QString::fromUtf8(FAIR) + PAPER;
    case CloseHoles: return QString::fromUtf8(CLOSE) + PAPER;
    case EraseAndFill: return QString::fromUtf8(ERASE) + PAPER;
    case BridgeBoundaries: return QString::fromUtf8(BRIDGE) + PAPER;
    case MeanCurvature: return QString::fromUtf8(CURVATURE) + PAPER;
    default: return "";
    }
}

} // namespace fairmesh_meshlab
