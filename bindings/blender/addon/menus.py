# SPDX-License-Identifier: GPL-3.0-or-later
"""Operators and their entries in Blender's menus."""

import bpy


def registration(operator, *menus):
    """The functions that register an operator with an entry at the end of each of `menus`, and take it back."""

    # Blender sets an attribute of it: a method would not do.
    def entry(self, context):
        self.layout.operator(operator.bl_idname)

    def register():
        bpy.utils.register_class(operator)
        for menu in menus:
            getattr(bpy.types, menu).append(entry)

    def unregister():
        for menu in menus:
            getattr(bpy.types, menu).remove(entry)
        bpy.utils.unregister_class(operator)

    return register, unregister
