# SPDX-License-Identifier: GPL-3.0-or-later
"""All that the add-on is in a Blender without numpy, as Debian's may be: it says what to install."""

import bpy

TEXT = "Fairmesh needs numpy, which this Blender comes without: apt-get install python3-numpy, then start Blender again"


def _draw(layout):
    for line in TEXT.split(": "):
        for part in line.split(", "):
            layout.label(text=part)


class VIEW3D_PT_fairmesh_no_numpy(bpy.types.Panel):
    bl_label = "Fairmesh"
    bl_space_type = "VIEW_3D"
    bl_region_type = "UI"
    bl_category = "Fairmesh"

    def draw(self, context):
        _draw(self.layout.column())


class FAIRMESH_AP_no_numpy(bpy.types.AddonPreferences):
    bl_idname = __package__

    def draw(self, context):
        self.layout.label(text=TEXT, icon="ERROR")


_CLASSES = (VIEW3D_PT_fairmesh_no_numpy, FAIRMESH_AP_no_numpy)


def register():
    # In the terminal, and where the add-on was switched on.
    print(TEXT)
    for each in _CLASSES:
        bpy.utils.register_class(each)


def unregister():
    for each in reversed(_CLASSES):
        bpy.utils.unregister_class(each)
