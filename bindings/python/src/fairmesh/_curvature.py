"""Mean curvature over a whole mesh."""

from __future__ import annotations

from typing import TYPE_CHECKING, overload

import numpy as np
from numpy.typing import NDArray

from . import _arrays
from ._calls import of_mesh
from ._errors import call
from ._forms import ArrayLike
from ._hosts import MeshLike
from ._library import load

if TYPE_CHECKING:
    from typing_extensions import Unpack

    from ._keywords import MeshKeywords


@overload
def mean_curvature(mesh: MeshLike, /, **keywords: Unpack[MeshKeywords]) -> NDArray[np.float64]: ...
@overload
def mean_curvature(vertices: ArrayLike, faces: ArrayLike, **keywords: Unpack[MeshKeywords]) -> NDArray[np.float64]: ...
@of_mesh()
def mean_curvature(mesh: _arrays.Mesh) -> NDArray[np.float64]:
    """Mean curvature H at every vertex of a mesh, (n,), in 1 / length.

    ``mesh`` and ``coincident`` as in `fair`. Negative on a sphere with outward normals,
    that is with faces counter-clockwise seen from outside. NaN at vertices without faces. The mesh need not be a
    manifold.

    Raises:
        InputError: An index or a coordinate is wrong; it says where.

    """
    made = np.empty(len(mesh.vertices))
    call(load(), "fairmesh_mean_curvature", mesh.struct, _arrays.scalars_out(made))
    return made
