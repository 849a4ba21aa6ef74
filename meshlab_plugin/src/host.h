// SPDX-License-Identifier: MIT OR Apache-2.0
/** MeshLab's headers, of either plugin interface, and what the filters need of the program around them. */
#ifndef FAIRMESH_MESHLAB_HOST_H
#define FAIRMESH_MESHLAB_HOST_H

#ifdef FAIRMESH_MESHLAB_2020
#include <common/interfaces.h>
#else
#include <common/plugins/interfaces/filter_plugin.h>
#endif

#include <functional>
#include <map>
#include <stdexcept>
#include <string>

namespace fairmesh_meshlab {

/** The host's number: float or double. */
using Scalar = CMeshO::ScalarType;
using Point = CMeshO::CoordType;

/** What a filter returns to a script. */
using Values = std::map<std::string, QVariant>;

/** The host's progress bar and log. */
struct Host {
    /** May be null; false asks the filter to stop. */
    vcg::CallBackPos *progress = nullptr;
    std::function<void(const std::string &)> log;
    std::function<void(const std::string &)> warn;
};

/** A filter that was not applied; the mesh is as it was. The text is for the user. */
struct Failure : std::runtime_error {
    using std::runtime_error::runtime_error;
};

} // namespace fairmesh_meshlab

#endif
