// Does not compile: meshes that the adapter cannot take are refused by name.
#include <OpenMesh/Core/Mesh/PolyMesh_ArrayKernelT.hh>
#include <OpenMesh/Core/Mesh/TriMesh_ArrayKernelT.hh>
#include <fairmesh_openmesh.hpp>

struct Integers : OpenMesh::DefaultTraits {
    using Point = OpenMesh::Vec3i;
};

int main() {
#if defined(POLY)
    OpenMesh::PolyMesh_ArrayKernelT<> mesh;
#elif defined(INTEGERS)
    OpenMesh::TriMesh_ArrayKernelT<Integers> mesh;
#elif defined(CONSTANT)
    const OpenMesh::TriMesh_ArrayKernelT<> mesh;
#else
    OpenMesh::TriMesh_ArrayKernelT<> mesh;
#endif
    fairmesh::fair(mesh);
}
