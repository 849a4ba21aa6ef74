"""Figures 1, 2, 7, 8 and, with scans, 9 and 10."""

from __future__ import annotations

from dataclasses import dataclass

from .measure import short, table, to_mesh
from .tool import Case, Run, Scan, Tool

FROM_ABOVE = ("--view", "0.45,-0.75,0.8", "--size", "200x175")
BLEND = ("cylinder-blend", "--vertices")
#: The solution of the linear problem with G1 boundary data (paper (3), 7.4): the paper's scheme
#: on one level begins there, and its one update moves nothing along normals.
LINEAR = ("--solver", "paper", "--paper-levels", 1, "--paper-max-updates", 1, "--paper-damping", 1e-9)


@dataclass
class Faired:
    """A mesh, its linear and its intrinsic surface."""

    case: Case
    linear: Run
    run: Run


def faired(tool: Tool, name: str, generate: tuple[object, ...], inner: str) -> Faired:
    """Both surfaces of a generated mesh."""
    case = tool.generate(name, *generate)
    how = ("--inner-fairness", inner)
    return Faired(case, tool.fair(case, f"linear-{inner}", *how, *LINEAR), tool.fair(case, inner, *how))


def sections(tool: Tool) -> dict[str, object]:
    """All but the scans."""
    return figures_1_and_2(tool) | figure_7(tool) | figure_8(tool)


def figures_1_and_2(tool: Tool) -> dict[str, object]:
    """Linear against intrinsic fairing."""
    meshes = {
        "920": (*BLEND, 920),
        "118": (*BLEND, 118),
        "920 with the patch": (*BLEND, 920, "--triangulation", "refined"),
        "13,308": (*BLEND, 13_308),
    }
    made = {
        (label, inner): faired(tool, f"blend{k}", generate, inner)
        for inner in ("uniform", "conformal")
        for k, (label, generate) in enumerate(meshes.items())
    }
    fine = made["13,308", "uniform"]
    shown = {
        "uniform, 920": made["920", "uniform"],
        "uniform, 118": made["118", "uniform"],
        "uniform, patch": made["920 with the patch", "uniform"],
        "conformal, 920": made["920", "conformal"],
    }
    linear = [(each.linear.file, caption) for caption, each in shown.items()]
    intrinsic = [(each.run.file, caption) for caption, each in shown.items()]
    reflected = (*FROM_ABOVE, "--shade", "flat,reflection")
    rows = [[label, inner, *distances(each, fine)] for (label, inner), each in made.items()]
    between = to_mesh(fine.linear.positions, fine.run.positions, fine.case.triangles)
    columns = "mesh | weights | linear: largest | rms | intrinsic: largest | rms | linear / intrinsic"
    what = ("Linear surfaces on four meshes", "Intrinsic surfaces on the same meshes", "Mean curvature")
    return {
        "figure_1": tool.render("figure1.png", what[0], linear, *reflected),
        "figure_2": tool.render("figure2.png", what[1], intrinsic, *reflected),
        "figure_2_curvature": tool.render(
            "figure2-curvature.png", what[2], intrinsic, *FROM_ABOVE, "--shade", "curvature"
        ),
        "linear_and_intrinsic": table(f"{columns} | outcome | iterations", rows),
        "apart": short(between.max),
        "apart_rms": short(between.rms),
    }


def distances(each: Faired, fine: Faired) -> list[object]:
    """Cells: linear to linear, intrinsic to intrinsic, how it ended."""
    linear = to_mesh(each.linear.positions, fine.linear.positions, fine.case.triangles)
    intrinsic = to_mesh(each.run.positions, fine.run.positions, fine.case.triangles)
    # The reference has no distance to itself.
    ratio = "-" if intrinsic.max < 1e-12 else f"{linear.max / intrinsic.max:.0f}"
    return [*map(short, (*linear, *intrinsic)), ratio, each.run.outcome, each.run.iterations]


def figure_7(tool: Tool) -> dict[str, object]:
    """Regular, and sparse with irregular connectivity."""
    irregular = (*BLEND, 300, "--triangulation", "irregular", "--seed", 3)
    regular = faired(tool, "regular", (*BLEND, 920), "uniform")
    sparse = faired(tool, "sparse", irregular, "uniform")
    fine = faired(tool, "blend3", (*BLEND, 13_308), "uniform")
    meshes, rows = [], []
    for label, each in (("regular", regular), ("sparse, irregular", sparse)):
        count = len(each.case.positions)
        meshes += [(each.linear.file, f"linear, {count}"), (each.run.file, f"intrinsic, {count}")]
        linear, _, intrinsic, _, _, *ending = distances(each, fine)
        rows.append([label, count, linear, intrinsic, *ending])
    what = "Linear and intrinsic, regular and sparse"
    columns = "linear, to the fine linear surface: largest | intrinsic, to the fine intrinsic one: largest"
    return {
        "figure_7": tool.render("figure7.png", what, meshes, *FROM_ABOVE, "--shade", "flat,reflection"),
        "regular_and_sparse": table(f"mesh | vertices | {columns} | outcome | iterations", rows),
    }


def figure_8(tool: Tool) -> dict[str, object]:
    """The tetra thing."""
    rows, cases = [], [tool.generate(f"tetra{count}", "tetra-thing", "--vertices", count) for count in (500, 13_308)]
    for inner in ("conformal", "uniform"):
        coarse, fine = (tool.fair(case, inner, "--inner-fairness", inner) for case in cases)
        distance = to_mesh(coarse.positions, fine.positions, cases[1].triangles)
        outcomes, iterations = f"{coarse.outcome} / {fine.outcome}", f"{coarse.iterations} / {fine.iterations}"
        rows.insert(0, [inner, outcomes, iterations, *map(short, distance)])
    meshes = [(coarse.file, "500"), (fine.file, "13308")]
    seen = ("--view", "1,0.7,0.8", "--shade", "flat,reflection,curvature", "--size", "180x180")
    return {
        "figure_8": tool.render("figure8.png", "The tetra thing of 500 and 13,308 vertices", meshes, *seen),
        "tetra_thing": table("weights | outcome, 500 / 13,308 | iterations | largest distance | rms", rows),
    }


def scans(tool: Tool, all_scans: list[Scan]) -> str:
    """Features of scans removed."""
    if not all_scans:
        return "Not in this run: the head of `reproduce.sh` says how they are given."
    pictures, rows = [], []
    for number, scan in enumerate(all_scans, 1):
        for inner in ("uniform", "conformal"):
            run = tool.fair_scan(scan, f"scan{number}.{inner}", "--inner-fairness", inner)
            quality = run.report["quality"]
            extents = [" to ".join(map(short, quality[place])) for place in ("h_inside", "h_boundary")]
            ending = [run.report["free_vertices"], run.outcome, run.iterations, f"{run.seconds:.3f}"]
            rows.append([scan.name, inner, *ending, f"{quality['worst_angle']:.1f}", *extents])
        meshes = [(scan.mesh, "before"), (run.file, "after")]
        seen = ("--view", scan.view, "--around", scan.free, "--shade", "flat,reflection", "--size", "220x220")
        pictures.append(f"{scan.name}:\n\n" + tool.render(f"scan{number}.png", scan.name, meshes, *seen))
    columns = (
        "scan | weights | free vertices | outcome | iterations | s | smallest angle | H inside | H on the boundary"
    )
    return "\n\n".join([*pictures, table(columns, rows)])
