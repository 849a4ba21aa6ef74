"""Measures of the truth itself, and of errors that were planted."""

from __future__ import annotations

from itertools import islice

import numpy as np
import pytest

from fairbench.blends import blends
from fairbench.cases import Case, hole, place, seeded
from fairbench.measures import distances, measured, new_triangles
from fairbench.meshes import Mesh, boundary_edges, loops, read_ply, write_ply
from fairbench.shape import edge_angles, smallest_angles
from fairbench.surfaces import mesh_of, surfaces

SPHERE = surfaces()[0]


def sphere_case():
    random = seeded("test", 1)
    mesh = mesh_of(SPHERE, 0.12, "irregular", random)
    return hole("test", "exact", mesh, place(mesh, 0.45, random), SPHERE)


@pytest.mark.parametrize("surface", surfaces(), ids=[s.name for s in surfaces()])
def test_meshes_of_surfaces_are_on_them_and_face_outwards(surface):
    for kind in ("regular", "irregular"):
        mesh = mesh_of(surface, 0.15, kind, seeded("mesh", 1))
        assert surface.distance(mesh.vertices).max() < 2e-7
        assert len(loops(mesh.faces)) == (0 if any(surface.poles) or surface.name == "torus" else 2)
        assert smallest_angles(mesh).min() > 1
        assert edge_angles(mesh)[2].max() < 60
        first, middle = mesh.normals(), mesh.corners().mean(axis=1)
        outward = np.c_[middle[:, :2], 0 * middle[:, 2]]
        if surface.name != "torus":
            assert ((first * outward).sum(axis=1) > 0).mean() > 0.97


def test_the_truth_is_measured_as_no_error_at_all():
    case = sphere_case()
    truth = measured(case, case.truth)
    assert truth.rms < 1e-12 and truth.largest < 1e-12 and truth.vertices < 1e-7
    assert (truth.crease, truth.folds, truth.open_edges, truth.moved) == (0, 0, 0, 0)
    assert truth.new_triangles == case.wanted.sum()


def test_planted_errors_are_measured_as_what_they_are():
    case = sphere_case()
    new = case.wanted
    inner = np.setdiff1d(np.unique(case.truth.faces[new]), np.unique(case.truth.faces[~new]))
    vertices = case.truth.vertices.copy()
    vertices[inner] *= 1.1
    out = measured(case, Mesh(vertices, case.truth.faces))
    assert out.vertices * case.width() == pytest.approx(0.1, rel=1e-6)
    assert 0.05 < out.largest * case.width() < 0.101 and 0.03 < out.rms * case.width() < 0.1
    assert out.crease > 5
    unfilled = measured(case, case.mesh)
    assert unfilled.rms == 1 and unfilled.new_triangles == 0
    assert unfilled.open_edges == len(boundary_edges(case.mesh.faces))
    vertices = case.truth.vertices.copy()
    outside = np.setdiff1d(np.unique(case.truth.faces[~new]), np.unique(case.truth.faces[new]))
    vertices[outside[:3]] *= 1 + 1e-15
    vertices[outside[:3]] = np.nextafter(vertices[outside[:3]], 9)
    assert measured(case, Mesh(vertices, case.truth.faces)).moved == 3
    flipped = case.truth.faces.copy()
    flipped[np.flatnonzero(new)[0]] = flipped[np.flatnonzero(new)[0], ::-1]
    assert new_triangles(case, Mesh(case.truth.vertices, flipped)).sum() == new.sum()


def test_distances_are_to_faces_edges_and_corners():
    square = Mesh(np.array([[0.0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0]]), np.array([[0, 1, 2], [0, 2, 3]]))
    points = np.array([[0.3, 0.6, 2.0], [0.5, -3.0, 4.0], [2.0, 2.0, 0.0], [0.2, 0.2, 0.0]])
    assert distances(points, square) == pytest.approx([2, 5, np.sqrt(2), 0], abs=1e-12)


