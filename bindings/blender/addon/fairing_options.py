# SPDX-License-Identifier: GPL-3.0-or-later
"""Options of the fairing, as properties: the same in operators and in the sidebar."""

import math

from bpy.props import FloatProperty, IntProperty

from . import advice
from .fairmesh import default_options
from .fairmesh._abi import SHARP_AUTO
from .properties import choice, selection, switch

#: The library's names for degrees, and what it does where nothing is asked.
_SHARP = {"OFF": "off", "AUTO": "auto", "MARKED": "off"}
_DEGREES = default_options()["sharp"]


class RegionOptions:
    """Mixed into the operator that fairs, and into settings."""

    region: selection(
        "Region",
        "Which vertices may move",
        ("AUTO", "By Select Mode", "Inside Faces in face select mode, otherwise Selected Vertices"),
        ("FACES", "Inside Faces", "Vertices whose faces are all selected: the boundary of the selection stays"),
        ("VERTICES", "Selected Vertices", "All selected vertices: the first unselected ones around them stay"),
    )

    def draw_region(self, layout):
        choice(layout, self, "region", "Region")

    asks = "select what is to move"

    @classmethod
    def lacks(cls, context, facts):
        settings = context.scene.fairmesh
        is_free = facts.inside if settings.is_by_faces(context) else facts.free
        return None if is_free else ": ".join(settings.nothing_free(context))

    def is_by_faces(self, context):
        if self.region == "AUTO":
            return tuple(context.tool_settings.mesh_select_mode) == (False, False, True)
        return self.region == "FACES"

    def nothing_free(self, context):
        """Why nothing can move, and what to do."""
        if self.is_by_faces(context):
            return (
                "No vertex can move",
                advice.named(
                    "select faces with vertices inside, as the selection's boundary stays; or set {region.VERTICES}"
                ),
            )
        return "No vertex can move", "select vertices inside the mesh. Its boundary and vertices of hidden faces stay"


class CurvatureOption:
    """How far surfaces go on as curved as what is around."""

    continuity: FloatProperty(
        name="Match Curvature",
        description=(
            "How far the surface goes on as curved as the faces around it. 0: it goes on smoothly. 1: its curvature does, "
            "too, so that reflections show no edge. Where the faces around are too rough, less is reached"
        ),
        default=0.0,
        min=0.0,
        max=1.0,
        subtype="FACTOR",
    )

    def draw_continuity(self, layout):
        layout.prop(self, "continuity", slider=True)


