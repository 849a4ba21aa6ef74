# SPDX-License-Identifier: GPL-3.0-or-later
"""Edge > Bridge Edges and Fair."""

import bpy
import numpy as np

from . import advice, fairmesh, filling, menus, messages, snapshot
from .job import Background, for_each
from .patch_options import BridgeOptions


class MESH_OT_fairmesh_bridge(Background, filling.Filling, BridgeOptions, bpy.types.Operator):
    """Connects two runs of boundary edges of each object in Edit mode."""

    bl_idname = "mesh.fairmesh_bridge"
    bl_label = "Bridge Edges and Fair"
    bl_description = (
        "Connect two selected runs of boundary edges by a strip that goes on smoothly from both: across a hole, which is "
        "divided, or between two parts"
    )

    asks = "select two runs of boundary edges of one object, each without a gap, that do not touch each other"

    @classmethod
    def lacks(cls, context, facts):
        has_width = context.scene.fairmesh.width > 0
        if any(len(_runs(beside)) == 2 for beside in facts.beside) or (has_width and facts.is_open):
            return None
        return _refusal(facts.beside)

    def draw_options(self, layout):
        self.draw_bridge(layout)
        self.draw_filling(layout)

    def prepare(self, context):
        chosen = []
        meshes = [snapshot.read(obj) for obj in context.objects_in_mode_unique_data]
        for mesh in meshes:
            runs = _runs(_beside(mesh))
            if self.width > 0 and not runs:
                runs = _single(mesh)
            if len(runs) == 2:
                chosen.append(filling.Holes(mesh, [], mesh.triangles, join=runs))
        if not chosen:
            self.tell({"ERROR"}, _refusal([_beside(mesh) for mesh in meshes]))
            return None
        # The thread reads no properties.
        fill_rest, width = self.fill_rest, self.width
        marked_keywords = self.marked_keywords()
        keywords = self.patch_keywords(filling.largest_diagonal((each.mesh, np.concatenate(each.join)) for each in chosen))

        def compute(each, monitor):
            mesh = each.mesh
            long = width / mesh.size if width > 0 else None
            return fairmesh.bridge(
                mesh.seen(),
                mesh.triangles,
                *each.join,
                width=long,
                fill=fill_rest,
                cancel=monitor,
                **keywords,
                **marked_keywords(mesh),
            )

        return for_each(chosen, compute)

    def objection(self, each):
        strip = each.result.strip
        if strip.outcome is not fairmesh.FillOutcome.LEFT_OPEN:
            return None
        return f"No bridge was made: {messages.reason(strip, {})}"

    def told(self, each):
        return messages.bridged(each.result, self.smooth)


def _refusal(meshes):
    """Why there are no two runs in any of the meshes, of which each is told as by `_beside`."""
    if any(beside and all(len(others) == 2 for others in beside.values()) for beside in meshes):
        return advice.named(
            "Whole loops are selected: for these there is {fairmesh_join_loops}. A bridge is for parts of loops"
        )
    return f"These are not two runs of edges: {MESH_OT_fairmesh_bridge.asks}"


def _beside(mesh):
    """Per vertex of selected boundary edges, those at their other ends."""
    beside = {}
    for a, b in snapshot.selected_edges(mesh.object, mesh.edge_faces == 1).tolist():
        beside.setdefault(a, []).append(b)
        beside.setdefault(b, []).append(a)
    return beside


def _runs(beside):
    """The runs of selected boundary edges: their vertices, one after the other."""
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


def _single(mesh):
    """The selected boundary vertices, each as a run of its own."""
    return [[vertex] for vertex in np.flatnonzero(mesh.vertex_selected & mesh.on_boundary).tolist()]


register, unregister = menus.registration(
    MESH_OT_fairmesh_bridge,
    "VIEW3D_MT_edit_mesh_clean",
    "VIEW3D_MT_edit_mesh_edges",
    select_modes=("EDGE",),
)
