"""What comes back: types, lists, records, and all ways to say the same. The numbers are in test_answers.py."""

import numpy as np
import pytest

import fairmesh
from meshes import (
    cube,
    dented_cylinder,
    dented_sphere,
    disc,
    fading_ridge,
    flared_tube,
    flattened_roof,
    off_sphere,
    smallest_angle,
    sphere,
    sphere_with_hole,
)

VERTICES, FACES, FREE, _ = dented_sphere()
ELLIPSOID = VERTICES * [1.0, 0.8, 0.6]


def test_outcomes_are_their_names():
    result = fairmesh.fair(VERTICES, FACES, free=FREE)
    assert result.outcome is fairmesh.Outcome.CONVERGED
    assert result.outcome == "converged" and str(result.outcome) == "converged"
    assert [outcome for outcome in fairmesh.Outcome if outcome.is_success] == [fairmesh.Outcome.CONVERGED]


def test_float32_is_calculated_in_double_precision():
    single = VERTICES.astype(np.float32)
    result = fairmesh.fair(single, FACES, free=FREE)
    assert result.vertices.dtype == np.float32 and np.array_equal(result.vertices[~FREE], single[~FREE])
    double = fairmesh.fair(single.astype(np.float64), FACES, free=FREE)
    assert np.array_equal(result.vertices, double.vertices.astype(np.float32))


def test_the_report_is_of_the_vertices_that_are_returned():
    inside = FACES[FREE[FACES].any(axis=1)]
    rounded = fairmesh.fair(VERTICES + 2**19, FACES, free=FREE, output_precision="single")
    assert rounded.outcome is fairmesh.Outcome.POOR_WHEN_ROUNDED and not rounded.outcome.is_success
    assert rounded.report.poor_triangle_count == len(rounded.poor_triangles) > 0
    # What is returned of float32 is float32, whatever is asked for.
    floats = (VERTICES + 2**14).astype(np.float32)
    single = fairmesh.fair(floats, FACES, free=FREE)
    asked = fairmesh.fair(floats, FACES, free=FREE, output_precision="double")
    for result in (rounded, single, asked):
        assert abs(result.report.worst_angle - smallest_angle(result.vertices, inside)) < 1e-4
        edge = [result.report.sharpest_edge_from, result.report.sharpest_edge_to]
        beside = FACES[np.isin(FACES, edge).sum(axis=1) == 2]
        corners = result.vertices.astype(float)[beside]
        normals = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
        first, second = normals / np.linalg.norm(normals, axis=1)[:, None]
        assert abs(np.cos(np.radians(result.report.sharpest_edge)) - first @ second) < 1e-6


def test_what_is_wrong_is_listed():
    vertices, faces, free, _ = cube(4)
    result = fairmesh.fair(vertices, faces, free=free, sharp="off")
    report = result.report
    assert report.creased_vertex_count == len(result.creased_vertices) > 0
    assert report.boundary_kink_vertex in result.creased_vertices
    assert report.remedy == result.outcome.remedy != ""
    needle = [[0.11, 0.07, 0.9], [0.13, 0.08, 0.9], [0.12, 0.1, 0.9], [0.12, 0.085, 1.5]]
    sides = np.array([[0, 2, 1], [0, 1, 3], [1, 2, 3], [2, 0, 3]]) + len(VERTICES)
    mesh = np.concatenate([VERTICES, needle]), np.concatenate([FACES, sides])
    result = fairmesh.fair(*mesh, free=np.append(FREE, [False] * 4))
    assert result.outcome is fairmesh.Outcome.SELF_INTERSECTING
    assert result.report.intersection_count == len(result.intersections) >= 3
    assert result.report.intersections_in_input == 0 and result.intersections[:, 1].min() >= len(FACES)


def test_attempts():
    vertices, faces, free, _ = flared_tube()
    report = fairmesh.fair(vertices, faces, free=free).report
    assert report.outcome is fairmesh.Outcome.NEAREST_MEMBER and "between harmonic and minimal energy" in report.text
    (component,) = report.components
    assert 0 < component.member_weight == report.member_weight <= 1
    assert component.bending_energy == report.bending_energy > 0
    attempts = component.attempts
    assert sum(attempt.iterations for attempt in attempts) == report.iterations
    assert attempts[0].name == "direct" and attempts[0].end is fairmesh.AttemptEnd.NOT_CONVERGED
    assert attempts[-1].name == "nearest member" and attempts[-1].end is fairmesh.AttemptEnd.SOUND
    with fairmesh.Solver(vertices, faces, free=free) as solver:
        assert solver.run().components[0].attempts == attempts


