# SPDX-License-Identifier: GPL-3.0-or-later
"""Blender's window as tests drive it: events, waiting, pictures.

Each step of a test is a generator that yields seconds to wait, as Blender has to draw and handle events in between.
"""

import subprocess
import sys
import time
import traceback
from pathlib import Path

import bpy  # isort: skip
import common
from bpy_extras import view3d_utils
from mathutils import Vector

ZIP, FOLDER = sys.argv[sys.argv.index("--") + 1 :]
# Blender ends a modal operator's timer loop between two of these.
POLL = 0.01
# From the top of the sidebar to the add-on's tab, to its first button, and from one button to the next, in pixels.
TAB, BUTTON, ROW = 175, 45, 23


def view():
    """What operators called from a timer need to find."""
    window = bpy.context.window_manager.windows[0]
    area = next(a for a in window.screen.areas if a.type == "VIEW_3D")
    region = next(r for r in area.regions if r.type == "WINDOW")
    return {"window": window, "area": area, "region": region}


def call(operator, *arguments, **keywords):
    with bpy.context.temp_override(**view()):
        return operator(*arguments, **keywords)


def on_screen(obj, point):
    """Where a point of an object is seen in the window."""
    region = view()["region"]
    place = obj.matrix_world @ Vector(point)
    at = view3d_utils.location_3d_to_region_2d(region, view()["area"].spaces.active.region_3d, place)
    return at.x + region.x, at.y + region.y


def picture(name):
    subprocess.run(["import", "-window", "root", str(Path(FOLDER) / f"{name}.png")], check=True)


def press(key, **modifiers):
    window = bpy.context.window_manager.windows[0]
    x, y = 500, 400
    window.event_simulate(type=key, value="PRESS", x=x, y=y, **modifiers)
    window.event_simulate(type=key, value="RELEASE", x=x, y=y, **modifiers)


def move(x, y, **modifiers):
    """Moves the pointer. Blender sees where it is when it has handled that."""
    window = bpy.context.window_manager.windows[0]
    window.event_simulate(type="MOUSEMOVE", value="NOTHING", x=int(x), y=int(y), **modifiers)


def button(value, x, y, kind="LEFTMOUSE"):
    bpy.context.window_manager.windows[0].event_simulate(type=kind, value=value, x=int(x), y=int(y))


def click(x, y, number=0):
    """Clicks in a window, by default the main one."""
    window = bpy.context.window_manager.windows[number]
    # Blender has to see where the pointer is before it is pressed.
    for offset in (30, 0):
        window.event_simulate(type="MOUSEMOVE", value="NOTHING", x=x - offset, y=y)
        yield 0.3
    window.event_simulate(type="LEFTMOUSE", value="PRESS", x=x, y=y)
    yield 0.1
    window.event_simulate(type="LEFTMOUSE", value="RELEASE", x=x, y=y)
    yield 0.7


def sidebar():
    return next(r for r in view()["area"].regions if r.type == "UI")


def open_tab():
    """Clicks on the add-on's tab, the last one of the sidebar."""
    yield from click(sidebar().x + sidebar().width - 12, sidebar().y + sidebar().height - TAB)


def press_button(number=0):
    """Clicks on a button in the add-on's tab, by default the first one."""
    yield from click(sidebar().x + 100, sidebar().y + sidebar().height - BUTTON - ROW * number)


def wait_until(condition, seconds):
    end = time.perf_counter() + seconds
    while not condition():
        assert time.perf_counter() < end, "it takes too long"
        yield POLL


def run(steps, install=True):
    """Does the steps, one after the other, and ends Blender. `install`: not by the steps themselves."""

    def drive():
        try:
            return next(steps)
        except StopIteration:
            print("The window test has passed", flush=True)
            common.leave(0)
        except BaseException:
            traceback.print_exc()
            picture("failed")
            common.leave(1)

    if install:
        common.install(ZIP)
    bpy.context.preferences.view.show_splash = False
    bpy.app.timers.register(drive, first_interval=2.0)
