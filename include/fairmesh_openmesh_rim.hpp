/** fairmesh for OpenMesh: what the boundaries of holes are like before they are filled, `fairmesh::rim_roughness(mesh)`, and what spoils them
 *  taken away, `fairmesh::trim_boundary(mesh)`, for the meshes of fairmesh_openmesh.hpp. */
#ifndef FAIRMESH_OPENMESH_RIM_HPP
#define FAIRMESH_OPENMESH_RIM_HPP

#include <fairmesh_openmesh_fill.hpp>

namespace fairmesh {

/** The boundary loops of a mesh with how rough their rims are; see fairmesh_rim_roughness. Where `is_rough` says so, `advised_relax_rim` and
 *  `advised_relax_within` are for `relax_rim` and `relax_within` of the `patches` of fill(mesh). */
template <class Mesh, class = std::enable_if_t<detail::is_openmesh<Mesh>>>
std::vector<openmesh_loop> rim_roughness(const Mesh &mesh, const openmesh_options &asked = openmesh_options()) {
    detail::openmesh_check<std::remove_const_t<Mesh>>();
    const detail::openmesh_view<Mesh> view(mesh, asked);
    return detail::openmesh_loops_of(rim_roughness(view.mesh()));
}

/** What was taken away at boundaries. */
struct openmesh_trimmed {
    /** The faces: deleted, which they stay until garbage_collection(). */
    std::vector<OpenMesh::FaceHandle> faces;
    /** Their area. */
    double area = 0.0;
};

namespace detail {

template <class Mesh, class Run> openmesh_trimmed openmesh_trim(Mesh &mesh, const openmesh_options &asked, Run run) {
    openmesh_check<Mesh>();
    openmesh_check_deletable(mesh);
    openmesh_view<Mesh> view(mesh, asked);
    openmesh_trimmed done;
    try {
        const trimmed_triangles left = run(view.mesh());
        done.area = left.area;
        done.faces = view.keep(left.kept);
    } catch (const error &caught) {
        openmesh_rethrow(view, caught);
    }
    for (const auto face : done.faces) mesh.delete_face(face, true);
    return done;
}

} // namespace detail

/** Deletes faces at all holes that would spoil patches: slender ones, spikes and fins, and those that hang at the others by one edge; see
 *  fairmesh_trim_boundary. The mesh needs the status of vertices, edges, half-edges and faces. Loops count anew afterwards. Errors as those of
 *  fair(mesh). */
template <class Mesh, class = std::enable_if_t<detail::is_openmesh<Mesh>>>
openmesh_trimmed trim_boundary(Mesh &mesh, const trim_limits &limits = trim_limits(), const openmesh_options &asked = openmesh_options()) {
    return detail::openmesh_trim(mesh, asked, [&](const fairmesh_mesh &plain) { return trim_boundary(plain, limits); });
}

/** The same at these loops, by their numbers in boundary_loops(mesh). */
template <class Mesh, class = std::enable_if_t<detail::is_openmesh<Mesh>>>
openmesh_trimmed trim_boundary(Mesh &mesh, const std::vector<std::uint32_t> &loops, const trim_limits &limits = trim_limits(),
                               const openmesh_options &asked = openmesh_options()) {
    return detail::openmesh_trim(mesh, asked, [&](const fairmesh_mesh &plain) { return trim_boundary(plain, loops, limits); });
}

} // namespace fairmesh

#endif
