# SPDX-License-Identifier: GPL-3.0-or-later
"""Fair Live in the tool bar of Edit mode, with a handle on every boundary loop of what is selected."""

from pathlib import Path

import bpy
from mathutils import Matrix, Vector

from . import live_loops, live_operator, region, snapshot

# Larger meshes take too long to be read after every click; there dragging beside a loop begins as well.
_MOST_READ = 200_000
_MOST_HANDLES = 24


class VIEW3D_GGT_fairmesh_live(bpy.types.GizmoGroup):
    """An arrow at each loop, along its normal; dragging it begins Fair Live there."""

    bl_label = "Fair Live"
    bl_space_type = "VIEW_3D"
    bl_region_type = "WINDOW"
    bl_options = {"3D", "SELECT", "PERSISTENT"}

    @classmethod
    def poll(cls, context):
        if context.mode != "EDIT_MESH" or live_operator.is_running():
            return False
        return live_operator.is_tool(context)

    def setup(self, context):
        self._made = []
        self.refresh(context)

    def refresh(self, context):
        handles = _handles(context)
        while len(self._made) < len(handles):
            self._made.append(self._arrow())
        for number, (arrow, properties) in enumerate(self._made):
            arrow.hide = number >= len(handles)
            if not arrow.hide:
                vertex, matrix = handles[number]
                properties.vertex = vertex
                arrow.matrix_basis = matrix

    def _arrow(self):
        arrow = self.gizmos.new("GIZMO_GT_arrow_3d")
        arrow.draw_style = "NORMAL"
        arrow.color, arrow.alpha = (0.2, 0.85, 1.0), 0.8
        arrow.color_highlight, arrow.alpha_highlight = (1.0, 1.0, 1.0), 1.0
        properties = arrow.target_set_operator(live_operator.MESH_OT_fairmesh_live.bl_idname)
        properties.hold = True
        return arrow, properties


def _handles(context):
    """(vertex, matrix) of the loops of what is selected in the active object, in the scene."""
    obj = context.edit_object
    if obj is None or len(obj.data.vertices) > _MOST_READ:
        return []
    mesh = snapshot.read(obj)
    by_faces = tuple(context.tool_settings.mesh_select_mode) == (False, False, True)
    free = region.free_mask(mesh, by_faces)
    made = []
    for loop in live_loops.loops_of(mesh, free)[:_MOST_HANDLES]:
        vertex = int(loop.vertices[0])
        normal = obj.matrix_world.to_3x3().inverted_safe().transposed() @ obj.data.vertices[vertex].normal
        turn = Vector((0, 0, 1)).rotation_difference(normal)
        made.append(
            (vertex, Matrix.Translation(obj.matrix_world @ Vector(mesh.vertices[vertex])) @ turn.to_matrix().to_4x4())
        )
    return made


class FairLiveTool(bpy.types.WorkSpaceTool):
    bl_space_type = "VIEW_3D"
    bl_context_mode = "EDIT_MESH"
    bl_idname = live_operator.TOOL
    bl_label = "Fair Live"
    bl_description = (
        "Fairs what is selected, and drags at its boundary loops how the surface leaves them.\n"
        "Drag a handle, or beside a loop; T, W, B, G: tilt, twist, bulge, move; Enter confirms"
    )
    # Without ".dat"; icon.py makes it.
    bl_icon = str(Path(__file__).resolve().parent / "icons" / "fairmesh.live")
    is_there = False
    bl_widget = "VIEW3D_GGT_fairmesh_live"
    bl_keymap = (
        (
            live_operator.MESH_OT_fairmesh_live.bl_idname,
            {"type": "LEFTMOUSE", "value": "PRESS"},
            {"properties": [("hold", True)]},
        ),
    )

    def draw_settings(context, layout, tool):
        properties = tool.operator_properties(live_operator.MESH_OT_fairmesh_live.bl_idname)
        layout.prop(properties, "region")
        layout.prop(properties, "boundary_normals")


def has_key_maps():
    """Whether there are maps that the tool's keys can be put into: not yet while Blender starts in the background."""
    configurations = bpy.context.window_manager.keyconfigs
    return configurations.default is not None and configurations.addon is not None


def register():
    bpy.utils.register_class(VIEW3D_GGT_fairmesh_live)
    FairLiveTool.is_there = has_key_maps()
    if FairLiveTool.is_there:
        # After a tool that is in no group: this one would be hidden in it.
        bpy.utils.register_tool(FairLiveTool, after={"builtin.poly_build"})


def unregister():
    if FairLiveTool.is_there:
        bpy.utils.unregister_tool(FairLiveTool)
    bpy.utils.unregister_class(VIEW3D_GGT_fairmesh_live)
