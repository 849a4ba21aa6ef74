"""What the package costs beside the library, and how soon a run stops; prints only: python timing.py [SIDE].

A unit sphere's top, laid flat, with SIDE x SIDE vertices, 356 by default: 100,000 of them free.
"""

import sys
import threading
import time

import numpy as np

import fairmesh
from fairmesh import _arrays
from meshes import dented_sphere


def main(side):
    mesh = dented_sphere(side=side, frame=20)
    gaps, result, cpu = watched(mesh)
    print(f"{mesh.free.sum()} free vertices, {result.outcome}, {sum(gaps):.2f} s, {cpu:.2f} s of CPU time, one thread")
    print(f"longest time between two calls of the progress function: {max(gaps):.3f} s")
    own = min(cost(mesh, result) for _ in range(5))
    print(f"the package's own part: {own:.4f} s of CPU time, {own / cpu:.2%}")
    for threads in (1, 2):
        stops = sorted(stopped(mesh, share * sum(gaps) / threads, threads) for share in np.linspace(0, 0.9, 24))
        print(f"stopped at 24 moments, {threads} threads: median {np.median(stops):.3f} s, worst {stops[-1]:.3f} s")


def watched(mesh):
    times = [time.perf_counter()]
    cpu = time.process_time()
    result = fairmesh.fair(
        mesh.vertices, mesh.faces, free=mesh.free, threads=1, progress=lambda _: times.append(time.perf_counter())
    )
    cpu = time.process_time() - cpu
    return np.diff([*times, time.perf_counter()]), result, cpu


def cost(mesh, result):
    """Reading the arrays, with a cast of the faces, and the results."""
    start = time.process_time()
    given = _arrays.Mesh(mesh.vertices, mesh.faces)
    _arrays.Region(given, mesh.free, None, None)
    np.empty_like(given.vertices)
    result._handle.report()
    result._handle.scalars(fairmesh._abi.fairmesh_scalars.MEAN_CURVATURE, len(mesh.vertices))
    result._handle.list(fairmesh._abi.fairmesh_list.BOUNDARY_VERTICES)
    return time.process_time() - start


def stopped(mesh, after, threads):
    """Seconds from cancelling to the return of the call."""
    monitor, asked = fairmesh.Monitor(), []

    def cancel():
        asked.append(time.perf_counter())
        monitor.cancel()

    timer = threading.Timer(after, cancel)
    timer.start()
    fairmesh.fair(mesh.vertices, mesh.faces, free=mesh.free, threads=threads, cancel=monitor)
    end = time.perf_counter()
    timer.cancel()
    timer.join()
    return max(end - asked[0], 0.0) if asked else 0.0


if __name__ == "__main__":
    main(int(sys.argv[1]) if len(sys.argv) > 1 else 356)
