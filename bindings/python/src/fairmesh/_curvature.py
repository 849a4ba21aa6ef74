"""Mean curvature over a whole mesh."""

from __future__ import annotations

import ctypes
from typing import Any, overload

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _arrays
from ._calls import of_mesh
from ._errors import call
from ._hosts import MeshLike
from ._library import load


@overload
def mean_curvature(mesh: MeshLike, /, *, coincident: _arrays.Coincident | None = ...) -> NDArray[np.float64]: ...
@overload
def mean_curvature(
    vertices: ArrayLike, faces: ArrayLike, *, coincident: _arrays.Coincident | None = ...
) -> NDArray[np.float64]: ...
@of_mesh()
def mean_curvature(
    vertices: Any, faces: Any = None, *, coincident: _arrays.Coincident | None = "join"
) -> NDArray[np.float64]:
    """Mean curvature H at every vertex of a mesh, (n,), in 1 / length.

    ``mesh`` and ``coincident`` as in `fair`. Negative on a sphere with outward normals,
    that is with faces counter-clockwise seen from outside. NaN at vertices without faces. The mesh need not be a
    manifold.

    Raises:
        InputError: An index or a coordinate is wrong; it says where.

    """
    library = load()
    mesh = _arrays.Mesh(vertices, faces, coincident)
    made = np.empty(len(mesh.vertices))
    call(library, "fairmesh_mean_curvature", ctypes.byref(mesh.struct), ctypes.byref(_arrays.scalars_out(made)))
    return made
