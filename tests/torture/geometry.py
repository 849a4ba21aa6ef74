"""What a checker needs of a triangle mesh, on arrays."""

from __future__ import annotations

import numpy as np


def cross_products(x: np.ndarray, triangles: np.ndarray) -> np.ndarray:
    p = x[triangles]
    return np.cross(p[:, 1] - p[:, 0], p[:, 2] - p[:, 0])


def unit(v: np.ndarray) -> np.ndarray:
    # Scaled first: squares of tiny cross products would vanish.
    top = np.abs(v).max(axis=-1, keepdims=True)
    v = v / np.where(top > 0, top, 1)
    length = np.linalg.norm(v, axis=-1, keepdims=True)
    return v / np.where(length > 0, length, 1)


def angle_between(a: np.ndarray, b: np.ndarray) -> np.ndarray:
    """In degrees; accurate near 0 and 180. Where one is zero there is no angle: 0."""
    a, b = unit(a), unit(b)
    degrees = np.degrees(2 * np.arctan2(np.linalg.norm(a - b, axis=-1), np.linalg.norm(a + b, axis=-1)))
    return np.where((a != 0).any(-1) & (b != 0).any(-1), degrees, 0.0)


def smallest_angles(x: np.ndarray, triangles: np.ndarray) -> np.ndarray:
    """The smallest angle of every triangle in degrees; 0 where two corners coincide."""
    if len(triangles) == 0:
        return np.zeros(0)
    p = x[triangles]
    angles = []
    for k in range(3):
        a, b = p[:, (k + 1) % 3] - p[:, k], p[:, (k + 2) % 3] - p[:, k]
        angles.append(angle_between(a, b))
    return np.min(angles, axis=0)


def half_edges(triangles: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Directed edges (start, end) and the triangle that each is of."""
    edges = triangles[:, [0, 1, 1, 2, 2, 0]].reshape(-1, 2)
    return edges, np.repeat(np.arange(len(triangles)), 3)


def undirected(edges: np.ndarray) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Different edges, to which of them each belongs, and how many share it."""
    ends = np.sort(edges, axis=1)
    key = ends[:, 0] * (int(ends.max(initial=0)) + 1) + ends[:, 1]
    _, first, inverse, counts = np.unique(key, return_index=True, return_inverse=True, return_counts=True)
    return ends[first], inverse, counts


def irregular_vertices(triangles: np.ndarray) -> np.ndarray:
    """Vertices at edges that do not have exactly two triangles of coherent orientation."""
    edges, _ = half_edges(triangles)
    ends, inverse, counts = undirected(edges)
    forward = np.bincount(inverse, weights=edges[:, 0] < edges[:, 1])
    bad = (counts != 2) | (forward != 1)
    return np.unique(ends[bad])


def folds(x: np.ndarray, triangles: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Inner edges, and the angle between the normals of their two triangles."""
    edges, owner = half_edges(triangles)
    ends, inverse, counts = undirected(edges)
    order = np.argsort(inverse, kind="stable")
    starts = np.concatenate([[0], np.cumsum(counts)])[:-1]
    inner = counts == 2
    first = owner[order[starts[inner]]]
    second = owner[order[starts[inner] + 1]]
    normals = cross_products(x, triangles)
    return ends[inner], angle_between(normals[first], normals[second])


def vertex_sums(x: np.ndarray, triangles: np.ndarray) -> np.ndarray:
    """Per vertex the sum of the cross products of these triangles."""
    sums = np.zeros_like(x)
    normals = cross_products(x, triangles)
    for k in range(3):
        np.add.at(sums, triangles[:, k], normals)
    return sums


def kinks(x: np.ndarray, inside: np.ndarray, outside: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Vertices between `inside` and `outside` triangles, and the angle in degrees between both sides' normals."""
    shared = np.intersect1d(np.unique(inside), np.unique(outside))
    a, b = vertex_sums(x, inside), vertex_sums(x, outside)
    return shared, angle_between(a[shared], b[shared])


def without_islands(inside: np.ndarray, outside: np.ndarray, most: int = 6) -> np.ndarray:
    """The `outside` triangles that are not of islands: up to `most` vertices among the `inside` triangles."""
    shared = set(np.intersect1d(np.unique(inside), np.unique(outside)).tolist())
    near = outside[np.isin(outside, list(shared)).any(1)]
    of: dict[int, list] = {}
    for corners in near.tolist():
        for v in corners:
            of.setdefault(v, []).append(corners)
    islands: set[int] = set()
    for v in shared - islands:
        found, front = {v}, [v]
        while front and len(found) <= most and found <= shared:
            front = [w for u in front for corners in of[u] for w in corners if w not in found]
            found.update(front)
        if len(found) <= most and found <= shared:
            islands |= found
    return outside[~np.isin(outside, list(islands)).any(1)] if islands else outside
