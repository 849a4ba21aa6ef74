// fairmesh_openmesh_fill.hpp: joined loops, what new vertices and faces carry on, what is refused.
#include <fairmesh_openmesh_fill.hpp>

#include "check.hpp"

namespace {

constexpr int around = 24, rows = 5, cap_vertices = 1 + around * rows;

/** The unit sphere without a band around its equator; the lower part turned around, if so asked. */
template <class Mesh> Mesh band_missing(bool turned = false) {
    const double degree = std::acos(-1.0) / 180;
    Mesh mesh;
    request_status(mesh);
    for (int half = 0; half < 2; half++) {
        const double up = half ? -1 : 1;
        const int pole = half * cap_vertices;
        const auto vertex = [&](int row, int k) { return VertexHandle(row < 0 ? pole : pole + 1 + around * row + (k + around) % around); };
        const auto face = [&](VertexHandle a, VertexHandle b, VertexHandle c) {
            if (half == 1 && !turned) std::swap(b, c);
            mesh.add_face(a, b, c);
        };
        mesh.add_vertex(point<Mesh>(0, 0, up));
        for (int row = 0; row < rows; row++) {
            for (int k = 0; k < around; k++) {
                const double tilt = 14 * (row + 1) * degree, turn = (15 * (k + 0.5 * row) + 4 * half) * degree;
                mesh.add_vertex(point<Mesh>(std::sin(tilt) * std::cos(turn), std::sin(tilt) * std::sin(turn), up * std::cos(tilt)));
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
    const auto why = thrown<fairmesh::error>([&] { fairmesh::fill(mesh, options); });
    CHECK(why.status() == FAIRMESH_STATUS_SELECTION_OUT_OF_RANGE && why.detail().element == 2);
    Mesh bare;
    thrown<std::invalid_argument>([&] { fairmesh::erase_and_fill(bare); });
}

} // namespace

int main() {
    joining<Doubles>(1e-8);
    joining<Floats>(1e-6);
    refusing<Doubles>();
    std::puts("filling: passed");
}
