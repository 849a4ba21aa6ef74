# SPDX-License-Identifier: GPL-3.0-or-later
"""Mesh > Clean Up > Fill Hole and Fair, and Fill All Holes."""

import bpy

from . import advice, fairmesh, filling, menus, messages, selected
from .job import Background
from .patch_options import GuideOptions, LimitOptions, OuterOptions, RelatedOptions, RimOptions, TrimOptions


class _Fill(Background, filling.Filling, RimOptions, TrimOptions, OuterOptions, RelatedOptions):
    """Fills holes of each object in Edit mode."""

    def _draw_holes(self, layout):
        self.draw_outer(layout)
        self.draw_related(layout)

    def _draw_patches(self, layout):
        self.draw_trim(layout)
        self.draw_rim(layout)
        self.draw_filling(layout)

    def _holes(self, obj):
        holes = filling.read(obj)
        mesh = holes.mesh
        holes.join = "auto" if self.join else "none"
        holes.loops = self._meant(holes)
        self._leave_out(holes, "a vertex is hidden", lambda loop: mesh.vertex_hidden[loop.vertices].any())
        if not self.outer:
            hanging = filling.hanging(holes)
            self._leave_out(holes, messages.why(fairmesh.FillReason.HANGING), lambda loop: id(loop) in hanging)
            self._leave_out(
                holes,
                messages.why(fairmesh.FillReason.OUTER_BOUNDARY),
                lambda loop: loop.kind is fairmesh.LoopKind.OUTER_BOUNDARY,
            )
        self._bound(holes)
        if self.trim and holes.loops:
            _, holes.loops = filling.trimmed(holes, holes.loops, self.trim, self.trim_area)
        return holes

    def _meant(self, holes):
        """The loops that are to be filled, if nothing is against it."""
        return holes.loops

    def _bound(self, holes):
        """Leaves out what is too large."""

    def _chosen(self, context):
        """The `Holes` of objects that have some to be filled; empty after it has said why there are none."""
        meshes = [self._holes(obj) for obj in context.objects_in_mode_unique_data]
        chosen = [holes for holes in meshes if holes.loops]
        if not chosen:
            skipped = next((each for holes in meshes for each in holes.skipped), None)
            why = "Nothing was filled, {} left open: {}".format(*skipped) if skipped else self.none
            self.tell({"ERROR"}, why)
        return chosen

    def _leave_out(self, holes, why, applies):
        left = [(index, loop) for index, loop in holes.loops if not applies(loop)]
        if len(left) < len(holes.loops):
            holes.skipped.append((len(holes.loops) - len(left), why))
        holes.loops = left


class MESH_OT_fairmesh_fill_holes(_Fill, GuideOptions, bpy.types.Operator):
    """Fills the selected holes of each object in Edit mode."""

    bl_idname = "mesh.fairmesh_fill_holes"
    bl_label = "Fill Hole and Fair"
    bl_description = (
        "Close holes with new triangles as large as those around them, on a surface that goes on smoothly: "
        "holes all of whose edges are selected; if there is none, holes with a selected edge or vertex"
    )

    asks = "select boundary edges of a hole (Alt-click on one), or use Fill All Holes"
    none = f"No hole is selected: {asks}"

    @classmethod
    def lacks(cls, context, facts):
        return None if facts.loops else cls.none

    def draw_options(self, layout):
        self._draw_holes(layout)
        self.draw_guides(layout)
        self._draw_patches(layout)

    def prepare(self, context):
        chosen = self._chosen(context)
        return self.work_on(chosen) if chosen and filling.guide(self, chosen) else None

    def _meant(self, holes):
        return filling.selected(holes)


class MESH_OT_fairmesh_fill_all_holes(_Fill, LimitOptions, bpy.types.Operator):
    """Fills all holes of each object in Edit mode, up to a size."""

    bl_idname = "mesh.fairmesh_fill_all_holes"
    bl_label = "Fill All Holes"
    bl_description = (
        "Close all holes, or all up to a size, with new triangles as large as those around them, "
        "on surfaces that go on smoothly"
    )

    none = "The mesh has no hole"

    @classmethod
    def missing(cls, context):
        facts = selected.facts(context)
        return None if facts is None or facts.is_open else cls.none

    def draw_options(self, layout):
        self.draw_limits(layout)
        self._draw_holes(layout)
        self._draw_patches(layout)

    def prepare(self, context):
        chosen = self._chosen(context)
        return self.work_on(chosen) if chosen else None

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


_MENUS = (
    "VIEW3D_MT_edit_mesh_clean",
    "VIEW3D_MT_edit_mesh_vertices",
    "VIEW3D_MT_edit_mesh_edges",
    "VIEW3D_MT_edit_mesh_faces",
)
_register, _unregister = menus.registration(MESH_OT_fairmesh_fill_holes, *_MENUS, select_modes=("VERT", "EDGE"))
_register_all, _unregister_all = menus.registration(MESH_OT_fairmesh_fill_all_holes, _MENUS[0])


def register():
    _register()
    _register_all()


def unregister():
    _unregister_all()
    _unregister()
