"""Results, solvers and their memory are freed."""

import gc
from pathlib import Path

import numpy as np
import pytest

import fairmesh
from meshes import dented_sphere, disc, sphere_with_hole

VERTICES, FACES, FREE, _ = dented_sphere(side=13, frame=3)
SMALL = disc(rings=4)
HOLE = sphere_with_hole(level=2)


def resident():
    """Memory in use, in bytes."""
    gc.collect()
    return int(Path("/proc/self/statm").read_text().split()[1]) * 4096


def one_of_everything():
    result = fairmesh.fair(VERTICES, FACES, free=FREE, threads=1)
    assert len(result.mean_curvature) == len(VERTICES) and len(result.boundary_normals) > 0
    filled = fairmesh.fill_holes(*HOLE, threads=1)
    assert filled.loops[0].report is not None and len(filled.parents) > 0
    assert len(fairmesh.boundary_loops(*HOLE)) == 1
    solver = fairmesh.Solver(SMALL.vertices, SMALL.faces, threads=1)
    solver.run(1)
    solver.result()
    with pytest.raises(KeyError):
        fairmesh.fair(VERTICES, FACES, free=FREE, threads=1, progress=lambda told: {}[told])
    with pytest.raises(fairmesh.InputError):
        fairmesh.fair(VERTICES, FACES, free=[0], threads=1)


def test_a_thousand_calls_of_each_kind_leave_nothing():
    for _ in range(100):
        one_of_everything()
    before = resident()
    for _ in range(1000):
        one_of_everything()
    # A single result has 25 kB: a leak of any kind would be 25 MB and more.
    assert resident() - before < 4e6


def test_handles_are_freed_with_their_objects(live_handles):
    results = [fairmesh.fair(VERTICES, FACES, free=FREE) for _ in range(3)]
    filled = fairmesh.fill_holes(*HOLE)
    assert live_handles("result") == 4
    loop = filled.loops[0]
    del filled
    assert live_handles("result") == 4  # its lists can still be read
    assert loop.outside_vertices.size == 0
    del loop
    assert live_handles("result") == 3
    curvature = results[0].mean_curvature
    del results
    assert live_handles("result") == 0
    assert np.isfinite(curvature).any()


def test_a_solver_is_freed_without_close(live_handles):
    solver = fairmesh.Solver(VERTICES, FACES, free=FREE)
    result = solver.result()
    assert (live_handles("solver"), live_handles("result")) == (1, 1)
    del solver
    assert (live_handles("solver"), live_handles("result")) == (0, 1)
    assert np.array_equal(result.vertices, VERTICES)


def test_freed_when_an_exception_passes(live_handles):
    def fails():
        solver = fairmesh.Solver(VERTICES, FACES, free=FREE)
        result = fairmesh.fair(VERTICES, FACES, free=FREE)
        raise RuntimeError(solver, result)

    with pytest.raises(RuntimeError) as error:
        fails()
    assert (live_handles("solver"), live_handles("result")) == (1, 1)
    del error
    assert (live_handles("solver"), live_handles("result")) == (0, 0)


def test_solvers_in_cycles_are_collected(live_handles):
    solver = fairmesh.Solver(VERTICES, FACES, free=FREE)
    solver.self = solver
    del solver
    assert live_handles("solver") == 0
