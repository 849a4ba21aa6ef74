# SPDX-License-Identifier: GPL-3.0-or-later
"""How the quads of a region are cut into triangles for the computation.

Blender cuts each quad by its present shape, which says nothing in a region that is to be replaced. The library's curvature
is most accurate at vertices with six triangles, and only approximate at three and four. So neighbouring quads are cut in
parallel, which gives six in a grid; where the grid is irregular single diagonals are turned.
"""

import numpy as np

LOW = 4


def cut_evenly(mesh, free):
    """Triangles of a `Snapshot`, (m, 3), those of quads with free vertices, (n,), cut anew. The order is the same."""
    starts = mesh.corner_starts
    quads = np.flatnonzero(np.diff(starts) == 4)
    corners = mesh.corners[starts[quads][:, None] + np.arange(4)]
    chosen = free[corners].any(axis=1)
    quads, corners = quads[chosen], corners[chosen]
    if not len(quads):
        return mesh.triangles
    sides = _parallel(*_neighbours(mesh, quads))
    # The first triangle of each face.
    first = starts[quads] - 2 * quads
    triangles = mesh.triangles.copy()
    _write(triangles, first, corners, sides)
    if _turn_single(triangles, corners, sides, free):
        _write(triangles, first, corners, sides)
    return triangles


def _neighbours(mesh, quads):
    """Per quad and edge: the chosen quad beyond, or -1; and the parity of the two positions of the edge."""
    count = len(mesh.edge_faces)
    edges = mesh.edge_of_corner[mesh.corner_starts[quads][:, None] + np.arange(4)].ravel()
    places = np.arange(4 * len(quads))
    first, last = np.empty(count, np.int64), np.empty(count, np.int64)
    first[edges[::-1]] = places[::-1]
    last[edges] = places
    beyond = np.where(first[edges] == places, last[edges], first[edges])
    inside = (mesh.edge_faces[edges] == 2) & (beyond != places)
    parity = (places + beyond) % 2
    return np.where(inside, beyond // 4, -1).reshape(-1, 4), parity.reshape(-1, 4)


def _parallel(neighbours, parity):
    """Per quad 0: cut from corner 0 to 2, 1: from 1 to 3. Across an edge the cuts go through different ends of it."""
    # Quads without neighbours are cut either way.
    sides = np.where((neighbours < 0).all(axis=1), 0, -1).astype(np.int8)
    seed = 0
    while True:
        seed += int(np.argmax(sides[seed:] < 0))
        if sides[seed] >= 0:
            return sides
        sides[seed] = 0
        front = np.array([seed])
        while len(front):
            beyond = neighbours[front].ravel()
            wanted = ((sides[front][:, None] + parity[front]) % 2).ravel()
            new = (beyond >= 0) & (sides[beyond] < 0)
            beyond, wanted = beyond[new], wanted[new]
            sides[beyond] = wanted
            front = np.unique(beyond)


def _write(triangles, first, corners, sides):
    turned = np.where(sides[:, None] == 1, np.roll(corners, -1, axis=1), corners)
    triangles[first] = turned[:, [0, 1, 2]]
    triangles[first + 1] = turned[:, [0, 2, 3]]


def _turn_single(triangles, corners, sides, free):
    """Turns diagonals towards vertices with few triangles, where that takes none from a vertex with few. Any turned?"""
    valence = np.bincount(triangles.ravel(), minlength=len(free))
    low = free & (valence <= LOW)
    touching = np.flatnonzero(low[corners].any(axis=1))
    turned = False
    for quad in touching.tolist():
        vertices, side = corners[quad], sides[quad]
        losing, winning = vertices[[side, side + 2]], vertices[[1 - side, 3 - side]]
        if (low[winning] & (valence[winning] <= LOW)).any() and (~free[losing] | (valence[losing] > LOW + 1)).all():
            sides[quad] = 1 - side
            valence[losing] -= 1
            valence[winning] += 1
            turned = True
    return turned
