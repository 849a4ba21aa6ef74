# SPDX-License-Identifier: GPL-3.0-or-later
"""What Fair Live is asked to change at the boundary: while it runs, as the operator's properties, and for the library."""

import math
from dataclasses import dataclass, replace

import bpy
import numpy as np
from bpy.props import FloatProperty, FloatVectorProperty, IntProperty

from . import fairmesh
from .properties import distance, selection

TILT, TWIST, BULGE, MOVE = "TILT", "TWIST", "BULGE", "MOVE"
#: Behind these the surface folds over.
WIDEST = math.radians(170)
_NO_WAY = (0.0, 0.0, 0.0)


@dataclass(frozen=True)
class Edit:
    """One change: `angle` of a tilt, a twist or a bulge, `way` of a move in the object's coordinates."""

    kind: str
    #: On the loop; -1 for a bulge, which is of all.
    vertex: int
    angle: float = 0.0
    way: tuple = _NO_WAY
    #: As seen in the scene.
    falloff: float = 0.0

    @property
    def is_nothing(self):
        return self.angle == 0.0 and self.way == _NO_WAY


class FAIRMESH_PG_live_edit(bpy.types.PropertyGroup):
    """The same as properties of the operator."""

    kind: selection(
        "Kind",
        "What is changed at the boundary",
        (TILT, "Tilt", "The surface leaves the boundary loop steeper"),
        (TWIST, "Twist", "The same with opposite signs on both sides of the vertex"),
        (BULGE, "Bulge", "All boundary loops are tilted alike"),
        (MOVE, "Move", "The boundary loop is moved"),
    )
    vertex: IntProperty(name="Vertex", description="A vertex of the boundary loop", default=-1, min=-1)
    angle: FloatProperty(
        name="Angle",
        description="By how much. Positive: outward, to the side that normals point to",
        subtype="ANGLE",
        min=-WIDEST,
        max=WIDEST,
    )
    way: FloatVectorProperty(
        name="Way", description="How far the loop is moved, in the object's coordinates", subtype="TRANSLATION"
    )
    falloff: distance("Falloff", "How far from the vertex the effect goes to zero. 0: the whole loop alike")

    def set(self, edit):
        self.kind, self.vertex, self.angle = edit.kind, edit.vertex, edit.angle
        self.way, self.falloff = edit.way, edit.falloff

    def get(self):
        return Edit(self.kind, self.vertex, self.angle, tuple(self.way), self.falloff)

    def draw_edit(self, layout):
        box = layout.column(align=True)
        box.prop(self, "kind")
        box.prop(self, "way" if self.kind == MOVE else "angle")
        if self.kind != BULGE:
            # What no length means, where it stands.
            none = "Falloff (Loop Alone)" if self.kind == MOVE else "Falloff (Whole Loop)"
            box.prop(self, "falloff", text="Falloff" if self.falloff else none)


def mirrored(edit, axis, image):
    """The mirror image of an edit across an axis of the object; `image` is that of its vertex."""
    way = tuple(-x if number == axis else x for number, x in enumerate(edit.way))
    # A reflected loop is run through the other way around.
    angle = -edit.angle if edit.kind == TWIST else edit.angle
    return replace(edit, vertex=image, angle=angle, way=way)


def for_library(edit, region):
    """As the library takes it; `region` is the `LiveRegion`."""
    size = region.mesh.size
    if edit.kind == BULGE:
        return fairmesh.Bulge(edit.angle)
    if edit.kind == MOVE:
        way = region.mesh.seen_way(np.array(edit.way))
        loop = region.loop_with(edit.vertex)
        return fairmesh.Move(
            [edit.vertex] if loop is None else loop.vertices, translation=tuple(way), falloff=edit.falloff / size
        )
    made = fairmesh.Tilt if edit.kind == TILT else fairmesh.Twist
    return made(edit.vertex, edit.angle, falloff=edit.falloff / size)


def register():
    bpy.utils.register_class(FAIRMESH_PG_live_edit)


def unregister():
    bpy.utils.unregister_class(FAIRMESH_PG_live_edit)
