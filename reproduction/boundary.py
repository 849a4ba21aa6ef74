"""What shows along the boundary of a region, measured alike for the surfaces of all programs.

The jump of mean curvature, and how far the surface deviates from the normals of its surroundings.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

import fairmesh

from .tool import Case, Points

#: Values are extrapolated from vertices so many edges away. The nearest have neighbours on both sides.
REACH = range(2, 5)
#: From so many of them at least.
FEWEST = 6


class Shown(NamedTuple):
    """Of a surface along the boundary."""

    #: Of mean curvature, over the root mean square of the surroundings' own.
    jump_rms: float
    jump_max: float
    #: The largest angle between the surface and the normals there, in degrees.
    deviation: float


class Boundary:
    """That of the free vertices of a mesh, with the normals that `fairmesh` fits to the surroundings."""

    def __init__(self, case: Case) -> None:
        result = fairmesh.fair(case.positions, case.triangles, case.free)
        self.triangles = case.triangles
        self.vertices, self.normals = result.boundary_vertices, result.boundary_normals
        self.is_free = np.zeros(len(case.positions), bool)
        self.is_free[case.free] = True
        neighbours: list[set[int]] = [set() for _ in case.positions]
        for a, b, c in case.triangles.tolist():
            neighbours[a] |= {b, c}
            neighbours[b] |= {c, a}
            neighbours[c] |= {a, b}
        sides = [set(np.flatnonzero(self.is_free == side)) - set(self.vertices) for side in (True, False)]
        #: For each boundary vertex those from which is extrapolated, inside and outside.
        self.around = [[_within_reach(v, neighbours, side) for side in sides] for v in self.vertices]

    def shown(self, positions: Points) -> Shown:
        """What a surface of the region shows."""
        h = fairmesh.mean_curvature(positions, self.triangles)
        jumps, outside = [], []
        for v, normal, around in zip(self.vertices, self.normals, self.around):
            inner, outer = (_extrapolated(positions[v], normal, positions[side], h[side]) for side in around)
            if inner is not None and outer is not None:
                jumps.append(inner - outer)
                outside.append(outer)
        rms = [float(np.sqrt(np.mean(np.square(values)))) for values in (jumps, outside)]
        return Shown(rms[0] / rms[1], float(np.max(np.abs(jumps))) / rms[1], self.deviation(positions))

    def deviation(self, positions: Points) -> float:
        """From the mean normal of the region's triangles at a boundary vertex to that of its surroundings."""
        inside = self.triangles[self.is_free[self.triangles].any(axis=1)]
        a, b, c = (positions[inside[:, k]] for k in range(3))
        sums = np.zeros_like(positions)
        np.add.at(sums, inside, np.cross(b - a, c - a)[:, None])
        found = sums[self.vertices]
        sines = np.linalg.norm(np.cross(found, self.normals), axis=1)
        return float(np.degrees(np.max(np.arctan2(sines, (found * self.normals).sum(axis=1)))))


def _within_reach(vertex: int, neighbours: list[set[int]], side: set[int]) -> NDArray[np.int64]:
    """The vertices within `REACH` along edges on one side of the boundary."""
    found: list[int] = []
    reached, front = {vertex}, {vertex}
    for edges in range(1, REACH.stop):
        front = (set().union(*(neighbours[v] for v in front)) & side) - reached
        reached |= front
        if edges in REACH:
            found += sorted(front)
    return np.array(found, np.int64)


def _extrapolated(place: Points, normal: Points, positions: Points, values: NDArray[np.float64]) -> float | None:
    """The value at a place of the linear function in its tangent plane that fits these values best."""
    known = np.isfinite(values)
    if np.count_nonzero(known) < FEWEST:
        return None
    across = np.cross(normal, [1, 0, 0] if abs(normal[0]) < 0.6 else [0, 1, 0])
    across /= np.linalg.norm(across)
    edges = positions[known] - place
    rows = np.column_stack([np.ones(len(edges)), edges @ across, edges @ np.cross(normal, across)])
    return float(np.linalg.lstsq(rows, values[known], rcond=None)[0][0])
