"""Public meshes out of packages of Debian and PyPI, and regions grown on them."""

from __future__ import annotations

import random
import subprocess
import sys
import tarfile
import zipfile
from pathlib import Path

import numpy as np

from formats import UnreadableError, read
from geometry import half_edges, irregular_vertices, undirected

# What is fetched: nothing of it is installed.
DEBIAN = "libcgal-demo"
WHEELS = ["pyvista==0.49.1", "pymeshlab==2025.7.post1"]
SUFFIXES = (".off", ".ply", ".obj", ".stl")
# Larger meshes would take the run's time and show nothing new.
MOST_TRIANGLES, MOST_BYTES = 15_000, 2_000_000
# Free vertices of a mesh's regions, at most; small meshes have smaller ones.
REGIONS = (30, 150, 700)


def fetch(folder: Path) -> None:
    """Downloads the packages and unpacks their meshes, once."""
    folder = folder.resolve()
    done = folder / "fetched"
    wanted = " ".join([DEBIAN, *WHEELS])
    if done.exists() and done.read_text() == wanted:
        return
    folder.mkdir(parents=True, exist_ok=True)
    download = folder / "download"
    download.mkdir(exist_ok=True)
    subprocess.run(["apt-get", "download", "-q", DEBIAN], cwd=download, check=True)
    pip = [sys.executable, "-m", "pip", "--disable-pip-version-check", "download", "-q", "--no-deps", "-d", "."]
    subprocess.run([*pip, *WHEELS], cwd=download, check=True)
    for package in download.glob("*.deb"):
        subprocess.run(["dpkg", "-x", package, "debian"], cwd=download, check=True)
    for archive in sorted(download.glob("debian/**/data.tar.gz")):
        with tarfile.open(archive) as packed:
            for member in packed:
                if member.isfile() and member.name.endswith(SUFFIXES):
                    keep(folder, "cgal_" + Path(member.name).name, packed.extractfile(member).read())
    for wheel in download.glob("*.whl"):
        with zipfile.ZipFile(wheel) as packed:
            for name in packed.namelist():
                if name.endswith(SUFFIXES):
                    keep(folder, f"{wheel.name.split('-')[0]}_{Path(name).name}", packed.read(name))
    done.write_text(wanted)


def keep(folder: Path, name: str, data: bytes) -> None:
    if len(data) <= MOST_BYTES:
        (folder / name).write_bytes(data)


def load(path: Path) -> tuple[np.ndarray, np.ndarray] | None:
    """Positions and triangles, or None if the file is no mesh that suits."""
    try:
        file = read(path)
    except UnreadableError:
        return None
    triangles = file.triangles()
    distinct = (triangles != np.roll(triangles, 1, axis=1)).all(1)
    triangles = triangles[distinct]
    if not 50 <= len(triangles) <= MOST_TRIANGLES or not np.isfinite(file.points).all():
        return None
    return compact(file.points, triangles)


def compact(x: np.ndarray, triangles: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    used, numbered = np.unique(triangles, return_inverse=True)
    return x[used], numbered.reshape(-1, 3)


class Surroundings:
    """Neighbours of every vertex, and the vertices that may be free."""

    def __init__(self, count: int, triangles: np.ndarray):
        edges, _ = half_edges(triangles)
        ends, _, _ = undirected(edges)
        both = np.concatenate([ends, ends[:, ::-1]])
        both = both[np.argsort(both[:, 0], kind="stable")]
        self.start = np.searchsorted(both[:, 0], np.arange(count + 1))
        self.neighbours = both[:, 1]
        self.good = np.ones(count, bool)
        self.good[irregular_vertices(triangles)] = False

    def ring(self, vertices: list[int]) -> set[int]:
        return {w for v in vertices for w in self.neighbours[self.start[v] : self.start[v + 1]].tolist()}

    def grow(self, rng: random.Random, wanted: int) -> np.ndarray:
        """Rings around a random vertex until there are so many vertices, of those that may be free."""
        candidates = np.flatnonzero(self.good)
        if len(candidates) == 0:
            return candidates
        region = {int(rng.choice(candidates.tolist()))}
        front = list(region)
        while len(region) < wanted and front:
            front = [v for v in sorted(self.ring(front)) if v not in region and self.good[v]]
            region.update(front)
        return np.array(sorted(region))


def are_apart(around: Surroundings, a: np.ndarray, b: np.ndarray, rings: int) -> bool:
    """Whether so many rings around region `a` do not reach region `b`."""
    reached, front = set(a.tolist()), a.tolist()
    for _ in range(rings):
        front = [v for v in around.ring(front) if v not in reached]
        reached.update(front)
    return reached.isdisjoint(b.tolist())


def regions(x: np.ndarray, triangles: np.ndarray, rng: random.Random) -> list[np.ndarray]:
    around = Surroundings(len(x), triangles)
    grown = [around.grow(rng, min(wanted, len(x) // 5)) for wanted in REGIONS]
    return [region for region in grown if 0 < len(region) < len(x) // 2]
