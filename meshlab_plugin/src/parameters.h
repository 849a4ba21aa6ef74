// SPDX-License-Identifier: MIT OR Apache-2.0
/** The parameters of the filters: their names, texts and defaults, and how they are read. */
#ifndef FAIRMESH_MESHLAB_PARAMETERS_H
#define FAIRMESH_MESHLAB_PARAMETERS_H

#include "host.h"

#include <fairmesh.hpp>

#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace fairmesh_meshlab {

/** Where the normals at the boundary of the region come from. The numbers are those of the parameter's list. */
enum class BoundaryNormals { Fitted, Averaged, VertexNormals, Attribute };

/** Which faces are selected after holes were closed. */
enum class SelectionAfter { OldAndNew, NewOnly, AsBefore };

/** Which loops get one patch together. */
enum class JoinLoops { None, Auto, AtSelection };

struct FairParameters {
    fairmesh::options options;
    BoundaryNormals normals = BoundaryNormals::Fitted;
    std::string attribute;
    double join_distance = 0;
    bool curvature_to_quality = false;
};

struct CloseParameters {
    fairmesh::options options;
    fairmesh::fill_options fill;
    bool touching_selection = false;
    bool outer_boundaries = false;
    JoinLoops join = JoinLoops::None;
    /** 0: of any length, width, area. */
    double max_length = 0, max_diagonal = 0, max_area = 0;
    std::size_t except_longest = 0;
    double join_distance = 0;
    SelectionAfter selection = SelectionAfter::OldAndNew;
    /** How much may be taken away at the holes before they are closed, and beside erased faces. */
    fairmesh::trim_limits trim = {0, 0.0};
    std::uint64_t clean = 0;
    /** Pairs of vertices that the patch shall have an edge between before it is refined, and whether the selected two are one. */
    std::vector<std::array<std::uint32_t, 2>> guides;
    bool guide_selected = false;
};

struct BridgeParameters {
    fairmesh::options options;
    fairmesh::fill_options fill;
    fairmesh::bridge_options how;
    double join_distance = 0;
};

/** Which creases are rounded. The numbers are those of the parameter's list. */
enum class Rounded { All, Convex, Concave, SelectedEdges };

struct RoundParameters {
    fairmesh::options options;
    fairmesh::round_options how;
    Rounded which = Rounded::All;
    double join_distance = 0;
};

/** The bulge that is asked is that of a region of size 1, so that one number has one shape, as in Blender: to 1 / length^3. */
void scale_bulge(fairmesh::options &options, double diagonal);

void add_fair_parameters(RichParameterList &list);
void add_close_parameters(RichParameterList &list);
void add_erase_parameters(RichParameterList &list);
void add_bridge_parameters(RichParameterList &list);
void add_round_parameters(RichParameterList &list);

/** Throw Failure for numbers that the library's types cannot hold. It refuses other wrong ones itself. */
FairParameters read_fair_parameters(const RichParameterList &list);
CloseParameters read_close_parameters(const RichParameterList &list);
CloseParameters read_erase_parameters(const RichParameterList &list);
BridgeParameters read_bridge_parameters(const RichParameterList &list);
RoundParameters read_round_parameters(const RichParameterList &list);

} // namespace fairmesh_meshlab

#endif
