"""REPRODUCTION.md: the paper's table, figures and claims."""

from __future__ import annotations

import sys
from collections.abc import Callable

from . import claims, figures
from .measure import short, table, to_mesh
from .tool import Case, Run, Scan, Tool

#: Name in the paper, its vertices, base vertices and seconds; how many times faster the solver has to be, and on what.
ROWS = (
    ("Cylinder blend", 920, 140, 1.9, 50, "cylinder-blend"),
    ("Bust face", 2_926, 256, 12, 150, "cylinder-blend"),
    ("Human ear", 4_665, 248, 21, 150, "cylinder-blend"),
    ("Tetra thing", 13_308, 308, 57, 150, "tetra-thing"),
)


def document(tool: Tool, scans: list[Scan], machine: str, runs: int) -> dict[str, object]:
    """The measured parts of the page."""
    sections: dict[str, Callable[[], dict[str, object]]] = {
        "table": lambda: times(tool, runs),
        "figures": lambda: figures.sections(tool),
        "scans": lambda: {"scans": figures.scans(tool, scans)},
        "claims": lambda: claims.sections(tool),
    }
    parts: dict[str, object] = {"machine": machine}
    for name, section in sections.items():
        parts |= section()
        print(f"{name}: done", file=sys.stderr)
    return parts


def times(tool: Tool, runs: int) -> dict[str, object]:
    """Table 1: seconds of the default solver, of the paper's scheme, and of the paper."""
    rows, own, all_met = [], [], True
    for name, count, base, seconds, bar, kind in ROWS:
        case = tool.generate(f"table{count}", kind, "--vertices", count)
        # The smaller the mesh, the more runs the mean takes.
        repeated = runs * min(max(13_308 // count, 1), 8)
        run, cpu = tool.timed(case, "default", repeated, "--threads", 1)
        all_met &= seconds / cpu >= bar and run.outcome == "converged"
        sizes = [len(case.positions), len(case.triangles), seconds]
        measured = [f"{run.seconds:.4f}", f"{cpu:.4f}", run.iterations, run.outcome, f"{seconds / cpu:.0f}"]
        rows.append([name, kind, *sizes, *measured, bar])
        own.append([name, base, *own_scheme(tool, case, run)])
    columns = (
        "in the paper | here | vertices | triangles | the paper, s | default solver, s | CPU s | iterations"
        " | outcome | times faster | at least"
    )
    own_columns = (
        " | base in the paper | base here | levels | s | updates | harmonic defect | outcome"
        " | largest distance to the default's surface"
    )
    return {
        "times": table(columns, rows),
        "all_met": "confirmed" if all_met else "not confirmed in this run",
        "own_scheme": table(own_columns, own),
    }


def own_scheme(tool: Tool, case: Case, default: Run) -> list[object]:
    """Cells about the paper's scheme on this mesh."""
    run = tool.fair(case, "paper", "--solver", "paper", "--threads", 1)
    levels = [level["vertices"] for level in run.report["levels"]]
    # What has not converged is no surface to compare with.
    distance = "-"
    if run.outcome.startswith("converged"):
        distance = short(to_mesh(run.positions, default.positions, case.triangles).max)
    figures = [f"{run.seconds:.2f}", run.iterations, short(run.report["defect"]), run.outcome, distance]
    return [levels[0] if levels else "-", ", ".join(map(str, levels)) or "-", *figures]
