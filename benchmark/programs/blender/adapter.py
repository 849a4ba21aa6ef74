"""Blender: Fill and Smooth, Bridge Edge Loops with a smooth profile, Fair Tangency of sculpting, Bevel."""

import bpy
import numpy as np

from fairbench.adapter import Answer, RefusedError, Task, main


def scene(task: Task):
    for old in list(bpy.data.objects):
        bpy.data.objects.remove(old)
    mesh = bpy.data.meshes.new("mesh")
    mesh.from_pydata(task.vertices.tolist(), [], task.faces.tolist())
    made = bpy.data.objects.new("mesh", mesh)
    bpy.context.collection.objects.link(made)
    bpy.context.view_layer.objects.active = made
    made.select_set(True)
    return made


def edited(made, select, work) -> None:
    """Selects edges in edit mode, and works on them."""
    import bmesh  # is there when bpy has been imported

    bpy.ops.object.mode_set(mode="EDIT")
    bpy.ops.mesh.select_mode(type="EDGE")
    bpy.ops.mesh.select_all(action="DESELECT")
    shape = bmesh.from_edit_mesh(made.data)
    shape.edges.ensure_lookup_table()
    for edge in shape.edges:
        edge.select_set(bool(select(edge)))
    bmesh.update_edit_mesh(made.data)
    work()
    bpy.ops.object.mode_set(mode="OBJECT")


def at_boundary(vertices: set[int]):
    """Whether an edge is one of the loops through these vertices."""
    return lambda edge: edge.is_boundary and all(v.index in vertices for v in edge.verts)


def arrays(made) -> Answer:
    mesh = made.data
    mesh.calc_loop_triangles()
    vertices = np.empty(3 * len(mesh.vertices))
    mesh.vertices.foreach_get("co", vertices)
    faces = np.empty(3 * len(mesh.loop_triangles), np.int32)
    mesh.loop_triangles.foreach_get("vertices", faces)
    return Answer(vertices.reshape(-1, 3), faces.reshape(-1, 3))


def loop_of(task: Task, vertex: int) -> set[int]:
    from fairbench.meshes import loops

    return next(set(map(int, loop)) for loop in loops(task.faces) if vertex in loop)


def exactly(task: Task, answer: Answer) -> Answer:
    """Blender keeps single precision: old vertices that only lost digits are put back."""
    vertices = answer.vertices.copy()
    count = len(task.vertices)
    same = (vertices[:count] == task.vertices.astype(np.float32)).all(axis=1)
    vertices[:count][same] = task.vertices[same]
    return answer._replace(vertices=vertices)


def run(task: Task) -> Answer:
    made = scene(task)
    if task.kind == "fill":
        edited(made, at_boundary(set(task.told["hole"])), lambda: bpy.ops.mesh.fill(use_beauty=True))
    elif task.kind == "join":
        ends = set().union(*(loop_of(task, vertex) for vertex in task.told["loops"]))
        edited(made, at_boundary(ends), lambda: bpy.ops.mesh.bridge_edge_loops(number_cuts=8, interpolation="SURFACE"))
    elif task.kind == "round":
        ends = set(task.told["edge"])
        is_sharp = lambda edge: all(v.index in ends for v in edge.verts)  # noqa: E731
        edited(made, is_sharp, lambda: bpy.ops.mesh.bevel(offset=task.told["radius"], segments=16, profile=0.5, clamp_overlap=False))
    elif task.kind == "fair":
        sculpted(made, task)
    else:
        raise RefusedError("not one of its tasks")
    return exactly(task, arrays(made))


def sculpted(made, task: Task) -> None:
    """Fair Tangency of the faces whose vertices are free; it wants a view."""
    free = np.zeros(len(task.vertices), bool)
    free[task.told["free"]] = True
    sets = made.data.attributes.new(".sculpt_face_set", "INT", "FACE")
    sets.data.foreach_set("value", np.where(free[task.faces].any(axis=1), 2, 1).astype(np.int32))
    window = bpy.context.window_manager.windows[0]
    area = next(each for each in window.screen.areas if each.type == "VIEW_3D")
    region = next(each for each in area.regions if each.type == "WINDOW")
    with bpy.context.temp_override(window=window, area=area, region=region):
        bpy.ops.object.mode_set(mode="SCULPT")
        bpy.ops.ed.undo_push(message="before")
        bpy.ops.sculpt.face_set_edit("EXEC_DEFAULT", active_face_set=2, mode="FAIR_TANGENCY", strength=1.0)
        bpy.ops.object.mode_set(mode="OBJECT")


main(run, bpy.app.version_string)
