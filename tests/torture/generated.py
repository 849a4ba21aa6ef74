"""Meshes that are hard by design: slots with very short edges at their ends, hubs, coordinates far off."""

from __future__ import annotations

import numpy as np


def slot(around_end: int, along: int, ratio: float) -> tuple[np.ndarray, np.ndarray]:
    """A flat sheet with a slot: round ends of `around_end` edges, sides of `along` edges `ratio` times as long."""
    radius = 1.0
    short = 2 * radius * np.sin(np.pi / (2 * around_end))
    half = ratio * short * along / 2
    turn = np.pi * np.arange(around_end) / around_end
    right = np.column_stack([half + radius * np.sin(turn), -radius * np.cos(turn)])
    side = half - 2 * half * np.arange(along) / along
    top = np.column_stack([side, np.full(along, radius)])
    loop = np.concatenate([right, top, -right, -top])
    return strip(loop)


def strip(loop: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Three rings of triangles around a convex loop of corners that runs counter-clockwise."""
    count = len(loop)
    edge = np.roll(loop, -1, 0) - loop
    normal = np.column_stack([edge[:, 1], -edge[:, 0]]) / np.linalg.norm(edge, axis=1)[:, None]
    out = normal + np.roll(normal, 1, 0)
    out /= np.linalg.norm(out, axis=1)[:, None]
    step = np.minimum(np.linalg.norm(edge, axis=1), np.linalg.norm(np.roll(edge, 1, 0), axis=1))[:, None]
    rings = [loop, loop + step * out, loop + 2 * step * out, loop + 3 * step * out]
    points = np.concatenate(rings)
    mesh = np.concatenate([ring_triangles(count, k) for k in range(3)])
    return np.column_stack([points, np.zeros(len(points))]), mesh


def ring_triangles(count: int, k: int) -> np.ndarray:
    i = np.arange(count)
    j = (i + 1) % count
    a, b = i + k * count, j + k * count
    return np.concatenate([np.column_stack([a, a + count, b + count]), np.column_stack([a, b + count, b])])


def hub(valence: int) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """A cap of the unit sphere whose pole has this valence; the pole and the ring about it are free."""
    turn = 2 * np.pi * np.arange(valence) / valence
    rings = [
        np.column_stack([np.sin(a) * np.cos(turn), np.sin(a) * np.sin(turn), np.full(valence, np.cos(a))])
        for a in (0.2, 0.3, 0.4, 0.5)
    ]
    points = np.concatenate([[[0, 0, 0.9]], *rings])
    i = np.arange(valence)
    fan = np.column_stack([np.zeros(valence, int), i + 1, (i + 1) % valence + 1])
    rest = [1 + ring_triangles(valence, k) for k in range(3)]
    return points, np.concatenate([fan, *rest]), np.arange(valence + 1)


def sphere(splits: int) -> tuple[np.ndarray, np.ndarray]:
    """An icosahedron split so many times, on the unit sphere."""
    g = (1 + 5**0.5) / 2
    x = [[-1, g, 0], [1, g, 0], [-1, -g, 0], [1, -g, 0], [0, -1, g], [0, 1, g]]
    x += [[0, -1, -g], [0, 1, -g], [g, 0, -1], [g, 0, 1], [-g, 0, -1], [-g, 0, 1]]
    t = [
        [0, 11, 5],
        [0, 5, 1],
        [0, 1, 7],
        [0, 7, 10],
        [0, 10, 11],
        [1, 5, 9],
        [5, 11, 4],
        [11, 10, 2],
        [10, 7, 6],
        [7, 1, 8],
    ]
    t += [
        [3, 9, 4],
        [3, 4, 2],
        [3, 2, 6],
        [3, 6, 8],
        [3, 8, 9],
        [4, 9, 5],
        [2, 4, 11],
        [6, 2, 10],
        [8, 6, 7],
        [9, 8, 1],
    ]
    points, triangles = np.array(x, float), np.array(t)
    for _ in range(splits):
        points, triangles = split(points, triangles)
    return points / np.linalg.norm(points, axis=1)[:, None], triangles


def split(points: np.ndarray, triangles: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    edges = np.sort(triangles[:, [0, 1, 1, 2, 2, 0]].reshape(-1, 2), axis=1)
    ends, number = np.unique(edges, axis=0, return_inverse=True)
    middle = number.reshape(-1, 3) + len(points)
    a, b, c = triangles.T
    u, v, w = middle.T
    quarters = [np.column_stack(t) for t in ((a, u, w), (b, v, u), (c, w, v), (u, v, w))]
    points = points / np.linalg.norm(points, axis=1)[:, None]
    return np.concatenate([points, points[ends].mean(1)]), np.concatenate(quarters)
