# SPDX-License-Identifier: GPL-3.0-or-later
"""Operators and their entries in Blender's menus."""

import bpy

_CONTEXT_MENU = "VIEW3D_MT_edit_mesh_context_menu"


def registration(operator, *menus, select_modes=()):
    """The functions that register an operator with an entry at the end of each of `menus`, and take it back.

    `select_modes`: those of "VERT", "EDGE", "FACE" in which it is in the context (right-click) menu, too.
    """

    # Blender sets an attribute of it: a method would not do.
    def entry(self, context):
        self.layout.operator(operator.bl_idname)

    def context_entry(self, context):
        modes = zip(("VERT", "EDGE", "FACE"), context.tool_settings.mesh_select_mode)
        if any(on and mode in select_modes for mode, on in modes):
            self.layout.operator(operator.bl_idname)

    entries = [(menu, entry) for menu in menus] + [(_CONTEXT_MENU, context_entry)] * bool(select_modes)

    def register():
        bpy.utils.register_class(operator)
        for menu, draw in entries:
            getattr(bpy.types, menu).append(draw)

    def unregister():
        for menu, draw in entries:
            getattr(bpy.types, menu).remove(draw)
        bpy.utils.unregister_class(operator)

    return register, unregister
