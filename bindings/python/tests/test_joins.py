"""Several loops with one patch, bridges, which loops, erased faces, components: on spheres, which have one answer."""

import math

import numpy as np
import pytest

import fairmesh
from fairmesh import ElementKind, FillReason, Status
from meshes import band_missing, dented_sphere, in_pieces, off_sphere, sphere, without


def turned(vertices, faces):
    """The lower part turned around."""
    lower = vertices[faces[:, 0], 2] < 0
    return vertices, np.where(lower[:, None], faces[:, ::-1], faces)


def check_whole_sphere(filled, bar=1e-8):
    """Closed, of genus 0, every vertex on the unit sphere."""
    assert fairmesh.boundary_loops(filled.vertices, filled.faces) == []
    assert len(filled.vertices) - len(filled.faces) // 2 == 2
    assert filled.new_vertex_count > 100
    assert off_sphere(filled.vertices.astype(float)) < bar


@pytest.mark.parametrize("dtype", [np.float64, np.float32])
def test_a_sphere_without_a_band_is_joined(dtype):
    vertices, faces = band_missing()
    vertices = vertices.astype(dtype)
    bar = 1e-8 if dtype == np.float64 else 1e-6
    for join in ([[0, 1]], ((1, 0),), np.array([[0, 1]]), "auto"):
        filled = fairmesh.fill_holes(vertices, faces, join=join)
        check_whole_sphere(filled, bar)
        assert filled.outcomes == ["faired"]
        (loop,) = filled.loops
        assert loop.loop_index == 0 and loop.loop_indices.tolist() == [0, 1] and loop.reason_elements == ()
        assert "loops 0, 1" in repr(loop) and (loop.joined is None) == (not isinstance(join, str))
    (found,) = fairmesh.suggest_joins(vertices, faces)
    assert found.loops.tolist() == [0, 1] and found.reason == loop.joined
    assert found.reason.joint_bend < 0.9 * found.reason.separate_bend
    assert found.reason.kind == "gap"


def test_a_noisy_boundary_is_relaxed():
    vertices, faces = band_missing()
    # Of one kept half the noise is in the mesh, too.
    noisy = vertices * (1 + 0.01 * np.random.default_rng(4).standard_normal(len(vertices)))[:, None]
    plain = fairmesh.fill_holes(noisy, faces, join="auto")
    assert plain.loops[0].moved is None and np.array_equal(plain.vertices[: len(noisy)], noisy)
    relaxed = fairmesh.fill_holes(noisy, faces, join="auto", relax_rim=3, relax_within=0.03)
    (loop,) = relaxed.loops
    assert loop.outcome == "faired" and loop.normals_reached == 1.0
    moved = np.linalg.norm(relaxed.vertices[: len(noisy)] - noisy, axis=1)
    assert loop.moved.count == np.count_nonzero(moved) and 0 < moved.max() <= 0.03 * (1 + 1e-9)
    assert math.isclose(loop.moved.largest, moved.max()) and loop.moved.unsound == 0
    new = slice(len(noisy), None)
    rms = [np.sqrt(np.mean((np.linalg.norm(f.vertices[new], axis=1) - 1) ** 2)) for f in (plain, relaxed)]
    assert rms[1] < rms[0]
    with pytest.raises(fairmesh.InputError, match="relax_within") as caught:
        fairmesh.fill_holes(noisy, faces, relax_rim=1, relax_within=-1.0)
    assert caught.value.status is Status.BAD_OPTION


def test_a_sphere_in_four_pieces_is_joined():
    vertices, faces = in_pieces()
    of = fairmesh.components(vertices, faces)
    assert of.shape == (len(faces),) and np.unique(of).tolist() == [0, 1, 2, 3]
    loops = fairmesh.boundary_loops(vertices, faces)
    assert sorted(loop.component for loop in loops) == [0, 1, 2, 3]
    for loop in loops:
        assert set(of[np.isin(faces, loop.vertices).any(axis=1)]) == {loop.component}
    check_whole_sphere(fairmesh.fill_holes(vertices, faces, join=[range(4)]))
    check_whole_sphere(fairmesh.fill_holes(vertices, faces, join="auto"))


def test_a_part_that_is_turned_around_is_refused_with_both_loops():
    mesh = turned(*band_missing())
    (loop,) = fairmesh.fill_holes(*mesh, join=[[0, 1]]).loops
    assert (loop.outcome, loop.reason) == ("left_open", FillReason.OPPOSITE_SIDES)
    assert loop.reason_elements == (0, 1) and loop.reason.remedy and loop.faces == slice(len(mesh[1]), len(mesh[1]))


