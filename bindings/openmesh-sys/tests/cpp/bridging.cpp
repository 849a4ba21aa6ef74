// fairmesh_openmesh_bridge.hpp, fairmesh_openmesh_rim.hpp, and of fairmesh_openmesh_fill.hpp guides, cleaning and what is carried over.
#include <fairmesh_openmesh_bridge.hpp>
#include <fairmesh_openmesh_rim.hpp>

#include "check.hpp"

namespace {

constexpr int side = 16;

VertexHandle at(int i, int j) { return VertexHandle((side + 1) * i + j); }

/** A sheet of 16 by 16 squares without 4 by 4 of them in the middle, curved like a sphere of radius 20, its heights off by `noise`. */
template <class Mesh> Mesh sheet(double noise, bool whole = false) {
    Mesh mesh;
    request_status(mesh);
    mesh.request_face_colors();
    mesh.request_vertex_colors();
    for (int i = 0; i <= side; i++) {
        for (int j = 0; j <= side; j++) {
            const double x = i - side / 2, y = j - side / 2;
            const double z = std::sqrt(400 - x * x - y * y) + noise * ((7 * i * i + 5 * j * i + 3 * j) % 5);
            const auto vertex = mesh.add_vertex(point<Mesh>(x, y, z));
            mesh.set_color(vertex, {static_cast<unsigned char>(200 - 10 * j), 40, 250});
        }
    }
    for (int i = 0; i < side; i++) {
        for (int j = 0; j < side; j++) {
            if (!whole && i >= 6 && i < 10 && j >= 6 && j < 10) continue;
            for (const auto face : {mesh.add_face(at(i, j), at(i + 1, j), at(i + 1, j + 1)), mesh.add_face(at(i, j), at(i + 1, j + 1), at(i, j + 1))}) {
                mesh.set_color(face, {static_cast<unsigned char>(i), static_cast<unsigned char>(j), 7});
            }
        }
    }
    return mesh;
}

/** The hole that is not the outer boundary. */
std::uint32_t hole_of(const std::vector<fairmesh::openmesh_loop> &loops) {
    CHECK(loops.size() == 2);
    return loops[0].kind == FAIRMESH_LOOP_KIND_HOLE ? 0 : 1;
}

template <class Mesh> void bridging(double bar) {
    const Mesh whole = sheet<Mesh>(0.0);
    // Two edges on opposite sides of the hole; it falls into two. The sides of the strip are free, and leave the sphere a little.
    Mesh mesh = whole;
    const auto edge = [&](VertexHandle a, VertexHandle b) { return mesh.edge_handle(mesh.find_halfedge(a, b)); };
    auto done = fairmesh::bridge(mesh, edge(at(6, 7), at(6, 8)), edge(at(10, 8), at(10, 9)));
    CHECK(done.strip.outcome == FAIRMESH_FILL_OUTCOME_FAIRED && done.rest.empty() && done.is_success && !done.has_whole);
    CHECK(done.chains[0].size() == 2 && done.chains[1].size() == 2 && !done.sides[0].empty() && !done.sides[1].empty());
    CHECK(mesh.n_faces() == whole.n_faces() + done.strip.faces.size() && fairmesh::boundary_loops(mesh).size() == 3);
    CHECK(off_sphere(mesh, done.strip.vertices, 20) < 5e-3);
    for (const auto v : whole.vertices()) CHECK(mesh.point(v) == whole.point(v));
    for (const auto f : done.strip.faces) CHECK(mesh.color(f)[2] == 7);
    for (const auto v : done.strip.vertices) CHECK(mesh.color(v)[1] == 40 && mesh.color(v)[2] == 250);

    // Two runs, and the holes beside the strip filled.
    mesh = whole;
    fairmesh::openmesh_bridge_options options;
    options.strip.fill = 1;
    done = fairmesh::bridge(mesh, {at(6, 7), at(6, 8), at(6, 9)}, {at(10, 9), at(10, 8), at(10, 7)}, options);
    CHECK(done.rest.size() == 2 && done.has_whole && done.whole.outcome == FAIRMESH_OUTCOME_CONVERGED);
    CHECK(fairmesh::boundary_loops(mesh).size() == 1 && off_sphere(mesh, done.rest[0].vertices, 20) < bar);

    // A vertex and a width; what is no run.
    mesh = whole;
    options.strip.fill = 0;
    options.strip.width = 2.0;
    done = fairmesh::bridge(mesh, {at(6, 8)}, {at(10, 8)}, options);
    CHECK(done.chains[0].size() == 3);
    mesh = whole;
    const auto why = thrown<fairmesh::error>([&] { fairmesh::bridge(mesh, {at(6, 7), at(6, 9)}, {at(10, 8), at(10, 9)}); });
    CHECK(why.status() == FAIRMESH_STATUS_BAD_CHAIN && mesh.n_faces() == whole.n_faces());
}

template <class Mesh> void guiding(double bar) {
    const Mesh whole = sheet<Mesh>(0.0);
    Mesh mesh = whole;
    fairmesh::openmesh_fill_options options;
    options.guides = {{at(6, 7), at(10, 9)}};
    const auto done = fairmesh::fill(mesh, options);
    const auto filled = done.patches[0].vertices.empty() ? done.patches[1] : done.patches[0];
    CHECK(filled.outcome == FAIRMESH_FILL_OUTCOME_FAIRED && off_sphere(mesh, filled.vertices, 20) < bar);
    // Neighbours can have no guide.
    options.guides = {{at(6, 7), at(6, 8)}};
    mesh = whole;
    CHECK(thrown<fairmesh::error>([&] { fairmesh::fill(mesh, options); }).status() == FAIRMESH_STATUS_BAD_GUIDE);
    CHECK(mesh.n_faces() == whole.n_faces());
}

template <class Mesh> void trimming() {
    Mesh mesh = sheet<Mesh>(0.0);
    // A tooth that hangs in the hole by one edge.
    const auto tip = mesh.add_vertex(typename Mesh::Point(-1.4f, -1.5f, 20.4f));
    const auto tooth = mesh.add_face(at(6, 7), at(6, 6), tip);
    CHECK(tooth.is_valid());
    fairmesh::trim_limits limits;
    limits.area = 0.01;
    CHECK(fairmesh::trim_boundary(mesh, limits).faces.empty());
    limits = fairmesh::trim_limits();
    const auto done = fairmesh::trim_boundary(mesh, {hole_of(fairmesh::boundary_loops(mesh))}, limits);
    CHECK(done.faces.size() == 1 && done.faces[0] == tooth && mesh.status(tooth).deleted() && mesh.status(tip).deleted());
    CHECK(done.area > 0.1 && done.area < 0.5);
    // Deleted elements are skipped, and the hole is as it was.
    CHECK(fairmesh::trim_boundary(mesh).faces.empty());
    const auto loops = fairmesh::boundary_loops(mesh);
    CHECK(loops[hole_of(loops)].vertices.size() == 16);
    const auto why = thrown<fairmesh::error>([&] { fairmesh::trim_boundary(mesh, {5}, limits); });
    CHECK(why.status() == FAIRMESH_STATUS_SELECTION_OUT_OF_RANGE && why.detail().element == 5);
    CHECK(why.detail().element_kind == FAIRMESH_ELEMENT_LOOP);
    Mesh bare;
    thrown<std::invalid_argument>([&] { fairmesh::trim_boundary(bare); });
}

template <class Mesh> void roughness() {
    for (const double noise : {0.0, 0.05}) {
        const Mesh mesh = sheet<Mesh>(noise);
        const auto loops = fairmesh::rim_roughness(mesh);
        const auto &hole = loops[hole_of(loops)];
        CHECK(hole.has_roughness && (hole.is_rough != 0) == (noise > 0) && hole.vertices.size() == 16);
        CHECK(!fairmesh::boundary_loops(mesh)[0].has_roughness);
        if (noise == 0.0) continue;
        CHECK(hole.roughness > 2 && hole.advised_relax_rim == 3 && hole.advised_relax_within > 0.5);
        Mesh filled = mesh;
        fairmesh::openmesh_fill_options options;
        options.patches.relax_rim = hole.advised_relax_rim;
        options.patches.relax_within = hole.advised_relax_within;
        const auto done = fairmesh::fill(filled, options);
        CHECK(done.patches[0].moved_count + done.patches[1].moved_count > 16);
    }
}

/** A dent is erased; slender faces beside it go with it, and colours come from what was there. */
template <class Mesh> void erasing(double bar) {
    Mesh mesh = sheet<Mesh>(0.0, true);
    for (auto f : mesh.faces()) {
        const auto middle = mesh.calc_face_centroid(f);
        mesh.status(f).set_selected(std::fabs(middle[0]) < 2 && std::fabs(middle[1]) < 2);
    }
    // Something to be seen on what will be erased.
    for (auto f : mesh.faces()) {
        if (mesh.status(f).selected()) mesh.set_color(f, {9, 9, 9});
    }
    mesh.set_color(at(8, 8), {0, 0, 0});
    // A vertex of its edge nearly on the next one.
    mesh.point(at(6, 8)) += (mesh.point(at(5, 8)) - mesh.point(at(6, 8))) * static_cast<typename Mesh::Scalar>(0.97);
    const Mesh whole = mesh;
    for (const bool carry_over : {false, true}) {
        mesh = whole;
        fairmesh::openmesh_fill_options options;
        options.clean = 10;
        options.carry_over = carry_over;
        const auto done = fairmesh::erase_and_fill(mesh, options);
        CHECK(done.cleaned > 0 && done.cleaned <= 10 && done.patches.size() == 1);
        const auto &patch = done.patches[0];
        CHECK(patch.outcome == FAIRMESH_FILL_OUTCOME_FAIRED && off_sphere(mesh, patch.vertices, 20) < bar);
        std::size_t of_old = 0;
        for (const auto f : patch.faces) of_old += mesh.color(f) == typename Mesh::Color(9, 9, 9);
        CHECK(carry_over ? 2 * of_old > patch.faces.size() : of_old == 0);
        int darkest = 255;
        for (const auto v : patch.vertices) darkest = std::min<int>(darkest, mesh.color(v)[2]);
        CHECK(carry_over ? darkest < 150 : darkest > 240);
        for (const auto f : patch.faces) CHECK(!mesh.status(f).deleted() && !mesh.status(f).selected());
        // Once more, with deleted elements about.
        for (const auto f : patch.faces) mesh.status(f).set_selected(true);
        CHECK(fairmesh::erase_and_fill(mesh).patches[0].outcome == FAIRMESH_FILL_OUTCOME_FAIRED);
        mesh.garbage_collection();
        CHECK(fairmesh::boundary_loops(mesh).size() == 1);
    }
}

} // namespace

int main() {
    bridging<Doubles>(1e-8);
    bridging<Floats>(1e-5);
    guiding<Doubles>(1e-8);
    trimming<Doubles>();
    trimming<Floats>();
    roughness<Doubles>();
    roughness<Floats>();
    erasing<Doubles>(1e-8);
    erasing<Floats>(1e-5);
    std::puts("bridging: passed");
}
