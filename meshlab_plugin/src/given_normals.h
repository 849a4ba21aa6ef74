// SPDX-License-Identifier: MIT OR Apache-2.0
/** Boundary normals that the user gives: the vertex normals of the mesh, or a per-vertex attribute. */
#ifndef FAIRMESH_MESHLAB_GIVEN_NORMALS_H
#define FAIRMESH_MESHLAB_GIVEN_NORMALS_H

#include "host.h"

#include <array>
#include <string>
#include <vector>

namespace fairmesh_meshlab {

/** One vector per vertex, of length one, or 0 0 0 where none is given. */
using Vectors = std::vector<std::array<double, 3>>;

/** The vertex normals of the mesh, whose length in MeshLab is arbitrary. */
Vectors vertex_normals(const CMeshO &mesh);

/** A custom attribute: points named `name`, or else three numbers named `name`_x, `name`_y and `name`_z, which is what MeshLab 2020
 *  can make. Throws Failure if there is none. The mesh is not const for vcg's sake. */
Vectors attribute_normals(CMeshO &mesh, const std::string &name);

} // namespace fairmesh_meshlab

#endif
