"""Meshes whose answers are known."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np


class Region(NamedTuple):
    """A mesh with a spoilt region, and where its vertices belong."""

    vertices: np.ndarray
    faces: np.ndarray
    free: np.ndarray
    exact: np.ndarray


def grid(rows, columns):
    """Triangles of a grid of vertices, numbered row by row; x runs with the rows, y with the columns."""
    i = np.arange(rows * columns).reshape(rows, columns)
    a, b, c, d = i[:-1, :-1], i[1:, :-1], i[1:, 1:], i[:-1, 1:]
    lower, upper = (np.stack(corners, axis=-1).reshape(-1, 3) for corners in ((a, b, c), (a, c, d)))
    return np.concatenate([lower, upper])


def jittered(side, seed):
    """Points of a grid over (-1/2, 1/2)^2, all but the outermost shaken by a quarter of the spacing."""
    line = np.linspace(-0.5, 0.5, side)
    x, y = np.meshgrid(line, line, indexing="ij")
    random = np.random.RandomState(seed)
    shake = random.uniform(-0.25, 0.25, (2, side, side)) / (side - 1)
    shake[:, [0, -1], :] = shake[:, :, [0, -1]] = 0
    return x + shake[0], y + shake[1]


def dented_sphere(side=21, frame=5, seed=1):
    """A piece of the unit sphere, normals outward; all but ``frame`` rows around it is flattened, and free."""
    x, y = jittered(side, seed)
    exact = np.stack([x, y, np.sqrt(1 - x * x - y * y)], axis=-1).reshape(-1, 3)
    free = np.zeros((side, side), bool)
    free[frame:-frame, frame:-frame] = True
    free = free.ravel()
    vertices = exact.copy()
    vertices[free, 2] = 0.8
    return Region(vertices, grid(side, side), free, exact)


def flattened_roof(side=15, frame=4):
    """Two planes that meet at right angles in a ridge along the x axis; in the middle they are flattened, and free."""
    line = np.arange(side) - side // 2.0
    x, y = np.meshgrid(line, line, indexing="ij")
    exact = np.stack([x, y, -np.abs(y)], axis=-1).reshape(-1, 3)
    free = np.zeros((side, side), bool)
    free[frame:-frame, frame:-frame] = True
    free = free.ravel()
    vertices = exact.copy()
    vertices[free, 2] = -3.0
    return Region(vertices, grid(side, side), free, exact)


def fading_ridge(side=15, frame=4):
    """A ridge along the x axis, of 53 degrees on one side of the free part; on the other side the surface is flat."""
    vertices, faces, free, _ = flattened_roof(side, frame)
    x, y = vertices[:, 0], vertices[:, 1]
    far = np.clip((x + 3) / 6, 0, 1)
    height = 1 - far * far * (3 - 2 * far)
    vertices = np.stack([x, y, -np.abs(y) * height / 2], axis=-1)
    return Region(vertices, faces, free, vertices)


def dented_cylinder(side=31, frame=5, seed=1):
    """A quarter and more of a cylinder of radius 1/2 around the y axis, normals outward."""
    x, y = jittered(side, seed)
    angle = 2 * x
    exact = np.stack([0.5 * np.sin(angle), y, 0.5 * np.cos(angle)], axis=-1).reshape(-1, 3)
    free = np.zeros((side, side), bool)
    free[frame:-frame, frame:-frame] = True
    free = free.ravel()
    vertices = exact.copy()
    vertices[free, 2] *= 0.5
    return Region(vertices, grid(side, side), free, exact)


def disc(rings=8):
    """The unit disc in the plane z = 0, normals up: ring k has 6 k vertices. Free is all but the outermost ring."""
    points, starts = [[0.0, 0.0, 0.0]], [0]
    faces = []
    for k in range(1, rings + 1):
        start = len(points)
        angle = 2 * np.pi * np.arange(6 * k) / (6 * k)
        points.extend(np.stack([np.cos(angle), np.sin(angle), 0 * angle], axis=-1) * k / rings)
        inner = [starts[-1]] if k == 1 else list(range(starts[-1], start))
        for sector in range(6):
            for j in range(k):
                outer = [start + (sector * k + j + m) % (6 * k) for m in (0, 1)]
                base = [inner[(sector * (k - 1) + j + m) % len(inner)] for m in (0, 1)]
                faces.append([base[0], outer[0], outer[1]])
                if j < k - 1:
                    faces.append([base[0], outer[1], base[1]])
        starts.append(start)
    vertices = np.array(points)
    free = np.arange(len(vertices)) < starts[-1]
    return Region(vertices, np.array(faces), free, vertices)


def sphere(level=3, radius=1.0):
    """A closed sphere, normals outward: an icosahedron, each triangle divided into 4^level."""
    g = (1 + 5**0.5) / 2
    points = [(-1, g, 0), (1, g, 0), (-1, -g, 0), (1, -g, 0), (0, -1, g), (0, 1, g)]
    points += [(0, -1, -g), (0, 1, -g), (g, 0, -1), (g, 0, 1), (-g, 0, -1), (-g, 0, 1)]
    faces = [(0, 11, 5), (0, 5, 1), (0, 1, 7), (0, 7, 10), (0, 10, 11), (1, 5, 9), (5, 11, 4), (11, 10, 2), (10, 7, 6)]
    faces += [(7, 1, 8), (3, 9, 4), (3, 4, 2), (3, 2, 6), (3, 6, 8), (3, 8, 9), (4, 9, 5), (2, 4, 11), (6, 2, 10)]
    faces += [(8, 6, 7), (9, 8, 1)]
    vertices, faces = np.array(points, float), np.array(faces)
    for _ in range(level):
        edges = np.sort(np.concatenate([faces[:, [0, 1]], faces[:, [1, 2]], faces[:, [2, 0]]]), axis=1)
        unique, inverse = np.unique(edges, axis=0, return_inverse=True)
        middle = len(vertices) + inverse.reshape(3, -1).T
        vertices = np.concatenate([vertices, vertices[unique].mean(axis=1)])
        a, b, c = faces.T
        ab, bc, ca = middle.T
        parts = ((a, ab, ca), (b, bc, ab), (c, ca, bc), (ab, bc, ca))
        faces = np.concatenate([np.stack(part, axis=-1) for part in parts])
    return vertices * (radius / np.linalg.norm(vertices, axis=1))[:, None], faces


def cube(cells):
    """The surface of a cube, normals outward, in so many cells along each edge; free is what lies inside the top."""
    u, v = np.meshgrid(np.arange(cells + 1), np.arange(cells + 1), indexing="ij")
    sides, faces = [], []
    for axis in range(3):
        for height in (0, cells):
            side = np.stack(np.roll([np.full(u.shape, height), u, v], axis, axis=0), axis=-1).reshape(-1, 3)
            of_side = grid(cells + 1, cells + 1)
            faces.append((of_side if height else of_side[:, ::-1]) + sum(map(len, sides)))
            sides.append(side)
    vertices, number = np.unique(np.concatenate(sides), axis=0, return_inverse=True)
    free = (vertices[:, 2] == cells) & (vertices[:, :2] % cells != 0).all(axis=1)
    return Region(vertices.astype(float), number.ravel()[np.concatenate(faces)], free, vertices)


def flared_tube(around=12, rows=7, outer=3, flare=40.0):
    """A tube of radius 1 and length 3, which is free; its ends flare outwards like cones, by an angle in degrees."""
    step, tilt = 3 / (rows - 1), np.radians(flare)
    row = np.arange(-outer, rows + outer)
    inside = np.clip(row, 0, rows - 1)
    r = 1 + step * np.abs(row - inside) * np.sin(tilt)
    z = step * (inside + (row - inside) * np.cos(tilt)) - 1.5
    turn = 2 * np.pi * np.arange(around) / around
    vertices = np.stack([np.outer(r, np.cos(turn)), np.outer(r, np.sin(turn)), np.outer(z, np.ones(around))], axis=-1)
    a = np.arange(len(row) * around).reshape(-1, around)
    b, c, d = np.roll(a, -1, axis=1)[:-1], a[1:], np.roll(a, -1, axis=1)[1:]
    faces = np.concatenate([np.stack(t, axis=-1).reshape(-1, 3) for t in ((a[:-1], b, d), (a[:-1], d, c))])
    free = np.repeat((row > 0) & (row < rows - 1), around)
    return Region(vertices.reshape(-1, 3), faces, free, vertices.reshape(-1, 3))


def smallest_angle(vertices, faces):
    """In degrees, in double precision."""
    corners = vertices.astype(float)[faces]
    first, second = (np.roll(corners, -k, axis=1) - corners for k in (1, 2))
    sine = np.linalg.norm(np.cross(first, second), axis=2)
    return np.degrees(np.arctan2(sine, (first * second).sum(axis=2))).min()


def without(vertices, faces, gone):
    """A mesh without the faces in a mask; vertices that no face names are left out."""
    faces = faces[~gone]
    used = np.unique(faces)
    number = np.full(len(vertices), -1)
    number[used] = np.arange(len(used))
    return vertices[used], number[faces]


def band_missing(level=4, half=0.3):
    """The unit sphere without a band around the equator."""
    vertices, faces = sphere(level)
    return without(vertices, faces, (np.abs(vertices[faces, 2]) < half).any(axis=1))


def in_pieces(level=5, half=0.06):
    """The unit sphere in four pieces with gaps between them."""
    vertices, faces = sphere(level)
    return without(vertices, faces, (np.abs(vertices[faces][:, :, :2]) < half).any(axis=(1, 2)))


def sphere_with_hole(level=4, above=0.8, radius=1.0):
    """A sphere without the triangles above a height."""
    vertices, faces = sphere(level, radius)
    return without(vertices, faces, (vertices[faces, 2] >= above * radius).all(axis=1))


def off_sphere(vertices, radius=1.0):
    """The largest distance of a vertex to the sphere."""
    return np.abs(np.linalg.norm(vertices, axis=1) - radius).max()
