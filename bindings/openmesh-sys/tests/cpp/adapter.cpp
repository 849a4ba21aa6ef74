// fairmesh_openmesh.hpp: what is kept, what is skipped, what is honoured, what is undone.
#include <fairmesh_openmesh.hpp>

#include "check.hpp"


#include <algorithm>
#include <new>
#include <set>

namespace {

/** Allocations of this program that are still granted; negative: all. The library has its own. */
long granted = -1;

} // namespace

// Not inlined: GCC would see malloc() and free() meet new and delete.
__attribute__((noinline)) void *operator new(std::size_t size) {
    if (granted == 0) throw std::bad_alloc();
    if (granted > 0) granted--;
    if (void *block = std::malloc(size ? size : 1)) return block;
    throw std::bad_alloc();
}
__attribute__((noinline)) void operator delete(void *block) noexcept { std::free(block); }
__attribute__((noinline)) void operator delete(void *block, std::size_t) noexcept { std::free(block); }

namespace {

/** The defaults: float points, nothing requested. */
using Plain = OpenMesh::TriMesh_ArrayKernelT<>;

/** Points and normals of different numbers, and attributes from the start. */
struct Foreign : OpenMesh::DefaultTraits {
    using Point = OpenMesh::Vec3d;
    using Normal = OpenMesh::Vec3f;
    using TexCoord2D = OpenMesh::Vec2d;
    VertexAttributes(OpenMesh::Attributes::Normal | OpenMesh::Attributes::Status | OpenMesh::Attributes::Color);
};
using Mixed = OpenMesh::TriMesh_ArrayKernelT<Foreign>;

constexpr int side = 21;

bool dented(int v) {
    int i = v % side, j = v / side;
    return i > 5 && i < 15 && j > 5 && j < 15;
}

/** A grid on the unit sphere with a dent; everything has a status. */
template <class Mesh> Mesh cap() {
    Mesh mesh;
    request_status(mesh);
    mesh.request_vertex_normals();
    mesh.request_face_normals();
    for (int v = 0; v < side * side; v++) {
        double x = 0.06 * (v % side) - 0.6, y = 0.06 * (v / side) - 0.6, z = std::sqrt(1.0 - x * x - y * y);
        mesh.add_vertex(dented(v) ? point<Mesh>(x + 0.02, y, 0.6 * z) : point<Mesh>(x, y, z));
    }
    for (int v = 0; v < side * (side - 1); v++) {
        if (v % side == side - 1) continue;
        mesh.add_face(VertexHandle(v), VertexHandle(v + 1), VertexHandle(v + side + 1));
        mesh.add_face(VertexHandle(v), VertexHandle(v + side + 1), VertexHandle(v + side));
    }
    return mesh;
}

template <class Mesh> Mesh selected_cap() {
    auto mesh = cap<Mesh>();
    for (auto v : mesh.vertices()) mesh.status(v).set_selected(dented(v.idx()));
    return mesh;
}

template <class Mesh> std::vector<typename Mesh::Point> points_of(const Mesh &mesh) {
    return std::vector<typename Mesh::Point>(mesh.points(), mesh.points() + mesh.n_vertices());
}

/** Everything of a mesh but positions, as numbers. */
template <class Mesh> std::vector<long> links_of(const Mesh &mesh) {
    std::vector<long> all;
    const auto add = [&](std::initializer_list<int> numbers) { all.insert(all.end(), numbers.begin(), numbers.end()); };
    for (auto v : mesh.all_vertices()) add({v.halfedge().idx(), int(mesh.status(v).bits())});
    for (auto h : mesh.all_halfedges()) {
        add({h.to().idx(), h.next().idx(), h.prev().idx(), mesh.face_handle(h).idx(), int(mesh.status(h).bits())});
    }
    for (auto e : mesh.all_edges()) add({int(mesh.status(e).bits())});
    for (auto f : mesh.all_faces()) add({f.halfedge().idx(), int(mesh.status(f).bits())});
    return all;
}

/** Names of all vertex properties, in their places. */
template <class Mesh> std::vector<std::string> properties_of(const Mesh &mesh) {
    std::vector<std::string> names;
    for (auto p = mesh.vprops_begin(); p != mesh.vprops_end(); ++p) names.push_back(*p ? (*p)->name() : "");
    while (!names.empty() && names.back().empty()) names.pop_back();
    return names;
}

template <class Mesh> void fairing(double bar) {
    auto mesh = selected_cap<Mesh>();
    OpenMesh::VPropHandleT<std::string> words;
    OpenMesh::EPropHandleT<int> numbers;
    OpenMesh::FPropHandleT<OpenMesh::Vec3d> vectors;
    mesh.add_property(words, "words");
    mesh.add_property(numbers, "numbers");
    mesh.add_property(vectors, "vectors");
    for (auto v : mesh.vertices()) mesh.property(words, v) = "vertex " + std::to_string(v.idx());
    for (auto e : mesh.edges()) mesh.property(numbers, e) = 7 * e.idx();
    for (auto f : mesh.faces()) mesh.property(vectors, f) = OpenMesh::Vec3d(f.idx(), 1, 2);
    mesh.status(FaceHandle(11)).set_selected(true);
    mesh.status(EdgeHandle(12)).set_tagged(true);
    mesh.update_normals();
    auto before = points_of(mesh);
    auto links = links_of(mesh);
    auto names = properties_of(mesh);
    auto normal = mesh.normal(VertexHandle(220));

    auto report = fairmesh::fair(mesh);
    CHECK(report.outcome == FAIRMESH_OUTCOME_CONVERGED && report.free_vertices == 81 && report.poor_triangles.empty());
    CHECK(off_sphere(mesh) < bar);
    for (int v = 0; v < side * side; v++) {
        if (!dented(v)) CHECK(mesh.point(VertexHandle(v)) == before[std::size_t(v)]);
    }
    CHECK(links_of(mesh) == links && properties_of(mesh) == names && mesh.normal(VertexHandle(220)) == normal);
    for (auto v : mesh.vertices()) CHECK(mesh.property(words, v) == "vertex " + std::to_string(v.idx()));
    for (auto e : mesh.edges()) CHECK(mesh.property(numbers, e) == 7 * e.idx());
    for (auto f : mesh.faces()) CHECK(mesh.property(vectors, f) == OpenMesh::Vec3d(f.idx(), 1, 2));
}

/** The dented cap, cut along its middle row: every vertex of it is there twice. */
Doubles cut_cap() {
    auto mesh = selected_cap<Doubles>();
    constexpr int middle = side / 2;
    std::vector<VertexHandle> twins;
    for (int i = 0; i < side; i++) {
        twins.push_back(mesh.add_vertex(mesh.point(VertexHandle(middle * side + i))));
        mesh.status(twins.back()).set_selected(dented(middle * side + i));
    }
    std::vector<std::array<VertexHandle, 3>> below;
    for (auto f : mesh.faces()) {
        std::array<VertexHandle, 3> corners;
        std::copy(mesh.cfv_begin(f), mesh.cfv_end(f), corners.begin());
        // Two triangles a cell, row by row.
        if (f.idx() / (2 * (side - 1)) < middle) continue;
        for (auto &v : corners) {
            if (v.idx() / side == middle) v = twins[std::size_t(v.idx() % side)];
        }
        below.push_back(corners);
        mesh.delete_face(f, false);
    }
    for (const auto &corners : below) CHECK(mesh.add_face(corners[0], corners[1], corners[2]).is_valid());
    return mesh;
}

void seams() {
    auto joined = cut_cap();
    CHECK(joined.is_boundary(VertexHandle(10 * side + 10)));
    const auto report = fairmesh::fair(joined);
    CHECK(report.outcome == FAIRMESH_OUTCOME_CONVERGED && off_sphere(joined) < 1e-7);
    for (int i = 0; i < side; i++) CHECK(joined.point(VertexHandle(10 * side + i)) == joined.point(VertexHandle(side * side + i)));
    // What only one of the copies is asked for stays.
    auto half = cut_cap();
    for (int i = 0; i < side; i++) half.status(VertexHandle(side * side + i)).set_selected(false);
    const auto before = half.point(VertexHandle(10 * side + 10));
    CHECK(fairmesh::fair(half).free_vertices == 72 && half.point(VertexHandle(10 * side + 10)) == before);
    // The boundaries that OpenMesh sees.
    auto apart = cut_cap();
    fairmesh::openmesh_options options;
    options.coincident = FAIRMESH_COINCIDENT_SEPARATE;
    CHECK(fairmesh::fair(apart, options).free_vertices == 72 && apart.point(VertexHandle(10 * side + 10)) == before);
}

void regions() {
    // By faces: the dent's vertices are those with nothing but selected faces.
    auto faces = cap<Doubles>();
    for (auto f : faces.faces()) {
        bool inside = false;
        for (auto v : faces.fv_range(f)) inside |= dented(v.idx());
        faces.status(f).set_selected(inside);
    }
    auto vertices = selected_cap<Doubles>();
    fairmesh::openmesh_options options;
    fairmesh::fair(vertices, options);
    options.region = fairmesh::openmesh_region::selected_faces;
    CHECK(fairmesh::fair(faces, options).free_vertices == 81);
    CHECK(points_of(faces) == points_of(vertices));
    // Everything: the boundary stays, without any status.
    auto plain = cap<Doubles>();
    plain.release_vertex_status();
    plain.release_edge_status();
    plain.release_halfedge_status();
    plain.release_face_status();
    options.region = fairmesh::openmesh_region::everything;
    CHECK(fairmesh::fair(plain, options).free_vertices == (side - 2) * (side - 2));
    for (auto region : {fairmesh::openmesh_region::selected_faces, fairmesh::openmesh_region::selected_vertices}) {
        options.region = region;
        CHECK(says(thrown<std::invalid_argument>([&] { fairmesh::fair(plain, options); }), "request_"));
    }
    // Nothing is selected.
    auto none = cap<Doubles>();
    CHECK(thrown<fairmesh::error>([&] { fairmesh::fair(none); }).status() == FAIRMESH_STATUS_EMPTY_REGION);
}

void fixed() {
    // Locked vertices, feature vertices, corners of feature edges and feature faces, and the boundary, selected or not.
    auto mesh = cap<Doubles>();
    for (auto v : mesh.vertices()) mesh.status(v).set_selected(true);
    std::set<int> stay;
    mesh.status(VertexHandle(10 * side + 10)).set_locked(true);
    stay.insert(10 * side + 10);
    mesh.status(VertexHandle(4 * side + 5)).set_feature(true);
    stay.insert(4 * side + 5);
    for (int i = 6; i < 15; i++) {
        auto half = mesh.find_halfedge(VertexHandle(13 * side + i), VertexHandle(13 * side + i + 1));
        mesh.status(mesh.edge_handle(half)).set_feature(true);
        stay.insert({13 * side + i, 13 * side + i + 1});
    }
    FaceHandle face(2 * (3 * (side - 1) + 15));
    mesh.status(face).set_feature(true);
    for (auto v : mesh.fv_range(face)) stay.insert(v.idx());
    CHECK(stay.size() == 15);
    for (auto v : mesh.vertices()) {
        if (!mesh.is_boundary(v) && !stay.count(v.idx())) mesh.point(v)[2] -= 0.001 * (v.idx() % 7);
    }
    auto before = points_of(mesh);
    auto twin = mesh;
    auto report = fairmesh::fair(mesh);
    CHECK(report.free_vertices == (side - 2) * (side - 2) - stay.size());
    std::size_t moved = 0;
    for (auto v : mesh.vertices()) {
        bool same = mesh.point(v) == before[std::size_t(v.idx())];
        CHECK(!same || mesh.is_boundary(v) || stay.count(v.idx()) || v.idx() % 7 == 0);
        if (stay.count(v.idx()) || mesh.is_boundary(v)) CHECK(same);
        moved += !same;
    }
    CHECK(moved > 300);
    // Without features only the locked one is fixed.
    fairmesh::openmesh_options options;
    options.features = false;
    CHECK(fairmesh::fair(twin, options).free_vertices == (side - 2) * (side - 2) - 1);
}

/** The adapter does what a program does by hand with fairmesh.hpp, to the last bit. */
void by_hand() {
    auto mesh = selected_cap<Doubles>();
    std::vector<std::array<double, 3>> positions;
    std::vector<std::array<std::uint32_t, 3>> triangles;
    std::vector<std::uint8_t> mask;
    for (auto v : mesh.vertices()) {
        auto p = mesh.point(v);
        positions.push_back({p[0], p[1], p[2]});
        mask.push_back(dented(v.idx()));
    }
    for (auto f : mesh.faces()) {
        auto corner = mesh.cfv_begin(f);
        std::array<std::uint32_t, 3> t;
        for (auto &index : t) index = std::uint32_t((*corner++).idx());
        triangles.push_back(t);
    }
    auto expected = fairmesh::fair(fairmesh::mesh(positions, triangles), fairmesh::free_mask(mask));
    auto x = expected.positions();
    auto h = expected.scalars(FAIRMESH_SCALARS_MEAN_CURVATURE);
    fairmesh::openmesh_options options;
    options.mean_curvature = "H";
    auto names = properties_of(mesh);
    auto report = fairmesh::fair(mesh, options);
    CHECK(report.iterations == expected.report().iterations);
    OpenMesh::VPropHandleT<double> H;
    CHECK(mesh.get_property_handle(H, "H") && properties_of(mesh).size() == names.size() + 1);
    std::size_t known = 0;
    for (auto v : mesh.vertices()) {
        auto k = std::size_t(v.idx());
        auto p = mesh.point(v);
        CHECK(p[0] == x[k][0] && p[1] == x[k][1] && p[2] == x[k][2]);
        double c = mesh.property(H, v);
        CHECK(c == h[k] || (std::isnan(c) && std::isnan(h[k])));
        if (dented(v.idx())) CHECK(std::fabs(c + 1.0) < 1e-3);
        known += !std::isnan(c);
    }
    CHECK(known == 81);
    // Into a property that is there, of floats.
    OpenMesh::VPropHandleT<float> G;
    mesh.add_property(G, "G");
    options.mean_curvature = "G";
    fairmesh::fair(mesh, options);
    CHECK(std::fabs(mesh.property(G, VertexHandle(10 * side + 10)) + 1.0f) < 1e-3f && properties_of(mesh).size() == names.size() + 2);
}

void normals() {
    // Tilted normals given by the mesh: another surface; exact ones: the sphere; all zero: fitted ones.
    auto given = [](double tilt, const char *name, auto vector) {
        auto mesh = selected_cap<Doubles>();
        using Vector = decltype(vector);
        OpenMesh::VPropHandleT<Vector> property;
        if (name == std::string("v:normals")) CHECK(mesh.get_property_handle(property, name));
        else mesh.add_property(property, name);
        for (auto v : mesh.vertices()) {
            auto p = mesh.point(v);
            p[2] += tilt;
            p.normalize();
            for (std::size_t k = 0; k < 3; k++) mesh.property(property, v)[k] = static_cast<typename Vector::value_type>(p[k]);
        }
        fairmesh::openmesh_options options;
        options.boundary_normals_property = name;
        auto report = fairmesh::fair(mesh, options);
        CHECK(report.outcome == FAIRMESH_OUTCOME_CONVERGED);
        return off_sphere(mesh);
    };
    CHECK(given(0.0, "v:normals", Doubles::Normal()) < 1e-7);
    CHECK(given(0.0, "mine", OpenMesh::Vec3d()) < 1e-7);
    CHECK(given(0.0, "mine", OpenMesh::Vec3f()) < 1e-6);
    CHECK(given(0.3, "mine", OpenMesh::Vec3d()) > 1e-3);
    auto zero = selected_cap<Doubles>();
    OpenMesh::VPropHandleT<OpenMesh::Vec3d> property;
    zero.add_property(property, "mine");
    for (auto v : zero.vertices()) zero.property(property, v) = OpenMesh::Vec3d(0, 0, 0);
    fairmesh::openmesh_options options;
    options.boundary_normals_property = "mine";
    auto fitted = selected_cap<Doubles>();
    fairmesh::fair(fitted);
    fairmesh::fair(zero, options);
    CHECK(points_of(zero) == points_of(fitted));
    // A bad one is told by its vertex, a missing one by its name.
    VertexHandle bad(5 * side + 9);
    zero.property(property, bad) = OpenMesh::Vec3d(0, 0, 2);
    auto before = points_of(zero);
    const auto e = thrown<fairmesh::error>([&] { fairmesh::fair(zero, options); });
    CHECK(e.status() == FAIRMESH_STATUS_BAD_NORMAL && e.detail().element == std::uint64_t(bad.idx()));
    options.boundary_normals_property = "nowhere";
    CHECK(says(thrown<std::invalid_argument>([&] { fairmesh::fair(zero, options); }), "nowhere"));
    CHECK(points_of(zero) == before);
}

/** With rings enough inside to take a curvature there. */
Doubles widely_selected_cap() {
    auto mesh = selected_cap<Doubles>();
    for (auto v : mesh.vertices()) {
        int i = v.idx() % side, j = v.idx() / side;
        if (i > 3 && i < 17 && j > 3 && j < 17) mesh.status(v).set_selected(true);
    }
    return mesh;
}

/** Curvature that is continued half of the way: fitted, or given by a property. */
void given_curvature() {
    const auto continued = [](auto number, const std::string &name, double h) {
        auto mesh = widely_selected_cap();
        OpenMesh::VPropHandleT<decltype(number)> property;
        mesh.add_property(property, "mine");
        for (auto v : mesh.vertices()) mesh.property(property, v) = static_cast<decltype(number)>(h);
        fairmesh::openmesh_options options;
        options.continuity = 0.5;
        options.boundary_curvature_property = name;
        auto report = fairmesh::fair(mesh, options);
        CHECK(report.continuity.size() == 1 && report.continuity[0].reached <= 0.5);
        if (!name.empty() && h == h) CHECK(std::abs(report.continuity[0].curvature - std::abs(h)) < 1e-6);
        return points_of(mesh);
    };
    const auto fitted = continued(0.0, "", 0.0);
    CHECK(continued(0.0, "mine", NAN) == fitted);
    CHECK(continued(0.0, "mine", -1.25) == continued(0.0f, "mine", -1.25));
    CHECK(continued(0.0, "mine", -1.25) != fitted);
    auto mesh = selected_cap<Doubles>();
    auto before = points_of(mesh);
    CHECK(fairmesh::fair(mesh).continuity.size() == 1); // the default: continued where it is certain
    mesh = selected_cap<Doubles>();
    fairmesh::openmesh_options options;
    options.continuity = 0.0;
    CHECK(fairmesh::fair(mesh, options).continuity.empty());
    mesh = selected_cap<Doubles>();
    options = {};
    options.boundary_curvature_property = "nowhere";
    CHECK(says(thrown<std::invalid_argument>([&] { fairmesh::fair(mesh, options); }), "nowhere"));
    CHECK(points_of(mesh) == before);
}

/** Deleted elements are not there, and stay until somebody collects them. */
void deleted() {
    auto mesh = selected_cap<Doubles>();
    auto whole = mesh;
    fairmesh::fair(whole);
    // A second sheet with a vertex that is NaN, deleted; and a corner of the grid.
    std::vector<VertexHandle> sheet;
    for (auto p : {OpenMesh::Vec3d(5, 0, 0), OpenMesh::Vec3d(6, 0, 0), OpenMesh::Vec3d(5, 1, 0)}) sheet.push_back(mesh.add_vertex(p));
    mesh.point(sheet[2])[0] = std::nan("");
    mesh.delete_face(mesh.add_face(sheet[0], sheet[1], sheet[2]), true);
    mesh.delete_face(FaceHandle(0), false);
    mesh.delete_face(FaceHandle(1), true);
    for (auto v : sheet) mesh.status(v).set_selected(true);
    auto links = links_of(mesh);
    fairmesh::openmesh_options options;
    options.mean_curvature = "H";
    auto report = fairmesh::fair(mesh, options);
    CHECK(report.free_vertices == 81 && links_of(mesh) == links);
    CHECK(mesh.n_faces() == whole.n_faces() + 1 && std::isnan(mesh.point(sheet[2])[0]));
    for (int v = 0; v < side * side; v++) CHECK(mesh.point(VertexHandle(v)) == whole.point(VertexHandle(v)));
    // Numbers of faces are OpenMesh's: 2 are missing before the worst triangle.
    CHECK(report.worst_triangle >= 2 && !mesh.status(FaceHandle(int(report.worst_triangle))).deleted());
    auto w = selected_cap<Doubles>();
    CHECK(fairmesh::fair(w).worst_triangle == report.worst_triangle);
    mesh.garbage_collection();
    CHECK(mesh.n_faces() + 2 == whole.n_faces());
}

/** An error about a triangle names OpenMesh's face. */
void faces_of_errors() {
    Doubles mesh;
    request_status(mesh);
    std::vector<VertexHandle> v;
    for (auto p : {OpenMesh::Vec3d(0, 0, 0), OpenMesh::Vec3d(1, 0, 0), OpenMesh::Vec3d(0, 1, 0), OpenMesh::Vec3d(9, 0, 0),
                   OpenMesh::Vec3d(9, 1, 0), OpenMesh::Vec3d(8, 1, 0)}) v.push_back(mesh.add_vertex(p));
    auto gone = mesh.add_face(v[3], v[4], v[5]);
    // Both sides of a triangle: a closed surface for OpenMesh, twice the same triangle for fairmesh.
    auto first = mesh.add_face(v[0], v[1], v[2]), second = mesh.add_face(v[0], v[2], v[1]);
    CHECK(second.is_valid());
    mesh.delete_face(gone, false);
    mesh.status(v[0]).set_selected(true);
    const auto e = thrown<fairmesh::error>([&] { fairmesh::fair(mesh); });
    CHECK(e.status() == FAIRMESH_STATUS_DUPLICATE_TRIANGLE && e.detail().element == std::uint64_t(second.idx()));
    CHECK(e.detail().other == std::uint64_t(first.idx()) && says(e, "face 2"));
}

void progress() {
    auto mesh = selected_cap<Doubles>();
    auto before = points_of(mesh);
    auto names = properties_of(mesh);
    fairmesh::openmesh_options options;
    options.mean_curvature = "H";
    // An exception of the callback arrives, and nothing has happened.
    options.on_progress = [](const fairmesh_progress &p) -> bool {
        if (p.iterations == 2) throw std::domain_error("broken");
        return true;
    };
    thrown<std::domain_error>([&] { fairmesh::fair(mesh, options); });
    CHECK(points_of(mesh) == before && properties_of(mesh) == names);
    // Stopped: the best surface so far.
    options.on_progress = [](const fairmesh_progress &p) { return p.iterations < 2; };
    CHECK(fairmesh::fair(mesh, options).outcome == FAIRMESH_OUTCOME_CANCELLED);
    CHECK(points_of(mesh) != before && off_sphere(mesh) < 0.1);
    // Watched to the end.
    double last = 0.0;
    options.on_progress = [&](const fairmesh_progress &p) { return p.fraction >= last && (last = p.fraction, true); };
    CHECK(fairmesh::fair(mesh, options).outcome == FAIRMESH_OUTCOME_CONVERGED && last > 0.0);
}

/** Allocations on this side of the library fail from the k-th on: the mesh is as it was. Many are OpenMesh's assertions', so
 *  that not every k is tried. */
void memory() {
    auto mesh = selected_cap<Doubles>();
    auto before = points_of(mesh);
    auto links = links_of(mesh);
    auto names = properties_of(mesh);
    fairmesh::openmesh_options options;
    options.mean_curvature = "a name that is too long for the string itself";
    options.threads = 1;
    long refused = 0;
    for (long allowed = 0;; allowed += allowed < 200 ? 1 : 31) {
        granted = allowed;
        bool done = false;
        try {
            fairmesh::fair(mesh, options);
            done = true;
        } catch (const std::bad_alloc &) {
            refused++;
        }
        granted = -1;
        if (done) break;
        CHECK(points_of(mesh) == before && links_of(mesh) == links && properties_of(mesh) == names);
    }
    CHECK(refused > 4 && off_sphere(mesh) < 1e-6);
}

} // namespace

int main() {
    fairing<Doubles>(1e-7);
    fairing<Floats>(1e-6);
    fairing<Plain>(1e-6);
    fairing<Mixed>(1e-7);
    regions();
    seams();
    fixed();
    by_hand();
    normals();
    given_curvature();
    deleted();
    faces_of_errors();
    progress();
    memory();
    std::puts("adapter: passed");
}
