// What the tests of the adapter share.
#pragma once

#include <OpenMesh/Core/Mesh/TriMesh_ArrayKernelT.hh>

#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <string>

#define CHECK(condition)                                                                    \
    do {                                                                                    \
        if (!(condition)) {                                                                 \
            std::fprintf(stderr, "%s:%d: failed: %s\n", __FILE__, __LINE__, #condition);    \
            std::exit(1);                                                                   \
        }                                                                                   \
    } while (0)

/** What `function` throws, which has to be an `Error`. */
template <class Error, class Function> Error thrown(Function function) {
    try {
        function();
    } catch (const Error &why) {
        return why;
    }
    CHECK(!"thrown");
    std::abort();
}
inline bool says(const std::exception &why, const char *word) { return std::string(why.what()).find(word) != std::string::npos; }

template <class Scalar> struct Traits : OpenMesh::DefaultTraits {
    using Point = OpenMesh::VectorT<Scalar, 3>;
    using Normal = OpenMesh::VectorT<Scalar, 3>;
    using TexCoord2D = OpenMesh::VectorT<Scalar, 2>;
};
using Doubles = OpenMesh::TriMesh_ArrayKernelT<Traits<double>>;
using Floats = OpenMesh::TriMesh_ArrayKernelT<Traits<float>>;
using OpenMesh::EdgeHandle;
using OpenMesh::FaceHandle;
using OpenMesh::VertexHandle;

template <class Mesh> void request_status(Mesh &mesh) {
    mesh.request_vertex_status();
    mesh.request_edge_status();
    mesh.request_halfedge_status();
    mesh.request_face_status();
}

template <class Mesh> typename Mesh::Point point(double x, double y, double z) {
    using Scalar = typename Mesh::Scalar;
    return typename Mesh::Point(static_cast<Scalar>(x), static_cast<Scalar>(y), static_cast<Scalar>(z));
}

/** How far the furthest of these vertices is from the sphere about the origin. */
template <class Mesh, class Vertices> double off_sphere(const Mesh &mesh, const Vertices &vertices, double radius = 1) {
    double worst = 0.0;
    for (const VertexHandle v : vertices) {
        const auto p = mesh.point(v);
        const double x = p[0], y = p[1], z = p[2];
        worst = std::fmax(worst, std::fabs(std::sqrt(x * x + y * y + z * z) - radius));
    }
    return worst;
}
template <class Mesh> double off_sphere(const Mesh &mesh) { return off_sphere(mesh, mesh.vertices()); }
