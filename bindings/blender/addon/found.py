# SPDX-License-Identifier: GPL-3.0-or-later
"""What the last run has said, the vertices and faces that it named, and the operator that selects them."""

import bmesh
import bpy

_last = None
#: What was said, [(whether it is good news, text)], and of which objects.
_said = []
_named = frozenset()


class Found:
    """Elements of an object's mesh: `vertices` and `faces` are indices, `counts` those of the mesh that they are of."""

    def __init__(self, obj, counts, what, vertices=(), faces=()):
        self.name = obj.name
        self.counts = counts
        self.what = what
        self.vertices = [int(v) for v in vertices]
        self.faces = [int(f) for f in faces]


def remember(found):
    """What the sidebar offers to select; None: nothing."""
    global _last
    _last = found


def last(context):
    """What the last run found, if it belongs to an object that is in Edit mode."""
    if _last is None:
        return None
    for obj in context.objects_in_mode_unique_data:
        if obj.name == _last.name and obj.mode == "EDIT":
            return _last
    return None


def begin():
    """A run begins: nothing is said or found yet."""
    remember(None)
    _said.clear()


def say(context, kind, text):
    """What the sidebar shows of the last run; `kind` as an operator reports."""
    global _named
    _said.append((kind == {"INFO"}, text))
    _named = frozenset(obj.name for obj in context.objects_in_mode)
    for area in context.screen.areas if context.screen else ():
        area.tag_redraw()


def said(context):
    """What the last run has said, if it was of an object that is edited now."""
    return _said if context.mode == "EDIT_MESH" and context.edit_object.name in _named else []


class MESH_OT_fairmesh_select_found(bpy.types.Operator):
    """Select the vertices or faces that the last run of Fairmesh named"""

    bl_idname = "mesh.fairmesh_select_found"
    bl_label = "Select Named Elements"
    bl_options = {"REGISTER", "UNDO"}

    @classmethod
    def poll(cls, context):
        return context.mode == "EDIT_MESH" and last(context) is not None

    def execute(self, context):
        found = last(context)
        mesh = bpy.data.objects[found.name].data
        edit_mesh = bmesh.from_edit_mesh(mesh)
        if (len(edit_mesh.verts), len(edit_mesh.edges), len(edit_mesh.faces)) != found.counts:
            self.report({"ERROR"}, "The mesh was changed since: its elements have other numbers now. Run it again")
            return {"CANCELLED"}
        bpy.ops.mesh.select_all(action="DESELECT")
        # Vertices cannot be shown in the face mode.
        context.tool_settings.mesh_select_mode = (bool(found.vertices), False, not found.vertices)
        edit_mesh.verts.ensure_lookup_table()
        edit_mesh.faces.ensure_lookup_table()
        for chosen in [edit_mesh.verts[v] for v in found.vertices] + [edit_mesh.faces[f] for f in found.faces]:
            chosen.hide_set(False)
            chosen.select_set(True)
        edit_mesh.select_flush_mode()
        bmesh.update_edit_mesh(mesh, loop_triangles=False, destructive=False)
        return {"FINISHED"}


def register():
    bpy.utils.register_class(MESH_OT_fairmesh_select_found)


def unregister():
    bpy.utils.unregister_class(MESH_OT_fairmesh_select_found)
    begin()
