# SPDX-License-Identifier: GPL-3.0-or-later
"""The add-on in Blender's window: sidebar, run with progress, ESC, undo, redo with another option, disabled in mid-run.

Started by gui.sh under Xvfb: blender --enable-event-simulate --python gui.py -- ZIP FOLDER. Pictures go to FOLDER.
"""

import contextlib
import sys
import threading
import time
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parent))
import blf

import bpy  # isort: skip
import common
import numpy as np
import window
from common import part
from window import call, click, picture, press, view, wait_until

# From the top of the sidebar to the first panel of options, in pixels.
OPTIONS = 237
# From its upper left corner to the icon of presets.
PRESETS = 170, 15


def running():
    return bool(part("job")._modal)


@contextlib.contextmanager
def held():
    """The library's calls wait until the event that this yields is set, or until they are cancelled."""
    library, go = part("fairmesh"), threading.Event()
    real = library.fair

    def wait_and_fair(*arguments, cancel, **keywords):
        while not (go.wait(0.01) or cancel.is_cancelled):
            pass
        return real(*arguments, cancel=cancel, **keywords)

    library.fair = wait_and_fair
    try:
        yield go
    finally:
        library.fair = real


def scene(make):
    """A sphere with its cap flat and selected; seen from above at an angle."""
    common.clear()
    part("found").begin()
    obj = make()
    free = common.flatten_cap(obj)
    space = view()["area"].spaces.active
    space.show_region_ui = True
    space.overlay.show_extras = False
    space.region_3d.view_distance = 4
    with bpy.context.temp_override(**view()):
        bpy.ops.ed.undo_push(message="scene")
    return obj, free


def steps():
    yield from labels_fit()
    yield from seen()
    yield from escape()
    yield from escape_from_a_busy_library()
    yield from small_region()
    yield from whole_message()
    yield from grey_buttons()
    yield from presets()
    yield from curvature()
    yield from disabled_in_mid_run()


def labels_fit():
    """No name or choice is cut at the width that the sidebar has from the start, or in the panel of the last operator."""
    scene(lambda: common.irregular_sphere(8))
    yield 1.0
    # Beside it are the tabs and margins; in the other panel two fifths are for names.
    room, names, values = window.sidebar().width - 47, 118, 170
    blf.size(0, 11.0)

    def needs(text, more=0):
        return blf.dimensions(0, text)[0] + more

    for option in bpy.context.scene.fairmesh.bl_rna.properties:
        if option.identifier in {"rna_type", "name"}:
            continue
        # A number stands beside its name, with arrows; a switch is a box before it.
        more = {"BOOLEAN": 26, "INT": 60, "FLOAT": 60, "ENUM": 0}[option.type]
        assert needs(option.name, more) <= room, option.name
        if option.type == "ENUM":
            for item in option.enum_items:
                assert needs(item.name, 34) <= min(room, values), item.name
        assert option.type == "BOOLEAN" or needs(option.name) <= names, option.name
    for name in (
        "fair",
        "live",
        "fill_holes",
        "fill_all_holes",
        "join_loops",
        "bridge",
        "erase_and_fill",
        "show_curvature",
        "select_found",
    ):
        assert needs(getattr(bpy.ops.mesh, f"fairmesh_{name}").get_rna_type().name, 40) <= room, name
    print(f"the sidebar has room for {room} pixels")


def seen():
    """The sidebar, the progress, the result, one step of undo and redo."""
    obj, free = scene(lambda: common.geodesic_sphere(60))
    name = obj.name
    yield 2.0
    yield from window.open_tab()
    picture("panel")
    before = common.coordinates(obj)
    with held() as go:
        assert call(bpy.ops.mesh.fairmesh_fair, "INVOKE_DEFAULT") == {"RUNNING_MODAL"}
        # Whatever is pressed meanwhile must not reach the mesh: X would delete, G would move.
        for key in ("X", "G", "TAB"):
            press(key)
        yield from wait_until(lambda: part("job").shown, 30)
        yield 0.05
        picture("running")
        go.set()
    yield from wait_until(lambda: not running(), 100)
    yield 1.0
    assert obj.mode == "EDIT"
    error = common.radial_error(obj, free)
    print(f"radial error {error:.1e}")
    assert error < 1e-5
    picture("faired")
    after = common.coordinates(obj)

    press("Z", ctrl=True)
    yield 1.0
    assert np.array_equal(common.coordinates(bpy.data.objects[name]), before), "one undo does not bring the mesh back"
    press("Z", ctrl=True, shift=True)
    yield 1.0
    assert np.array_equal(common.coordinates(bpy.data.objects[name]), after), "redo does not bring the result back"


def escape():
    obj, free = scene(lambda: common.irregular_sphere(158))
    print(f"{len(free)} free vertices")
    before = common.coordinates(obj)
    # The machine's software OpenGL takes seconds to draw this mesh, and events wait for that.
    area = view()["area"]
    area.type = "CONSOLE"
    yield 1.0
    assert bpy.ops.mesh.fairmesh_fair("INVOKE_DEFAULT") == {"RUNNING_MODAL"}
    yield 0.3
    pressed = time.perf_counter()
    press("ESC")
    yield from wait_until(lambda: not running(), 10)
    print(f"ESC to the end of the operator: {time.perf_counter() - pressed:.3f} s")
    assert np.array_equal(common.coordinates(obj), before), "ESC has changed the mesh"
    yield from wait_until(lambda: not part("job")._running, 30)
    print(f"and to the end of its thread: {time.perf_counter() - pressed:.3f} s")
    yield 0.5
    assert np.array_equal(common.coordinates(obj), before)
    area.type = "VIEW_3D"


