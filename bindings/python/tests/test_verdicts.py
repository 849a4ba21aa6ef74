"""The command line, the C library and this package say the same of a hundred meshes, good and bad."""

from __future__ import annotations

import ctypes
import json
import os
import subprocess
from concurrent.futures import ThreadPoolExecutor

import numpy as np
import pytest

import fairmesh
from fairmesh import _abi

#: As the program ends: all that was asked for was done; refused; written, but no success.
DONE, REFUSED, IMPERFECT = 0, 2, 3
SEEDS = range(5)


def ball(seed, rows=10, columns=16):
    """The closed unit sphere, turned by chance."""
    i, j = np.meshgrid(np.arange(1, rows), np.arange(columns), indexing="ij")
    angle, around = np.pi * i / rows, 2 * np.pi * j / columns
    places = np.stack([np.sin(angle) * np.cos(around), np.sin(angle) * np.sin(around), np.cos(angle)], axis=-1)
    vertices = np.concatenate([[[0, 0, 1]], places.reshape(-1, 3), [[0, 0, -1]]])
    at = 1 + (i - 1) * columns + j
    right = np.roll(at, -1, axis=1)
    faces = [
        np.stack([0 * at[0], at[0], right[0]], axis=-1),
        np.stack([at[-1], 0 * at[0] + at.max() + 1, right[-1]], axis=-1),
    ]
    for corners in ((at[:-1], at[1:], right[1:]), (at[:-1], right[1:], right[:-1])):
        faces.append(np.stack(corners, axis=-1).reshape(-1, 3))
    turn, _ = np.linalg.qr(np.random.RandomState(seed).normal(size=(3, 3)))
    if np.linalg.det(turn) < 0:
        turn[:, 0] *= -1
    return vertices @ turn, np.concatenate(faces)


def without(mesh, gone):
    vertices, faces = mesh
    return vertices, faces[~gone]


def holed(seed, least=0.75):
    """The sphere without what is near its first axis."""
    vertices, faces = ball(seed, 14, 24)
    return without((vertices, faces), vertices[faces].mean(axis=1)[:, 0] > least)


def two_holes(seed):
    vertices, faces = holed(seed)
    return without((vertices, faces), vertices[faces].mean(axis=1)[:, 0] < -0.8)


def noisy(seed):
    """Everything of the holed sphere is off by up to half an edge."""
    vertices, faces = holed(seed)
    return vertices + np.random.RandomState(seed).uniform(-0.1, 0.1, vertices.shape), faces


def sheet(seed, side=9):
    i, j = np.meshgrid(np.arange(side), np.arange(side), indexing="ij")
    height = 0.05 * np.random.RandomState(seed).normal(size=i.shape)
    at = i * side + j
    a, b, c, d = at[:-1, :-1], at[1:, :-1], at[1:, 1:], at[:-1, 1:]
    faces = [np.stack(corners, axis=-1).reshape(-1, 3) for corners in ((a, b, c), (a, c, d))]
    return np.stack([i, j, height], axis=-1).reshape(-1, 3).astype(float), np.concatenate(faces)


def sheet_with_hole(seed):
    vertices, faces = sheet(seed)
    middle = vertices[faces].mean(axis=1)[:, :2]
    return without((vertices, faces), np.abs(middle - 4).max(axis=1) < 1.5)


def island(seed):
    """A sheet with a hole and a part of itself in that."""
    vertices, faces = sheet(seed, 15)
    far = np.abs(vertices[faces].mean(axis=1)[:, :2] - 7).max(axis=1)
    return without((vertices, faces), (far > 1.5) & (far < 4.5))


def cube(seed, side=8):
    """A cube without what is near a place on an edge: a crease runs into the hole."""
    line = np.arange(side + 1) / side
    places, faces = [], []
    for axis in range(3):
        for end in (0, 1):
            u, v = np.meshgrid(line, line, indexing="ij")
            corners = np.zeros((side + 1, side + 1, 3))
            corners[..., axis], corners[..., (axis + 1) % 3], corners[..., (axis + 2) % 3] = end, u, v
            at = sum(map(len, places)) + np.arange((side + 1) ** 2).reshape(side + 1, side + 1)
            places.append(corners.reshape(-1, 3))
            a, b, c, d = at[:-1, :-1], at[1:, :-1], at[1:, 1:], at[:-1, 1:]
            for tri in ((a, b, c), (a, c, d)):
                tri = np.stack(tri, axis=-1).reshape(-1, 3)
                faces.append(tri if end else tri[:, ::-1])
    vertices, number = np.unique(np.round(np.concatenate(places), 9), axis=0, return_inverse=True)
    faces = number.reshape(-1)[np.concatenate(faces)]
    middle = vertices[faces].mean(axis=1)
    return without((vertices, faces), np.linalg.norm(middle - [1, 1, 0.3 + 0.1 * seed], axis=1) < 0.25)


