"""Faces chosen by place, distance and shape, as masks."""

import numpy as np
import pytest

import fairmesh
from meshes import cube, dented_sphere, off_sphere, sphere

VERTICES, FACES = cube(8)[:2]
LOW, HIGH = VERTICES.min(axis=0), VERTICES.max(axis=0)
CENTRE, TOP = (LOW + HIGH) / 2, (VERTICES[FACES, 2] == HIGH[2]).all(axis=1)
ON_TOP = [CENTRE[0], CENTRE[1], HIGH[2]]


def test_places_on_a_cube():
    inside = (np.linalg.norm(VERTICES[FACES] - HIGH, axis=2) <= 2.6).all(axis=1)
    ball = fairmesh.select_ball(VERTICES, FACES, HIGH, 2.6)
    assert ball.dtype == bool and 0 < ball.sum() < len(FACES) and np.array_equal(ball, inside)
    everything = fairmesh.select_box((VERTICES, FACES), LOW, HIGH)
    assert everything.all() and len(everything) == len(FACES)
    upper = fairmesh.select_halfspace(VERTICES, FACES, CENTRE, [0, 0, 1])
    assert np.array_equal(upper, (VERTICES[FACES, 2] >= CENTRE[2]).all(axis=1))
    assert np.array_equal(~upper, fairmesh.select_halfspace(VERTICES, FACES, CENTRE, [0, 0, -1]))


def test_what_hangs_together_on_a_cube():
    assert np.array_equal(fairmesh.select_patch(VERTICES, FACES, ON_TOP), TOP)
    assert fairmesh.select_patch(VERTICES, FACES, ON_TOP, 100).all()
    assert fairmesh.select_component(VERTICES, FACES, 0).all()
    apart = np.concatenate([VERTICES, VERTICES + 10])
    two = np.concatenate([FACES, FACES + len(VERTICES)])
    second = fairmesh.select_component(apart, two, len(VERTICES))
    assert np.array_equal(second, np.arange(len(two)) >= len(FACES))
    half = (HIGH[0] - LOW[0]) / 2
    near = fairmesh.select_geodesic(VERTICES, FACES, ON_TOP, half)
    assert 0 < near.sum() < TOP.sum() and not (near & ~TOP).any()
    around = fairmesh.select_geodesic(VERTICES, FACES, ON_TOP, 1.6 * half)
    assert (around & ~TOP).any() and not (near & ~around).any()


def test_copies_of_vertices_hang_together_unless_they_are_separate():
    corners = VERTICES[FACES].reshape(-1, 3)
    apart = np.arange(len(corners)).reshape(-1, 3)
    assert fairmesh.select_component(corners, apart, 0).all()
    assert np.flatnonzero(fairmesh.select_component(corners, apart, 0, coincident="separate")).tolist() == [0]
    assert np.array_equal(fairmesh.grow(corners, apart, TOP), fairmesh.grow(VERTICES, FACES, TOP))


def test_rings_and_what_masks_are_combined_by():
    grown = fairmesh.grow(VERTICES, FACES, TOP)
    touched = np.isin(FACES, FACES[TOP]).any(axis=1)
    assert np.array_equal(grown, touched) and np.array_equal(fairmesh.shrink(VERTICES, FACES, grown), TOP)
    assert np.array_equal(fairmesh.grow(VERTICES, FACES, np.flatnonzero(TOP), 2), fairmesh.grow(VERTICES, FACES, grown))
    assert np.array_equal(fairmesh.grow(VERTICES, FACES, TOP, 0), TOP)
    left = fairmesh.select_halfspace(VERTICES, FACES, CENTRE, [-1, 0, 0])
    quarter = TOP & left | fairmesh.select_ball(VERTICES, FACES, CENTRE, 0.01)
    assert 0 < quarter.sum() < TOP.sum()
    assert len(fairmesh.erase(VERTICES, FACES, quarter).faces) <= (~quarter).sum()


