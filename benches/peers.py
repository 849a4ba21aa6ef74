"""Whole solves of fairmesh beside one linear solve of other libraries, by turns on the same meshes.

CPU seconds of all threads, medians.

    pip install numpy libigl meshlib ./bindings/python
    cargo build --release
    python3 benches/peers.py 1000 13000 100000

MeshLib is asked for `positionVertsSmoothly` with cotangent weights, libigl for `harmonic` with k = 2.
"""

import statistics
import subprocess
import sys
import tempfile
import time
from pathlib import Path

import fairmesh
import igl
import numpy as np
from meshlib import mrmeshnumpy, mrmeshpy

PROGRAM = Path(__file__).parent.parent / "target/release/fairmesh"
SHAPES = ("sphere-cap", "cylinder", "catenoid", "revolution")
# Turns for a mesh of a thousand free vertices, and at least.
TURNS = 20
FEWEST = 3


def case(shape, size, folder):
    """Positions, triangles, mask of the free vertices, and boundary normals as (indices, vectors)."""
    mesh, free, normals = (str(Path(folder) / name) for name in ("mesh.obj", "free.txt", "normals.txt"))
    options = ["--vertices", str(size), "--triangulation", "irregular", "--start", "flat"]
    command = [PROGRAM, "generate", shape, *options, "-o", mesh, "--free", free, "--normals", normals]
    subprocess.run(command, check=True, stdout=subprocess.DEVNULL)
    positions, triangles = igl.read_triangle_mesh(mesh)
    mask = np.zeros(len(positions), bool)
    mask[np.loadtxt(free, dtype=int, ndmin=1)] = True
    given = np.loadtxt(normals, ndmin=2)
    return positions, triangles, mask, (given[:, 0].astype(int), given[:, 1:].copy())


def solvers(positions, triangles, free, normals):
    """What is timed, by name."""
    fixed = np.flatnonzero(~free)
    wide = triangles.astype(np.int64)

    def meshlib():
        mesh = mrmeshnumpy.meshFromFacesVerts(triangles.astype(np.int32), positions)
        selected = mrmeshnumpy.vertBitSetFromBools(free)
        weights, masses = mrmeshpy.EdgeWeights.Cotan, mrmeshpy.VertexMass.NeiArea
        return lambda: mrmeshpy.positionVertsSmoothly(mesh, selected, weights, masses)

    return {
        "fairmesh": lambda: (
            lambda: fairmesh.fair(positions, triangles, free=free, boundary_normals=normals, threads=1)
        ),
        "MeshLib": meshlib,
        "libigl": lambda: lambda: igl.harmonic(positions, wide, fixed, positions[fixed], 2),
    }


def seconds(prepare):
    solve = prepare()
    begin = time.process_time()
    solve()
    return time.process_time() - begin


def main():
    sizes = [int(size) for size in sys.argv[1:]] or [1000, 13000]
    print(f"{'':12}{'free':>9}{'fairmesh s':>12}{'/ MeshLib':>11}{'/ libigl':>10}")
    for size in sizes:
        for shape in SHAPES:
            with tempfile.TemporaryDirectory() as folder:
                arrays = case(shape, size, folder)
            contestants = solvers(*arrays)
            spent = {name: [] for name in contestants}
            for _ in range(max(FEWEST, TURNS * 1000 // size)):
                for name, prepare in contestants.items():
                    spent[name].append(seconds(prepare))
            own, *others = (statistics.median(times) for times in spent.values())
            ratios = "".join(f"{own / other:10.2f}" for other in others)
            print(f"{shape:12}{arrays[2].sum():9}{own:12.4f} {ratios}", flush=True)


if __name__ == "__main__":
    main()
