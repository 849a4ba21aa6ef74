"""docs/ladder.md: which attempt of the solver finds the surface, over random regions and holes of public meshes."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator
from itertools import pairwise
from pathlib import Path
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray
from scipy.sparse import csr_array
from scipy.sparse.csgraph import dijkstra

import fairmesh

from .measure import table
from .tool import Points, Triangles

#: Regions of each mesh, and how many of all are holes, too: every so many.
REGIONS, EVERY = 40, 3
#: Free vertices of a region.
SIZES = (30, 3_000)
#: The sharpest edge at a rim, in degrees, and between which of them successes are counted.
RIMS = (0, 15, 25, 45)
#: Rings of triangles around a region that are kept.
AROUND = 6
#: The attempt whose surface others begin at.
START = "minimal energy"


class Mesh(NamedTuple):
    """A mesh whose edges have one or two triangles that run along them in both directions."""

    name: str
    positions: Points
    triangles: Triangles


class Region(NamedTuple):
    """Free vertices, by a mask, and the sharpest edge that meets their rim."""

    free: NDArray[np.bool_]
    rim: float


class Run(NamedTuple):
    """What came of one region or hole."""

    is_success: bool
    outcome: str
    #: The attempts on the mesh itself: name, iterations, whether it was sound.
    attempts: list[tuple[str, int, bool]]


def read_off(path: Path) -> Mesh | None:
    """A mesh of triangles; none for other polygons and for text that is none."""
    words = path.read_text(encoding="utf-8", errors="replace").split()
    if not words or words[0] != "OFF":
        return None
    vertices, faces = int(words[1]), int(words[2])
    numbers = words[4 : 4 + 3 * vertices], words[4 + 3 * vertices :][: 4 * faces]
    try:
        positions = np.array(numbers[0], float).reshape(-1, 3)
        corners = np.array(numbers[1], int).reshape(-1, 4)
    except ValueError:
        return None
    if (corners[:, 0] != 3).any():
        return None
    return Mesh(path.stem, positions, corners[:, 1:].astype(np.int32))


def half_edges(triangles: Triangles) -> NDArray[np.int64]:
    """Their ends; those of corner k begin at k times the number of triangles."""
    return np.vstack([triangles[:, [k, (k + 1) % 3]] for k in range(3)]).astype(np.int64)


def is_surface(mesh: Mesh) -> bool:
    """Whether no half-edge is there twice."""
    ends = half_edges(mesh.triangles)
    keys = ends[:, 0] * len(mesh.positions) + ends[:, 1]
    return len(mesh.triangles) >= 300 and len(np.unique(keys)) == len(keys)


def meshes(folder: Path) -> Iterator[Mesh]:
    """All that regions can be cut out of."""
    for path in sorted(folder.glob("*.off")):
        mesh = read_off(path)
        if mesh is not None and is_surface(mesh):
            yield mesh


def folds(
    mesh: Mesh,
) -> tuple[NDArray[np.int64], NDArray[np.float64], NDArray[np.int64]]:
    """The ends of edges with two triangles, the angles between these in degrees, and the triangles."""
    ends = half_edges(mesh.triangles)
    low, high = ends.min(axis=1), ends.max(axis=1)
    order = np.lexsort((high, low))
    same = np.flatnonzero((np.diff(low[order]) == 0) & (np.diff(high[order]) == 0))
    pairs = np.column_stack([order[same], order[same + 1]])
    corners = mesh.positions[mesh.triangles]
    normals = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    sides = pairs % len(mesh.triangles)
    a, b = normals[sides[:, 0]], normals[sides[:, 1]]
    angles = np.arctan2(np.linalg.norm(np.cross(a, b), axis=1), (a * b).sum(axis=1))
    return ends[pairs[:, 0]], np.degrees(angles), sides


def regions(mesh: Mesh, random: np.random.Generator) -> Iterator[Region]:
    """Geodesic discs that do not reach a boundary of the mesh."""
    count = len(mesh.positions)
    ends = half_edges(mesh.triangles)
    lengths = np.linalg.norm(np.diff(mesh.positions[ends], axis=1)[:, 0], axis=1)
    graph = csr_array((lengths, (ends[:, 0], ends[:, 1])), (count, count))
    graph = graph.maximum(graph.T)
    keys = ends[:, 0] * count + ends[:, 1]
    is_open = ~np.isin(keys, ends[:, 1] * count + ends[:, 0])
    edges, angles, sides = folds(mesh)
    for _ in range(REGIONS):
        size = int(np.exp(random.uniform(*np.log(np.minimum(SIZES, count / 4)))))
        distance = dijkstra(graph, indices=int(random.integers(count)))
        free = np.zeros(count, bool)
        free[np.argsort(distance)[:size]] = True
        inside = free[mesh.triangles].any(axis=1)
        rim = np.zeros(count, bool)
        rim[mesh.triangles[inside]] = True
        rim &= ~free
        is_cut = not rim.any() or not np.isfinite(distance[free]).all() or (free | rim)[ends[is_open]].any()
        meets = rim[edges].any(axis=1) & ~inside[sides].all(axis=1)
        sharpest = float(angles[meets].max(initial=0.0))
        if not is_cut and sharpest < RIMS[-1]:
            yield Region(free, sharpest)


def around(mesh: Mesh, region: Region) -> tuple[Points, Triangles, NDArray[np.bool_]]:
    """The piece of mesh around a region."""
    near = region.free.copy()
    for _ in range(AROUND):
        near[mesh.triangles[near[mesh.triangles].any(axis=1)]] = True
    triangles = mesh.triangles[near[mesh.triangles].all(axis=1)]
    used = np.unique(triangles)
    number = np.zeros(len(near), np.int32)
    number[used] = np.arange(len(used))
    return mesh.positions[used], number[triangles], region.free[used]


def crosses_itself(positions: Points, triangles: Triangles, free: NDArray[np.bool_]) -> bool:
    """Whether the surroundings intersect themselves."""
    outside = triangles[~free[triangles].any(axis=1)]
    return len(fairmesh.self_intersections(positions, outside)) > 0


def told(report: fairmesh.Report | None, is_success: bool) -> Run:
    """Of a report, what is counted."""
    if report is None:
        return Run(is_success, "none", [])
    attempts = [
        (attempt.name, attempt.iterations, attempt.end == "sound")
        for component in report.components
        for attempt in component.attempts
        if attempt.free_vertices == component.free_vertices
    ]
    return Run(is_success, str(report.outcome), attempts)


def faired(positions: Points, triangles: Triangles, free: NDArray[np.bool_]) -> Run | None:
    """None where the mesh is refused."""
    try:
        result = fairmesh.fair(positions, triangles, free=free)
    except fairmesh.FairmeshError:
        return None
    return told(result.report, result.outcome.is_success)


def filled(positions: Points, triangles: Triangles, free: NDArray[np.bool_]) -> Run | None:
    """The region deleted, and the hole filled."""
    inside = free[triangles].any(axis=1)
    rim = set(np.unique(triangles[inside])) - set(np.flatnonzero(free))
    try:
        loops = fairmesh.boundary_loops(positions, triangles[~inside])
        hole = [i for i, loop in enumerate(loops) if set(loop.vertices) & rim]
        if len(hole) != 1:
            return None
        result = fairmesh.fill_holes(positions, triangles[~inside], loops=hole)
    except fairmesh.FairmeshError:
        return None
    return told(result.loops[0].report, result.is_success)


def solved(runs: list[Run]) -> Counter[str]:
    """Successes by the first attempt that was sound."""
    found: Counter[str] = Counter()
    for run in runs:
        sound = [name for name, _, is_sound in run.attempts if is_sound and name != START]
        if run.is_success:
            found[sound[0] if sound else run.attempts[-1][0] if run.attempts else "without a new vertex"] += 1
        else:
            found[f"*{run.outcome}*"] += 1
    return found


def attempts(regions_runs: list[Run], holes_runs: list[Run]) -> str:
    """The table of attempts."""
    both = [solved(regions_runs), solved(holes_runs)]
    spent: Counter[str] = Counter()
    for run in regions_runs + holes_runs:
        for name, iterations, _ in run.attempts:
            spent[name] += iterations
    names = sorted(
        both[0].keys() | both[1].keys() | spent.keys(),
        key=lambda name: (name[0] == "*", -both[0][name]),
    )
    share = [max(len(runs), 1) for runs in (regions_runs, holes_runs)]
    cells = [
        [
            name.strip("*").replace("_", " ") if name[0] != "*" else f"none: {name.strip('*').replace('_', ' ')}",
            *[f"{found[name]} ({found[name] / of:.1%})" for found, of in zip(both, share, strict=True)],
            spent[name] or "",
        ]
        for name in names
    ]
    return table("attempt | regions | holes | iterations of all", cells)


def document(folder: Path) -> dict[str, object]:
    """The measured parts of the page."""
    random = np.random.default_rng(1)
    runs: list[tuple[float, Run]] = []
    holes: list[Run] = []
    used = set()
    for mesh in meshes(folder):
        for region in regions(mesh, random):
            piece = around(mesh, region)
            run = faired(*piece)
            if run is None or crosses_itself(*piece):
                continue
            used.add(mesh.name)
            runs.append((region.rim, run))
            hole = filled(*piece) if len(runs) % EVERY == 0 else None
            if hole is not None:
                holes.append(hole)
    rows = []
    for low, high in pairwise(RIMS):
        of = [run for rim, run in runs if low <= rim < high]
        good = sum(run.is_success for run in of)
        rows.append([f"{low} to {high}", len(of), f"{good} ({good / max(len(of), 1):.1%})"])
    return {
        "regions": len(runs),
        "holes": len(holes),
        "meshes": len(used),
        "attempts": attempts([run for _, run in runs], holes),
        "rims": table("rim | regions | converged", rows),
    }
