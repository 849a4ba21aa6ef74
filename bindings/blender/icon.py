# SPDX-License-Identifier: GPL-3.0-or-later
"""Writes the icon of Fair Live in the tool bar, in Blender's format of coloured triangles: icon.py FILE

A sheet whose middle has risen to a smooth dome, and the handle that its boundary is dragged by.
"""

import math
import sys
from pathlib import Path

# On a canvas of 255 by 255, from the lower left. Red, green, blue, opacity.
SHEET, DOME, HANDLE = (205, 205, 205, 255), (171, 120, 224, 255), (64, 200, 255, 255)
PARTS, THICK = 20, 26
LEFT, RIGHT, GROUND, TOP = 78.0, 210.0, 62.0, 176.0


def quad(a, b, c, d):
    return [(a, b, c), (a, c, d)]


def dome():
    """A band below the curve that leaves the sheet flat on both sides."""
    width = (RIGHT - LEFT) / PARTS

    def height(part):
        return GROUND + (TOP - GROUND) * 0.5 * (1 - math.cos(2 * math.pi * part / PARTS))

    made = []
    for part in range(PARTS):
        x, next_x = LEFT + part * width, LEFT + (part + 1) * width
        y, next_y = height(part), height(part + 1)
        made += quad((x, GROUND - THICK), (next_x, GROUND - THICK), (next_x, next_y), (x, y))
    return made


def rectangle(left, bottom, right, top):
    return quad((left, bottom), (right, bottom), (right, top), (left, top))


def icon():
    shapes = (
        (SHEET, rectangle(20, GROUND - THICK, LEFT, GROUND) + rectangle(RIGHT, GROUND - THICK, 235, GROUND)),
        (DOME, dome()),
        (HANDLE, rectangle(LEFT - 30, GROUND + 8, LEFT - 16, 190) + [((LEFT - 50, 186), (LEFT + 4, 186), (LEFT - 23, 236))]),
    )
    corners, colors = bytearray(), bytearray()
    for color, triangles in shapes:
        for triangle in triangles:
            for corner in triangle:
                corners += bytes(round(value) for value in corner)
                colors += bytes(color)
    # The magic, how large the canvas is, and where it begins.
    return b"VCO\0" + bytes((255, 255, 0, 0)) + corners + colors


if __name__ == "__main__":
    target = Path(sys.argv[1])
    target.parent.mkdir(parents=True, exist_ok=True)
    target.write_bytes(icon())
