"""Edges that booleans leave, and the same solids with the edge rounded by a ball of constant radius that rolls along it: exact but for facets.

The middle of the ball runs along the curve at its radius from both surfaces. What it touches are the rails, and between them the rounding is an arc about the
middle. The truth is the union of the solids and of a ring whose section is that arc and the sharp edge.
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import NamedTuple

import manifold3d
import numpy as np

from .meshes import Mesh, Points

#: Sides of rods in the truth, and points across an arc: facets are off by 5e-5 of a rod's radius, and by .02 of that of an error of one per cent.
SIDES = 320
ARC = 24
#: Sides of rods in the input, as tools make them.
COARSE = 64
#: The arc's radius is longer by so much, so that its ends are below the facets of what it touches: those are off by 5e-5 of a radius of about one. With
#: nothing, walls of this height are left.
SUNK = 6e-5
#: How far the ring reaches into the solids, in radii of the ball: enough for a boolean to be sure of.
INTO = 0.2


class Blend(NamedTuple):
    """A part, the vertices of its edge in order, the ball's radius, and the part with the edge rounded."""

    name: str
    sharp: Mesh
    edge: list[int]
    radius: float
    rounded: Mesh
    #: The triangles of `rounded` on the rounding.
    wanted: np.ndarray


class Base(NamedTuple):
    """What a rod stands on: the plane z = 0 (radius 0), or a cylinder about the x axis."""

    radius: float

    def rod(self, radius: float, tilt: float, sides: int) -> manifold3d.Manifold:
        """A rod through the origin, which begins inside."""
        below = 0.8 if self.radius == 0 else 0.25
        return manifold3d.Manifold.cylinder(2.2 + below, radius, circular_segments=sides).translate((0, 0, -below)).rotate((0, tilt, 0))

    def solid(self, sides: int) -> manifold3d.Manifold:
        """Four wide."""
        if self.radius == 0:
            return manifold3d.Manifold.cube((4, 4, 1.5), True).translate((0, 0, -0.75))
        return manifold3d.Manifold.cylinder(4, self.radius, circular_segments=sides, center=True).rotate((0, 90, 0))

    def outward(self, points: Points) -> Points:
        """Unit normals of the surface below some points."""
        if self.radius == 0:
            return np.broadcast_to([0.0, 0.0, 1.0], points.shape)
        across = points * [0, 1, 1]
        return np.asarray(across / np.linalg.norm(across, axis=1)[:, None])

    def above(self, starts: Points, way: Points, height: float) -> Points:
        """Where lines are at a height above the surface, on their way up."""
        if self.radius == 0:
            return starts + ((height - starts[:, 2]) / way[2])[:, None] * way
        b, c = starts[:, 1:] @ way[1:], (starts[:, 1:] ** 2).sum(axis=1) - (self.radius + height) ** 2
        a = way[1:] @ way[1:]
        return np.asarray(starts + ((np.sqrt(b * b - a * c) - b) / a)[:, None] * way)


def blends(random: np.random.Generator) -> Iterator[Blend]:
    """A boss on a plate, upright and tilted, and two tees of rods, of random sizes."""
    for name, base, most in (("boss", 0.0, 0.0), ("boss-tilted", 0.0, 35.0), ("tee", 0.9, 0.0), ("tee-tilted", 0.9, 25.0)):
        tilt = random.uniform(0.5, 1) * most
        yield _blend(name, Base(base * random.uniform(0.9, 1.1)), random.uniform(0.35, 0.5), tilt, random.uniform(0.1, 0.18))


def _blend(name: str, base: Base, rod: float, tilt: float, radius: float) -> Blend:
    axis = np.array([np.sin(np.radians(tilt)), 0.0, np.cos(np.radians(tilt))])
    sharp = _mesh(base.solid(COARSE) + base.rod(rod, tilt, COARSE))
    on_base = np.abs(_height(base, sharp.vertices)) < 0.003
    across = sharp.vertices - (sharp.vertices @ axis)[:, None] * axis
    edge = np.flatnonzero(on_base & (np.abs(np.linalg.norm(across, axis=1) - rod) < 0.003) & (sharp.vertices @ axis > -0.5))
    around = np.arctan2(across[edge, 1], across[edge] @ np.array([axis[2], 0, -axis[0]]))
    ring = _ring(base, rod, axis, radius)
    # Where surfaces touch, facets cross and leave slivers.
    whole = (base.solid(SIDES) + base.rod(rod, tilt, SIDES) + ring).simplify(1e-4 * radius)
    rounded = _mesh(whole)
    return Blend(name, sharp, edge[np.argsort(around)].tolist(), radius, rounded, _of(whole, ring))


def _height(base: Base, points: Points) -> Points:
    return points[:, 2] if base.radius == 0 else np.linalg.norm(points[:, 1:], axis=1) - base.radius


def _ring(base: Base, rod: float, axis: Points, radius: float) -> manifold3d.Manifold:
    """The solid between the rounding and the edge."""
    angles = 2 * np.pi * np.arange(SIDES) / SIDES
    side, up = np.array([axis[2], 0, -axis[0]]), np.array([0.0, 1.0, 0.0])
    away = np.cos(angles)[:, None] * side + np.sin(angles)[:, None] * up
    middle = base.above((rod + radius) * away, axis, radius)
    down = base.outward(middle)
    # From the rod's rail to the base's, about the middle of the ball.
    turn = np.arccos(np.clip((away * down).sum(axis=1), -1, 1))[:, None]
    shares = np.linspace(0, 1, ARC + 1)[:, None, None]
    arc = middle - (radius + SUNK) * (np.sin((1 - shares) * turn) * away + np.sin(shares * turn) * down) / np.sin(turn)
    inside = [arc[-1] - INTO * radius * down, base.above(rod * away, axis, 0.0) - INTO * radius * (away + down), arc[0] - INTO * radius * away]
    rows = np.vstack([arc, inside])
    count = len(rows)
    at = np.arange(count)[:, None] * SIDES + np.arange(SIDES)
    right, below = np.roll(at, -1, axis=1), np.roll(at, -1, axis=0)
    corner = np.roll(below, -1, axis=1)
    faces = np.vstack([np.stack([at, below, corner], axis=2).reshape(-1, 3), np.stack([at, corner, right], axis=2).reshape(-1, 3)])
    return manifold3d.Manifold(manifold3d.Mesh64(rows.reshape(-1, 3), faces.astype(np.uint64))).as_original()


def _mesh(solid: manifold3d.Manifold) -> Mesh:
    made = solid.to_mesh64()
    return Mesh(np.asarray(made.vert_properties, float)[:, :3], np.asarray(made.tri_verts, np.int64))


def _of(whole: manifold3d.Manifold, part: manifold3d.Manifold) -> np.ndarray:
    """The triangles that one of its parts has brought."""
    made = whole.to_mesh64()
    owner = np.repeat(np.asarray(made.run_original_id), np.diff(np.asarray(made.run_index)) // 3)
    return np.asarray(owner == part.original_id())
