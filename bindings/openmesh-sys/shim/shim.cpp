#include "shim.h"

#include <OpenMesh/Core/Mesh/TriMesh_ArrayKernelT.hh>
#include <OpenMesh/Tools/Smoother/JacobiLaplaceSmootherT.hh>

#include <memory>
#include <stdexcept>
#include <string>

namespace {

thread_local std::string last_error;

struct Traits : OpenMesh::DefaultTraits {
    using Point = OpenMesh::Vec3d;
    using Normal = OpenMesh::Vec3d;
    VertexAttributes(OpenMesh::Attributes::Status | OpenMesh::Attributes::Normal);
    FaceAttributes(OpenMesh::Attributes::Normal);
};
using Mesh = OpenMesh::TriMesh_ArrayKernelT<Traits>;
using Smoother = OpenMesh::Smoother::JacobiLaplaceSmootherT<Mesh>;

Mesh::VertexHandle vertex(size_t index) { return Mesh::VertexHandle(static_cast<int>(index)); }

/** What `function` returns, or nothing and a message. */
template <class Result, class Function> Result guarded(Result otherwise, Function function) noexcept {
    try {
        last_error.clear();
        return function();
    } catch (const std::exception &e) {
        try {
            last_error = e.what();
        } catch (...) {
        }
    } catch (...) {
    }
    return otherwise;
}

} // namespace

struct om_mesh {
    Mesh mesh;
};

const char *om_last_error(void) { return last_error.empty() ? "out of memory" : last_error.c_str(); }

om_mesh *om_mesh_build(const double *positions, size_t vertices, const uint32_t *triangles, size_t faces) {
    return guarded(static_cast<om_mesh *>(nullptr), [&] {
        // OpenMesh reports on std::cerr besides returning an invalid handle.
        omerr().disable();
        auto made = std::make_unique<om_mesh>();
        for (const double *p = positions; p != positions + 3 * vertices; p += 3) made->mesh.add_vertex(Mesh::Point(p[0], p[1], p[2]));
        for (size_t f = 0; f < faces; f++) {
            const uint32_t *t = triangles + 3 * f;
            const bool inside = t[0] < vertices && t[1] < vertices && t[2] < vertices;
            if (!inside || !made->mesh.add_face(vertex(t[0]), vertex(t[1]), vertex(t[2])).is_valid()) {
                throw std::runtime_error("OpenMesh refuses triangle " + std::to_string(f));
            }
        }
        return made.release();
    });
}

void om_mesh_free(om_mesh *mesh) { delete mesh; }

void om_mesh_positions(const om_mesh *mesh, double *out) {
    for (auto v : mesh->mesh.vertices()) {
        for (double coordinate : mesh->mesh.point(v)) *out++ = coordinate;
    }
}

void om_mesh_select(om_mesh *mesh, const bool *vertices) {
    for (auto v : mesh->mesh.vertices()) mesh->mesh.status(v).set_selected(*vertices++);
}

bool om_mesh_smooth(om_mesh *mesh, uint32_t iterations) {
    return guarded(false, [&] {
        Smoother smoother(mesh->mesh);
        smoother.initialize(Smoother::Tangential_and_Normal, Smoother::C1);
        smoother.smooth(iterations);
        return true;
    });
}
