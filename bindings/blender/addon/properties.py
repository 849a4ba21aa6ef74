# SPDX-License-Identifier: GPL-3.0-or-later
"""Properties of the kinds that operators and the sidebar have many of."""

from bpy.props import BoolProperty, EnumProperty, FloatProperty, IntProperty


def selection(name, description, *items, default=None):
    """One of several (identifier, name, description), by default the first."""
    return EnumProperty(name=name, description=description, items=items, default=default or items[0][0])


def switch(name, description, default=False):
    """On or off."""
    return BoolProperty(name=name, description=description, default=default)


def count(name, description, least=0, **more):
    """A number of things, by default none."""
    return IntProperty(name=name, description=description, default=0, min=least, **more)


def distance(name, description):
    """A length in the scene, by default 0, which stands for none."""
    return FloatProperty(name=name, description=description, default=0.0, min=0.0, subtype="DISTANCE")


def area(name, description):
    """An area in the scene, by default 0, which stands for none."""
    return FloatProperty(name=name, description=description, default=0.0, min=0.0, precision=4)


def choice(layout, owner, name, label):
    """Draws a choice from a list: beside its name, or below it in the sidebar, which is narrow."""
    if layout.use_property_split:
        layout.prop(owner, name)
        return
    column = layout.column(align=True)
    column.label(text=label)
    column.prop(owner, name, text="")
