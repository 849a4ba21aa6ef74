// SPDX-License-Identifier: MIT OR Apache-2.0
/** The filters, independent of the plugin interface. Each throws an exception that tells why it was not applied; the mesh is as it
 * was then. */
#ifndef FAIRMESH_MESHLAB_FILTERS_H
#define FAIRMESH_MESHLAB_FILTERS_H

#include "host.h"

namespace fairmesh_meshlab {

/** The filters' numbers in the plugin. */
enum Filter { FairSelection, CloseHoles, MeanCurvature, EraseAndFill, BridgeBoundaries, RoundEdges };
constexpr Filter FILTERS[] = {FairSelection, CloseHoles, MeanCurvature, EraseAndFill, BridgeBoundaries, RoundEdges};

/** Name in menus and scripts of MeshLab. */
QString name(int filter);
/** Name in Python. */
QString python_name(int filter);
/** Help text, HTML. */
QString help(int filter);
/** A mask of the host's FilterClass: the menus that it is in. */
int menus(int filter);
/** Masks of MeshModel::MeshElement: what the filter needs, and what it changes. */
int needs(int filter);
int changes(int filter);

/** Its parameters. */
RichParameterList parameters(int filter);

/** Applies it to a mesh, which may be null (an empty document). */
Values apply(int filter, MeshModel *model, const RichParameterList &asked, const Host &host);

} // namespace fairmesh_meshlab

#endif
