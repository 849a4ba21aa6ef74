"""Surfaces that are known exactly."""

import numpy as np
import pytest

import fairmesh
from meshes import (
    cube,
    dented_cylinder,
    dented_sphere,
    disc,
    flared_tube,
    off_sphere,
    smallest_angle,
    sphere,
    sphere_with_hole,
)


@pytest.mark.parametrize("seed", [1, 2, 3])
def test_a_dented_sphere_is_a_sphere_again(seed):
    vertices, faces, free, _ = dented_sphere(seed=seed)
    result = fairmesh.fair(vertices, faces, free=free)
    assert result.outcome is fairmesh.Outcome.CONVERGED
    assert result.outcome == "converged" and str(result.outcome) == "converged" and result.outcome.is_success
    assert result.vertices.dtype == np.float64
    assert off_sphere(result.vertices) < 1e-8
    assert np.array_equal(result.vertices[~free], vertices[~free])
    assert result.report.free_vertices == free.sum() == 121
    assert result.report.step < 1e-8


def test_float32_is_as_good_as_its_rounding():
    vertices, faces, free, _ = dented_sphere()
    single = vertices.astype(np.float32)
    result = fairmesh.fair(single, faces, free=free)
    assert result.vertices.dtype == np.float32
    assert off_sphere(result.vertices) < 1e-6
    assert np.array_equal(result.vertices[~free], single[~free])
    # Computed in double precision: the same as of the same numbers as doubles, rounded.
    double = fairmesh.fair(single.astype(np.float64), faces, free=free)
    assert np.array_equal(result.vertices, double.vertices.astype(np.float32))


def test_the_report_is_of_the_vertices_that_are_returned():
    vertices, faces, free, _ = dented_sphere()
    inside = faces[free[faces].any(axis=1)]
    double = fairmesh.fair(vertices + 2**19, faces, free=free)
    assert double.outcome is fairmesh.Outcome.CONVERGED
    rounded = fairmesh.fair(vertices + 2**19, faces, free=free, output_precision="single")
    assert rounded.outcome is fairmesh.Outcome.POOR_WHEN_ROUNDED and not rounded.outcome.is_success
    assert rounded.report.poor_triangle_count == len(rounded.poor_triangles) > 0
    assert np.array_equal(rounded.vertices[free], rounded.vertices[free].astype(np.float32))
    # What is returned of float32 is float32, whatever is asked for.
    floats = (vertices + 2**14).astype(np.float32)
    single = fairmesh.fair(floats, faces, free=free)
    asked = fairmesh.fair(floats, faces, free=free, output_precision="double")
    for result in (double, rounded, single, asked):
        assert abs(result.report.worst_angle - smallest_angle(result.vertices, inside)) < 1e-4


def test_only_a_surface_without_reservation_is_a_success():
    assert [outcome for outcome in fairmesh.Outcome if outcome.is_success] == [fairmesh.Outcome.CONVERGED]


def test_a_crease_along_the_boundary_is_no_success():
    # The top of a coarse cube cannot meet the normals of its walls.
    vertices, faces, free, _ = cube(4)
    result = fairmesh.fair(vertices, faces, free=free)
    assert result.outcome is fairmesh.Outcome.BOUNDARY_CREASE and not result.outcome.is_success
    report = result.report
    assert report.creased_vertex_count == len(result.creased_vertices) > 0
    assert report.boundary_kink > 45 and report.boundary_kink_vertex in result.creased_vertices
    assert report.remedy == result.outcome.remedy != ""


def test_the_nearest_member_is_a_surface_with_a_remark():
    vertices, faces, free, _ = flared_tube()
    result = fairmesh.fair(vertices, faces, free=free)
    report = result.report
    assert result.outcome is fairmesh.Outcome.NEAREST_MEMBER and not result.outcome.is_success
    assert not report.linear_surface and 0 < report.member_weight <= 1
    assert "between harmonic and minimal energy" in report.text and report.remedy
    (component,) = report.components
    assert component.member_weight == report.member_weight
    assert component.bending_energy == report.bending_energy > 0
    attempts = component.attempts
    assert sum(attempt.iterations for attempt in attempts) == report.iterations
    assert {attempt.free_vertices for attempt in attempts} == {free.sum()}
    assert attempts[0].name == "direct" and attempts[0].end is fairmesh.AttemptEnd.NOT_CONVERGED
    assert attempts[-1].name == "nearest member" and attempts[-1].end is fairmesh.AttemptEnd.SOUND
    assert attempts[-1].bending_energy == pytest.approx(report.bending_energy, rel=1e-6)
    with fairmesh.Solver(vertices, faces, free=free) as solver:
        assert solver.run().components[0].attempts == attempts


