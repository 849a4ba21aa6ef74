# SPDX-License-Identifier: GPL-3.0-or-later
"""Mesh > Delete > Erase and Fill."""

import bpy
import numpy as np

from . import advice, fairmesh, filling, menus, messages, selected, snapshot
from .job import Background
from .patch_options import CleanOptions, OuterOptions, RimOptions

_NOTHING_LEFT = "nothing is left around the selected faces that a new surface could go on from"


class MESH_OT_fairmesh_erase_and_fill(
    Background, filling.Filling, RimOptions, CleanOptions, OuterOptions, bpy.types.Operator
):
    """Replaces the selected faces of each object in Edit mode."""

    bl_idname = "mesh.fairmesh_erase_and_fill"
    bl_label = "Erase and Fill"
    bl_description = (
        "Delete the selected faces, and close the holes with new triangles on a surface that goes on smoothly: "
        "for bumps, noise and tangles whose old shape is of no use"
    )

    asks = "select the faces that are to be replaced"

    @classmethod
    def missing(cls, context):
        chosen = [(count, every) for count, every in selected.faces(context) if count]
        if not chosen:
            return f"No face is selected: {cls.asks}"
        return None if any(count < every for count, every in chosen) else _NOTHING_LEFT.capitalize()

    def draw_options(self, layout):
        self.draw_outer(layout)
        self.draw_clean(layout)
        self.draw_rim(layout)
        self.draw_filling(layout)

    def prepare(self, context):
        every = [snapshot.read(obj) for obj in context.objects_in_mode_unique_data]
        meshes = [mesh for mesh in every if mesh.face_selected.any()]
        if not meshes:
            self.tell({"ERROR"}, f"No face is selected: {self.asks}")
            return None
        chosen = []
        for mesh in meshes:
            with messages.about(mesh):
                holes = _erased(mesh, self.clean_boundary)
            why = self._no_hole(holes)
            if why is not None:
                self.tell({"ERROR"}, f"{mesh.object.name}: {why}. The mesh is unchanged")
                return None
            chosen.append(holes)
        return self.work_on(chosen)

    def _no_hole(self, holes):
        """Why nothing is tried; None: it is."""
        loops = [loop for _, loop in holes.loops]
        if not loops:
            return _NOTHING_LEFT
        if not self.outer and any(loop.kind is fairmesh.LoopKind.OUTER_BOUNDARY for loop in loops):
            return "the selected faces lie at the outer boundary of the surface, which would be closed: " + advice.named(
                "deselect those there, or switch on {outer}"
            )
        if any(holes.mesh.vertex_hidden[loop.vertices].any() for loop in loops):
            return "a vertex around the selected faces is hidden"
        return None

    def objection(self, holes):
        # The old faces are better than none.
        still = [loop for loop in holes.result.loops if loop.outcome is fairmesh.FillOutcome.LEFT_OPEN]
        return messages.filled(still, holes.places())[1] if still else None


def _erased(mesh, clean):
    """The mesh without its selected faces, what would hang loose there, and `clean` more at most that would spoil the patch.

    Faces go as a whole.
    """
    gone = mesh.face_selected.copy()
    while True:
        left = fairmesh.erase(mesh.seen(), mesh.triangles, gone[mesh.face_of], clean=clean)
        clean = 0
        kept = np.zeros(len(mesh.triangles), bool)
        kept[left.kept_faces] = True
        cut = np.zeros(len(gone), bool)
        cut[mesh.face_of[~kept]] = True
        if (cut == gone).all():
            break
        gone = cut
    loops = fairmesh.boundary_loops(mesh.seen(), left.faces)
    return filling.Holes(mesh, [(int(i), loops[i]) for i in left.loops], left.faces, np.flatnonzero(gone))


register, unregister = menus.registration(
    MESH_OT_fairmesh_erase_and_fill,
    "VIEW3D_MT_edit_mesh_clean",
    "VIEW3D_MT_edit_mesh_delete",
    "VIEW3D_MT_edit_mesh_faces",
    select_modes=("FACE",),
)