def test_files_come_back(tmp_path):
    mesh = sphere_case().mesh
    write_ply(tmp_path / "mesh.ply", mesh)
    again = read_ply(tmp_path / "mesh.ply")
    assert np.array_equal(again.vertices, mesh.vertices) and np.array_equal(again.faces, mesh.faces)


def pole_case(cap):
    """A sphere whose top is to be found, and the mesh with the top moved to heights that a function gives of the distance from the axis."""
    mesh = mesh_of(SPHERE, 0.08, "regular", seeded("pole", 1))
    part = mesh.corners().mean(axis=1)[:, 2] > 0.8
    case = hole("pole", "exact", mesh, part, SPHERE)
    inner = np.setdiff1d(np.unique(mesh.faces[part]), np.unique(mesh.faces[~part]))
    vertices = mesh.vertices.copy()
    rim = np.intersect1d(mesh.faces[part], mesh.faces[~part])
    edge = np.hypot(*mesh.vertices[rim, :2].T).mean()
    vertices[inner, 2] = mesh.vertices[rim, 2].mean() + cap(np.hypot(*vertices[inner, :2].T)) - cap(edge)
    return case, Mesh(vertices, mesh.faces)


def test_a_jump_of_mean_curvature_is_measured():
    for radius in (0.8, 2.0):
        case, result = pole_case(lambda r, radius=radius: np.sqrt(radius**2 - r**2))
        assert measured(case, result).jump / case.width() == pytest.approx(abs(1 / radius - 1), rel=0.1)


def test_triangles_that_go_through_others_are_counted():
    case, result = pole_case(lambda r: -3 * r)
    assert measured(case, result).crossings == 0
    # The top pushed through the bottom.
    vertices = result.vertices.copy()
    vertices[np.argmax(result.vertices[:, 2] + (np.hypot(*result.vertices[:, :2].T) < 1e-9)), 2] = -1.5
    pushed = measured(case, Mesh(vertices, result.faces))
    assert 3 <= pushed.crossings <= 8 and pushed.tangled == 0
    twice = Mesh(result.vertices, np.vstack([result.faces, result.faces[np.flatnonzero(case.wanted)[:1]]]))
    assert measured(case, twice).tangled == 3


def test_a_hole_beside_an_open_end_is_told_apart_from_it():
    tube = surfaces()[1]
    mesh = mesh_of(tube, 0.12, "irregular", seeded("tube", 1))
    # A hole whose boundary is one row of triangles away from the end.
    heights = np.abs(mesh.corners().mean(axis=1) - [1.0, 0, -1.1])
    part = np.linalg.norm(heights, axis=1) < 0.25
    case = hole("tube", "exact", mesh, part, tube)
    ends = boundary_edges(mesh.faces)
    assert measured(case, mesh).open_edges == 0
    middle = np.array([[0, 0, z * mesh.vertices[:, 2].max()] for z in (-1, 1)])
    lids = [(b, a, len(mesh.vertices) + (mesh.vertices[a, 2] > 0)) for a, b in ends]
    capped = Mesh(np.vstack([mesh.vertices, middle]), np.vstack([mesh.faces, lids]))
    both = measured(case, capped)
    assert (both.open_edges, both.new_triangles) == (0, part.sum()) and both.rms < 1e-12
    only_ends = measured(case, Mesh(capped.vertices, np.vstack([mesh.faces[~part], lids])))
    assert only_ends.open_edges == len(boundary_edges(mesh.faces[part]))


def test_flat_sides_do_not_count_as_rounded():
    for blend in islice(blends(seeded("blends", 3)), 2):
        told = {"edge": blend.edge, "radius": blend.radius}
        case = Case(blend.name, "blend", "round", blend.sharp, told, blend.rounded, blend.wanted, None)
        assert measured(case, blend.rounded).rms < 1e-10
        # The edge left all but as it is: the middle of the arc is off by .29 of the radius at right angles.
        vertices = blend.sharp.vertices.copy()
        vertices[blend.edge] += 1e-4
        left = measured(case, Mesh(vertices, blend.sharp.faces))
        assert 0.28 < left.largest * case.width() / blend.radius < 0.5
        assert len(np.unique(blend.edge)) == len(blend.edge) >= 32