def test_the_bending_energy_of_a_sphere_is_its_solid_angle():
    vertices, faces, free, _ = dented_sphere()
    result = fairmesh.fair(vertices, faces, free=free)
    corners = result.vertices[faces]
    areas = np.linalg.norm(np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]), axis=1) / 2
    area = (areas[:, None] * free[faces]).sum() / 3  # H is -1: a third of each triangle for each free corner
    assert result.report.bending_energy == pytest.approx(area, rel=0.02)
    assert result.report.member_weight == 0


def test_a_surface_that_runs_into_what_stands_there_is_no_success():
    vertices, faces, free, _ = dented_sphere()
    needle = [[0.11, 0.07, 0.9], [0.13, 0.08, 0.9], [0.12, 0.1, 0.9], [0.12, 0.085, 1.5]]
    sides = np.array([[0, 2, 1], [0, 1, 3], [1, 2, 3], [2, 0, 3]]) + len(vertices)
    with_needle = np.concatenate([vertices, needle]), np.concatenate([faces, sides])
    may_move = np.append(free, [False] * 4)
    result = fairmesh.fair(*with_needle, free=may_move)
    assert result.outcome is fairmesh.Outcome.SELF_INTERSECTING and not result.outcome.is_success
    assert result.report.intersection_count == len(result.intersections) >= 3
    assert result.report.intersections_in_input == 0 and result.intersections[:, 1].min() >= len(faces)
    unseen = fairmesh.fair(*with_needle, free=may_move, intersections="skip")
    assert unseen.outcome is fairmesh.Outcome.CONVERGED and not unseen.report.intersections_checked
    assert np.array_equal(unseen.vertices, result.vertices)


def test_a_cylinder_with_given_normals():
    vertices, faces, free, exact = dented_cylinder()
    normals = exact * [1, 0, 1] / 0.5
    result = fairmesh.fair(vertices, faces, free=free, boundary_normals=normals)
    assert result.outcome.is_success
    error = np.abs(np.hypot(result.vertices[:, 0], result.vertices[:, 2]) - 0.5).max()
    assert error < 1e-4 * result.report.diagonal
    assert np.nanmax(np.abs(result.mean_curvature + 1)) < 0.02  # H = -1 / (2 r) = -1


@pytest.mark.parametrize("angle", [20.0, 45.0])
def test_given_normals_turn_a_disc_into_a_cap(angle):
    # The unit circle with normals tilted outward by an angle is the boundary of a cap of radius 1 / sin(angle).
    vertices, faces, free, _ = disc()
    boundary = np.flatnonzero(~free)
    tilt = np.radians(angle)
    vectors = vertices[boundary] * np.sin(tilt) + [0, 0, np.cos(tilt)]
    result = fairmesh.fair(vertices, faces, boundary_normals=(boundary, vectors))
    assert result.outcome.is_success
    centre = [0, 0, -1 / np.tan(tilt)]
    assert off_sphere(result.vertices - centre, 1 / np.sin(tilt)) < 1e-7
    # The other way to say the same: a row per vertex, NaN or zeros where there is none.
    for nothing in (np.nan, 0.0):
        rows = np.full(vertices.shape, nothing)
        rows[boundary] = vectors
        assert np.array_equal(fairmesh.fair(vertices, faces, boundary_normals=rows).vertices, result.vertices)
        assert np.isnan(rows).any() == np.isnan(nothing)
    assert np.array_equal(result.boundary_vertices, boundary)
    assert np.abs(result.boundary_normals - vectors).max() < 1e-12