def no_area(seed):
    """A sheet with a slit whose patch has no area."""
    vertices = np.array([[-2, -1], [2, -1], [2, 1], [-2, 1], [-1, 0], [0, 0], [1, 0]], float) * (1 + seed)
    faces = np.array([[0, 4, 3], [3, 4, 5], [3, 5, 2], [5, 6, 2], [1, 2, 6], [0, 1, 6], [0, 6, 4]])
    return np.column_stack([vertices, 0 * vertices[:, 0]]), faces


def flat_face(seed):
    """A triangle of the holed sphere names a vertex twice."""
    vertices, faces = holed(seed)
    faces = faces.copy()
    faces[seed * 7, 2] = faces[seed * 7, 1]
    return vertices, faces


def not_finite(seed):
    """A vertex of the rim, or inside, is no number."""
    vertices, faces = holed(seed)
    used = np.unique(faces)
    vertices = vertices.copy()
    vertices[used[np.argsort(vertices[used, 0])[-1 - 40 * (seed % 2)]]] = np.nan if seed % 3 else np.inf
    return vertices, faces


def fin(seed):
    """A third triangle at an edge: of the rim, or away from it."""
    vertices, faces = holed(seed)
    face = faces[np.argsort(vertices[faces].mean(axis=1)[:, 0])[-1 if seed % 2 else len(faces) // 2]]
    return np.concatenate([vertices, [2.0 * vertices[face[0]]]]), np.concatenate(
        [faces, [[face[0], face[1], len(vertices)]]]
    )


def bow_tie(seed):
    """A triangle hangs at a vertex: of a closed mesh, or of the rim of one."""
    vertices, faces = holed(seed) if seed % 2 else ball(seed)
    at = faces[0, 0] if seed % 2 == 0 else faces[np.argmax(vertices[faces].mean(axis=1)[:, 0]), 0]
    more = 1.3 * vertices[at] + 0.2 * np.eye(3)[:2]
    return np.concatenate([vertices, more]), np.concatenate([faces, [[at, len(vertices), len(vertices) + 1]]])


def half_turned(seed):
    vertices, faces = holed(seed)
    faces = faces.copy()
    some = np.random.RandomState(seed).uniform(size=len(faces)) < 0.1 + 0.2 * seed
    faces[some] = faces[some][:, ::-1]
    return vertices, faces


def two_parts(seed):
    (a, f), (b, g) = holed(seed), (holed(seed + 9) if seed % 2 else cube(seed))
    return np.concatenate([a, b + 5]), np.concatenate([f, g + len(a)])


def soup(seed):
    """Each triangle has corners of its own; from the second seed on they agree but for their last digits."""
    vertices, faces = holed(seed)
    corners = vertices[faces].reshape(-1, 3)
    jitter = [0, 1e-12, 1e-9, 1e-7, 1e-4][seed]
    corners = corners + jitter * np.random.RandomState(seed).uniform(-1, 1, corners.shape)
    return corners, np.arange(len(corners)).reshape(-1, 3)


def twice(seed):
    """Some triangles are there twice."""
    vertices, faces = holed(seed)
    return vertices, np.concatenate([faces, faces[seed : seed + 3]])


def large(seed):
    """More of the sphere is gone than is left."""
    return holed(seed, -0.1 - 0.15 * seed)


def scaled(seed):
    """Far away, huge or tiny."""
    vertices, faces = holed(seed)
    return vertices * 10.0 ** (9 * seed - 18) + (1e4 if seed == 2 else 0), faces


SHAPES = [
    ball, holed, two_holes, noisy, sheet, sheet_with_hole, island, cube, no_area, flat_face, not_finite, fin, bow_tie,
    half_turned, two_parts, soup, twice, large, scaled,
]  # fmt: skip
MESHES = [(shape, seed) for shape in SHAPES for seed in SEEDS]
#: Text that is no mesh: refused, with nothing written.
BROKEN = [
    "",
    "OFF\n3 1 0\n0 0 0\n1 0 0\n",
    "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 7\n",
    "OFF\n3 0 0\n0 0 0\n1 0 0\n0 1 0\n",
    "OFF\n3 1 0\n0 0 zero\n1 0 0\n0 1 0\n3 0 1 2\n",
]


def off(vertices, faces):
    rows = [f"OFF\n{len(vertices)} {len(faces)} 0"]
    rows += [" ".join(map(repr, map(float, p))) for p in vertices]
    rows += [f"3 {a} {b} {c}" for a, b, c in faces]
    return "\n".join(rows) + "\n"


def program(folder, *arguments):
    """The exit code, and the report if there is one."""
    done = subprocess.run(
        [os.environ["FAIRMESH_TEST_PROGRAM"], *arguments, "-q", "--threads", "1", "--json", "report.json"],
        cwd=folder,
        capture_output=True,
        text=True,
        check=False,
    )
    path = folder / "report.json"
    report = json.loads(path.read_text()) if path.exists() else None
    assert (done.returncode == REFUSED) == (report is None), done.stderr
    return done.returncode, report


def package(call, verdict):
    """The exit code that the program would have, and the result; the C library itself has to say the same."""
    try:
        made = call()
    except fairmesh.FairmeshError:
        return REFUSED, None
    assert bool(made._handle.info().is_success) == verdict(made)
    return DONE if verdict(made) else IMPERFECT, made


def in_c(loop_handle, index):
    """A loop's report as C has it."""
    struct = _abi.fairmesh_fill_report(struct_size=ctypes.sizeof(_abi.fairmesh_fill_report))
    loop_handle.read("fairmesh_result_fill_report", index, struct)
    return struct


def check_fill(folder, vertices, faces):
    code, report = program(folder, "fill", "in.off", "-o", "out.off")
    same, filled = package(lambda: fairmesh.fill_holes(vertices, faces, threads=1), lambda filled: filled.is_success)
    assert code == same
    if filled is None:
        return code
    assert report["success"] == filled.is_success
    assert len(report["loops"]) == len(filled.loops)
    for index, (told, loop) in enumerate(zip(report["loops"], filled.loops)):
        struct = in_c(filled._handle, index)
        assert told["success"] == loop.is_success == bool(struct.is_success)
        assert told["outcome"] == loop.outcome.value
        fairing = told["fairing"]
        assert (fairing is None) == (loop.report is None)
        if fairing:
            assert fairing["outcome"] == loop.report.outcome.value
    # What is no success stays open if it shall.
    kept = fairmesh.fill_holes(vertices, faces, threads=1, on_failure="open")
    assert all(loop.is_success or loop.outcome is fairmesh.FillOutcome.LEFT_OPEN for loop in kept.loops)
    return code


def check_fair(folder, vertices, faces):
    """Of the faces around the middle one of the list."""
    middles = vertices[faces].mean(axis=1)
    ids = np.sort(np.argsort(np.linalg.norm(middles - middles[len(faces) // 2], axis=1))[:40])
    (folder / "faces.txt").write_text("\n".join(map(str, ids)) + "\n")
    (folder / "report.json").unlink(missing_ok=True)
    code, report = program(folder, "fair", "in.off", "--faces", "faces.txt", "-o", "out.off")
    same, result = package(
        lambda: fairmesh.fair(vertices, faces, free_faces=ids, threads=1),
        lambda result: result.report.outcome is fairmesh.Outcome.CONVERGED,
    )
    assert code == same
    if result is not None:
        assert report["outcome"] == result.report.outcome.value
    return code


def check(folder, shape, seed):
    vertices, faces = shape(seed)
    folder.mkdir()
    (folder / "in.off").write_text(off(vertices, faces))
    return check_fill(folder, vertices, faces), check_fair(folder, vertices, faces)


def test_all_hosts_agree_on_a_hundred_files(tmp_path):
    assert len(MESHES) + len(BROKEN) == 100
    with ThreadPoolExecutor() as pool:
        jobs = {
            (shape.__name__, seed): pool.submit(check, tmp_path / f"{shape.__name__}_{seed}", shape, seed)
            for shape, seed in MESHES
        }
    wrong = {name: job.exception() for name, job in jobs.items() if job.exception()}
    assert not wrong, "\n".join(f"{name}: {why}" for name, why in wrong.items())
    codes = {name: job.result() for name, job in jobs.items()}
    # Not all of one kind.
    for which in (0, 1):
        ends = [code[which] for code in codes.values()]
        assert min(ends.count(DONE), ends.count(IMPERFECT if which == 0 else REFUSED)) > 15, codes
    assert {codes["holed", seed][0] for seed in SEEDS} == {DONE}
    assert {codes[name, seed][0] for seed in SEEDS for name in ("sheet", "no_area", "noisy")} == {IMPERFECT}
    assert IMPERFECT in {codes["cube", seed][0] for seed in SEEDS}


@pytest.mark.parametrize("text", BROKEN)
def test_what_is_no_mesh_is_refused(tmp_path, text):
    (tmp_path / "in.off").write_text(text)
    assert program(tmp_path, "fill", "in.off", "-o", "out.off")[0] == REFUSED
    assert not (tmp_path / "out.off").exists()
