"""What type checkers are to find out: mypy reads this, nobody runs it."""

from __future__ import annotations

import numpy as np
import open3d
import pyvista
import trimesh
from numpy.typing import NDArray
from typing_extensions import assert_type

import fairmesh

mesh = trimesh.Trimesh()
points = pyvista.PolyData()
vertices: NDArray[np.float64] = np.empty((0, 3))
faces: NDArray[np.int64] = np.empty((0, 3), np.int64)
mask: NDArray[np.bool_] = np.empty(0, bool)

assert_type(fairmesh.fair(mesh, mask).mesh, trimesh.Trimesh)
assert_type(fairmesh.fair(mesh, free_faces=mask, tolerance=1e-6, target="harmonic").mesh, trimesh.Trimesh)
assert_type(fairmesh.fair(points, "mask").mesh, pyvista.PolyData)
assert_type(fairmesh.fill_holes(points, join="auto", density=2.0, threads=1).mesh, pyvista.PolyData)
assert_type(fairmesh.remesh(mesh, mask, density=2.0).mesh, trimesh.Trimesh)
assert_type(fairmesh.erase(mesh, mask).mesh, trimesh.Trimesh)
assert_type(fairmesh.bridge(mesh, [1, 2], [3, 4], fill=True).mesh, trimesh.Trimesh)
assert_type(fairmesh.Solver(mesh, mask).result().mesh, trimesh.Trimesh)
assert_type(fairmesh.fair(vertices, faces, mask).outcome, fairmesh.Outcome)
new_vertices, _ = fairmesh.fair(vertices, faces, mask).mesh
assert_type(new_vertices.ndim, int)
fairmesh.fair(open3d.geometry.TriangleMesh(), mask)
assert_type(fairmesh.mean_curvature(mesh), NDArray[np.float64])
assert_type(fairmesh.grow(mesh, fairmesh.select_ball(points, (0, 0, 1), 0.3) & ~mask, 2), NDArray[np.bool_])
assert_type(fairmesh.select_patch(vertices, faces, 0), NDArray[np.bool_])

# Each of these is an error, or mypy says that the comment is of no use.
fairmesh.fair(mesh, tolerence=1e-6)  # type: ignore[call-overload]
fairmesh.fair(mesh, inner_fairness="unifrom")  # type: ignore[call-overload]
fairmesh.fill_holes(vertices)  # type: ignore[call-overload]
