"""igl.harmonic with Laplacians of order k on the input's triangles: what its tutorial calls fairing."""

import sys
from importlib.metadata import version

import igl
import numpy as np

from fairbench.adapter import Answer, RefusedError, Task, main


def run(task: Task) -> Answer:
    if task.kind != "fair":
        raise RefusedError("not one of its tasks")
    fixed = np.setdiff1d(np.arange(len(task.vertices)), task.told["free"])
    moved = igl.harmonic(task.vertices, task.faces, fixed, task.vertices[fixed], int(sys.argv[3]))
    if not np.isfinite(moved).all():
        raise RefusedError("not finite")
    return Answer(moved, task.faces)


main(run, version("libigl"))