def test_components():
    n = len(VERTICES)
    mesh = np.concatenate([VERTICES, 1e-3 * VERTICES + [50, 0, 0]]), np.concatenate([FACES, FACES + n])
    free = np.concatenate([FREE, FREE])
    report = fairmesh.fair(*mesh, free=free).report
    assert [c.vertex for c in report.components] == [np.flatnonzero(FREE)[0], n + np.flatnonzero(FREE)[0]]
    assert report.components[0] == fairmesh.fair(VERTICES, FACES, free=FREE).report.components[0]
    with fairmesh.Solver(*mesh, free=free) as solver:
        assert solver.run().components == solver.report.components == report.components


def test_normals_in_any_way():
    vertices, faces, free, _ = disc()
    boundary = np.flatnonzero(~free)
    vectors = vertices[boundary] * 0.6 + [0, 0, 0.8]
    result = fairmesh.fair(vertices, faces, boundary_normals=(boundary, vectors))
    assert np.array_equal(result.boundary_vertices, boundary)
    assert np.abs(result.boundary_normals - vectors).max() < 1e-12
    for nothing in (np.nan, 0.0):
        rows = np.full(vertices.shape, nothing)
        rows[boundary] = vectors
        assert np.array_equal(fairmesh.fair(vertices, faces, boundary_normals=rows).vertices, result.vertices)
        assert np.isnan(rows).any() == np.isnan(nothing)


def fair(**options):
    return fairmesh.fair(ELLIPSOID, FACES, free=FREE, threads=1, **options)


def test_continuity_and_targets_in_any_way():
    tangent = fair()
    # The mesh is too small to tell the curvature of its surroundings.
    curvature = dict.fromkeys(map(int, tangent.boundary_vertices), -1.25)
    whole = fair(continuity="g2", boundary_curvature=curvature)
    assert not np.array_equal(whole.vertices, tangent.vertices)
    on = int(whole.boundary_vertices[5])
    for asked in ({"continuity": 1.0}, *({"loop_continuity": {on: how_far}} for how_far in ("g2", 1, 1.0))):
        assert np.array_equal(fair(boundary_curvature=curvature, **asked).vertices, whole.vertices), asked
    for none in ("auto", "g1", 0, 0.0):
        assert np.array_equal(fair(continuity=none).vertices, tangent.vertices)
    (loop,) = fair(continuity="auto").report.components[0].continuity
    assert loop.asked == -1 and loop.reached == 0 and loop.uncertainty == np.inf
    for nothing in ({}, {on: "g1"}):
        assert np.array_equal(fair(loop_continuity=nothing).vertices, tangent.vertices)
    for target in (0.0, "harmonic"):
        assert np.array_equal(fair(target=target).vertices, tangent.vertices)
    with pytest.raises(fairmesh.InputError) as error:
        fair(loop_continuity={0: 1.0})
    assert (error.value.status, error.value.element) == (fairmesh.Status.NOT_ON_LOOP, 0)
    with pytest.raises(TypeError, match="loop_continuity: a mapping from vertices to numbers is needed, not float"):
        fair(loop_continuity=1.0)
    with fairmesh.Solver(ELLIPSOID, FACES, free=FREE, continuity=1.0, boundary_curvature=curvature) as solver:
        assert solver.run().components[0].continuity == whole.report.components[0].continuity
        assert np.array_equal(solver.vertices, whole.vertices)


def test_sharp_edges_go_on_where_that_is_asked_for():
    vertices, faces, free, exact = flattened_roof()
    auto, off = (fairmesh.fair(vertices, faces, free=free, sharp=sharp) for sharp in ("auto", "off"))
    assert np.abs(auto.vertices - exact).max() < 1e-9 < 0.1 < np.abs(off.vertices - exact).max()
    assert off.report.sharp_edges == ()
    for sharp, same in ((20, auto), (20.0, auto), (120, off), (0, off)):
        assert np.array_equal(fairmesh.fair(vertices, faces, free=free, sharp=sharp).vertices, same.vertices)
    (edge,) = auto.report.sharp_edges
    assert edge.fate is fairmesh.SharpFate.GOES_ON and edge.fate == "goes_on"
    assert np.abs(auto.vertices[edge.vertices][:, 1:]).max() < 1e-9 and len(edge.vertices) > 2
    for end in edge.ends:
        assert abs(end.angle - 90) < 1e-6 and end.error < 1 and end.vertex in edge.vertices
        assert np.abs(np.abs(end.direction) - [1, 0, 0]).max() < 1e-6
        assert abs(np.dot(end.normal_left, end.normal_right)) < 1e-6


