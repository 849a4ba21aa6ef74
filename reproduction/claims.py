"""Convergence to known surfaces, and what the paper claims."""

from __future__ import annotations

from collections.abc import Sequence
from math import log, sqrt
from typing import NamedTuple

from .measure import Distance, angles, apart, diagonal, short, spread, table, to_mesh
from .surfaces import distance
from .tool import Case, Run, Tool

SIZES = (500, 2_000, 8_000)
KNOWN = ("sphere-cap", "cylinder", "catenoid", "unduloid")
PATCH = ("cylinder-blend", "--vertices", 920, "--triangulation", "refined")


class Solved(NamedTuple):
    """A mesh on a known surface, and what came of it."""

    case: Case
    run: Run
    error: Distance


#: Of one surface at all sizes.
Series = list[Solved]
#: A mesh and its surface.
Faired = tuple[Case, Run]


class Claim(NamedTuple):
    """What is said, whether it holds here, and the figures."""

    what: str
    holds: bool
    figures: str


def solve_known(tool: Tool, kind: str, triangulation: str, count: int, *words: object) -> Solved:
    """A surface from a wrong interior."""
    how = ("--triangulation", triangulation, "--start", "flat")
    case = tool.generate(f"{kind}-{triangulation}-{count}", kind, "--vertices", count, *how)
    run = tool.fair(case, "other" if words else "fair", "--tolerance", 1e-10, *words)
    free = run.positions[case.free]
    return Solved(case, run, spread(distance(kind, free) / diagonal(free)))


def sections(tool: Tool) -> dict[str, object]:
    """Both tables."""
    reproduced, rows = [], []
    for kind in KNOWN:
        for triangulation in ("regular", "irregular"):
            series = [solve_known(tool, kind, triangulation, count) for count in SIZES]
            reproduced.append((kind, series))
            rows.append([kind, triangulation, *cells(series)])
    columns = "surface | triangulation | vertices | largest error | rms | order of largest | of rms"
    return {
        "convergence": table(f"{columns} | iterations | outcome", rows),
        "claims": claims(tool, reproduced),
    }


def cells(series: Series) -> list[str]:
    """Counts, errors, orders, iterations and outcomes of one row."""

    def joined(values: Sequence[object]) -> str:
        return " / ".join(map(str, values))

    counts = [len(solved.case.free) for solved in series]
    errors = list(zip(*(solved.error for solved in series)))
    outcomes = [solved.run.outcome for solved in series]
    return [
        joined(counts),
        *(joined([short(error) for error in each]) for each in errors),
        # Rounding has no order.
        *("exact" if each[0] < 1e-8 else f"{order(each, counts):.1f}" for each in errors),
        joined([solved.run.iterations for solved in series]),
        outcomes[0] if len(set(outcomes)) == 1 else joined(outcomes),
    ]


def order(errors: tuple[float, ...], vertices: list[int]) -> float:
    """Of errors that go with edge lengths `n^(-1/2)`."""
    return log(errors[0] / errors[-1]) / log(sqrt(vertices[-1] / vertices[0]))


def claims(tool: Tool, reproduced: list[tuple[str, Series]]) -> str:
    """The table of claims."""
    meshes = (("cylinder-blend", 118), ("cylinder-blend", 920), ("cylinder-blend", 13_308), ("tetra-thing", 13_308))
    blends = []
    for kind, count in meshes:
        case = tool.generate(f"claim-{kind}-{count}", kind, "--vertices", count)
        blends.append((case, tool.fair(case, "fair", "--tolerance", 1e-10)))
    tried = (
        spheres_and_cylinders(reproduced),
        extremes_on_the_boundary(reproduced, blends),
        g1(blends),
        coarse_is_close(blends),
        weights_do_not_matter(tool, blends[2]),
        start_does_not_matter(tool),
        conformal_distorts_less(tool),
        no_minimal_energy(tool),
    )
    rows = [(what, "confirmed" if holds else "**not confirmed**", figures) for what, holds, figures in tried]
    return table("claim | here | figures", rows)


def spheres_and_cylinders(reproduced: list[tuple[str, Series]]) -> Claim:
    """The sphere at the coarsest, the others at the finest mesh."""

    def worst(kind: str, size: int) -> float:
        return max(series[size].error.max for name, series in reproduced if name == kind)

    sphere, cylinder, catenoid = worst("sphere-cap", 0), worst("cylinder", -1), worst("catenoid", -1)
    return Claim(
        "Spheres, cylinders and minimal surfaces are reproduced (section 3)",
        sphere < 1e-8 and cylinder < 1e-4 and catenoid < 1e-4,
        f"largest errors: sphere {short(sphere)} at {SIZES[0]} vertices; cylinder {short(cylinder)}, "
        f"catenoid {short(catenoid)} at {SIZES[-1]}",
    )


def excess(run: Run) -> float:
    """How far the curvature inside exceeds that on the boundary, over the boundary's largest."""
    (low, high), (least, most) = run.report["quality"]["h_inside"], run.report["quality"]["h_boundary"]
    return float(max(high - most, least - low, 0) / max(abs(most), abs(least)))


