# SPDX-License-Identifier: GPL-3.0-or-later
"""Mesh > Clean Up > Fill Hole and Fair."""

import bpy

from . import advice, fairmesh, filling, menus, messages
from .job import Background
from .patch_options import GuideOptions, HoleOptions, OuterOptions, RimOptions, TrimOptions
from .properties import selection


class MESH_OT_fairmesh_fill_holes(
    Background, filling.Filling, RimOptions, TrimOptions, GuideOptions, OuterOptions, HoleOptions, bpy.types.Operator
):
    """Fills holes of each object in Edit mode."""

    bl_idname = "mesh.fairmesh_fill_holes"
    bl_label = "Fill Hole and Fair"
    bl_description = (
        "Close holes with new triangles as large as those around them, on a surface that goes on smoothly: "
        "holes all of whose edges are selected; if there is none, holes with a selected edge or vertex"
    )

    scope: selection(
        "Holes",
        "Which holes are filled. Those with hidden vertices stay open",
        ("SELECTED", "Selected", "Holes whose boundaries are selected, or touched by the selection"),
        ("ALL", "All", "All holes of the mesh, up to a size"),
    )

    def draw_options(self, layout):
        layout.prop(self, "scope")
        if self.scope == "ALL":
            self.draw_limits(layout)
        self.draw_outer(layout)
        layout.prop(self, "join")
        self.draw_guides(layout)
        self.draw_trim(layout)
        self.draw_rim(layout)
        self.draw_filling(layout)

    def prepare(self, context):
        meshes = [self._holes(obj) for obj in context.objects_in_mode_unique_data]
        chosen = [holes for holes in meshes if holes.loops]
        if not chosen:
            self.tell({"ERROR"}, self._nothing(meshes))
            return None
        return self.work_on(chosen) if filling.guide(self, chosen) else None

    def _holes(self, obj):
        holes = filling.read(obj)
        mesh = holes.mesh
        holes.join = "auto" if self.join else "none"
        if self.scope == "SELECTED":
            holes.loops = filling.selected(holes)
        self._leave_out(holes, "a vertex is hidden", lambda loop: mesh.vertex_hidden[loop.vertices].any())
        if not self.outer:
            hanging = filling.hanging(holes)
            self._leave_out(holes, messages.why(fairmesh.FillReason.HANGING), lambda loop: id(loop) in hanging)
            self._leave_out(
                holes,
                messages.why(fairmesh.FillReason.OUTER_BOUNDARY),
                lambda loop: loop.kind is fairmesh.LoopKind.OUTER_BOUNDARY,
            )
        if self.scope == "ALL":
            self._bound(holes)
        if self.trim and holes.loops:
            _, holes.loops = filling.trimmed(holes, holes.loops, self.trim, self.trim_area)
        return holes

    def _bound(self, holes):
        """Leaves out what is too large."""
        by_length = sorted((loop for _, loop in holes.loops), key=lambda loop: loop.length, reverse=True)
        longest = {id(loop) for loop in by_length[: self.except_longest]}
        self._leave_out(holes, "it is one of the largest", lambda loop: id(loop) in longest)
        if self.max_edges:
            self._leave_out(
                holes, advice.named("it has more edges than {max_edges}"), lambda loop: len(loop.vertices) > self.max_edges
            )
        # Lengths and areas as seen in the scene, up to the object's size.
        size = holes.mesh.size
        if self.max_length:
            self._leave_out(
                holes, advice.named("it is longer than {max_length}"), lambda loop: size * loop.length > self.max_length
            )
        if self.max_diagonal:
            self._leave_out(
                holes,
                advice.named("it is wider than {max_diagonal}"),
                lambda loop: size * filling.largest_diagonal([(holes.mesh, loop.vertices)]) > self.max_diagonal,
            )
        if self.max_area:
            self._leave_out(
                holes, advice.named("it is larger than {max_area}"), lambda loop: size**2 * loop.area > self.max_area
            )

    def _leave_out(self, holes, why, applies):
        left = [(index, loop) for index, loop in holes.loops if not applies(loop)]
        if len(left) < len(holes.loops):
            holes.skipped.append((len(holes.loops) - len(left), why))
        holes.loops = left

    def _nothing(self, meshes):
        for holes in meshes:
            for count, why in holes.skipped:
                return f"Nothing was filled, {count} left open: {why}"
        if self.scope == "SELECTED":
            return messages.not_selected(
                (holes.mesh for holes in meshes),
                "No hole is selected",
                "select boundary edges of a hole (Alt-click on one), or use Fill All Holes in the sidebar",
            )
        return "The mesh has no hole"


register, unregister = menus.registration(
    MESH_OT_fairmesh_fill_holes,
    "VIEW3D_MT_edit_mesh_clean",
    "VIEW3D_MT_edit_mesh_vertices",
    "VIEW3D_MT_edit_mesh_edges",
    "VIEW3D_MT_edit_mesh_faces",
    select_modes=("VERT", "EDGE"),
)
