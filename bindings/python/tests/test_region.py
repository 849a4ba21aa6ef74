"""Faces chosen by place, distance and shape, as masks."""

import numpy as np
import pytest

import fairmesh
from meshes import cube, sphere

VERTICES, FACES = cube(8)[:2]
LOW, HIGH = VERTICES.min(axis=0), VERTICES.max(axis=0)
CENTRE, TOP = (LOW + HIGH) / 2, (VERTICES[FACES, 2] == HIGH[2]).all(axis=1)
ON_TOP = [CENTRE[0], CENTRE[1], HIGH[2]]


def test_copies_of_vertices_hang_together_unless_they_are_separate():
    corners = VERTICES[FACES].reshape(-1, 3)
    apart = np.arange(len(corners)).reshape(-1, 3)
    assert fairmesh.select_component(corners, apart, 0).all()
    assert np.flatnonzero(fairmesh.select_component(corners, apart, 0, coincident="separate")).tolist() == [0]
    assert np.array_equal(fairmesh.grow(corners, apart, TOP), fairmesh.grow(VERTICES, FACES, TOP))


def test_masks():
    assert fairmesh.select_ball((VERTICES, FACES), HIGH, 2.6).dtype == bool
    assert fairmesh.select_patch(VERTICES, FACES, ON_TOP, 100).all()
    assert np.array_equal(fairmesh.select_patch(VERTICES, FACES, ON_TOP), TOP)
    grown = fairmesh.grow(VERTICES, FACES, TOP)
    assert np.array_equal(fairmesh.grow(VERTICES, FACES, np.flatnonzero(TOP), 2), fairmesh.grow(VERTICES, FACES, grown))
    assert np.array_equal(fairmesh.grow(VERTICES, FACES, TOP, 0), TOP)


def test_a_bump():
    vertices, faces = sphere(4)
    angle = np.arccos(np.clip(vertices[:, 2], -1, 1)) / 0.4
    height = np.where(angle < 1, 0.1 * np.clip(1 - angle**2, 0, None) ** 3, 0)
    found = fairmesh.select_bump(vertices * (1 - height[:, None]), faces, [0, 0, 0.9])
    assert found[(angle[faces] < 0.8).all(axis=1)].all() and found.sum() < len(faces) / 4
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
        (lambda: fairmesh.select_component(VERTICES, FACES, -1), fairmesh.InputError, "seed"),
        (lambda: fairmesh.select_component(VERTICES, FACES, len(VERTICES)), fairmesh.InputError, "only 386"),
        (lambda: fairmesh.select_component(VERTICES, FACES, 0.5), TypeError, "seed"),
        (lambda: fairmesh.grow(VERTICES, FACES, [len(FACES)]), fairmesh.InputError, "element"),
        (lambda: fairmesh.grow(VERTICES, FACES, TOP[1:]), ValueError, "region"),
        (lambda: fairmesh.shrink(VERTICES, FACES, TOP, -1), ValueError, "rings"),
        (lambda: fairmesh.select_bump(VERTICES, FACES, place=0), TypeError, "unknown option 'place'"),
    ],
)
def test_what_is_refused(call, error, message):
    with pytest.raises(error, match=message):
        call()
