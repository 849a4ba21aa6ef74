"""Triangles that go through each other."""

from __future__ import annotations

import numpy as np
from scipy.spatial import cKDTree

from .meshes import Faces, Mask, Mesh, Points
from .shape import smallest_angles

#: Triangles with an angle below this, in degrees, have no area to speak of: what crosses them is rounding. Of 2,000 results none changes at half or double.
FLAT = 0.01
#: An edge goes through a triangle where it meets it that far from its own ends and from the triangle's edges, in parts of their lengths: less is touching.
INSIDE = 1e-6


def crossings(mesh: Mesh, new: Mask) -> int:
    """How many new triangles an edge of another triangle goes through, or have an edge that goes through another. Triangles in one plane do not count."""
    first, second = _near(mesh, new)
    hit = np.zeros(len(mesh.faces), bool)
    for some, others in ((first, second), (second, first)):
        for k in range(3):
            goes = _goes_through(mesh.vertices, mesh.faces[some][:, [k, (k + 1) % 3]], mesh.faces[others])
            hit[some[goes]] = hit[others[goes]] = True
    return int((hit & new).sum())


def _near(mesh: Mesh, new: Mask) -> tuple[np.ndarray, np.ndarray]:
    """Pairs of triangles, one of them new, whose boxes overlap; not those without area."""
    corners = mesh.corners()
    low, high = corners.min(axis=1), corners.max(axis=1)
    at_new = ((low <= high[new].max(axis=0)) & (high >= low[new].min(axis=0))).all(axis=1)
    local = np.flatnonzero(at_new & (smallest_angles(mesh) > FLAT))
    middles, radii = (low + high)[local] / 2, np.linalg.norm(high - low, axis=1)[local] / 2
    # The larger one of a pair finds the other within twice its own reach.
    found = cKDTree(middles).query_ball_point(middles, 2 * radii)
    pairs = np.column_stack([np.repeat(local, [len(some) for some in found]), local[np.concatenate(found).astype(np.int64)]])
    pairs = np.unique(np.sort(pairs[pairs[:, 0] != pairs[:, 1]], axis=1), axis=0)
    first, second = pairs[(new[pairs]).any(axis=1)].T
    overlap = ((low[first] <= high[second]) & (low[second] <= high[first])).all(axis=1)
    return first[overlap], second[overlap]


def _goes_through(points: Points, edges: Faces, triangles: Faces) -> Mask:
    """Whether each edge goes through the triangle of its row; not where they have a vertex in common."""
    apart = ~(edges[:, :, None] == triangles[:, None, :]).any(axis=(1, 2))
    p, q = points[edges[:, 0]], points[edges[:, 1]]
    a, u, v = points[triangles[:, 0]], points[triangles[:, 1]] - points[triangles[:, 0]], points[triangles[:, 2]] - points[triangles[:, 0]]
    way = q - p
    across = np.cross(way, v)
    det = (u * across).sum(axis=1)
    parallel = np.abs(det) <= 1e-12 * np.linalg.norm(way, axis=1) * np.linalg.norm(u, axis=1) * np.linalg.norm(v, axis=1)
    safe = np.where(parallel, 1, det)
    back = np.cross(p - a, u)
    s, t, along = ((p - a) * across).sum(axis=1) / safe, (way * back).sum(axis=1) / safe, (v * back).sum(axis=1) / safe
    inside = (s > INSIDE) & (t > INSIDE) & (s + t < 1 - INSIDE) & (along > INSIDE) & (along < 1 - INSIDE)
    return apart & inside & ~parallel
