"""A surface that follows what is dragged at its boundary."""

import numpy as np
import pytest

import fairmesh
from meshes import dented_sphere


@pytest.fixture
def solver():
    vertices, faces, free, _ = dented_sphere()
    with fairmesh.Solver(vertices, faces, free=free, tolerance=1e-10, threads=1) as made:
        made.finish()
        yield made


def boundary_vertex(solver):
    return int(solver.result().boundary_vertices[0])


def test_frames_settle_and_edits_are_taken_back(solver):
    first = solver.vertices
    edits = [fairmesh.Tilt(boundary_vertex(solver), 0.1)]
    solver.edit(edits)
    frames = [solver.update(evaluations=2)]
    while not frames[-1].is_settled:
        frames.append(solver.update(evaluations=2))
        assert frames[-1].evaluations <= 2 and len(frames) < 100
    assert len(frames) > 1 and frames[-1].step <= 1e-6
    assert np.abs(solver.vertices - first).max() > 1e-3
    solver.edit([])
    solver.finish()
    assert np.abs(solver.vertices - first).max() < 1e-8


def test_a_handle_takes_the_surface_with_it(solver):
    first = solver.vertices
    _, _, free, _ = dented_sphere()
    angle = 0.3
    turn = np.array([[np.cos(angle), -np.sin(angle), 0], [np.sin(angle), np.cos(angle), 0], [0, 0, 1]])
    centre, shift = np.array([0.5, 0.0, 0.0]), np.array([0.0, 2.0, 1.0])
    solver.edit([fairmesh.Move(~free, rotation=[0, 0, angle], centre=centre, translation=shift)])
    assert solver.update().is_settled
    solver.finish()
    assert np.abs(solver.vertices - ((first - centre) @ turn.T + centre + shift)).max() < 1e-8


def test_a_bulge_has_a_range(solver):
    low, high = solver.bulge_range()
    assert low < 0 < high
    heights = []
    for amount in (0.9 * low, 0.0, 0.9 * high):
        solver.edit([fairmesh.Bulge(amount)])
        assert solver.finish().outcome is fairmesh.Outcome.CONVERGED
        heights.append(np.linalg.norm(solver.vertices, axis=1).mean())
    assert heights[0] < heights[1] < heights[2]


def test_bad_edits_are_refused(solver):
    before = solver.vertices
    _, _, free, _ = dented_sphere()
    inside = int(np.flatnonzero(free)[0])
    with pytest.raises(TypeError, match="edits: Tilt, Twist, Bulge or Move is needed, not int"):
        solver.edit([1])
    with pytest.raises(fairmesh.InputError) as refused:
        solver.edit([fairmesh.Tilt(len(before), 0.1)])
    assert refused.value.status is fairmesh.Status.SELECTION_OUT_OF_RANGE and refused.value.element == len(before)
    with pytest.raises(fairmesh.InputError) as refused:
        solver.edit([fairmesh.Tilt(inside, 0.1)])
    assert refused.value.element == inside
    with pytest.raises(fairmesh.InputError) as refused:
        solver.edit([fairmesh.Move([inside], translation=[0, 0, 1])])
    assert refused.value.element == inside
    with pytest.raises(fairmesh.InputError):
        solver.edit([fairmesh.Bulge(np.nan)])
    with pytest.raises(fairmesh.InputError):
        solver.update(seconds=-1.0)
    with pytest.raises(ValueError, match=r"translation: the shape has to be \(3,\)"):
        solver.edit([fairmesh.Move([0], translation=[0, 1])])
    solver.update()
    assert np.abs(solver.vertices - before).max() < 1e-6
