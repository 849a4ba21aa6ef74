"""docs/measurements.md: accuracy, times, holes, known shortfalls. `tests/docs.rs` measures one seed anew."""

from __future__ import annotations

from collections.abc import Callable, Iterable

import numpy as np

from .measure import scientific, table
from .surfaces import distance
from .tool import Case, Points, Tool


def document(tool: Tool, machine: str) -> dict[str, object]:
    """The measured parts of the page."""
    sections = (accuracy, times, holes, one_hole, tilted_normals)
    tables: dict[str, object] = {section.__name__: section(tool) for section in sections}
    return {"machine": machine} | tables


def irregular(tool: Tool, name: str, kind: str, count: int, seed: int, *words: object) -> Case:
    """An irregular triangulation of an exact surface."""
    return tool.generate(name, kind, "--vertices", count, "--seed", seed, "--triangulation", "irregular", *words)


def span(values: Iterable[float], shown: Callable[[float], str] = str) -> str:
    """The least and the greatest, or the one that all are."""
    values = list(values)
    ends = [shown(min(values)), shown(max(values))]
    return ends[0] if ends[0] == ends[1] else " to ".join(ends)


def accuracy(tool: Tool) -> str:
    """By surface and size."""
    rows = []
    for kind in ("sphere-cap", "cylinder", "catenoid", "unduloid", "revolution"):
        for count in (1_000, 13_000):
            cases = [
                irregular(tool, f"{kind}-{count}-{seed}", kind, count, seed, "--start", "random")
                for seed in range(1, 9)
            ]
            for normals in ("exact", "fitted"):
                rows.append([kind, count, normals, *accuracy_of(tool, kind, cases, normals == "exact")])
    return table("surface | free vertices | boundary normals | largest error | iterations | converged", rows)


def accuracy_of(tool: Tool, kind: str, cases: list[Case], exact_normals: bool) -> list[str]:
    """Errors, iterations and how many have converged."""
    errors, iterations, converged = [], [], 0
    for case in cases:
        if not exact_normals:
            case.normals_file = None
        run = tool.fair(case, "fair")
        errors.append(np.max(distance(kind, run.positions[case.free])) / run.report["diagonal"])
        iterations.append(run.iterations)
        converged += run.outcome == "converged"
    return [span(errors, scientific), span(iterations), f"{converged} of {len(cases)}"]


def times(tool: Tool) -> str:
    """By size."""
    rows = []
    for count in (1_000, 13_000, 100_000):
        case = irregular(tool, f"time-{count}", "sphere-cap", count, 1, "--start", "random")
        one, two = (tool.timed(case, "fair", 3, "--threads", threads)[0] for threads in (1, 2))
        rows.append([count, f"{one.seconds:.3f}", f"{two.seconds:.3f}", one.iterations])
    return table("free vertices | one thread | two threads | iterations", rows)


def off_sphere(points: Points) -> float:
    """How far the furthest is from the unit sphere."""
    return float(np.max(distance("sphere", points)))


def holes(tool: Tool) -> str:
    """The unit sphere without a cap, filled, and how far the new vertices are from the sphere."""
    rows = []
    for count in (13_000, 30_000, 100_000):
        cases = [irregular(tool, f"hole-{count}-{k}", "sphere-hole", count, k, "--outside", 1) for k in (1, 2, 3)]
        runs = [tool.fill(case, "fill", "--threads", 1) for case in cases]
        errors = [off_sphere(run.positions[len(case.positions) :]) for case, run in zip(cases, runs)]
        new, seconds = ([run.report["new_vertices"] for run in runs], [run.seconds for run in runs])
        rows.append([count, span(new), span(errors, scientific), span(seconds, "{:.2f}".format)])
    return table("vertices | new vertices | off the sphere | seconds", rows)


def one_hole(tool: Tool) -> str:
    """A sphere from the rings inside a hole."""
    rows = []
    for angle in (45, 30, 20):
        for count in (1_000, 5_000):
            errors = []
            for seed in range(1, 11):
                name = f"one-hole-{angle}-{count}-{seed}"
                case = irregular(tool, name, "sphere-hole", count, seed, "--angle", angle, "--start", "flat")
                run = tool.fair(case, "fair")
                if run.outcome == "converged":
                    errors.append(off_sphere(run.positions[case.free]) / run.report["diagonal"])
            worst = scientific(max(errors)) if errors else "-"
            rows.append([angle, count, f"{len(errors)} of 10", worst])
    return table("half-angle of the hole | free vertices | completed | largest error of these", rows)


def tilted_normals(tool: Tool) -> str:
    """How far the normals of the blend can be tilted."""
    rows = []
    for count in (920, 13_308):
        case = tool.generate(f"tilt-{count}", "cylinder-blend", "--vertices", count)
        vertices, normals = case.normals()
        case.normals_file = tool.work / "tilted.txt"
        for direction, sign in (("outward", 1), ("inward", -1)):
            last = 0
            for degrees in range(5, 61, 5):
                tilted = tilt(case.positions[vertices], normals, np.radians(sign * degrees))
                np.savetxt(case.normals_file, np.column_stack([vertices, tilted]), "%d %.17g %.17g %.17g")
                if tool.fair(case, "tilted").outcome != "converged":
                    break
                last = degrees
            rows.append([count, direction, f"up to {last}"])
    return table("vertices | tilt | degrees that converge, of 5, 10, ..., 60", rows)


def tilt(places: Points, normals: Points, angle: float) -> Points:
    """Normals turned towards the axes of their tubes, which point away from the middle."""
    apart = np.linalg.norm(places[:, None] - places[None], axis=2)
    np.fill_diagonal(apart, np.inf)
    # Normals of neighbours on one circle span its plane.
    axes = np.cross(normals, normals[np.argmin(apart, axis=1)])
    axes /= np.linalg.norm(axes, axis=1, keepdims=True)
    axes *= np.sign((axes * places).sum(axis=1, keepdims=True))
    return normals * np.cos(angle) + axes * np.sin(angle)
