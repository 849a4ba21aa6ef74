#!/usr/bin/env python3
"""One fair and one fill on a sphere, by the plugin in PyMeshLab: use_pymeshlab.py PLUGIN"""

import sys

import numpy as np
import pymeshlab

pymeshlab.load_plugin(sys.argv[1])


def sphere(condition):
    """Of radius 1, with the faces selected where the condition holds."""
    meshes = pymeshlab.MeshSet(verbose=False)
    meshes.create_sphere(radius=1.0, subdiv=4)
    meshes.compute_selection_by_condition_per_face(condselect=condition)
    return meshes


def radial_error(meshes):
    """The largest distance from the unit sphere."""
    return np.abs(np.linalg.norm(meshes.current_mesh().vertex_matrix(), axis=1) - 1).max()


CAP = "(z0+z1+z2)/3 > 0.8"
dented = sphere(CAP)
dented.compute_coord_by_function(x="x", y="y", z="z>0.9 ? z-0.1 : z")
assert radial_error(dented) > 0.05
assert dented.apply_filter("apply_coord_fairing_to_selection")["converged"]
assert radial_error(dented) < 1e-5, radial_error(dented)

opened = sphere(CAP)
opened.meshing_remove_selected_faces()
opened.meshing_remove_unreferenced_vertices()
opened.apply_filter("meshing_close_holes_and_fair")
assert opened.get_topological_measures()["boundary_edges"] == 0
assert radial_error(opened) < 1e-5, radial_error(opened)
print("MeshLab", sys.argv[1])