def test_groups_bring_no_other_loops_unless_they_are_asked_for():
    vertices, faces = band_missing()
    top = np.linalg.norm(vertices - [0, 0, 1], axis=1) < 0.3
    vertices, faces = without(vertices, faces, top[faces].any(axis=1))
    loops = fairmesh.boundary_loops(vertices, faces)
    assert len(loops) == 3
    hole = min(range(3), key=lambda index: loops[index].length)
    groups = [[index for index in range(3) if index != hole]]
    indices = [loop.loop_indices.tolist() for loop in fairmesh.fill_holes(vertices, faces, join=groups).loops]
    assert indices == groups
    for also in ("all", [hole]):
        check_whole_sphere(fairmesh.fill_holes(vertices, faces, join=groups, loops=also))
    assert fairmesh.fill_holes(vertices, faces, join=groups, loops=[]).new_vertex_count > 0
    assert fairmesh.fill_holes(vertices, faces, join="none", loops="all", fair=False).outcomes == ["flat"] * 3


def test_holes_are_chosen_by_what_they_are_and_where():
    vertices, faces = sphere(4)
    near = [np.linalg.norm(vertices - at, axis=1) < r for at, r in (([0, 0, 1], 0.3), ([0, 0, -1], 0.5))]
    vertices, faces = without(vertices, faces, np.logical_or(*near)[faces].any(axis=1))
    loops = fairmesh.boundary_loops(vertices, faces)
    small = int(vertices[loops[1].vertices[0], 2] > 0)
    one = loops[small]

    def filled(**which):
        told = fairmesh.fill_holes(vertices, faces, fair=False, **which).loops
        reasons = {loop.reason for loop in told if loop.outcome == "left_open"}
        assert reasons <= {FillReason.NOT_ASKED_FOR, FillReason.TOO_MANY_EDGES}
        return [loop.loop_index for loop in told if loop.outcome != "left_open"]

    assert filled() == [0, 1]
    for which in (
        {"max_edges": len(one.vertices)},
        {"max_length": one.length},
        {"max_area": one.area},
        {"max_diagonal": np.linalg.norm(np.ptp(vertices[one.vertices], axis=0)) * 1.001},
        {"except_longest": 1},
        {"within": ([0, 0, 1], 0.5)},
        {"within": ([-1, -1, 0], [1, 1, 1])},
        {"loops": [small]},
    ):
        assert filled(**which) == [small], which
    assert filled(max_length=0.0) == filled(max_length=one.length, within=([0, 0, -1], 1)) == []
    assert filled(of_components=[0]) == [0, 1] and filled(of_components=[1]) == []
    assert fairmesh.suggest_joins(vertices, faces, within=([0, 0, 1], 0.5)) == []


def test_what_becomes_of_a_hole_without_a_fair_patch():
    vertices, faces = band_missing()
    for on_failure, outcome in (("linear", "linear"), ("flat", "flat"), ("open", "left_open")):
        filled = fairmesh.fill_holes(vertices, faces, join="auto", max_iterations=1, on_failure=on_failure)
        assert filled.outcomes == [outcome]
    assert filled.loops[0].reason is FillReason.NOT_FAIR and filled.new_face_count == 0


def test_a_dent_is_erased_and_filled():
    vertices, faces, free, _ = dented_sphere()
    dent = free[faces].any(axis=1)
    for erased in (dent, np.flatnonzero(dent)):
        left = fairmesh.erase(vertices, faces, erased)
        assert left.faces.dtype == faces.dtype and np.array_equal(left.faces, faces[left.kept_faces])
        assert len(left.faces) + left.dropped_count + dent.sum() == len(faces) and not dent[left.kept_faces].any()
        filled = fairmesh.fill_holes(vertices, left.faces, loops=left.loops)
        assert filled.outcomes == ["faired"]
        assert off_sphere(filled.vertices[filled.new_vertices]) < 2e-4
        assert len(fairmesh.boundary_loops(filled.vertices, filled.faces)) == 1


