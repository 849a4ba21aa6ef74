// SPDX-License-Identifier: MIT OR Apache-2.0
#include "given_normals.h"

#include <cmath>
#include <typeindex>

namespace fairmesh_meshlab {

namespace {

/** NaN and infinite vectors stay what they are: the library names the vertex if they are needed. */
std::array<double, 3> unit(double x, double y, double z) {
    const double length = std::hypot(x, y, z);
    if (length == 0) return {0, 0, 0};
    return {x / length, y / length, z / length};
}

/** A handle to the attribute of this name; null if there is none of this type. vcg itself compares names and sizes only. */
template <class Type> CMeshO::PerVertexAttributeHandle<Type> find(CMeshO &mesh, const std::string &name) {
    for (const auto &attribute : mesh.vert_attr)
        if (attribute._name == name && attribute._type == std::type_index(typeid(Type)))
            return vcg::tri::Allocator<CMeshO>::FindPerVertexAttribute<Type>(mesh, name);
    return CMeshO::PerVertexAttributeHandle<Type>(nullptr, 0);
}

template <class Vector> bool read_vectors(CMeshO &mesh, const std::string &name, Vectors &out) {
    auto handle = find<Vector>(mesh, name);
    if (!handle._handle) return false;
    for (std::size_t i = 0; i < out.size(); ++i) {
        const Vector &n = handle[i];
        out[i] = unit(n[0], n[1], n[2]);
    }
    return true;
}

template <class Number> bool read_numbers(CMeshO &mesh, const std::string &name, Vectors &out) {
    Vectors read(out.size());
    for (int axis = 0; axis < 3; ++axis) {
        const std::string full = name + "_" + "xyz"[axis];
        auto handle = find<Number>(mesh, full);
        if (!handle._handle) return false;
        for (std::size_t i = 0; i < out.size(); ++i) read[i][axis] = handle[i];
    }
    for (std::size_t i = 0; i < out.size(); ++i) out[i] = unit(read[i][0], read[i][1], read[i][2]);
    return true;
}

} // namespace

Vectors vertex_normals(const CMeshO &mesh) {
    Vectors normals(mesh.vert.size());
    for (std::size_t i = 0; i < normals.size(); ++i) {
        const auto &n = mesh.vert[i].cN();
        normals[i] = unit(n[0], n[1], n[2]);
    }
    return normals;
}

Vectors attribute_normals(CMeshO &mesh, const std::string &name) {
    if (name.empty()) throw Failure("Boundary normals from an attribute: its name is not given.");
    Vectors normals(mesh.vert.size());
    if (read_vectors<vcg::Point3<float>>(mesh, name, normals) || read_vectors<vcg::Point3<double>>(mesh, name, normals) ||
        read_numbers<float>(mesh, name, normals) || read_numbers<double>(mesh, name, normals))
        return normals;
    throw Failure("The mesh has no per-vertex attribute '" + name + "' of points, and no three attributes '" + name +
                  "_x', '_y' and '_z' of numbers.");
}

} // namespace fairmesh_meshlab
