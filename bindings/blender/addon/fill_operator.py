# SPDX-License-Identifier: GPL-3.0-or-later
"""Mesh > Clean Up > Fill Hole and Fair."""

from dataclasses import dataclass, field

import bpy
import numpy as np
from bpy.props import BoolProperty, EnumProperty, FloatProperty, IntProperty

from . import fairmesh, found, messages, patch, snapshot
from .job import Background
from .settings import FairingOptions


@dataclass
class Holes:
    """What is to be filled of one object."""

    mesh: snapshot.Snapshot
    loops: list
    #: Loops that are left out although they are meant: (how many, why).
    skipped: list = field(default_factory=list)
    result: object = None


class MESH_OT_fairmesh_fill_holes(Background, FairingOptions, bpy.types.Operator):
    """Fills holes of each object in Edit mode."""

    bl_idname = "mesh.fairmesh_fill_holes"
    bl_label = "Fill Hole and Fair"
    bl_description = (
        "Close holes with new triangles as large as those around them, on a surface that goes on smoothly: "
        "holes all of whose edges are selected; if there is none, holes with a selected edge or vertex"
    )
    bl_options = {"REGISTER", "UNDO"}

    scope: EnumProperty(
        name="Holes",
        description="Which holes are filled. Those with hidden vertices stay open",
        items=(
            ("SELECTED", "Selected", "Holes whose boundaries are selected, or touched by the selection"),
            ("ALL", "All", "All holes of the mesh, up to a size"),
        ),
        default="SELECTED",
    )
    max_edges: IntProperty(
        name="Largest Hole",
        description="With All: holes of more edges stay open. 0: holes of any size are filled",
        default=0,
        min=0,
    )
    outer: BoolProperty(
        name="Outer boundaries, Too",
        description="Also fill the outer boundary of an open surface, not only gaps in it",
        default=False,
    )
    density: FloatProperty(
        name="Density",
        description="1: new edges are as long as those around the hole; 2: half as long",
        default=1.0,
        min=0.1,
        max=7.0,
        soft_min=0.5,
        soft_max=4.0,
    )
    smooth: BoolProperty(
        name="Fair",
        description="Make the patch a smooth continuation of its surroundings. Off: it stays as triangulated",
        default=True,
    )

    @classmethod
    def poll(cls, context):
        return context.mode == "EDIT_MESH"

    def draw(self, context):
        layout = self.layout
        layout.use_property_split = True
        layout.prop(self, "scope")
        if self.scope == "ALL":
            layout.prop(self, "max_edges")
        layout.prop(self, "outer")
        layout.prop(self, "density")
        layout.prop(self, "smooth")
        if self.smooth:
            self.draw_fairing(layout)

    def prepare(self, context):
        found.remember(None)
        meshes = [self._holes(obj) for obj in context.objects_in_mode_unique_data]
        chosen = [holes for holes in meshes if holes.loops]
        if not chosen:
            self.report({"ERROR"}, self._nothing(meshes))
            return None

        # The library's factor: the square root of 2 is as long as around the hole. The thread reads no properties.
        density, smooth = self.density * np.sqrt(2.0), self.smooth
        keywords = self.fairing_keywords(_size(chosen))

        def work(monitor):
            for holes in chosen:
                with messages.about(holes.mesh):
                    holes.result = fairmesh.fill_holes(
                        holes.mesh.seen(),
                        holes.mesh.triangles,
                        loops=[index for index, _ in holes.loops],
                        density=density,
                        fair=smooth,
                        cancel=monitor,
                        **keywords,
                    )
            return chosen

        return work

    def _holes(self, obj):
        mesh = snapshot.read(obj)
        with messages.about(mesh):
            loops = list(enumerate(fairmesh.boundary_loops(mesh.seen(), mesh.triangles)))
        holes = Holes(mesh, loops)
        if self.scope == "SELECTED":
            holes.loops = _selected(mesh, loops)
        self._leave_out(holes, "a vertex is hidden", lambda loop: mesh.vertex_hidden[loop.vertices].any())
        if not self.outer:
            self._leave_out(
                holes,
                'it is the outer boundary of an open surface: switch on "Outer boundaries, Too" to fill it',
                lambda loop: loop.kind is fairmesh.LoopKind.OUTER_BOUNDARY,
            )
        if self.scope == "ALL" and self.max_edges:
            self._leave_out(holes, "it is larger than Largest Hole", lambda loop: len(loop.vertices) > self.max_edges)
        return holes

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
            return (
                "No hole is selected: select boundary edges of a hole (Alt-click on one), "
                "or use Fill All Holes in the sidebar"
            )
        return "The mesh has no hole"

    def finish(self, context, chosen):
        for holes in chosen:
            snapshot.edit_mesh(holes.mesh)  # all are still there, before the first is changed
        bpy.ops.mesh.select_all(action="DESELECT")
        for holes in chosen:
            patch.add(holes.mesh, holes.result)
            kind, text = messages.filled(holes.result.loops, self.continuity)
            name = f"{holes.mesh.object.name}: " if len(chosen) > 1 else ""
            for count, why in holes.skipped:
                text += f"; {count} left open: {why}"
            self.report({kind}, name + text)
        return {"FINISHED"}


def _selected(mesh, loops):
    """Loops whose edges are all selected; else those with a selected edge; else those with a selected vertex."""
    selected = _keys(snapshot.selected_edges(mesh.object), len(mesh.vertices))
    marks = []
    for _, loop in loops:
        ends = np.stack([loop.vertices, np.roll(loop.vertices, -1)], axis=1)
        edges = np.isin(_keys(ends, len(mesh.vertices)), selected)
        marks.append((edges.all(), edges.any(), mesh.vertex_selected[loop.vertices].any()))
    for level in range(3):
        chosen = [loop for loop, mark in zip(loops, marks) if mark[level]]
        if chosen:
            return chosen
    return []


def _keys(edges, count):
    """A number for each edge, the same for both directions."""
    edges = edges.astype(np.int64)
    return edges.min(axis=1) * count + edges.max(axis=1)


def _size(chosen):
    """The largest extent of the holes, for the constant of the target."""
    extents = [np.ptp(holes.mesh.seen()[loop.vertices], axis=0) for holes in chosen for _, loop in holes.loops]
    return max(float(np.linalg.norm(extent)) for extent in extents)


def _menu(self, context):
    self.layout.operator(MESH_OT_fairmesh_fill_holes.bl_idname)


_MENUS = ("VIEW3D_MT_edit_mesh_clean", "VIEW3D_MT_edit_mesh_faces", "VIEW3D_MT_edit_mesh_context_menu")


def register():
    bpy.utils.register_class(MESH_OT_fairmesh_fill_holes)
    for menu in _MENUS:
        getattr(bpy.types, menu).append(_menu)


def unregister():
    for menu in _MENUS:
        getattr(bpy.types, menu).remove(_menu)
    bpy.utils.unregister_class(MESH_OT_fairmesh_fill_holes)
