// SPDX-License-Identifier: MIT OR Apache-2.0
#include "filters.h"

#include "mesh_view.h"
#include "parameters.h"
#include "report.h"
#include "work.h"

#include <chrono>
#include <utility>

namespace fairmesh_meshlab {

namespace {

#ifdef FAIRMESH_MESHLAB_2020
using Menus = MeshFilterInterface;
#else
using Menus = FilterPlugin;
#endif

Values dispatch(int filter, MeshModel &model, MeshView &view, const RichParameterList &asked, const Host &host) {
    switch (filter) {
    case FairSelection: {
        FairParameters parameters = read_fair_parameters(asked);
        view.join(parameters.join_distance);
        return fair_selection(model, view, std::move(parameters), host);
    }
    case CloseHoles: {
        CloseParameters parameters = read_close_parameters(asked);
        view.join(parameters.join_distance);
        return close_holes(model, view, std::move(parameters), host);
    }
    case EraseAndFill: {
        CloseParameters parameters = read_erase_parameters(asked);
        view.join(parameters.join_distance);
        return erase_and_fill(model, view, std::move(parameters), host);
    }
    case BridgeBoundaries: {
        BridgeParameters parameters = read_bridge_parameters(asked);
        view.join(parameters.join_distance);
        return bridge_boundaries(model, view, std::move(parameters), host);
    }
    case RoundEdges: {
        RoundParameters parameters = read_round_parameters(asked);
        view.join(parameters.join_distance);
        return round_edges(model, view, std::move(parameters), host);
    }
    case MeanCurvature: return mean_curvature(model, view, host);
    default: throw Failure("There is no such filter.");
    }
}

} // namespace

int menus(int filter) {
    switch (filter) {
    case CloseHoles:
    case EraseAndFill:
    case BridgeBoundaries:
    case RoundEdges: return Menus::Smoothing | Menus::Remeshing;
    case MeanCurvature: return Menus::Smoothing | Menus::Quality;
    default: return Menus::Smoothing;
    }
}

int needs(int) { return MeshModel::MM_FACENUMBER; }

int changes(int filter) {
    switch (filter) {
    case FairSelection: return MeshModel::MM_VERTCOORD | MeshModel::MM_VERTNORMAL | MeshModel::MM_FACENORMAL | MeshModel::MM_VERTQUALITY;
    case CloseHoles:
    case EraseAndFill:
    case BridgeBoundaries:
    case RoundEdges: return MeshModel::MM_GEOMETRY_AND_TOPOLOGY_CHANGE | MeshModel::MM_FACEFLAGSELECT;
    default: return MeshModel::MM_VERTQUALITY;
    }
}

RichParameterList parameters(int filter) {
    RichParameterList list;
    if (filter == FairSelection) add_fair_parameters(list);
    if (filter == CloseHoles) add_close_parameters(list);
    if (filter == EraseAndFill) add_erase_parameters(list);
    if (filter == BridgeBoundaries) add_bridge_parameters(list);
    if (filter == RoundEdges) add_round_parameters(list);
    return list;
}

Values apply(int filter, MeshModel *model, const RichParameterList &asked, const Host &host) {
    const auto start = std::chrono::steady_clock::now();
    if (!model) throw Failure("There is no mesh.");
    MeshView view(model->cm);
    try {
        Values values = dispatch(filter, *model, view, asked, host);
        const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
        values["seconds"] = seconds;
        host.log(text("fairmesh %s: %.3f seconds", fairmesh_version_string(), seconds));
        return values;
    } catch (const fairmesh::error &error) {
        throw Failure(explained(error, view));
    } catch (const std::bad_alloc &) {
        throw Failure("Memory ran out.");
    }
}

} // namespace fairmesh_meshlab
