// Fills a hole, or fairs vertices, with CGAL's headers; the word is the continuity. The exit code is 2 if CGAL says that the result is not
// fair.
#include <CGAL/Eigen_solver_traits.h>
#include <CGAL/Polygon_mesh_processing/fair.h>
#include <CGAL/Polygon_mesh_processing/triangulate_hole.h>
#include <CGAL/Simple_cartesian.h>
#include <CGAL/Surface_mesh.h>

#include <iostream>

#include "../off.hpp"

namespace pmp = CGAL::Polygon_mesh_processing;
using Mesh = CGAL::Surface_mesh<CGAL::Simple_cartesian<double>::Point_3>;
using Vertex = Mesh::Vertex_index;

Mesh mesh_of(const Off &off) {
    Mesh mesh;
    for (auto &p : off.points) mesh.add_vertex({p[0], p[1], p[2]});
    for (auto &f : off.faces)
        if (mesh.add_face(Vertex(f[0]), Vertex(f[1]), Vertex(f[2])) == Mesh::null_face())
            throw std::runtime_error("the mesh is no manifold");
    return mesh;
}

Off off_of(const Mesh &mesh) {
    Off off;
    for (auto vertex : mesh.vertices()) off.points.push_back({mesh.point(vertex).x(), mesh.point(vertex).y(), mesh.point(vertex).z()});
    for (auto face : mesh.faces()) {
        auto edge = mesh.halfedge(face);
        off.faces.push_back({mesh.source(edge), mesh.target(edge), mesh.target(mesh.next(edge))});
    }
    return off;
}

bool filled(Mesh &mesh, const std::set<unsigned> &hole, unsigned continuity) {
    for (auto edge : mesh.halfedges()) {
        if (!mesh.is_border(edge) || hole.count(mesh.source(edge)) == 0 || hole.count(mesh.target(edge)) == 0) continue;
        std::vector<Mesh::Face_index> faces;
        std::vector<Vertex> vertices;
        return std::get<0>(pmp::triangulate_refine_and_fair_hole(mesh, edge, std::back_inserter(faces), std::back_inserter(vertices),
                                                                 CGAL::parameters::fairing_continuity(continuity)));
    }
    throw std::runtime_error("the hole is not there");
}

bool faired(Mesh &mesh, const std::set<unsigned> &free, unsigned continuity) {
    std::vector<Vertex> vertices(free.begin(), free.end());
    return pmp::fair(mesh, vertices, CGAL::parameters::fairing_continuity(continuity));
}

int main(int, char **words) try {
    Mesh mesh = mesh_of(read_off(words[1]));
    auto work = std::string(words[2]) == "fill" ? filled : faired;
    bool is_fair = work(mesh, read_numbers(words[3]), std::stoul(words[5]));
    write_off(off_of(mesh), words[4]);
    return is_fair ? 0 : 2;
} catch (const std::exception &why) {
    std::cerr << why.what() << '\n';
    return 1;
}
