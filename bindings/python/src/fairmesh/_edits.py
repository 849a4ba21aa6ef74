"""Changes of the boundary between the frames of a `Solver`."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Union

import numpy as np

from . import _abi, _arrays
from ._options import keep, real

if TYPE_CHECKING:
    from ._forms import ArrayLike

_kinds = _abi.fairmesh_edit_kind


@dataclass(frozen=True)
class Tilt:
    """Turns the boundary normals of a loop about the boundary.

    Attributes:
        vertex: A boundary vertex of the region; its loop is meant.
        angle: In radians. With a positive one the surface leaves the boundary steeper to the side of the normals.
        falloff: How far along the loop from ``vertex`` it reaches, falling off smoothly; 0: the whole loop alike.

    """

    vertex: int
    angle: float
    falloff: float = 0.0


@dataclass(frozen=True)
class Twist:
    """The same on one side of ``vertex``, and the opposite on the other; attributes as of `Tilt`."""

    vertex: int
    angle: float
    falloff: float = 0.0


@dataclass(frozen=True)
class Bulge:
    """Bulges the whole region by one number, outward if it is positive; see `Solver.bulge_range`."""

    amount: float


@dataclass(frozen=True, eq=False)
class Move:
    """Moves fixed vertices rigidly; their normals follow, given or fitted.

    Attributes:
        vertices: Indices, or a mask.
        rotation: The axis, times the angle in radians.
        centre: A point on the axis.
        translation: After the rotation.
        falloff: How far along the mesh other fixed vertices follow in part; 0: none does.

    """

    vertices: ArrayLike
    rotation: ArrayLike = (0.0, 0.0, 0.0)
    centre: ArrayLike = (0.0, 0.0, 0.0)
    translation: ArrayLike = (0.0, 0.0, 0.0)
    falloff: float = 0.0


#: A change of what is asked at the boundary.
Edit = Union[Tilt, Twist, Bulge, Move]


@dataclass(frozen=True)
class Frame:
    """How the surface of a frame stands."""

    #: Its step norm, in diagonals of the bounding box: how far from the end it is, about; NaN before there is one.
    step: float
    #: Evaluations of the equations that it has cost.
    evaluations: int
    #: Whether its step norm is within the tolerance; if not, further updates go on from here.
    is_settled: bool


def edit_struct(edit: Edit, count: int) -> _abi.fairmesh_edit:
    """An edit as the C interface takes it."""
    if isinstance(edit, Bulge):
        return _abi.fairmesh_edit(kind=_kinds.BULGE, amount=real(edit.amount, "amount"))
    if isinstance(edit, (Tilt, Twist)):
        made = _abi.fairmesh_edit(kind=_kinds.TILT if isinstance(edit, Tilt) else _kinds.TWIST)
        made.vertex = int(_arrays.indices(np.asarray(edit.vertex).reshape(1), "vertex")[0])
        made.amount = real(edit.angle, "angle")
    elif isinstance(edit, Move):
        given = _arrays.mask_or_indices(edit.vertices, "vertices", count)
        vertices = np.flatnonzero(given).astype(np.uint32) if given.dtype == np.uint8 else given
        made = keep(_abi.fairmesh_edit(kind=_kinds.MOVE, vertices=_arrays.indices_view(vertices)), vertices)
        for name in ("rotation", "centre", "translation"):
            getattr(made, name)[:] = _arrays.point(getattr(edit, name), name)
    else:
        raise TypeError(f"edits: Tilt, Twist, Bulge or Move is needed, not {type(edit).__name__}")
    made.falloff = real(edit.falloff, "falloff")
    return made
