# SPDX-License-Identifier: GPL-3.0-or-later
"""A run of Fair Live in a window: events, frames, and what is shown."""

import math
import time
from dataclasses import replace

import numpy as np

from . import live_loops
from .live_edits import BULGE, MOVE, TILT, TWIST
from .live_preview import Preview, circle_curve, handle_curve, loop_curves
from .live_state import NAMES, LiveState
from .live_view import RADIANS, Drag, View
from .number_input import NumberInput

# A frame may take so long, and is made so often.
FRAME = 0.04
TICK = 1 / 60
# After so many seconds without a change the surface is sought from the beginning, where frames are stuck.
REST = 0.25
# A click so far from all loops, in pixels, is none on a loop.
NEAR = 60
_KINDS = {"T": TILT, "W": TWIST, "B": BULGE, "G": MOVE}
_WIDER, _NARROWER = {"WHEELDOWNMOUSE", "PAGE_UP"}, {"WHEELUPMOUSE", "PAGE_DOWN"}
_NAVIGATION = {"MIDDLEMOUSE", "TRACKPADPAN", "TRACKPADZOOM", "MOUSEROTATE", "NDOF_MOTION"}
_KEYS = (
    "Drag at a loop    Enter, click away: confirm    ESC: cancel    T: tilt    W: twist    B: bulge    G: move    "
    "Wheel: falloff    X: mirror    L: loop at the pointer    0-9: number    Shift: precise    "
    "Ctrl: 5\u00b0 steps    Ctrl Z: take back"
)

#: The last text in the header.
shown = ""
#: How many frames were made since the add-on was enabled.
frame_count = 0


