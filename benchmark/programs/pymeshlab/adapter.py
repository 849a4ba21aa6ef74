"""MeshLab's own filters: Close Holes with refinement; Laplacian smoothing of a selection."""

from importlib.metadata import version

import numpy as np
import pymeshlab

from fairbench.adapter import Answer, RefusedError, Task, main


def run(task: Task) -> Answer:
    meshes = pymeshlab.MeshSet(verbose=False)
    if task.kind == "fill":
        meshes.add_mesh(pymeshlab.Mesh(task.vertices, task.faces))
        meshes.meshing_close_holes(maxholesize=1_000_000, newfaceselected=True, selfintersection=False, refinehole=True)
    elif task.kind == "fair":
        free = np.zeros(len(task.vertices))
        free[task.told["free"]] = 1
        meshes.add_mesh(pymeshlab.Mesh(task.vertices, task.faces, v_scalar_array=free))
        meshes.compute_selection_by_condition_per_vertex(condselect="q > 0.5")
        meshes.apply_coord_laplacian_smoothing(stepsmoothnum=100, cotangentweight=True, selected=True)
    else:
        raise RefusedError("not one of its tasks")
    made = meshes.current_mesh()
    return Answer(made.vertex_matrix(), made.face_matrix())


main(run, version("pymeshlab"))
