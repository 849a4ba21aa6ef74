"""Faces of a mesh chosen by place, distance and shape, as masks."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, overload

import numpy as np
from numpy.typing import NDArray

from . import _abi, _arrays
from ._calls import of_mesh
from ._forms import ArrayLike
from ._hosts import MeshLike
from ._keywords import SelectKeywords
from ._options import real, whole
from ._runs import watched

if TYPE_CHECKING:
    from typing_extensions import Unpack


_kinds = _abi.fairmesh_region_kind
#: A mask of faces.
Mask = NDArray[np.bool_]


@overload
def select_ball(mesh: MeshLike, /, centre: ArrayLike, radius: float, **keywords: Unpack[SelectKeywords]) -> Mask: ...
@overload
def select_ball(
    vertices: ArrayLike, faces: ArrayLike, centre: ArrayLike, radius: float, **keywords: Unpack[SelectKeywords]
) -> Mask: ...
@of_mesh(SelectKeywords)
def select_ball(mesh: _arrays.Mesh, centre: ArrayLike, radius: float, **keywords: Unpack[SelectKeywords]) -> Mask:
    """Faces that lie in a ball with all corners, as a mask (m,).

    Args:
        mesh, coincident: As in `fair`.
        centre: x, y, z.
        radius: Its radius.
        progress, cancel: As in `fair`.

    """
    step = _step(_kinds.BALL, point=_arrays.point(centre, "centre"), value=real(radius, "radius"))
    return _chosen(keywords, mesh, step)


@overload
def select_box(mesh: MeshLike, /, low: ArrayLike, high: ArrayLike, **keywords: Unpack[SelectKeywords]) -> Mask: ...
@overload
def select_box(
    vertices: ArrayLike, faces: ArrayLike, low: ArrayLike, high: ArrayLike, **keywords: Unpack[SelectKeywords]
) -> Mask: ...
@of_mesh(SelectKeywords)
def select_box(mesh: _arrays.Mesh, low: ArrayLike, high: ArrayLike, **keywords: Unpack[SelectKeywords]) -> Mask:
    """Faces that lie in a box with all corners, as a mask (m,).

    Args:
        mesh, coincident: As in `fair`.
        low, high: Its smallest and its largest coordinates.
        progress, cancel: As in `fair`.

    """
    step = _step(_kinds.BOX, point=_arrays.point(low, "low"), vector=_arrays.point(high, "high"))
    return _chosen(keywords, mesh, step)


@overload
def select_halfspace(
    mesh: MeshLike, /, point: ArrayLike, normal: ArrayLike, **keywords: Unpack[SelectKeywords]
) -> Mask: ...
@overload
def select_halfspace(
    vertices: ArrayLike, faces: ArrayLike, point: ArrayLike, normal: ArrayLike, **keywords: Unpack[SelectKeywords]
) -> Mask: ...
@of_mesh(SelectKeywords)
def select_halfspace(
    mesh: _arrays.Mesh, point: ArrayLike, normal: ArrayLike, **keywords: Unpack[SelectKeywords]
) -> Mask:
    """Faces on one side of a plane with all corners, as a mask (m,).

    Args:
        mesh, coincident: As in `fair`.
        point: A point of the plane.
        normal: Points to the side, of any length but zero.
        progress, cancel: As in `fair`.

    """
    step = _step(_kinds.HALF_SPACE, point=_arrays.point(point, "point"), vector=_arrays.point(normal, "normal"))
    return _chosen(keywords, mesh, step)


@overload
def select_geodesic(
    mesh: MeshLike, /, seed: ArrayLike | int, radius: float, **keywords: Unpack[SelectKeywords]
) -> Mask: ...
@overload
def select_geodesic(
    vertices: ArrayLike, faces: ArrayLike, seed: ArrayLike | int, radius: float, **keywords: Unpack[SelectKeywords]
) -> Mask: ...
@of_mesh(SelectKeywords)
def select_geodesic(
    mesh: _arrays.Mesh, seed: ArrayLike | int, radius: float, **keywords: Unpack[SelectKeywords]
) -> Mask:
    """Faces all of whose corners are no further from a place than this along the surface, as a mask (m,).

    Args:
        mesh, coincident: As in `fair`.
        seed: A vertex by its number, or x, y, z: the point of the surface that is nearest.
        radius: The largest distance.
        progress, cancel: As in `fair`.

    """
    return _chosen(keywords, mesh, _seeded(_kinds.GEODESIC, seed, real(radius, "radius")))


@overload
def select_component(mesh: MeshLike, /, seed: ArrayLike | int, **keywords: Unpack[SelectKeywords]) -> Mask: ...
@overload
def select_component(
    vertices: ArrayLike, faces: ArrayLike, seed: ArrayLike | int, **keywords: Unpack[SelectKeywords]
) -> Mask: ...
@of_mesh(SelectKeywords)
def select_component(mesh: _arrays.Mesh, seed: ArrayLike | int, **keywords: Unpack[SelectKeywords]) -> Mask:
    """Faces that hang together with a place by edges, as a mask (m,).

    Args:
        mesh, coincident: As in `fair`.
        seed: A vertex by its number, or x, y, z: the point of the surface that is nearest.
        progress, cancel: As in `fair`.

    """
    return _chosen(keywords, mesh, _seeded(_kinds.COMPONENT, seed))


@overload
def select_patch(
    mesh: MeshLike, /, seed: ArrayLike | int, angle: float = ..., **keywords: Unpack[SelectKeywords]
) -> Mask: ...
@overload
def select_patch(
    vertices: ArrayLike, faces: ArrayLike, seed: ArrayLike | int, angle: float = ..., **keywords: Unpack[SelectKeywords]
) -> Mask: ...
@of_mesh(SelectKeywords)
def select_patch(
    mesh: _arrays.Mesh, seed: ArrayLike | int, angle: float = 30.0, **keywords: Unpack[SelectKeywords]
) -> Mask:
    """Faces around a place up to edges at which the surface bends by more than an angle, as a mask (m,).

    Args:
        mesh, coincident: As in `fair`.
        seed: A vertex by its number, or x, y, z: the point of the surface that is nearest.
        angle: In degrees, from 0 to 180. Default 30.
        progress, cancel: As in `fair`.

    """
    return _chosen(keywords, mesh, _seeded(_kinds.PATCH, seed, real(angle, "angle")))


@overload
def select_bump(
    mesh: MeshLike, /, seed: ArrayLike | int, size: float = ..., **keywords: Unpack[SelectKeywords]
) -> Mask: ...
@overload
def select_bump(
    vertices: ArrayLike, faces: ArrayLike, seed: ArrayLike | int, size: float = ..., **keywords: Unpack[SelectKeywords]
) -> Mask: ...
@of_mesh(SelectKeywords)
def select_bump(
    mesh: _arrays.Mesh, seed: ArrayLike | int, size: float = 0.0, **keywords: Unpack[SelectKeywords]
) -> Mask:
    """All of the bump or dent at a place, as a mask (m,).

    It is the least region whose fair surface stays what it is when the region grows.

    Args:
        mesh, coincident: As in `fair`.
        seed: A vertex by its number, or x, y, z: the point of the surface that is nearest.
        size: About how far it reaches along the surface, as a nose with a pimple on it. Default 0: the smallest one.
        progress, cancel: As in `fair`.

    Raises:
        InputError: Nothing tells where a bump ends (`Status.NO_BUMP`).

    """
    return _chosen(keywords, mesh, _seeded(_kinds.BUMP, seed, real(size, "size")))


@overload
def grow(mesh: MeshLike, /, region: ArrayLike | str, rings: int = ..., **keywords: Unpack[SelectKeywords]) -> Mask: ...
@overload
def grow(
    vertices: ArrayLike, faces: ArrayLike, region: ArrayLike, rings: int = ..., **keywords: Unpack[SelectKeywords]
) -> Mask: ...
@of_mesh(SelectKeywords)
def grow(mesh: _arrays.Mesh, region: ArrayLike | str, rings: int = 1, **keywords: Unpack[SelectKeywords]) -> Mask:
    """A region with the faces that have a vertex in common with it, as a mask (m,).

    Args:
        mesh, coincident: As in `fair`.
        region: A mask (m,) or indices of faces, or the name of a mask that the mesh has at its faces.
        rings: So often. Default 1.
        progress, cancel: As in `fair`.

    """
    return _spread(keywords, mesh, region, _step(_kinds.GROW, rings=whole(rings, "rings")))


@overload
def shrink(
    mesh: MeshLike, /, region: ArrayLike | str, rings: int = ..., **keywords: Unpack[SelectKeywords]
) -> Mask: ...
@overload
def shrink(
    vertices: ArrayLike, faces: ArrayLike, region: ArrayLike, rings: int = ..., **keywords: Unpack[SelectKeywords]
) -> Mask: ...
@of_mesh(SelectKeywords)
def shrink(mesh: _arrays.Mesh, region: ArrayLike | str, rings: int = 1, **keywords: Unpack[SelectKeywords]) -> Mask:
    """A region without the faces that have a vertex in common with the rest, as a mask (m,).

    Args:
        mesh, coincident: As in `fair`.
        region: A mask (m,) or indices of faces, or the name of a mask that the mesh has at its faces.
        rings: So often. Default 1.
        progress, cancel: As in `fair`.

    """
    return _spread(keywords, mesh, region, _step(_kinds.SHRINK, rings=whole(rings, "rings")))


def _step(
    kind: _abi.fairmesh_region_kind, *, point: Any = None, vector: Any = None, value: float = 0.0, rings: int = 0
) -> _abi.fairmesh_region_step:
    made = _abi.fairmesh_region_step(kind=kind, value=value, rings=rings)
    if point is not None:
        made.point[:] = point
    if vector is not None:
        made.vector[:] = vector
    return made


def _seeded(kind: _abi.fairmesh_region_kind, seed: ArrayLike | int, value: float = 0.0) -> _abi.fairmesh_region_step:
    """A step that begins at a vertex or a point."""
    if np.asarray(seed).ndim != 0:
        return _step(kind, point=_arrays.point(seed, "seed"), value=value)
    made = _step(kind, value=value)
    made.seed_kind = _abi.fairmesh_seed_kind.VERTEX
    made.seed_vertex = int(_arrays.indices(np.asarray(seed).reshape(1), "seed")[0])
    return made


def _spread(keywords: SelectKeywords, mesh: _arrays.Mesh, region: Any, step: _abi.fairmesh_region_step) -> Mask:
    listed = _arrays.chosen_faces(mesh, region, "region")
    first = _step(_kinds.TRIANGLES)
    first.list = _arrays.indices_view(listed)
    return _chosen(keywords, mesh, first, step)


def _chosen(keywords: SelectKeywords, mesh: _arrays.Mesh, *steps: _abi.fairmesh_region_step) -> Mask:
    """What the steps choose, as a mask."""
    asked = (_abi.fairmesh_region_step * len(steps))(*steps)
    handle = watched(keywords, "fairmesh_select_region", mesh.struct, asked, len(steps))
    made = np.zeros(len(mesh.faces), np.bool_)
    made[handle.list(_abi.fairmesh_list.REGION_TRIANGLES)] = True
    return made