def extremes_on_the_boundary(reproduced: list[tuple[str, Series]], blends: list[Faired]) -> Claim:
    """H of the catenoid is zero and has no extremes."""
    known = max(excess(solved.run) for kind, series in reproduced if kind != "catenoid" for solved in series)
    worst = max(excess(run) for _, run in blends)
    quality = blends[2][1].report["quality"]
    inside, boundary = (" to ".join(f"{h:.4f}" for h in quality[place]) for place in ("h_inside", "h_boundary"))
    return Claim(
        "The extremes of H are on the boundary (section 3)",
        worst < 1e-6 and known < 1e-6,
        f"relative excess of H inside over the boundary: blends and tetra thing {short(worst)}, known surfaces "
        f"{short(known)}; blend of 13,308: {inside} inside, {boundary} on the boundary",
    )


def g1(blends: list[Faired]) -> Claim:
    """The angle to the prescribed normals falls with the edge length."""
    angle = [run.report["quality"]["normal_deviation_rms"] for _, run in blends[:3]]
    reached = order(tuple(angle), [len(case.positions) for case, _ in blends[:3]])
    return Claim(
        "The surface is G1 at the boundary (sections 1, 7.5)",
        reached > 0.8 and angle[2] < 2.0,
        f"angle between the prescribed normals and the triangles' mean normal, rms: {', '.join(map(short, angle))} "
        f"degrees at 118, 920 and 13,308 vertices; order {reached:.2f} in the edge length "
        "(a smooth tangent surface has 1)",
    )


def coarse_is_close(blends: list[Faired]) -> Claim:
    """To the surface of the finest blend."""
    case, fine = blends[2]
    coarse, middle = (to_mesh(run.positions, fine.positions, case.triangles).max for _, run in blends[:2])
    return Claim(
        "A coarse mesh already approximates the smooth surface (sections 3, 7.4)",
        coarse < 0.02 and middle < coarse,
        f"largest distance to the surface of 13,308 vertices: {short(coarse)} from 118, {short(middle)} from 920",
    )


def weights_do_not_matter(tool: Tool, fine: Faired) -> Claim:
    """All kinds of inner fairness give one surface."""
    case = tool.generate("weights", *PATCH)
    runs = {inner: tool.fair(case, inner, "--inner-fairness", inner) for inner in ("uniform", "conformal", "convex")}
    far = {inner: to_mesh(run.positions, fine[1].positions, fine[0].triangles).max for inner, run in runs.items()}
    figures = ", ".join(f"{inner} {short(far[inner])} ({run.outcome})" for inner, run in runs.items())
    return Claim(
        "Inner fairness can be chosen freely: outer and inner fairness are separate (sections 3, 7.3)",
        max(far.values()) < 5e-3,
        f"blend of 920 with the patch, largest distance to the surface of 13,308: {figures}",
    )


def start_does_not_matter(tool: Tool) -> Claim:
    """The interior of the input does not pull at the result."""
    surfaces = []
    for start in ("exact", "noise", "random"):
        case = tool.generate(f"start-{start}", "cylinder-blend", "--start", start, "--noise", 0.5)
        surfaces.append(tool.fair(case, "fair", "--tolerance", 1e-10).positions)
    worst = max(apart(surfaces[0], other).max for other in surfaces[1:])
    return Claim(
        "The surface is defined by the boundary alone (sections 3, 8)",
        worst < 1e-7,
        "largest distance between results from a smooth, a rough (half an edge length) and a random interior, "
        f"920 vertices: {short(worst)}",
    )


def conformal_distorts_less(tool: Tool) -> Claim:
    """By the change of the triangles' angles."""
    case = tool.generate("distortion", *PATCH)
    before, changes = angles(case.positions, case.triangles), []
    for inner in ("uniform", "conformal"):
        run = tool.fair(case, inner, "--inner-fairness", inner)
        changes.append(spread(angles(run.positions, case.triangles) - before).rms)
    return Claim(
        "Conformal weights distort the input's triangles least (section 7.3)",
        changes[1] < changes[0],
        f"rms change of the angles, blend with the patch: uniform {short(changes[0])} degrees, "
        f"conformal {short(changes[1])}",
    )


def no_minimal_energy(tool: Tool) -> Claim:
    """The other equation keeps spheres alone."""
    target = ("--target", "minimal-energy")
    coarse, fine = (solve_known(tool, "cylinder", "regular", count, *target) for count in SIZES[:2])
    sphere = solve_known(tool, "sphere-cap", "regular", SIZES[1], *target).error.max
    return Claim(
        "Minimal-energy surfaces do not reproduce cylinders (section 3)",
        fine.error.max > 1e-3 and sphere < 1e-6 and fine.run.outcome == "converged",
        f"`--target minimal-energy` between the circles of a cylinder: {short(coarse.error.max)} from it at 500, "
        f"{short(fine.error.max)} at 2,000 vertices ({fine.run.outcome}); from a sphere: {short(sphere)}",
    )
