"""Meshes of other packages: which they are, how they are read, and how one of their kind is made again.

No package is imported here: whoever has a mesh of its kind has imported it.
"""

from __future__ import annotations

import abc
import os
import sys
from collections.abc import Callable
from typing import TYPE_CHECKING, Any, Protocol, TypeVar, Union

import numpy as np
from numpy.typing import NDArray

from ._carry import renewed
from ._forms import ArrayLike

if TYPE_CHECKING:
    from ._carry import Change


class HasVertices(Protocol):
    """A mesh of trimesh, or of Open3D."""

    @property
    def vertices(self) -> Any:
        """(n, 3)."""


class HasPoints(Protocol):
    """A mesh of pyvista or meshio."""

    @property
    def points(self) -> Any:
        """(n, 3)."""


class HasVertex(Protocol):
    """A mesh of Open3D's tensors."""

    @property
    def vertex(self) -> Any:
        """What belongs to its vertices."""


#: A mesh: `trimesh.Trimesh`, `pyvista.PolyData`, `open3d.geometry.TriangleMesh` or `open3d.t.geometry.TriangleMesh`,
#: `meshio.Mesh`, or a pair of arrays, vertices (n, 3) and faces (m, 3).
MeshLike = Union[HasVertices, HasPoints, HasVertex, tuple[ArrayLike, ArrayLike]]
#: One of these, and the same again.
M = TypeVar("M", bound=MeshLike)
#: The pair of arrays that functions give back which were given two arrays.
Arrays = tuple[NDArray[Any], NDArray[Any]]


class Host(abc.ABC):
    """A mesh that was given. Its arrays are read once, when it is given."""

    #: What it is called where it is about its data: "vertex_attributes", ...
    vertex_data_name = ""
    face_data_name = ""

    #: (n, 3) and (m, 3).
    vertices: Any
    faces: Any

    @abc.abstractmethod
    def __init__(self, mesh: Any) -> None:
        self._mesh = mesh

    def same(self, made: Callable[[], Any]) -> Any:
        """What is made of the mesh, if it has the vertices and faces that it had when it was given."""
        now = type(self)(self._mesh)
        if len(now.vertices) != len(self.vertices) or not np.array_equal(now.faces, self.faces):
            raise ValueError(
                "the mesh that was given has other vertices or faces now: ask for the new mesh before that"
            )
        return made()

    def vertex_data(self, name: str) -> Any:
        """What the mesh has under this name at its vertices; None if there is no such thing."""
        del name

    def face_data(self, name: str) -> Any:
        """What the mesh has under this name at its faces; None if there is no such thing."""
        del name

    def renewed(self, normals: Any, vertices: NDArray[Any], faces: NDArray[Any]) -> NDArray[Any]:
        """Normals of a mesh that was made of this one, made anew where the surface is another one."""
        return renewed(np.asarray(normals), (np.asarray(self.vertices), np.asarray(self.faces)), (vertices, faces))

    @abc.abstractmethod
    def moved(self, vertices: NDArray[Any]) -> Any:
        """A copy with other positions of the same vertices."""

    @abc.abstractmethod
    def rebuilt(self, change: Change) -> Any:
        """A copy with other vertices and faces, and all that can be carried over to them."""


class Pair(Host):
    """Two arrays."""

    def __init__(self, vertices: ArrayLike, faces: ArrayLike) -> None:
        self.vertices = vertices
        self.faces = faces

    def same(self, made: Callable[[], Any]) -> Any:
        """Nothing else can be made of arrays."""
        return made()

    def moved(self, vertices: NDArray[Any]) -> Arrays:
        """The vertices, and the faces as they were given."""
        return vertices, np.asarray(self.faces)

    def rebuilt(self, change: Change) -> Arrays:
        """The vertices and faces."""
        return change.vertices, change.faces


def _trimesh(mesh: Any) -> Host:
    from ._host_trimesh import Trimesh

    return Trimesh(mesh)


def _pyvista(mesh: Any) -> Host:
    from ._host_pyvista import PolyData

    return PolyData(mesh)


def _open3d(mesh: Any) -> Host:
    from ._host_open3d import TensorMesh, TriangleMesh

    return TensorMesh(mesh) if ".t." in type(mesh).__module__ else TriangleMesh(mesh)


def _meshio(mesh: Any) -> Host:
    from ._host_meshio import Mesh

    return Mesh(mesh)


#: Package and class.
_KINDS: dict[tuple[str, str], Callable[[Any], Host]] = {
    ("trimesh", "Trimesh"): _trimesh,
    ("pyvista", "PolyData"): _pyvista,
    ("open3d", "TriangleMesh"): _open3d,
    ("meshio", "Mesh"): _meshio,
}
#: What is no mesh of triangles, and what to do then.
_NOT_QUITE = {
    ("trimesh", "Scene"): "has meshes inside: give scene.to_mesh(), or one of scene.geometry.values()",
    ("trimesh", "PointCloud"): "has no faces",
    ("pyvista", "MultiBlock"): "has meshes inside: give one of them",
    ("pyvista", "DataSet"): "is no surface of triangles: give mesh.extract_surface().triangulate()",
    ("vtkmodules", "vtkDataObject"): "is a mesh of VTK: give pyvista.wrap(mesh)",
    ("open3d", "PointCloud"): "has no faces",
}


def host_of(given: Any) -> Host | None:
    """A mesh object, or a pair of arrays, as a host; None for what is one array."""
    if isinstance(given, (tuple, list)) and len(given) == 2:
        # Not two points: these are of one dimension.
        ranks = [getattr(each, "ndim", None) or (2 if _is_nested(each) else 1) for each in given]
        return Pair(*given) if ranks == [2, 2] else None
    if isinstance(given, (np.ndarray, tuple, list)):
        return None
    if isinstance(given, (str, os.PathLike)):
        raise TypeError("a mesh is needed, not the name of a file: read it first, for example with trimesh.load_mesh")
    for base in type(given).__mro__:
        kind = (base.__module__.split(".")[0], base.__name__)
        if kind in _KINDS:
            return _KINDS[kind](given)
        if kind in _NOT_QUITE:
            raise TypeError(f"{_a(given)} {_NOT_QUITE[kind]}")
    faces = next((name for name in ("faces", "triangles") if hasattr(given, name)), None)
    if faces and hasattr(given, "vertices"):
        raise TypeError(
            f"{_a(given)} is no mesh of a package that is known: "
            f"give mesh.vertices and mesh.{faces} in its place, as vertices and faces"
        )
    return None


def _a(given: Any) -> str:
    name = type(given).__name__
    return f"an {name}" if name[0] in "AEIOU" else f"a {name}"


def _is_nested(given: Any) -> bool:
    return isinstance(given, (tuple, list)) and len(given) > 0 and np.ndim(given[0]) == 1


def package(name: str) -> Any:
    """The package that a mesh is of: whoever made the mesh has imported it."""
    return sys.modules[name]
