# SPDX-License-Identifier: GPL-3.0-or-later
"""Options of the fairing, as properties: the same in operators and in the sidebar."""

import bpy
from bpy.props import BoolProperty, EnumProperty, FloatProperty, IntProperty, PointerProperty


class FairingOptions:
    """Mixed into operators and settings. Every identifier in lower case is the library's name of the choice."""

    inner_fairness: EnumProperty(
        name="Distribution",
        description="How vertices are spread within the surface. The shape of the surface hardly depends on it",
        items=(
            ("UNIFORM", "Even", "Vertices are spread evenly"),
            ("CONFORMAL", "Keep Shapes", "Least distortion of the triangles as they are now. Needs sound triangles"),
            ("CONVEX", "Keep Shapes, Robust", "As Keep Shapes, with weights that are positive for bad triangles, too"),
        ),
        default="UNIFORM",
    )
    boundary_normals: EnumProperty(
        name="Boundary Normals",
        description="The tangent planes in which the surface meets the faces around it",
        items=(
            ("FITTED", "Fitted", "Fitted to the curved surface around the region: the most accurate"),
            ("AVERAGED", "Averaged", "Average of the faces around the region: for noisy surroundings"),
        ),
        default="FITTED",
    )
    continuity: FloatProperty(
        name="Curvature Continuity",
        description=(
            "How far the surface continues the curvature of the faces around it: 0 its tangent planes alone (G1), 1 its "
            "curvature, too (G2), so that reflections show no edge. Where the surroundings are too rough, less is reached"
        ),
        default=0.0,
        min=0.0,
        max=1.0,
        subtype="FACTOR",
    )
    target: EnumProperty(
        name="Curvature",
        description="What the mean curvature H of the surface has to satisfy",
        items=(
            ("HARMONIC", "Harmonic", "H varies as little as it can: spheres and cylinders are restored exactly"),
            ("CONSTANT", "Bulged", "The Laplacian of H is a constant: the surface is pushed out or in"),
            ("MINIMAL_ENERGY", "Minimal Energy", "Least total curvature, as a thin elastic sheet"),
        ),
        default="HARMONIC",
    )
    constant: FloatProperty(
        name="Bulge",
        description=(
            "The constant of Bulged, divided by the cube of the diagonal of the region's bounding box. "
            "Positive pushes out, along the normals; 100 raises a flat disc by about a seventh of its radius"
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
            "Stop when a step moves the vertices by less than 10 to the power of minus this, in diagonals of the region. "
            "Blender keeps about 7 digits"
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

    check_intersections: BoolProperty(
        name="Check Intersections",
        description="Search the result for faces that intersect each other or the rest of the mesh, and warn of them",
        default=True,
    )

    def draw_fairing(self, layout):
        """All options, the constant only where it counts."""
        layout.prop(self, "inner_fairness")
        layout.prop(self, "boundary_normals")
        layout.prop(self, "continuity", slider=True)
        layout.prop(self, "target")
        if self.target == "CONSTANT":
            layout.prop(self, "constant")
        layout.prop(self, "digits")
        layout.prop(self, "max_iterations")
        layout.prop(self, "check_intersections")

    def fairing_keywords(self, diagonal):
        """The same for `fairmesh.fair`; `diagonal` is that of the region."""
        if self.target == "CONSTANT":
            target = self.constant / diagonal**3 if diagonal > 0 else 0.0
        else:
            target = self.target.lower()
        return {
            "inner_fairness": self.inner_fairness.lower(),
            "boundary_normals": self.boundary_normals.lower(),
            "continuity": self.continuity,
            "target": target,
            "tolerance": 10.0**-self.digits,
            "max_iterations": self.max_iterations,
            # That of Blender's coordinates.
            "output_precision": "single",
            "intersections": "check" if self.check_intersections else "skip",
        }


FAIRING = tuple(FairingOptions.__annotations__)


class FAIRMESH_PG_settings(FairingOptions, bpy.types.PropertyGroup):
    """What the buttons of the sidebar hand to the operators."""

    def hand_to(self, operator):
        """Sets the fairing options of a button's operator."""
        for name in FAIRING:
            setattr(operator, name, getattr(self, name))


def register():
    bpy.utils.register_class(FAIRMESH_PG_settings)
    bpy.types.Scene.fairmesh = PointerProperty(type=FAIRMESH_PG_settings)


def unregister():
    del bpy.types.Scene.fairmesh
    bpy.utils.unregister_class(FAIRMESH_PG_settings)
