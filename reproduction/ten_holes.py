"""Ten regions of known surfaces: tangent planes alone, curvature where it is certain, and the truth."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Callable

import numpy as np
from numpy.typing import NDArray

from .measure import diagonal, spread, table
from .tool import Case, Points, Tool

Values = NDArray[np.float64]
#: Of differences by which the gradient of an implicit function is found.
STEP = 1e-5


@dataclass
class Surface:
    """Where a function of three coordinates is zero, and points of it by two."""

    title: str
    place: Callable[[Values, Values], Points]
    zero: Callable[[Values, Values, Values], Values]
    view: str = "0.5,-0.8,0.9"

    def distance(self, points: Points) -> Values:
        """Of points nearby, to first order."""
        value = self.zero(*points.T)
        slopes = [(self.zero(*(points + step).T) - self.zero(*(points - step).T)) / 2 for step in STEP * np.eye(3)]
        return np.abs(value) * STEP / np.linalg.norm(slopes, axis=0)


def ellipsoid(a: float, b: float, c: float) -> Surface:
    """Around the end of its third axis."""

    def place(u: Values, v: Values) -> Points:
        scale = 4 / (4 + u * u + v * v)
        return np.column_stack([a * u * scale, b * v * scale, c * (2 * scale - 1)])

    return Surface(f"ellipsoid {a}, {b}, {c}", place, lambda x, y, z: (x / a) ** 2 + (y / b) ** 2 + (z / c) ** 2 - 1)


def torus(title: str, turn: float, view: str) -> Surface:
    """Radii 1 and 0.4, around a place of its small circle."""

    def place(u: Values, v: Values) -> Points:
        angle = turn + 2 * v
        radius = 1 + 0.4 * np.cos(angle)
        return np.column_stack([radius * np.cos(u), radius * np.sin(u), 0.4 * np.sin(angle)])

    return Surface(title, place, lambda x, y, z: (np.hypot(x, y) - 1) ** 2 + z * z - 0.16, view)


def graph(title: str, height: Callable[[Values, Values], Values]) -> Surface:
    """Over a plane."""
    return Surface(title, lambda u, v: np.column_stack([u, v, height(u, v)]), lambda x, y, z: z - height(x, y))


SURFACES = [
    ellipsoid(1, 0.8, 0.6),
    ellipsoid(1, 1, 0.6),
    ellipsoid(0.7, 0.7, 1),
    ellipsoid(1, 0.6, 0.8),
    torus("torus, outer side", 0, "1,-0.3,0.3"),
    torus("torus, top", np.pi / 2, "0.3,-0.5,1"),
    torus("torus, inner side", np.pi, "-1,-0.3,0.8"),
    graph("saddle", lambda u, v: 0.3 * (u * u - v * v)),
    graph("paraboloid", lambda u, v: -0.5 * u * u - 0.25 * v * v),
    graph("waves", lambda u, v: 0.12 * np.sin(2 * u) * np.cos(1.5 * v)),
]


def case_of(tool: Tool, disc: Case, number: int) -> Case:
    """The image of a cap of the sphere, by its stereographic coordinates."""
    x, y, z = disc.positions.T
    u, v = 2 * x / (1 + z), 2 * y / (1 + z)
    return tool.put(f"g2-hole{number}", SURFACES[number].place(u, v), disc.triangles, disc.free)


def section(tool: Tool) -> str:
    """Pictures of all, and their errors."""
    disc = tool.generate(
        "g2-disc", "sphere-cap", "--angle", 50, "--vertices", 2_000, "--triangulation", "irregular", "--outside", 10
    )
    rows, pictures = [], []
    for number, surface in enumerate(SURFACES):
        case = case_of(tool, disc, number)
        wide = diagonal(case.positions[case.free])
        runs = [tool.fair(case, asked, "--continuity", asked, "--threads", 1) for asked in ("g1", "auto")]
        errors = [100 * spread(surface.distance(run.positions[case.free]) / wide).rms for run in runs]
        rows.append([surface.title, *(f"{error:.3f}" for error in errors), runs[1].reached()])
        shown = [(runs[0].file, "G1"), (runs[1].file, "auto"), (case.file, "the truth")]
        seen = ("--view", surface.view, "--shade", "reflection", "--size", "170x170")
        tool.render(f"hole{number}.png", surface.title, shown, *seen)
        pictures.append(
            f"![{surface.title}: reflection lines with G1, with auto, and of the surface itself](g2/hole{number}.png)"
        )
    pairs = [" | ".join(pictures[k : k + 2]) for k in range(0, len(pictures), 2)]
    shown = "\n".join(["| | |", "|---|---|", *(f"| {pair} |" for pair in pairs)])
    return "\n\n".join([table("region | rms error, G1, % of its width | auto | reached", rows), shown])
