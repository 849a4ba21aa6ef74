"""Holes filled by fairmesh and by MeshLib, on the same files: error, creases, intersections, CPU seconds.

    pip install numpy meshlib
    cargo build --release
    python3 benches/holes_peers.py [FILE.off ...]

A sphere without a cap and one without a band, whose surface is known, are made here. Both programs are asked for new vertices as dense
as those around. MeshLib fills with `fillHoleNicely`, smoothing the curvature, each hole by itself, and joins two loops with
`stitchHolesNicely`. Creases are the largest angle between a new triangle and one of the mesh beside it, the mean over all
holes; intersections are pairs of triangles, one of them new, that cross.
"""

import resource
import subprocess
import sys
import tempfile
import time
from pathlib import Path

import numpy as np
from meshlib import mrmeshnumpy, mrmeshpy

ROOT = Path(__file__).parent.parent
PROGRAM = ROOT / "target/release/fairmesh"
sys.path.insert(0, str(ROOT / "tests/torture"))

from intersections import crossing_pairs  # noqa: E402


def read(path):
    """Positions and triangles of an OFF file."""
    lines = [line for line in Path(path).read_text().split("\n") if line.strip() and not line.startswith("#")]
    vertices, faces = map(int, lines[1].split()[:2])
    body = lines[2:]
    positions = np.array([line.split()[:3] for line in body[:vertices]], float)
    triangles = np.array([line.split()[1:4] for line in body[vertices : vertices + faces]], int)
    return positions, triangles


def write(path, positions, triangles):
    """An OFF file of a mesh."""
    rows = [" ".join(map(repr, p)) for p in positions.tolist()] + ["3 %d %d %d" % tuple(t) for t in triangles.tolist()]
    Path(path).write_text("\n".join(["OFF", f"{len(positions)} {len(triangles)} 0", *rows]) + "\n")


def sphere(folder, name, gone):
    """An irregular unit sphere of 13,000 vertices without those whose height `gone` takes."""
    path = str(Path(folder) / "sphere.off")
    options = ["--vertices", "13000", "--triangulation", "irregular", "--angle", "5"]
    subprocess.run([PROGRAM, "generate", "sphere-hole", *options, "-o", path], check=True, stdout=subprocess.DEVNULL)
    positions, triangles = read(path)
    positions /= np.linalg.norm(positions, axis=1)[:, None]
    triangles = triangles[~gone(positions[:, 2])[triangles].any(1)]
    used = np.unique(triangles)
    number = np.full(len(positions), -1)
    number[used] = np.arange(len(used))
    path = str(Path(folder) / f"{name}.off")
    write(path, positions[used], number[triangles])
    return path


def by_fairmesh(path, options):
    """Positions, triangles and seconds of the filled mesh."""
    out = path + ".filled.off"
    command = [PROGRAM, "fill", path, "-o", out, "--quiet", "--threads", "1", *options]
    start = cpu_of_children()
    subprocess.run(command, check=False, stdout=subprocess.DEVNULL)
    return *read(out), cpu_of_children() - start


def cpu_of_children():
    """CPU seconds of all programs run so far, reading and writing included."""
    used = resource.getrusage(resource.RUSAGE_CHILDREN)
    return used.ru_utime + used.ru_stime


def by_meshlib(path, is_joined):
    """The same."""
    mesh = mrmeshpy.loadMesh(path)
    start = time.process_time()
    edges = list(mesh.topology.findHoleRepresentiveEdges())
    if is_joined:
        by_size = sorted(edges, key=lambda edge: mesh.holePerimeter(edge), reverse=True)
        settings = mrmeshpy.StitchHolesNicelySettings()
        fit(settings, mesh, by_size[0])
        mrmeshpy.stitchHolesNicely(mesh, by_size[0], by_size[1], settings)
        edges = by_size[2:]
    for edge in edges:
        settings = mrmeshpy.FillHoleNicelySettings()
        fit(settings, mesh, edge)
        mrmeshpy.fillHoleNicely(mesh, edge, settings)
    seconds = time.process_time() - start
    return mrmeshnumpy.getNumpyVerts(mesh), mrmeshnumpy.getNumpyFaces(mesh.topology), seconds


def fit(settings, mesh, edge):
    """New edges as long as those of the boundary."""
    count, at = 0, edge
    while True:
        at = mesh.topology.prev(at.sym())
        count += 1
        if at == edge:
            break
    settings.subdivideSettings.maxEdgeLen = 1.2 * mesh.holePerimeter(edge) / count
    settings.subdivideSettings.maxEdgeSplits = 1_000_000
    settings.smoothCurvature = True


def crease(positions, triangles, old):
    """The largest angle in degrees at an edge between an old and a new triangle, and the mean of all."""
    x = positions[triangles]
    normals = np.cross(x[:, 1] - x[:, 0], x[:, 2] - x[:, 0])
    normals /= np.maximum(np.linalg.norm(normals, axis=1), 1e-300)[:, None]
    edges = np.sort(np.concatenate([triangles[:, [k, (k + 1) % 3]] for k in range(3)]), axis=1)
    owner = np.tile(np.arange(len(triangles)), 3)
    order = np.lexsort(edges.T)
    edges, owner = edges[order], owner[order]
    same = (edges[1:] == edges[:-1]).all(1)
    a, b = owner[:-1][same], owner[1:][same]
    beside = (a < old) != (b < old)
    cosines = (normals[a[beside]] * normals[b[beside]]).sum(1)
    angles = np.degrees(np.arccos(np.clip(cosines, -1, 1)))
    return angles.max(initial=0.0), angles.mean() if len(angles) else 0.0


def row(name, program, path, found, is_sphere):
    """One row of the table."""
    positions, triangles, seconds = found
    given, old = read(path)
    # MeshLib keeps the given triangles first, and their numbers, as fairmesh does.
    new = np.arange(len(old), len(triangles))
    error = ""
    if is_sphere:
        error = "%.1e" % np.abs(np.linalg.norm(positions[len(given) :], axis=1) - 1).max(initial=0.0)
    largest, mean = crease(positions, triangles, len(old))
    crossing = len(crossing_pairs(positions, triangles, new)) if len(new) else 0
    cells = (
        name,
        program,
        len(positions) - len(given),
        error,
        "%.1f" % mean,
        "%.0f" % largest,
        crossing,
        "%.2f" % seconds,
    )
    print("| " + " | ".join(map(str, cells)) + " |", flush=True)


def main():
    """Prints the table."""
    print("| mesh | program | new vertices | off the sphere | crease, mean | largest | crossing pairs | s |")
    print("|---|---|---|---|---|---|---|---|")
    with tempfile.TemporaryDirectory() as folder:
        cap = sphere(folder, "cap", lambda z: z > 0.5)
        band = sphere(folder, "band", lambda z: np.abs(z) < 0.25)
        cases = [
            ("sphere without a cap", cap, [], False, True),
            ("sphere without a band", band, ["--join", "auto"], True, True),
        ]
        for path in sys.argv[1:]:
            copy = str(Path(folder) / Path(path).name)
            write(copy, *read(path))
            cases.append((Path(path).stem, copy, [], False, False))
        for name, path, options, is_joined, is_sphere in cases:
            row(name, "fairmesh", path, by_fairmesh(path, options), is_sphere)
            row(name, "MeshLib", path, by_meshlib(path, is_joined), is_sphere)


if __name__ == "__main__":
    main()
