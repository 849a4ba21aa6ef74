"""The checker finds each planted defect beside a forged report, and nothing on a true result."""

from __future__ import annotations

import os
import random
import sys
from pathlib import Path

import numpy as np
import pytest

from cases import Place, fair, fill, together
from checker import clean, closed, filled_kinks, judge_fair, judge_fill, kinks_before, tells_intersections
from formats import FORMATS, UnreadableError, ending, read, write
from generated import hub, slot, sphere
from geometry import irregular_vertices, smallest_angles, without_islands
from intersections import crossing_pairs, sides
from meshes import Surroundings
from mutations import mutate, pristine, still_there
from runner import Runner

FORM = "ply-binary-double"


def cap() -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """A sphere of 2,562 vertices, and the numbers of those that are free: 15 % about the pole."""
    x, triangles = sphere(4)
    return x, triangles, np.flatnonzero(x[:, 2] > 0.7)


def forged(tmp_path: Path, change, form: str = FORM, **report) -> set[str]:
    """The kinds found when the cap has been changed so and is told converged."""
    x, triangles, free = cap()
    before, after = tmp_path / f"in{ending(form)}", tmp_path / f"out{ending(form)}"
    write(before, form, x, triangles)
    file = read(before)
    numbers = np.zeros(len(x), int)
    numbers[triangles.ravel()] = file.triangles().ravel()
    y = x.copy()
    change(y, free)
    write(after, form, y, triangles)
    inside = np.isin(triangles, free).any(1)
    told = {"outcome": "converged", "quality": {"worst_angle": float(smallest_angles(y, triangles[inside]).min())}}
    told["quality"]["normal_deviation"] = 180.0
    told.update(report)
    return {kind for kind, _ in judge_fair(before, after, numbers[free], told, form, True)}


@pytest.mark.parametrize("form", FORMATS)
def test_a_true_result_passes_in_every_format(tmp_path, form):
    def swell(y, free):
        y[free] *= 1 + 0.01 * (y[free, 2:] - 0.7)

    assert forged(tmp_path, swell, form) == set()


@pytest.mark.parametrize("form", FORMATS)
def test_a_fixed_vertex_that_moved_by_one_bit_is_found(tmp_path, form):
    def nudge(y, _free):
        at = int(np.argmin(y[:, 2]))
        y[at, 2] = np.nextafter(y[at, 2].astype(np.float32), np.float32(0))

    assert forged(tmp_path, nudge, form) == {"fixed"}


def test_a_crease_at_the_boundary_is_found(tmp_path):
    def step(y, free):
        y[free, 2] -= 0.5

    assert "kink" in forged(tmp_path, step)


def test_a_fold_is_found(tmp_path):
    def turn(y, free):
        pole = free[np.argmax(y[free, 2])]
        edge = np.sort(np.linalg.norm(y[free] - y[pole], axis=1))[1]
        y[pole] += [2.0 * edge, 0, -0.05 * edge]

    assert "fold" in forged(tmp_path, turn)


def test_a_null_face_and_a_needle_are_found(tmp_path):
    def collapse(part):
        def change(y, free):
            pole = free[np.argmax(y[free, 2])]
            next_to_it = free[np.argsort(np.linalg.norm(y[free] - y[pole], axis=1))[1]]
            y[pole] += part * (y[next_to_it] - y[pole])

        return change

    assert "null" in forged(tmp_path, collapse(1.0))
    assert "needle" in forged(tmp_path, collapse(0.995))


def push_through(y, free):
    """The pole goes through the sphere's other side."""
    pole = free[y[free, 2] > 0.98]
    y[pole] += [0.013, 0.007, -2.1]


def test_an_intersection_is_found_unless_the_report_tells_it(tmp_path):
    assert "intersects" in forged(tmp_path, push_through)
    assert "intersects" not in forged(tmp_path, push_through, intersections={"count": 3})
    assert "intersects" in forged(tmp_path, push_through, intersections={"count": 0, "list": []})


def test_figures_that_differ_from_the_file_are_found(tmp_path):
    quality = {"worst_angle": 44.0, "normal_deviation": 180.0}
    assert forged(tmp_path, lambda *_: None, quality=quality) == {"figures"}
    x, triangles, free = cap()
    right = float(smallest_angles(x, triangles[np.isin(triangles, free).any(1)]).min())
    assert forged(tmp_path, lambda *_: None, quality={"worst_angle": right, "normal_deviation": 0.0}) == {"figures"}


