"""Triangle meshes: arrays, files, and what a mesh is made of."""

from __future__ import annotations

from pathlib import Path
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

Points = NDArray[np.float64]
Faces = NDArray[np.int64]
Mask = NDArray[np.bool_]


class Mesh(NamedTuple):
    """Vertices (n, 3) and triangles (m, 3), counter-clockwise seen from outside."""

    vertices: Points
    faces: Faces

    def corners(self) -> Points:
        """The corners of every triangle, (m, 3, 3)."""
        return self.vertices[self.faces]

    def normals(self) -> Points:
        """Normals of the triangles, as long as twice their areas."""
        a, b, c = np.moveaxis(self.corners(), 1, 0)
        return np.cross(b - a, c - a)

    def areas(self) -> NDArray[np.float64]:
        """Of the triangles."""
        return np.linalg.norm(self.normals(), axis=1) / 2

    def diagonal(self) -> float:
        """Of the box around what triangles have."""
        return float(np.linalg.norm(np.ptp(self.vertices[np.unique(self.faces)], axis=0)))

    def only(self, kept: Mask) -> Mesh:
        """These triangles, without the vertices that none of them has."""
        used, faces = np.unique(self.faces[kept], return_inverse=True)
        return Mesh(self.vertices[used], faces.reshape(-1, 3))


def write_ply(path: Path, mesh: Mesh) -> None:
    """Binary: coordinates in single precision if that loses nothing, else in double."""
    is_single = (mesh.vertices == mesh.vertices.astype("<f4")).all()
    head = f"ply\nformat binary_little_endian 1.0\nelement vertex {len(mesh.vertices)}\n"
    head += "".join(f"property {'float' if is_single else 'double'} {axis}\n" for axis in "xyz")
    head += f"element face {len(mesh.faces)}\nproperty list uchar int vertex_indices\nend_header\n"
    rows = np.empty(len(mesh.faces), [("count", "u1"), ("corners", "<i4", 3)])
    rows["count"], rows["corners"] = 3, mesh.faces
    path.write_bytes(head.encode() + mesh.vertices.astype("<f4" if is_single else "<f8").tobytes() + rows.tobytes())


def read_ply(path: Path) -> Mesh:
    """What `write_ply` has written. Programs write what their adapters make of it."""
    data = path.read_bytes()
    head, body = data.split(b"end_header\n", 1)
    counts = [int(line.split()[2]) for line in head.splitlines() if line.startswith(b"element")]
    number = np.dtype("<f4" if b"property float x" in head else "<f8")
    vertices = np.frombuffer(body, number, 3 * counts[0]).reshape(-1, 3)
    rows = np.frombuffer(body[3 * number.itemsize * counts[0] :], np.dtype([("count", "u1"), ("corners", "<i4", 3)]), counts[1])
    return Mesh(vertices.astype(float), rows["corners"].astype(np.int64))


def half_edges(faces: Faces) -> Faces:
    """All directed edges of the triangles, (3 m, 2)."""
    return faces[:, [0, 1, 1, 2, 2, 0]].reshape(-1, 2)


def boundary_edges(faces: Faces) -> Faces:
    """The directed edges whose opposite no triangle has."""
    edges = half_edges(faces)
    top = np.int64(faces.max() + 1) if len(faces) else np.int64(1)
    there, back = edges[:, 0] * top + edges[:, 1], edges[:, 1] * top + edges[:, 0]
    return edges[~np.isin(there, back)]


def loops(faces: Faces) -> list[NDArray[np.int64]]:
    """The boundary's loops, each by its vertices in the order of its triangles' edges. Vertices on two loops end both."""
    follows: dict[int, int] = {int(a): int(b) for a, b in boundary_edges(faces)}
    found = []
    while follows:
        start = next(iter(follows))
        loop = [start]
        while (following := follows.pop(loop[-1], None)) is not None and following != start:
            loop.append(following)
        found.append(np.array(loop))
    return found


def rings(faces: Faces, start: Mask, count: int) -> Mask:
    """The triangles within so many rings of vertices around marked triangles."""
    marked = start.copy()
    for _ in range(count):
        touched = np.zeros(faces.max() + 1, bool)
        touched[faces[marked]] = True
        marked |= touched[faces].any(axis=1)
    return marked