def test_an_ellipsoid_continues_its_curvature():
    vertices, faces, free, _ = dented_sphere()
    vertices = vertices * [1.0, 0.8, 0.6]
    tangent = fairmesh.fair(vertices, faces, free=free)
    assert tangent.report.components[0].continuity == ()
    for none in ("g1", 0, 0.0):
        assert np.array_equal(fairmesh.fair(vertices, faces, free=free, continuity=none).vertices, tangent.vertices)
    result = fairmesh.fair(vertices, faces, free=free, continuity="g2")
    assert result.outcome.is_success
    (loop,) = result.report.components[0].continuity
    assert loop.vertex == result.boundary_vertices.min() and loop.vertex_count == len(result.boundary_vertices)
    assert 0.5 < loop.reached <= 1 and loop.jump < 0.5 * loop.jump_before
    assert loop.largest_jump >= loop.jump and loop.largest_jump_before >= loop.jump_before
    assert loop.curvature > 0.5 and loop.uncertainty > 0
    with fairmesh.Solver(vertices, faces, free=free, continuity=1.0) as solver:
        assert solver.run().components[0].continuity == (loop,)
        assert np.array_equal(solver.vertices, result.vertices)


def test_a_loop_has_a_number_of_its_own():
    vertices, faces, free, _ = dented_sphere()
    vertices = vertices * [1.0, 0.8, 0.6]
    asked = {"free": free, "threads": 1}
    whole = fairmesh.fair(vertices, faces, **asked, continuity="g2")
    on = int(whole.boundary_vertices[5])
    for how_far in ("g2", 1, 1.0):
        one = fairmesh.fair(vertices, faces, **asked, loop_continuity={on: how_far})
        assert np.array_equal(one.vertices, whole.vertices)
    tangent = fairmesh.fair(vertices, faces, **asked)
    for nothing in ({}, {on: "g1"}):
        assert np.array_equal(
            fairmesh.fair(vertices, faces, **asked, loop_continuity=nothing).vertices, tangent.vertices
        )
    with pytest.raises(fairmesh.InputError) as error:
        fairmesh.fair(vertices, faces, **asked, loop_continuity={0: 1.0})
    assert (error.value.status, error.value.element) == (fairmesh.Status.NOT_ON_LOOP, 0)
    with pytest.raises(TypeError, match="loop_continuity: a mapping from vertices to numbers is needed, not float"):
        fairmesh.fair(vertices, faces, **asked, loop_continuity=1.0)


def test_curvature_is_given_in_any_way():
    vertices, faces, free, _ = dented_sphere()
    boundary = fairmesh.fair(vertices, faces, free=free).boundary_vertices
    by_vertex = np.full(len(vertices), np.nan)
    by_vertex[boundary] = -1.25
    asked = {"free": free, "continuity": 0.5}
    results = [
        fairmesh.fair(vertices, faces, **asked, boundary_curvature=given)
        for given in (dict.fromkeys(boundary, -1.25), (boundary, np.full(len(boundary), -1.25)), by_vertex)
    ]
    (loop,) = results[0].report.components[0].continuity
    assert loop.curvature == pytest.approx(1.25) and 0 <= loop.reached <= 0.5
    assert all(np.array_equal(result.vertices, results[0].vertices) for result in results)
    estimated = fairmesh.fair(vertices, faces, **asked, boundary_curvature="estimated")
    assert not np.array_equal(estimated.vertices, results[0].vertices)
    for nothing in ({}, ([], []), np.full(len(vertices), np.nan, np.float32)):
        result = fairmesh.fair(vertices, faces, **asked, boundary_curvature=nothing)
        assert np.array_equal(result.vertices, estimated.vertices)


def test_some_normals_given_the_others_fitted():
    vertices, faces, free, exact = dented_sphere()
    boundary = fairmesh.fair(vertices, faces, free=free).boundary_vertices
    result = fairmesh.fair(vertices, faces, free=free, boundary_normals=(boundary[::2], exact[boundary[::2]]))
    assert off_sphere(result.vertices) < 1e-8
    assert np.abs(result.boundary_normals[::2] - exact[boundary[::2]]).max() < 1e-15


def test_averaged_normals_are_worse_than_fitted_ones():
    vertices, faces, free, _ = dented_sphere()
    averaged = fairmesh.fair(vertices, faces, free=free, boundary_normals="averaged")
    fitted = fairmesh.fair(vertices, faces, free=free, boundary_normals="fitted")
    assert off_sphere(fitted.vertices) < 1e-8 < 1e-5 < off_sphere(averaged.vertices) < 0.05