def escape_from_a_busy_library():
    """ESC ends the operator at once, also if the library does not listen."""
    obj, _ = scene(lambda: common.irregular_sphere(16))
    before = common.coordinates(obj)
    library, go = part("fairmesh"), threading.Event()
    real, library.fair = library.fair, lambda *_, **__: go.wait(100)
    try:
        assert call(bpy.ops.mesh.fairmesh_fair, "INVOKE_DEFAULT") == {"RUNNING_MODAL"}
        yield 0.3
        press("ESC")
        yield from wait_until(lambda: not running(), 30)
        assert part("job")._running, "the operator has waited for the library"
    finally:
        go.set()
        library.fair = real
    yield from wait_until(lambda: not part("job")._running, 30)
    yield 0.3
    assert np.array_equal(common.coordinates(obj), before)


def small_region():
    """A click on the sidebar's button: done at once, and F9's panel runs it again with other options."""
    obj, free = scene(lambda: common.irregular_sphere(16))
    name = obj.name
    yield 0.5
    # The options of the surface, open for the picture.
    yield from click(window.sidebar().x + 60, window.sidebar().y + window.sidebar().height - OPTIONS)
    yield from window.press_button()
    assert common.radial_error(bpy.data.objects[name], free) < 1e-5, "the button did nothing"
    first = common.coordinates(bpy.data.objects[name])
    last = bpy.context.window_manager.operators[-1]
    assert last.bl_idname == "MESH_OT_fairmesh_fair"
    # The panel appears where the pointer is.
    bpy.context.window_manager.windows[0].event_simulate(type="MOUSEMOVE", value="NOTHING", x=500, y=400)
    yield 0.3
    press("F9")
    yield 1.5
    picture("redo")
    press("ESC")
    yield 0.5
    # The same as a change in that panel.
    last = bpy.context.window_manager.operators[-1]
    last.properties.inner_fairness = "CONFORMAL"
    assert call(bpy.ops.ed.undo_redo) == {"FINISHED"}
    yield 0.5
    second = common.coordinates(bpy.data.objects[name])
    assert not np.array_equal(first, second), "the other option changes nothing"
    assert common.radial_error(bpy.data.objects[name], free) < 1e-5


def whole_message():
    """All that the last run has said stands in the sidebar, in lines that fit it, and what it named can be selected."""
    common.clear()
    obj = common.irregular_sphere(16)
    common.delete_faces(obj, lambda face: face.calc_center_median().z > 0.3)
    common.select_boundary(obj)
    assert call(bpy.ops.mesh.fairmesh_fill_holes, max_iterations=1) == {"FINISHED"}
    # The panels below move down first.
    for step in range(10):
        window.move(window.sidebar().x + 50 + step, window.sidebar().y + 300)
        yield 0.2
    picture("last_run")
    ((_, text),) = part("found").said(bpy.context)
    with bpy.context.temp_override(**{**view(), "region": window.sidebar()}):
        lines = part("panel").wrapped(text, bpy.context)
    assert " ".join(lines) == text and "64 at most" in lines[-1] + lines[-2] and len(lines) > 5, lines
    blf.size(0, 11.0)
    widest = max(blf.dimensions(0, line)[0] for line in lines)
    assert widest <= window.sidebar().width - part("panel").BESIDE, widest


def grey_buttons():
    """What cannot run is grey, and its tooltip says why."""
    common.clear()
    common.edit(common.irregular_sphere(8))
    yield 1.0
    # The tooltip of Join Loops and Fair.
    for step in range(8):
        window.move(window.sidebar().x + 80 + step, window.sidebar().y + window.sidebar().height - 45 - 3 * 23)
        yield 0.3
    yield 2.0
    picture("grey")


def presets():
    """The icon in the panel's header opens a list; a click on an entry sets the options."""
    settings = bpy.context.scene.fairmesh
    x, y = window.sidebar().x, window.sidebar().y + window.sidebar().height
    yield from click(x + PRESETS[0], y - PRESETS[1])
    picture("presets")
    window.move(x + PRESETS[0], y - PRESETS[1] - 60)
    yield 0.5
    yield from click(x + PRESETS[0] - 60, y - PRESETS[1] - 82)
    picture("preset_taken")
    assert (settings.relax_rim, settings.continuity) in {(3, 0.0), (0, 1.0)}, "no preset was taken"
    settings.reset()


def curvature():
    obj, _ = scene(lambda: common.irregular_sphere(40))
    yield 0.3
    call(bpy.ops.mesh.select_all, action="DESELECT")
    assert call(bpy.ops.mesh.fairmesh_show_curvature) == {"FINISHED"}
    yield 1.0
    picture("curvature_edit")
    call(bpy.ops.object.mode_set, mode="OBJECT")
    yield 1.0
    picture("curvature_object")
    shading = view()["area"].spaces.active.shading
    assert (shading.type, shading.color_type) == ("SOLID", "VERTEX")
    assert call(bpy.ops.mesh.fairmesh_hide_curvature) == {"FINISHED"}
    assert (shading.type, shading.color_type) == ("SOLID", "MATERIAL"), "the shading is not what it was"
    yield 0.5
    picture("curvature_hidden")


def disabled_in_mid_run():
    scene(lambda: common.uv_sphere(300, 150))
    yield 0.5
    with held():
        assert call(bpy.ops.mesh.fairmesh_fair, "INVOKE_DEFAULT") == {"RUNNING_MODAL"}
        yield 0.3
        assert running()
        bpy.ops.preferences.addon_disable(module=common.NAME)
    # Time for events to go where the operator was.
    press("A")
    yield 1.0
    press("ESC")
    yield 1.0
    bpy.ops.preferences.addon_enable(module=common.NAME)
    yield 0.5
    picture("enabled_again")


window.run(steps())
