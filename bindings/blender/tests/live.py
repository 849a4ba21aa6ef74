# SPDX-License-Identifier: GPL-3.0-or-later
"""Fair Live in Blender's window: dragging, wheel, numbers, mirror, ESC, Enter, undo, redo; as a tool.

Started by gui.sh under Xvfb, as gui.py is.
"""

import math
import os
import sys
import time
import unittest.mock
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parent))
import bmesh

import bpy  # isort: skip
import common
import numpy as np
import window
from common import part
from window import button, call, move, on_screen, picture, press, view, wait_until


def middle():
    """Of the view, in the window."""
    region = view()["region"]
    return region.x + region.width // 2, region.y + region.height // 2


def run_of():
    """The run in the window, None where there is none."""
    return next(iter(part("live_operator")._running), None)


def state():
    return run_of()._run.state


def header():
    return part("live_run").shown


def settled():
    return run_of() is not None and header().endswith("settled")


def scene(make=lambda: common.irregular_sphere(24), height=0.2):
    """A sphere with its cap flat and selected."""
    common.clear()
    obj = make()
    common.flatten_cap(obj, height)
    set_view()
    return obj


def set_view():
    space = view()["area"].spaces.active
    space.show_region_ui = False
    space.overlay.show_extras = False
    space.region_3d.view_distance = 4.5
    space.region_3d.view_location = (0, 0, 0.3)
    with bpy.context.temp_override(**view()):
        bpy.ops.ed.undo_push(message="scene")


def begin(**properties):
    """Starts the operator as a menu does, with the pointer in the middle."""
    move(*middle())
    yield 0.2
    assert call(bpy.ops.mesh.fairmesh_live, "INVOKE_DEFAULT", **properties) == {"RUNNING_MODAL"}
    yield from wait_until(settled, 30)


def drag(dx, dy, steps=5, pressed=True, **modifiers):
    """From the vertex that is edited, with the button held."""
    live, vertex = run_of()._run.live, state().vertex
    x, y = on_screen(live.mesh.object, live.positions()[0][vertex])
    move(x, y)
    yield 0.1
    if pressed:
        button("PRESS", x, y)
        yield 0.1
    for step in range(1, steps + 1):
        move(x + dx * step / steps, y + dy * step / steps, **modifiers)
        yield 0.1
    if pressed:
        button("RELEASE", x + dx, y + dy)
        yield 0.1
    yield from wait_until(settled, 30)


def flags(obj):
    """All that ESC has to leave as it was."""
    mesh = bmesh.from_edit_mesh(obj.data)
    lists = [[(e.select, e.hide) for e in kind] for kind in (mesh.verts, mesh.edges, mesh.faces)]
    return (
        lists,
        [type(e).__name__ + str(e.index) for e in mesh.select_history],
        mesh.faces.active and mesh.faces.active.index,
    )


def angle():
    return math.degrees(state().current.angle)


def steps():
    only = os.environ.get("FAIRMESH_ONLY", "")
    every = (
        tilt_and_undo,
        escape,
        wheel_and_numbers,
        bulge_twist_move_mirror,
        too_far,
        tool,
        released_early,
        closed_by_the_addon,
    )
    for each in every:
        if only in each.__name__:
            yield from each()


def tilt_and_undo():
    """A drag changes what is shown, not the mesh; Enter writes it, in one step of undo."""
    obj = scene()
    name, before = obj.name, common.coordinates(obj)
    yield 0.5
    yield from begin()
    picture("live_first")
    # On the way from the menu nothing changes yet.
    yield from drag(60, 100, pressed=False)
    assert angle() == 0.0, angle()
    yield from drag(0, 100)
    assert np.array_equal(common.coordinates(obj), before), "the mesh was changed before Enter"
    dragged = angle()
    assert abs(dragged) > 3, dragged
    assert header().startswith("Tilt: ") and "settled" in header(), header()
    picture("live_tilt")
    press("RET")
    yield from wait_until(lambda: run_of() is None, 10)
    yield 0.3
    after = common.coordinates(obj)
    assert not any(hide for kind in flags(obj)[0] for _, hide in kind), "something is hidden"
    picture("live_tilted")
    assert np.abs(after - before).max() > 0.01
    last = bpy.context.window_manager.operators[-1]
    assert last.bl_idname == "MESH_OT_fairmesh_live" and len(last.edits) == 1
    assert abs(math.degrees(last.edits[0].angle) - dragged) < 1e-3
    press("Z", ctrl=True)
    yield 0.7
    assert np.array_equal(common.coordinates(bpy.data.objects[name]), before), "one undo does not bring the mesh back"
    press("Z", ctrl=True, shift=True)
    yield 0.7
    assert np.array_equal(common.coordinates(bpy.data.objects[name]), after), "redo does not bring the result back"


def set_active_face(obj):
    mesh = bmesh.from_edit_mesh(obj.data)
    mesh.faces.active = next(f for f in mesh.faces if f.select)
    mesh.select_history.add(mesh.faces.active)


