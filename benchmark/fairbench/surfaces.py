"""Surfaces that are known exactly: meshes of them, and how far a point is from them.

All are surfaces of revolution about z, whose profile (r, z) is a curve in the half plane r >= 0; the ellipsoid is one of two equal semi-axes.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray
from scipy.integrate import solve_ivp

from .meshes import Mesh, Points

Numbers = NDArray[np.float64]
Triple = tuple[int, ...]
Vector = tuple[float, ...]
#: Points of a profile that distances are taken to: chords of a curve of length 1 are off by less than 1e-8.
FINE = 8_000
#: How far a vertex of an irregular mesh is from its place, in edges: the smallest angle of eight meshes is 22 degrees; at half it is 25, as regular
#: as flips leave it; at double 548 edges are folded.
JITTER = 0.2


class Surface(NamedTuple):
    """A profile over a parameter from 0 to 1 by its arc length, and whether it ends on the axis."""

    name: str
    profile: Callable[[Numbers], Numbers]
    #: The mesh is closed there: at the beginning, at the end.
    poles: tuple[bool, bool]

    def fine(self) -> Numbers:
        """The profile's points, (FINE, 2)."""
        return self.profile(np.linspace(0, 1, FINE))

    def length(self) -> float:
        """Of the profile."""
        return float(np.linalg.norm(np.diff(self.fine(), axis=0), axis=1).sum())

    def distance(self, points: Points) -> Numbers:
        """From the surface, without a sign."""
        curve = self.fine()
        at = np.column_stack([np.hypot(points[:, 0], points[:, 1]), points[:, 2]])
        best = np.full(len(points), np.inf)
        for part in np.array_split(np.arange(len(at)), max(1, len(at) // 500)):
            squares = ((at[part, None] - curve[None]) ** 2).sum(axis=2)
            near = squares.argmin(axis=1)
            for other in (near - 1, near):
                first = np.clip(other, 0, FINE - 2)
                a, b = curve[first], curve[first + 1]
                along = np.clip(((at[part] - a) * (b - a)).sum(axis=1) / ((b - a) ** 2).sum(axis=1), 0, 1)
                best[part] = np.minimum(best[part], np.linalg.norm(at[part] - a - along[:, None] * (b - a), axis=1))
        return best


def _arc(radius: float, low: float, high: float, centre: float = 0.0) -> Callable[[Numbers], Numbers]:
    def profile(s: Numbers) -> Numbers:
        angle = low + s * (high - low)
        return np.column_stack([centre + radius * np.cos(angle), radius * np.sin(angle)])

    return profile


def _curve(points: Numbers) -> Callable[[Numbers], Numbers]:
    """Points over their arc length."""
    along = np.r_[0, np.cumsum(np.linalg.norm(np.diff(points, axis=0), axis=1))]

    def profile(s: Numbers) -> Numbers:
        return np.column_stack([np.interp(s * along[-1], along, points[:, k]) for k in range(2)])

    return profile


def _revolved(mean: float, slope: float, radius: float, length: float) -> Numbers:
    """The profile with mean curvature H, from the middle on, where it runs along the axis: H = `mean`, and r dH/ds = `slope` all along, so that H is
    harmonic. The angle to the r axis turns by 2 H - sin(angle) / r.
    """

    def rate(_: float, y: Numbers) -> list[float]:
        r, _, angle, h = y
        return [float(np.cos(angle)), float(np.sin(angle)), float(2 * h - np.sin(angle) / r), slope / float(r)]

    def half(way: int) -> Numbers:
        found = solve_ivp(
            lambda s, y: way * np.array(rate(s, y)),
            (0, length / 2),
            (radius, 0, np.pi / 2, mean),
            rtol=1e-11,
            atol=1e-12,
            t_eval=np.linspace(0, length / 2, FINE // 2),
        )
        return np.asarray(found.y[:2].T)

    return np.vstack([half(-1)[:0:-1], half(1)])


def surfaces() -> list[Surface]:
    """All of them, each about two units wide."""
    half = np.pi / 2
    z = np.linspace(-1, 1, FINE)
    tilt = np.linspace(-half, half, FINE)
    # Constant mean curvature, with a bulge of radius 1 and necks of .6; and one that falls along the axis.
    unduloid = _revolved(1 / 1.6, 0.0, 1.0, 3.6)
    band = _revolved(0.5, 0.25, 1.0, 2.4)
    return [
        Surface("sphere", _arc(1.0, -half, half), (True, True)),
        Surface("cylinder", _curve(np.column_stack([np.ones(FINE), 1.5 * z])), (False, False)),
        Surface("cone", _curve(np.column_stack([0.75 + 0.4 * z, 1.2 * z])), (False, False)),
        Surface("torus", _arc(0.4, -np.pi, np.pi, centre=1.0), (False, False)),
        Surface("ellipsoid", _curve(np.column_stack([np.cos(tilt), 0.6 * np.sin(tilt)])), (True, True)),
        Surface("catenoid", _curve(np.column_stack([np.cosh(z), z])), (False, False)),
        Surface("unduloid", _curve(unduloid), (False, False)),
        Surface("band", _curve(band), (False, False)),
    ]


def mesh_of(surface: Surface, edge: float, kind: str, random: np.random.Generator, stretch: float = 1.0) -> Mesh:
    """A mesh of about this edge length: "regular", or "irregular", with vertices moved along the surface and edges flipped. With `stretch` triangles are
    so many times as long along the profile as around.
    """
    rows = max(3, round(surface.length() / (edge * stretch * 0.866)) + 1)
    is_closed = surface.name == "torus"
    places = (np.arange(rows) + 0.5) / rows if is_closed else np.linspace(0, 1, rows)
    vertices, lists, ends = [], [], []
    for row, s in enumerate(places):
        r = float(surface.profile(np.array([s]))[0, 0])
        is_pole = (surface.poles[0] and row == 0) or (surface.poles[1] and row == rows - 1)
        count = 1 if is_pole else max(6, round(2 * np.pi * r / edge))
        angles = 2 * np.pi * (np.arange(count) + 0.5 * (row % 2)) / count
        along = np.full(count, s)
        is_inside = is_closed or 0 < row < rows - 1
        if kind == "irregular" and is_inside:
            angles += random.uniform(-JITTER, JITTER, count) * 2 * np.pi / count
            along += random.uniform(-JITTER, JITTER, count) / rows
        at = surface.profile(along % 1.0 if is_closed else np.clip(along, 0, 1))
        lists.append(np.arange(count) + sum(ends))
        ends.append(count)
        vertices.append(np.column_stack([at[:, 0] * np.cos(angles), at[:, 0] * np.sin(angles), at[:, 1]]))
    pairs = list(zip(lists, lists[1:], strict=False)) + ([(lists[-1], lists[0])] if is_closed else [])
    faces = np.vstack([between(low, high) for low, high in pairs])
    mesh = Mesh(np.vstack(vertices), faces)
    return _flipped(mesh, random) if kind == "irregular" else mesh


def between(low: NDArray[np.int64], high: NDArray[np.int64]) -> NDArray[np.int64]:
    """Triangles between two rings of vertices, whose numbers need not be the same: the ring that is behind goes on."""
    faces, i, j = [], 0, 0
    while i < len(low) or j < len(high):
        a, b = low[i % len(low)], high[j % len(high)]
        is_behind = (i + 1) * len(high) <= (j + 1) * len(low)
        takes_low = j == len(high) or (i < len(low) and len(low) > 1 and (is_behind or len(high) == 1))
        if takes_low:
            i += 1
            faces.append((a, low[i % len(low)], b))
        else:
            j += 1
            faces.append((a, high[j % len(high)], b))
    return np.array([face for face in faces if len(set(face)) == 3], np.int64)


def _flipped(mesh: Mesh, random: np.random.Generator) -> Mesh:
    """Edges flipped where that makes the smallest angle larger, and then a seventh of all where it leaves 25 degrees: vertices have four to eight
    neighbours.
    """
    flips = _Flips(mesh)
    for _ in range(3):
        for edge in sorted(flips.sides):
            flips.flip(edge, lambda old, new: new > old + 1)
    edges = sorted(flips.sides)
    for pick in random.permutation(len(edges))[: len(edges) // 7]:
        flips.flip(edges[pick], lambda _, new: new > 25)
    return Mesh(mesh.vertices, np.array(flips.triangles, np.int64))


class _Flips:
    """Triangles whose edges are flipped. Plain numbers: arrays of three take ten times as long."""

    def __init__(self, mesh: Mesh) -> None:
        self.points = [tuple(map(float, p)) for p in mesh.vertices]
        self.triangles = [tuple(map(int, face)) for face in mesh.faces]
        #: The triangle of each directed edge.
        self.sides = {edge: t for t, corners in enumerate(self.triangles) for edge in _edges(corners)}

    def flip(self, edge: tuple[int, int], is_wanted: Callable[[float, float], bool]) -> None:
        """Flips an edge if it can be, and the smallest angles before and after are as wanted."""
        a, b = edge
        t, u = self.sides.get((a, b)), self.sides.get((b, a))
        if t is None or u is None:
            return
        c, d = (next(v for v in self.triangles[f] if v not in (a, b)) for f in (t, u))
        if (c, d) in self.sides or (d, c) in self.sides:
            return
        old, new = [self.triangles[t], self.triangles[u]], [(c, d, b), (d, c, a)]
        shapes = [[self._shape(corners) for corners in some] for some in (old, new)]
        if min(_dot(n, m) for n, _ in shapes[0] for m, _ in shapes[1]) <= 0:
            return
        if not is_wanted(*(min(angle for _, angle in some) for some in shapes)):
            return
        for corners in old:
            for side in _edges(corners):
                del self.sides[side]
        for f, corners in zip((t, u), new, strict=True):
            self.triangles[f] = corners
            self.sides.update(dict.fromkeys(_edges(corners), f))

    def _shape(self, corners: Triple) -> tuple[Vector, float]:
        """The normal, and the smallest angle in degrees."""
        a, b, c = (self.points[v] for v in corners)
        x, y, z = (tuple(q - p for p, q in zip(*ends, strict=True)) for ends in ((a, b), (b, c), (c, a)))
        normal = (x[1] * y[2] - x[2] * y[1], x[2] * y[0] - x[0] * y[2], x[0] * y[1] - x[1] * y[0])
        area = math.sqrt(_dot(normal, normal))
        return normal, math.degrees(min(math.atan2(area, -_dot(p, q)) for p, q in ((x, y), (y, z), (z, x))))


def _edges(corners: Triple) -> tuple[tuple[int, int], ...]:
    a, b, c = corners
    return (a, b), (b, c), (c, a)


def _dot(p: Vector, q: Vector) -> float:
    return p[0] * q[0] + p[1] * q[1] + p[2] * q[2]