def test_marked_edges_are_sharp():
    vertices, faces, free, exact = flattened_roof()
    vertices, exact = vertices * [1, 1, 0.1], exact * [1, 1, 0.1]
    on = np.isclose(exact[:, 2], 0)
    edges = np.concatenate([faces[:, [0, 1]], faces[:, [1, 2]], faces[:, [2, 0]]])
    marked = edges[on[edges].all(axis=1)]
    for sharp in ("auto", "off"):
        result = fairmesh.fair(vertices, faces, free=free, sharp=sharp, marked_edges=marked)
        (edge,) = result.report.sharp_edges
        assert edge.fate == "goes_on" and np.abs(result.vertices - exact).max() < 1e-9
        assert fairmesh.fair(vertices, faces, free=free, sharp=sharp).report.sharp_edges == ()
    with pytest.raises(ValueError, match=r"marked_edges: the shape has to be \(k, 2\), not \(3,\)"):
        fairmesh.fair(vertices, faces, free=free, marked_edges=[1, 2, 3])


def test_a_sharp_edge_that_ends_is_told():
    vertices, faces, free, _ = fading_ridge()
    report = fairmesh.fair(vertices, faces, free=free, sharp="auto").report
    (edge,) = report.sharp_edges
    assert edge.fate == "alone" and edge.fate.remedy and len(edge.ends) == 1 and len(edge.vertices) == 0
    assert abs(edge.ends[0].angle - 53.13) < 0.01 and report.loose_reason == "sharp_edge"


def test_sharp_edges_of_a_patch_are_told():
    vertices, faces, free, _ = flattened_roof()
    faces = faces[~free[faces].any(axis=1)]
    hole = next(k for k, loop in enumerate(fairmesh.boundary_loops(vertices, faces)) if loop.kind == "hole")
    filled = fairmesh.fill_holes(vertices, faces, loops=[hole], sharp="auto")
    (edge,) = filled.loops[0].report.sharp_edges
    assert edge.fate == "goes_on" and len(edge.vertices) > 2
    assert np.abs(filled.vertices[edge.vertices][:, 1:]).max() < 1e-9
    assert {end.vertex for end in edge.ends} == set(edge.vertices[[0, -1]])


def test_curvature_in_any_way():
    boundary = fair().boundary_vertices
    by_vertex = np.full(len(VERTICES), np.nan)
    by_vertex[boundary] = -1.25
    estimated = fair(continuity=0.5, boundary_curvature="estimated")
    given = fair(continuity=0.5, boundary_curvature=dict.fromkeys(boundary, -1.25))
    assert not np.array_equal(estimated.vertices, given.vertices)
    for same in ((boundary, np.full(len(boundary), -1.25)), by_vertex):
        assert np.array_equal(fair(continuity=0.5, boundary_curvature=same).vertices, given.vertices)
    for nothing in ({}, ([], []), np.full(len(VERTICES), np.nan, np.float32)):
        assert np.array_equal(fair(continuity=0.5, boundary_curvature=nothing).vertices, estimated.vertices)


def test_curvatures_of_the_result():
    result = fairmesh.fair(VERTICES, FACES, free=FREE)
    assert np.isnan(result.mean_curvature[0]) and result.mean_curvature is result.mean_curvature
    low, high = result.report.h_inside
    assert low == result.mean_curvature[FREE].min() and high == result.mean_curvature[FREE].max()
    assert len(result.poor_triangles) == len(result.flipped_triangles) == len(result.needles) == 0
    assert result.report.intersections_checked and result.intersections.shape == (0, 2)
    assert len(result.suspicious_normals) == 0


def test_mean_curvature_of_a_mesh():
    vertices, faces = sphere(3, 2.0)
    more = np.concatenate([vertices, [[5, 5, 5]]])
    h = fairmesh.mean_curvature(more, faces)
    assert h.shape == (len(more),) and h.dtype == np.float64
    assert np.abs(2 * h[:-1] + 1).max() < 1e-6 and np.isnan(h[-1])
    single = fairmesh.mean_curvature(vertices.astype(np.float32), faces)
    assert single.dtype == np.float64 and np.abs(2 * single + 1).max() < 1e-3


