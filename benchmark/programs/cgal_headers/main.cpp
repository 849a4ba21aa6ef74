// Fills a hole, or fairs vertices, with CGAL's headers: cgal_headers INPUT.off fill|fair NUMBERS OUTPUT.off CONTINUITY, where NUMBERS is a
// file with the vertices of the hole, or the free ones. The exit code is 0 if CGAL says that the result is fair, 2 if it says that it is
// not.
#include <CGAL/Eigen_solver_traits.h>
#include <CGAL/Polygon_mesh_processing/fair.h>
#include <CGAL/Polygon_mesh_processing/triangulate_hole.h>
#include <CGAL/Simple_cartesian.h>
#include <CGAL/Surface_mesh.h>

#include <fstream>
#include <iostream>
#include <set>
#include <string>
#include <tuple>
#include <vector>

namespace pmp = CGAL::Polygon_mesh_processing;
using Mesh = CGAL::Surface_mesh<CGAL::Simple_cartesian<double>::Point_3>;

Mesh read(const char *path) {
    Mesh mesh;
    std::ifstream in(path);
    std::string word;
    std::size_t vertices = 0, faces = 0;
    in >> word >> vertices >> faces >> word;
    for (std::size_t k = 0; k < vertices; ++k) {
        double x = 0, y = 0, z = 0;
        in >> x >> y >> z;
        mesh.add_vertex({x, y, z});
    }
    for (std::size_t k = 0; k < faces; ++k) {
        unsigned count = 0, a = 0, b = 0, c = 0;
        in >> count >> a >> b >> c;
        if (mesh.add_face(Mesh::Vertex_index(a), Mesh::Vertex_index(b), Mesh::Vertex_index(c)) == Mesh::null_face())
            throw std::runtime_error("the mesh is no manifold");
    }
    return mesh;
}

void write(const Mesh &mesh, const char *path) {
    std::ofstream out(path);
    out.precision(17);
    out << "OFF\n" << mesh.number_of_vertices() << ' ' << mesh.number_of_faces() << " 0\n";
    for (auto vertex : mesh.vertices()) out << mesh.point(vertex) << '\n';
    for (auto face : mesh.faces()) {
        out << 3;
        for (auto vertex : CGAL::vertices_around_face(mesh.halfedge(face), mesh)) out << ' ' << vertex.idx();
        out << '\n';
    }
}

bool filled(Mesh &mesh, const std::set<unsigned> &hole, unsigned continuity) {
    for (auto edge : mesh.halfedges()) {
        if (!mesh.is_border(edge) || hole.count(mesh.source(edge).idx()) == 0 || hole.count(mesh.target(edge).idx()) == 0) continue;
        std::vector<Mesh::Face_index> faces;
        std::vector<Mesh::Vertex_index> vertices;
        return std::get<0>(pmp::triangulate_refine_and_fair_hole(mesh, edge, std::back_inserter(faces), std::back_inserter(vertices),
                                                                 CGAL::parameters::fairing_continuity(continuity)));
    }
    throw std::runtime_error("the hole is not there");
}

bool faired(Mesh &mesh, const std::set<unsigned> &free, unsigned continuity) {
    std::vector<Mesh::Vertex_index> vertices;
    for (unsigned number : free) vertices.emplace_back(number);
    return pmp::fair(mesh, vertices, CGAL::parameters::fairing_continuity(continuity));
}

int main(int, char **words) try {
    Mesh mesh = read(words[1]);
    std::ifstream in(words[3]);
    std::set<unsigned> numbers{std::istream_iterator<unsigned>(in), {}};
    auto work = std::string(words[2]) == "fill" ? filled : faired;
    bool is_fair = work(mesh, numbers, std::stoul(words[5]));
    write(mesh, words[4]);
    return is_fair ? 0 : 2;
} catch (const std::exception &why) {
    std::cerr << why.what() << '\n';
    return 1;
}
