# SPDX-License-Identifier: GPL-3.0-or-later
"""Runs the library on a thread of its own, so that Blender stays alive, and the operators' part of that.

The library does not hold Python's interpreter lock while it works. Nothing of Blender is touched on the thread: it gets
arrays and leaves arrays.
"""

import threading

import bpy

from . import fairmesh, found, messages, native, selected, snapshot

# A run shorter than this shows no progress.
AT_ONCE = 0.1
TICK = 0.05
# Navigation goes on while the library works.
_NAVIGATION = {"MIDDLEMOUSE", "WHEELUPMOUSE", "WHEELDOWNMOUSE", "WHEELINMOUSE", "WHEELOUTMOUSE", "TRACKPADPAN",
               "TRACKPADZOOM", "MOUSEROTATE", "NDOF_MOTION"}  # fmt: skip

_running = set()
#: The last text in the status bar.
shown = ""


class Job:
    """A function `work(monitor)` on a thread; `monitor` is a `fairmesh.Monitor`."""

    def __init__(self, work):
        self.monitor = fairmesh.Monitor()
        self._work = work
        self._result = None
        self._error = None
        self._thread = threading.Thread(target=self._run, name="fairmesh", daemon=True)

    def start(self):
        _running.add(self)
        self._thread.start()

    def _run(self):
        try:
            self._result = self._work(self.monitor)
        except BaseException as why:  # raised again where the result is asked for
            self._error = why
        finally:
            _running.discard(self)

    def wait(self, seconds=None):
        """Waits until the work is done, at most so long; True: it is."""
        self._thread.join(seconds)
        return not self._thread.is_alive()

    def result(self):
        """What the function returned; raises what it raised."""
        if self._error is not None:
            raise self._error
        return self._result


def for_each(parts, compute):
    """A function for a `Job`: sets the `result` of each of `parts` to `compute(part, monitor)`, and returns them.

    A part has the `Snapshot` that it is of as `mesh`: errors are about that.
    """

    def work(monitor):
        for part in parts:
            with messages.about(part.mesh, getattr(part, "face_of", None)):
                part.result = compute(part, monitor)
        return parts

    return work


def stop_all():
    """Stops all threads and waits for them."""
    for job in list(_running):
        job.monitor.cancel()
    for job in list(_running):
        job.wait()
    for operator in list(_modal):
        operator.leave()


_modal = set()


def add_modal(operator):
    """`operator.leave()` is called when the add-on is disabled."""
    _modal.add(operator)


def remove_modal(operator):
    _modal.discard(operator)


class Background:
    """Mixed into operators that compute: modal with progress and ESC from the interface, at once from scripts and F9.

    They are operators of Edit mode. Each has `asks`, what is to be selected, and `lacks(context, facts)`, what then is
    missing for a button of the sidebar, or None; `prepare(context)`, which reads and returns a function `work(monitor)`, or
    reports and returns None; `finish(context, result)`, which writes, reports and returns what an operator returns; and
    `draw_options(layout)`.
    """

    bl_options = {"REGISTER", "UNDO", "PRESET"}

    @classmethod
    def poll(cls, context):
        why = cls.missing(context) if context.mode == "EDIT_MESH" else "Works in Edit mode: press Tab"
        if why:
            # The button's tooltip says it.
            cls.poll_message_set(why)
        return not why

    @classmethod
    def missing(cls, context):
        """What has to be selected first, a sentence; None: it can run."""
        if not selected.vertices(context):
            return f"Nothing is selected: {cls.asks}"
        facts = selected.facts(context)
        return cls.lacks(context, facts) if facts is not None else None

    def draw(self, context):
        layout = self.layout
        layout.use_property_split = True
        self.draw_options(layout)

    def tell(self, kind, text):
        """Reports, and leaves the whole text in the sidebar: the status bar cuts it."""
        found.say(bpy.context, kind, text)
        self.report(kind, text)

    def execute(self, context):
        work = self._guarded(self._prepare, context)
        if work is None:
            return {"CANCELLED"}
        return self._guarded(lambda: self.finish(context, work(fairmesh.Monitor()))) or {"CANCELLED"}

    def invoke(self, context, event):
        work = self._guarded(self._prepare, context)
        if work is None:
            return {"CANCELLED"}
        self._job = Job(work)
        self._job.start()
        if bpy.app.background or context.window is None:
            self._job.wait()
        if self._job.wait(AT_ONCE):
            return self._end(context)
        self._window_manager = context.window_manager
        self._workspace = context.workspace
        self._timer = self._window_manager.event_timer_add(TICK, window=context.window)
        self._window_manager.progress_begin(0, 100)
        self._window_manager.modal_handler_add(self)
        _modal.add(self)
        return {"RUNNING_MODAL"}

    def modal(self, context, event):
        if event.type == "ESC" and event.value == "PRESS":
            return self._escape()
        if event.type == "TIMER":
            if self._job.wait(0):
                self.leave()
                return self._end(context)
            self._show()
        # Anything else could change the mesh.
        return {"PASS_THROUGH"} if event.type in _NAVIGATION else {"RUNNING_MODAL"}

    def cancel(self, context):
        """Blender ends the operator: the window was closed, another file loaded."""
        self._job.monitor.cancel()
        self.leave()

    def leave(self):
        """Takes back what `invoke` put into Blender's interface."""
        if self not in _modal:
            return
        _modal.discard(self)
        self._window_manager.event_timer_remove(self._timer)
        self._window_manager.progress_end()
        self._workspace.status_text_set(None)

    def _prepare(self, context):
        native.load()
        found.begin()
        return self.prepare(context)

    def _show(self):
        global shown
        monitor = self._job.monitor
        self._window_manager.progress_update(int(100 * monitor.fraction))
        iteration = f", iteration {monitor.iteration}" if monitor.iteration else ""
        shown = f"{self.bl_label}: {100 * monitor.fraction:.0f} %, {monitor.phase}{iteration}     ESC: cancel"
        self._workspace.status_text_set(shown)

    def _escape(self):
        # The thread ends before its next iteration; its result is nobody's then.
        self._job.monitor.cancel()
        self.leave()
        self.tell({"INFO"}, f"{self.bl_label}: cancelled, nothing was changed")
        return {"CANCELLED"}

    def _end(self, context):
        return self._guarded(lambda: self.finish(context, self._job.result())) or {"CANCELLED"}

    def _guarded(self, function, *arguments):
        """None where something is wrong, after it was reported."""
        try:
            return function(*arguments)
        except fairmesh.FairmeshError as why:
            self.tell({"ERROR"}, messages.refused(why, getattr(why, "subject", None)))
        except (fairmesh.LibraryError, MemoryError) as why:
            self.tell({"ERROR"}, f"{self.bl_label}: {why}")
        except snapshot.Stale:
            self.tell({"ERROR"}, f"{self.bl_label}: the mesh was changed meanwhile, nothing was written. Run it again")
        return None
