"""Fairing in steps."""

import gc
import os
import signal
import threading
import time

import numpy as np
import pytest

import fairmesh
from meshes import dented_sphere, off_sphere


@pytest.mark.parametrize("dtype", [np.float64, np.float32])
def test_steps_find_what_one_call_finds(dtype):
    vertices, faces, free, _ = dented_sphere()
    vertices = vertices.astype(dtype)
    whole = fairmesh.fair(vertices, faces, free=free)
    with fairmesh.Solver(vertices, faces, free=free) as solver:
        assert np.array_equal(solver.vertices, vertices) and solver.vertices.dtype == dtype
        assert solver.report.iterations == 0
        steps = 0
        while solver.run(1).outcome is fairmesh.Outcome.ITERATION_LIMIT:
            steps += 1
            assert solver.report.iterations == steps
        assert solver.report.iterations == whole.report.iterations
        assert np.array_equal(solver.vertices, whole.vertices)
        assert np.array_equal(solver.mean_curvature, whole.mean_curvature, equal_nan=True)
        result = solver.result()
    # A result is a copy: it outlives the solver.
    assert np.array_equal(result.vertices, whole.vertices)
    assert np.array_equal(result.boundary_normals, whole.boundary_normals)
    assert result.report.outcome is fairmesh.Outcome.CONVERGED


def test_changes_in_between():
    vertices, faces, free, exact = dented_sphere()
    with fairmesh.Solver(vertices, faces, free=free, boundary_normals="averaged", threads=1) as solver:
        solver.run()
        assert off_sphere(solver.vertices) > 1e-5
        solver.set_boundary_normals(exact)
        assert solver.run().outcome.is_success
        assert off_sphere(solver.vertices) < 1e-7
        solver.set_target(-20.0)
        assert solver.run().outcome.is_success
        assert np.linalg.norm(solver.vertices[free], axis=1).min() < 1 - 1e-4
        solver.set_target("harmonic")
        solver.set_boundary_normals("fitted")
        assert solver.run().outcome.is_success
        assert off_sphere(solver.vertices) < 1e-7


def test_continuity_is_asked_anew():
    vertices, faces, free, _ = dented_sphere()
    vertices = vertices * [1.0, 0.8, 0.6]
    tangent, half, whole = (fairmesh.fair(vertices, faces, free=free, continuity=c) for c in (0.0, 0.5, 1.0))
    on = int(whole.boundary_vertices[0])
    with fairmesh.Solver(vertices, faces, free=free) as solver:
        solver.run()
        assert np.array_equal(solver.vertices, tangent.vertices)
        for asked, result in (
            (("g2",), whole),
            ((0.0, {on: 0.5}), half),
            (("g1",), tangent),
            ((1.0,), whole),
        ):
            solver.set_continuity(*asked)
            assert solver.run().outcome.is_success
            assert np.abs(solver.vertices - result.vertices).max() < 1e-6
        solver.set_boundary_curvature({on: -1.25})
        (loop,) = solver.run().components[0].continuity
        assert loop.curvature != whole.report.components[0].continuity[0].curvature
        with pytest.raises(fairmesh.InputError) as error:
            solver.set_continuity(0.0, {on: 1.5})
        assert (error.value.status, error.value.element) == (fairmesh.Status.BAD_OPTION, on)
        with pytest.raises(ValueError, match="continuity: 'g3' is neither"):
            solver.set_continuity("g3")


def test_errors_of_a_solver():
    vertices, faces, free, exact = dented_sphere()
    with fairmesh.Solver(vertices, faces, free=free) as solver:
        with pytest.raises(ValueError, match="normals: 440 rows, but 441 are needed"):
            solver.set_boundary_normals(exact[1:])
        wrong = exact.copy()
        boundary = int(solver.result().boundary_vertices[3])
        wrong[boundary] *= 2
        with pytest.raises(fairmesh.InputError) as error:
            solver.set_boundary_normals(wrong)
        assert (error.value.status, error.value.element) == (fairmesh.Status.BAD_NORMAL, boundary)
        with pytest.raises(ValueError, match="target: 'flat' is neither"):
            solver.set_target("flat")
        with pytest.raises(TypeError, match="iterations: an integer is needed, not float"):
            solver.run(1.5)
        with pytest.raises(fairmesh.InputError, match="iterations: has to be at least 1"):
            solver.run(0)
        assert solver.run().outcome.is_success
    for use in (solver.run, solver.result, lambda: solver.vertices, lambda: solver.report):
        with pytest.raises(fairmesh.FairmeshError, match="the solver is closed") as error:
            use()
        assert error.value.status is fairmesh.Status.BAD_HANDLE
    solver.close()
    with pytest.raises(fairmesh.InputError, match="free vertex 0 lies on the boundary"):
        fairmesh.Solver(vertices, faces, free=np.ones(len(vertices), bool))


