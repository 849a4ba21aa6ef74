/** fairmesh for OpenMesh: `fairmesh::fill(mesh, options)` and `fairmesh::erase_and_fill(mesh, options)`, for the meshes of
 *  fairmesh_openmesh.hpp. They carry the mesh to the library and the patches back. */
#ifndef FAIRMESH_OPENMESH_FILL_HPP
#define FAIRMESH_OPENMESH_FILL_HPP

#include <fairmesh_openmesh.hpp>

#include <OpenMesh/Core/Mesh/Status.hh>

namespace fairmesh {

/** Which loops are filled. */
enum class openmesh_loops {
    /** Those that `patches` of the options asks for. */
    as_asked,
    /** Those whose vertices are all selected, each with a patch of its own; outer boundaries, too. */
    selected,
    /** The same, with one patch for all of them. */
    selected_joined
};

/** What is asked: how patches are faired, and which. `region`, `features` and the names of properties are not read. */
struct openmesh_fill_options : openmesh_options {
    /** Which loops, and which of them together, by their numbers in boundary_loops(mesh); density; what becomes of a loop without a
     *  fair patch. */
    fill_options patches;
    openmesh_loops loops = openmesh_loops::as_asked;
    /** Pairs of boundary vertices that the triangulation shall have an edge between, beside those that `patches` names. */
    std::vector<std::array<OpenMesh::VertexHandle, 2>> guides;
    /** erase_and_fill drops up to so many faces more that would spoil the boundary of the patch: slender ones, and fins. */
    std::uint64_t clean = 0;
    /** erase_and_fill takes the properties of what is new from the nearest place of what was erased, not from the edge of the hole. */
    bool carry_over = false;
};

/** A boundary loop. */
struct openmesh_loop : fairmesh_loop {
    /** In the direction of faces that fill it. */
    std::vector<OpenMesh::VertexHandle> vertices;
};

/** What became of a loop, or of several that are joined. Numbers are OpenMesh's. */
struct openmesh_patch : fairmesh_fill_report {
    /** The loops, by their numbers in boundary_loops(mesh), of the mesh without the faces that were erased. */
    std::vector<std::uint32_t> loops;
    /** New vertices and faces. */
    std::vector<OpenMesh::VertexHandle> vertices;
    std::vector<OpenMesh::FaceHandle> faces;
};

/** What was done. */
struct openmesh_filled {
    std::vector<openmesh_patch> patches;
    /** Faces that were erased besides the selected ones: they would have hung loose. */
    std::uint64_t dropped = 0;
    /** Faces that were erased besides because they would have spoilt the boundary of the patch. */
    std::uint64_t cleaned = 0;
};

namespace detail {

template <class Value> struct openmesh_mixable {
    using number = Value;
    static constexpr std::size_t size = 1;
    static number &at(Value &value, std::size_t) { return value; }
};
template <class Number, int Size> struct openmesh_mixable<OpenMesh::VectorT<Number, Size>> {
    using number = Number;
    static constexpr std::size_t size = Size;
    static number &at(OpenMesh::VectorT<Number, Size> &value, std::size_t k) { return value[k]; }
};

/** Where the new vertices of a patch come from: three parents each, with weights. */
struct openmesh_parents {
    std::size_t first = 0;
    std::vector<std::uint32_t> vertices;
    std::vector<std::array<double, 3>> weights;

    std::size_t main(std::size_t k) const {
        const auto &w = weights[k];
        return vertices[3 * k + static_cast<std::size_t>(std::max_element(w.begin(), w.end()) - w.begin())];
    }

    /** Interpolates a property, if it is of such values. */
    template <class Value> bool mix(OpenMesh::BaseProperty *property) const {
        auto *typed = dynamic_cast<OpenMesh::PropertyT<Value> *>(property);
        if (!typed) return false;
        using mixable = openmesh_mixable<Value>;
        for (std::size_t k = 0; k < weights.size(); k++) {
            Value mixed = (*typed)[static_cast<int>(main(k))];
            for (std::size_t c = 0; c < mixable::size; c++) {
                double sum = 0.0;
                for (std::size_t i = 0; i < 3; i++) {
                    sum += weights[k][i] * mixable::at((*typed)[static_cast<int>(vertices[3 * k + i])], c);
                }
                using number = typename mixable::number;
                // Colours are numbers of eight bits.
                mixable::at(mixed, c) = static_cast<number>(std::is_integral_v<number> ? sum + 0.5 : sum);
            }
            (*typed)[static_cast<int>(first + k)] = mixed;
        }
        return true;
    }

