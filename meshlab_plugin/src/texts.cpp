// SPDX-License-Identifier: MIT OR Apache-2.0
/** Names and help texts. Menus and searches list the filters side by side. The first sentence of a help text is what it is for: some
 *  dialogs show no more. */
#include "filters.h"

namespace fairmesh_meshlab {

namespace {

const char PAPER[] = "<br>The method: <i>Robert Schneider and Leif Kobbelt</i>, "
                     "<b>\"Geometric fairing of irregular meshes for free-form surface design\"</b>, "
                     "Computer Aided Geometric Design, volume 18, issue 4, 2001, pages 359-379.<br>";

const char FAIR[] =
    "<b>Removes bumps, dents and noise: the selected faces continue those around them, exactly smooth.</b> There is no undo: duplicate "
    "the layer first. Select the faces of a bump, "
    "with some good ones around, and apply. What was inside is forgotten; parts of spheres and cylinders come back exactly.<br><br>"
    "A vertex moves if all its faces are selected and it is not on the boundary of the mesh. To close a hole apply 'Fairmesh: Close "
    "Holes'; "
    "where the old faces are tangled, 'Fairmesh: Erase and Fill'.<br><br>"
    "The mean curvature H of the new surface is a harmonic function on it (&Delta;<sub>B</sub>H = 0), and it has the tangent planes of its "
    "surroundings (G<sup>1</sup>), or given normals.<br>";

const char CLOSE[] =
    "<b>Fills holes and joins loops with a surface that continues the faces around, exactly smooth.</b> There is no undo: "
    "duplicate the layer first. All holes are closed, or those of a size or at the selection.<br><br>"
    "New triangles are as large as those beside the hole, and colours, quality, texture coordinates and attributes are interpolated. "
    "'Join loops' gives several boundaries one surface: the sides of a gap, ends of tubes, a hole and the island in it.<br>";

const char ERASE[] =
    "<b>Deletes the selected faces and fills the hole, exactly smooth.</b> There is no undo: duplicate the layer first. For "
    "bumps, noise and tangles whose old faces are of no use.<br><br>"
    "Faces that would hang loose at the rest go, too. Where the hole would stay open, nothing is changed.<br>";

const char BRIDGE[] = "<b>Joins two selected stretches of boundary by a strip, exactly smooth.</b> There is no undo: "
                      "duplicate the layer first. Select the vertices or the faces there: on two sides of a hole, "
                      "which it divides, or on two parts.<br><br>"
                      "It goes on smoothly from both. Its free sides are curves; 'Fill the rest' closes the holes beside it, too.<br>";

const char ROUND[] =
    "<b>Rounds sharp edges: blends take their place, exactly smooth.</b> There is no undo: duplicate the layer first. Also after "
    "booleans.<br><br>"
    "Between planes a blend is a cylinder, elsewhere and in corners the smoothest surface there is. Outside of the blends the surface "
    "stays "
    "where it is; faces that reach into one are cut. Blends are narrower where there is less room, and edges without a sound blend stay "
    "sharp: the log says which.<br>";

const char CURVATURE[] =
    "<b>Writes how much the surface is curved at every vertex to its quality.</b> To see it, apply 'Colorize by vertex quality'.<br><br>"
    "It is the mean curvature, in 1 / length: negative where a closed surface bulges out (on a sphere of radius r it is -1/r), positive in "
    "hollows. It is fitted to the normal curvatures towards the neighbours, so that it is smooth on irregular meshes, too. Vertices "
    "without faces get 0.<br>"
    "<br>The method: <i>Henry P. Moreton and Carlo H. S&eacute;quin</i>, <b>\"Functional optimization for fair surface design\"</b>, "
    "SIGGRAPH 1992, pages 167-176.<br>";

} // namespace

QString name(int filter) {
    switch (filter) {
    case FairSelection: return "Fairmesh: Fair Selected Region";
    case CloseHoles: return "Fairmesh: Close Holes";
    case EraseAndFill: return "Fairmesh: Erase and Fill";
    case BridgeBoundaries: return "Fairmesh: Bridge Boundaries";
    case RoundEdges: return "Fairmesh: Round Edges";
    case MeanCurvature: return "Fairmesh: Mean Curvature";
    default: return "";
    }
}

QString python_name(int filter) {
    switch (filter) {
    case FairSelection: return "apply_coord_fairing_to_selection";
    case CloseHoles: return "meshing_close_holes_and_fair";
    case EraseAndFill: return "meshing_erase_and_fill_selection";
    case BridgeBoundaries: return "meshing_bridge_boundaries";
    case RoundEdges: return "meshing_round_edges";
    case MeanCurvature: return "compute_scalar_by_smooth_mean_curvature_per_vertex";
    default: return "";
    }
}

QString help(int filter) {
    switch (filter) {
    case FairSelection: return QString::fromUtf8(FAIR) + PAPER;
    case CloseHoles: return QString::fromUtf8(CLOSE);
    case EraseAndFill: return QString::fromUtf8(ERASE);
    case BridgeBoundaries: return QString::fromUtf8(BRIDGE);
    case RoundEdges: return QString::fromUtf8(ROUND);
    case MeanCurvature: return QString::fromUtf8(CURVATURE);
    default: return "";
    }
}

} // namespace fairmesh_meshlab
