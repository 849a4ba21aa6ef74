# SPDX-License-Identifier: GPL-3.0-or-later
"""Presets of all options in the sidebar, by Blender's own mechanism: those in `preset_files`, and those that users add."""

from pathlib import Path

import bpy
from bl_operators.presets import AddPresetBase
from bl_ui.utils import PresetPanel

from . import settings

_SUBDIR = "fairmesh"
_OURS = Path(__file__).resolve().parent / "preset_files"


class FAIRMESH_PT_presets(PresetPanel, bpy.types.Panel):
    """What the icon in the header of the sidebar's panel opens."""

    bl_label = "Fairmesh Presets"
    preset_subdir = _SUBDIR
    preset_operator = "script.execute_preset"
    preset_add_operator = "scene.fairmesh_preset_add"

    def path_menu(self, searchpaths, operator, **more):
        """Ours first: before Blender 4.2 add-ons cannot name a folder of presets."""
        super().path_menu([str(_OURS), *searchpaths], operator, **more)


class SCENE_OT_fairmesh_preset_add(AddPresetBase, bpy.types.Operator):
    """Add or remove a preset of all options of Fairmesh"""

    bl_idname = "scene.fairmesh_preset_add"
    bl_label = "Add Fairmesh Preset"
    preset_menu = "FAIRMESH_PT_presets"
    preset_subdir = _SUBDIR
    preset_defines = ["settings = bpy.context.scene.fairmesh"]
    preset_values = [f"settings.{name}" for name in settings.names()]


_CLASSES = (FAIRMESH_PT_presets, SCENE_OT_fairmesh_preset_add)
register, unregister = bpy.utils.register_classes_factory(_CLASSES)
