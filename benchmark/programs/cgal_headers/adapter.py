"""CGAL's triangulate_refine_and_fair_hole and fair with continuous curvature, which its Python package does not offer."""

import re
from pathlib import Path

from fairbench.adapter import Answer, Task, main
from programs.compiled import ran

VERSION = re.search(r"CGAL_VERSION (\S+)", Path("/usr/include/CGAL/version.h").read_text())


def run(task: Task) -> Answer:
    result, code = ran(task, "cgal_headers", "2")
    return Answer(result.vertices, result.faces, code == 0, "fair" if code == 0 else "not fair")


main(run, VERSION[1] if VERSION else "unknown")