def test_triangles_that_cross():
    vertices = [[0, 0, 0], [2, 0, 0], [0, 2, 0], [0.5, 0.5, -1], [0.5, 0.5, 1], [3, 3, 0]]
    faces = [[0, 1, 2], [3, 4, 5], [1, 5, 2]]
    assert fairmesh.self_intersections(vertices, faces).tolist() == [[0, 1], [1, 2]]
    assert fairmesh.self_intersections(vertices, faces, [0]).tolist() == [[0, 1]]
    assert fairmesh.self_intersections(vertices, faces, np.array([False, False, True])).tolist() == [[1, 2]]
    assert fairmesh.self_intersections(*sphere(2)).shape == (0, 2)
    with pytest.raises(fairmesh.InputError):
        fairmesh.self_intersections(vertices, faces, [3])


@pytest.mark.parametrize("dtype", [np.float64, np.float32])
@pytest.mark.parametrize("integers", [np.int64, np.int32, np.uint32])
def test_a_filled_hole(dtype, integers):
    vertices, faces = sphere_with_hole(radius=3.0)
    vertices, faces = vertices.astype(dtype), faces.astype(integers)
    filled = fairmesh.fill_holes(vertices, faces)
    assert filled.vertices.dtype == dtype and filled.faces.dtype == integers
    assert np.array_equal(filled.vertices[: len(vertices)], vertices)
    assert np.array_equal(filled.faces[: len(faces)], faces)
    assert filled.outcomes == [fairmesh.FillOutcome.FAIRED]
    assert filled.new_vertex_count == len(filled.vertices) - len(vertices) > 50
    assert filled.new_face_count == len(filled.faces) - len(faces) > 100
    assert filled.new_vertices == slice(len(vertices), len(filled.vertices))
    assert filled.new_faces == slice(len(faces), len(filled.faces))
    assert off_sphere(filled.vertices[filled.new_vertices], 3.0) < (1e-8 if dtype == np.float64 else 1e-5)
    (loop,) = filled.loops
    assert (loop.outcome, loop.reason, loop.refused) == ("faired", "none", None)
    assert loop.report.outcome.is_success and loop.report.free_vertices == filled.new_vertex_count
    assert loop.worst_angle > 10 and not loop.coarsened and len(loop.outside_vertices) == 0
    assert filled.parents.shape == (filled.new_vertex_count, 3)
    assert str(loop.edge_count) in repr(loop) and "1 loops" in repr(filled)
    few = fairmesh.fill_holes(vertices, faces, max_new_vertices=20)
    assert few.loops[0].coarsened and fairmesh.fill_holes(vertices, faces, fair=False).loops[0].report is None


def test_boundary_loops():
    vertices, faces, free, _ = disc(rings=4)
    (loop,) = fairmesh.boundary_loops(vertices, faces)
    assert loop.kind is fairmesh.LoopKind.OUTER_BOUNDARY and loop.edge is None and loop.touching.size == 0
    assert sorted(loop.vertices) == list(np.flatnonzero(~free))
    assert loop.length == pytest.approx(24 * 2 * np.sin(np.pi / 24), rel=1e-12)
    assert loop.area == pytest.approx(12 * np.sin(np.pi / 12), rel=1e-12)
    assert loop.turn == pytest.approx(180, abs=1e-3)
    assert fairmesh.boundary_loops(*sphere(1)) == []
    # Two triangles that share one vertex; three triangles at one edge.
    corners = np.array([[0, 0, 0], [0, 0, 1], [1, 0, 0], [-1, 1, 0], [-1, -1, 0]], float)
    assert all(list(loop.touching) == [0] for loop in fairmesh.boundary_loops(corners, [[0, 1, 2], [0, 3, 4]]))
    loops = fairmesh.boundary_loops(corners, [[0, 1, 2], [0, 1, 3], [0, 1, 4]])
    bad = [loop for loop in loops if loop.kind == "non_manifold"]
    assert bad and all(loop.edge == (0, 1) for loop in bad)


def test_a_remeshed_region():
    vertices, faces, free, _ = dented_cylinder(side=21)
    new = fairmesh.remesh(vertices.astype(np.float32), faces.astype(np.int32), free=free, density=2.0)
    assert new.vertices.dtype == np.float32 and new.faces.dtype == np.int32
    kept = ~free[new.kept_vertices]
    assert kept.sum() == (~free).sum()
    left = new.vertices[: len(new.kept_vertices)]
    assert np.array_equal(left[kept], vertices.astype(np.float32)[new.kept_vertices][kept])
    assert np.array_equal(new.kept_faces, np.flatnonzero(~free[faces].any(axis=1)))
    assert new.parents.shape == new.parent_weights.shape == (new.new_vertex_count, 3)
    assert len(new.free_vertices) == new.new_vertex_count + (~kept).sum()
    assert fairmesh.fair(new.vertices, new.faces, free=new.free_vertices).outcome.is_success
