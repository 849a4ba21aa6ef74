"""MeshLib: fillHoleNicely and stitchHolesNicely with smoothed curvature, positionVertsSmoothly."""

from importlib.metadata import version

import numpy as np
from meshlib import mrmeshnumpy as mn
from meshlib import mrmeshpy as mm

from fairbench.adapter import Answer, RefusedError, Task, main


def settings(task: Task, made):
    made.smoothCurvature = True
    rim = np.array(task.told["hole"] if task.kind == "fill" else task.told["loops"])
    near = task.faces[np.isin(task.faces, rim).any(axis=1)]
    edges = task.vertices[near[:, [1, 2, 0]]] - task.vertices[near]
    made.subdivideSettings.maxEdgeLen = float(np.linalg.norm(edges, axis=2).mean())
    made.subdivideSettings.maxEdgeSplits = 1_000_000
    return made


def run(task: Task) -> Answer:
    mesh = mn.meshFromFacesVerts(task.faces.astype(np.int32), task.vertices)
    if task.kind == "fair":
        free = np.zeros(len(task.vertices), bool)
        free[task.told["free"]] = True
        mm.positionVertsSmoothly(mesh, mn.vertBitSetFromBools(free), mm.EdgeWeights.Cotan, mm.VertexMass.NeiArea)
        moved = np.where(free[:, None], mn.getNumpyVerts(mesh), task.vertices)
        return Answer(moved, task.faces)
    holes = list(mesh.topology.findHoleRepresentiveEdges())
    if task.kind == "fill":
        wanted = set(task.told["hole"])
        for edge in holes:
            if mesh.topology.org(edge).get() in wanted:
                mm.fillHoleNicely(mesh, edge, settings(task, mm.FillHoleNicelySettings()))
    elif task.kind == "join":
        ends = [next(edge for edge in holes if on_loop(mesh, edge, vertex)) for vertex in task.told["loops"]]
        mm.stitchHolesNicely(mesh, ends[0], ends[1], settings(task, mm.StitchHolesNicelySettings()))
    else:
        raise RefusedError("not one of its tasks")
    vertices = mn.getNumpyVerts(mesh).copy()
    vertices[: len(task.vertices)] = np.where(vertices[: len(task.vertices)] == task.vertices.astype(np.float32), task.vertices, vertices[: len(task.vertices)])
    return Answer(vertices, mn.getNumpyFaces(mesh.topology))


def on_loop(mesh, edge, vertex: int) -> bool:
    at = edge
    while True:
        if mesh.topology.org(at).get() == vertex:
            return True
        at = mesh.topology.prev(at.sym())
        if at == edge:
            return False


main(run, version("meshlib"))
