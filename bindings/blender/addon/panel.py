# SPDX-License-Identifier: GPL-3.0-or-later
"""The tab Fairmesh of the sidebar."""

import bpy

from . import found
from .bridge_operator import MESH_OT_fairmesh_bridge
from .curvature_operator import MESH_OT_fairmesh_show_curvature
from .erase_operator import MESH_OT_fairmesh_erase_and_fill
from .fair_operator import MESH_OT_fairmesh_fair
from .fill_operator import MESH_OT_fairmesh_fill_holes
from .join_operator import MESH_OT_fairmesh_join_loops

_OPERATORS = (
    (MESH_OT_fairmesh_fair, "MOD_SMOOTH"),
    (MESH_OT_fairmesh_erase_and_fill, "BRUSH_DATA"),
    (MESH_OT_fairmesh_join_loops, "AUTOMERGE_ON"),
    (MESH_OT_fairmesh_bridge, "MOD_SKIN"),
    (MESH_OT_fairmesh_fill_holes, "MESH_DATA"),
)


class _Sidebar:
    bl_space_type = "VIEW_3D"
    bl_region_type = "UI"
    bl_category = "Fairmesh"


class VIEW3D_PT_fairmesh(_Sidebar, bpy.types.Panel):
    bl_label = "Fairmesh"

    @classmethod
    def poll(cls, context):
        return context.mode in {"EDIT_MESH", "OBJECT"} and context.object is not None and context.object.type == "MESH"

    def draw(self, context):
        column = self.layout.column()
        settings = context.scene.fairmesh
        for operator, icon in _OPERATORS:
            settings.hand_to(column.operator(operator.bl_idname, icon=icon))
        fill_all = column.operator(MESH_OT_fairmesh_fill_holes.bl_idname, text="Fill All Holes", icon="MESH_DATA")
        settings.hand_to(fill_all)
        fill_all.scope = "ALL"
        column.operator(MESH_OT_fairmesh_show_curvature.bl_idname, icon="COLOR")
        if context.mode != "EDIT_MESH":
            column.label(text="Fairing and filling: in Edit mode")
        last = found.last(context) if context.mode == "EDIT_MESH" else None
        if last is not None:
            column.separator()
            column.label(text=f"Last run: {last.what}")
            column.operator("mesh.fairmesh_select_found", icon="RESTRICT_SELECT_OFF")


class VIEW3D_PT_fairmesh_options(_Sidebar, bpy.types.Panel):
    bl_label = "Options"
    bl_parent_id = "VIEW3D_PT_fairmesh"
    bl_options = {"DEFAULT_CLOSED"}

    def draw(self, context):
        layout = self.layout
        layout.use_property_split = True
        context.scene.fairmesh.draw_fairing(layout)


_CLASSES = (VIEW3D_PT_fairmesh, VIEW3D_PT_fairmesh_options)


def register():
    for panel in _CLASSES:
        bpy.utils.register_class(panel)


def unregister():
    for panel in reversed(_CLASSES):
        bpy.utils.unregister_class(panel)