class FairingOptions(CurvatureOption):
    """Mixed into operators and settings. Every identifier in lower case is the library's name of the choice."""

    curvature: selection(
        "Curvature",
        "Whether the surface goes on as curved as the faces around it, so that reflections show no edge",
        ("AUTO", "Where Certain", "It does where the faces around tell it, else it goes on smoothly"),
        ("PART", "By Factor", "As far as Match Curvature says, along all boundaries"),
    )
    inner_fairness: selection(
        "Distribution",
        "How vertices are spread within the surface. The shape of the surface hardly depends on it",
        ("UNIFORM", "Even", "Vertices are spread evenly"),
        ("CONFORMAL", "Keep Shapes", "Least distortion of the triangles as they are now. Needs sound triangles"),
        ("CONVEX", "Keep Shapes, Robust", "As Keep Shapes, with weights that are positive for bad triangles, too"),
    )
    boundary_normals: selection(
        "Tangents",
        "The directions in which the surface leaves the faces around it",
        ("FITTED", "Fitted", "Fitted to the curved surface around the region: the most accurate"),
        ("AVERAGED", "Averaged", "Average of the faces around the region: for noisy surroundings"),
    )
    sharp: selection(
        "Sharp Edges",
        "What becomes of sharp edges around the selection that lead into it. In Fair Live they end there",
        ("OFF", "Smooth", "They end at the selection: inside, the surface is smooth"),
        (
            "AUTO",
            "Go On",
            "Those that are certain or marked sharp or creased go on, if they fit each other: vertices lie along them then",
        ),
        ("ANGLE", "Go On by Angle", "The same, of those that bend by the angle or more, or are marked"),
        ("MARKED", "Go On if Marked", "The same, of those alone that are marked sharp or creased"),
        default={0.0: "OFF", SHARP_AUTO: "AUTO"}.get(_DEGREES, "ANGLE"),
    )
    sharp_angle: FloatProperty(
        name="Sharp Angle",
        description="Edges that bend by this much or more go on",
        default=math.radians(_DEGREES or SHARP_AUTO),
        min=math.radians(1.0),
        max=math.pi,
        subtype="ANGLE",
    )
    target: selection(
        "Shape",
        "The kind of surface",
        ("HARMONIC", "Natural", "Curved as evenly as it can be: parts of spheres and cylinders come back exactly"),
        ("CONSTANT", "Bulged", "Pushed out or in, by Bulge"),
        ("MINIMAL_ENERGY", "Elastic Sheet", "Bent as little as it can be, as a thin sheet of steel"),
    )
    constant: FloatProperty(
        name="Bulge",
        description=(
            "How far the surface is pushed out, along the normals; a negative number pushes it in. "
            "100 raises a flat disc by about a seventh of its radius, whatever its size"
        ),
        default=100.0,
        soft_min=-1000.0,
        soft_max=1000.0,
        step=1000,
        precision=1,
    )
    digits: IntProperty(
        name="Accuracy",
        description=(
            "How many digits of the positions are right, measured in the size of the region. Blender keeps about 7"
        ),
        default=7,
        min=2,
        max=12,
    )
    max_iterations: IntProperty(
        name="Iterations",
        description="At most this many iterations; 5 to 30 is usual",
        default=500,
        min=1,
        soft_max=1000,
    )

    check_intersections: switch(
        "Check Intersections",
        "Search the result for faces that intersect each other or the rest of the mesh, and warn of them",
        True,
    )

    def draw_fairing(self, layout):
        """All options, the constant only where it counts."""
        choice(layout, self, "inner_fairness", "Distribution")
        choice(layout, self, "boundary_normals", "Tangents")
        choice(layout, self, "curvature", "Curvature")
        if self.curvature == "PART":
            self.draw_continuity(layout)
        choice(layout, self, "sharp", "Sharp Edges")
        if self.sharp == "ANGLE":
            layout.prop(self, "sharp_angle")
        choice(layout, self, "target", "Shape")
        if self.target == "CONSTANT":
            layout.prop(self, "constant")
        layout.prop(self, "digits")
        layout.prop(self, "max_iterations")
        layout.prop(self, "check_intersections")

    def asked_continuity(self):
        """How far curvature goes on, as the library takes it."""
        return "auto" if self.curvature == "AUTO" else self.continuity

    def marked_keywords(self):
        """A function from a `Snapshot` to its edges that are sharp because they are marked, for `fairmesh.fair`."""
        if self.sharp == "OFF":
            return lambda mesh: {}
        return lambda mesh: {"marked_edges": mesh.marked_edges}

    def fairing_keywords(self, diagonal):
        """The same for `fairmesh.fair`; `diagonal` is that of the region."""
        if self.target == "CONSTANT":
            target = self.constant / diagonal**3 if diagonal > 0 else 0.0
        else:
            target = self.target.lower()
        return {
            "inner_fairness": self.inner_fairness.lower(),
            "boundary_normals": self.boundary_normals.lower(),
            "continuity": self.asked_continuity(),
            "sharp": _SHARP.get(self.sharp, math.degrees(self.sharp_angle)),
            "target": target,
            "tolerance": 10.0**-self.digits,
            "max_iterations": self.max_iterations,
            # That of Blender's coordinates.
            "output_precision": "single",
            "intersections": "check" if self.check_intersections else "skip",
        }
