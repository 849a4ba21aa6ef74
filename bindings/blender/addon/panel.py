# SPDX-License-Identifier: GPL-3.0-or-later
"""The tab Fairmesh of the sidebar: the operators, and all of their options."""

import blf
import bpy

from . import curvature_operator, found, manual, presets, selected
from .bridge_operator import MESH_OT_fairmesh_bridge
from .erase_operator import MESH_OT_fairmesh_erase_and_fill
from .fair_operator import MESH_OT_fairmesh_fair
from .fill_operator import MESH_OT_fairmesh_fill_all_holes, MESH_OT_fairmesh_fill_holes
from .join_operator import MESH_OT_fairmesh_join_loops
from .live_operator import MESH_OT_fairmesh_live
from .round_operator import MESH_OT_fairmesh_round_edges

_OPERATORS = (
    (MESH_OT_fairmesh_fair, "MOD_SMOOTH"),
    (MESH_OT_fairmesh_live, "MOD_SIMPLEDEFORM"),
    (MESH_OT_fairmesh_erase_and_fill, "BRUSH_DATA"),
    (MESH_OT_fairmesh_join_loops, "AUTOMERGE_ON"),
    (MESH_OT_fairmesh_bridge, "MOD_SKIN"),
    (MESH_OT_fairmesh_fill_holes, "MESH_DATA"),
    (MESH_OT_fairmesh_fill_all_holes, "MESH_DATA"),
    (MESH_OT_fairmesh_round_edges, "MOD_BEVEL"),
)


# What is beside a line in a box of the sidebar, in pixels: the tabs, margins and an icon.
BESIDE = 90


class _Sidebar:
    bl_space_type = "VIEW_3D"
    bl_region_type = "UI"
    bl_category = "Fairmesh"


class VIEW3D_PT_fairmesh(_Sidebar, bpy.types.Panel):
    bl_label = "Fairmesh"

    @classmethod
    def poll(cls, context):
        return context.mode in {"EDIT_MESH", "OBJECT"} and context.object is not None and context.object.type == "MESH"

    def draw_header_preset(self, context):
        self.layout.operator("wm.url_open", text="", icon="HELP", emboss=False).url = manual.url()
        presets.FAIRMESH_PT_presets.draw_panel_header(self.layout)

    def draw(self, context):
        column = self.layout.column()
        settings = context.scene.fairmesh
        column.context_pointer_set(selected.SIDEBAR, settings)
        for operator, icon in _OPERATORS:
            settings.hand_to(column.operator(operator.bl_idname, icon=icon), operator)
        row = column.row(align=True)
        row.operator("mesh.fairmesh_show_curvature", icon="COLOR")
        if curvature_operator.is_shown(context):
            row.operator("mesh.fairmesh_hide_curvature", text="", icon="X")
        if found.said(context):
            _draw_said(column.box().column(align=True), context)


def _draw_said(column, context):
    """The whole of what the last run said, and what can be selected."""
    column.label(text="Last run")
    lines = column.column(align=True)
    lines.scale_y = 0.75
    for is_good, text in found.said(context):
        icon = "CHECKMARK" if is_good else "ERROR"
        for line in wrapped(text, context):
            lines.label(text=line, icon=icon)
            icon = "BLANK1"
    last = found.last(context)
    if last is not None:
        column.separator()
        column.label(text=last.what)
        column.operator("mesh.fairmesh_select_found", icon="RESTRICT_SELECT_OFF")


def wrapped(text, context):
    """The lines of a text in a box of the sidebar, beside an icon."""
    scale = context.preferences.system.ui_scale
    blf.size(0, scale * context.preferences.ui_styles[0].widget.points)
    room, lines = context.region.width - BESIDE * scale, [""]
    for word in text.split():
        longer = f"{lines[-1]} {word}".strip()
        if lines[-1] and blf.dimensions(0, longer)[0] > room:
            lines.append(word)
        else:
            lines[-1] = longer
    return lines


class _Options(_Sidebar):
    bl_parent_id = "VIEW3D_PT_fairmesh"
    bl_options = {"DEFAULT_CLOSED"}

    def draw(self, context):
        self.draw_options(self.layout.column(), context.scene.fairmesh)


class VIEW3D_PT_fairmesh_options(_Options, bpy.types.Panel):
    bl_label = "Surface"

    def draw_options(self, layout, settings):
        settings.draw_region(layout)
        settings.draw_fairing(layout)


class VIEW3D_PT_fairmesh_patches(_Options, bpy.types.Panel):
    bl_label = "New Faces"

    def draw_options(self, layout, settings):
        settings.draw_patch(layout)
        settings.draw_outer(layout)
        settings.draw_guides(layout)
        settings.draw_trim(layout)
        settings.draw_clean(layout)
        settings.draw_rim(layout)


class VIEW3D_PT_fairmesh_holes(_Options, bpy.types.Panel):
    bl_label = "Holes and Loops"

    def draw_options(self, layout, settings):
        layout.label(text="Fill All Holes")
        settings.draw_limits(layout)
        settings.draw_related(layout)
        settings.draw_groups(layout)
        settings.draw_bridge(layout)


class VIEW3D_PT_fairmesh_edges(_Options, bpy.types.Panel):
    bl_label = "Round Edges"

    def draw_options(self, layout, settings):
        settings.draw_round(layout)


_CLASSES = (
    VIEW3D_PT_fairmesh,
    VIEW3D_PT_fairmesh_options,
    VIEW3D_PT_fairmesh_patches,
    VIEW3D_PT_fairmesh_holes,
    VIEW3D_PT_fairmesh_edges,
)


def register():
    for panel in _CLASSES:
        bpy.utils.register_class(panel)


def unregister():
    for panel in reversed(_CLASSES):
        bpy.utils.unregister_class(panel)
