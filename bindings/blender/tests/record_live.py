# SPDX-License-Identifier: GPL-3.0-or-later
"""Records Fair Live at work on the blend of three tubes, as pictures of the window, for recording.sh."""

import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parent))
import bpy  # isort: skip
import common
import numpy as np
import window
from common import part
from mathutils import Euler
from window import button, call, move, on_screen, picture, press, view, wait_until

# Pictures of a drag, and how far it goes, in pixels.
STEPS, FAR = 11, 110


def scene():
    """Three tubes, joined by a patch that is selected then."""
    common.clear()
    mouths = (
        (0.5, (-1.6, 0, -0.4), (-0.7, 0, -0.2)),
        (0.5, (1.6, 0, -0.4), (0.7, 0, -0.2)),
        (0.5, (0, 0, 1.7), (0, 0, 0.9)),
    )
    obj = common.tubes(*mouths)
    common.select_boundary(obj, lambda e: np.linalg.norm(e.verts[0].co) < 1.2)
    assert call(bpy.ops.mesh.fairmesh_join_loops, density=1.3) == {"FINISHED"}
    call(bpy.ops.mesh.select_mode, type="FACE")
    space = view()["area"].spaces.active
    space.show_region_ui = False
    space.overlay.show_cursor = space.overlay.show_text = False
    space.show_gizmo_navigate = False
    space.region_3d.view_rotation = Euler((1.25, 0, 0.35)).to_quaternion()
    space.region_3d.view_location = (0, 0, 0.3)
    space.region_3d.view_distance = 5.2
    return obj


class Camera:
    """Takes a picture when the surface has settled and is drawn."""

    def __init__(self):
        self.count = 0

    def take(self, settle=True):
        if settle:
            yield 0.1
            yield from wait_until(lambda: part("live_run").shown.endswith("settled"), 60)
        yield 0.6
        picture(f"live_{self.count:03d}")
        self.count += 1


def there_and_back(steps):
    return [np.sin(np.pi * step / steps) for step in range(steps + 1)]


def steps():
    call(bpy.ops.screen.screen_full_area)
    yield 1.0
    obj = scene()
    call(bpy.ops.wm.tool_set_by_id, name="fairmesh.live")
    yield 2.0
    camera = Camera()
    yield from camera.take(settle=False)
    snapshot, region = part("snapshot"), part("region")
    mesh = snapshot.read(obj)
    loops = part("live_loops").loops_of(mesh, region.free_mask(mesh, True))
    assert len(loops) == 3
    for name in ("left", "top"):
        side = (-1, 0, 0) if name == "left" else (0, 0, 1)
        loop = max(loops, key=lambda each: common.coordinates(obj)[each.vertices].mean(axis=0) @ side)
        vertex = max(loop.vertices, key=lambda v: common.coordinates(obj)[v] @ (-0.3, -0.9, 0.4))
        x, y = on_screen(obj, common.coordinates(obj)[vertex])
        move(x, y)
        yield 0.5
        button("PRESS", x, y)
        yield from camera.take()
        # Along the handle.
        run = next(iter(part("live_operator")._running))._run
        way = FAR * run._view.outward(mesh.vertices[vertex], run.live.normal(vertex))
        for share in there_and_back(STEPS)[1 : STEPS // 2 + 2] if name == "left" else there_and_back(STEPS)[1:]:
            move(x + way[0] * share, y + way[1] * share)
            yield from camera.take()
        button("RELEASE", x, y)
        yield 0.3
    press("B")
    button("PRESS", x, y)
    for share in there_and_back(STEPS)[1:]:
        move(x + way[0] * share, y + way[1] * share)
        yield from camera.take()
    button("RELEASE", x, y)
    yield 0.2
    press("RET")
    yield 0.5
    yield from camera.take(settle=False)
    print(f"{camera.count} pictures")


window.run(steps())
