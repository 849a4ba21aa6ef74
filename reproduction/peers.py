"""Linear surfaces of libigl and CGAL over the free vertices of a mesh.

CGAL's `fair` is compiled at the first call; `reproduce.sh` installs Debian's libcgal-dev.
"""

from __future__ import annotations

import subprocess
import time
from collections.abc import Callable, Iterator
from pathlib import Path

import igl
import numpy as np

from .tool import Case, Points


def surfaces(case: Case, work: Path) -> Iterator[tuple[str, Points, float]]:
    """Name, positions and CPU seconds of each."""
    solvers: dict[str, Callable[[], tuple[Points, float] | None]] = {
        "libigl harmonic, k = 2": lambda: harmonic(case, 2),
        "libigl harmonic, k = 3": lambda: harmonic(case, 3),
        "CGAL 5.5 fair, continuity 2": lambda: cgal(case, work),
    }
    for name, solve in solvers.items():
        found = solve()
        if found is not None:
            yield name, *found


def harmonic(case: Case, k: int) -> tuple[Points, float]:
    """`igl::harmonic`."""
    fixed = np.setdiff1d(np.arange(len(case.positions)), case.free)
    begin = time.process_time()
    found = igl.harmonic(case.positions, case.triangles.astype(np.int64), fixed, case.positions[fixed], k)
    return found, time.process_time() - begin


def cgal(case: Case, work: Path) -> tuple[Points, float] | None:
    """`CGAL::Polygon_mesh_processing::fair`."""
    program, asked, answer = cgal_program(work), work / "cgal.in", work / "cgal.out"
    with asked.open("w", encoding="utf-8") as file:
        file.write(f"{len(case.positions)} {len(case.triangles)} {len(case.free)}\n")
        for rows, form in ((case.positions, "%.17g"), (case.triangles, "%d"), (case.free, "%d")):
            np.savetxt(file, rows, form)
    if subprocess.run([program, asked, answer], check=False).returncode != 0:
        return None
    seconds, *numbers = answer.read_text(encoding="utf-8").split()
    return np.array(numbers, float).reshape(-1, 3), float(seconds)


def cgal_program(work: Path) -> Path:
    """The compiled program."""
    program = work / "cgal_fair"
    if not program.exists():
        source = Path(__file__).parent / "cgal_fair.cpp"
        command = ["g++", "-O2", "-DNDEBUG", "-I/usr/include/eigen3", source, "-o", program, "-lgmp", "-lmpfr"]
        subprocess.run(command, check=True)
    return program
