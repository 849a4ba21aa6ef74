"""Mean curvature at the boundary of what is new, from one side and from the other."""

from __future__ import annotations

import numpy as np

from .meshes import Mask, Mesh, Points, rings

#: Rings of triangles that a fit takes. Where there is no jump, on the truths of 16 exact surfaces, .03 over the hole's width is measured, half of them
#: less; with 3 rings .04, with 4 .05. One ring has too few vertices.
RINGS = 2
#: A quadric through a point has five numbers; fits to fewer than so many points are none.
POINTS = 8


def jump(mesh: Mesh, new: Mask) -> float:
    """The difference of mean curvature at vertices between new triangles and old ones, root mean square, in one over a length; NaN where there are too
    few vertices for fits.
    """
    is_rim = np.zeros(len(mesh.vertices), bool)
    is_rim[np.intersect1d(mesh.faces[new], mesh.faces[~new])] = True
    rim = np.flatnonzero(is_rim)
    around = rings(mesh.faces, is_rim[mesh.faces].any(axis=1), RINGS)
    near, side = Mesh(mesh.vertices, mesh.faces[around]), new[around]
    normals = np.zeros((len(mesh.vertices), 3))
    for k in range(3):
        np.add.at(normals, near.faces[:, k], near.normals())
    differences = np.array([_mean_curvature(near, side, v, normals[v]) - _mean_curvature(near, ~side, v, normals[v]) for v in rim])
    known = np.isfinite(differences)
    return float(np.sqrt((differences[known] ** 2).mean())) if 2 * known.sum() > len(rim) > 0 else float("nan")


def _mean_curvature(mesh: Mesh, side: Mask, vertex: int, normal: Points) -> float:
    """Of a quadric through the vertex, fitted to the vertices of rings of triangles on one side, least squares by the inverse distance."""
    at = side & (mesh.faces == vertex).any(axis=1)
    local = np.flatnonzero(side)
    around = rings(mesh.faces[local], at[local], RINGS - 1) if at.any() else at[local]
    points = mesh.vertices[np.setdiff1d(mesh.faces[local][around], [vertex])] - mesh.vertices[vertex]
    length = np.linalg.norm(normal)
    if len(points) < POINTS or length == 0:
        return float("nan")
    third = normal / length
    first = np.cross(third, np.eye(3)[np.abs(third).argmin()])
    first /= np.linalg.norm(first)
    x, y, z = points @ first, points @ np.cross(third, first), points @ third
    weights = 1 / np.maximum(np.hypot(x, y), 1e-12)
    columns = np.column_stack([x * x / 2, x * y, y * y / 2, x, y])
    (a, b, c, d, e), _, rank, _ = np.linalg.lstsq(columns * weights[:, None], z * weights, rcond=1e-8)
    if rank < 5:
        return float("nan")
    return float(((1 + e * e) * a - 2 * d * e * b + (1 + d * d) * c) / (2 * (1 + d * d + e * e) ** 1.5))