def escape():
    for way in ("ESC", "RIGHTMOUSE"):
        obj = scene(lambda: common.uv_sphere(48, 24))
        set_active_face(obj)
        before, were = common.coordinates(obj), flags(obj)
        yield 0.3
        yield from begin()
        yield from drag(30, 80)
        press(way)
        yield from wait_until(lambda: run_of() is None, 10)
        yield 0.3
        assert np.array_equal(common.coordinates(obj), before), f"{way} has changed the mesh"
        assert flags(obj) == were, f"{way} has changed the selection, or what is hidden"
    picture("live_escaped")


def wheel_and_numbers():
    obj = scene()
    name = obj.name
    yield 0.3
    yield from begin()
    assert "whole loop" in header(), header()
    for _ in range(4):
        press("WHEELUPMOUSE")
        yield 0.1
    reach = state().current.falloff
    assert 0 < reach < state().loop.length / 3, reach
    yield from drag(0, 70)
    picture("live_falloff")
    for _ in range(12):
        press("WHEELDOWNMOUSE")
        yield 0.05
    assert "whole loop" in header(), header()
    vertex = state().vertex
    for key in ("MINUS", "ONE", "TWO", "NUMPAD_PERIOD", "NUMPAD_5"):
        press(key)
        yield 0.1
    assert "-12.5|" in header() and abs(angle() + 12.5) < 1e-9, (header(), angle())
    # The pointer does nothing now.
    yield from drag(50, 50, pressed=False)
    assert abs(angle() + 12.5) < 1e-9
    press("BACK_SPACE")
    press("BACK_SPACE")
    yield 0.2
    assert abs(angle() + 12) < 1e-9, angle()
    yield from wait_until(settled, 30)
    press("NUMPAD_ENTER")
    yield from wait_until(lambda: run_of() is None, 10)
    yield 0.3
    written = common.coordinates(bpy.data.objects[name])
    # The panel of the last operator runs it again, without the window: the same.
    assert call(bpy.ops.ed.undo_redo) == {"FINISHED"}
    yield 0.5
    difference = np.abs(common.coordinates(bpy.data.objects[name]) - written).max()
    assert difference < 1e-5, difference
    # The same from a script.
    obj = scene()
    edit = {"name": "", "kind": "TILT", "vertex": vertex, "angle": math.radians(-12), "way": (0, 0, 0), "falloff": 0.0}
    assert call(bpy.ops.mesh.fairmesh_live, edits=[edit]) == {"FINISHED"}
    difference = np.abs(common.coordinates(obj) - written).max()
    assert difference < 1e-5, difference


def bulge_twist_move_mirror():
    obj = scene(lambda: common.uv_sphere(64, 32))
    name, before = obj.name, common.coordinates(obj)
    yield 0.3
    yield from begin()
    press("B")
    press("TWO")
    press("FIVE")
    yield 0.3
    yield from wait_until(settled, 30)
    assert header().startswith("Bulge: 25|"), header()
    yield 0.5
    picture("live_bulge")
    press("Z", ctrl=True)
    yield 0.2
    assert not state().edits or all(edit.is_nothing for edit in state().edits.values()), state().edits
    press("W")
    yield 0.1
    yield from drag(0, 60)
    assert header().startswith("Twist: "), header()
    picture("live_twist")
    press("T")
    for _ in range(5):
        press("WHEELUPMOUSE")
    press("X")
    yield from drag(0, 120)
    assert "Mirror: X" in header(), header()
    picture("live_mirror")
    press("G")
    yield 0.1
    for _ in range(6):
        press("WHEELDOWNMOUSE")
    yield from drag(60, 60)
    assert header().startswith("Move: "), header()
    picture("live_move")
    press("RET")
    yield from wait_until(lambda: run_of() is None, 10)
    yield 0.3
    picture("live_moved")
    kinds = {each.kind for each in bpy.context.window_manager.operators[-1].edits}
    assert kinds == {"TWIST", "TILT", "MOVE"}, kinds
    press("Z", ctrl=True)
    yield 0.7
    assert np.array_equal(common.coordinates(bpy.data.objects[name]), before)


def band():
    """A sphere with a belt selected, which has two boundary loops."""
    common.clear()
    obj = common.uv_sphere(64, 48)
    common.edit(obj)
    common.select_faces(obj, lambda face: all(-0.3 < v.co.z < 0.5 for v in face.verts))
    set_view()
    return obj


def too_far():
    """An angle that no surface has: the header says so, what is shown stays sound, and turning back goes on."""
    scene()
    yield 0.3
    yield from begin()
    for key in ("ONE", "FIVE", "ZERO"):
        press(key)
        yield 0.05
    yield from wait_until(lambda: "NOT SETTLED" in header(), 30)
    yield 1.0
    picture("live_too_far")
    positions = run_of()._run.live.positions()[0]
    assert np.abs(positions).max() < 20, np.abs(positions).max()
    for key in ("BACK_SPACE", "BACK_SPACE"):
        press(key)
        yield 0.05
    yield 0.2
    yield from wait_until(settled, 30)
    press("BACK_SPACE")
    press("ZERO")
    yield 0.2
    yield from wait_until(settled, 30)
    run = run_of()._run.live
    assert np.abs(np.linalg.norm(run.positions()[0][run.free], axis=1) - 1).max() < 1e-4
    press("ESC")
    yield from wait_until(lambda: run_of() is None, 10)


