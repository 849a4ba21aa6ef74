# SPDX-License-Identifier: GPL-3.0-or-later
"""The Blender section of docs/start.md, typed in Blender's window from the document's own words.

What stands in bold there is a key or something to click, in italics a movement of the mouse. A word that is not known here
fails: then the document asks for something else than what was tried. Started by gui.sh, as gui.py is.
"""

import re
import sys
import time
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parent))
import bpy  # isort: skip
import common
import numpy as np
import window
from window import button, move, picture, view

DOCUMENT = Path(__file__).resolve().parents[3] / "docs/start.md"
KEYS = {"Delete": "DEL", "Tab": "TAB", "1": "ONE", "2": "TWO", "3": "THREE", "G": "G", "N": "N"}
# How far the pointer goes from the middle of the view while vertices are chosen, and then to move them, in pixels.
CHOSEN, PULLED = 30, 60


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
    """What the document asks for, one after the other."""
    section = DOCUMENT.read_text().split("## Blender\n")[1].split("\n## ")[0]
    lines = re.findall(r"^\d\. .*$", section, re.MULTILINE)
    return [bold or italic for line in lines for bold, italic in re.findall(r"\*\*(.+?)\*\*|\*(.+?)\*", line)]


def off_sphere(obj):
    return float(np.abs(np.linalg.norm(common.coordinates(obj), axis=1) - 1).max())


def steps():
    asked = words()
    assert "Fair Selection" in asked and len(asked) > 8, asked
    start, dented = time.perf_counter(), 0.0
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
    print(
        f"{len(asked)} keys and clicks in {time.perf_counter() - start:.0f} s; off the sphere: {dented:.2f}, then {left:.1e}"
    )
    assert dented > 0.1, "nothing was pulled out of place"
    assert left < 1e-5, "the dent is still there"


window.run(steps())
