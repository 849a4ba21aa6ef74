"""Judges what the program wrote, from the files alone: each finding is (kind, text)."""

from __future__ import annotations

import json
from pathlib import Path

import numpy as np

from formats import File, UnreadableError, read, without
from geometry import (
    angle_between,
    cross_products,
    folds,
    half_edges,
    kinks,
    smallest_angles,
    without_islands,
)
from intersections import crossing, crossing_pairs

Findings = list[tuple[str, str]]

# A kink at the boundary beyond this many degrees, and this many more than the input's there, is no fair surface.
KINK, KINK_MORE = 45.0, 15.0
# Two triangles that meet at more than this angle are folded.
FOLD = 150.0
# A success has no angle below this; and one below the second is that of a null face.
NEEDLE, NULL = 1.0, 1e-4
# Between reported and recomputed angles, in degrees and relative.
ANGLE_ERROR = 2e-3
# So many times the vertices that fill the patch with triangles as large as those around it.
TOO_MANY = 20


def success(report: dict) -> bool:
    return report["outcome"] == "converged"


def tells_intersections(report: object) -> bool:
    """Whether a report says anywhere that the surface intersects itself or the rest."""
    if isinstance(report, dict):
        return any(
            ("intersect" in key and says_something(value)) or tells_intersections(value)
            for key, value in report.items()
        )
    return isinstance(report, list) and any(tells_intersections(value) for value in report)


def says_something(value: object) -> bool:
    # Beside its own count a report may have that of the input.
    if isinstance(value, dict):
        return bool(value.get("count") or value.get("list"))
    return bool(value)


def first(values: np.ndarray, count: int = 4) -> str:
    return ", ".join(str(v) for v in np.asarray(values).tolist()[:count]) + (", ..." if len(values) > count else "")


def fixed_bits(before: Path, after: Path, old: File, new: File, free: np.ndarray, name: str) -> Findings:
    """Nothing but the coordinates of free vertices has changed."""
    if len(new.points) != len(old.points) and ".stl" not in (before.suffix, after.suffix):
        return [("fixed", f"{len(old.points)} vertices have become {len(new.points)}")]
    if len(new.polygons) != len(old.polygons):
        return [("fixed", f"{len(old.polygons)} faces have become {len(new.polygons)}")]
    if before.suffix != after.suffix:
        return fixed_corners(old, new, free)
    free_set = set(free.tolist())

    def changeable(file: File) -> list:
        # An STL that is read back may weld otherwise: the old file says which corners are free.
        facets = [i for i, p in enumerate(old.polygons) if free_set & set(p)] if file.facet_spans else []
        spans = file.spans if file is old or before.suffix != ".stl" else corner_spans(old, new)
        return [s for v in free_set for s in spans[v]] + [file.facet_spans[i] for i in facets]

    if without(before.read_bytes(), changeable(old)) != without(after.read_bytes(), changeable(new)):
        return [("fixed", f"bytes beside the free vertices' coordinates have changed ({name})")]
    return []


def fixed_corners(old: File, new: File, free: np.ndarray) -> Findings:
    """The same between two formats: compared face by face, in single precision if one file has no more."""
    corners = old.triangles().ravel()
    points, others = old.points[corners], new.points[new.triangles().ravel()]
    if len(points) != len(others):
        return [("fixed", "the result has other faces")]
    if old.single or new.single:
        points, others = points.astype(np.float32), others.astype(np.float32)
    moved = np.unique(corners[(points != others).any(1) & ~np.isin(corners, free)])
    return [("fixed", f"fixed vertices {first(moved)} have moved")] if len(moved) else []


def corner_places(file: File) -> list[tuple[int, int]]:
    """Of an STL, the range of every corner in the order of the file."""
    return sorted(s for spans in file.spans for s in spans)


def corner_spans(old: File, new: File) -> list[list[tuple[int, int]]]:
    places = corner_places(new)
    spans: list[list[tuple[int, int]]] = [[] for _ in old.points]
    for number, vertex in enumerate(v for polygon in old.polygons for v in polygon):
        spans[vertex].append(places[number])
    return spans


