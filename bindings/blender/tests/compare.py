# SPDX-License-Identifier: GPL-3.0-or-later
"""Fair Selection beside Blender's own Fair Tangency, in one run: errors against the exact sphere, and CPU seconds, with
those that the operator spends beside the library's own call.

    target/blender/bpy-4.2/bin/python bindings/blender/tests/compare.py ZIP [FREE VERTICES...]

The cap z > 0.2 of a unit sphere is laid flat and faired; the exact answer has radius 1. Blender offers Fair Tangency in
Sculpt mode only, for a face set; scripts can call it since Blender 4.
"""

import sys
import time
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parent))
import bpy  # isort: skip
import bmesh
import common
import numpy as np

FREE = (1_000, 13_000, 100_000)
FAR = (1000.0, 0.0, 0.0)


def uv(free):
    """About so many vertices above z = 0.2."""
    segments = round(np.sqrt(5 * free))
    return common.uv_sphere(segments, segments // 2)


def irregular(free):
    return common.irregular_sphere(round(np.sqrt(free / 4)))


def measure(make, free, offset, run):
    """Free vertices, error, and the seconds of run(obj)."""
    common.clear()
    obj = make(free)
    free = common.flatten_cap(obj, offset=offset)
    spent = run(obj)
    return len(free), common.radial_error(obj, free, offset), *spent


def fair_selection(obj):
    """CPU and wall seconds, and CPU seconds beside the library's call."""
    library, inside = common.part("fairmesh"), []
    real = library.fair

    def watched(*arguments, **keywords):
        start = time.process_time()
        try:
            return real(*arguments, **keywords)
        finally:
            inside.append(time.process_time() - start)

    library.fair = watched
    try:
        cpu, wall = timed(lambda: bpy.ops.mesh.fairmesh_fair())
    finally:
        library.fair = real
    return cpu, wall, cpu - sum(inside)


def fair_tangency(obj):
    selected = np.array([f.select for f in bmesh.from_edit_mesh(obj.data).faces])
    bpy.ops.object.mode_set(mode="OBJECT")
    sets = obj.data.attributes.new(".sculpt_face_set", "INT", "FACE")
    sets.data.foreach_set("value", np.where(selected, 2, 1).astype(np.int32))
    # Without an undo step Sculpt mode crashes when it is entered by a script.
    bpy.ops.ed.undo_push()
    bpy.ops.object.mode_set(mode="SCULPT")
    spent = timed(lambda: bpy.ops.sculpt.face_set_edit(active_face_set=2, mode="FAIR_TANGENCY"))
    bpy.ops.object.mode_set(mode="OBJECT")
    return spent


def timed(function):
    cpu, wall = time.process_time(), time.perf_counter()
    assert function() == {"FINISHED"}
    return time.process_time() - cpu, time.perf_counter() - wall


def main():
    common.install(sys.argv[1])
    sizes = [int(a) for a in sys.argv[2:]] or FREE
    print(f"Blender {bpy.app.version_string}; largest radial error, CPU s (wall s)")
    print("| sphere | at | free vertices | Fair Selection | beside the library | Fair Tangency |")
    print("|---|---|---|---|---|---|")
    for name, make in (("UV", uv), ("irregular", irregular)):
        for place, offset in (("origin", (0.0, 0.0, 0.0)), ("1,000 radii", FAR)):
            for size in sizes:
                free, *ours, beside = measure(make, size, offset, fair_selection)
                _, *theirs = measure(make, size, offset, fair_tangency)
                cells = [f"{error:.1e}, {cpu:.3f} ({wall:.3f})" for error, cpu, wall in (ours, theirs)]
                print(f"| {name} | {place} | {free:,} | {cells[0]} | {beside:.3f} | {cells[1]} |", flush=True)


if __name__ == "__main__":
    main()
