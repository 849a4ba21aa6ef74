"""Meshes that name a vertex of the surface by several numbers."""

import numpy as np
import pytest

import fairmesh
from meshes import dented_sphere

MESH = dented_sphere()
JOINED = fairmesh.fair(MESH.vertices, MESH.faces, free=MESH.free)


def soup():
    """Every face with vertices of its own, numbered in the order of the vertices before; and their numbers before."""
    before = MESH.faces.ravel()
    order = np.argsort(before, kind="stable")
    number = np.empty_like(before)
    number[order] = np.arange(len(before))
    return before[order], number.reshape(-1, 3)


def test_a_soup_is_faired_as_the_joined_mesh():
    before, faces = soup()
    result = fairmesh.fair(MESH.vertices[before], faces, free=MESH.free[before])
    assert result.outcome is JOINED.outcome
    assert np.array_equal(result.vertices, JOINED.vertices[before])
    assert np.array_equal(result.mean_curvature, JOINED.mean_curvature[before], equal_nan=True)
    with fairmesh.Solver(MESH.vertices[before], faces, free=MESH.free[before]) as solver:
        solver.run()
        assert np.array_equal(solver.vertices, result.vertices)


def test_a_distance_below_zero():
    with pytest.raises(fairmesh.InputError) as error:
        fairmesh.fair(MESH.vertices, MESH.faces, coincident=-1.0)
    assert error.value.status is fairmesh.Status.BAD_OPTION


def test_the_other_functions_join_too():
    before, faces = soup()
    vertices = MESH.vertices[before]
    assert len(fairmesh.boundary_loops(vertices, faces)) == 1
    assert len(fairmesh.boundary_loops(vertices, faces, coincident="separate")) == len(faces)
    curvature = fairmesh.mean_curvature(vertices, faces)
    assert np.array_equal(curvature, fairmesh.mean_curvature(MESH.vertices, MESH.faces)[before])
    new = fairmesh.remesh(vertices, faces, free=MESH.free[before])
    assert len(fairmesh.boundary_loops(new.vertices, new.faces)) == 1
    open_faces = faces[~MESH.free[MESH.faces].any(axis=1)]
    hole = min(range(2), key=lambda index: len(fairmesh.boundary_loops(vertices, open_faces)[index].vertices))
    filled = fairmesh.fill_holes(vertices, open_faces, loops=[hole])
    assert np.array_equal(filled.faces[: len(open_faces)], open_faces)
    assert len(fairmesh.boundary_loops(filled.vertices, filled.faces)) == 1
