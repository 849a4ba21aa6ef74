"""100,000 free vertices: what the package costs beside the call, the interpreter lock, and cancelling."""

import threading
import time

import numpy as np
import pytest

import fairmesh
from fairmesh import _arrays
from meshes import dented_sphere


class Run:
    """A fairing that was watched."""

    def __init__(self, mesh, threads):
        self.told, times = [], []

        def tell(progress):
            self.told.append(progress)
            times.append(time.perf_counter())

        cpu = time.process_time()
        start = time.perf_counter()
        self.result = fairmesh.fair(mesh.vertices, mesh.faces, free=mesh.free, threads=threads, progress=tell)
        self.seconds = time.perf_counter() - start
        self.cpu = time.process_time() - cpu
        self.gaps = np.diff([start, *times, start + self.seconds])

    def longest_between_iterations(self):
        """Seconds between callbacks of the iterations, without the first, which begins with a factorization."""
        return max(gap for gap, told in zip(self.gaps, self.told) if told.iteration > 1)

    def __str__(self):
        lines = [f"{gap:.3f} s to {told.phase} {told.iteration}" for gap, told in zip(self.gaps, self.told)]
        return "\n".join([*lines, f"{self.gaps[-1]:.3f} s to the end", f"{self.seconds:.3f} s together"])


@pytest.fixture(scope="module")
def mesh():
    made = dented_sphere(side=356, frame=20)
    assert made.free.sum() == 99856
    return made


@pytest.fixture(scope="module")
def run(mesh):
    run = Run(mesh, threads=1)
    print(run)
    return run


def test_it_is_solved(run):
    assert run.result.outcome.is_success
    assert np.abs(np.linalg.norm(run.result.vertices, axis=1) - 1).max() < 1e-7


def test_the_package_costs_a_few_percent(run, mesh):
    """CPU time of everything but the native call: reading the arrays, with a cast of the faces, and the results."""
    best = min(cost(mesh, run.result) for _ in range(5))
    print(f"package {best:.4f} s, whole {run.cpu:.3f} s of CPU time: {100 * best / run.cpu:.2f} %")
    assert best < 0.03 * run.cpu


def cost(mesh, result):
    start = time.process_time()
    given = _arrays.Mesh(mesh.vertices, mesh.faces)
    _arrays.Region(given, mesh.free, None, None)
    np.empty_like(given.vertices)
    result._handle.report()
    result._handle.scalars(fairmesh._abi.fairmesh_scalars.MEAN_CURVATURE, len(mesh.vertices))
    result._handle.list(fairmesh._abi.fairmesh_list.BORDER_VERTICES)
    return time.process_time() - start


def test_other_threads_run_on(mesh):
    """The interpreter lock is released: another thread wakes up every millisecond all the while."""
    done = threading.Event()
    late = []

    def tick():
        while not done.is_set():
            before = time.perf_counter()
            time.sleep(0.001)
            late.append(time.perf_counter() - before)

    thread = threading.Thread(target=tick)
    thread.start()
    start = time.perf_counter()
    fairmesh.fair(mesh.vertices, mesh.faces, free=mesh.free, threads=1)
    seconds = time.perf_counter() - start
    done.set()
    thread.join()
    print(f"{len(late)} ticks in {seconds:.3f} s, the longest pause {max(late):.3f} s")
    assert max(late) < 0.25 and len(late) > 100 * seconds


@pytest.mark.parametrize("make", [threading.Event, fairmesh.Monitor])
def test_cancelling_takes_an_iteration(run, mesh, make):
    """From setting the event in another thread to the return of the call, in the middle of an iteration."""
    cancel, times = make(), []
    third = threading.Event()

    def other():
        assert third.wait(60)
        time.sleep(0.02)
        times.append(time.perf_counter())
        getattr(cancel, "set", getattr(cancel, "cancel", None))()

    thread = threading.Thread(target=other)
    thread.start()
    result = fairmesh.fair(
        mesh.vertices,
        mesh.faces,
        free=mesh.free,
        threads=1,
        cancel=cancel,
        progress=lambda told: third.set() if told.iteration == 3 else None,
    )
    latency = time.perf_counter() - times[0]
    thread.join()
    iteration, end = run.longest_between_iterations(), run.gaps[-1]
    print(f"cancelled in {latency:.3f} s; an iteration takes {iteration:.3f} s, the end {end:.3f} s")
    assert result.outcome is fairmesh.Outcome.CANCELLED and result.report.iterations == 4
    # Nothing but the rest of the iteration and what follows the last one; doubled for a busy machine.
    assert latency < 2 * (iteration + end)