def tool():
    """The tool: dragging beside a loop with the button held, then the other loop, and a click beside them ends it."""
    obj = band()
    before = common.coordinates(obj)
    call(bpy.ops.wm.tool_set_by_id, name="fairmesh.live")
    yield 2.5
    picture("live_tool")
    found = part("live_loops").loops_of(
        part("snapshot").read(obj), part("region").free_mask(part("snapshot").read(obj), True)
    )
    assert sorted(len(loop.vertices) for loop in found) == [64, 64]
    places = common.coordinates(obj)
    seen = [min(loop.vertices.tolist(), key=lambda v: on_screen(obj, places[v])[1]) for loop in found]
    yield from on_an_arrow(obj, found)
    for number, vertex in enumerate(seen):
        x, y = on_screen(obj, common.coordinates(obj)[vertex])
        move(x + 8, y - 25)
        yield 0.3
        button("PRESS", x + 8, y - 25)
        yield from wait_until(lambda: run_of() is not None and run_of()._run, 20)
        for step in range(6):
            move(x + 8, y - 25 - 10 * step)
            yield 0.05
        button("RELEASE", x + 8, y - 75)
        yield from wait_until(settled, 20)
        # With the button up the pointer does nothing.
        tilted = angle()
        assert abs(tilted) > 3
        move(x + 100, y + 50)
        yield 0.2
        assert angle() == tilted
        picture(f"live_tool_{number}")
    assert len([edit for edit in state().edits.values() if not edit.is_nothing]) == 2, state().edits
    region = view()["region"]
    corner = region.x + region.width - 20, region.y + 20
    move(*corner)
    yield 0.2
    button("PRESS", *corner)
    button("RELEASE", *corner)
    yield from wait_until(lambda: run_of() is None, 10)
    yield 0.3
    assert np.abs(common.coordinates(obj) - before).max() > 0.01
    call(bpy.ops.mesh.select_all, action="DESELECT")
    yield 0.5
    move(*middle())
    yield 0.2
    button("PRESS", *middle())
    button("RELEASE", *middle())
    yield 0.7
    picture("live_tool_nothing")
    ((_, text),) = part("found")._said
    assert "No vertex can move: select faces" in text, text
    call(bpy.ops.wm.tool_set_by_id, name="builtin.select_box")
    yield 0.3


def on_an_arrow(obj, found):
    """A drag of the handle that is there before: at its loop, wherever the pointer is nearest to another one."""
    vertex = int(found[1].vertices[0])
    normal = common.coordinates(obj)[vertex]
    x, y = on_screen(obj, normal)
    dx, dy = np.array(on_screen(obj, normal * 1.2)) - (x, y)
    share = 45 / math.hypot(dx, dy)
    move(x + share * dx, y + share * dy)
    yield 0.7
    picture("live_arrow")
    button("PRESS", x + share * dx, y + share * dy)
    yield from wait_until(lambda: run_of() is not None and run_of()._run, 20)
    assert state().vertex == vertex, (state().vertex, vertex)
    button("RELEASE", x + share * dx, y + share * dy)
    yield 0.3
    press("ESC")
    yield from wait_until(lambda: run_of() is None, 10)
    yield 0.5


def released_early():
    """A click with the tool that is over before the first surface is there drags nothing."""
    obj = scene()
    yield 0.3
    region = part("live_region").LiveRegion
    real = region.start

    def slow(*arguments):
        time.sleep(1.0)
        return real(*arguments)

    with unittest.mock.patch.object(region, "start", slow):
        x, y = middle()
        move(x, y)
        yield 0.2
        assert call(bpy.ops.mesh.fairmesh_live, "INVOKE_DEFAULT", hold=True) == {"RUNNING_MODAL"}
        button("PRESS", x, y)
        button("RELEASE", x, y)
        yield from wait_until(settled, 30)
    move(x + 60, y + 90)
    yield 0.3
    assert angle() == 0.0, angle()
    press("ESC")
    yield from wait_until(lambda: run_of() is None, 10)
    assert obj.mode == "EDIT"


def closed_by_the_addon():
    """Disabled in the middle of a drag: the mesh is as it was."""
    obj = scene()
    before, were = common.coordinates(obj), flags(obj)
    yield 0.3
    yield from begin()
    yield from drag(0, 50)
    bpy.ops.preferences.addon_disable(module=common.NAME)
    press("A")
    yield 0.5
    press("ESC")
    yield 0.5
    bpy.ops.preferences.addon_enable(module=common.NAME)
    yield 0.3
    assert np.array_equal(common.coordinates(obj), before)
    # A has selected all then.
    assert [[hide for _, hide in kind] for kind in flags(obj)[0]] == [[hide for _, hide in kind] for kind in were[0]]


window.run(steps())