def test_a_positive_target_pushes_along_the_normals():
    vertices, faces, free, _ = disc()
    boundary = np.flatnonzero(~free)
    up = np.tile([0.0, 0.0, 1.0], (len(boundary), 1))
    flat = fairmesh.fair(vertices, faces, boundary_normals=(boundary, up))
    assert np.abs(flat.vertices[:, 2]).max() < 1e-12
    out = fairmesh.fair(vertices, faces, boundary_normals=(boundary, up), target=1.0)
    # Small heights: the clamped plate, Delta^2 z = 2 c, so that z = 2 c (1 - r^2)^2 / 64 with Delta_B H = c and
    # H = Delta z / 2.
    assert out.outcome.is_success
    assert abs(out.vertices[0, 2]) == pytest.approx(2 / 64, rel=0.05)
    assert out.vertices[0, 2] > 0
    assert np.array_equal(
        fairmesh.fair(vertices, faces, boundary_normals=(boundary, up), target=0.0).vertices, flat.vertices
    )
    assert np.array_equal(
        fairmesh.fair(vertices, faces, boundary_normals=(boundary, up), target="harmonic").vertices, flat.vertices
    )


def test_spheres_have_minimal_energy():
    vertices, faces, free, _ = dented_sphere()
    result = fairmesh.fair(vertices, faces, free=free, target="minimal_energy")
    assert result.outcome.is_success and off_sphere(result.vertices) < 1e-6


@pytest.mark.parametrize("weights", ["uniform", "conformal", "convex"])
@pytest.mark.parametrize("discretization", ["second_order", "paper"])
def test_inner_fairness_only_moves_vertices_within_the_surface(weights, discretization):
    vertices, faces, free, _ = dented_sphere()
    # Weights of the input need an input worth it.
    vertices[free, 2] -= 0.05 * np.sin(5 * vertices[free, 0])
    result = fairmesh.fair(vertices, faces, free=free, inner_fairness=weights, discretization=discretization)
    assert result.outcome.is_success
    assert off_sphere(result.vertices) < (1e-8 if discretization == "second_order" else 2e-2)


@pytest.mark.parametrize("interior", ["smooth", "input"])
def test_a_fixed_vertex_inside_is_passed(interior):
    vertices, faces, free, exact = dented_sphere()
    inside = 10 * 21 + 10
    free[inside] = False
    vertices[inside] = exact[inside]
    result = fairmesh.fair(vertices, faces, free=free, interior_normals=interior)
    assert np.array_equal(result.vertices[inside], exact[inside])
    assert inside in result.boundary_vertices
    if interior == "smooth":
        assert off_sphere(result.vertices) < 1e-8


def test_curvatures_of_the_result():
    vertices, faces, free, _ = dented_sphere()
    result = fairmesh.fair(2.0 * vertices, faces, free=free)
    assert np.abs(result.mean_curvature[free] + 0.5).max() < 1e-4
    assert np.abs(result.gaussian_curvature[free] - 0.25).max() < 0.02
    assert np.isnan(result.mean_curvature[0])
    low, high = result.report.h_inside
    assert low == result.mean_curvature[free].min() and high == result.mean_curvature[free].max()
    assert len(result.poor_triangles) == len(result.flipped_triangles) == len(result.needles) == 0
    assert result.report.intersections_checked and result.intersections.shape == (0, 2)
    assert len(result.suspicious_normals) == 0
    assert result.mean_curvature is result.mean_curvature


@pytest.mark.parametrize("radius", [0.5, 1.0, 20.0])
def test_mean_curvature_of_a_sphere(radius):
    vertices, faces = sphere(3, radius)
    h = fairmesh.mean_curvature(vertices, faces)
    assert h.shape == (len(vertices),) and h.dtype == np.float64
    assert np.abs(h * radius + 1).max() < 1e-6
    assert np.abs(fairmesh.mean_curvature(vertices, faces[:, ::-1]) * radius - 1).max() < 1e-6
    single = fairmesh.mean_curvature(vertices.astype(np.float32), faces)
    assert single.dtype == np.float64 and np.abs(single * radius + 1).max() < 1e-3


