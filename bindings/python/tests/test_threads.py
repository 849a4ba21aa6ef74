"""Any number of threads outside, and the same bits."""

import threading
from concurrent.futures import ThreadPoolExecutor

import pytest

import fairmesh
from meshes import dented_cylinder, dented_sphere, sphere_with_hole

MESH = dented_cylinder(side=41)


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
