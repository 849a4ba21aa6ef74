"""MeshLab's own filters: Close Holes with refinement to the edges around, of the hole whose faces are selected; Taubin smoothing of a selection."""

from importlib.metadata import version

import numpy as np
import pymeshlab

from fairbench.adapter import Answer, RefusedError, Task, main
from fairbench.meshes import boundary_edges


def closed(meshes: pymeshlab.MeshSet, task: Task) -> None:
    """Closes the hole that has an edge of a selected face."""
    rim = boundary_edges(task.faces)
    rim = rim[np.isin(rim, task.told["hole"]).all(axis=1)]
    length = float(np.linalg.norm(task.vertices[rim[:, 0]] - task.vertices[rim[:, 1]], axis=1).mean())
    at_rim = (np.isin(task.faces, task.told["hole"]).sum(axis=1) > 1).astype(float)
    meshes.add_mesh(pymeshlab.Mesh(task.vertices, task.faces, f_scalar_array=at_rim))
    meshes.compute_selection_by_condition_per_face(condselect="fq > 0.5")
    edge = pymeshlab.PureValue(length)
    meshes.meshing_close_holes(maxholesize=1_000_000, selected=True, selfintersection=False, refinehole=True, refineholeedgelen=edge)


def run(task: Task) -> Answer:
    meshes = pymeshlab.MeshSet(verbose=False)
    if task.kind == "fill":
        closed(meshes, task)
    elif task.kind == "fair":
        # Vertices whose faces are all selected are smoothed.
        at_free = np.isin(task.faces, task.told["free"]).any(axis=1).astype(float)
        meshes.add_mesh(pymeshlab.Mesh(task.vertices, task.faces, f_scalar_array=at_free))
        meshes.compute_selection_by_condition_per_face(condselect="fq > 0.5")
        meshes.apply_coord_taubin_smoothing(stepsmoothnum=30, selected=True)
    else:
        raise RefusedError("not one of its tasks")
    made = meshes.current_mesh()
    return Answer(made.vertex_matrix(), made.face_matrix())


main(run, version("pymeshlab"))
