#include "shim.h"

#include <OpenMesh/Core/IO/MeshIO.hh>
#include <OpenMesh/Core/Mesh/TriMesh_ArrayKernelT.hh>
#include <OpenMesh/Tools/Smoother/JacobiLaplaceSmootherT.hh>

#include <memory>
#include <stdexcept>
#include <string>

namespace {

thread_local std::string last_error;

template <class Scalar_> struct Traits : OpenMesh::DefaultTraits {
    using Point = OpenMesh::VectorT<Scalar_, 3>;
    using Normal = OpenMesh::VectorT<Scalar_, 3>;
    VertexAttributes(OpenMesh::Attributes::Status | OpenMesh::Attributes::Normal);
    HalfedgeAttributes(OpenMesh::Attributes::Status | OpenMesh::Attributes::PrevHalfedge);
    EdgeAttributes(OpenMesh::Attributes::Status);
    FaceAttributes(OpenMesh::Attributes::Status | OpenMesh::Attributes::Normal);
};

/** OpenMesh reports on std::cerr besides returning false. */
void silence() {
    static const bool once = (omerr().disable(), omlog().disable(), true);
    (void)once;
}

/** What `function` returns, or nothing and a message. */
template <class Result, class Function> Result guarded(Result otherwise, Function function) noexcept {
    try {
        silence();
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
    virtual ~om_mesh() = default;
    virtual void build(const double *positions, size_t vertices, const uint32_t *triangles, size_t faces) = 0;
    virtual void read(const char *path) = 0;
    virtual void write(const char *path) const = 0;
    virtual size_t count(uint32_t element) const = 0;
    virtual void positions(double *out) const = 0;
    virtual void set_positions(const double *positions) = 0;
    virtual void triangles(uint32_t *out) const = 0;
    virtual size_t edge(size_t a, size_t b) const = 0;
    virtual OpenMesh::Attributes::StatusInfo &status(uint32_t element, size_t index) = 0;
    virtual void update_normals() = 0;
    virtual void normals(double *out) const = 0;
    virtual void smooth(uint32_t component, uint32_t continuity, uint32_t iterations, bool skip_features) = 0;
};

namespace {

template <class Scalar> struct mesh_of final : om_mesh {
    using Mesh = OpenMesh::TriMesh_ArrayKernelT<Traits<Scalar>>;
    using Smoother = OpenMesh::Smoother::JacobiLaplaceSmootherT<Mesh>;
    using Point = typename Mesh::Point;

    Mesh mesh;

    static auto vertex(size_t index) { return typename Mesh::VertexHandle(static_cast<int>(index)); }

    static Point point(const double *from) {
        return Point(static_cast<Scalar>(from[0]), static_cast<Scalar>(from[1]), static_cast<Scalar>(from[2]));
    }

    static void copy(const Point &from, double *to) {
        for (int k = 0; k < 3; k++) to[k] = from[k];
    }

    void build(const double *positions, size_t vertices, const uint32_t *triangles, size_t faces) override {
        mesh.reserve(vertices, 3 * faces / 2, faces);
        for (size_t v = 0; v < vertices; v++) mesh.add_vertex(point(positions + 3 * v));
        for (size_t f = 0; f < faces; f++) {
            const uint32_t *t = triangles + 3 * f;
            bool inside = t[0] < vertices && t[1] < vertices && t[2] < vertices;
            if (!inside || !mesh.add_face(vertex(t[0]), vertex(t[1]), vertex(t[2])).is_valid()) {
                throw std::runtime_error("OpenMesh refuses triangle " + std::to_string(f));
            }
        }
    }

    void read(const char *path) override {
        if (!OpenMesh::IO::read_mesh(mesh, path)) throw std::runtime_error(std::string("OpenMesh cannot read ") + path);
    }

    void write(const char *path) const override {
        // More digits than the default six: what is written as text is read back to the same bits.
        if (!OpenMesh::IO::write_mesh(mesh, path, OpenMesh::IO::Options::Default, 17)) {
            throw std::runtime_error(std::string("OpenMesh cannot write ") + path);
        }
    }

    size_t count(uint32_t element) const override {
        switch (element) {
        case OM_VERTEX: return mesh.n_vertices();
        case OM_EDGE: return mesh.n_edges();
        default: return mesh.n_faces();
        }
    }

    void positions(double *out) const override {
        for (size_t v = 0; v < mesh.n_vertices(); v++) copy(mesh.point(vertex(v)), out + 3 * v);
    }

    void set_positions(const double *positions) override {
        for (size_t v = 0; v < mesh.n_vertices(); v++) mesh.set_point(vertex(v), point(positions + 3 * v));
    }

    void triangles(uint32_t *out) const override {
        for (auto face : mesh.all_faces()) {
            for (auto corner : mesh.fv_range(face)) *out++ = static_cast<uint32_t>(corner.idx());
        }
    }

    size_t edge(size_t a, size_t b) const override {
        auto halfedge = mesh.find_halfedge(vertex(a), vertex(b));
        return halfedge.is_valid() ? static_cast<size_t>(mesh.edge_handle(halfedge).idx()) : SIZE_MAX;
    }

    OpenMesh::Attributes::StatusInfo &status(uint32_t element, size_t index) override {
        int number = static_cast<int>(index);
        switch (element) {
        case OM_VERTEX: return mesh.status(typename Mesh::VertexHandle(number));
        case OM_EDGE: return mesh.status(typename Mesh::EdgeHandle(number));
        default: return mesh.status(typename Mesh::FaceHandle(number));
        }
    }

    void update_normals() override { mesh.update_normals(); }

    void normals(double *out) const override {
        for (size_t v = 0; v < mesh.n_vertices(); v++) copy(mesh.normal(vertex(v)), out + 3 * v);
    }

    void smooth(uint32_t component, uint32_t continuity, uint32_t iterations, bool skip_features) override {
        Smoother smoother(mesh);
        auto part = component == OM_TANGENTIAL ? Smoother::Tangential
                    : component == OM_NORMAL   ? Smoother::Normal
                                               : Smoother::Tangential_and_Normal;
        smoother.skip_features(skip_features);
        smoother.initialize(part, continuity == OM_C0 ? Smoother::C0 : Smoother::C1);
        smoother.smooth(iterations);
    }
};

om_mesh *made(uint32_t scalar) {
    if (scalar == OM_FLOAT) return new mesh_of<float>;
    return new mesh_of<double>;
}

} // namespace

const char *om_last_error(void) { return last_error.empty() ? "out of memory" : last_error.c_str(); }

om_mesh *om_mesh_build(uint32_t scalar, const double *positions, size_t vertices, const uint32_t *triangles, size_t faces) {
    return guarded(static_cast<om_mesh *>(nullptr), [&] {
        std::unique_ptr<om_mesh> mesh(made(scalar));
        mesh->build(positions, vertices, triangles, faces);
        return mesh.release();
    });
}

om_mesh *om_mesh_read(uint32_t scalar, const char *path) {
    return guarded(static_cast<om_mesh *>(nullptr), [&] {
        std::unique_ptr<om_mesh> mesh(made(scalar));
        mesh->read(path);
        return mesh.release();
    });
}

bool om_mesh_write(const om_mesh *mesh, const char *path) {
    return guarded(false, [&] { return mesh->write(path), true; });
}

void om_mesh_free(om_mesh *mesh) { delete mesh; }

size_t om_mesh_count(const om_mesh *mesh, uint32_t element) { return mesh->count(element); }

void om_mesh_positions(const om_mesh *mesh, double *out) { mesh->positions(out); }

void om_mesh_set_positions(om_mesh *mesh, const double *positions) { mesh->set_positions(positions); }

void om_mesh_triangles(const om_mesh *mesh, uint32_t *out) { mesh->triangles(out); }

size_t om_mesh_edge(const om_mesh *mesh, size_t a, size_t b) { return mesh->edge(a, b); }

bool om_mesh_status(const om_mesh *mesh, uint32_t element, size_t index, uint32_t flag) {
    auto &status = const_cast<om_mesh *>(mesh)->status(element, index);
    switch (flag) {
    case OM_SELECTED: return status.selected();
    case OM_LOCKED: return status.locked();
    case OM_FEATURE: return status.feature();
    default: return status.deleted();
    }
}

void om_mesh_set_status(om_mesh *mesh, uint32_t element, size_t index, uint32_t flag, bool value) {
    auto &status = mesh->status(element, index);
    switch (flag) {
    case OM_SELECTED: status.set_selected(value); break;
    case OM_LOCKED: status.set_locked(value); break;
    case OM_FEATURE: status.set_feature(value); break;
    default: break;
    }
}

void om_mesh_update_normals(om_mesh *mesh) { mesh->update_normals(); }

void om_mesh_normals(const om_mesh *mesh, double *out) { mesh->normals(out); }

bool om_mesh_smooth(om_mesh *mesh, uint32_t component, uint32_t continuity, uint32_t iterations, bool skip_features) {
    return guarded(false, [&] { return mesh->smooth(component, continuity, iterations, skip_features), true; });
}
