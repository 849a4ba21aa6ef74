# SPDX-License-Identifier: GPL-3.0-or-later
"""What is selected, as far as it decides which of the operators can do anything: their buttons are grey otherwise.

Scripts are refused by numbers alone that Blender keeps. The sidebar, which is drawn again after every change, is told
more, which is found once for each change.
"""

from dataclasses import dataclass

import bmesh
import bpy
from bpy.app.handlers import persistent

# Larger meshes take too long to be looked through after every click; of these a run says what is missing. At 50,000 edges
# it takes 0.03 s.
_MOST_EDGES = 50_000
#: What marks buttons of the sidebar in their contexts.
SIDEBAR = "fairmesh_sidebar"

_known = {}


@dataclass
class Facts:
    """Of all objects in Edit mode together; of loops the most that one of them has."""

    #: Vertices that are selected, not on the boundary; and those all of whose faces are.
    free: bool = False
    inside: bool = False
    #: Whether there is a boundary; how many loops of it have a selected vertex.
    is_open: bool = False
    loops: int = 0
    #: Per object: by selected vertex, those at the other ends of its selected boundary edges.
    beside: tuple = ()


def vertices(context):
    """How many vertices are selected, of all objects in Edit mode."""
    return sum(obj.data.total_vert_sel for obj in context.objects_in_mode_unique_data)


def faces(context):
    """How many faces are selected, and how many there are, of each object in Edit mode."""
    meshes = [obj.data for obj in context.objects_in_mode_unique_data]
    return [(mesh.total_face_sel, len(bmesh.from_edit_mesh(mesh).faces)) for mesh in meshes]


def is_sidebar(context):
    """Whether a button of the sidebar asks."""
    return getattr(context, SIDEBAR, None) is not None


def facts(context):
    """The `Facts` for a button of the sidebar; None for anything else, and where it would take too long."""
    if not is_sidebar(context):
        return None
    meshes = [bmesh.from_edit_mesh(obj.data) for obj in context.objects_in_mode_unique_data]
    if sum(len(mesh.edges) for mesh in meshes) > _MOST_EDGES:
        return None
    key = tuple((obj.name, obj.data.total_vert_sel) for obj in context.objects_in_mode_unique_data)
    if key not in _known:
        _known.clear()
        _known[key] = _find(meshes)
    return _known[key]


def _find(meshes):
    found = Facts(beside=tuple(_beside(mesh) for mesh in meshes))
    for mesh in meshes:
        found.loops = max(found.loops, _loops(mesh))
        found.is_open = found.is_open or any(edge.is_boundary for edge in mesh.edges)
        for vertex in mesh.verts:
            if vertex.select and vertex.link_faces and not vertex.is_boundary:
                found.free = True
                found.inside = found.inside or all(face.select for face in vertex.link_faces)
            if found.inside:
                break
    return found


def _beside(mesh):
    made = {}
    for edge in mesh.edges:
        if edge.select and edge.is_boundary:
            a, b = (vertex.index for vertex in edge.verts)
            made.setdefault(a, []).append(b)
            made.setdefault(b, []).append(a)
    return made


def _loops(mesh):
    """How many boundary loops have a selected vertex; those that meet in a vertex are one."""
    count, seen = 0, set()
    for vertex in mesh.verts:
        if not vertex.select or not vertex.is_boundary or vertex in seen:
            continue
        count += 1
        front = [vertex]
        while front:
            here = front.pop()
            if here not in seen:
                seen.add(here)
                front += [edge.other_vert(here) for edge in here.link_edges if edge.is_boundary]
    return count


@persistent
def _forget(*_):
    _known.clear()


def register():
    bpy.app.handlers.depsgraph_update_post.append(_forget)


def unregister():
    bpy.app.handlers.depsgraph_update_post.remove(_forget)
    _known.clear()
