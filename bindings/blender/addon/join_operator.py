# SPDX-License-Identifier: GPL-3.0-or-later
"""Edge > Join Loops and Fair."""

import bpy

from . import fairmesh, filling, menus, messages
from .job import Background
from .patch_options import GuideOptions, JoinOptions, RimOptions, TrimOptions


class MESH_OT_fairmesh_join_loops(
    Background, filling.Filling, RimOptions, TrimOptions, GuideOptions, JoinOptions, bpy.types.Operator
):
    """Joins boundary loops of each object in Edit mode."""

    bl_idname = "mesh.fairmesh_join_loops"
    bl_label = "Join Loops and Fair"
    bl_description = (
        "Close the gap between the selected boundary loops with one surface that goes on smoothly from all of them: "
        "ends of tubes, the sides of a gap, a hole and the island in it"
    )

    asks = (
        "select two or more boundary loops of one object (Alt-click on an edge, Shift-Alt-click on others). "
        "Parts in several objects: join the objects first (Ctrl-J)"
    )

    @classmethod
    def lacks(cls, context, facts):
        return None if facts.loops > 1 else f"One loop alone is selected, or none: {cls.asks}"

    def draw_options(self, layout):
        self.draw_groups(layout)
        self.draw_guides(layout)
        self.draw_trim(layout)
        self.draw_rim(layout)
        self.draw_filling(layout)

    def prepare(self, context):
        meshes = [filling.read(obj) for obj in context.objects_in_mode_unique_data]
        for holes in meshes:
            self._choose(holes)
        chosen = [holes for holes in meshes if holes.join]
        if not chosen:
            self.tell({"ERROR"}, self._nothing(meshes))
            return None
        return self.work_on(chosen) if filling.guide(self, chosen) else None

    def _choose(self, holes):
        """Sets which loops are joined; none: an empty list."""
        mesh = holes.mesh
        selected = filling.selected(holes, at_least=2)
        shown = [(index, loop) for index, loop in selected if not mesh.vertex_hidden[loop.vertices].any()]
        if len(shown) < len(selected):
            holes.skipped.append((len(selected) - len(shown), "a vertex is hidden"))
        if self.trim and len(shown) > 1:
            holes.loops, shown = filling.trimmed(holes, shown, self.trim, self.trim_area)
        indices = [index for index, _ in shown]
        if self.groups == "AUTO" and len(indices) > 1:
            with messages.about(mesh):
                suggested = fairmesh.suggest_joins(mesh.seen(), holes.triangles, loops=indices)
            holes.join = [each.loops.tolist() for each in suggested]
        else:
            holes.join = [indices] if len(indices) > 1 else []

    def _nothing(self, meshes):
        for holes in meshes:
            for count, why in holes.skipped:
                return f"Nothing was joined, {count} left out: {why}"
        if self.groups == "AUTO":
            return "No two loops have a common patch that bends less than patches of their own: select those to be joined"
        return f"One loop alone is selected, or none: {self.asks}"

    def finish(self, context, chosen):
        # Where nothing became of any group, the mesh stays as it is, selection included.
        done = [holes for holes in chosen if holes.result.new_face_count]
        for holes in chosen:
            if holes not in done:
                text = messages.filled(holes.result.loops, holes.places())[1]
                self.tell({"WARNING" if done else "ERROR"}, messages.name_before(chosen, holes) + text)
            filling.remember_refused(holes)
        return self.write(done) if done else {"CANCELLED"}


register, unregister = menus.registration(
    MESH_OT_fairmesh_join_loops,
    "VIEW3D_MT_edit_mesh_clean",
    "VIEW3D_MT_edit_mesh_edges",
    select_modes=("EDGE",),
)
