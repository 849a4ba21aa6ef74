# SPDX-License-Identifier: GPL-3.0-or-later
"""Options of rounding, as properties: the same in the operator and in the sidebar."""

import math

from bpy.props import FloatProperty

from .properties import choice, selection


class RoundOptions:
    """How large blends are."""

    measured: selection(
        "Measured By",
        "What the size of a blend is",
        ("WIDTH", "Width", "How far it reaches from the edge, along the faces on both sides"),
        ("RADIUS", "Radius", "Of a ball that touches both faces where the blend begins; between planes that of the blend"),
    )
    length: FloatProperty(
        name="Size",
        description="Of the blends. Where there is less room, they are narrower",
        default=0.1,
        min=1e-6,
        soft_min=1e-3,
        subtype="DISTANCE",
    )
    taper: FloatProperty(
        name="Taper",
        description="How many times as large as at one end of the edges the blend is at the other one",
        default=1.0,
        min=0.01,
        soft_min=0.2,
        soft_max=5.0,
        max=100.0,
    )
    least_angle: FloatProperty(
        name="Least Angle",
        description="Selected edges that bend by no more than this stay as they are",
        default=math.radians(5.0),
        min=0.0,
        max=math.pi,
        subtype="ANGLE",
    )

    def size_keywords(self):
        """The size for the library, by the size of the mesh in the scene. The properties are read now."""
        name, length, taper = self.measured.lower(), self.length, self.taper
        return lambda size: {name: length / size, "taper": taper}

    def draw_round(self, layout):
        choice(layout, self, "measured", "Measured By")
        layout.prop(self, "length")
        layout.prop(self, "taper")
        layout.prop(self, "least_angle")
