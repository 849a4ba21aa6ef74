// What peers.py measures CGAL with.
#define CGAL_EIGEN3_ENABLED 1
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/fair.h>
#include <CGAL/Surface_mesh.h>
#include <ctime>
#include <fstream>
#include <iostream>
typedef CGAL::Exact_predicates_inexact_constructions_kernel Kernel;
typedef CGAL::Surface_mesh<Kernel::Point_3> Mesh;
// Reads counts, positions, triangles and free vertices; writes seconds of the processor and positions.
int main(int, char **argv) {
    std::ifstream in(argv[1]);
    std::size_t points, triangles, free;
    in >> points >> triangles >> free;
    Mesh mesh;
    for (std::size_t k = 0; k < points; ++k) {
        double x, y, z;
        in >> x >> y >> z;
        mesh.add_vertex(Kernel::Point_3(x, y, z));
    }
    for (std::size_t k = 0; k < triangles; ++k) {
        unsigned a, b, c;
        in >> a >> b >> c;
        mesh.add_face(Mesh::Vertex_index(a), Mesh::Vertex_index(b), Mesh::Vertex_index(c));
    }
    std::vector<Mesh::Vertex_index> inside;
    for (unsigned v; in >> v;) inside.push_back(Mesh::Vertex_index(v));
    const std::clock_t begin = std::clock();
    const bool good = CGAL::Polygon_mesh_processing::fair(mesh, inside, CGAL::parameters::fairing_continuity(2));
    std::ofstream out(argv[2]);
    out.precision(17);
    out << double(std::clock() - begin) / CLOCKS_PER_SEC << "\n";
    for (auto v : mesh.vertices()) out << mesh.point(v) << "\n";
    return good ? 0 : 1;
}
