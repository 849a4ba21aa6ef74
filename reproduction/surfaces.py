"""Distances to the exact surfaces that `fairmesh generate` makes. Axes of revolution are the z axis."""

from __future__ import annotations

import math
from functools import cache

import numpy as np
from numpy.typing import NDArray
from scipy.spatial import cKDTree

from .tool import Points

#: Of the profiles, in arc length. What is neglected goes with its third power.
_STEP = 2e-4


def distance(kind: str, points: Points) -> NDArray[np.float64]:
    """Of points near the surface that the program generates by this name."""
    radius = np.hypot(points[:, 0], points[:, 1])
    if kind.startswith("sphere"):
        return np.abs(np.linalg.norm(points, axis=1) - 1)
    if kind == "cylinder":
        return np.abs(radius - 1)
    if kind == "torus":
        return np.abs(np.hypot(radius - 1, points[:, 2]) - 0.4)
    if kind == "ellipsoid":
        return _to_ellipsoid(points, np.array([1, 0.8, 0.6]))
    return _to_profile(np.column_stack([radius, points[:, 2]]), kind)


def _to_ellipsoid(points: Points, semi_axes: NDArray[np.float64]) -> NDArray[np.float64]:
    """The nearest point is `a^2 p / (a^2 + t)`; Newton's method for `t`."""
    squares, t = semi_axes**2, np.zeros((len(points), 1))
    for _ in range(30):
        terms = squares * (points / (squares + t)) ** 2
        t += (terms.sum(axis=1, keepdims=True) - 1) / (2 * terms / (squares + t)).sum(axis=1, keepdims=True)
    return np.linalg.norm(points * (t / (squares + t)), axis=1)


@cache
def _profile(kind: str) -> NDArray[np.float64]:
    """Rows `r, z, f, H` by arc length; the profile has the direction `(cos f, sin f)`.

    With the outward normal `(sin f, -cos f)` the curvatures are `-f'` and `-sin f / r`, so that
    `f' = -2 H - sin f / r`; and `dH/ds = c / r` where H is harmonic. Runge-Kutta.
    """
    start, c, low, high = {
        "catenoid": ((1.0, 0.0, math.pi / 2, 0.0), 0.0, -1.7, 1.7),
        # From the neck; the bulge has the radius 1.
        "unduloid": ((0.7, 0.0, math.pi / 2, -1 / 1.7), 0.0, -1.7, 1.7),
        "revolution": ((1.0, 0.0, 1.0, -1.0), 0.5, -0.3, 2.3),
    }[kind]

    def rate(y: NDArray[np.float64]) -> NDArray[np.float64]:
        r, _, f, h = y
        return np.array([math.cos(f), math.sin(f), -2 * h - math.sin(f) / r, c / r])

    def walk(length: float) -> list[NDArray[np.float64]]:
        step, rows = math.copysign(_STEP, length), [np.array(start)]
        for _ in range(round(length / step)):
            y = rows[-1]
            k1 = rate(y)
            k2 = rate(y + step / 2 * k1)
            k3 = rate(y + step / 2 * k2)
            rows.append(y + step / 6 * (k1 + 2 * k2 + 2 * k3 + rate(y + step * k3)))
        return rows

    return np.array(walk(low)[:0:-1] + walk(high))


def _to_profile(points: NDArray[np.float64], kind: str) -> NDArray[np.float64]:
    """The distance to the circle of curvature at the nearest row of the profile."""
    profile = _profile(kind)
    r, z, f, h = profile[cKDTree(profile[:, :2]).query(points)[1]].T
    gap, curvature = points - np.column_stack([r, z]), -2 * h - np.sin(f) / r
    a = gap[:, 0] * np.cos(f) + gap[:, 1] * np.sin(f)
    b = gap[:, 1] * np.cos(f) - gap[:, 0] * np.sin(f)
    # |q - centre| - 1 / curvature, without dividing by a curvature of 0.
    twice = np.abs(curvature * (a * a + b * b) - 2 * b)
    return twice / (np.hypot(curvature * a, 1 - curvature * b) + 1)
