"""Curvature continuity beside tangent continuity and the linear surfaces of other programs: docs/g2.md."""

from __future__ import annotations

from dataclasses import dataclass
from math import cos, hypot, pi, radians, sin, sqrt, tau
from pathlib import Path

import igl
import numpy as np

from . import peers, ten_holes
from .boundary import Boundary
from .measure import diagonal, short, spread, table
from .surfaces import distance
from .tool import Case, Points, Run, Scan, Tool, write_ply

#: How exact surfaces are triangulated, with rings of triangles around the regions.
IRREGULAR = ("--triangulation", "irregular", "--seed", 7, "--outside", 10)
#: What is asked for in the tables.
ASKED = {"G1": "g1", "continuity 0.5": "0.5", "G2": "g2", "auto": "auto"}
#: Of the surroundings, in edge lengths.
NOISE = (0, 0.003, 0.01, 0.03)


@dataclass
class Subject:
    """What is faired, and how it is shown."""

    title: str
    what: str
    case: Case
    view: str
    #: Of an exact surface.
    kind: str = ""


def document(tool: Tool, scans: list[Scan], machine: str) -> dict[str, object]:
    """The measured parts of the page."""
    cap = "Semi-axes 1, 0.8, 0.6; the image of the cap of 50 degrees of a sphere is free."
    patch = "Radii 1 and 0.4, on the outer side; both angles below one radian are free."
    subjects = [
        exact(tool, "ellipsoid", "A cap of an ellipsoid", cap, "0.6,-0.7,0.75"),
        exact(tool, "torus", "A patch of a torus", patch, "1,-0.5,0.6"),
        rod_on_ball(tool),
        *(of_scan(tool, scan, number) for number, scan in enumerate(scans)),
    ]
    overview(tool, subjects[0])
    return {
        "machine": machine,
        "subjects": "\n\n".join(section(tool, subject) for subject in subjects),
        "holes": ten_holes.section(tool),
        "sizes": sizes(tool),
        "noise": noise(tool, subjects[0].case),
    }


def exact_case(tool: Tool, kind: str, count: int) -> Case:
    """A region of an exact surface; normals are not given."""
    angle = ("--angle", np.degrees(1.0)) if kind == "torus" else ()
    case = tool.generate(f"g2-{kind}-{count}", kind, "--vertices", count, *angle, *IRREGULAR)
    case.normals_file = None
    return case


def exact(tool: Tool, kind: str, title: str, what: str, view: str) -> Subject:
    """The same as a subject."""
    case = exact_case(tool, kind, 4_000)
    what = f"{what} {len(case.free)} free vertices, irregular triangulation."
    return Subject(title, what, case, view, kind)


def rod_on_ball(tool: Tool) -> Subject:
    """Rows of vertices around an axis: a ball, a rod a little off its centre, and a cone between, which is free."""
    count, rod, end = 90, 0.4, radians(55)

    def height(radius: float) -> float:
        return 0.5 * sqrt(3) * tau * radius / count

    # Radius, height and offset of the axis of each row.
    ball, angle = [], end
    while angle < 0.6 * pi:
        ball.insert(0, (sin(angle), cos(angle), 0.0))
        angle += height(sin(angle))
    first, last = np.array(ball[-1]), np.array([rod, 1.5, 0.2])
    parts = [0.0]
    while parts[-1] < 1:
        radius = first[0] + parts[-1] * (last[0] - first[0])
        parts.append(parts[-1] + height(radius) / hypot(*(last - first)[:2]))
    cone = [first + t / parts[-1] * (last - first) for t in parts[1:-1]]
    rows = [*ball, *cone, *((rod, last[1] + k * height(rod), last[2]) for k in range(16))]
    turns = [tau * (np.arange(count) + 0.5 * (i % 2)) / count for i in range(len(rows))]
    positions = [
        np.column_stack([offset + radius * np.cos(turn), radius * np.sin(turn), np.full(count, z)])
        for (radius, z, offset), turn in zip(rows, turns)
    ]
    triangles = []
    for i in range(len(rows) - 1):
        for k in range(count):
            (a, b), (c, d) = ((count * row + k, count * row + (k + 1) % count) for row in (i, i + 1))
            triangles += [(a, b, c), (c, b, d)] if i % 2 == 0 else [(a, d, c), (a, b, d)]
    free = np.arange(count * len(ball), count * (len(ball) + len(cone)))
    case = tool.put("g2-blend", np.concatenate(positions), np.array(triangles, np.int32), free)
    what = (
        "A rod of radius 0.4 on a ball of radius 1, a little off its centre, joined by a cone whose "
        f"{len(free)} vertices are free. Two loops."
    )
    return Subject("A blend of given surfaces", what, case, "0.5,-1,0.35")


def of_scan(tool: Tool, scan: Scan, number: int) -> Subject:
    """A mesh of somebody else's."""
    positions, triangles = igl.read_triangle_mesh(str(scan.mesh))
    free = np.loadtxt(scan.free, dtype=np.int64, ndmin=1)
    case = tool.put(f"g2-scan{number}", positions, triangles.astype(np.int32), free)
    return Subject(scan.name, f"{len(free)} free vertices.", case, scan.view)


