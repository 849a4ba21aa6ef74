"""The Polygon Mesh Processing Library's fill_hole, and fair with a Laplacian of order two, which is its minimize_curvature."""

import os

from fairbench.adapter import Answer, Task, main
from programs.compiled import ran

VERSION = os.environ.get("PMP_VERSION", "unknown")


def run(task: Task) -> Answer:
    result, _ = ran(task, "pmp", "2")
    return Answer(result.vertices, result.faces)


main(run, VERSION)
