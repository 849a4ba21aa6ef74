# SPDX-License-Identifier: GPL-3.0-or-later
"""Mesh > Clean Up > Fair Live: fairs a region, and changes how the surface leaves its boundary while one looks."""

from types import SimpleNamespace

import bpy
import numpy as np
from bpy.props import BoolProperty, BoolVectorProperty, CollectionProperty, EnumProperty, IntProperty

from . import (
    advice,
    custom_normals,
    fair_operator,
    job,
    live_run,
    menus,
    messages,
    region,
    selected,
    snapshot,
    triangulation,
)
from .fairing_options import FairingOptions, RegionOptions
from .job import Background
from .live_edits import FAIRMESH_PG_live_edit
from .live_region import MOST_FREE, LiveRegion
from .live_state import NAMES
from .live_view import View

#: Its name in the tool bar.
TOOL = "fairmesh.live"

_running = set()


def is_running():
    """Whether one is being dragged in a window."""
    return bool(_running)


def is_tool(context):
    """Whether the tool is the one at hand."""
    if context.workspace is None:
        return False
    tool = context.workspace.tools.from_space_view3d_mode("EDIT_MESH", create=False)
    return tool is not None and tool.idname == TOOL


class MESH_OT_fairmesh_live(Background, RegionOptions, FairingOptions, bpy.types.Operator):
    """Fairs the selected region of the active object, and drags how the surface leaves its boundary."""

    bl_idname = "mesh.fairmesh_live"
    bl_label = "Fair Live"
    bl_description = (
        "Fair the selected region, and drag at its boundary loops how the surface leaves them: tilt, twist, bulge "
        "or move, while the surface follows"
    )

    edits: CollectionProperty(
        name="Edits",
        description="What is changed at the boundary, all relative to the fair surface",
        type=FAIRMESH_PG_live_edit,
        options={"SKIP_SAVE"},
    )
    mirror: BoolVectorProperty(
        name="Mirror",
        description="Every change is made at the mirror image of its boundary loop, too, where there is one",
        size=3,
        subtype="XYZ",
        options={"SKIP_SAVE"},
    )
    kind: EnumProperty(
        name="Kind",
        description="What dragging changes first",
        items=[(kind, name, f"Begin with {name}") for kind, name in NAMES.items()],
        options={"SKIP_SAVE", "HIDDEN"},
    )
    vertex: IntProperty(
        name="Vertex",
        description="A vertex of the boundary loop to begin with; -1: the one nearest to the pointer",
        default=-1,
        min=-1,
        options={"SKIP_SAVE", "HIDDEN"},
    )
    hold: BoolProperty(
        name="Hold",
        description="The left button is down already: the drag begins at once, as with the tool",
        options={"SKIP_SAVE", "HIDDEN"},
    )

    _run = None

    @classmethod
    def missing(cls, context):
        # A click with the tool has to say what is missing: it has no button that could be grey.
        return None if is_tool(context) and not selected.is_sidebar(context) else super().missing(context)

    def draw_options(self, layout):
        for each in self.edits:
            each.draw_edit(layout)
        layout.prop(self, "mirror")
        self.draw_region(layout)
        self.draw_fairing(layout)

    def prepare(self, context):
        mesh = snapshot.read(context.edit_object)
        free = region.free_mask(mesh, self.is_by_faces(context))
        count = np.count_nonzero(free)
        if not count:
            self.tell({"ERROR"}, ": ".join(self.nothing_free(context)))
            return None
        symmetry = region.Symmetry(mesh, free)
        mesh.triangles = triangulation.cut_evenly(mesh, free)
        live = LiveRegion(mesh, free, symmetry, self.fairing_keywords(region.diagonal(mesh, free)))
        if not live.loops:
            self.tell({"ERROR"}, "The region has no boundary: deselect something around what is to move")
            return None
        if count > MOST_FREE:
            text = advice.named(
                f"{count} vertices would move, too many to be dragged: select at most {MOST_FREE}, or use {{fairmesh_fair}}"
            )
            self.tell({"ERROR"}, text)
            return None

        def compute(monitor):
            with messages.about(mesh):
                live.start(monitor)
            return live

        return compute

    # Without a window, from scripts, and again with other options.

    def finish(self, context, live):
        """Puts the edits of the properties in force, and writes."""
        try:
            with messages.about(live.mesh):
                live.edit([each.get() for each in self.edits], [axis for axis in range(3) if self.mirror[axis]])
            return self._write(live)
        finally:
            live.close()

    def _write(self, live):
        with messages.about(live.mesh):
            live.finish()
        indices, positions = live.final()
        custom_normals.mark(live.mesh)
        snapshot.write_positions(live.mesh, indices, positions)
        custom_normals.put_back([live.mesh])
        fair_operator.last_reports[:] = [live.result.report]
        kind, text = messages.faired(live.result.report, self.asked_continuity())
        self.tell({kind}, text)
        fair_operator.remember(live)
        return {"FINISHED"}

    # With a window.

    def invoke(self, context, event):
        # The event is gone when this function returns.
        self._pointer = SimpleNamespace(mouse_x=event.mouse_x, mouse_y=event.mouse_y)
        self._is_modal = False
        return super().invoke(context, event)

    def _end(self, context):
        """The first surface is there."""
        if bpy.app.background or not View.is_there(context):
            return super()._end(context)
        return self._guarded(self._begin, context) or {"CANCELLED"}

    def _begin(self, context):
        self._run = live_run.LiveRun(context, self, self._job.result(), self._pointer)
        if not self._is_modal:
            context.window_manager.modal_handler_add(self)
        job.add_modal(self)
        _running.add(self)
        return {"RUNNING_MODAL"}

    def modal(self, context, event):
        self._is_modal = True
        if self._run is None:
            if event.type == "LEFTMOUSE" and event.value == "RELEASE":
                # Before there was a surface to drag.
                self.hold = False
            return super().modal(context, event)
        try:
            return self._guarded(self._run.take, event) or self._stop()
        except BaseException:
            # Blender forgets the operator: nothing may be left hidden.
            self._stop()
            raise

    def confirm(self):
        """Ends the run with what it has come to."""
        run = self._run
        self._set_properties(run.state)
        self.leave()
        try:
            run.put_in_force()
            return self._write(run.live)
        finally:
            run.live.close()

    def abandon(self):
        """Ends the run with the mesh as it was."""
        self._stop()
        self.tell({"INFO"}, f"{self.bl_label}: cancelled, nothing was changed")
        return {"CANCELLED"}

    def _stop(self):
        live = self._run.live if self._run is not None else None
        self.leave()
        if live is not None:
            live.close()
        return {"CANCELLED"}

    def cancel(self, context):
        if self._run is None:
            super().cancel(context)
        else:
            self._stop()

    def leave(self):
        if self._run is None:
            super().leave()
            return
        job.remove_modal(self)
        _running.discard(self)
        self._run.close()
        self._run = None

    def _set_properties(self, state):
        self.mirror = [axis in state.axes for axis in range(3)]
        self.edits.clear()
        for edit in state.edits.values():
            if not edit.is_nothing:
                self.edits.add().set(edit)


register, unregister = menus.registration(
    MESH_OT_fairmesh_live,
    "VIEW3D_MT_edit_mesh_clean",
    "VIEW3D_MT_edit_mesh_vertices",
    "VIEW3D_MT_edit_mesh_edges",
    "VIEW3D_MT_edit_mesh_faces",
    select_modes=("VERT", "EDGE", "FACE"),
)