def moved_points(old: File, new: File) -> np.ndarray | None:
    """New positions by the old numbers; None if the copies of a vertex have come apart."""
    moved = np.full(old.points.shape, np.nan)
    old_corners = old.triangles().ravel()
    new_corners = new.points[new.triangles().ravel()]
    moved[old_corners] = new_corners
    return moved if np.array_equal(moved[old_corners], new_corners, equal_nan=True) else None


def judge_fair(before: Path, after: Path, free: np.ndarray, report: dict, name: str, averaged: bool) -> Findings:
    """All that is wrong with a fairing that was written, given that its report says what it says.

    `averaged`: its boundary normals are the averages of the triangles outside.
    """
    old = read(before)
    try:
        new = read(after)
    except UnreadableError as error:
        return [("unreadable", str(error))]
    findings = fixed_bits(before, after, old, new, free, name)
    if findings:
        return findings
    x = moved_points(old, new)
    if x is None:
        return [("torn", "copies of one vertex have different positions")]
    if not np.isfinite(x).all():
        return [("nan", "a coordinate is not finite")]
    triangles = old.triangles()
    touched = np.isin(triangles, free)
    inside, outside = triangles[touched.any(1)], triangles[~touched.any(1)]
    # The surface passes an island, it does not end there.
    outside = without_islands(inside, outside)
    findings += figures(x, inside, outside, report, averaged)
    if success(report):
        findings += sound(old.points, x, inside, outside)
        findings += new_crossings(old.points, x, triangles, np.flatnonzero(touched.any(1)), report)
    return findings


def figures(x: np.ndarray, inside: np.ndarray, outside: np.ndarray, report: dict, averaged: bool) -> Findings:
    """The report's figures are those of the file."""
    findings = []
    quality = report["quality"]
    found, told = float(smallest_angles(x, inside).min()), quality["worst_angle"]
    if told is None or abs(found - told) > ANGLE_ERROR + ANGLE_ERROR * found:
        findings.append(("figures", f"smallest angle {told} reported, {found:.6g} in the file"))
    if averaged:
        # Then the deviation is the kink to the outside triangles, where a vertex has any.
        at, angles = kinks(x, inside, outside)
        told = quality["normal_deviation"]
        if len(at) and angles.max() > told + ANGLE_ERROR + ANGLE_ERROR * told:
            worst = int(at[angles.argmax()])
            findings.append(("figures", f"deviation {told:.6g} reported, {angles.max():.6g} at vertex {worst}"))
    return findings


def sound(old: np.ndarray, new: np.ndarray, inside: np.ndarray, outside: np.ndarray) -> Findings:
    """What a success must not have: kinks, folds, needles and null faces that the input had not."""
    findings = []
    at, after = kinks(new, inside, outside)
    _, before = kinks(old, inside, outside)
    bad = (after > KINK) & (after > before + KINK_MORE)
    if bad.any():
        worst = np.flatnonzero(bad)[np.argmax(after[bad])]
        told = (
            f"{bad.sum()} boundary vertices; vertex {at[worst]}: {after[worst]:.1f} degrees, {before[worst]:.1f} before"
        )
        findings.append(("kink", told))
    edges, after = folds(new, inside)
    _, before = folds(old, inside)
    bad = (after > FOLD) & (before <= FOLD)
    if bad.any():
        worst = np.flatnonzero(bad)[np.argmax(after[bad])]
        findings.append(("fold", f"{bad.sum()} edges; {edges[worst].tolist()}: {after[worst]:.1f} degrees"))
    return findings + thin(new, inside)


def thin(x: np.ndarray, triangles: np.ndarray) -> Findings:
    angles = smallest_angles(x, triangles)
    null = angles < NULL
    if null.any():
        return [("null", f"{null.sum()} null faces, first of vertices {triangles[null][0].tolist()}")]
    if angles.min(initial=60) < NEEDLE:
        return [("needle", f"an angle of {angles.min():.4g} degrees at {triangles[angles.argmin()].tolist()}")]
    return []


