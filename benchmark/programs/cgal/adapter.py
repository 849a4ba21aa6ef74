"""CGAL's triangulate_refine_and_fair_hole and fair, through its Python package."""

from importlib.metadata import version

import numpy as np
from CGAL import CGAL_Polygon_mesh_processing as pmp
from CGAL.CGAL_Polyhedron_3 import Polyhedron_3

from fairbench.adapter import Answer, RefusedError, Task, main


def polyhedron(task: Task) -> Polyhedron_3:
    """Through a file: the package has no way for arrays."""
    path = task.scratch / "mesh.off"
    lines = [f"OFF\n{len(task.vertices)} {len(task.faces)} 0"]
    lines += [" ".join(map(repr, map(float, p))) for p in task.vertices]
    lines += [f"3 {a} {b} {c}" for a, b, c in task.faces]
    path.write_text("\n".join(lines) + "\n")
    made = Polyhedron_3(str(path))
    if made.size_of_vertices() != len(task.vertices):
        raise RefusedError("the mesh is no polyhedron")
    return made


def arrays(made: Polyhedron_3) -> Answer:
    """Its vertices, the old ones first, and its faces."""
    for number, vertex in enumerate(made.vertices()):
        vertex.set_id(number)
    vertices = np.array([(p.x(), p.y(), p.z()) for p in made.points()])
    faces = []
    for facet in made.facets():
        first = at = facet.halfedge()
        corners = []
        while True:
            corners.append(at.vertex().id())
            at = at.next()
            if at == first:
                break
        faces.append(corners)
    return Answer(vertices, np.array(faces))


def run(task: Task) -> Answer:
    made = polyhedron(task)
    is_closed = True
    if task.kind == "fill":
        open_edges = [edge for edge in made.halfedges() if edge.is_border()]
        while open_edges:
            edge = open_edges[0]
            new_faces, new_vertices = [], []
            is_closed = pmp.triangulate_refine_and_fair_hole(made, edge, new_faces, new_vertices) is not False and is_closed
            left = [edge for edge in made.halfedges() if edge.is_border()]
            if len(left) >= len(open_edges):
                break
            open_edges = left
    elif task.kind == "fair":
        free = set(task.told["free"])
        handles = [vertex for number, vertex in enumerate(made.vertices()) if number in free]
        is_closed = pmp.fair(made, handles) is not False
    else:
        raise RefusedError("not one of its tasks")
    answer = arrays(made)
    return answer._replace(success=is_closed, words="fair" if is_closed else "not fair")


main(run, version("cgal"))
