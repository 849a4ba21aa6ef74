"""How near a result is to the truth, and how sound it is: judged by files alone."""

from __future__ import annotations

from typing import NamedTuple

import igl
import numpy as np
from numpy.typing import NDArray
from scipy.sparse import coo_array
from scipy.sparse.csgraph import connected_components
from scipy.spatial import cKDTree

from .bends import jump
from .cases import Case
from .crossings import crossings
from .meshes import Mask, Mesh, Points, boundary_edges, half_edges
from .shape import edge_angles, smallest_angles

#: Points per triangle side at which distances are taken. With half of it root mean squares of 115 results change by up to 5 %
#: (median .3 %), with double by up to 2.4 % (.1 %).
SIDE = 4


class Measures(NamedTuple):
    """Lengths are in widths of the hole or region; angles in degrees."""

    #: From the truth to the result and back, over the area: root mean square of both, mean, and the largest.
    rms: float
    mean: float
    largest: float
    #: Of the vertices that are new or have moved, from the exact surface; NaN where none is known, or none is there.
    vertices: float
    #: Angles between new and old triangles at the rim, root mean square, beyond those of the truth; NaN for what is rounded.
    crease: float
    #: Mean curvature of the new side at the rim, beyond that of the old one, root mean square over the width, beyond that of the truth; NaN without vertices.
    jump: float
    smallest_angle: float
    #: Pairs of triangles that are neighbours and face opposite ways, by more than 170 degrees, of which one is new.
    folds: int
    #: New triangles that go through others.
    crossings: int
    #: Edges of new triangles that have more than one triangle on a side: nothing is on both its sides there.
    tangled: int
    #: Edges of the boundary besides those that the truth has.
    open_edges: int
    #: Old vertices that are no longer where they were, to the last bit.
    moved: int
    #: Triangles of the result that are new.
    new_triangles: int


def new_triangles(case: Case, result: Mesh) -> Mask:
    """The triangles of a result that its input does not have, and for a region those of its free vertices. Corners are known by their places."""
    if case.task in ("fair", "bump"):
        is_moved = np.zeros(len(result.vertices), bool)
        is_moved[: len(case.mesh.vertices)] = (result.vertices[: len(case.mesh.vertices)] != case.truth.vertices).any(axis=1)
        if len(result.vertices) == len(case.mesh.vertices):
            return is_moved[result.faces].any(axis=1)
    return _at_rim(case, result, ~np.isin(_keys(result), _keys(case.mesh)))


def _keys(mesh: Mesh) -> NDArray[np.void]:
    """Each triangle by the places of its corners, to single precision, the smallest first."""
    places = _places(mesh.vertices)[mesh.faces]
    first = places.argmin(axis=1)
    turned = np.take_along_axis(places, (first[:, None] + np.arange(3)) % 3, axis=1)
    return np.ascontiguousarray(turned).view([("", turned.dtype)] * 3).ravel()


def _places(points: Points) -> NDArray[np.uint64]:
    """A number for each place, to single precision: a hash of its coordinates' bits."""
    bits = (points.astype(np.float32) + np.float32(0)).view(np.uint32).astype(np.uint64)
    mixed = np.zeros(len(points), np.uint64)
    for k in range(3):
        mixed = (mixed ^ bits[:, k]) * np.uint64(0x9E3779B97F4A7C15)
        mixed ^= mixed >> np.uint64(29)
    return mixed


def _at_rim(case: Case, result: Mesh, new: Mask) -> Mask:
    """Of the new triangles those that hang together with the hole's boundary: programs may have filled other holes, too."""
    if "hole" not in case.told or not new.any():
        return new
    corners = case.mesh.vertices[case.told["hole"]]
    rim = np.isin(_places(result.vertices), _places(corners))
    if not rim.any():
        # A program may have moved them, by less than an edge.
        near = cKDTree(corners).query(corners, 2)[0][:, 1].mean()
        rim = cKDTree(corners).query(result.vertices, distance_upper_bound=near)[0] < near
    faces = result.faces[new]
    joints = coo_array((np.ones(3 * len(faces)), (faces.ravel(), faces[:, [1, 2, 0]].ravel())), (len(result.vertices),) * 2)
    _, part = connected_components(joints, directed=False)
    found = new.copy()
    found[new] = np.isin(part[faces[:, 0]], part[np.intersect1d(np.flatnonzero(rim), faces)])
    return found


def samples(mesh: Mesh) -> tuple[Points, NDArray[np.float64]]:
    """Points spread over triangles, and the area that each stands for."""
    thirds = [(3 * i + k, 3 * j + k) for i in range(SIDE) for j in range(SIDE - i) for k in ((1, 2) if i + j + 1 < SIDE else (1,))]
    shares = np.array(thirds) / (3 * SIDE)
    a, b, c = np.moveaxis(mesh.corners(), 1, 0)
    at = a[:, None] + shares[None, :, :1] * (b - a)[:, None] + shares[None, :, 1:] * (c - a)[:, None]
    weights = np.repeat(mesh.areas() / len(shares), len(shares))
    return at.reshape(-1, 3), weights


