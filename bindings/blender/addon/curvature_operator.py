# SPDX-License-Identifier: GPL-3.0-or-later
"""Mesh > Clean Up > Show Curvature: mean curvature as colours; and Hide Curvature."""

import bmesh
import bpy
import numpy as np
from bpy.props import FloatProperty

from . import fairmesh, menus, messages, native, snapshot
from .properties import selection, switch

COLORS = "Mean Curvature"
VALUES = "mean_curvature"

# Blue, white, red: end points and middle of a diverging map (Moreland 2009), linear RGB.
_BLUE, _WHITE, _RED = np.array([[0.044, 0.072, 0.527], [0.725, 0.725, 0.725], [0.456, 0.001, 0.019]])
_GREY = np.array([0.05, 0.05, 0.05])


# What colour was shown before, in a mesh's custom properties; and how a viewport was shaded, by its address.
_COLOR_BEFORE = "fairmesh_color_before"
_shading_before = {}


class MESH_OT_fairmesh_show_curvature(bpy.types.Operator):
    """Store the mean curvature H of the whole mesh as the colour attribute "Mean Curvature" and show it.

    Red bulges out (H negative with outward normals), blue is hollow, white is the middle of the range"""

    bl_idname = "mesh.fairmesh_show_curvature"
    bl_label = "Show Curvature"
    bl_options = {"REGISTER", "UNDO"}

    scale: selection(
        "Range",
        "Which curvatures the ends of the colour map stand for",
        ("AUTO", "Automatic", "98 of 100 vertices are within the range"),
        ("MANUAL", "Manual", "Half Width is given"),
    )
    half_width: FloatProperty(
        name="Half Width",
        description="The ends of the map are this far from its middle, in 1 / length",
        default=1.0,
        min=1e-9,
        soft_max=100.0,
        precision=3,
    )
    middle: selection(
        "Middle",
        "The curvature that is white",
        ("ZERO", "Flat", "H = 0"),
        ("MEDIAN", "Median", "The median of H: shows how even a surface is curved"),
    )
    values: switch("Store Values", 'Store H itself, too, as the attribute "mean_curvature" for geometry nodes and scripts')
    show: switch("Show in Viewport", "Switch solid shading to the colours", True)

    @classmethod
    def poll(cls, context):
        return context.mode in {"EDIT_MESH", "OBJECT"} and context.object is not None and context.object.type == "MESH"

    def draw(self, context):
        layout = self.layout
        layout.use_property_split = True
        layout.prop(self, "scale")
        if self.scale == "MANUAL":
            layout.prop(self, "half_width")
        layout.prop(self, "middle")
        layout.prop(self, "values")
        layout.prop(self, "show")

    def execute(self, context):
        objects = _objects(context)
        try:
            native.load()
            curvatures = [_curvature(obj) for obj in objects]
        except fairmesh.FairmeshError as why:
            self.report({"ERROR"}, messages.refused(why, getattr(why, "subject", None)))
            return {"CANCELLED"}
        except (fairmesh.LibraryError, MemoryError) as why:
            self.report({"ERROR"}, f"{self.bl_label}: {why}")
            return {"CANCELLED"}
        known = np.concatenate([h[np.isfinite(h)] for h in curvatures])
        if not len(known):
            self.report({"ERROR"}, "The mesh has no faces to take the curvature of")
            return {"CANCELLED"}
        middle = float(np.median(known)) if self.middle == "MEDIAN" else 0.0
        width = self.half_width if self.scale == "MANUAL" else float(np.percentile(np.abs(known - middle), 98))
        # A plane, or a perfect sphere around its median: rounding is not to be blown up to colours.
        width = max(width, 1e-4 * float(np.abs(known).max()), 1e-12)
        for obj, h in zip(objects, curvatures):
            _store(obj, colors_of((h - middle) / width), h if self.values else None)
        if self.show:
            _show(context)
        self.report(
            {"INFO"},
            f"H from {known.min():.4g} to {known.max():.4g}; colours: {middle - width:.4g} to {middle + width:.4g}",
        )
        return {"FINISHED"}


class MESH_OT_fairmesh_hide_curvature(bpy.types.Operator):
    """Take the colours of Show Curvature away, and shade as before"""

    bl_idname = "mesh.fairmesh_hide_curvature"
    bl_label = "Hide Curvature"
    bl_options = {"REGISTER", "UNDO"}

    @classmethod
    def poll(cls, context):
        return MESH_OT_fairmesh_show_curvature.poll(context) and is_shown(context)

    def execute(self, context):
        for obj in _objects(context):
            _take_away(obj.data)
        _show_as_before(context)
        return {"FINISHED"}


