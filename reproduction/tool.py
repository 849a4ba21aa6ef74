"""Runs the program `fairmesh`, and reads back what it wrote."""

from __future__ import annotations

import json
import re
import resource
import subprocess
from dataclasses import dataclass
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

Points = NDArray[np.float64]
Triangles = NDArray[np.int32]
#: `<!--[name]-->text<!--[/name]-->`
PART = re.compile(r"<!--\[(\w+)\]-->(.*?)<!--\[/\1\]-->", re.DOTALL)
_FACE = np.dtype([("count", "u1"), ("corners", "<i4", 3)])


class Scan(NamedTuple):
    """A mesh of somebody else's, a list of its free vertices, and from where it is seen."""

    name: str
    mesh: Path
    free: Path
    view: str


@dataclass
class Case:
    """A mesh with what belongs to it."""

    #: Also the stem of its files.
    name: str
    file: Path
    free_file: Path
    #: Of the boundary normals, if they are given.
    normals_file: Path | None = None

    def __post_init__(self) -> None:
        """Reads the files."""
        self.positions, self.triangles = read_ply(self.file)
        self.free = np.loadtxt(self.free_file, dtype=np.int64, ndmin=1)

    def normals(self) -> tuple[NDArray[np.int64], Points]:
        """The vertices with given normals, and these."""
        rows = np.loadtxt(self.normals_file, ndmin=2)
        return rows[:, 0].astype(np.int64), rows[:, 1:]


@dataclass
class Run:
    """What came of `fairmesh fair` or `fairmesh fill`."""

    file: Path
    report: dict[str, Any]

    @property
    def positions(self) -> Points:
        """All vertices."""
        return read_ply(self.file)[0]

    @property
    def outcome(self) -> str:
        """`converged` or why not."""
        return str(self.report["outcome"])

    @property
    def iterations(self) -> int:
        """Of the solver."""
        return int(self.report["iterations"])

    @property
    def seconds(self) -> float:
        """From the arrays of the input to those of the result."""
        return float(self.report["seconds"]["solve"])

    def reached(self) -> str:
        """How much of the way to the curvature of the surroundings, loop by loop."""
        loops = [loop for component in self.report["components"] for loop in component["continuity"]]
        return ", ".join(f"{loop['reached']:.2f}" for loop in loops)


def renew(page: Path, parts: dict[str, object]) -> None:
    """Replaces the parts of a page, each between `<!--[name]-->` and `<!--[/name]-->`."""
    text = page.read_text(encoding="utf-8")
    places = {match[1]: match for match in PART.finditer(text)}
    if places.keys() != parts.keys():
        raise ValueError(f"{page}: parts {sorted(places)}, measured {sorted(parts)}")

    def measured(match: re.Match[str]) -> str:
        space = match[2][: len(match[2]) - len(match[2].lstrip())]
        return f"<!--[{match[1]}]-->{space}{parts[match[1]]}{space}<!--[/{match[1]}]-->"

    page.write_text(PART.sub(measured, text), encoding="utf-8")


class Tool:
    """The program, with folders for working files and for pictures."""

    def __init__(self, program: Path, work: Path, pictures: Path) -> None:
        self.program, self.work, self.pictures = program, work, pictures
        work.mkdir(parents=True, exist_ok=True)
        pictures.mkdir(parents=True, exist_ok=True)

    def run(self, *words: object) -> None:
        """Exit codes 0 and 3 (not converged) are fine."""
        command = [str(self.program), *map(str, words)]
        done = subprocess.run(command, capture_output=True, text=True, check=False)
        if done.returncode not in (0, 3):
            raise SystemExit(f"{' '.join(command)}: {done.stderr}")

    def generate(self, name: str, *words: object) -> Case:
        """`fairmesh generate KIND ...`."""
        file, free, normals = (self.work / f"{name}{end}" for end in (".ply", ".free.txt", ".normals.txt"))
        self.run("generate", *words, "-o", file, "--free", free, "--normals", normals)
        return Case(name, file, free, normals)

    def put(self, name: str, positions: Points, triangles: Triangles, free: NDArray[np.int64]) -> Case:
        """A mesh with what is free in it, as files."""
        file, free_file = self.work / f"{name}.ply", self.work / f"{name}.free.txt"
        write_ply(file, positions, triangles)
        np.savetxt(free_file, free, "%d")
        return Case(name, file, free_file)

    def _report(self, command: str, mesh: Path, stem: str, *words: object) -> Run:
        file, report = self.work / f"{stem}.ply", self.work / f"{stem}.json"
        self.run(command, "--quiet", mesh, "-o", file, "--json", report, *words)
        return Run(file, json.loads(report.read_text(encoding="utf-8")))

    def fair(self, case: Case, name: str, *words: object) -> Run:
        """`fairmesh fair ...`; `name` is added to the mesh's for the result."""
        normals = ["--normals", case.normals_file] if case.normals_file else []
        return self._report("fair", case.file, f"{case.name}.{name}", "--free", case.free_file, *normals, *words)

    def fair_scan(self, scan: Scan, stem: str, *words: object) -> Run:
        """The same for a mesh in a format that only the program reads."""
        return self._report("fair", scan.mesh, stem, "--free", scan.free, *words)

    def fill(self, case: Case, name: str, *words: object) -> Run:
        """`fairmesh fill ...` of a mesh with holes."""
        return self._report("fill", case.file, f"{case.name}.{name}", *words)

    def timed(self, case: Case, name: str, times: int, *words: object) -> tuple[Run, float]:
        """The quickest of these runs, and the mean CPU seconds of the whole program, files included."""
        before = resource.getrusage(resource.RUSAGE_CHILDREN)
        runs = [self.fair(case, name, *words) for _ in range(times)]
        after = resource.getrusage(resource.RUSAGE_CHILDREN)
        used = after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime
        return min(runs, key=lambda run: run.seconds), used / times

    def render(self, picture: str, what: str, meshes: list[tuple[Path, str]], *words: object) -> str:
        """`fairmesh render ...` of files with captions; returns the picture's line for REPRODUCTION.md."""
        captions = [word for _, caption in meshes for word in ("--caption", caption)]
        self.run("render", *[file for file, _ in meshes], *captions, "-o", self.pictures / picture, *words)
        return f"![{what}](docs/reproduction/{picture})"


def read_ply(path: Path) -> tuple[Points, Triangles]:
    """A PLY file as the program writes it: doubles, then triangles with counts of one byte and 32-bit numbers."""
    header, _, body = path.read_bytes().partition(b"end_header\n")
    count = {line.split()[1]: int(line.split()[2]) for line in header.splitlines() if line.startswith(b"element")}
    positions = np.frombuffer(body, "<f8", 3 * count[b"vertex"]).reshape(-1, 3)
    faces = np.frombuffer(body, _FACE, count[b"face"], positions.nbytes)
    return positions, faces["corners"]


def write_ply(path: Path, positions: Points, triangles: Triangles) -> None:
    """The same."""
    header = (
        f"ply\nformat binary_little_endian 1.0\nelement vertex {len(positions)}\n"
        "property double x\nproperty double y\nproperty double z\n"
        f"element face {len(triangles)}\nproperty list uchar int vertex_indices\nend_header\n"
    )
    faces = np.empty(len(triangles), _FACE)
    faces["count"], faces["corners"] = 3, triangles
    path.write_bytes(header.encode() + positions.astype("<f8").tobytes() + faces.tobytes())