class LiveRun:
    """What the operator does between its first surface and its end."""

    def __init__(self, context, operator, live, pointer):
        self.live = live
        self._operator = operator
        self._window_manager, self._workspace = context.window_manager, context.workspace
        self._view = View(context, live.mesh.object)
        self._number = NumberInput()
        # The pointer drags while the button is held. From a menu or the sidebar it has a way to go first.
        self._is_held = operator.hold
        self._settle_anew()
        self.state = self._first_state(pointer)
        self._preview = Preview(live.mesh)
        self._timer = self._window_manager.event_timer_add(TICK, window=context.window)
        self._workspace.status_text_set(_KEYS)
        self._begin_drag(pointer)
        self._show()

    def close(self):
        """Takes back all that is shown."""
        global shown
        self._preview.close()
        self._window_manager.event_timer_remove(self._timer)
        self._workspace.status_text_set(None)
        self._view.area.header_text_set(None)
        self._view.area.tag_redraw()
        shown = ""

    def put_in_force(self):
        """Hands the edits to the solver."""
        self.live.edit(self.state.edits.values(), self.state.axes)
        self._is_changed = False

    def _first_state(self, pointer):
        loop, vertex = self._first_loop(pointer)
        # With mirror editing both sides are edited alike from the start.
        state = LiveState(loop, vertex, axes=tuple(self._mirror_axes(only_if_on=True)))
        state.choose(self._operator.kind)
        return state

    def _first_loop(self, pointer):
        """That of the vertex asked for, of the active vertex (not as a tool), or the one nearest to the pointer."""
        for vertex in (self._operator.vertex, -1 if self._operator.hold else self._active_vertex()):
            loop = self.live.loop_with(vertex)
            if loop is not None:
                return loop, vertex
        found = self._nearest(pointer)
        if found is not None:
            return found[:2]
        return self.live.loops[0], int(self.live.loops[0].vertices[0])

    def _active_vertex(self):
        import bmesh

        active = bmesh.from_edit_mesh(self.live.mesh.object.data).select_history.active
        return active.index if isinstance(active, bmesh.types.BMVert) else -1

    def _nearest(self, event):
        positions = self.live.positions()[0]
        screen, pointer = self._view.on_screen(positions), self._view.inside(event)
        # Those behind the surface only where none is before it.
        before = np.where(self._view.faces(positions, self.live.normals())[:, None], screen, np.nan)
        return live_loops.nearest(self.live.loops, before, pointer) or live_loops.nearest(self.live.loops, screen, pointer)

    @property
    def _matrix(self):
        return self.live.mesh.object.matrix_world

    def _mirror_axes(self, only_if_on=False):
        data = self.live.mesh.object.data
        on = [axis for axis, name in enumerate("xyz") if getattr(data, f"use_mirror_{name}")]
        return on if on or only_if_on else [0]

    # Events.

    def take(self, event):
        """Answers an event as an operator does."""
        if event.type == "TIMER":
            self._make_frame()
        elif event.type == "MOUSEMOVE":
            self._move_pointer(event)
        elif event.type == "LEFTMOUSE":
            return self._take_button(event)
        elif event.type in _NAVIGATION or (event.ctrl and event.type in _WIDER | _NARROWER):
            return {"PASS_THROUGH"}
        elif event.value == "PRESS":
            return self._take_key(event)
        return {"RUNNING_MODAL"}

    def _take_button(self, event):
        if event.value == "PRESS":
            found = self._nearest(event)
            if found is None or found[2] > NEAR:
                return self._operator.confirm()
            self._is_held = True
            self.state.pick(*found[:2])
            self._begin_drag(event)
        elif event.value == "RELEASE":
            self._is_held = False
            self.state.remember()
        return {"RUNNING_MODAL"}

    def _take_key(self, event):
        key = event.type
        if key in {"ESC", "RIGHTMOUSE"}:
            return self._operator.abandon()
        if key in {"RET", "NUMPAD_ENTER"}:
            return self._operator.confirm()
        if key == "Z" and event.ctrl:
            if self.state.take_back():
                self._begin_drag(event)
        elif key in _KINDS:
            self.state.choose(_KINDS[key])
            self._begin_drag(event)
        elif key == "X":
            self.state.remember()
            self.state.axes = () if self.state.axes else tuple(self._mirror_axes())
        elif key == "L":
            self._pick(event)
        elif key in _WIDER | _NARROWER:
            self._widen(key in _WIDER)
        elif self._number.take(key):
            self._use_number()
        else:
            return {"RUNNING_MODAL"}
        self._settle_anew()
        self._show()
        return {"RUNNING_MODAL"}

    def _pick(self, event):
        found = self._nearest(event)
        if found is not None:
            self.state.pick(*found[:2])
            self._begin_drag(event)

    def _widen(self, is_wider):
        size, loop = self.live.mesh.size, self.state.loop
        self.state.widen(is_wider, size * loop.length / len(loop.vertices), size)

    def _begin_drag(self, event):
        self._number.clear()
        self._drag = Drag(self._view, event)
        self._start = self.state.current

    def _move_pointer(self, event):
        if not self._is_held or self._number.is_active:
            # The drag goes on from where the pointer is then.
            self._drag = Drag(self._view, event)
            self._start = self.state.current
            return
        self._drag.move(event)
        point = self.live.mesh.vertices[self.state.vertex]
        if self.state.kind == MOVE:
            way = self._view.way(point, self._drag.way)
            self.state.current = replace(self.state.current, way=tuple((way + self._start.way).tolist()))
        else:
            outward = self._view.outward(point, self.live.normal(self.state.vertex))
            angle = float(self._drag.way @ outward) * RADIANS
            self.state.turn(self._start, angle, event.ctrl)
        self._settle_anew()
        self._show_text()

    def _use_number(self):
        number = self._number.value or 0.0
        if self.state.kind == MOVE:
            # Along the normal there, in the unit of the scene.
            normal = self.live.normal(self.state.vertex)
            long = np.linalg.norm(np.array(self._matrix.to_3x3()) @ normal)
            way = tuple((normal * (number / max(long, 1e-300))).tolist())
            self.state.current = replace(self.state.current, way=way)
        else:
            self.state.turn(replace(self._start, angle=0.0), math.radians(number), False)

    # Frames.

    def _settle_anew(self):
        self._is_changed, self._is_settled, self._is_hopeless = True, False, False
        self._changed_at = time.monotonic()

    def _make_frame(self):
        global frame_count
        if self._is_changed:
            self.put_in_force()
        elif self._is_settled or self._is_hopeless:
            return
        if not self.live.is_stuck:
            self._is_settled = self.live.update(FRAME)
        elif time.monotonic() - self._changed_at > REST:
            self._is_settled = self.live.recover()
            self._is_hopeless = not self._is_settled
        frame_count += 1
        self._show()

    def _show(self):
        positions, moved = self.live.positions()
        self._preview.show(positions, moved)
        state = self.state
        curves = loop_curves(self.live, positions, state.loop, state.weights(self.live.mesh.size))
        if state.kind == BULGE:
            self._preview.curves = curves
        else:
            point, normal = positions[state.vertex], self.live.normal(state.vertex)
            curves.append(handle_curve(point, self._view.handle_end(point, normal)))
            if state.kind == MOVE and state.current.falloff > 0:
                curves.append(circle_curve(point, *self._view.axes(), state.current.falloff))
            self._preview.curves = curves
        self._redraw()
        self._show_text()

    def _redraw(self):
        # Not whole areas: with their bars and panels that takes much longer.
        for window in self._window_manager.windows:
            for area in window.screen.areas:
                for region in area.regions if area.type == "VIEW_3D" else ():
                    if region.type == "WINDOW":
                        region.tag_redraw()

    def _show_text(self):
        global shown
        state, edit = self.state, self.state.current
        parts = [f"{NAMES[state.kind]}: {self._value(edit)}"]
        if state.kind != BULGE and not state.loop.is_point:
            whole = "none" if state.kind == MOVE else "whole loop"
            parts.append(f"Falloff: {f'{edit.falloff:.3g}' if edit.falloff else whole}")
        if state.axes:
            parts.append("Mirror: " + "".join("XYZ"[axis] for axis in state.axes) + self._image_missing())
        parts.append(self._standing())
        text = "    ".join(parts)
        if text != shown:
            shown = text
            self._view.area.header_text_set(text)

    def _value(self, edit):
        if self._number.is_active:
            return self._number.text
        if edit.kind == MOVE:
            return f"{np.linalg.norm(np.array(self._matrix.to_3x3()) @ np.array(edit.way)):.4g}"
        return f"{math.degrees(edit.angle):.1f}\u00b0"

    def _image_missing(self):
        state = self.state
        found = state.kind == BULGE or any(self.live.image(state.vertex, axis) >= 0 for axis in state.axes)
        return "" if found else " (this loop has no mirror image)"

    def _standing(self):
        if self._is_settled:
            return "settled"
        if self.live.is_stuck:
            return "NOT SETTLED: the surface shown is not that of this value. Turn back a little"
        return "settling"