def test_a_coordinate_that_is_no_number_is_found(tmp_path):
    def spoil(y, free):
        y[free[3], 1] = np.nan

    assert forged(tmp_path, spoil) == {"nan"}


def filled(tmp_path: Path, change=None, drop: int = 0, added: int = 0) -> set[str]:
    """The kinds found when the cap has been deleted and put back in this state."""
    x, triangles, free = cap()
    inside = np.isin(triangles, free).any(1)
    own, patch = triangles[~inside], triangles[inside]
    order = np.concatenate([np.setdiff1d(np.arange(len(x)), free), free])
    number = np.argsort(order)
    was = kinks_before(x, patch, own)
    count = len(x) - len(free)
    write(tmp_path / "in.off", "off", x[order[:count]], number[own])
    y = x.copy()
    if change:
        change(y, free)
    write(tmp_path / "out.off", "off", y[order], number[np.concatenate([own, patch])][: len(triangles) - drop])
    edges = 2 * len(np.intersect1d(own, patch)) // 2
    loop = {"index": 0, "edges": edges, "outcome": "faired", "told": "converged", "fairing": {"outcome": "converged"}}
    loop["worst_angle"] = float(smallest_angles(y, patch[: len(patch) - drop]).min())
    loop["faces"], loop["vertices"] = [len(own), len(triangles) - drop], [count, len(x) + added]
    assert clean(loop)
    return {kind for kind, _ in judge_fill(tmp_path / "in.off", tmp_path / "out.off", {"loops": [loop]}, was)}


def test_a_filling_is_judged_alike(tmp_path):
    def lower(y, free):
        y[free, 2] -= 0.5

    def move_fixed(y, _free):
        y[int(np.argmin(y[:, 2]))] *= 1.0000001

    assert filled(tmp_path) == set()
    assert filled(tmp_path, drop=1) == {"open"}
    assert filled(tmp_path, lower) == {"kink"}
    assert filled(tmp_path, push_through) >= {"intersects"}
    assert filled(tmp_path, move_fixed) == {"fixed"}
    assert filled(tmp_path, added=20_000) == {"many"}


def test_a_patch_may_have_its_own_numbers_for_vertices_at_the_same_place():
    x, triangles, free = cap()
    inside = np.isin(triangles, free).any(1)
    own, patch = triangles[~inside], triangles[inside]
    rim = np.intersect1d(own, patch)
    number = np.arange(len(x))
    number[rim] = len(x) + np.arange(len(rim))
    both = np.concatenate([own, number[patch]])
    assert closed(np.concatenate([x, x[rim]]), both, number[patch], {"index": 0}) == []
    assert closed(np.concatenate([x, x[rim] + 1e-3]), both, number[patch], {"index": 0}) != []


def test_a_kink_beside_a_doubled_vertex_is_measured_against_both_its_sides():
    # Two triangles of a roof, 50 degrees steep, each with its own copy of the vertex between them, and a level patch.
    slope = -np.tan(np.radians(50))
    x = np.array(
        [[0, 0, 0], [1, -0.1, slope], [1, 0.1, slope], [-1, 0.1, slope], [-1, -0.1, slope], [-0.1, -1, 0], [0.1, -1, 0]]
    )
    x = np.vstack([x, x[0]])
    own, patch = np.array([[0, 1, 2], [7, 3, 4]]), np.array([[0, 5, 6]])
    assert filled_kinks(x, own, patch, {"index": 0}, None) == []
    x[7] += 1e-3
    assert [kind for kind, _ in filled_kinks(x, own, patch, {"index": 0}, None)] == ["kink"]


def test_exit_0_does_not_stand_beside_an_unfaired_loop():
    told = "not converged: the surface of least bending"
    assert not clean({"outcome": "least_bending", "told": told, "fairing": {"outcome": "not_converged"}})
    assert not clean({"outcome": "flat", "told": "triangulated and refined only: no normal", "fairing": None})
    assert clean({"outcome": "flat", "told": "triangulated; no new vertex was needed", "fairing": None})


def test_reports_of_intersections():
    assert tells_intersections({"quality": {"self_intersections": {"count": 1, "list": [[1, 2]]}}})
    assert tells_intersections({"loops": [{"intersections": [[3, 4]]}]})
    assert not tells_intersections({"quality": {"self_intersections": []}, "outcome": "converged"})
    assert not tells_intersections({"intersections": {"count": 0, "list": [], "in_input": 5}})


