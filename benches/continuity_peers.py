"""Linear surfaces of libigl and CGAL over the free vertices of a mesh: called by `./reproduce.sh continuity`.

    continuity_peers.py MESH FREE STEM         solves; prints a line of JSON for each solver: name, file, CPU seconds
    continuity_peers.py --convert MESH OUT     writes a mesh as the files that are read and written here

FREE lists the free vertices, one number a line. Files are PLY with doubles, triangles with 32-bit counts and numbers.
CGAL's `fair` is compiled at the first call; `reproduce.sh` installs Debian's libcgal-dev.
"""

import json
import subprocess
import sys
import tempfile
import time
from pathlib import Path

import igl
import numpy as np

CGAL = r"""
#define CGAL_EIGEN3_ENABLED 1
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/fair.h>
#include <CGAL/Surface_mesh.h>
#include <ctime>
#include <fstream>
#include <iostream>
typedef CGAL::Exact_predicates_inexact_constructions_kernel Kernel;
typedef CGAL::Surface_mesh<Kernel::Point_3> Mesh;
// Reads counts, positions, triangles and free vertices; writes seconds of the processor and positions.
int main(int, char **argv) {
    std::ifstream in(argv[1]);
    std::size_t points, triangles, free;
    in >> points >> triangles >> free;
    Mesh mesh;
    for (std::size_t k = 0; k < points; ++k) {
        double x, y, z;
        in >> x >> y >> z;
        mesh.add_vertex(Kernel::Point_3(x, y, z));
    }
    for (std::size_t k = 0; k < triangles; ++k) {
        unsigned a, b, c;
        in >> a >> b >> c;
        mesh.add_face(Mesh::Vertex_index(a), Mesh::Vertex_index(b), Mesh::Vertex_index(c));
    }
    std::vector<Mesh::Vertex_index> inside;
    for (unsigned v; in >> v;) inside.push_back(Mesh::Vertex_index(v));
    const std::clock_t begin = std::clock();
    const bool good = CGAL::Polygon_mesh_processing::fair(mesh, inside, CGAL::parameters::fairing_continuity(2));
    std::ofstream out(argv[2]);
    out.precision(17);
    out << double(std::clock() - begin) / CLOCKS_PER_SEC << "\n";
    for (auto v : mesh.vertices()) out << mesh.point(v) << "\n";
    return good ? 0 : 1;
}
"""


def write_ply(path, positions, triangles):
    header = (
        f"ply\nformat binary_little_endian 1.0\nelement vertex {len(positions)}\n"
        "property double x\nproperty double y\nproperty double z\n"
        f"element face {len(triangles)}\nproperty list uint int vertex_indices\nend_header\n"
    )
    rows = np.column_stack([np.full(len(triangles), 3), triangles]).astype("<u4")
    Path(path).write_bytes(header.encode() + positions.astype("<f8").tobytes() + rows.tobytes())


def cgal_program(folder):
    """The compiled program."""
    program = folder / "cgal_fair"
    if not program.exists():
        source = folder / "cgal_fair.cpp"
        source.write_text(CGAL)
        command = [
            "g++",
            "-O2",
            "-DNDEBUG",
            "-I/usr/include/eigen3",
            str(source),
            "-o",
            str(program),
            "-lgmp",
            "-lmpfr",
        ]
        subprocess.run(command, check=True)
    return program


def cgal(positions, triangles, free):
    program = cgal_program(Path(sys.argv[3]).parent)
    with tempfile.TemporaryDirectory() as folder:
        asked, answer = Path(folder) / "in", Path(folder) / "out"
        with asked.open("w") as file:
            file.write(f"{len(positions)} {len(triangles)} {len(free)}\n")
            for rows, form in ((positions, "%.17g"), (triangles, "%d"), (free, "%d")):
                np.savetxt(file, rows, form)
        if subprocess.run([program, asked, answer], check=False).returncode != 0:
            return None
        seconds, *numbers = answer.read_text().split()
    return np.array(numbers, float).reshape(-1, 3), float(seconds)


def harmonic(positions, triangles, free, k):
    is_fixed = np.ones(len(positions), bool)
    is_fixed[free] = False
    fixed = np.flatnonzero(is_fixed)
    begin = time.process_time()
    found = igl.harmonic(positions, triangles, fixed, positions[fixed], k)
    return found, time.process_time() - begin


def main():
    if sys.argv[1] == "--convert":
        write_ply(sys.argv[3], *igl.read_triangle_mesh(sys.argv[2]))
        return
    mesh, listed, stem = sys.argv[1:]
    positions, triangles = igl.read_triangle_mesh(mesh)
    triangles = triangles.astype(np.int64)
    free = np.loadtxt(listed, dtype=np.int64, ndmin=1)
    solvers = {
        "libigl harmonic, k = 2": lambda: harmonic(positions, triangles, free, 2),
        "libigl harmonic, k = 3": lambda: harmonic(positions, triangles, free, 3),
        "CGAL 5.5 fair, continuity 2": lambda: cgal(positions, triangles, free),
    }
    for number, (name, solve) in enumerate(solvers.items()):
        found = solve()
        if found is None:
            continue
        file = f"{stem}.peer{number}.ply"
        write_ply(file, found[0], triangles)
        print(json.dumps({"name": name, "file": file, "seconds": found[1]}), flush=True)


if __name__ == "__main__":
    main()
