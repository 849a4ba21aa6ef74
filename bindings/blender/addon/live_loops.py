# SPDX-License-Identifier: GPL-3.0-or-later
"""The boundary loops of a region: the curves of fixed vertices that the surface leaves from."""

from dataclasses import dataclass

import numpy as np


@dataclass
class Loop:
    """The region lies to the left of the way from each vertex to the next one, seen from the side that normals point to."""

    vertices: np.ndarray
    #: The way along the loop to each vertex, (k,), and around it, as seen in the scene.
    along: np.ndarray
    length: float

    @property
    def is_point(self):
        """One fixed vertex with free ones all around."""
        return self.length == 0.0

    def distances(self, vertex):
        """How far each vertex is from `vertex` along the loop, (k,): negative where it lies behind."""
        if self.is_point:
            return np.zeros(1)
        ahead = (self.along - self.along[np.flatnonzero(self.vertices == vertex)[0]]) % self.length
        return np.where(ahead > self.length / 2, ahead - self.length, ahead)


def loops_of(mesh, free):
    """The loops of the region of `free`, (n,), of a `Snapshot`; copies of a vertex are one, and it is named by the first."""
    inside = mesh.triangles[free[mesh.triangles].any(axis=1)]
    if not len(inside):
        return []
    halves = np.concatenate([inside[:, [0, 1]], inside[:, [1, 2]], inside[:, [2, 0]]])
    halves = _without_other_half(halves, len(free))
    # Copies lie at open edges.
    first = _first_copies(mesh, np.unique(halves))
    after = {}
    for a, b in _without_other_half(first[halves], len(free)).tolist():
        after.setdefault(a, []).append(b)
    positions = mesh.seen()
    loops = [_measured(walk, positions) for walk in _walks(after)]
    return loops + _points(free, np.unique(first[inside]), loops)


def _without_other_half(halves, count):
    """Of half-edges, (h, 2), between so many vertices those whose edge is not run through the other way, too."""
    # As one number each.
    halves = halves.astype(np.int64)
    there, back = halves @ (count, 1), halves @ (1, count)
    return halves[~np.isin(there, back)]


def _points(free, used, loops):
    """Fixed vertices within the region, each a loop of its own of no length."""
    on_loops = np.concatenate([loop.vertices for loop in loops]) if loops else []
    inside = used[~free[used] & ~np.isin(used, on_loops)]
    return [Loop(np.array([vertex]), np.zeros(1), 0.0) for vertex in inside]


def _first_copies(mesh, used):
    """For each vertex the first of `used` at its place."""
    first = np.arange(len(mesh.vertices))
    # Blender's zeros have signs.
    _, index, inverse = np.unique(mesh.vertices[used] + 0.0, axis=0, return_index=True, return_inverse=True)
    first[used] = used[index[inverse.ravel()]]
    return first


def _walks(after):
    walks = []
    while after:
        start = at = next(iter(after))
        walk = []
        while at in after:
            walk.append(at)
            beyond = after[at]
            following = beyond.pop()
            if not beyond:
                del after[at]
            at = following
            if at == start:
                break
        walks.append(walk)
    return walks


def _measured(walk, positions):
    vertices = np.array(walk)
    points = positions[vertices]
    steps = np.linalg.norm(np.roll(points, -1, axis=0) - points, axis=1)
    along = np.concatenate([[0.0], np.cumsum(steps[:-1])])
    return Loop(vertices, along, float(steps.sum()))


def nearest(loops, on_screen, pointer):
    """The loop and the vertex nearest to the pointer, and their distance in pixels; `on_screen` (n, 2) of all vertices.

    What is behind the viewer is NaN there. None where nothing is seen.
    """
    best = None
    for loop in loops:
        away = np.linalg.norm(on_screen[loop.vertices] - pointer, axis=1)
        if np.isnan(away).all():
            continue
        at = int(np.nanargmin(away))
        if best is None or away[at] < best[2]:
            best = loop, int(loop.vertices[at]), float(away[at])
    return best
