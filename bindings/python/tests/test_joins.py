"""Several loops with one patch, bridges, which loops, erased faces, components: on spheres, which have one answer."""

import math

import numpy as np
import pytest

import fairmesh
from fairmesh import ElementKind, FillReason, Status
from meshes import band_missing, in_pieces, off_sphere, without


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


def test_what_a_relaxed_rim_tells():
    vertices, faces = band_missing()
    noisy = vertices * (1 + 0.01 * np.random.default_rng(4).standard_normal(len(vertices)))[:, None]
    assert fairmesh.fill_holes(noisy, faces, join="auto").loops[0].moved is None
    relaxed = fairmesh.fill_holes(noisy, faces, join="auto", relax_rim=3, relax_within=0.03)
    (loop,) = relaxed.loops
    moved = np.linalg.norm(relaxed.vertices[: len(noisy)] - noisy, axis=1)
    assert loop.moved.count == np.count_nonzero(moved) and loop.normals_reached == 1.0
    assert math.isclose(loop.moved.largest, moved.max()) and loop.moved.unsound == 0


def test_components():
    vertices, faces = in_pieces()
    of = fairmesh.components(vertices, faces)
    assert of.shape == (len(faces),) and np.unique(of).tolist() == [0, 1, 2, 3]
    for loop in fairmesh.boundary_loops(vertices, faces):
        assert set(of[np.isin(faces, loop.vertices).any(axis=1)]) == {loop.component}
    check_whole_sphere(fairmesh.fill_holes(vertices, faces, join=[range(4)]))


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
    hole = min(range(3), key=lambda index: loops[index].length)
    groups = [[index for index in range(3) if index != hole]]
    filled = fairmesh.fill_holes(vertices, faces, join=groups)
    assert [loop.loop_indices.tolist() for loop in filled.loops] == groups
    for also in ("all", [hole]):
        assert len(fairmesh.fill_holes(vertices, faces, join=groups, loops=also, fair=False).loops) == 2
    assert fairmesh.fill_holes(vertices, faces, join=groups, loops=[], fair=False).new_vertex_count > 0
    assert fairmesh.suggest_joins(vertices, faces, within=([0, 0, 1], 0.5)) == []


def band_chains(vertices, faces, count=3):
    """Some vertices of both loops, beside each other."""
    upper, lower = sorted(fairmesh.boundary_loops(vertices, faces), key=lambda loop: -vertices[loop.vertices[0], 2])

    def chain(loop):
        middle = np.argmax(vertices[loop.vertices, 0])
        return np.roll(loop.vertices, count // 2 - middle)[:count]

    return chain(upper), chain(lower)


def test_bridges_and_guides():
    vertices, faces = band_missing()
    start, end = band_chains(vertices, faces)
    strip = fairmesh.bridge(vertices, faces, start, end)
    assert strip.is_success and strip.whole is None and strip.rest == [] and abs(strip.twist) < 10
    assert fairmesh.bridge(vertices, faces, start, end[::-1], fill=True).whole.outcome.is_success
    for given, status in (({"start": [0, 1]}, Status.BAD_CHAIN), ({"width": -1.0}, Status.BAD_OPTION)):
        with pytest.raises(fairmesh.InputError) as error:
            fairmesh.bridge(vertices, faces, **{"start": start, "end": end, **given})
        assert error.value.status is status
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
        "loops: no loop is named; None fills all holes": {"loops": []},
        "on_failure: 'closed' is none of 'best', 'flat', 'open'": {"on_failure": "closed"},
        "within: a ball (centre, radius) or a box (low, high) is needed": {"within": 3},
        "within: 2 numbers, but 3 are needed": {"within": ([0, 0], 1)},
        "of_components: no component is named; None takes all holes": {"of_components": []},
    }.items():
        with pytest.raises(ValueError) as error:
            fairmesh.fill_holes(*mesh, **given)
        assert str(error.value) == message
    count = len(mesh[1])
    with pytest.raises(fairmesh.InputError) as error:
        fairmesh.erase(*mesh, [count])
    assert (error.value.element_kind, error.value.element) == (ElementKind.TRIANGLE, count)
    with pytest.raises(TypeError, match="unknown option 'edges'"):
        fairmesh.suggest_joins(*mesh, edges=3)
