"""Results go through pickles, copies and other processes."""

import copy
import pickle
from concurrent.futures import ProcessPoolExecutor
from functools import cached_property
from multiprocessing import get_context

import numpy as np
import pytest
import trimesh

import fairmesh
from meshes import dented_sphere, off_sphere, sphere_with_hole


def results():
    vertices, faces, free = dented_sphere()[:3]
    hole = sphere_with_hole()
    made = [
        fairmesh.fair(vertices, faces, free),
        fairmesh.fair(vertices, faces, free, continuity=1.0),
        fairmesh.remesh(vertices, faces, free),
        fairmesh.fill_holes(*hole),
        fairmesh.erase(*hole, np.arange(3)),
    ]
    return [*made, made[3].loops[0], made[0].report]


def same(one, other):
    if isinstance(one, np.ndarray):
        return np.array_equal(one, other, equal_nan=one.dtype.kind == "f")
    if isinstance(one, (list, tuple)):
        return len(one) == len(other) and all(map(same, one, other))
    if type(one).__module__.startswith("fairmesh") and hasattr(one, "__dict__"):
        return type(one) is type(other) and all(same(getattr(one, n), getattr(other, n)) for n in public(one))
    return one == other or (one != one and other != other)


def public(of):
    lazy = {n for kind in type(of).__mro__ for n, m in vars(kind).items() if isinstance(m, (cached_property, property))}
    return sorted(n for n in lazy | set(vars(of)) if not n.startswith("_"))


@pytest.mark.parametrize("through", [lambda r: pickle.loads(pickle.dumps(r)), copy.copy, copy.deepcopy])
def test_nothing_is_lost(through):
    for result in results():
        assert same(result, through(result)), result


def test_a_pickle_is_as_large_as_what_is_in_it():
    result = results()[0]
    assert len(pickle.dumps(result)) < 6 * result.vertices.nbytes


def fair(_):
    vertices, faces, free = dented_sphere()[:3]
    return fairmesh.fair(vertices, faces, free)


def test_a_result_comes_back_from_another_process():
    with ProcessPoolExecutor(1, mp_context=get_context("spawn")) as pool:
        (result,) = pool.map(fair, [0])
    assert result.report.outcome == "converged"
    assert off_sphere(result.vertices).max() < 1e-8
    assert np.array_equal(result.mesh[0], result.vertices)


def refused(_):
    vertices, faces, free = dented_sphere()[:3]
    faces[3, 1] = len(vertices) + 7
    fairmesh.fair(vertices, faces, free)


def test_what_is_raised_in_another_process_is_raised_here():
    with ProcessPoolExecutor(1, mp_context=get_context("spawn")) as pool:
        with pytest.raises(fairmesh.InputError, match="triangle 3 names vertex") as caught:
            list(pool.map(refused, [0]))
        again = list(pool.map(fair, [0]))
    why = caught.value
    assert (why.element, why.status) == (3, fairmesh.Status.INDEX_OUT_OF_RANGE)
    assert why.element_kind is fairmesh.ElementKind.TRIANGLE and len(again) == 1


def test_of_a_mesh_of_another_package_too():
    vertices, faces, free = dented_sphere()[:3]
    result = fairmesh.fair(trimesh.Trimesh(vertices, faces, process=False), free)
    again = pickle.loads(pickle.dumps(result))
    assert isinstance(again.mesh, trimesh.Trimesh)
    assert np.array_equal(again.mesh.vertices, result.vertices)