def is_shown(context):
    """Whether an object has the colours."""
    return any(COLORS in obj.data.attributes for obj in _objects(context))


def _objects(context):
    return context.objects_in_mode_unique_data if context.mode == "EDIT_MESH" else [context.object]


def _curvature(obj):
    mesh = snapshot.read(obj)
    with messages.about(mesh):
        return fairmesh.mean_curvature(mesh.vertices, mesh.triangles)


def colors_of(scaled):
    """(n, 4) linear colours: -1 red, 0 white, 1 blue; NaN dark grey."""
    side = np.clip(np.nan_to_num(scaled), -1, 1)[:, None]
    colors = np.where(side < 0, _WHITE + (_RED - _WHITE) * -side, _WHITE + (_BLUE - _WHITE) * side)
    colors[np.isnan(scaled)] = _GREY
    return np.column_stack([colors, np.ones(len(colors))]).astype(np.float32)


def _store(obj, colors, curvature):
    mesh = obj.data
    before = mesh.color_attributes.active_color
    if _COLOR_BEFORE not in mesh:
        mesh[_COLOR_BEFORE] = before.name if before is not None else ""
    _attribute(mesh, COLORS, "FLOAT_COLOR")
    if curvature is not None:
        _attribute(mesh, VALUES, "FLOAT")
    # Adding moves the data: attributes are looked up when all are there.
    mesh.color_attributes.active_color = mesh.color_attributes[COLORS]
    if obj.mode != "EDIT":
        mesh.attributes[COLORS].data.foreach_set("color", colors.ravel())
        if curvature is not None:
            mesh.attributes[VALUES].data.foreach_set("value", np.nan_to_num(curvature).astype(np.float32))
        mesh.update()
        return
    edit_mesh = bmesh.from_edit_mesh(mesh)
    layer = edit_mesh.verts.layers.float_color[COLORS]
    for vertex, color in zip(edit_mesh.verts, colors.tolist()):
        vertex[layer] = color
    if curvature is not None:
        layer = edit_mesh.verts.layers.float[VALUES]
        for vertex, value in zip(edit_mesh.verts, np.nan_to_num(curvature).tolist()):
            vertex[layer] = value
    bmesh.update_edit_mesh(mesh, loop_triangles=False, destructive=False)


def _attribute(mesh, name, kind):
    """An attribute of vertices, made if there is none; one of another kind with this name is replaced."""
    there = mesh.attributes.get(name)
    if there is not None and (there.domain != "POINT" or there.data_type != kind):
        mesh.attributes.remove(there)
        there = None
    if there is None:
        collection = mesh.color_attributes if kind == "FLOAT_COLOR" else mesh.attributes
        collection.new(name, kind, "POINT")


def _take_away(mesh):
    there = mesh.attributes.get(COLORS)
    if there is not None:
        mesh.attributes.remove(there)
    before = mesh.color_attributes.get(mesh.pop(_COLOR_BEFORE, ""))
    if before is not None:
        mesh.color_attributes.active_color = before


def _show(context):
    space = context.space_data
    if space is not None and space.type == "VIEW_3D":
        if space.shading.color_type != "VERTEX":
            _shading_before[space.as_pointer()] = space.shading.type, space.shading.color_type
        space.shading.color_type = "VERTEX"
        if space.shading.type not in {"SOLID", "WIREFRAME"}:
            space.shading.type = "SOLID"


def _show_as_before(context):
    space = context.space_data
    if space is None or space.type != "VIEW_3D" or space.shading.color_type != "VERTEX":
        return
    kind, color_type = _shading_before.pop(space.as_pointer(), ("SOLID", "MATERIAL"))
    # A color type is that of solid shading.
    space.shading.color_type = color_type
    space.shading.type = kind


_register, _unregister = menus.registration(
    MESH_OT_fairmesh_show_curvature,
    "VIEW3D_MT_edit_mesh_clean",
)


def register():
    _register()
    bpy.utils.register_class(MESH_OT_fairmesh_hide_curvature)


def unregister():
    bpy.utils.unregister_class(MESH_OT_fairmesh_hide_curvature)
    _unregister()
    _shading_before.clear()
