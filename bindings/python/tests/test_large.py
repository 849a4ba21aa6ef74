"""100,000 free vertices: the answer, and the interpreter lock. timing.py measures the times."""

import threading
import time

import numpy as np

import fairmesh
from meshes import dented_sphere


def test_it_is_solved_while_other_threads_run():
    """The interpreter lock is released: another thread wakes up again and again during the call."""
    mesh = dented_sphere(side=356, frame=20)
    assert mesh.free.sum() == 99856
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
