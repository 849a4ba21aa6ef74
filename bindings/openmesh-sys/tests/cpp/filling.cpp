// fairmesh_openmesh_fill.hpp: joined loops and erased faces, what new vertices and faces carry on, what is refused.
#include <fairmesh_openmesh_fill.hpp>

#include "check.hpp"

#include <OpenMesh/Core/Mesh/TriMesh_ArrayKernelT.hh>

#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <string>

namespace {

using OpenMesh::FaceHandle;
using OpenMesh::VertexHandle;

template <class Scalar> struct Traits : OpenMesh::DefaultTraits {
    using Point = OpenMesh::VectorT<Scalar, 3>;
    using Normal = OpenMesh::VectorT<Scalar, 3>;
    using TexCoord2D = OpenMesh::VectorT<Scalar, 2>;
};
using Doubles = OpenMesh::TriMesh_ArrayKernelT<Traits<double>>;
using Floats = OpenMesh::TriMesh_ArrayKernelT<Traits<float>>;

constexpr int around = 24, rows = 5, cap_vertices = 1 + around * rows;

/** The unit sphere without a band around its equator; the lower part turned around, if so asked. */
template <class Mesh> Mesh band_missing(bool turned = false) {
    using Point = typename Mesh::Point;
    using Scalar = typename OpenMesh::vector_traits<Point>::value_type;
    const double degree = std::acos(-1.0) / 180;
    Mesh mesh;
    mesh.request_vertex_status();
    mesh.request_edge_status();
    mesh.request_halfedge_status();
    mesh.request_face_status();
    for (int half = 0; half < 2; half++) {
        const double up = half ? -1 : 1;
        const int pole = half * cap_vertices;
        const auto vertex = [&](int row, int k) { return VertexHandle(row < 0 ? pole : pole + 1 + around * row + (k + around) % around); };
        const auto face = [&](VertexHandle a, VertexHandle b, VertexHandle c) {
            if (half == 1 && !turned) std::swap(b, c);
            mesh.add_face(a, b, c);
        };
        mesh.add_vertex(Point(0, 0, static_cast<Scalar>(up)));
        for (int row = 0; row < rows; row++) {
            for (int k = 0; k < around; k++) {
                const double tilt = 14 * (row + 1) * degree, turn = (15 * (k + 0.5 * row) + 4 * half) * degree;
                mesh.add_vertex(Point(static_cast<Scalar>(std::sin(tilt) * std::cos(turn)), static_cast<Scalar>(std::sin(tilt) * std::sin(turn)),
                                      static_cast<Scalar>(up * std::cos(tilt))));
            }
        }
        for (int k = 0; k < around; k++) {
            face(vertex(-1, 0), vertex(0, k), vertex(0, k + 1));
            for (int row = 0; row + 1 < rows; row++) {
                face(vertex(row, k), vertex(row + 1, k), vertex(row, k + 1));
                face(vertex(row, k + 1), vertex(row + 1, k), vertex(row + 1, k + 1));
            }
        }
    }
    return mesh;
}

template <class Mesh> double off_sphere(const Mesh &mesh) {
    double worst = 0.0;
    for (auto v : mesh.vertices()) {
        const auto p = mesh.point(v);
        const double x = p[0], y = p[1], z = p[2];
        worst = std::fmax(worst, std::fabs(std::sqrt(x * x + y * y + z * z) - 1.0));
    }
    return worst;
}

/** Closed, of genus 0, on the unit sphere. */
template <class Mesh> void check_whole_sphere(Mesh mesh, double bar) {
    mesh.garbage_collection();
    CHECK(fairmesh::boundary_loops(mesh).empty());
    CHECK(mesh.n_vertices() + mesh.n_faces() == mesh.n_edges() + 2);
    CHECK(off_sphere(mesh) < bar);
}

template <class Mesh> void joining(double bar) {
    const Mesh whole = band_missing<Mesh>();
    CHECK(fairmesh::boundary_loops(whole).size() == 2 && fairmesh::boundary_loops(whole)[1].component == 1);
    fairmesh::openmesh_fill_options options;
    options.patches.join_auto();
    Mesh mesh = whole;
    auto done = fairmesh::fill(mesh, options);
    check_whole_sphere(mesh, bar);
    CHECK(done.patches.size() == 1 && done.patches[0].loops.size() == 2 && done.patches[0].outcome == FAIRMESH_FILL_OUTCOME_FAIRED);
    CHECK(done.patches[0].vertices.size() == mesh.n_vertices() - whole.n_vertices());
    CHECK(done.patches[0].faces.size() == mesh.n_faces() - whole.n_faces());

    // By the selection; the old elements keep everything, the new ones get what is beside them.
    mesh = whole;
    OpenMesh::VPropHandleT<std::string> words;
    OpenMesh::VPropHandleT<double> heights;
    OpenMesh::FPropHandleT<int> parts;
    mesh.add_property(words, "words");
    mesh.add_property(heights, "heights");
    mesh.add_property(parts, "parts");
    mesh.request_vertex_texcoords2D();
    for (auto v : mesh.vertices()) {
        mesh.property(words, v) = "old";
        mesh.property(heights, v) = mesh.point(v)[2];
        mesh.set_texcoord2D(v, typename Mesh::TexCoord2D(mesh.point(v)[2], 7));
        mesh.status(v).set_selected(mesh.is_boundary(v));
    }
    for (auto f : mesh.faces()) mesh.property(parts, f) = 3;
    fairmesh::openmesh_fill_options joined;
    joined.loops = fairmesh::openmesh_loops::selected_joined;
    done = fairmesh::fill(mesh, joined);
    check_whole_sphere(mesh, bar);
    for (auto v : whole.vertices()) CHECK(mesh.point(v) == whole.point(v) && mesh.property(words, v) == "old");
    for (auto v : done.patches[0].vertices) {
        CHECK(mesh.property(words, v) == "old" && std::fabs(mesh.property(heights, v)) < 0.35);
        CHECK(std::fabs(mesh.texcoord2D(v)[0] - mesh.property(heights, v)) < 1e-6 && std::fabs(mesh.texcoord2D(v)[1] - 7) < 1e-5);
    }
    for (auto f : done.patches[0].faces) CHECK(mesh.property(parts, f) == 3);

    // One loop alone.
    mesh = whole;
    for (auto v : mesh.vertices()) mesh.status(v).set_selected(mesh.point(v)[2] > 0);
    done = fairmesh::fill(mesh, joined);
    CHECK(done.patches.size() == 1 && fairmesh::boundary_loops(mesh).size() == 1);
}

template <class Mesh> void refusing() {
    Mesh mesh = band_missing<Mesh>(true);
    const auto faces = mesh.n_faces();
    fairmesh::openmesh_fill_options options;
    options.patches.join_groups({{0, 1}});
    options.patches.only({});
    const auto done = fairmesh::fill(mesh, options);
    CHECK(done.patches[0].reason == FAIRMESH_FILL_REASON_OPPOSITE_SIDES && mesh.n_faces() == faces);
    CHECK(done.patches[0].reason_element == 0 && done.patches[0].reason_other == 1);
    options.patches.join_groups({{0, 2}});
    try {
        fairmesh::fill(mesh, options);
        CHECK(false);
    } catch (const fairmesh::error &why) {
        CHECK(why.status() == FAIRMESH_STATUS_SELECTION_OUT_OF_RANGE && why.detail().element == 2);
    }
    Mesh bare;
    try {
        fairmesh::erase_and_fill(bare);
        CHECK(false);
    } catch (const std::invalid_argument &) {
    }
}

/** Noise at the upper pole is erased. */
template <class Mesh> void erasing(double bar) {
    Mesh mesh = band_missing<Mesh>();
    fairmesh::openmesh_fill_options options;
    options.patches.join_auto();
    fairmesh::fill(mesh, options);
    // Deleted elements are skipped.
    for (auto v : mesh.vertices()) {
        const bool is_noise = mesh.point(v)[2] > 0.85;
        if (is_noise) mesh.point(v) *= static_cast<typename OpenMesh::vector_traits<typename Mesh::Point>::value_type>(v.idx() % 2 ? 0.7 : 1.4);
    }
    std::size_t selected = 0;
    for (auto f : mesh.faces()) {
        bool is_noise = false;
        for (auto v : mesh.fv_range(f)) is_noise = is_noise || std::fabs(mesh.point(v).norm() - 1) > 0.1;
        mesh.status(f).set_selected(is_noise);
        selected += is_noise;
    }
    const auto before = mesh.n_faces();
    const auto done = fairmesh::erase_and_fill(mesh);
    CHECK(done.patches.size() == 1 && done.patches[0].outcome == FAIRMESH_FILL_OUTCOME_FAIRED);
    CHECK(mesh.n_faces() == before + done.patches[0].faces.size());
    std::size_t deleted = 0;
    for (std::size_t f = 0; f < mesh.n_faces(); f++) deleted += mesh.status(FaceHandle(static_cast<int>(f))).deleted();
    CHECK(deleted == selected + done.dropped);
    check_whole_sphere(mesh, bar);
    // Once more, with deleted elements about.
    for (auto f : mesh.faces()) mesh.status(f).set_selected(mesh.calc_face_centroid(f)[0] > 0.8);
    fairmesh::erase_and_fill(mesh);
    check_whole_sphere(mesh, bar);
}

} // namespace

int main() {
    joining<Doubles>(1e-8);
    joining<Floats>(1e-6);
    refusing<Doubles>();
    erasing<Doubles>(1e-8);
    erasing<Floats>(1e-6);
    std::puts("filling: passed");
}