def test_triangles_that_cross():
    vertices = [[0, 0, 0], [2, 0, 0], [0, 2, 0], [0.5, 0.5, -1], [0.5, 0.5, 1], [3, 3, 0]]
    faces = [[0, 1, 2], [3, 4, 5], [1, 5, 2]]
    assert fairmesh.self_intersections(vertices, faces).tolist() == [[0, 1], [1, 2]]
    assert fairmesh.self_intersections(vertices, faces, [0]).tolist() == [[0, 1]]
    assert fairmesh.self_intersections(vertices, faces, np.array([False, False, True])).tolist() == [[1, 2]]
    assert fairmesh.self_intersections(*sphere(2)).shape == (0, 2)
    with pytest.raises(fairmesh.InputError):
        fairmesh.self_intersections(vertices, faces, [3])


def test_mean_curvature_is_nan_without_triangles():
    vertices, faces = sphere(1)
    h = fairmesh.mean_curvature(np.concatenate([vertices, [[5, 5, 5]]]), faces)
    assert np.isnan(h[-1]) and not np.isnan(h[:-1]).any()


@pytest.mark.parametrize("dtype", [np.float64, np.float32])
@pytest.mark.parametrize("integers", [np.int64, np.int32, np.uint32])
def test_a_hole_in_a_sphere_is_filled(dtype, integers):
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
    bar = 1e-8 if dtype == np.float64 else 1e-5
    assert off_sphere(filled.vertices[filled.new_vertices], 3.0) < bar
    assert fairmesh.boundary_loops(filled.vertices, filled.faces) == []

    (loop,) = filled.loops
    assert (loop.outcome, loop.reason, loop.refused) == ("faired", "none", None)
    assert loop.report.outcome.is_success and loop.report.free_vertices == filled.new_vertex_count
    assert (loop.vertices, loop.faces) == (filled.new_vertices, filled.new_faces)
    assert loop.worst_angle > 10 and not loop.coarsened and len(loop.outside_vertices) == 0
    assert filled.parents.shape == (filled.new_vertex_count, 3)
    assert filled.parents.max() < len(vertices)
    assert np.allclose(filled.parent_weights.sum(axis=1), 1) and filled.parent_weights.min() >= 0
    assert str(loop.edge_count) in repr(loop) and "1 loops" in repr(filled)


def test_fill_options():
    vertices, faces = sphere_with_hole()
    coarse = fairmesh.fill_holes(vertices, faces, density=1.0)
    fine = fairmesh.fill_holes(vertices, faces, density=3.0)
    assert fine.new_vertex_count > 2 * coarse.new_vertex_count
    few = fairmesh.fill_holes(vertices, faces, max_new_vertices=20)
    assert few.new_vertex_count <= 20 and few.loops[0].coarsened
    flat = fairmesh.fill_holes(vertices, faces, fair=False)
    assert flat.outcomes == ["flat"] and flat.loops[0].reason == "not_asked" and flat.loops[0].report is None
    edges = fairmesh.boundary_loops(vertices, faces)[0].vertices.size
    open_ = fairmesh.fill_holes(vertices, faces, max_edges=edges - 1)
    assert open_.outcomes == ["left_open"] and open_.loops[0].reason == "too_many_edges"
    assert open_.new_vertex_count == 0 and np.array_equal(open_.faces, faces)
    assert fairmesh.fill_holes(vertices, faces, max_edges=edges).outcomes == ["faired"]


def test_an_open_sheet_is_filled_only_if_it_is_named():
    _, faces, free, exact = dented_sphere()
    faces = faces[~free[faces].any(axis=1)]
    kinds = [loop.kind for loop in fairmesh.boundary_loops(exact, faces)]
    assert sorted(kinds) == ["hole", "outer_boundary"]
    filled = fairmesh.fill_holes(exact, faces)
    assert sorted((loop.outcome, loop.reason) for loop in filled.loops) == [
        ("faired", "none"),
        ("left_open", "outer_boundary"),
    ]
    hole = kinds.index("hole")
    only = fairmesh.fill_holes(exact, faces, loops=[hole])
    assert [loop.loop_index for loop in only.loops] == [hole]
    assert np.array_equal(only.vertices, filled.vertices)


