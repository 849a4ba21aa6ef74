/** fairmesh for OpenMesh: `fairmesh::fair(mesh, options)` for any triangle mesh of OpenMesh 9 with points of floats or
 *  doubles. It carries the mesh to the library and the positions back, and computes nothing. Include it after OpenMesh's headers or
 *  before; link fairmesh and OpenMeshCore. */
#ifndef FAIRMESH_OPENMESH_HPP
#define FAIRMESH_OPENMESH_HPP

#include <fairmesh.hpp>

#include <OpenMesh/Core/Mesh/BaseKernel.hh>
#include <OpenMesh/Core/Mesh/Handles.hh>
#include <OpenMesh/Core/Utils/Property.hh>
#include <OpenMesh/Core/Utils/vector_traits.hh>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <vector>

namespace fairmesh {

/** Where the region comes from. Whatever is said, vertices stay that are locked or on the boundary of the surface. */
enum class openmesh_region {
    /** Vertices whose status says selected. */
    selected_vertices,
    /** Vertices all of whose faces are selected. */
    selected_faces,
    /** All. */
    everything
};

/** What is asked: fairmesh::options, and what concerns OpenMesh. Vertices have OpenMesh's numbers in `boundary_normals` and
 *  `boundary_curvature`, too. */
struct openmesh_options : options {
    openmesh_region region = openmesh_region::selected_vertices;
    /** Vertices stay that are features, or corners of feature edges or feature faces. The surface passes feature edges
     *  inside the region as `interior_normals` says. Without it features are not looked at. */
    bool features = true;
    /** Whether boundary edges of the mesh that lie on each other are one edge of the surface, as at the seams of a mesh that was cut
     *  for its texture: the copies of a vertex then move alike, if all are in the region. Else the mesh ends where OpenMesh says. */
    fairmesh_coincident coincident = FAIRMESH_COINCIDENT_JOIN;
    /** They lie on each other up to this distance; see fairmesh_mesh. */
    double coincident_within = 0.0;
    /** A vertex property of vectors, such as "v:normals" for the mesh's own normals: unit normals at the boundary of the region,
     *  0 0 0 where none is given. Empty: `boundary_normals` says where they come from. */
    std::string boundary_normals_property;
    /** A vertex property of doubles or floats: the mean curvature that is to be continued, in 1 / length, negative on a sphere, where
     *  `continuity` is not 0; NaN where none is given. Empty: `boundary_curvature` says where it comes from. */
    std::string boundary_curvature_property;
    /** A vertex property of doubles or floats for the mean curvature, in 1 / length, negative on a sphere; NaN at vertices
     *  that are not free. It is made, of doubles, if there is none. Empty: not wanted. */
    std::string mean_curvature;
};

/** How it went. Vertices and faces have OpenMesh's numbers, `worst_triangle` too. */
struct openmesh_report : fairmesh_report {
    /** Flipped or with an angle below one degree, where the outcome is about them. */
    std::vector<OpenMesh::FaceHandle> poor_triangles;
    /** Boundary vertices whose normal contradicts the surface or its neighbours'. */
    std::vector<OpenMesh::VertexHandle> suspicious_normals;
    /** Pairs of faces that intersect; at least one of each has a free vertex. */
    std::vector<std::array<OpenMesh::FaceHandle, 2>> intersections;
    /** Where `continuity` is not 0: how far the curvature of the surroundings is continued along each boundary loop. */
    std::vector<fairmesh_continuity> continuity;
};

namespace detail {

template <class Mesh> constexpr bool is_openmesh = std::is_base_of_v<OpenMesh::BaseKernel, std::remove_const_t<Mesh>>;

inline OpenMesh::VertexHandle openmesh_vertex(std::size_t index) {
    return OpenMesh::VertexHandle(static_cast<int>(index));
}

/** A mesh's arrays. Vertices keep their numbers; faces that are deleted are left out, so that the others' change. */
template <class Mesh> class openmesh_view {
public:
    using scalar = typename OpenMesh::vector_traits<typename Mesh::Point>::value_type;

    openmesh_view(const Mesh &mesh, const openmesh_options &asked)
        : mesh_(mesh), coincident_(asked.coincident), within_(asked.coincident_within) {
        copy_points();
        copy_faces();
    }

    fairmesh_mesh mesh() const {
        auto made = fairmesh::mesh(points(positions_.data(), positions_.size() / 3), indices(corners_.data(), corners_.size() / 3));
        made.coincident = coincident_;
        made.coincident_within = within_;
        return made;
    }

    /** The face that the library means. */
    std::uint64_t face(std::uint64_t triangle) const {
        return triangle < faces_.size() ? static_cast<std::uint64_t>(faces_[static_cast<std::size_t>(triangle)].idx()) : triangle;
    }

    /** The faces that the library sees, in its order. */
    const std::vector<OpenMesh::FaceHandle> &faces() const noexcept { return faces_; }

    /** Leaves out all triangles but these, ascending; the faces that are left out. */
    std::vector<OpenMesh::FaceHandle> keep(const std::vector<std::uint32_t> &kept) {
        std::vector<OpenMesh::FaceHandle> faces, gone;
        std::vector<std::uint32_t> corners;
        auto next = kept.begin();
        for (std::size_t t = 0; t < faces_.size(); t++) {
            if (next == kept.end() || *next != t) {
                gone.push_back(faces_[t]);
                continue;
            }
            ++next;
            faces.push_back(faces_[t]);
            corners.insert(corners.end(), {corners_[3 * t], corners_[3 * t + 1], corners_[3 * t + 2]});
        }
        faces_.swap(faces);
        corners_.swap(corners);
        return gone;
    }

    /** One byte per vertex: not zero is free. */
    std::vector<std::uint8_t> free(const openmesh_options &asked) const {
        if (asked.region == openmesh_region::selected_vertices && !mesh_.has_vertex_status()) {
            throw std::invalid_argument("no vertex can be selected: see request_vertex_status()");
        }
        if (asked.region == openmesh_region::selected_faces && !mesh_.has_face_status()) {
            throw std::invalid_argument("no face can be selected: see request_face_status()");
        }
        std::vector<std::uint8_t> free(mesh_.n_vertices());
        bool has_boundary = false;
        for (std::size_t v = 0; v < free.size(); v++) {
            auto vertex = openmesh_vertex(v);
            free[v] = !deleted(vertex) && !mesh_.is_isolated(vertex) && in_region(vertex, asked.region) && !locked(vertex);
            has_boundary = has_boundary || (free[v] && mesh_.is_boundary(vertex));
        }
        if (has_boundary) fix_boundary(free);
        if (asked.features) fix_features(free);
        return free;
    }

    /** The numbers of a vertex property of vectors, for the whole mesh. */
    template <class Vector> std::vector<scalar> vectors(OpenMesh::VPropHandleT<Vector> property) const {
        std::vector<scalar> all;
        all.reserve(3 * mesh_.n_vertices());
        for (std::size_t v = 0; v < mesh_.n_vertices(); v++) {
            const auto &vector = mesh_.property(property, openmesh_vertex(v));
            for (std::size_t k = 0; k < 3; k++) all.push_back(static_cast<scalar>(vector[k]));
        }
        return all;
    }

private:
    const Mesh &mesh_;
    fairmesh_coincident coincident_;
    double within_;
    std::vector<scalar> positions_;
    std::vector<std::uint32_t> corners_;
    std::vector<OpenMesh::FaceHandle> faces_;

    // OpenMesh deletes nothing unless there is a status of all.
    bool deleted(OpenMesh::VertexHandle vertex) const { return mesh_.has_vertex_status() && mesh_.status(vertex).deleted(); }
    bool deleted(OpenMesh::FaceHandle face) const { return mesh_.has_face_status() && mesh_.status(face).deleted(); }

    bool locked(OpenMesh::VertexHandle vertex) const { return mesh_.has_vertex_status() && mesh_.status(vertex).locked(); }

    bool in_region(OpenMesh::VertexHandle vertex, openmesh_region region) const {
        if (region == openmesh_region::everything) return true;
        if (region == openmesh_region::selected_vertices) return mesh_.status(vertex).selected();
        for (auto face = mesh_.cvf_begin(vertex); face.is_valid(); ++face) {
            if (!mesh_.status(*face).selected()) return false;
        }
        return true;
    }

    void copy_points() {
        positions_.reserve(3 * mesh_.n_vertices());
        for (std::size_t v = 0; v < mesh_.n_vertices(); v++) {
            const auto &point = mesh_.point(openmesh_vertex(v));
            for (std::size_t k = 0; k < 3; k++) positions_.push_back(point[k]);
        }
    }

    void copy_faces() {
        corners_.reserve(3 * mesh_.n_faces());
        faces_.reserve(mesh_.n_faces());
        for (std::size_t f = 0; f < mesh_.n_faces(); f++) {
            OpenMesh::FaceHandle face(static_cast<int>(f));
            if (deleted(face)) continue;
            faces_.push_back(face);
            for (auto corner = mesh_.cfv_begin(face); corner.is_valid(); ++corner) {
                corners_.push_back(static_cast<std::uint32_t>(corner->idx()));
            }
        }
    }

    void fix_boundary(std::vector<std::uint8_t> &free) const {
        if (coincident_ == FAIRMESH_COINCIDENT_SEPARATE) {
            for (std::size_t v = 0; v < free.size(); v++) free[v] = free[v] && !mesh_.is_boundary(openmesh_vertex(v));
            return;
        }
        const auto loops = boundary_loops(mesh());
        for (std::size_t loop = 0; loop < loops.info().loop_count; loop++) {
            for (auto v : loops.list(FAIRMESH_LIST_LOOP_VERTICES, loop)) free[v] = 0;
        }
    }

    void fix_features(std::vector<std::uint8_t> &free) const {
        if (mesh_.has_vertex_status()) {
            for (std::size_t v = 0; v < free.size(); v++) {
                if (mesh_.status(openmesh_vertex(v)).feature()) free[v] = 0;
            }
        }
        if (mesh_.has_face_status()) {
            for (std::size_t corner = 0; corner < corners_.size(); corner++) {
                if (mesh_.status(faces_[corner / 3]).feature()) free[corners_[corner]] = 0;
            }
        }
        if (!mesh_.has_edge_status()) return;
        for (std::size_t e = 0; e < mesh_.n_edges(); e++) {
            OpenMesh::EdgeHandle edge(static_cast<int>(e));
            if (!mesh_.status(edge).feature() || mesh_.status(edge).deleted()) continue;
            auto halfedge = mesh_.halfedge_handle(edge, 0);
            free[static_cast<std::size_t>(mesh_.to_vertex_handle(halfedge).idx())] = 0;
            free[static_cast<std::size_t>(mesh_.from_vertex_handle(halfedge).idx())] = 0;
        }
    }
};

/** A vertex property of numbers, made if need be; unmade unless the run ends well. */
template <class Mesh> class openmesh_numbers {
public:
    openmesh_numbers(Mesh &mesh, const std::string &name) : mesh_(mesh) {
        if (name.empty() || mesh.get_property_handle(doubles_, name) || mesh.get_property_handle(floats_, name)) return;
        made_ = true;
        try {
            mesh.add_property(doubles_, name);
        } catch (...) {
            // OpenMesh may have added it without giving it its size. (To look for its name would need memory.)
            if (doubles_.is_valid()) mesh.remove_property(doubles_);
            throw;
        }
    }
    openmesh_numbers(const openmesh_numbers &) = delete;
    openmesh_numbers &operator=(const openmesh_numbers &) = delete;
    ~openmesh_numbers() {
        if (made_) mesh_.remove_property(doubles_);
    }

    bool wanted() const noexcept { return doubles_.is_valid() || floats_.is_valid(); }

    /** Until the numbers are written, something may throw; not after that. */
    void write(const std::vector<double> &values) {
        if (doubles_.is_valid()) fill(mesh_.property(doubles_), values);
        else if (floats_.is_valid()) fill(mesh_.property(floats_), values);
        made_ = false;
    }

private:
    Mesh &mesh_;
    OpenMesh::VPropHandleT<double> doubles_;
    OpenMesh::VPropHandleT<float> floats_;
    bool made_ = false;

    template <class Number> static void fill(OpenMesh::PropertyT<Number> &property, const std::vector<double> &values) {
        for (std::size_t v = 0; v < values.size(); v++) property[static_cast<int>(v)] = static_cast<Number>(values[v]);
    }
};

/** The vectors of a vertex property by its name: of the mesh's own normals or points, of doubles, of floats. */
template <class Mesh>
std::vector<typename openmesh_view<Mesh>::scalar> openmesh_normals(const Mesh &mesh, const openmesh_view<Mesh> &view,
                                                                   const std::string &name) {
    OpenMesh::VPropHandleT<typename Mesh::Normal> own;
    if (mesh.get_property_handle(own, name)) return view.vectors(own);
    OpenMesh::VPropHandleT<OpenMesh::VectorT<double, 3>> doubles;
    if (mesh.get_property_handle(doubles, name)) return view.vectors(doubles);
    OpenMesh::VPropHandleT<OpenMesh::VectorT<float, 3>> floats;
    if (mesh.get_property_handle(floats, name)) return view.vectors(floats);
    throw std::invalid_argument("the mesh has no vertex property of vectors with the name " + name);
}

/** The numbers of a vertex property by its name, of doubles or floats. */
template <class Mesh> std::vector<double> openmesh_given(const Mesh &mesh, const std::string &name) {
    std::vector<double> values(mesh.n_vertices());
    const auto copied = [&](const auto &property) {
        for (std::size_t v = 0; v < values.size(); v++) values[v] = mesh.property(property, openmesh_vertex(v));
        return values;
    };
    OpenMesh::VPropHandleT<double> doubles;
    if (mesh.get_property_handle(doubles, name)) return copied(doubles);
    OpenMesh::VPropHandleT<float> floats;
    if (mesh.get_property_handle(floats, name)) return copied(floats);
    throw std::invalid_argument("the mesh has no vertex property of numbers with the name " + name);
}

/** The same error about the face that OpenMesh knows. */
template <class View> [[noreturn]] void openmesh_rethrow(const View &view, const error &caught) {
    fairmesh_error why = caught.detail();
    if (why.element_kind != FAIRMESH_ELEMENT_TRIANGLE || view.face(why.element) == why.element) throw error(caught);
    why.element = view.face(why.element);
    if (why.status == FAIRMESH_STATUS_DUPLICATE_TRIANGLE) why.other = view.face(why.other);
    std::string text = "face " + std::to_string(why.element) + ": " + name(FAIRMESH_ANSWER_STATUS, why.status);
    std::size_t size = std::min(text.size(), sizeof why.message - 1);
    std::copy_n(text.data(), size, why.message);
    why.message[size] = '\0';
    throw error(why);
}

/** The view's free vertices, with errors about OpenMesh's faces. */
template <class View> std::vector<std::uint8_t> openmesh_free(const View &view, const openmesh_options &asked) {
    try {
        return view.free(asked);
    } catch (const error &caught) {
        openmesh_rethrow(view, caught);
    }
}

template <class Handle> std::vector<Handle> openmesh_handles(const std::vector<std::uint32_t> &indices) {
    std::vector<Handle> handles;
    handles.reserve(indices.size());
    for (auto index : indices) handles.emplace_back(static_cast<int>(index));
    return handles;
}

template <class View> openmesh_report openmesh_told(const View &view, const result &found) {
    openmesh_report told{};
    static_cast<fairmesh_report &>(told) = found.report();
    told.worst_triangle = view.face(told.worst_triangle);
    for (auto triangle : found.list(FAIRMESH_LIST_POOR_TRIANGLES)) {
        told.poor_triangles.emplace_back(static_cast<int>(view.face(triangle)));
    }
    for (std::uint64_t part = 0; part < told.component_count; part++) {
        const std::uint64_t loops = found.component(part).continuity_count;
        for (std::uint64_t loop = 0; loop < loops; loop++) told.continuity.push_back(found.continuity(part, loop));
    }
    told.suspicious_normals = openmesh_handles<OpenMesh::VertexHandle>(found.list(FAIRMESH_LIST_SUSPICIOUS_NORMALS));
    const auto pairs = found.list(FAIRMESH_LIST_INTERSECTIONS);
    const auto face = [&](std::uint32_t triangle) { return OpenMesh::FaceHandle(static_cast<int>(view.face(triangle))); };
    for (std::size_t k = 0; k + 1 < pairs.size(); k += 2) told.intersections.push_back({face(pairs[k]), face(pairs[k + 1])});
    return told;
}

/** Why a mesh cannot be taken, at compile time. */
template <class Mesh> constexpr void openmesh_check() {
    static_assert(!std::is_const_v<Mesh>, "fairmesh::fair moves vertices: the OpenMesh mesh must not be const");
    static_assert(Mesh::is_trimesh(), "fairmesh::fair needs a triangle mesh of OpenMesh (TriMesh_ArrayKernelT): a PolyMesh "
                                      "has to be triangulated and copied into one first");
    using traits = OpenMesh::vector_traits<typename Mesh::Point>;
    static_assert(traits::size_ == 3, "fairmesh::fair needs points with three coordinates");
    static_assert(std::is_same_v<typename traits::value_type, float> || std::is_same_v<typename traits::value_type, double>,
                  "fairmesh::fair needs points of floats or doubles");
}

} // namespace detail

/** Moves the free vertices of a mesh until the surface is fair; see fairmesh_fair. Nothing but their points and the
 *  property `mean_curvature` is written, so normals want to be updated afterwards. Deleted elements are skipped.
 *
 *  Errors of the library are fairmesh::error, with OpenMesh's numbers; std::invalid_argument says that the mesh has not what
 *  the options name. Whatever is thrown, also by the callback, the mesh is as it was. A callback that returns false gets the
 *  best surface so far. */
template <class Mesh, class = std::enable_if_t<detail::is_openmesh<Mesh>>>
openmesh_report fair(Mesh &mesh, const openmesh_options &asked = openmesh_options()) {
    detail::openmesh_check<Mesh>();
    using view_of = detail::openmesh_view<Mesh>;
    using scalar = typename view_of::scalar;
    const view_of view(mesh, asked);
    const auto free = detail::openmesh_free(view, asked);
    detail::openmesh_numbers<Mesh> curvature(mesh, asked.mean_curvature);

    options plain = asked;
    if (std::is_same_v<scalar, float>) plain.output_precision = FAIRMESH_OUTPUT_PRECISION_SINGLE;
    std::vector<scalar> normals;
    if (!asked.boundary_normals_property.empty()) {
        normals = detail::openmesh_normals(mesh, view, asked.boundary_normals_property);
        plain.boundary_normals = fairmesh_boundary_normals{};
        plain.boundary_normals.kind = FAIRMESH_BOUNDARY_NORMALS_KIND_GIVEN;
        plain.boundary_normals.vectors = points(normals.data(), normals.size() / 3);
    }
    std::vector<double> given;
    if (!asked.boundary_curvature_property.empty()) {
        given = detail::openmesh_given(mesh, asked.boundary_curvature_property);
        plain.boundary_curvature = fairmesh_boundary_curvature{};
        plain.boundary_curvature.kind = FAIRMESH_BOUNDARY_CURVATURE_KIND_GIVEN;
        plain.boundary_curvature.values = numbers(given.data(), given.size());
    }

    try {
        const auto found = fair(view.mesh(), free_mask(free), plain);
        std::vector<scalar> positions(3 * mesh.n_vertices());
        found.positions(points_out(positions.data(), positions.size() / 3));
        std::vector<double> h;
        if (curvature.wanted()) h = found.scalars(FAIRMESH_SCALARS_MEAN_CURVATURE);
        auto told = detail::openmesh_told(view, found);
        // To look properties up may throw where OpenMesh's assertions are on, to write into them does not.
        auto &points = mesh.property(mesh.points_property_handle());
        curvature.write(h);
        for (std::size_t v = 0; v < free.size(); v++) {
            if (!free[v]) continue;
            for (std::size_t k = 0; k < 3; k++) points[static_cast<int>(v)][k] = positions[3 * v + k];
        }
        return told;
    } catch (const error &caught) {
        detail::openmesh_rethrow(view, caught);
    }
}

} // namespace fairmesh

#endif
