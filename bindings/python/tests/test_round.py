"""Edges that are rounded."""

import numpy as np
import pytest

import fairmesh
from meshes import cube

VERTICES, FACES = cube(2)[:2]
WIDTH = 0.1


def distance_to_rounded_edges(points, radius):
    """From the surface of a cube whose edges are cylinders; near its corners something else."""
    low, high = VERTICES.min(axis=0), VERTICES.max(axis=0)
    inner = np.clip(points, low + radius, high - radius)
    return np.abs(np.linalg.norm(points - inner, axis=1) - radius)


def test_all_edges_of_a_cube():
    made = fairmesh.round_edges(VERTICES, FACES, width=WIDTH)
    assert made.is_success and made.report.outcome is fairmesh.Outcome.CONVERGED
    assert len(made.creases) == 12 and all(crease.is_rounded and crease.part == 1.0 for crease in made.creases)
    assert {round(crease.bend) for crease in made.creases} == {90} and 0 < made.angle < 90
    assert made.creases[0].vertices.tolist() != [] and len(made.sharp_corners) == 0
    low, high = VERTICES.min(axis=0), VERTICES.max(axis=0)
    in_corner = (np.minimum(made.vertices - low, high - made.vertices) < 3 * WIDTH).all(axis=1)
    assert distance_to_rounded_edges(made.vertices[~in_corner], WIDTH).max() < 1e-3
    assert np.array_equal(made.vertices[: made.new_vertices.start], VERTICES[made.kept_vertices])
    assert len(made.kept_faces) == made.new_faces.start and made.kept_faces.max() < len(FACES)
    assert "12 of 12 creases" in repr(made) and made.mesh[1].shape == made.faces.shape


def test_one_edge_runs_through_to_the_faces_at_its_ends():
    high = VERTICES.max(axis=0)
    on_edge = np.flatnonzero((VERTICES[:, :2] == high[:2]).all(axis=1))
    on_edge = on_edge[np.argsort(VERTICES[on_edge, 2])]
    edges = np.stack([on_edge[:-1], on_edge[1:]], axis=1)
    made = fairmesh.round_edges((VERTICES, FACES), width=WIDTH, edges=edges)
    assert sum(crease.is_rounded for crease in made.creases) == 1
    assert [edge.fate for edge in made.report.sharp_edges] == [fairmesh.SharpFate.GOES_ON] * 2
    new = made.vertices[made.new_vertices]
    inside = (new[:, :2] > high[:2] - WIDTH).all(axis=1)
    at_ends = np.minimum(new[:, 2] - VERTICES[:, 2].min(), high[2] - new[:, 2]) < 1e-9
    from_axis = np.linalg.norm(new[:, :2] - (high[:2] - WIDTH), axis=1)
    assert np.abs(from_axis - WIDTH)[inside & ~at_ends].max() < 1e-4


def test_curvature_goes_on_if_asked():
    made = fairmesh.round_edges(VERTICES, FACES, width=0.15, continuity="g2")
    loops = [loop for component in made.report.components for loop in component.continuity]
    assert made.is_success and loops and min(loop.reached for loop in loops) > 0.95
    assert max(loop.jump / loop.jump_before for loop in loops) < 0.1


def test_threads_change_no_bit():
    one, two = (fairmesh.round_edges(VERTICES, FACES, width=WIDTH, threads=n, intersections="skip") for n in (1, 2))
    assert np.array_equal(one.vertices, two.vertices) and np.array_equal(one.faces, two.faces)


def test_what_is_refused():
    for given, status in (
        ({}, "BAD_OPTION"),
        ({"width": WIDTH, "creases": "concave"}, "NO_CREASE"),
        ({"width": WIDTH, "taper": 0.0}, "BAD_OPTION"),
        ({"width": WIDTH, "max_blend_vertices": 100}, "BAD_OPTION"),
        ({"width": WIDTH, "edges": [[0, len(VERTICES) - 1]]}, "NOT_AN_EDGE"),
    ):
        with pytest.raises(fairmesh.FairmeshError) as refused:
            fairmesh.round_edges(VERTICES, FACES, **given)
        assert refused.value.status is fairmesh.Status[status]
    with pytest.raises(TypeError, match="did you mean 'width'"):
        fairmesh.round_edges(VERTICES, FACES, widht=WIDTH)
    with pytest.raises(ValueError, match="creases: 'round' is none of"):
        fairmesh.round_edges(VERTICES, FACES, width=WIDTH, creases="round")


def test_it_can_be_stopped(live_handles):
    with pytest.raises(fairmesh.FairmeshError) as stopped:
        fairmesh.round_edges(VERTICES, FACES, width=WIDTH, progress=lambda _: False)
    assert stopped.value.status is fairmesh.Status.CANCELLED
    assert live_handles("result") == 0
