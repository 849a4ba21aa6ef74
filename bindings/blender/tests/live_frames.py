# SPDX-License-Identifier: GPL-3.0-or-later
"""Fair Live in Blender's window: what a frame costs at 13,000 free vertices, and that frames leave nothing behind.

Started by gui.sh under Xvfb. The window should be small: what software OpenGL takes for an empty scene is not the add-on's.
FAIRMESH_FRAMES: how many, 60 if nothing else is said.
"""

import math
import os
import sys
import time
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parent))
import bpy  # isort: skip
import common
import window
from common import part
from window import call, move, press, view, wait_until

COUNT = int(os.environ.get("FAIRMESH_FRAMES", "60"))
# Frames for each CPU second, of the add-on and the library alone. 28 to 31 were measured.
LEAST = 10
# MB that a thousand frames may leave.
MOST = 40


class Clock:
    """The CPU seconds that a function takes, that of other threads in the meantime included."""

    def __init__(self, owner, name):
        self.seconds = 0.0
        self._function = getattr(owner, name)
        setattr(owner, name, lambda *arguments: self._timed(*arguments))

    def _timed(self, *arguments):
        start = time.process_time()
        try:
            return self._function(*arguments)
        finally:
            self.seconds += time.process_time() - start


def steps():
    clocks = [Clock(part("live_run").LiveRun, name) for name in ("_make_frame", "_move_pointer")]
    # Its draw handler is the method of each preview.
    clocks.append(Clock(part("live_preview").Preview, "_draw"))
    common.clear()
    obj = common.irregular_sphere(57)
    free = common.flatten_cap(obj)
    space = view()["area"].spaces.active
    space.region_3d.view_distance = 4
    yield 1.0
    host = bpy.context.window_manager.windows[0]
    x, y = host.width // 2, host.height // 2
    move(x, y)
    yield 0.5
    run = part("live_run")
    assert call(bpy.ops.mesh.fairmesh_live, "INVOKE_DEFAULT", hold=True) == {"RUNNING_MODAL"}
    yield from wait_until(lambda: run.shown.endswith("settled"), 60)
    print(f"{len(free)} free vertices")
    for overlays in (True, False):
        space.overlay.show_overlays = overlays
        yield 0.5
        yield from measured(run, clocks, x, y, f"overlays {'shown' if overlays else 'hidden'}")
    press("ESC")
    yield from wait_until(lambda: not run.shown, 10)


def measured(run, clocks, x, y, name):
    """Drags up and down, a little at each frame."""
    first, step = run.frame_count, 0
    for clock in clocks:
        clock.seconds = 0.0
    start, before = time.process_time(), None
    while run.frame_count < first + COUNT:
        step += 1
        move(x, y + 60 * math.sin(step / 15))
        yield window.POLL
        # What is made once is there by then.
        if before is None and run.frame_count > first + COUNT // 4:
            before = common.memory()
    made = run.frame_count - first
    own = made / sum(clock.seconds for clock in clocks)
    more = common.memory() - before
    print(
        f"{made} frames, {name}: {own:.1f} for each CPU second of the add-on, "
        f"{made / (time.process_time() - start):.1f} with all that Blender draws; {more:+.1f} MB",
        flush=True,
    )
    assert own > LEAST, own
    assert more < MOST, more


window.run(steps())
