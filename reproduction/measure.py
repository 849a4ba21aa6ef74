"""Distances and angles, and how figures are written."""

from __future__ import annotations

from collections.abc import Iterable
from typing import NamedTuple

import igl
import numpy as np
from numpy.typing import NDArray

from .tool import Points, Triangles


class Distance(NamedTuple):
    """Of many points."""

    max: float
    rms: float


def spread(distances: NDArray[np.float64]) -> Distance:
    """Largest and root mean square."""
    return Distance(float(np.max(np.abs(distances))), float(np.sqrt(np.mean(distances**2))))


def diagonal(positions: Points) -> float:
    """Of the bounding box."""
    return float(np.linalg.norm(np.ptp(positions, axis=0)))


def to_mesh(points: Points, positions: Points, triangles: Triangles) -> Distance:
    """The distances of points to the surface of a mesh, over the mesh's diagonal."""
    squares = igl.point_mesh_squared_distance(points, positions, triangles.astype(np.int64))[0]
    return spread(np.sqrt(squares) / diagonal(positions))


def apart(a: Points, b: Points) -> Distance:
    """The distances of vertices of the same number, over the diagonal."""
    return spread(np.linalg.norm(a - b, axis=1) / diagonal(a))


def angles(positions: Points, triangles: Triangles) -> NDArray[np.float64]:
    """Of the triangles, in degrees."""
    corners = positions[triangles]
    a, b = (np.roll(corners, -k, axis=1) - corners for k in (1, 2))
    return np.degrees(np.arctan2(np.linalg.norm(np.cross(a, b), axis=2), (a * b).sum(axis=2)))


def scientific(x: float) -> str:
    """Two digits with an exponent."""
    mantissa, _, exponent = f"{x:.1e}".partition("e")
    return f"{mantissa}e{int(exponent)}"


def short(x: float) -> str:
    """A number in few digits."""
    # The distance of a surface to itself is rounding.
    if abs(x) < 1e-15:
        return "0"
    if 0.01 <= abs(x) < 1e4:
        return f"{x:.{min(max(2 - int(np.floor(np.log10(abs(x)))), 0), 4)}f}"
    return scientific(x)


def table(columns: str, rows: Iterable[Iterable[object]]) -> str:
    """Columns are separated by bars."""
    lines = [f"| {columns} |", "|" + "---|" * (1 + columns.count("|"))]
    lines += [f"| {' | '.join(map(str, cells))} |" for cells in rows]
    return "\n".join(lines)