def test_sides_are_exact():
    # The fourth point is above the plane x + y + z = 1 by the last bit only.
    third = 1 / 3
    x = np.array([[1, 0, 0], [0, 1, 0], [0, 0, 1], [third, third, 1 - 2 * third], [0.25, 0.25, 0.5]])
    x = np.vstack([x, x[4] + [0, 0, 2.0**-53], x[4] - [0, 0, 2.0**-54]])
    a, b, c = (np.full(3, k) for k in range(3))
    assert sides(x, a, b, c, np.array([4, 5, 6])).tolist() == [0, -1, 1]
    assert sides(x * 1e-150, a, b, c, np.array([4, 5, 6])).tolist()[1] == -1


def test_crossing_pairs_are_found_and_touching_ones_are_not():
    x = np.array([[0, 0, 0], [1, 0, 0], [0, 1, 0], [0.2, 0.2, -1], [0.3, 0.2, 1], [0.2, 0.3, 1]], float)
    triangles = np.array([[0, 1, 2], [3, 4, 5]])
    assert crossing_pairs(x, triangles, np.array([0])).tolist() == [[0, 1]]
    x[3, 2] = 0.5
    assert len(crossing_pairs(x, triangles, np.array([0]))) == 0
    x[3, 2] = 0.0
    assert len(crossing_pairs(x, triangles, np.array([0]))) == 0
    # Two that share a corner and cross elsewhere.
    x = np.array([[0, 0, 0], [1, 0, 0], [0, 1, 0], [0.4, 0.4, -1], [0.4, 0.4, 1]], float)
    assert len(crossing_pairs(x, np.array([[0, 1, 2], [0, 3, 4]]), np.array([0, 1]))) == 1


def test_a_sphere_crosses_nothing_and_two_spheres_cross_as_counted_one_by_one():
    x, triangles = sphere(2)
    assert len(crossing_pairs(x, triangles, np.arange(len(triangles)))) == 0
    both = np.concatenate([x, x + np.array([0.9, 0.13, 0.27])])
    faces = np.concatenate([triangles, triangles + len(x)])
    pairs = crossing_pairs(both, faces, np.arange(len(triangles)))
    assert len(pairs) > 50
    other = crossing_pairs(both, faces, np.arange(len(triangles), len(faces)))
    assert {frozenset(p) for p in pairs.tolist()} == {frozenset(p) for p in other.tolist()}