def distances(points: Points, mesh: Mesh) -> NDArray[np.float64]:
    """From each point to the nearest one of a mesh."""
    return np.sqrt(igl.point_mesh_squared_distance(points, mesh.vertices, mesh.faces)[0])


def crease(mesh: Mesh, new: Mask) -> float:
    """The angles at edges between new triangles and old ones, root mean square."""
    first, second, angles = edge_angles(mesh)
    at_rim = new[first] != new[second]
    return float(np.sqrt((angles[at_rim] ** 2).mean())) if at_rim.any() else float("nan")


def measured(case: Case, result: Mesh) -> Measures:
    """All of it. A result without new triangles is measured as far from the truth as that is wide."""
    width = case.width()
    new = new_triangles(case, result)
    # Of a region that keeps its triangles, those that the input or the result has moved are compared.
    wanted = case.wanted | new if case.task in ("fair", "bump") and len(new) == len(case.wanted) else case.wanted
    new = wanted if len(new) == len(wanted) and case.task in ("fair", "bump") else new
    if not new.any():
        nothing = float("nan")
        return Measures(1.0, 1.0, 1.0, nothing, nothing, nothing, nothing, 0, 0, 0, _open(case, result), _moved(case, result), 0)
    found, truth = result.only(new), case.truth.only(wanted)
    there, there_weights = samples(truth)
    back, back_weights = samples(found)
    # A rounding's rim may be anywhere, as flat sides may have new triangles, too.
    is_round, nowhere = case.task == "round", float("nan")
    if is_round:
        # Flat sides may have other triangles than before: what is further from the rounding than the ball is wide does not count.
        back_weights = back_weights * (distances(back, truth) < case.told["radius"])
    # From and to all of each: a program may have moved what is around the hole.
    ways = [(distances(there, result), there_weights), (distances(back, case.truth), back_weights)]
    mean = np.mean([np.average(far, weights=weights) for far, weights in ways])
    square = np.mean([np.average(far**2, weights=weights) for far, weights in ways])
    angles = smallest_angles(found)
    first, second, turns = edge_angles(result)
    return Measures(
        rms=float(np.sqrt(square)) / width,
        mean=float(mean) / width,
        largest=float(max(far.max() for far, _ in ways)) / width,
        vertices=_vertices(case, result, new) / width,
        crease=nowhere if is_round else crease(result, new) - crease(case.truth, case.wanted),
        jump=nowhere if is_round else (jump(result, new) - jump(case.truth, case.wanted)) * width,
        smallest_angle=float(angles.min()),
        folds=int(((turns > 170) & (new[first] | new[second])).sum()),
        crossings=crossings(result, new),
        tangled=tangled(result, new),
        open_edges=_open(case, result),
        moved=_moved(case, result),
        new_triangles=int(new.sum()),
    )


def _vertices(case: Case, result: Mesh, new: Mask) -> float:
    """Root mean square of the distances of vertices that no old triangle has from the exact surface."""
    inner = np.setdiff1d(np.unique(result.faces[new]), np.unique(result.faces[~new]))
    if case.exact is None or len(inner) == 0:
        return float("nan")
    return float(np.sqrt((case.exact.distance(result.vertices[inner]) ** 2).mean()))


def _open(case: Case, result: Mesh) -> int:
    """Edges of the boundary that the truth does not have, by the places of their ends: not those of other holes, filled or not."""
    result_edges, truth_edges = (_places(mesh.vertices)[boundary_edges(mesh.faces)] for mesh in (result, case.truth))
    known = set(map(tuple, truth_edges.tolist()))
    return sum(edge not in known for edge in map(tuple, result_edges.tolist()))


def _moved(case: Case, result: Mesh) -> int:
    """Vertices of the truth around what is wanted whose places no vertex of the result has."""
    around = case.truth.faces[~case.wanted]
    if case.task == "round" or len(around) == 0:
        return 0
    given = case.mesh.vertices[np.unique(case.mesh.faces)] if case.task in ("fill", "join") else case.truth.vertices[np.unique(around)]
    there = {p.tobytes() for p in result.vertices + 0.0}
    return sum(p.tobytes() not in there for p in given + 0.0)


def tangled(mesh: Mesh, new: Mask) -> int:
    """Directed edges that several triangles have, one of them new."""
    edges = half_edges(mesh.faces)
    _, number, count = np.unique(edges, axis=0, return_inverse=True, return_counts=True)
    again = count[number.ravel()] > 1
    return len(np.unique(number.ravel()[again & np.repeat(new, 3)]))
