"""100,000 free vertices: the answer, the interpreter lock, and cancelling. timing.py measures the times."""

import threading
import time

import numpy as np
import pytest

import fairmesh
from meshes import dented_sphere


@pytest.fixture(scope="module")
def mesh():
    made = dented_sphere(side=356, frame=20)
    assert made.free.sum() == 99856
    return made


def test_it_is_solved_while_other_threads_run(mesh):
    """The interpreter lock is released: another thread wakes up again and again during the call."""
    done, ticks = threading.Event(), []

    def tick():
        while not done.is_set():
            time.sleep(0.001)
            ticks.append(None)

    thread = threading.Thread(target=tick)
    thread.start()
    before = len(ticks)
    result = fairmesh.fair(mesh.vertices, mesh.faces, free=mesh.free, threads=1)
    during = len(ticks) - before
    done.set()
    thread.join()
    assert result.outcome.is_success
    assert np.abs(np.linalg.norm(result.vertices, axis=1) - 1).max() < 1e-7
    # Without the lock it would be one or two.
    assert during > 20


@pytest.mark.parametrize("make", [threading.Event, fairmesh.Monitor])
def test_cancelling_takes_no_more_than_an_iteration(mesh, make):
    """From another thread, in the middle of an iteration."""
    cancel, third = make(), threading.Event()

    def other():
        assert third.wait(100)
        getattr(cancel, "set", getattr(cancel, "cancel", None))()

    def tell(progress):
        if progress.iteration == 3:
            third.set()
            thread.join()

    thread = threading.Thread(target=other)
    thread.start()
    result = fairmesh.fair(mesh.vertices, mesh.faces, free=mesh.free, threads=1, cancel=cancel, progress=tell)
    assert result.outcome is fairmesh.Outcome.CANCELLED and result.report.iterations in (3, 4)
