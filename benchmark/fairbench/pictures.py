"""Pictures of the worst and the best case of each class: the input, the truth, what fairmesh has made of it, and the nearest of the others."""

from __future__ import annotations

import os
import subprocess
from collections import defaultdict
from pathlib import Path
from typing import NamedTuple

import numpy as np

from .cases import Case
from .judge import Row
from .meshes import Mesh, read_ply, write_ply

#: How much of a mesh is shown around a hole, in its widths.
AROUND = 1.1
#: Pixels of one mesh.
TILE = "240x210"


class Chosen(NamedTuple):
    """A case to be shown, of fairmesh and of the nearest other program; where fairmesh does not take part, of the nearest alone."""

    label: str
    own: Row
    other: Row | None


def chosen(rows: list[Row], own: str) -> list[Chosen]:
    """The worst and the best of each class, by how far fairmesh is from the truth beside the nearest other."""
    by_case: dict[tuple[str, int], list[Row]] = defaultdict(list)
    for one in rows:
        by_case[one.problem()].append(one)
    classes: dict[tuple[str, str], list[tuple[float, Chosen]]] = defaultdict(list)
    for some in by_case.values():
        mine = next((one for one in some if one.program == own), None)
        others = [one for one in some if not one.program.startswith("fairmesh")]
        other = min(others, key=Row.error) if others else None
        shown = Chosen("", mine, other) if mine is not None else Chosen("", other, None)
        beside = shown.own.error() / shown.other.error() if shown.other is not None else shown.own.error()
        classes[shown.own.family, shown.own.task].append((beside, shown))
    found = []
    for some_chosen in classes.values():
        in_order = sorted(some_chosen, key=lambda each: each[0])
        found += [in_order[-1][1]._replace(label="worst"), in_order[0][1]._replace(label="best")]
    return found


def draw(case: Case, which: Chosen, results: Path, folder: Path) -> str | None:
    """Writes a picture, and gives the line of Markdown that shows it. Where a program was not run this time, its last picture stays; None: there is none."""
    made = folder / f"{case.name}.png"
    line = f"![{which.label} of {case.family}, {case.task}: {case.name}](benchmark/{made.name})"
    programs = [one for one in (which.own, which.other) if one is not None and one.rms is not None]
    meshes = [results / one.program.replace(" ", "-") / "mesh.ply" for one in programs]
    if not all(mesh.exists() for mesh in meshes):
        return line if made.exists() else None
    scratch = results / "pictures"
    scratch.mkdir(parents=True, exist_ok=True)
    centre = case.truth.corners()[case.wanted].reshape(-1, 3).mean(axis=0)
    normal = case.truth.normals()[case.wanted].sum(axis=0)
    shown = [("input", case.mesh), ("truth", case.truth)]
    shown += [(f"{one.program}: {100 * one.rms:.2g} %", read_ply(mesh)) for one, mesh in zip(programs, meshes, strict=True)]
    words: list[str] = []
    for number, (caption, mesh) in enumerate(shown):
        path = scratch / f"{number}.ply"
        write_ply(path, _near(mesh, centre, AROUND * case.width()))
        words += [str(path), "--caption", caption]
    view = ",".join(f"{x:.3f}" for x in _seen_from(normal))
    command = [os.environ["FAIRMESH_PROGRAM"], "render", *words, "-o", str(made), "--shade", "flat,reflection", "--size", TILE, f"--view={view}"]
    subprocess.run(command, check=True, capture_output=True)
    return line


def _near(mesh: Mesh, centre: np.ndarray, radius: float) -> Mesh:
    """The triangles around a place; all, if none is there."""
    inside = np.linalg.norm(mesh.corners().mean(axis=1) - centre, axis=1) < radius
    return mesh.only(inside) if inside.any() else mesh


def _seen_from(normal: np.ndarray) -> np.ndarray:
    """From above, a little to the side; from the usual corner where a part looks in all directions."""
    length = np.linalg.norm(normal)
    if length == 0:
        return np.array([1.0, 0.7, 0.8])
    return normal / length + np.array([0.25, -0.2, 0.3])
