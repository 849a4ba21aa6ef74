"""trimesh.repair.fill_holes."""

from importlib.metadata import version

import trimesh

from fairbench.adapter import Answer, RefusedError, Task, main


def run(task: Task) -> Answer:
    if task.kind != "fill":
        raise RefusedError("not one of its tasks")
    mesh = trimesh.Trimesh(task.vertices, task.faces, process=False)
    is_closed = trimesh.repair.fill_holes(mesh, use_fan=True)
    return Answer(mesh.vertices, mesh.faces, bool(is_closed), "watertight" if is_closed else "not watertight")


main(run, version("trimesh"))
