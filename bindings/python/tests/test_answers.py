"""The library's answers (tests/answers.json) come through: each option arrives, and all that is found comes back."""

import json
from pathlib import Path

import numpy as np
import pytest

import fairmesh
from fairmesh import ElementKind, Status

FILE = json.loads((Path(__file__).resolve().parents[3] / "tests" / "answers.json").read_text())
CASES = [pytest.param(case, id=case["name"]) for case in FILE["cases"] if "answer" in case]
ERRORS = [pytest.param(case, id=case["name"]) for case in FILE["cases"] if "error" in case]
#: Single precision anywhere on the way would show.
NEAR = 1e-8


def call(case, dtype=np.float64):
    mesh = FILE["meshes"][case["mesh"]]
    options = dict(case["options"])
    for name, (indices, numbers) in {
        "boundary_normals": ("vertices", "vectors"),
        "boundary_curvature": ("vertices", "values"),
    }.items():
        if isinstance(options.get(name), dict):
            options[name] = (options[name][indices], options[name][numbers])
    if "loop_continuity" in options:
        options["loop_continuity"] = dict(options["loop_continuity"])
    if options.get("target") == "inf":
        options["target"] = np.inf
    if case["call"] in ("fair", "remesh", "refill"):
        options.setdefault("free", mesh["free"])
    faces = options.pop("faces", mesh["faces"])
    return getattr(fairmesh, case["call"])(np.array(mesh["vertices"], dtype), np.array(faces), **options)


def same(found, expected):
    np.testing.assert_allclose(found, expected, rtol=NEAR, atol=NEAR)


def check_samples(found, expected):
    for at, value in expected:
        same(found[at], value)


def check_loop(loop, expected):
    found = {
        "loop_indices": loop.loop_indices.tolist(),
        "edge_count": loop.edge_count,
        "outcome": loop.outcome,
        "reason": loop.reason,
        "vertices": [loop.vertices.start, loop.vertices.stop],
        "faces": [loop.faces.start, loop.faces.stop],
    }
    assert found == expected


def check_faired(result, expected):
    for name, value in expected["report"].items():
        found = getattr(result.report, name)
        assert found == value if isinstance(value, str | bool | int) else not same(found, value), name
    assert result.outcome == expected["report"]["outcome"]
    check_samples(result.mean_curvature, expected["mean_curvature"])
    check_samples(result.gaussian_curvature, expected["gaussian_curvature"])
    normals = dict(zip(result.boundary_vertices.tolist(), result.boundary_normals, strict=True))
    check_samples(normals, expected["boundary_normals"])
    loops = result.report.components[0].continuity
    assert len(loops) == len(expected["continuity"])
    for loop, told in zip(loops, expected["continuity"], strict=True):
        same([getattr(loop, name) for name in told], list(told.values()))


def check_bridge(result, expected):
    assert [sorted(chain.tolist()) for chain in result.chains] == expected["chains"]
    assert [len(side) for side in result.sides] == expected["sides"]
    assert len(result.rest) == expected["rest"]
    assert (result.whole and result.whole.outcome) == expected["whole"]
    check_loop(result.strip, expected["strip"])


@pytest.mark.parametrize("case", CASES)
def test_answers(case):
    result, expected = call(case), case["answer"]
    if isinstance(result, np.ndarray):
        assert np.flatnonzero(result).tolist() == expected["faces"]
        return
    vertices = getattr(result, "vertices", None)
    check_samples(vertices, expected.get("positions", []))
    for name in ("dropped_count", "loops"):
        if case["call"] == "erase":
            assert getattr(result, name) == expected[name]
    for name in ("kept_vertices", "kept_faces", "free_vertices"):
        if name in expected:
            assert len(getattr(result, name)) == expected[name]
    if "face_count" in expected:
        assert len(result.faces) == expected["face_count"]
    if "vertex_count" in expected:
        assert len(vertices) == expected["vertex_count"]
    if case["call"] == "fair":
        check_faired(result, expected)
    if case["call"] == "bridge":
        check_bridge(result, expected)
    if case["call"] == "fill_holes":
        for loop, told in zip(result.loops, expected["loops"], strict=True):
            check_loop(loop, told)
        step = max(1, len(result.parents) // 3)
        for parents, weights, told in zip(
            result.parents[::step], result.parent_weights[::step], expected["parents"], strict=True
        ):
            assert parents.tolist() == told[0]
            same(weights, told[1])


@pytest.mark.parametrize("case", ERRORS)
def test_errors(case):
    with pytest.raises(fairmesh.InputError) as error:
        call(case)
    why, told = error.value, case["error"]
    assert (why.status.name.lower(), why.element_kind.name.lower()) == (told["status"], told["element_kind"])
    assert str(why) == why.message == told["message"]
    if why.element_kind is ElementKind.ARGUMENT:
        assert why.status is Status.BAD_OPTION and why.argument == case["name"]