def band_chains(vertices, faces, count=3):
    """Some vertices of both loops, beside each other."""
    upper, lower = sorted(fairmesh.boundary_loops(vertices, faces), key=lambda loop: -vertices[loop.vertices[0], 2])

    def chain(loop):
        middle = np.argmax(vertices[loop.vertices, 0])
        return np.roll(loop.vertices, count // 2 - middle)[:count]

    return chain(upper), chain(lower)


def test_a_bridge_and_the_rest_of_the_band():
    vertices, faces = band_missing()
    start, end = band_chains(vertices, faces)
    strip = fairmesh.bridge(vertices, faces, start, end)
    assert strip.strip.outcome == "faired" and strip.is_clean and strip.whole is None and strip.rest == []
    assert set(strip.chains[0]) == set(start) and set(strip.chains[1]) == set(end) and abs(strip.twist) < 10
    assert all(len(side) for side in strip.sides) and len(fairmesh.boundary_loops(strip.vertices, strip.faces)) == 1
    assert off_sphere(strip.vertices) < 0.02
    whole = fairmesh.bridge(vertices, faces, start, end[::-1], fill=True)
    assert whole.is_clean and whole.whole.outcome.is_success and len(whole.rest) == 1
    check_whole_sphere(whole)
    for given, status in (({"start": [0, 1]}, Status.BAD_CHAIN), ({"width": -1.0}, Status.BAD_OPTION)):
        with pytest.raises(fairmesh.InputError) as error:
            fairmesh.bridge(vertices, faces, **{"start": start, "end": end, **given})
        assert error.value.status is status
    (loop,) = [fairmesh.bridge(*turned(vertices, faces), start, end).strip]
    assert loop.reason is FillReason.OPPOSITE_SIDES


def test_guides():
    vertices, faces = band_missing()
    start, end = band_chains(vertices, faces)
    check_whole_sphere(fairmesh.fill_holes(vertices, faces, join="auto", guides=[(start[1], end[1])]))
    edges = fairmesh.fill_holes(vertices, faces, join="auto", guides=[(start[1], end[1])], max_new_vertices=0).faces
    assert any({start[1], end[1]} <= set(face) for face in edges.tolist())
    with pytest.raises(fairmesh.InputError) as error:
        fairmesh.fill_holes(vertices, faces, join="auto", guides=[(start[1], start[1])])
    assert error.value.status is Status.BAD_GUIDE
    with pytest.raises(ValueError, match=r"guides: the shape has to be \(k, 2\), not \(3,\)"):
        fairmesh.fill_holes(vertices, faces, guides=[1, 2, 3])


def test_wrong_choices_are_named():
    mesh = band_missing(level=3)
    for message, given in {
        "join: 'all' is neither 'none' nor 'auto' nor groups of loops": {"join": "all"},
        "join: groups of loops are needed, such as [[0, 1], [2, 5]]": {"join": [0, 1]},
        "loops: 'none' is neither 'all' nor a list of loops": {"loops": "none"},
        "on_failure: 'closed' is none of 'linear', 'flat', 'open'": {"on_failure": "closed"},
        "within: a ball (centre, radius) or a box (low, high) is needed": {"within": 3},
        "within: 2 numbers, but 3 are needed": {"within": ([0, 0], 1)},
        "of_components: no component is named; None takes all holes": {"of_components": []},
    }.items():
        with pytest.raises(ValueError) as error:
            fairmesh.fill_holes(*mesh, **given)
        assert str(error.value) == message
    for argument, given in {
        "join": {"join": [[0, 1], [1]]},
        "max_length": {"max_length": -1.0},
        "max_diagonal": {"max_diagonal": math.nan},
        "within": {"within": ([0, 0, math.nan], 1.0)},
    }.items():
        with pytest.raises(fairmesh.InputError) as error:
            fairmesh.fill_holes(*mesh, **given)
        assert (error.value.status, error.value.argument) == (Status.BAD_OPTION, argument)
    for given in ({"join": [[0, 2]]}, {"loops": [2]}):
        with pytest.raises(fairmesh.InputError) as error:
            fairmesh.fill_holes(*mesh, **given)
        assert (error.value.status, error.value.element_kind) == (Status.SELECTION_OUT_OF_RANGE, ElementKind.LOOP)
        assert error.value.element == 2
    count = len(mesh[1])
    with pytest.raises(fairmesh.InputError) as error:
        fairmesh.erase(*mesh, [count])
    assert (error.value.element_kind, error.value.element) == (ElementKind.TRIANGLE, count)
    with pytest.raises(TypeError, match="unknown option 'edges'"):
        fairmesh.suggest_joins(*mesh, edges=3)