def new_crossings(old: np.ndarray, new: np.ndarray, triangles: np.ndarray, some: np.ndarray, report: dict) -> Findings:
    """Pairs of triangles that cross in the result and not in the input, of which the report says nothing."""
    pairs = crossing_pairs(new, triangles, some)
    if len(pairs):
        pairs = pairs[~crossing(old, triangles, pairs)]
    if len(pairs) == 0 or tells_intersections(report):
        return []
    return [("intersects", f"{len(pairs)} pairs of triangles cross, not so in the input: {first(pairs)}")]


def judge_fill(before: Path, after: Path, report: dict, was: dict | None) -> Findings:
    """All that is wrong with a filling. `was`: by position in single precision, the kinks before the hole was made."""
    old = read(before)
    try:
        new = read(after)
    except UnreadableError as error:
        return [("unreadable", str(error))]
    count, faces = len(old.points), len(old.polygons)
    points, others = old.points, new.points[:count]
    if old.single or new.single:
        points, others = points.astype(np.float32), others.astype(np.float32)
    if not np.array_equal(points, others) or new.polygons[:faces] != old.polygons:
        return [("fixed", "the file's own vertices or faces have changed")]
    if not np.isfinite(new.points).all():
        return [("nan", "a coordinate is not finite")]
    findings: Findings = []
    for loop in report["loops"]:
        findings += judge_loop(new, faces, loop, was)
    return findings


def faired(loop: dict) -> bool:
    """Whether a loop is told to be filled and fair, without a reservation."""
    return loop["outcome"] == "faired" and loop["fairing"]["outcome"] == "converged"


def clean(loop: dict) -> bool:
    """Whether exit code 0 may stand beside this loop: faired, or by rule without new vertices or open."""
    by_rule = ("no new vertex was needed", "it encloses the mesh", "triangulated and refined")
    return faired(loop) or loop["told"].endswith(by_rule) or any(f"{rule}," in loop["told"] for rule in by_rule)


def judge_loop(new: File, faces: int, loop: dict, was: dict | None) -> Findings:
    begin, end = loop["faces"]
    if begin == end:
        return [("open", f"loop {loop['index']} is told filled and has no face")] if faired(loop) else []
    triangles = new.triangles()
    if len(triangles) != len(new.polygons):
        return []
    x, patch = new.points, triangles[begin:end]
    found, told = float(smallest_angles(x, patch).min()), loop["worst_angle"]
    findings: Findings = []
    if told is None or abs(found - told) > ANGLE_ERROR + ANGLE_ERROR * found:
        findings.append(("figures", f"loop {loop['index']}: smallest angle {told} reported, {found:.6g} in the file"))
    findings += closed(x, triangles, patch, loop) + numbers(x, triangles[:faces], patch, loop)
    if clean(loop) and not tells_intersections(loop):
        pairs = crossing_pairs(x, triangles, np.arange(begin, end))
        if len(pairs):
            text = f"loop {loop['index']}: {len(pairs)} pairs of triangles cross: {first(pairs)}"
            findings.append(("intersects", text))
    if not faired(loop):
        return findings
    edges, angles = folds(x, patch)
    if (angles > FOLD).any():
        worst = angles.argmax()
        findings.append(("fold", f"loop {loop['index']}: edge {edges[worst].tolist()}: {angles[worst]:.1f} degrees"))
    # The boundary alone decides on faces without a new vertex.
    new_faces = patch[(patch >= loop["vertices"][0]).any(1)] if "vertices" in loop else patch
    return findings + thin(x, new_faces) + filled_kinks(x, triangles[:faces], patch, loop, was)


def closed(x: np.ndarray, triangles: np.ndarray, patch: np.ndarray, loop: dict) -> Findings:
    """Every edge of the patch has two triangles, which run through it in opposite directions.

    Where the mesh has several vertices at one place, their numbers may differ, and a second sheet may lie there.
    """
    _, place, copies = np.unique(x, axis=0, return_inverse=True, return_counts=True)
    place = place.reshape(-1)
    edges, _ = half_edges(patch)
    has_copies = (copies[place[edges]] > 1).any(1)
    meets = directions(place[triangles], place[patch])[1] > 0
    if ((directions(triangles, patch) == 1).all(0) | (has_copies & meets)).all():
        return []
    return [("open", f"loop {loop['index']}: edges of the patch have other than two triangles, one each way")]


