// Opens a mesh with OpenMesh, selects vertices, fairs them, saves the mesh:
//   fair_region in.ply out.ply property free         vertices whose property `free` is not zero (PLY)
//   fair_region in.obj out.obj sphere 0 0 1 0.5      vertices in a sphere: its centre, its radius
#include <OpenMesh/Core/IO/MeshIO.hh>
#include <OpenMesh/Core/Mesh/TriMesh_ArrayKernelT.hh>
#include <cstdio>
#include <cstdlib>
#include <fairmesh_openmesh.hpp>
#include <string>

struct Traits : OpenMesh::DefaultTraits {
    using Point = OpenMesh::Vec3d;
    using Normal = OpenMesh::Vec3d;
    VertexAttributes(OpenMesh::Attributes::Status);
    EdgeAttributes(OpenMesh::Attributes::Status);
    FaceAttributes(OpenMesh::Attributes::Status);
};
using Mesh = OpenMesh::TriMesh_ArrayKernelT<Traits>;

/** Zero; OpenMesh reads the bytes of a PLY file in text as characters. */
template <class Number> bool is_zero(Number n) {
    return n == Number(0) || (sizeof n == 1 && n == Number('0'));
}

/** PLY has numbers of several types; OpenMesh makes a property of each as it is. */
template <class Number> bool select_by(Mesh &mesh, const std::string &name) {
    OpenMesh::VPropHandleT<Number> property;
    if (!mesh.get_property_handle(property, name)) return false;
    for (auto v : mesh.vertices()) mesh.status(v).set_selected(!is_zero(mesh.property(property, v)));
    return true;
}

static bool select_by_property(Mesh &mesh, const std::string &name) {
    return select_by<unsigned char>(mesh, name) || select_by<signed char>(mesh, name) || select_by<int>(mesh, name) ||
           select_by<unsigned int>(mesh, name) || select_by<float>(mesh, name) || select_by<double>(mesh, name);
}

static void select_by_sphere(Mesh &mesh, const Mesh::Point &centre, double radius) {
    for (auto v : mesh.vertices()) mesh.status(v).set_selected((mesh.point(v) - centre).norm() < radius);
}

static int usage() {
    std::fprintf(stderr, "usage: fair_region IN OUT property NAME | sphere X Y Z RADIUS\n");
    return 1;
}

int main(int count, char **words) {
    if (count < 5) return usage();
    Mesh mesh;
    OpenMesh::IO::Options custom = OpenMesh::IO::Options::Custom;
    if (!OpenMesh::IO::read_mesh(mesh, words[1], custom)) return 1;

    std::string how = words[3];
    if (how == "property" && count == 5) {
        if (!select_by_property(mesh, words[4])) {
            std::fprintf(stderr, "%s has no vertex property %s\n", words[1], words[4]);
            return 1;
        }
    } else if (how == "sphere" && count == 8) {
        auto number = [&](int k) { return std::atof(words[k]); };
        select_by_sphere(mesh, Mesh::Point(number(4), number(5), number(6)), number(7));
    } else {
        return usage();
    }

    try {
        fairmesh::openmesh_options options;
        options.on_progress = [](const fairmesh_progress &p) {
            std::printf("\r%3.0f %%", 100.0 * p.fraction);
            return true;
        };
        auto report = fairmesh::fair(mesh, options);
        std::printf("\r%s: %u free vertices, %u iterations\n", fairmesh::name(FAIRMESH_ANSWER_OUTCOME, report.outcome),
                    static_cast<unsigned>(report.free_vertices), static_cast<unsigned>(report.iterations));
    } catch (const std::exception &e) {
        std::fprintf(stderr, "%s\n", e.what());
        return 1;
    }
    return OpenMesh::IO::write_mesh(mesh, words[2], OpenMesh::IO::Options::Default, 17) ? 0 : 1;
}
