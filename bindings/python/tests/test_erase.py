"""Faces erased, trimmed and refilled; what was there is carried over."""

import numpy as np
import pytest

import fairmesh
from meshes import dented_sphere, off_sphere, sphere, sphere_with_hole

VERTICES, FACES = sphere(4)
TOP = (VERTICES[FACES, 2] > 0.8).all(axis=1)


def test_colours_come_from_what_was_erased():
    colours = (127.5 + 127 * VERTICES).astype(np.uint8)
    parts = (FACES.min(axis=1) % 3).astype(np.int32)
    left = fairmesh.erase(VERTICES, FACES, TOP)
    filled = fairmesh.fill_holes(VERTICES, left.faces, loops=left.loops)
    new = filled.vertices[filled.new_vertices]
    carried = fairmesh.carry_over(VERTICES, FACES, new, TOP)
    assert TOP[carried.faces].all() and np.array_equal(FACES[carried.faces], carried.corners)
    places = (VERTICES[carried.corners] * carried.weights[..., None]).sum(axis=1)
    assert np.linalg.norm(places - new, axis=1).max() < 0.01
    assert np.abs(carried.of_vertices(colours) - (127.5 + 127 * new)).max() < 3
    # By what is at the boundary alone the top of the cap would have the colours of its side.
    assert np.abs(colours[filled.parents].mean(axis=1) - (127.5 + 127 * new)).max() > 10
    assert np.array_equal(carried.of_faces(parts), parts[carried.faces])
    assert np.array_equal(fairmesh.carry_over((VERTICES, FACES), new).faces, carried.faces)
    nowhere = fairmesh.carry_over(VERTICES, FACES, [[0, 0, np.nan], [0, 0, 2]], [5])
    assert nowhere.faces.tolist() == [-1, 5] and (nowhere.corners[0] == -1).all()
    with pytest.raises(ValueError, match="point 0 is on no face: it is not finite"):
        nowhere.of_vertices(colours)


def test_what_would_spoil_a_boundary_is_cleaned():
    vertices, faces = sphere_with_hole()
    hole = fairmesh.boundary_loops(vertices, faces)[0].vertices
    # A sliver at the hole: its third vertex is nearly on the edge.
    a, b = hole[:2]
    tip = 0.5 * (vertices[a] + vertices[b]) * (1 + 1e-3)
    spoilt = np.concatenate([vertices, [tip]])
    order = [a, b] if ((faces == b) & (np.roll(faces, -1, 1) == a)).any() else [b, a]
    more = np.concatenate([faces, [[*order, len(vertices)]]])
    trimmed = fairmesh.trim_boundary(spoilt, more, 10)
    assert np.array_equal(trimmed.kept_faces, np.arange(len(faces))) and trimmed.dropped_count == 1
    corner = np.linalg.norm(np.cross(spoilt[b] - spoilt[a], tip - spoilt[a])) / 2
    assert trimmed.dropped_area == pytest.approx(corner)
    assert np.array_equal(trimmed.mesh[1], faces) and "1 dropped" in repr(trimmed)
    assert fairmesh.trim_boundary(spoilt, more, 10, max_area=corner / 2).dropped_count == 0
    assert fairmesh.trim_boundary(spoilt, more, 0).dropped_count == 0
    for wrong, message in (({"max_area": 0.0}, "max_area: it has to be positive"), ({"loops": [[0]]}, "loops: the")):
        with pytest.raises(ValueError, match=message):
            fairmesh.trim_boundary(spoilt, more, 10, **wrong)


def test_what_is_slender_beside_erased_faces_goes_with_them():
    rim = fairmesh.boundary_loops(VERTICES, FACES[~TOP])[0].vertices[:2]
    beside = np.flatnonzero(~TOP & np.isin(FACES, rim).sum(axis=1).astype(bool))
    (face,) = beside[np.isin(FACES[beside], rim).sum(axis=1) == 2]
    (apex,) = np.setdiff1d(FACES[face], rim)
    vertices = VERTICES.copy()
    vertices[apex] = 0.98 * VERTICES[rim].mean(axis=0) + 0.02 * VERTICES[apex]
    plain = fairmesh.erase(vertices, FACES, TOP)
    assert plain.cleaned_count == 0 and face in plain.kept_faces
    left = fairmesh.erase(vertices, FACES, TOP, clean=10)
    assert 1 <= left.cleaned_count <= 10 and face not in left.kept_faces


def test_a_region_is_refilled():
    vertices, faces, free, _ = dented_sphere()
    new = fairmesh.refill(vertices, faces, free, density=2.0)
    assert off_sphere(new.vertices[np.unique(new.faces)]) < 1e-6 and new.new_vertex_count > 150
    assert np.array_equal(vertices[new.kept_vertices], new.vertices[: new.new_vertices.start])
    assert np.array_equal(new.mesh[1], new.faces)
    with pytest.raises(fairmesh.FairmeshError) as error:
        fairmesh.refill(vertices, faces, progress=lambda _: False, free=free)
    assert error.value.status is fairmesh.Status.NO_FAIR_PATCH and error.value.remedy


def test_roughness_of_loops():
    vertices, faces = sphere_with_hole()
    (smooth,) = fairmesh.boundary_loops(vertices, faces, roughness=True)
    assert smooth.roughness is not None and not smooth.roughness.is_rough and smooth.roughness.advised_relax_rim == 0
    assert fairmesh.boundary_loops(vertices, faces)[0].roughness is None
    shaken = vertices + np.random.RandomState(1).normal(0, 0.01, vertices.shape)
    (loop,) = fairmesh.boundary_loops(shaken, faces, roughness=True)
    rough = loop.roughness
    assert rough.is_rough and rough.ratio > 2 > smooth.roughness.ratio and 0.005 < rough.noise < 0.02
    assert rough.angle > rough.expected_angle > 0
    advice = {"relax_rim": rough.advised_relax_rim, "relax_within": rough.advised_relax_within}
    filled = fairmesh.fill_holes(shaken, faces, **advice)
    assert filled.loops[0].moved is not None and advice["relax_rim"] > 0
    followed = fairmesh.fill_holes(shaken, faces, relax_rim="auto")
    assert followed.loops[0].moved.count == filled.loops[0].moved.count
    assert fairmesh.fill_holes(vertices, faces, relax_rim="auto").loops[0].moved is None
