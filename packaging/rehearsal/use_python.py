#!/usr/bin/env python3
"""One fair and one fill on a sphere, by the Python package that is installed."""

import fairmesh
import numpy as np
import trimesh


def radial_error(vertices):
    """The largest distance from the unit sphere."""
    return np.abs(np.linalg.norm(vertices, axis=1) - 1).max()


mesh = trimesh.creation.icosphere(subdivisions=4)
cap = mesh.vertices[:, 2] > 0.8
dented = mesh.copy()
dented.vertices[cap] *= 0.9
faired = fairmesh.fair(dented, cap)
assert str(faired.outcome) == "converged" and radial_error(faired.mesh.vertices) < 1e-5, faired.outcome

inside = mesh.triangles_center[:, 2] > 0.8
mesh.update_faces(~inside)
mesh.remove_unreferenced_vertices()
filled = fairmesh.fill_holes(mesh)
assert filled.mesh.is_watertight and radial_error(filled.mesh.vertices) < 1e-5, filled.patches
print("Python", fairmesh.load().path)
