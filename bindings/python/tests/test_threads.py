"""Any number of threads, inside and outside, and the same bits."""

import os
import struct
import subprocess
import threading
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

import numpy as np
import pytest

import fairmesh
from meshes import dented_cylinder, dented_sphere, sphere_with_hole

# The end of the SONAME.
INTERFACE = ".".join(fairmesh.__version__.split(".")[: 2 if fairmesh.__version__.startswith("0.") else 1])
ROOT = Path(__file__).resolve().parents[3]
MESH = dented_cylinder(side=41)


@pytest.mark.parametrize("threads", [1, 2, 3, 8])
def test_any_number_of_threads_gives_the_same_bits(threads):
    one = fairmesh.fair(MESH.vertices, MESH.faces, free=MESH.free, threads=1)
    more = fairmesh.fair(MESH.vertices, MESH.faces, free=MESH.free, threads=threads)
    assert one.vertices.tobytes() == more.vertices.tobytes()
    assert one.mean_curvature.tobytes() == more.mean_curvature.tobytes()
    hole = sphere_with_hole()
    assert (
        fairmesh.fill_holes(*hole, threads=1).vertices.tobytes()
        == fairmesh.fill_holes(*hole, threads=threads).vertices.tobytes()
    )


def test_many_calls_at_once():
    sphere, hole = dented_sphere(), sphere_with_hole()
    expected = {
        "fair": fairmesh.fair(sphere.vertices, sphere.faces, free=sphere.free).vertices.tobytes(),
        "fill": fairmesh.fill_holes(*hole).vertices.tobytes(),
        "curvature": fairmesh.mean_curvature(*hole).tobytes(),
    }

    def work(number):
        told = []
        with fairmesh.Solver(sphere.vertices, sphere.faces, free=sphere.free, threads=1 + number % 3) as solver:
            solver.run()
            stepped = solver.vertices.tobytes()
        whole = fairmesh.fair(
            sphere.vertices, sphere.faces, free=sphere.free, threads=1 + number % 3, progress=told.append
        )
        with pytest.raises(ZeroDivisionError):
            fairmesh.fair(sphere.vertices, sphere.faces, free=sphere.free, progress=lambda _: number // 0)
        with pytest.raises(fairmesh.InputError) as error:
            fairmesh.fair(sphere.vertices, sphere.faces, free=[220, 441 + number])
        assert error.value.element == 441 + number
        assert {told[-1].iteration} == {whole.report.iterations}
        return stepped, whole.vertices.tobytes(), fairmesh.fill_holes(*hole).vertices.tobytes()

    with ThreadPoolExecutor(12) as pool:
        for stepped, whole, filled in pool.map(work, range(60)):
            assert stepped == whole == expected["fair"] and filled == expected["fill"]
    assert fairmesh.mean_curvature(*hole).tobytes() == expected["curvature"]


def test_one_result_read_by_many_threads():
    result = fairmesh.fair(MESH.vertices, MESH.faces, free=MESH.free)
    expected = result._handle.scalars(fairmesh._abi.fairmesh_scalars.MEAN_CURVATURE, len(MESH.vertices)).tobytes()
    barrier = threading.Barrier(8)

    def read(_):
        barrier.wait(30)
        return result.mean_curvature.tobytes(), result.boundary_vertices.tobytes()

    with ThreadPoolExecutor(8) as pool:
        answers = set(pool.map(read, range(8)))
    assert {curvature for curvature, _ in answers} == {expected} and len(answers) == 1


def write_ply(path, vertices, faces):
    kind = {4: "float", 8: "double"}[vertices.itemsize]
    head = (
        f"ply\nformat binary_little_endian 1.0\nelement vertex {len(vertices)}\n"
        + "".join(f"property {kind} {axis}\n" for axis in "xyz")
        + f"element face {len(faces)}\nproperty list uchar int vertex_indices\nend_header\n"
    )
    rows = np.empty(len(faces), [("count", "u1"), ("corners", "<i4", 3)])
    rows["count"], rows["corners"] = 3, faces
    path.write_bytes(head.encode() + vertices.tobytes() + rows.tobytes())
    return len(head)


@pytest.mark.parametrize("dtype", [np.float64, np.float32])
def test_the_command_line_gives_the_same_bits(tmp_path, dtype):
    program = os.environ["FAIRMESH_TEST_PROGRAM"]
    vertices = MESH.vertices.astype(dtype)
    skip = write_ply(tmp_path / "in.ply", vertices, MESH.faces)
    (tmp_path / "free.txt").write_text("\n".join(map(str, np.flatnonzero(MESH.free))))
    command = [program, "fair", "in.ply", "-o", "out.ply", "--free", "free.txt"]
    subprocess.run(command, cwd=tmp_path, check=True, capture_output=True)
    written = np.frombuffer((tmp_path / "out.ply").read_bytes(), dtype, vertices.size, skip).reshape(-1, 3)
    result = fairmesh.fair(vertices, MESH.faces, free=MESH.free)
    assert result.outcome.is_success and not np.array_equal(result.vertices, vertices)
    assert np.array_equal(written, result.vertices)


PROGRAM = r"""
#include <fairmesh.h>
#include <stdio.h>
#include <stdlib.h>
int main(void) {
    uint64_t n, m;
    if (fread(&n, 8, 1, stdin) + fread(&m, 8, 1, stdin) != 2) return 2;
    double *positions = malloc(24 * n);
    uint32_t *corners = malloc(12 * m);
    uint8_t *may_move = malloc(n);
    if (fread(positions, 24, n, stdin) != n || fread(corners, 12, m, stdin) != m) return 3;
    if (fread(may_move, 1, n, stdin) != n) return 3;
    fairmesh_mesh mesh = {sizeof mesh, 0, {positions, n, 0, FAIRMESH_SCALAR_FLOAT64, 0}, {corners, m, 0}};
    fairmesh_selection selection = {sizeof selection, FAIRMESH_SELECTION_KIND_FREE_MASK, may_move, n, 0};
    fairmesh_points_out out = {positions, n, 0, FAIRMESH_SCALAR_FLOAT64, 0};
    if (fairmesh_fair(&mesh, &selection, NULL, &out, NULL, NULL, NULL) != FAIRMESH_STATUS_OK) return 4;
    return fwrite(positions, 24, n, stdout) == n ? 0 : 5;
}
"""


def test_c_gives_the_same_bits(tmp_path):
    (tmp_path / "fair.c").write_text(PROGRAM)
    library = Path(fairmesh.load().path).resolve()
    link = [f"-L{library.parent}", f"-l:{library.name}", f"-Wl,-rpath,{tmp_path}"]
    (tmp_path / f"libfairmesh.so.{INTERFACE}").symlink_to(library)
    command = ["cc", "-I", ROOT / "include", "-o", tmp_path / "fair", tmp_path / "fair.c", *link]
    subprocess.run(command, check=True)
    n, m = len(MESH.vertices), len(MESH.faces)
    given = struct.pack("<QQ", n, m) + MESH.vertices.tobytes() + MESH.faces.astype("<u4").tobytes()
    run = subprocess.run([tmp_path / "fair"], input=given + MESH.free.tobytes(), capture_output=True, check=True)
    result = fairmesh.fair(MESH.vertices, MESH.faces, free=MESH.free)
    assert run.stdout == result.vertices.tobytes()