def test_a_dent_is_found_and_faired():
    given = dented_sphere()
    dented = given.free[given.faces].any(axis=1)
    chosen = fairmesh.select_geodesic(given.vertices, given.faces, [0, 0, 0.8], 0.5) & dented
    chosen = fairmesh.grow(given.vertices, given.faces, chosen)
    assert (dented & ~chosen).sum() == 0
    result = fairmesh.fair(given.vertices, given.faces, free_faces=chosen)
    assert result.outcome.is_success
    assert off_sphere(result.vertices) < 5e-3


def test_a_bump_is_as_far_as_the_curvature_departs():
    vertices, faces = sphere(5)
    angle = np.arccos(np.clip(vertices[:, 2], -1, 1)) / 0.3
    height = np.where(angle < 1, 0.1 * np.clip(1 - angle**2, 0, None) ** 3, 0)
    bumped = vertices * (1 - height[:, None])
    on_it = (angle[faces] < 0.9).all(axis=1)
    found = fairmesh.select_bump(bumped, faces, [0, 0, 0.9])
    assert (on_it & ~found).sum() == 0 and found.sum() < len(faces) / 4
    result = fairmesh.fair(bumped, faces, free_faces=found)
    assert off_sphere(result.vertices) < 1e-6
    with pytest.raises(fairmesh.InputError) as refused:
        fairmesh.select_bump(VERTICES, FACES, ON_TOP)
    assert refused.value.status == fairmesh.Status.NO_BUMP


def test_meshes_of_other_packages():
    trimesh = pytest.importorskip("trimesh")
    mesh = trimesh.Trimesh(VERTICES, FACES, process=False)
    mesh.face_attributes["top"] = TOP
    assert np.array_equal(fairmesh.select_patch(mesh, ON_TOP), TOP)
    assert np.array_equal(fairmesh.grow(mesh, "top"), fairmesh.grow(VERTICES, FACES, TOP))
    assert len(fairmesh.erase(mesh, fairmesh.select_patch(mesh, ON_TOP)).mesh.faces) == (~TOP).sum()


@pytest.mark.parametrize(
    ("call", "error", "message"),
    [
        (lambda: fairmesh.select_ball(VERTICES, FACES, [0, 0], 1.0), ValueError, r"centre: the shape has to be \(3,\)"),
        (lambda: fairmesh.select_ball(VERTICES, FACES, CENTRE, "1"), TypeError, "radius: a number is needed"),
        (lambda: fairmesh.select_ball(VERTICES, FACES, CENTRE, -1), fairmesh.InputError, "a radius is at least 0"),
        (lambda: fairmesh.select_box(VERTICES, FACES, HIGH, LOW), fairmesh.InputError, "the largest coordinates"),
        (lambda: fairmesh.select_halfspace(VERTICES, FACES, LOW, [0, 0, 0]), fairmesh.InputError, "normal"),
        (lambda: fairmesh.select_patch(VERTICES, FACES, 0, 200), fairmesh.InputError, "angle"),
        (lambda: fairmesh.select_component(VERTICES, FACES, -1), fairmesh.InputError, "seed"),
        (lambda: fairmesh.select_component(VERTICES, FACES, len(VERTICES)), fairmesh.InputError, "only 386"),
        (lambda: fairmesh.select_component(VERTICES, FACES, 0.5), TypeError, "seed"),
        (lambda: fairmesh.select_patch(VERTICES, [], ON_TOP), fairmesh.InputError, "near a surface"),
        (lambda: fairmesh.select_bump(VERTICES, FACES, [1e200, 0, 0]), fairmesh.InputError, "near a surface"),
        (
            lambda: fairmesh.select_geodesic(VERTICES, FACES, ON_TOP, np.nan),
            fairmesh.InputError,
            "a radius is at least 0",
        ),
        (lambda: fairmesh.grow(VERTICES, FACES, [len(FACES)]), fairmesh.InputError, "element"),
        (lambda: fairmesh.grow(VERTICES, FACES, TOP[1:]), ValueError, "region"),
        (lambda: fairmesh.shrink(VERTICES, FACES, TOP, -1), ValueError, "rings"),
        (lambda: fairmesh.select_bump(VERTICES, FACES, place=0), TypeError, "unknown option 'place'"),
    ],
)
def test_what_is_refused(call, error, message):
    with pytest.raises(error, match=message):
        call()