    template <class... Values> void mix_first_of(OpenMesh::BaseProperty *property) const {
        static_cast<void>((mix<Values>(property) || ...));
    }
};

/** The mesh that the library fills, and what of the real one is not in it. */
template <class Mesh> struct openmesh_open {
    openmesh_view<Mesh> view;
    std::vector<OpenMesh::FaceHandle> erased;
    std::vector<std::uint32_t> loops;
    std::uint64_t dropped = 0, cleaned = 0;
    /** The mesh with what is erased, and the triangles that are, if properties are taken from there. */
    std::unique_ptr<const openmesh_view<Mesh>> was;
    std::vector<std::uint32_t> gone;

    openmesh_open(const Mesh &mesh, const openmesh_options &asked) : view(mesh, asked) {}

    /** Leaves the selected faces out. */
    void erase_selected(const Mesh &mesh, std::uint64_t clean, bool carry_over) {
        std::vector<std::uint32_t> selected;
        const auto &faces = view.faces();
        for (std::size_t t = 0; t < faces.size(); t++) {
            if (mesh.status(faces[t]).selected()) selected.push_back(static_cast<std::uint32_t>(t));
        }
        const auto left = fairmesh::erase(view.mesh(), selected, clean);
        dropped = left.dropped;
        cleaned = left.cleaned;
        loops = left.loops;
        if (carry_over) {
            was = std::make_unique<const openmesh_view<Mesh>>(view);
            auto next = left.kept.begin();
            for (std::uint32_t t = 0; t < faces.size(); t++) {
                if (next != left.kept.end() && *next == t) ++next;
                else gone.push_back(t);
            }
        }
        erased = view.keep(left.kept);
    }

    /** The places of points on what is erased. */
    template <class Scalar> carried_points carried(const Scalar *x, std::size_t count) const {
        return carry_over(was->mesh(), gone, points(x, count));
    }
};

inline std::uint32_t openmesh_index(OpenMesh::VertexHandle vertex) {
    return static_cast<std::uint32_t>(vertex.idx());
}

/** The number of each loop whose vertices are all selected. */
template <class Mesh> std::vector<std::uint32_t> openmesh_selected_loops(const Mesh &mesh, const openmesh_view<Mesh> &view) {
    if (!mesh.has_vertex_status()) throw std::invalid_argument("no loop can be selected: see request_vertex_status()");
    const auto loops = boundary_loops(view.mesh());
    std::vector<std::uint32_t> selected;
    for (std::uint32_t loop = 0; loop < loops.info().loop_count; loop++) {
        const auto vertices = loops.list(FAIRMESH_LIST_LOOP_VERTICES, loop);
        const auto is_selected = [&](std::uint32_t v) { return mesh.status(openmesh_vertex(v)).selected(); };
        if (std::all_of(vertices.begin(), vertices.end(), is_selected)) selected.push_back(loop);
    }
    return selected;
}

/** Gives a face the properties of another one, and its colour. */
template <class Mesh> void openmesh_copy(Mesh &mesh, OpenMesh::FaceHandle from, OpenMesh::FaceHandle to) {
    mesh.copy_all_properties(from, to);
    if (mesh.has_face_colors()) mesh.set_color(to, mesh.color(from));
}

/** Gives new faces the properties of those that were nearest to their middles. */
template <class Mesh>
void openmesh_carry(Mesh &mesh, const openmesh_open<Mesh> &open, const std::vector<OpenMesh::FaceHandle> &made) {
    std::vector<double> middles;
    for (const auto face : made) {
        const auto middle = mesh.calc_face_centroid(face);
        for (std::size_t k = 0; k < 3; k++) middles.push_back(static_cast<double>(middle[k]));
    }
    const auto found = open.carried(middles.data(), made.size()).triangles;
    for (std::size_t k = 0; k < made.size(); k++) {
        if (found[k] < open.was->faces().size()) openmesh_copy(mesh, open.was->faces()[found[k]], made[k]);
    }
}

/** Gives new faces, which are the last ones, the properties of old faces near them. */
template <class Mesh> void openmesh_spread(Mesh &mesh, const std::vector<OpenMesh::FaceHandle> &made) {
    if (made.empty()) return;
    const int first = made.front().idx();
    std::vector<char> done(made.size());
    std::vector<OpenMesh::FaceHandle> front;
    const auto copy = [&](OpenMesh::FaceHandle from, OpenMesh::FaceHandle to) {
        openmesh_copy(mesh, from, to);
        done[static_cast<std::size_t>(to.idx() - first)] = 1;
        front.push_back(to);
    };
    for (const auto face : made) {
        for (auto beside = mesh.cff_begin(face); beside.is_valid(); ++beside) {
            if (beside->idx() >= first) continue;
            copy(OpenMesh::FaceHandle(beside->idx()), face);
            break;
        }
    }
    for (std::size_t k = 0; k < front.size(); k++) {
        const auto face = front[k];
        for (auto beside = mesh.cff_begin(face); beside.is_valid(); ++beside) {
            if (beside->idx() < first || done[static_cast<std::size_t>(beside->idx() - first)]) continue;
            copy(face, OpenMesh::FaceHandle(beside->idx()));
        }
    }
}

/** Adds the patches to a mesh, its erased faces being deleted. */
template <class Mesh>
std::vector<openmesh_patch> openmesh_add(Mesh &mesh, const openmesh_open<Mesh> &open, const result &filled) {
    using scalar = typename openmesh_view<Mesh>::scalar;
    const auto info = filled.info();
    const std::size_t olds = mesh.n_vertices(), count = static_cast<std::size_t>(info.vertex_count);
    std::vector<scalar> positions(3 * count);
    filled.positions(points_out(positions.data(), count));
    openmesh_parents parents{olds, filled.list(FAIRMESH_LIST_PARENTS), filled.vectors(FAIRMESH_VECTORS_PARENT_WEIGHTS)};
    if (open.was) {
        const auto carried = open.carried(positions.data() + 3 * olds, count - olds);
        for (std::size_t k = 0; k < carried.triangles.size(); k++) {
            if (carried.triangles[k] == UINT32_MAX) continue;
            std::copy_n(carried.corners.begin() + static_cast<std::ptrdiff_t>(3 * k), 3, parents.vertices.begin() + static_cast<std::ptrdiff_t>(3 * k));
            parents.weights[k] = carried.weights[k];
        }
    }
    for (const auto face : open.erased) mesh.delete_face(face, true);
    // Boundaries that were relaxed; others are as they were.
    for (std::size_t v = 0; v < olds; v++) {
        mesh.set_point(openmesh_vertex(static_cast<std::uint32_t>(v)),
                       typename Mesh::Point(positions[3 * v], positions[3 * v + 1], positions[3 * v + 2]));
    }
    for (std::size_t v = olds; v < count; v++) {
        const auto made = mesh.add_vertex(typename Mesh::Point(positions[3 * v], positions[3 * v + 1], positions[3 * v + 2]));
        mesh.copy_all_properties(openmesh_vertex(parents.main(v - olds)), made);
    }
    for (auto property = mesh.vprops_begin(); property != mesh.vprops_end(); ++property) {
        // Not the points, which the library has found.
        if (!*property || (*property)->name() == "v:points") continue;
        using OpenMesh::VectorT;
        parents.mix_first_of<float, double, VectorT<float, 2>, VectorT<double, 2>, VectorT<float, 3>, VectorT<double, 3>,
                             VectorT<float, 4>, VectorT<double, 4>, VectorT<unsigned char, 3>, VectorT<unsigned char, 4>>(*property);
    }
    const auto triangles = filled.triangles();
    const std::size_t old_triangles = triangles.size() - static_cast<std::size_t>(info.new_triangle_count);
    std::vector<OpenMesh::FaceHandle> faces;
    for (std::size_t t = old_triangles; t < triangles.size(); t++) {
        const auto &c = triangles[t];
        const auto made = mesh.add_face(openmesh_vertex(c[0]), openmesh_vertex(c[1]), openmesh_vertex(c[2]));
        if (!made.is_valid()) {
            throw std::runtime_error("OpenMesh takes no face with the vertices " + std::to_string(c[0]) + ", " +
                                     std::to_string(c[1]) + " and " + std::to_string(c[2]));
        }
        faces.push_back(made);
    }
    openmesh_spread(mesh, faces);
    if (open.was) openmesh_carry(mesh, open, faces);
    std::vector<openmesh_patch> patches(static_cast<std::size_t>(info.loop_count));
    for (std::size_t k = 0; k < patches.size(); k++) {
        auto &patch = patches[k];
        static_cast<fairmesh_fill_report &>(patch) = filled.fill_report(k);
        patch.loops = filled.list(FAIRMESH_LIST_JOINED_LOOPS, k);
        for (std::uint64_t v = 0; v < patch.vertex_count; v++) patch.vertices.push_back(openmesh_vertex(patch.first_vertex + v));
        const auto first = faces.begin() + static_cast<std::ptrdiff_t>(patch.first_triangle - old_triangles);
        patch.faces.assign(first, first + static_cast<std::ptrdiff_t>(patch.triangle_count));
        if (!patch.faces.empty()) patch.first_triangle = static_cast<std::uint64_t>(patch.faces.front().idx());
    }
    return patches;
}

/** Adds what `run`, given the options, makes of a mesh. */
template <class Mesh, class Run>
std::vector<openmesh_patch> openmesh_run(Mesh &mesh, const openmesh_open<Mesh> &open, const options &asked, Run run) {
    options plain = asked;
    if (std::is_same_v<typename openmesh_view<Mesh>::scalar, float>) plain.output_precision = FAIRMESH_OUTPUT_PRECISION_SINGLE;
    try {
        const result filled = run(plain);
        // Faces that were added cannot be taken back without a trace.
        Mesh changed(mesh);
        auto patches = openmesh_add(changed, open, filled);
        mesh = changed;
        return patches;
    } catch (const error &caught) {
        openmesh_rethrow(open.view, caught);
    }
}

template <class Mesh>
openmesh_filled openmesh_fill(Mesh &mesh, const openmesh_open<Mesh> &open, fill_options patches, const openmesh_fill_options &asked) {
    for (const auto &pair : asked.guides) patches.add_guide({openmesh_index(pair[0]), openmesh_index(pair[1])});
    openmesh_filled done;
    done.patches = openmesh_run(mesh, open, asked, [&](const options &plain) { return fill_holes(open.view.mesh(), patches, plain); });
    done.dropped = open.dropped;
    done.cleaned = open.cleaned;
    return done;
}

inline std::vector<openmesh_loop> openmesh_loops_of(const result &found) {
    std::vector<openmesh_loop> loops(static_cast<std::size_t>(found.info().loop_count));
    for (std::size_t k = 0; k < loops.size(); k++) {
        static_cast<fairmesh_loop &>(loops[k]) = found.loop(k);
        loops[k].vertices = openmesh_handles<OpenMesh::VertexHandle>(found.list(FAIRMESH_LIST_LOOP_VERTICES, k));
    }
    return loops;
}

/** Without the status of all elements nothing can be deleted. */
template <class Mesh> void openmesh_check_deletable(const Mesh &mesh) {
    if (mesh.has_vertex_status() && mesh.has_edge_status() && mesh.has_halfedge_status() && mesh.has_face_status()) return;
    throw std::invalid_argument("nothing can be deleted: see request_vertex_status(), also of edges, halfedges and faces");
}

} // namespace detail

/** The boundary loops of a mesh; see fairmesh_boundary_loops. Their numbers are their places in the list. */
template <class Mesh, class = std::enable_if_t<detail::is_openmesh<Mesh>>>
std::vector<openmesh_loop> boundary_loops(const Mesh &mesh, const openmesh_options &asked = openmesh_options()) {
    detail::openmesh_check<std::remove_const_t<Mesh>>();
    const detail::openmesh_view<Mesh> view(mesh, asked);
    return detail::openmesh_loops_of(boundary_loops(view.mesh()));
}

/** Fills holes, each or several together; see fairmesh_fill_holes. Vertices and faces keep their numbers, new ones follow. New
 *  vertices get properties of floats, doubles and vectors of them interpolated, and colours, others from the nearest old vertex, new faces
 *  those of a face beside them; properties of edges and half-edges keep their defaults. Update normals afterwards.
 *
 *  Errors as those of fair(mesh); std::runtime_error where OpenMesh refuses a face. The mesh is as it was then: the patches are
 *  made in a copy of it. */
template <class Mesh, class = std::enable_if_t<detail::is_openmesh<Mesh>>>
openmesh_filled fill(Mesh &mesh, const openmesh_fill_options &asked = openmesh_fill_options()) {
    detail::openmesh_check<Mesh>();
    const detail::openmesh_open<Mesh> open(mesh, asked);
    fill_options patches = asked.patches;
    if (asked.loops != openmesh_loops::as_asked) {
        auto selected = detail::openmesh_selected_loops(mesh, open.view);
        const bool joined = asked.loops == openmesh_loops::selected_joined && selected.size() > 1;
        if (joined) patches.join_groups({selected});
        patches.only(joined ? std::vector<std::uint32_t>() : std::move(selected));
    }
    return detail::openmesh_fill(mesh, open, patches, asked);
}

/** Deletes the selected faces, and what would hang loose there or, up to `clean`, spoil the patch, and fills the holes that they leave; see
 *  fairmesh_erase. Of `patches` the loops are not read. The mesh needs the status of vertices, edges, half-edges and faces; what is deleted stays until
 *  garbage_collection(). Otherwise as fill(mesh). */
template <class Mesh, class = std::enable_if_t<detail::is_openmesh<Mesh>>>
openmesh_filled erase_and_fill(Mesh &mesh, const openmesh_fill_options &asked = openmesh_fill_options()) {
    detail::openmesh_check<Mesh>();
    detail::openmesh_check_deletable(mesh);
    detail::openmesh_open<Mesh> open(mesh, asked);
    try {
        open.erase_selected(mesh, asked.clean, asked.carry_over);
    } catch (const error &caught) {
        detail::openmesh_rethrow(open.view, caught);
    }
    fill_options patches = asked.patches;
    patches.only(open.loops);
    return detail::openmesh_fill(mesh, open, patches, asked);
}

} // namespace fairmesh

#endif