def faired(tool: Tool, case: Case, continuity: str) -> Run:
    """The surface of this program."""
    return tool.fair(case, continuity, "--continuity", continuity, "--threads", 1)


def error(case: Case, kind: str, positions: Points) -> str:
    """Root mean square of the distances of the free vertices, over the diagonal of what is free."""
    return short(spread(distance(kind, positions[case.free]) / diagonal(case.positions[case.free])).rms)


def section(tool: Tool, subject: Subject) -> str:
    """Table and picture of one subject."""
    case, boundary = subject.case, Boundary(subject.case)
    rows, shown = [], []

    def add(name: str, positions: Points, of_run: tuple[object, object, str]) -> None:
        reached, iterations, seconds = of_run
        seen = boundary.shown(positions)
        far = error(case, subject.kind, positions) if subject.kind else ""
        jumps = [f"{seen.jump_rms:.3f}", f"{seen.jump_max:.3f}"]
        rows.append([name, far, *jumps, reached, f"{seen.deviation:.1f}", iterations, seconds])

    if subject.kind:
        add("the exact one", case.positions, ("", "", ""))
        rows[0][1] = 0
    for number, (name, positions, seconds) in enumerate(peers.surfaces(case, tool.work)):
        add(name, positions, ("", "", f"{seconds:.2f}"))
        if "k = 3" in name:
            file = tool.work / f"{case.name}.peer{number}.ply"
            write_ply(file, positions, case.triangles)
            shown.append((file, name))
    for name, continuity in ASKED.items():
        run = faired(tool, case, continuity)
        add(name, run.positions, (run.reached(), run.iterations, f"{run.seconds:.2f}"))
        shown.append((run.file, name))
    columns = "surface | rms error | jump of H, rms | largest | reached | deviation of normals | iterations | seconds"
    parts = (f"## {subject.title}", subject.what, picture(tool, subject, shown), table(columns, rows))
    return "\n\n".join(parts)


def picture(tool: Tool, subject: Subject, shown: list[tuple[Path, str]]) -> str:
    """Mean curvature and reflections of some of the surfaces."""
    name = subject.case.name.split("-")[1]
    view, _, up = subject.view.partition("/")
    # Of somebody else's mesh only what is faired.
    around = ("--around", subject.case.free_file) if name.startswith("scan") else ()
    seen = ("--view", view, "--up", up or "0,0,1", "--shade", "curvature,reflection", "--size", "240x220")
    tool.render(f"{name}.png", subject.title, shown, *seen, *around)
    return f"![{subject.title}: mean curvature above, reflection lines below](g2/{name}.png)"


def overview(tool: Tool, subject: Subject) -> None:
    """What the pages of other hosts show: one surface with tangent planes alone, and with continuous curvature."""
    captions = {"g1": "continuity 0 (G1)", "g2": "continuity 1 (G2)"}
    meshes = [(faired(tool, subject.case, asked).file, caption) for asked, caption in captions.items()]
    tool.render("g1-g2.png", "", meshes, "--view", subject.view, "--shade", "curvature", "--size", "300x260")


def sizes(tool: Tool) -> str:
    """Errors and jumps by size."""
    rows = []
    for count in (1_000, 4_000, 13_000, 50_000):
        for kind in ("ellipsoid", "torus"):
            case = exact_case(tool, kind, count)
            boundary, runs = Boundary(case), [faired(tool, case, asked) for asked in ("g1", "g2")]
            figures = [
                [error(case, kind, run.positions) for run in runs],
                [f"{boundary.shown(run.positions).jump_rms:.3f}" for run in runs],
                [runs[1].reached()],
                [str(run.iterations) for run in runs],
                [f"{run.seconds:.2f}" for run in runs],
            ]
            rows.append([kind, len(case.free), *map(" → ".join, figures)])
    columns = "surface | free vertices | rms error | jump of H, rms | reached | iterations | seconds"
    return table(columns, rows)


def noise(tool: Tool, ellipsoid: Case) -> str:
    """What becomes of it where the surroundings are noisy."""
    rows, fixed = [], np.setdiff1d(np.arange(len(ellipsoid.positions)), ellipsoid.free)
    corners = ellipsoid.positions[ellipsoid.triangles]
    edge = np.mean(np.linalg.norm(corners - np.roll(corners, 1, axis=1), axis=2))
    for number, size in enumerate(NOISE):
        positions = ellipsoid.positions.copy()
        positions[fixed] += np.random.default_rng(3).normal(0, size * edge, (len(fixed), 3))
        case = tool.put(f"g2-noise{number}", positions, ellipsoid.triangles, ellipsoid.free)
        runs = [faired(tool, case, asked) for asked in ("g1", "g2")]
        rows.append([size, *(error(case, "ellipsoid", run.positions) for run in runs), runs[1].reached()])
    return table("noise | rms error, G1 | G2 | reached", rows)
