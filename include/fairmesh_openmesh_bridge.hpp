/** fairmesh for OpenMesh: `fairmesh::bridge(mesh, from, to, options)`, a strip of surface between two boundary edges or runs of them, for the
 *  meshes of fairmesh_openmesh.hpp. */
#ifndef FAIRMESH_OPENMESH_BRIDGE_HPP
#define FAIRMESH_OPENMESH_BRIDGE_HPP

#include <fairmesh_openmesh_fill.hpp>

namespace fairmesh {

/** What is asked: how the strip is faired, and what it shall be. `region`, `features` and the names of properties are not read. */
struct openmesh_bridge_options : openmesh_options {
    /** Width, and whether the holes beside the strip are filled, too. */
    bridge_options strip;
    /** Density; what becomes of a strip that is not fair. Loops, groups, guides and `relax_rim` are not read. */
    fill_options patches;
};

/** What was done. Vertices and faces have OpenMesh's numbers. */
struct openmesh_bridged : fairmesh_bridge_report {
    openmesh_patch strip;
    /** The holes beside the strip, if they were to be filled. */
    std::vector<openmesh_patch> rest;
    /** The runs that the strip begins and ends at, in the direction in which its faces run through them. */
    std::array<std::vector<OpenMesh::VertexHandle>, 2> chains;
    /** The new vertices on either side of the strip: from the first run to the second, and back. */
    std::array<std::vector<OpenMesh::VertexHandle>, 2> sides;
    /** Whether there is nothing to be said of the result, see fairmesh_info. */
    bool is_success = false;
    /** If `has_whole` says so, how the fairing of all that is new together went. */
    fairmesh_report whole{};
};

/** Connects two runs of boundary edges by a strip that is tangent to the mesh at both; see fairmesh_bridge. Each is given by its vertices, one
 *  after the other, in either direction: at least two, or one if the strip has a width. What is new gets properties as from fill(mesh), and
 *  errors are those of fill(mesh). */
template <class Mesh, class = std::enable_if_t<detail::is_openmesh<Mesh>>>
openmesh_bridged bridge(Mesh &mesh, const std::vector<OpenMesh::VertexHandle> &from, const std::vector<OpenMesh::VertexHandle> &to,
                        const openmesh_bridge_options &asked = openmesh_bridge_options()) {
    detail::openmesh_check<Mesh>();
    const detail::openmesh_open<Mesh> open(mesh, asked);
    std::array<std::vector<std::uint32_t>, 2> chains;
    for (const auto vertex : from) chains[0].push_back(detail::openmesh_index(vertex));
    for (const auto vertex : to) chains[1].push_back(detail::openmesh_index(vertex));
    openmesh_bridged done{};
    const auto run = [&](const options &plain) {
        result made = bridge(open.view.mesh(), chains[0], chains[1], asked.strip, asked.patches, plain);
        static_cast<fairmesh_bridge_report &>(done) = made.bridge_report();
        for (std::size_t k = 0; k < 2; k++) {
            done.chains[k] = detail::openmesh_handles<OpenMesh::VertexHandle>(made.list(FAIRMESH_LIST_BRIDGE_CHAIN, k));
            done.sides[k] = detail::openmesh_handles<OpenMesh::VertexHandle>(made.list(FAIRMESH_LIST_BRIDGE_SIDE, k));
        }
        done.is_success = made.is_success();
        if (done.has_whole) {
            done.whole = made.report(made.info().loop_count);
        }
        return made;
    };
    auto patches = detail::openmesh_run(mesh, open, asked, run);
    done.strip = patches.front();
    done.rest.assign(patches.begin() + 1, patches.end());
    return done;
}

/** The same between two boundary edges. */
template <class Mesh, class = std::enable_if_t<detail::is_openmesh<Mesh>>>
openmesh_bridged bridge(Mesh &mesh, OpenMesh::EdgeHandle from, OpenMesh::EdgeHandle to,
                        const openmesh_bridge_options &asked = openmesh_bridge_options()) {
    const auto ends = [&](OpenMesh::EdgeHandle edge) {
        const auto halfedge = mesh.halfedge_handle(edge, 0);
        return std::vector<OpenMesh::VertexHandle>{mesh.from_vertex_handle(halfedge), mesh.to_vertex_handle(halfedge)};
    };
    return bridge(mesh, ends(from), ends(to), asked);
}

} // namespace fairmesh

#endif