def directions(triangles: np.ndarray, patch: np.ndarray) -> np.ndarray:
    """Per edge of the patch, how many triangles run through it forwards, and how many backwards."""
    everywhere, _ = half_edges(triangles)
    edges, _ = half_edges(patch)
    size = int(everywhere.max()) + 1
    keys, counts = np.unique(everywhere @ [size, 1], return_counts=True)

    def count(wanted: np.ndarray) -> np.ndarray:
        at = np.minimum(np.searchsorted(keys, wanted), len(keys) - 1)
        return np.where(keys[at] == wanted, counts[at], 0)

    return np.stack([count(edges @ [size, 1]), count(edges @ [1, size])])


def numbers(x: np.ndarray, own: np.ndarray, patch: np.ndarray, loop: dict) -> Findings:
    """The number of new vertices is in proportion to the patch's area and the edges around it."""
    added = loop["vertices"][1] - loop["vertices"][0]
    boundary = np.intersect1d(np.unique(own), np.unique(patch))
    beside = own[np.isin(own, boundary).sum(1) >= 2]
    edges, _ = half_edges(beside)
    length = np.linalg.norm(x[edges[:, 0]] - x[edges[:, 1]], axis=1)
    area = np.linalg.norm(cross_products(x, patch), axis=1).sum() / 2
    expected = loop["edges"] + area / (np.sqrt(3) / 2 * max(np.median(length) ** 2, np.finfo(float).tiny))
    if added > TOO_MANY * expected:
        return [("many", f"loop {loop['index']}: {added} new vertices where about {expected:.0f} are asked for")]
    return []


def position_keys(x: np.ndarray) -> list[tuple]:
    return [tuple(p) for p in (x.astype(np.float32) + 0).tolist()]


def kinks_before(x: np.ndarray, inside: np.ndarray, outside: np.ndarray) -> dict:
    at, angles = kinks(x, inside, outside)
    return dict(zip(position_keys(x[at]), angles.tolist(), strict=True))


def filled_kinks(x: np.ndarray, own: np.ndarray, patch: np.ndarray, loop: dict, was: dict | None) -> Findings:
    """A kink beside a patch is measured against that of the surface before, or else the sharpness around it.

    Vertices at one place may be one, with the surface around both, or lie on two sheets: a kink is one either way.
    """
    points, place = np.unique(x, axis=0, return_inverse=True)
    place = place.reshape(-1)
    apart = bad_kinks(x, own, patch, was)
    as_one = bad_kinks(points, place[own], place[patch], was)
    both = {v: angles for v, angles in apart.items() if place[v] in as_one}
    if not both:
        return []
    worst = max(both, key=lambda v: both[v][0])
    after, before = both[worst]
    told = f"{len(both)} boundary vertices; vertex {worst}: {after:.1f} degrees, {before:.1f} around it"
    return [("kink", f"loop {loop['index']}: {told}")]


def bad_kinks(x: np.ndarray, own: np.ndarray, patch: np.ndarray, was: dict | None) -> dict[int, tuple[float, float]]:
    """The vertices beside a patch with too wide a kink: how wide it is, and what it is measured against."""
    at, after = kinks(x, patch, own)
    before = sharpness(x, own, at)
    if was is not None:
        before = np.array([was.get(key, around) for key, around in zip(position_keys(x[at]), before, strict=True)])
    bad = (after > KINK) & (after > before + KINK_MORE)
    return {int(v): (float(a), float(b)) for v, a, b in zip(at[bad], after[bad], before[bad], strict=True)}


def sharpness(x: np.ndarray, triangles: np.ndarray, vertices: np.ndarray) -> np.ndarray:
    """Per vertex the largest angle between one of its triangles and their sum."""
    normals = cross_products(x, triangles)
    sums = np.zeros_like(x)
    worst = np.zeros(len(x))
    for k in range(3):
        np.add.at(sums, triangles[:, k], normals)
    for k in range(3):
        np.maximum.at(worst, triangles[:, k], angle_between(normals, sums[triangles[:, k]]))
    return worst[vertices]


def load_report(path: Path) -> dict:
    return json.loads(path.read_text())
