"""Intersecting triangles of a whole mesh."""

from __future__ import annotations

from typing import TYPE_CHECKING, overload

import numpy as np
from numpy.typing import NDArray

from . import _abi, _arrays
from ._calls import of_mesh
from ._forms import ArrayLike
from ._hosts import MeshLike
from ._keywords import WatchKeywords
from ._runs import watched

if TYPE_CHECKING:
    from typing_extensions import Unpack


@overload
def self_intersections(
    mesh: MeshLike, /, among: ArrayLike | str | None = None, **keywords: Unpack[WatchKeywords]
) -> NDArray[np.intp]: ...
@overload
def self_intersections(
    vertices: ArrayLike, faces: ArrayLike, among: ArrayLike | None = None, **keywords: Unpack[WatchKeywords]
) -> NDArray[np.intp]: ...
@of_mesh(WatchKeywords)
def self_intersections(
    mesh: _arrays.Mesh, among: ArrayLike | str | None = None, **keywords: Unpack[WatchKeywords]
) -> NDArray[np.intp]:
    """Pairs of faces that intersect, (p, 2), the smaller index first, ascending.

    ``mesh`` as in `fair`; ``among``: indices of faces, a mask, or the name of one that the mesh has, and only
    pairs with at least one of them. ``progress`` and ``cancel`` as in `fair`.

    Two triangles intersect if they have more in common than a vertex of both or an edge of both, where vertices at the
    same position are one; also if they only touch. Exact for the positions given. Triangles without area take no part.
    The mesh need not be a manifold.

    Raises:
        InputError: An index or a coordinate is wrong; it says where.

    """
    listed = None if among is None else _arrays.chosen_faces(mesh, among, "among")
    handle = watched(keywords, "fairmesh_self_intersections", mesh.struct, _arrays.list_view(listed))
    return handle.list(_abi.fairmesh_list.INTERSECTIONS).reshape(-1, 2)
