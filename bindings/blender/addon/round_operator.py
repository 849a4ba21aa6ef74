# SPDX-License-Identifier: GPL-3.0-or-later
"""Edge > Round Edges."""

from dataclasses import dataclass
from math import degrees

import bmesh
import bpy
import numpy as np

from . import blend, custom_normals, fairmesh, menus, messages, snapshot
from .fairing_options import CurvatureOption
from .job import Background, for_each
from .round_options import RoundOptions


@dataclass
class _Chosen:
    mesh: snapshot.Snapshot
    #: The edges that are rounded, (k, 2).
    edges: np.ndarray
    #: The `fairmesh.Rounded` and its `blend.Change`.
    result: object = None


class MESH_OT_fairmesh_round_edges(Background, RoundOptions, CurvatureOption, bpy.types.Operator):
    """Rounds the selected edges of each object in Edit mode."""

    bl_idname = "mesh.fairmesh_round_edges"
    bl_label = "Round Edges"
    bl_description = (
        "Replace the selected edges by blends that go on smoothly from the faces beside them: between planes parts of "
        "cylinders, along curved faces and in corners the smoothest surface there is"
    )

    asks = "select sharp edges inside the surface"

    @classmethod
    def missing(cls, context):
        if not any(obj.data.total_edge_sel for obj in context.objects_in_mode_unique_data):
            return f"No edge is selected: {cls.asks}"
        return None

    def draw_options(self, layout):
        self.draw_round(layout)
        self.draw_continuity(layout)

    def prepare(self, context):
        least = self.least_angle
        chosen = []
        for mesh in map(snapshot.read, context.objects_in_mode_unique_data):
            edges = snapshot.selected_edges(mesh.object, _bends(mesh.object, least))
            if len(edges):
                chosen.append(_Chosen(mesh, edges))
        if not chosen:
            bend = f"no selected edge with two faces bends by more than {degrees(least):.0f} degrees"
            self.tell({"ERROR"}, f"Nothing to be rounded: {bend}; {self.asks}")
            return None
        # The thread reads no properties.
        size_keywords, continuity = self.size_keywords(), self.continuity

        def compute(each, monitor):
            seen, triangles = each.mesh.seen(), each.mesh.triangles
            rounded = fairmesh.round_edges(
                seen,
                triangles,
                edges=each.edges,
                labels=_labels(each.mesh),
                continuity=continuity,
                cancel=monitor,
                **size_keywords(each.mesh.size),
            )
            return rounded, blend.change(each.mesh, rounded)

        return for_each(chosen, compute)

    def finish(self, context, chosen):
        for each in chosen:
            why = _objection(each)
            if why is not None:
                self.tell({"ERROR"}, f"{messages.name_before(chosen, each)}{why}. The mesh is unchanged")
                return {"CANCELLED"}
            snapshot.edit_mesh(each.mesh)  # all are still there, before the first is changed
        bpy.ops.mesh.select_all(action="DESELECT")
        for each in chosen:
            custom_normals.mark(each.mesh)
            blend.add(each.mesh, *each.result)
            kind, text = messages.rounded(each.mesh, each.result[0])
            self.tell({kind}, messages.name_before(chosen, each) + text)
        custom_normals.put_back(each.mesh for each in chosen)
        return {"FINISHED"}


def _labels(mesh):
    """Of the triangles: a face of more than three corners keeps its boundary; a triangle does beside another material."""
    is_triangle = np.diff(mesh.corner_starts) == 3
    labels = np.where(is_triangle, mesh.materials, mesh.materials.max(initial=0) + 1 + np.arange(len(is_triangle)))
    return labels[mesh.face_of]


def _bends(obj, least):
    """Which edges have two faces that bend by more than this."""
    edges = bmesh.from_edit_mesh(obj.data).edges
    return np.fromiter((edge.calc_face_angle(0.0) > least for edge in edges), bool, len(edges))


def _objection(each):
    """Why a result is not to be written; None: it is."""
    rounded, made = each.result
    if not any(crease.is_rounded for crease in rounded.creases):
        return messages.rounded(each.mesh, rounded)[1]
    if each.mesh.face_hidden[made.erased].any():
        return "Blends would reach into hidden faces: show them (Alt-H), or round less"
    return None


register, unregister = menus.registration(
    MESH_OT_fairmesh_round_edges,
    "VIEW3D_MT_edit_mesh_edges",
    select_modes=("EDGE",),
)