@pytest.mark.parametrize("form", FORMATS)
def test_files_are_read_as_they_were_written(tmp_path, form):
    x, triangles = sphere(2)
    path = tmp_path / f"x{ending(form)}"
    write(path, form, x, triangles)
    file = read(path)
    wanted = x.astype(np.float32).astype(float) if file.single or "float" in form else x
    assert np.abs(file.points[file.triangles()] - wanted[triangles]).max() <= (1e-7 if "stl" in form else 0)
    data = path.read_bytes()
    if form not in ("obj", "stl-ascii"):
        path.write_bytes(data[: len(data) * 2 // 3])
        with pytest.raises(UnreadableError):
            read(path)


@pytest.mark.parametrize("form", FORMATS)
def test_a_result_that_lost_something_of_a_damaged_file_is_found(tmp_path, form):
    path, _ = pristine(tmp_path, form)
    assert still_there(path, path, False) == []
    file, less = read(path), tmp_path / f"less{ending(form)}"
    write(less, form, file.points, file.triangles()[1:])
    assert [kind for kind, _ in still_there(path, less, True)] == ["misread"]
    write(less, form, file.points + 1.0, file.triangles())
    assert [kind for kind, _ in still_there(path, less, True)] == ["misread"]
    less.write_bytes(b"")
    assert [kind for kind, _ in still_there(less, path, True)] == ["misread"]


def test_mutations_are_the_same_for_the_same_seed():
    data = bytes(range(200))
    assert [mutate(data, random.Random(k)) for k in range(9)] == [mutate(data, random.Random(k)) for k in range(9)]
    assert sum(mutate(data, random.Random(k)) != data for k in range(50)) > 40


def test_regions_are_whole_and_away_from_boundaries():
    x, triangles, free = cap()
    open_sheet = triangles[~np.isin(triangles, free).any(1)]
    region = Surroundings(len(x), open_sheet).grow(random.Random(1), 200)
    assert len(region) >= 200
    assert not np.isin(region, irregular_vertices(open_sheet)).any()
    assert len(irregular_vertices(triangles)) == 0


def test_generated_meshes_have_their_boundaries():
    _, triangles = slot(6, 3, 10.0)
    assert len(irregular_vertices(triangles)) == 2 * 18
    _, triangles, _ = hub(40)
    assert len(irregular_vertices(triangles)) == 40


def script(tmp_path: Path, text: str) -> Place:
    """A place whose program is this shell script."""
    program = tmp_path / "program"
    program.write_text("#!/bin/sh\n" + text)
    program.chmod(0o755)
    return Place(program, tmp_path / "work", Runner(), 0)


@pytest.mark.parametrize(
    ("text", "kind"),
    [
        ("kill -SEGV $$", "crash"),
        ("exit 101", "crash"),
        ('cp "$2" "$4"; exit 2', "refused"),
        ("exit 0", "written"),
        ('cp "$2" "$4"; touch $(dirname "$4")/.fairmesh-1234; exit 3', "written"),
    ],
)
def test_wrong_ends_are_found(tmp_path, text, kind):
    place = script(tmp_path, text)
    x, triangles, free = cap()
    result = fair(place, "fair", "case", x, triangles, free, {"format": FORM})
    assert [k for k, _ in result.findings] == [kind]
    assert "case/in.ply" in result.command


def test_a_hang_is_found(tmp_path, monkeypatch):
    monkeypatch.setattr("cases.FILL_LIMIT", 1)
    place = script(tmp_path, "while :; do :; done")
    x, triangles, _ = cap()
    assert [k for k, _ in fill(place, "fill", "case", x, triangles, FORM, None).findings] == ["hang"]


def test_peak_memory_is_that_of_the_program(tmp_path):
    program = tmp_path / "large.py"
    program.write_text("x = bytearray(200_000_000)")
    python = os.environ.get("PYTHON", "python3")
    ballast = np.ones(40_000_000)
    small, large = (Runner().run([python, *words], 10) for words in (["-c", ""], [program]))
    assert ballast.sum() > 0
    assert small["kilobytes"] < 60_000
    assert large["kilobytes"] > 190_000


@pytest.mark.parametrize("form", FORMATS)
def test_reading_by_arrays_is_reading_word_by_word(tmp_path, form):
    path, _ = pristine(tmp_path, form)
    quick = read(path)
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr("formats.fast", lambda *_: None)
        slow = read(path)
    assert np.array_equal(quick.points, slow.points)
    assert quick.polygons == slow.polygons
    assert (quick.spans, quick.facet_spans, quick.single) == (slow.spans, slow.facet_spans, slow.single)


def test_an_island_is_no_outside():
    x, triangles, free = cap()
    pole = free[np.argmax(x[free, 2])]
    island = triangles[(triangles == pole).any(1)][0]
    touched = np.isin(triangles, np.setdiff1d(free, island)).any(1)
    kept = without_islands(triangles[touched], triangles[~touched])
    assert len(triangles[~touched]) - len(kept) == 1
    assert not np.isin(kept, island).any()
    # A sheet that ends at the region's boundary is no island.
    assert len(without_islands(triangles[touched], kept)) == len(kept)


@pytest.mark.parametrize(("move", "kinds"), [(0.0, []), (1e-9, ["component"])])
def test_a_component_that_depends_on_another_one_is_found(tmp_path, move, kinds):
    x, triangles = sphere(3)
    a, b = (np.flatnonzero(sign * x[:, 2] > 0.9) for sign in (1, -1))
    # Writes what it reads, moved by so much if more vertices are free than of one region.
    program = f"""#!{sys.executable}
import json, struct, sys
data, free = open(sys.argv[2], "rb").read(), open(sys.argv[sys.argv.index("--free") + 1]).read().split()
at = data.index(b"end_header") + 11
if len(free) > {len(a)}:
    at += 24 * int(free[0])
    data = data[:at] + struct.pack("<d", struct.unpack_from("<d", data, at)[0] + {move}) + data[at + 8 :]
open(sys.argv[4], "wb").write(data)
report = {{"outcome": "not_converged", "quality": {{"worst_angle": {{ANGLE}}, "normal_deviation": 180}}}}
json.dump(report, open(sys.argv[sys.argv.index("--json") + 1], "w"))
sys.exit(3)
"""
    angle = min(smallest_angles(x, triangles[np.isin(triangles, r).any(1)]).min() for r in (a, b))
    place = script(tmp_path, "")
    place.program.write_text(program.replace("{ANGLE}", repr(float(angle))))
    assert [kind for run in together(place, "case", x, triangles, a, b, "auto") for kind, _ in run.findings] == kinds
    assert (place.folder / "case_both").exists() == bool(kinds)
