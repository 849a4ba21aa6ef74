// Fills a hole, or fairs vertices, with the Polygon Mesh Processing Library; the word is the order of the Laplacian for fairing.
#include <pmp/algorithms/fairing.h>
#include <pmp/algorithms/hole_filling.h>

#include <iostream>

#include "../off.hpp"

pmp::SurfaceMesh mesh_of(const Off &off) {
    pmp::SurfaceMesh mesh;
    for (auto &p : off.points) mesh.add_vertex(pmp::Point(p[0], p[1], p[2]));
    for (auto &f : off.faces) mesh.add_triangle(pmp::Vertex(f[0]), pmp::Vertex(f[1]), pmp::Vertex(f[2]));
    return mesh;
}

Off off_of(const pmp::SurfaceMesh &mesh) {
    Off off;
    for (auto vertex : mesh.vertices())
        off.points.push_back({mesh.position(vertex)[0], mesh.position(vertex)[1], mesh.position(vertex)[2]});
    for (auto face : mesh.faces()) {
        auto edge = mesh.halfedge(face);
        off.faces.push_back({mesh.from_vertex(edge).idx(), mesh.to_vertex(edge).idx(), mesh.to_vertex(mesh.next_halfedge(edge)).idx()});
    }
    return off;
}

void fill(pmp::SurfaceMesh &mesh, const std::set<unsigned> &hole) {
    for (auto edge : mesh.halfedges()) {
        if (!mesh.is_boundary(edge) || hole.count(mesh.from_vertex(edge).idx()) == 0 || hole.count(mesh.to_vertex(edge).idx()) == 0)
            continue;
        pmp::fill_hole(mesh, edge);
        // Old vertices stay in front, as none of them is removed.
        mesh.garbage_collection();
        return;
    }
    throw std::runtime_error("the hole is not there");
}

void fair(pmp::SurfaceMesh &mesh, const std::set<unsigned> &free, unsigned order) {
    auto selected = mesh.add_vertex_property<bool>("v:selected", false);
    for (unsigned number : free) selected[pmp::Vertex(number)] = true;
    pmp::fair(mesh, order);
}

int main(int, char **words) try {
    pmp::SurfaceMesh mesh = mesh_of(read_off(words[1]));
    if (std::string(words[2]) == "fill") fill(mesh, read_numbers(words[3]));
    else fair(mesh, read_numbers(words[3]), std::stoul(words[5]));
    write_off(off_of(mesh), words[4]);
} catch (const std::exception &why) {
    std::cerr << why.what() << '\n';
    return 1;
}