def test_a_solver_is_busy_in_its_own_callback():
    vertices, faces, free, _ = dented_sphere()
    seen = []

    def look(_):
        with pytest.raises(fairmesh.FairmeshError) as error:
            solver.run(1)
        seen.append(error.value.status)
        with pytest.raises(fairmesh.FairmeshError) as error:
            solver.close()
        seen.append(error.value.status)

    with fairmesh.Solver(vertices, faces, free=free, progress=look) as solver:
        assert solver.run().outcome.is_success
    assert len(seen) > 4 and set(seen) == {fairmesh.Status.BUSY}


def test_a_second_thread_is_refused_and_does_no_harm():
    vertices, faces, free, _ = dented_sphere()
    inside, go_on = threading.Event(), threading.Event()

    def wait(_):
        inside.set()
        assert go_on.wait(30)

    reports = []
    with fairmesh.Solver(vertices, faces, free=free, progress=wait) as solver:
        thread = threading.Thread(target=lambda: reports.append(solver.run()))
        thread.start()
        assert inside.wait(30)
        with pytest.raises(fairmesh.FairmeshError) as error:
            solver.run()
        assert error.value.status is fairmesh.Status.BUSY
        go_on.set()
        thread.join(30)
    assert [report.outcome for report in reports] == ["converged"]


def test_a_callback_that_raises_can_be_followed_by_another_run():
    vertices, faces, free, _ = dented_sphere()
    whole = fairmesh.fair(vertices, faces, free=free)
    calls = []

    def fail_once(progress):
        calls.append(progress)
        if len(calls) == 4:
            raise KeyError("once")

    with fairmesh.Solver(vertices, faces, free=free, progress=fail_once) as solver:
        with pytest.raises(KeyError, match="once"):
            solver.run()
        assert solver.run().outcome is fairmesh.Outcome.CONVERGED
        assert off_sphere(solver.vertices) < 1e-8
        assert np.abs(solver.vertices - whole.vertices).max() < 1e-8


@pytest.mark.filterwarnings("ignore:.*use of fork:DeprecationWarning")
def test_a_forked_process():
    vertices, faces, free, _ = dented_sphere()
    expected = fairmesh.fair(vertices, faces, free=free).vertices
    solver = fairmesh.Solver(vertices, faces, free=free)
    solver.run(1)
    child = os.fork()
    if child == 0:
        code = 1
        try:
            # What the parent has made is refused and left alone; new calls work.
            with pytest.raises(fairmesh.FairmeshError, match="the process that this one was forked from"):
                solver.run()
            solver.close()
            del solver
            gc.collect()
            code = int(not np.array_equal(fairmesh.fair(vertices, faces, free=free).vertices, expected))
        finally:
            os._exit(code)
    for _ in range(300):
        ended, status = os.waitpid(child, os.WNOHANG)
        if ended:
            break
        time.sleep(0.1)
    else:
        os.kill(child, signal.SIGKILL)
        os.waitpid(child, 0)
        pytest.fail("the forked process hangs")
    assert os.WEXITSTATUS(status) == 0
    assert solver.run().outcome.is_success


def test_a_solver_that_its_own_callback_refers_to_is_collected(live_handles):
    vertices, faces, free, _ = dented_sphere()
    before = live_handles("solver")

    def make():
        solver = fairmesh.Solver(vertices, faces, free=free, progress=lambda _: solver is None)
        solver.run(1)

    make()
    gc.collect()
    assert live_handles("solver") == before
