"""CGAL's triangulate_refine_and_fair_hole and fair, through its Python package."""

from importlib.metadata import version

import numpy as np
from CGAL import CGAL_Polygon_mesh_processing as pmp
from CGAL.CGAL_Polyhedron_3 import Polyhedron_3

from fairbench.adapter import Answer, RefusedError, Task, main
from programs.compiled import write_off


def polyhedron(task: Task) -> Polyhedron_3:
    """Through a file: the package has no way for arrays."""
    path = task.scratch / "mesh.off"
    write_off(path, task.vertices, task.faces)
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
    if task.kind == "fill":
        for number, vertex in enumerate(made.vertices()):
            vertex.set_id(number)
        hole = set(task.told["hole"])
        edge = next(each for each in made.halfedges() if each.is_border() and each.vertex().id() in hole)
        is_closed = pmp.triangulate_refine_and_fair_hole(made, edge, [], []) is not False
    elif task.kind == "fair":
        free = set(task.told["free"])
        handles = [vertex for number, vertex in enumerate(made.vertices()) if number in free]
        is_closed = pmp.fair(made, handles) is not False
    else:
        raise RefusedError("not one of its tasks")
    answer = arrays(made)
    return answer._replace(success=is_closed, words="fair" if is_closed else "not fair")


main(run, version("cgal"))
