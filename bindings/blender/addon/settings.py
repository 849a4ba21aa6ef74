# SPDX-License-Identifier: GPL-3.0-or-later
"""What the buttons of the sidebar hand to the operators: every option of each."""

import bpy
from bpy.props import PointerProperty

from . import fairing_options, patch_options, round_options

_OPTIONS = (
    fairing_options.RegionOptions,
    fairing_options.FairingOptions,
    fairing_options.CurvatureOption,
    patch_options.PatchOptions,
    patch_options.RimOptions,
    patch_options.TrimOptions,
    patch_options.CleanOptions,
    patch_options.GuideOptions,
    patch_options.OuterOptions,
    patch_options.LimitOptions,
    patch_options.RelatedOptions,
    patch_options.JoinOptions,
    patch_options.BridgeOptions,
    round_options.RoundOptions,
)


def names():
    """Of all options."""
    return [name for options in _OPTIONS for name in options.__annotations__]


class FAIRMESH_PG_settings(*_OPTIONS, bpy.types.PropertyGroup):
    """The options in the sidebar, one set for each scene."""

    def reset(self):
        """Sets all options to what they are at first."""
        for name in names():
            self.property_unset(name)

    def hand_to(self, button, operator):
        """Sets the options of a button that runs an operator of this class."""
        for options in _OPTIONS:
            if issubclass(operator, options):
                for name in options.__annotations__:
                    setattr(button, name, getattr(self, name))


def register():
    bpy.utils.register_class(FAIRMESH_PG_settings)
    bpy.types.Scene.fairmesh = PointerProperty(type=FAIRMESH_PG_settings)


def unregister():
    del bpy.types.Scene.fairmesh
    bpy.utils.unregister_class(FAIRMESH_PG_settings)
