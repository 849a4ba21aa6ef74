"""Memory that runs out and bugs of the library, in a build of it that can be made to fail, with the wheel's linker."""

import os
import subprocess
import sys
from pathlib import Path

HOOKS = os.environ["FAIRMESH_TEST_HOOKS"]

PREPARE = """
import sys
sys.path.insert(0, sys.argv[1])
import ctypes
import numpy as np
import fairmesh
from meshes import band_missing, dented_sphere, sphere_with_hole

library = fairmesh.load(sys.argv[2])
refuse = library._cdll.fairmesh_test_refuse
refuse.argtypes, refuse.restype = (ctypes.c_int64, ctypes.c_int64), ctypes.c_uint64
panic = library._cdll.fairmesh_test_panic
panic.argtypes, panic.restype = (ctypes.c_int64,), None
vertices, faces, free, _ = dented_sphere(side=13, frame=3)
hole = sphere_with_hole(level=2)
band = band_missing(level=2)
calls = {
    "fair": lambda: fairmesh.fair(vertices, faces, free=free, threads=1).vertices,
    "fill_holes": lambda: fairmesh.fill_holes(*hole, threads=1).vertices,
    "join": lambda: fairmesh.fill_holes(*band, join="auto", threads=1).vertices,
    "suggest_joins": lambda: np.array([found.loops for found in fairmesh.suggest_joins(*band)]),
    "erase": lambda: fairmesh.erase(vertices, faces, [3]).faces,
    "trim_boundary": lambda: fairmesh.trim_boundary(vertices, faces, 3).faces,
    "carry_over": lambda: fairmesh.carry_over(vertices, faces, hole[0]).faces,
    "refill": lambda: fairmesh.refill(vertices, faces, free, threads=1).vertices,
    "roughness": lambda: np.array([loop.roughness.ratio for loop in fairmesh.boundary_loops(*hole, roughness=True)]),
    "mean_curvature": lambda: fairmesh.mean_curvature(vertices, faces),
}
"""

OUT_OF_MEMORY = """
for name, call in calls.items():
    expected = call()
    refuse(-1, 0)
    call()
    count = refuse(-1, 0)
    refused = 0
    for at in range(0, count, max(1, count // 60)):
        refuse(at, 1 << 40)
        try:
            answer = call()
        except MemoryError as error:
            assert isinstance(error, fairmesh.OutOfMemoryError) and error.status is fairmesh.Status.OUT_OF_MEMORY
            refused += 1
        else:
            assert answer.tobytes() == expected.tobytes()
        finally:
            refuse(-1, 0)
    assert refused > 0, name
    assert call().tobytes() == expected.tobytes()
print("done")
"""

PANIC = """
for name, call in calls.items():
    expected = call()
    panic(0)
    try:
        call()
    except fairmesh.FairmeshError as error:
        assert error.status is fairmesh.Status.INTERNAL and not isinstance(error, ValueError)
    else:
        raise AssertionError(name)
    assert call().tobytes() == expected.tobytes()
solver = fairmesh.Solver(vertices, faces, free=free)
panic(0)
for _ in range(2):  # from now on
    try:
        solver.run()
    except fairmesh.FairmeshError as error:
        assert error.status is fairmesh.Status.INTERNAL
    else:
        raise AssertionError("solver")
solver.close()
print("done")
"""


def run(program):
    command = [sys.executable, "-c", PREPARE + program, str(Path(__file__).parent), HOOKS]
    done = subprocess.run(command, capture_output=True, text=True, timeout=300)
    assert (done.stdout, done.returncode) == ("done\n", 0), done.stderr


def test_memory_that_runs_out_is_a_memory_error():
    run(OUT_OF_MEMORY)


def test_a_bug_of_the_library_is_an_exception():
    run(PANIC)
