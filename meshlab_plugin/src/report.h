// SPDX-License-Identifier: MIT OR Apache-2.0
/** What a filter tells: lines of the log, and values for scripts. */
#ifndef FAIRMESH_MESHLAB_REPORT_H
#define FAIRMESH_MESHLAB_REPORT_H

#include "host.h"
#include "mesh_view.h"

#include <fairmesh.hpp>

#include <string>

namespace fairmesh_meshlab {

/** printf into a string. */
[[gnu::format(printf, 1, 2)]] std::string text(const char *format, ...);

/** A fairing's report as values; faces are the host's. */
Values values_of(const fairmesh_report &report, const MeshView &view);

/** A fairing's report in the log. An outcome with a reservation is a warning. */
void log_report(const fairmesh_report &report, const MeshView &view, const Host &host);

/** In the log: how many components the region has, where they are several, and those that are not fair. */
void log_components(const fairmesh::result &result, const Host &host);

/** In the log: how far curvature is continued along each boundary loop of a region, the one with this index of the result. */
void log_continuity(const fairmesh::result &result, double asked, const Host &host, std::uint64_t index = 0);

/** In the log: what became of the sharp edges that reach the boundary of a region, the one with this index of the result. */
void log_sharp_edges(const fairmesh::result &result, const Host &host, std::uint64_t index = 0);

/** What an outcome means to the user; empty for one without reservation. */
std::string reservation(const fairmesh_report &report);

/** What became of a hole that was not closed with a faired surface; empty for one that was. */
std::string reservation(const fairmesh_fill_report &report);

/** An error of the library in the host's words and numbers. */
std::string explained(const fairmesh::error &error, const MeshView &view);

} // namespace fairmesh_meshlab

#endif