def test_boundary_loops_of_a_disc():
    vertices, faces, free, _ = disc(rings=4)
    (loop,) = fairmesh.boundary_loops(vertices, faces)
    assert loop.kind is fairmesh.LoopKind.OUTER_BOUNDARY and loop.edge is None
    assert sorted(loop.vertices) == list(np.flatnonzero(~free))
    # Triangles that fill it would run the other way than the disc's.
    step = (np.roll(loop.vertices, -1) - loop.vertices) % 24
    assert set(step) == {23}
    assert loop.length == pytest.approx(24 * 2 * np.sin(np.pi / 24), rel=1e-12)
    assert loop.area == pytest.approx(12 * np.sin(np.pi / 12), rel=1e-12)
    assert loop.turn == pytest.approx(180, abs=1e-3)
    assert loop.touching.size == 0
    assert fairmesh.boundary_loops(*sphere(1)) == []


def test_loops_that_touch_and_loops_at_a_bad_edge():
    # Two triangles that share one vertex.
    vertices = np.array([[0, 0, 0], [1, 0, 0], [0, 1, 0], [-1, 0, 0], [0, -1, 0]], float)
    loops = fairmesh.boundary_loops(vertices, [[0, 1, 2], [0, 3, 4]])
    assert sorted(loop.vertices.size for loop in loops) == [3, 3]
    assert all(list(loop.touching) == [0] for loop in loops)
    # Three triangles at one edge.
    vertices = np.array([[0, 0, 0], [0, 0, 1], [1, 0, 0], [-1, 1, 0], [-1, -1, 0]], float)
    loops = fairmesh.boundary_loops(vertices, [[0, 1, 2], [0, 1, 3], [0, 1, 4]])
    bad = [loop for loop in loops if loop.kind == "non_manifold"]
    assert bad and all(loop.edge == (0, 1) for loop in bad)


def test_a_remeshed_region_is_faired():
    _, faces, free, exact = dented_sphere()
    new = fairmesh.remesh(exact.astype(np.float32), faces.astype(np.int32), free=free, density=2.0)
    assert new.vertices.dtype == np.float32 and new.faces.dtype == np.int32
    kept = ~free[new.kept_vertices]
    assert kept.sum() == (~free).sum()
    left = new.vertices[: len(new.kept_vertices)]
    assert np.array_equal(left[kept], exact.astype(np.float32)[new.kept_vertices][kept])
    outside = ~free[faces].any(axis=1)
    assert np.array_equal(new.kept_faces, np.flatnonzero(outside))
    assert new.parents.shape == new.parent_weights.shape == (new.new_vertex_count, 3)
    assert np.allclose(new.parent_weights.sum(axis=1), 1)
    assert len(new.free_vertices) == new.new_vertex_count + (~kept).sum() > 1.5 * free.sum()
    result = fairmesh.fair(new.vertices.astype(float), new.faces, free=new.free_vertices)
    assert off_sphere(result.vertices) < 1e-6
    few = fairmesh.remesh(exact, faces, free=free, density=2.0, max_vertices=30)
    assert few.new_vertex_count <= 30


def test_components_are_independent():
    vertices, faces, free, _ = dented_sphere()
    n = len(vertices)
    both = np.concatenate([vertices, 1e-3 * vertices + [50, 0, 0]])
    result = fairmesh.fair(both, np.concatenate([faces, faces + n]), free=np.concatenate([free, free]))
    components = result.report.components
    assert [c.vertex for c in components] == [np.flatnonzero(free)[0], n + np.flatnonzero(free)[0]]
    assert all(c.outcome.is_success and c.free_vertices == free.sum() and c.step < 1e-8 for c in components)
    assert components[1].diagonal == pytest.approx(1e-3 * components[0].diagonal, rel=1e-6)
    alone = fairmesh.fair(vertices, faces, free=free)
    assert np.array_equal(result.vertices[:n], alone.vertices)
    assert alone.report.components[0] == components[0]
    with fairmesh.Solver(both, np.concatenate([faces, faces + n]), free=np.concatenate([free, free])) as solver:
        report = solver.run()
        assert [c.outcome for c in report.components] == ["converged", "converged"]
        assert report.components == solver.report.components


def test_the_papers_own_scheme():
    vertices, faces, free, _ = dented_sphere()
    result = fairmesh.fair(vertices, faces, free=free, solver="paper", discretization="paper", paper_levels=2)
    assert result.outcome.is_success and result.report.level_count == len(result.levels) == 2
    coarse, fine = result.levels
    assert coarse.vertices < fine.vertices and fine.updates > 0 and fine.defect <= 1e-6
    assert fairmesh.fair(vertices, faces, free=free).levels == []
