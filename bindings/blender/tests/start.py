# SPDX-License-Identifier: GPL-3.0-or-later
"""The Blender section of docs/start.md, from the zip to the first success, typed in Blender's window from its own words.

What stands between ">" is in menus and windows; in bold is a key or something to click, in italics a movement of the mouse.
A word that is not known here fails: then the document asks for something else than what was tried. Started by gui.sh.
"""

import re
import shutil
import sys
import tempfile
import time
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parent))
import bpy  # isort: skip
import common
import numpy as np
import window
from window import button, move, picture, view

DOCUMENT = Path(__file__).resolve().parents[3] / "docs/start.md"
KEYS = {"Delete": "DEL", "Tab": "TAB", "1": "ONE", "2": "TWO", "3": "THREE", "G": "G", "N": "N", "/": "SLASH", "_": "MINUS"}
KEYS |= dict(zip("0456789", ("ZERO", "FOUR", "FIVE", "SIX", "SEVEN", "EIGHT", "NINE")))
# How far the pointer goes from the middle of the view while vertices are chosen, and then to move them, in pixels.
CHOSEN, PULLED = 30, 60
# Seconds for reading what comes next, and at most from the zip to the first success.
READING, MOST = 4, 180


def middle():
    region = view()["region"]
    return region.x + region.width // 2, region.y + region.height // 2


def key(name, **modifiers):
    """Presses a key in the middle of the view."""
    x, y = middle()
    for value in ("PRESS", "RELEASE"):
        bpy.context.window_manager.windows[0].event_simulate(type=name, value=value, x=x, y=y, **modifiers)
        yield 0.2


def add():
    yield from key("A", shift=True)


def uv_sphere():
    """The letters that Blender underlines in the open menu."""
    yield from key("M")
    yield 0.5
    picture("start_menu")
    yield from key("U")


def drag():
    x, y = middle()
    move(x - CHOSEN, y - CHOSEN)
    yield 0.2
    button("PRESS", x - CHOSEN, y - CHOSEN)
    for step in range(-CHOSEN, CHOSEN + 1, 6):
        move(x + step, y + step)
        yield 0.05
    button("RELEASE", x + CHOSEN, y + CHOSEN)
    yield 0.3


def pull():
    x, y = middle()
    for step in range(0, PULLED + 1, 6):
        move(x + step, y + step // 2)
        yield 0.05


def click():
    x, y = middle()
    button("PRESS", x + PULLED, y + PULLED // 2)
    yield 0.1
    button("RELEASE", x + PULLED, y + PULLED // 2)
    picture("start_dent")


def edit_menu():
    yield from click_at(76, 787)


def preferences():
    """The letter underlined in the menu. The window opens about the pointer, so that it is seen whole."""
    move(800, 400)
    for value in ("PRESS", "RELEASE"):
        bpy.context.window_manager.windows[0].event_simulate(type="P", value=value, x=800, y=400)
    yield 1.5


def pick_the_zip():
    """In Blender's file browser: the folder typed, the file chosen, the button."""
    folder = tempfile.mkdtemp(prefix="zip", dir="/tmp")
    shutil.copy(window.ZIP, folder)
    yield 1.5
    yield from click_at(576, 604, 2)
    typed(("A", {"ctrl": True}), *((KEYS.get(c) or c.upper(), {"unicode": c}) for c in folder), ("RET", {}))
    yield 1.5
    yield from click_at(400, 547, 2)
    yield from click_at(1014, 22, 2)
    yield 1.0


def tick():
    yield from click_at(211, 466, 1)
    picture("start_installed")
    assert common.NAME in bpy.context.preferences.addons, "the add-on is not enabled"
    # With the mouse, where there is a window manager.
    with bpy.context.temp_override(window=bpy.context.window_manager.windows[1]):
        bpy.ops.wm.window_close()
    yield 0.5


def typed(*keys):
    browser = bpy.context.window_manager.windows[2]
    for name, more in keys:
        for value in ("PRESS", "RELEASE"):
            known = more if value == "PRESS" or "ctrl" in more else {}
            browser.event_simulate(type=name, value=value, x=576, y=604, **known)


def click_at(x, y, number=0):
    """A place in the main window, the preferences, or the file browser, all of fixed sizes."""
    yield from window.click(x, y, number)


INSTALLING = {
    "Edit": edit_menu,
    "Preferences": preferences,
    "Add-ons": lambda: click_at(60, 361, 1),
    "Install…": lambda: click_at(531, 523, 1),
    "the zip": pick_the_zip,
    "Mesh: Fairmesh": tick,
}
ACTIONS = {
    "Shift A": add,
    "UV Sphere": uv_sphere,
    "drag": drag,
    "pull": pull,
    "click": click,
    "Fairmesh": window.open_tab,
    "Fair Selection": window.press_button,
}


def words():
    """What the document asks for, one after the other: to install, and then."""
    section = DOCUMENT.read_text().split("## Blender\n")[1].split("\n## ")[0].replace("\n", " \n")
    menus, ticked = re.search(r'3\.4 to 4\.1 choose (.*?),\s+pick\s+the zip and tick "(.*?)"', section).groups()
    lines = re.findall(r"^\d\. .*$", section, re.MULTILINE)
    then = [bold or italic for line in lines for bold, italic in re.findall(r"\*\*(.+?)\*\*|\*(.+?)\*", line)]
    return [*menus.split(" > "), "the zip", ticked], then


def off_sphere(obj):
    return float(np.abs(np.linalg.norm(common.coordinates(obj), axis=1) - 1).max())


def steps():
    first, asked = words()
    assert "Fair Selection" in asked and len(asked) > 8, asked
    start, dented = time.perf_counter(), 0.0
    for word in first:
        yield from INSTALLING[word]()
    move(*middle())
    yield 0.3
    for word in asked:
        yield from key(KEYS[word]) if word in KEYS else ACTIONS[word]()
        yield 0.5
        if bpy.context.mode == "EDIT_MESH":
            dented = max(dented, off_sphere(bpy.context.edit_object))
    yield 1.0
    picture("start_faired")
    left = off_sphere(bpy.context.edit_object)
    seconds = time.perf_counter() - start
    # In the file browser there are three, in the menu Add two, and the preferences are closed.
    count = len(first) + 2 + len(asked) + 1 + 1
    print(f"{count} keys, clicks and drags, by a script in {seconds:.0f} s; off the sphere: {dented:.2f}, then {left:.1e}")
    assert dented > 0.1, "nothing was pulled out of place"
    assert left < 1e-5, "the dent is still there"
    # A stranger reads before each of them.
    assert seconds + READING * count < MOST


window.run(steps(), install=False)
