"""Angles of triangles and edges."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from .meshes import Faces, Mesh, half_edges


def smallest_angles(mesh: Mesh) -> NDArray[np.float64]:
    """Of each triangle, in degrees."""
    edges = np.roll(mesh.corners(), -1, axis=1) - mesh.corners()
    after = np.roll(edges, -1, axis=1)
    sines = np.linalg.norm(np.cross(edges, after), axis=2)
    return np.degrees(np.arctan2(sines, -(edges * after).sum(axis=2))).min(axis=1)


def inner_edges(faces: Faces) -> tuple[NDArray[np.int64], NDArray[np.int64], NDArray[np.int64]]:
    """Edges with two triangles that run along them in both directions: vertices (k, 2), and both triangles."""
    edges = half_edges(faces)
    top = np.int64(faces.max() + 1)
    there, back = edges[:, 0] * top + edges[:, 1], edges[:, 1] * top + edges[:, 0]
    order = np.argsort(there, kind="stable")
    at = np.clip(np.searchsorted(there[order], back), 0, len(order) - 1)
    other = order[at]
    is_pair = (there[other] == back) & (edges[:, 0] < edges[:, 1])
    mine = np.arange(len(edges)) // 3
    return edges[is_pair], mine[is_pair], (other // 3)[is_pair]


def edge_angles(mesh: Mesh) -> tuple[NDArray[np.int64], NDArray[np.int64], NDArray[np.float64]]:
    """The two triangles of each inner edge, and by how many degrees they turn there."""
    _, first, second = inner_edges(mesh.faces)
    n = mesh.normals()
    sines = np.linalg.norm(np.cross(n[first], n[second]), axis=1)
    return first, second, np.degrees(np.arctan2(sines, (n[first] * n[second]).sum(axis=1)))
