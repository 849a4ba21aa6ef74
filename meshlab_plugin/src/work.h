// SPDX-License-Identifier: MIT OR Apache-2.0
/** What the filters do to a mesh. */
#ifndef FAIRMESH_MESHLAB_WORK_H
#define FAIRMESH_MESHLAB_WORK_H

#include "host.h"
#include "mesh_view.h"
#include "parameters.h"

namespace fairmesh_meshlab {

/** Moves the vertices all of whose faces are selected. */
Values fair_selection(MeshModel &model, const MeshView &view, FairParameters asked, const Host &host);

/** Closes holes, each or several together. */
Values close_holes(MeshModel &model, const MeshView &view, CloseParameters asked, const Host &host);

/** Deletes the selected faces and fills the holes that they leave. */
Values erase_and_fill(MeshModel &model, const MeshView &view, CloseParameters asked, const Host &host);

/** Connects two selected stretches of boundary by a strip. */
Values bridge_boundaries(MeshModel &model, const MeshView &view, BridgeParameters asked, const Host &host);

/** Puts blends in place of creases. */
Values round_edges(MeshModel &model, const MeshView &view, RoundParameters asked, const Host &host);

/** Writes the mean curvature of all vertices to their quality; 0 to those without faces. */
Values mean_curvature(MeshModel &model, const MeshView &view, const Host &host);

/** The library's callback for the host's progress bar, which says in `cancelled` whether the host has stopped the run. */
fairmesh::progress shown(const Host &host, bool &cancelled);

constexpr char CANCELLED[] = "Cancelled. The mesh is as it was.";

} // namespace fairmesh_meshlab

#endif
