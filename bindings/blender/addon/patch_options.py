# SPDX-License-Identifier: GPL-3.0-or-later
"""Options of patches, as properties: the same in operators and in the sidebar."""

from bpy.props import FloatProperty

from .properties import area, choice, count, distance, selection, switch


class PatchOptions:
    """What every patch has."""

    density: FloatProperty(
        name="Density",
        description="1: new edges are as long as those around the hole; 2: half as long",
        default=1.0,
        min=0.1,
        max=7.0,
        soft_min=0.5,
        soft_max=4.0,
    )
    faces: selection(
        "Faces",
        "What the new faces are",
        (
            "AUTO",
            "Automatic",
            "Rows of quads between two loops that have equally many edges with quads at them; otherwise triangles",
        ),
        ("TRIANGLES", "Triangles", "Triangles alone"),
        ("QUADS", "Quads", "Such rows, or pairs of triangles as Tris to Quads makes of them; what is left stays triangles"),
    )
    smooth: switch("Fair", "Make the patch a smooth continuation of its surroundings. Off: it stays as triangulated", True)
    cap: selection(
        "Flat Holes",
        "What closes a hole whose boundary lies in a plane, as where a part was cut off",
        ("FAIR", "Fair", "A patch that continues its surroundings, as everywhere"),
        ("FLAT", "Plane", "That plane, with a sharp edge"),
    )
    on_failure: selection(
        "If Not Fair",
        "What a hole gets whose patch is not fair, creased, intersects something or has another flaw",
        ("BEST", "Best There Is", "The best surface that is found; a warning says what it lacks"),
        ("FLAT", "Flat", "The patch as triangulated"),
        ("OPEN", "Nothing", "It stays open"),
    )

    def own_keywords(self):
        """The same for the library."""
        return {
            # The library's factor: the square root of 2 is as long as around the hole.
            "density": self.density * 2.0**0.5,
            "fair": self.smooth,
            "cap": self.cap.lower(),
            "on_failure": self.on_failure.lower(),
        }

    def draw_patch(self, layout):
        layout.prop(self, "density")
        choice(layout, self, "faces", "Faces")
        layout.prop(self, "smooth")
        if self.smooth:
            choice(layout, self, "cap", "Flat Holes")
            choice(layout, self, "on_failure", "If Not Fair")


class RimOptions:
    """What may become of the mesh around a hole."""

    relax_rim: count(
        "Smooth Rim",
        "For the rough boundaries of scans: so many rings of vertices around a hole, those of its boundary counted, "
        "may move onto the smooth surface there; 3 is a good number. 0: the faces around the hole stay as they are. "
        "-1: as many as are advised around holes that are rough, and where nothing folds",
        least=-1,
        soft_max=8,
    )
    relax_within: distance("Rim Limit", "No vertex of the rim moves further than this. 0: than the edges there are long")

    def rim_keywords(self):
        """The same for the library, by the size of the mesh in the scene. The properties are read now."""
        rings, within = self.relax_rim, self.relax_within

        def keywords(size):
            has_limit = rings != 0 and within > 0
            return {"relax_rim": "auto" if rings < 0 else rings, "relax_within": within / size if has_limit else None}

        return keywords

    def draw_rim(self, layout):
        layout.prop(self, "relax_rim")
        if self.relax_rim:
            layout.prop(self, "relax_within")


class TrimOptions:
    """What may be taken away at a hole before it is filled."""

    trim: count(
        "Trim Faces",
        "Before a hole is filled, up to so many faces at it are taken away that would spoil the patch: slivers, spikes "
        "and fins, the worst first. 0: none",
        soft_max=100,
    )
    trim_area: area("Trim Area", "No more area than this is trimmed away, of all such faces of an object together. 0: any")

    def draw_trim(self, layout):
        layout.prop(self, "trim")
        if self.trim:
            layout.prop(self, "trim_area")


class CleanOptions:
    """What may go beside faces that are erased."""

    clean_boundary: count(
        "Clean Rim",
        "Erase and Fill: up to so many faces more beside the selected ones go, slivers and fins. 0: none",
        soft_max=100,
    )

    def draw_clean(self, layout):
        layout.prop(self, "clean_boundary")


class GuideOptions:
    """Which vertices across a hole belong together."""

    guides: switch(
        "Connect Pairs",
        "The triangulation begins with edges between the selected vertices, two by two as they were selected one after "
        "the other: for long tears, to say which points of the two sides belong together. No edge shows in the surface",
    )

    def draw_guides(self, layout):
        layout.prop(self, "guides")


class OuterOptions:
    """Whether an open surface may be closed."""

    outer: switch("Outer Boundaries, Too", "Also fill the outer boundary of an open surface, not only gaps in it")

    def draw_outer(self, layout):
        layout.prop(self, "outer")


class LimitOptions:
    """Which of all holes are filled."""

    max_edges: count("Most Edges", "Fill All Holes: those of more edges stay open. 0: holes of any size are filled")
    max_length: distance(
        "Longest", "Fill All Holes: those with a longer boundary stay open. 0: holes of any length are filled"
    )
    max_diagonal: distance(
        "Widest", "Fill All Holes: those with a longer diagonal of the bounding box stay open. 0: of any width are filled"
    )
    max_area: area("Largest Area", "Fill All Holes: those that span a larger area stay open. 0: of any area are filled")
    except_longest: count(
        "But the Largest", "Fill All Holes: so many stay open, those with the longest boundaries of each object"
    )

    def draw_limits(self, layout):
        layout.prop(self, "max_edges")
        layout.prop(self, "max_length")
        layout.prop(self, "max_diagonal")
        layout.prop(self, "max_area")
        layout.prop(self, "except_longest")


class RelatedOptions:
    """Whether holes are joined."""

    join: switch(
        "Join Related Loops",
        "Loops whose common patch bends less than patches of their own get one: the two sides of a gap, "
        "ends of tubes that face each other",
    )

    def draw_related(self, layout):
        layout.prop(self, "join")


class JoinOptions:
    """Which loops are joined."""

    groups: selection(
        "Patches",
        "Which loops get one patch together",
        ("ONE", "One for All", "All selected loops of an object get one patch"),
        (
            "AUTO",
            "Where It Bends Less",
            "Loops whose common patch bends less than patches of their own would; the others are left open",
        ),
    )

    def draw_groups(self, layout):
        choice(layout, self, "groups", "Join Loops: Patches")


class BridgeOptions:
    """What a bridge is."""

    width: distance(
        "Bridge Width",
        "How long the ends of a bridge are along the boundary: the selected runs are made longer or shorter about their "
        "middles, and one vertex each is enough. 0: as they are selected",
    )
    fill_rest: switch(
        "Fill the Rest", "Also fill the holes that a bridge leaves beside it; all that is new is faired together"
    )

    def draw_bridge(self, layout):
        layout.prop(self, "width")
        layout.prop(self, "fill_rest")
