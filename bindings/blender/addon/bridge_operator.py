# SPDX-License-Identifier: GPL-3.0-or-later
"""Edge > Bridge Edges and Fair."""

import bpy
import numpy as np
from bpy.props import BoolProperty

from . import fairmesh, filling, menus, messages, snapshot
from .job import Background, for_each


class MESH_OT_fairmesh_bridge(Background, filling.Filling, bpy.types.Operator):
    """Connects two runs of boundary edges of each object in Edit mode."""

    bl_idname = "mesh.fairmesh_bridge"
    bl_label = "Bridge Edges and Fair"
    bl_description = (
        "Connect two selected runs of boundary edges by a strip that goes on smoothly from both: across a hole, which is "
        "divided, or between two parts"
    )
    bl_options = {"REGISTER", "UNDO"}

    fill_rest: BoolProperty(
        name="Fill the Rest",
        description="Also fill the holes that the strip leaves beside it; all that is new is faired together",
        default=False,
    )

    def draw_options(self, layout):
        layout.prop(self, "fill_rest")
        self.draw_filling(layout)

    def prepare(self, context):
        chosen = []
        for obj in context.objects_in_mode_unique_data:
            mesh = snapshot.read(obj)
            runs = _runs(mesh)
            if len(runs) == 2:
                chosen.append(filling.Holes(mesh, [], mesh.triangles, join=runs))
        if not chosen:
            self.report(
                {"ERROR"},
                "Select two runs of boundary edges of one object, each without a gap, that do not touch each other",
            )
            return None
        # The thread reads no properties.
        fill_rest = self.fill_rest
        keywords = self.patch_keywords(filling.largest_diagonal((each.mesh, np.concatenate(each.join)) for each in chosen))

        def compute(each, monitor):
            mesh = each.mesh
            return fairmesh.bridge(mesh.seen(), mesh.triangles, *each.join, fill=fill_rest, cancel=monitor, **keywords)

        return for_each(chosen, compute)

    def objection(self, each):
        strip = each.result.strip
        if strip.outcome is not fairmesh.FillOutcome.LEFT_OPEN:
            return None
        advice = f". {messages.TURN}" if strip.reason is fairmesh.FillReason.OPPOSITE_SIDES else ""
        return f"No bridge was made: {strip.reason.text}{advice}"

    def told(self, each):
        return messages.bridged(each.result, self.smooth)


def _runs(mesh):
    """The runs of selected boundary edges: their vertices, one after the other."""
    edges = snapshot.selected_edges(mesh.object, mesh.edge_faces == 1)
    beside = {}
    for a, b in edges.tolist():
        beside.setdefault(a, []).append(b)
        beside.setdefault(b, []).append(a)
    runs = []
    ends = [v for v, others in beside.items() if len(others) == 1]
    seen = set()
    for end in ends:
        if end in seen:
            continue
        run = [end]
        while True:
            seen.add(run[-1])
            onward = [v for v in beside[run[-1]] if v not in seen]
            if not onward:
                break
            run.append(onward[0])
        runs.append(run)
    # Closed runs, and those that branch, have no end or several.
    return runs if len(seen) == len(beside) else []


register, unregister = menus.registration(
    MESH_OT_fairmesh_bridge,
    "VIEW3D_MT_edit_mesh_edges",
    "VIEW3D_MT_edit_mesh_context_menu",
)
