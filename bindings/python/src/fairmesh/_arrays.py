"""numpy arrays to the library's views and back. Arrays that the library can read where they are, are not copied."""

from __future__ import annotations

import ctypes
import functools
from collections.abc import Callable
from typing import Any, Literal, TypeVar, Union

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _abi
from ._errors import ElementKind, InputError, Status

Floats = NDArray[Any]
Indices = NDArray[Any]
UInt32 = NDArray[np.uint32]
Float64 = NDArray[np.float64]
Selection = Union[ArrayLike, None]
#: "join" where coordinates are equal, a distance up to which they may differ, or "separate".
Coincident = Union[Literal["join", "separate"], float]

_SCALARS = {
    np.dtype(np.float32): _abi.fairmesh_scalar.FLOAT32,
    np.dtype(np.float64): _abi.fairmesh_scalar.FLOAT64,
}
_NO_INDEX = 2**32
#: What lists of indices name, if not vertices.
_ELEMENTS = {
    "free_faces": ElementKind.TRIANGLE,
    "among": ElementKind.TRIANGLE,
    "erased": ElementKind.TRIANGLE,
    "loops": ElementKind.LOOP,
    "join": ElementKind.LOOP,
    "of_components": ElementKind.NONE,
}


def _readable(array: NDArray[Any]) -> bool:
    """Can the library step through the rows: entries side by side, rows forward, aligned, in native byte order?"""
    size = array.itemsize
    row = size * (array.shape[1] if array.ndim == 2 else 1)
    return (
        array.dtype.isnative
        and array.flags.aligned
        and (array.ndim == 1 or array.strides[1] == size)
        and (len(array) < 2 or (array.strides[0] >= row and array.strides[0] % size == 0))
    )


def _packed(array: NDArray[Any]) -> NDArray[Any]:
    """A copy, aligned and with nothing between (`numpy.ascontiguousarray` keeps misaligned arrays)."""
    return np.array(array, order="C")


def _stride(array: NDArray[Any]) -> int:
    return array.strides[0] if len(array) > 1 else 0


def _address(array: NDArray[Any]) -> int | None:
    return array.ctypes.data if len(array) else None


Function = TypeVar("Function", bound=Callable[..., Any])


def of_arrays(function: Function) -> Function:
    """Tells those who hand over a mesh object that its arrays are needed."""

    @functools.wraps(function)
    def checked(*given: Any, **named: Any) -> Any:
        for each in (*given, *named.values()):
            faces = next((name for name in ("faces", "triangles") if hasattr(each, name)), None)
            if faces and hasattr(each, "vertices"):
                what = type(each).__name__
                raise TypeError(
                    f"a {what} is no array: give mesh.vertices and mesh.{faces} in its place, as vertices and faces"
                )
        return function(*given, **named)

    return checked  # type: ignore[return-value]


def points(given: ArrayLike, name: str, *, rows: int | None = None) -> Floats:
    """Points or vectors, (n, 3), float32 or float64; other real numbers become float64."""
    array = np.asarray(given)
    native = array.dtype.newbyteorder("=")
    if native not in _SCALARS:
        if native.kind not in "iuf":
            raise TypeError(f"{name}: real numbers are needed, not {array.dtype}")
        native = np.dtype(np.float64)
    array = array.astype(native, copy=False)
    if array.ndim != 2 or array.shape[1] != 3:
        if array.shape == (0,):
            return np.empty((0, 3), native)
        raise ValueError(f"{name}: the shape has to be (n, 3), not {array.shape}")
    if rows is not None and len(array) != rows:
        raise ValueError(f"{name}: {len(array)} rows, but {rows} are needed")
    return array if _readable(array) else _packed(array)


def numbers(given: ArrayLike, name: str, *, count: int) -> Floats:
    """Real numbers, (count,), float32 or float64; others become float64."""
    array = np.asarray(given)
    if array.shape == (0,):
        array = np.empty(0)
    if array.dtype.kind not in "iuf":
        raise TypeError(f"{name}: real numbers are needed, not {array.dtype}")
    if array.ndim != 1:
        raise ValueError(f"{name}: the shape has to be (k,), not {array.shape}")
    if len(array) != count:
        raise ValueError(f"{name}: {len(array)} numbers, but {count} are needed")
    native = array.dtype.newbyteorder("=")
    array = array.astype(native if native in _SCALARS else np.dtype(np.float64), copy=False)
    return array if _readable(array) else _packed(array)


def triangles(given: ArrayLike) -> tuple[UInt32, np.dtype[Any]]:
    """Triangles, (m, 3), as uint32; and the type of integers that they were given in."""
    array = np.asarray(given)
    if array.shape == (0,):
        array = np.empty((0, 3), np.int64)
    _whole_numbers(array, "faces")
    if array.ndim != 2 or array.shape[1] != 3:
        raise ValueError(f"faces: the shape has to be (m, 3), not {array.shape}")
    at = _first_outside(array)
    if at is not None:
        triangle, index = at // 3, int(array[at // 3, at % 3])
        raise InputError(
            Status.INDEX_OUT_OF_RANGE,
            f"triangle {triangle} names vertex {index}",
            element_kind=ElementKind.TRIANGLE,
            element=triangle,
            other=index,
        )
    return _as_uint32(array), array.dtype


def indices(given: ArrayLike, name: str) -> UInt32:
    """Indices, (k,), as uint32."""
    array = np.asarray(given)
    if array.shape == (0,):
        return np.empty(0, np.uint32)
    _whole_numbers(array, name)
    if array.ndim != 1:
        raise ValueError(f"{name}: the shape has to be (k,), not {array.shape}")
    at = _first_outside(array)
    if at is not None:
        raise InputError(
            Status.SELECTION_OUT_OF_RANGE,
            f"{name} names element {int(array[at])}",
            element_kind=_ELEMENTS.get(name, ElementKind.VERTEX),
            element=int(array[at]),
        )
    return _as_uint32(array)


def pairs(given: ArrayLike, name: str) -> UInt32:
    """Pairs of indices, (k, 2), as uint32."""
    array = np.asarray(given)
    if array.shape == (0,):
        return np.empty((0, 2), np.uint32)
    if array.ndim != 2 or array.shape[1] != 2:
        raise ValueError(f"{name}: the shape has to be (k, 2), not {array.shape}")
    return indices(array.reshape(-1), name).reshape(-1, 2)


def _whole_numbers(array: NDArray[Any], name: str) -> None:
    if array.dtype.kind not in "iu":
        raise TypeError(f"{name}: integers are needed, not {array.dtype}")


def _first_outside(array: NDArray[Any]) -> int | None:
    """The first entry, counted through, that no uint32 can hold."""
    if array.size == 0 or (array.dtype.kind == "u" and array.itemsize <= 4):
        return None
    if int(array.min()) >= 0 and (array.itemsize <= 4 or int(array.max()) < _NO_INDEX):
        return None
    return int(np.flatnonzero((array < 0) | (array >= _NO_INDEX))[0])


def _as_uint32(array: NDArray[Any]) -> UInt32:
    whole = array.dtype.itemsize == 4 and array.dtype.isnative
    array = array.view(np.uint32) if whole else array.astype(np.uint32)
    return array if _readable(array) else _packed(array)


def mask_or_indices(given: ArrayLike, name: str, count: int) -> NDArray[Any]:
    """A mask as uint8, or indices as uint32, each once. Integers that could be either are refused: of 8 bits, or as
    many as a mask has entries and only 0 and 1.
    """
    array = np.asarray(given)
    if array.dtype == np.bool_:
        if array.shape != (count,):
            raise ValueError(f"{name}: a mask has to have the shape ({count},), not {array.shape}")
        mask = array.view(np.uint8)
        return mask if _readable(mask) else _packed(mask)
    if array.dtype.kind in "iu" and array.itemsize == 1:
        raise TypeError(f"{name}: {array.dtype} is neither a mask (bool) nor indices (16 bits and more)")
    chosen = indices(array, name)
    if len(chosen) > 1 and len(chosen) == count and int(chosen.max()) <= 1:
        raise ValueError(
            f"{name}: {count} integers, all 0 or 1, are a mask or indices? Give a mask as bool, {name}.astype(bool), "
            f"or indices, np.flatnonzero({name})"
        )
    _each_once(chosen, name)
    return chosen


def _each_once(chosen: UInt32, name: str) -> None:
    values, counts = np.unique(chosen, return_counts=True)
    if len(values) < len(chosen):
        index = int(values[counts > 1][0])
        raise ValueError(
            f"{name}: index {index} is given {int(counts[counts > 1][0])} times; np.unique({name}) has each once"
        )


def points_view(array: Floats) -> _abi.fairmesh_points:
    """The library's view of what `points` returned. The array has to live as long."""
    return _abi.fairmesh_points(_address(array), len(array), _stride(array), _SCALARS[array.dtype], 0)


def numbers_view(array: Floats) -> _abi.fairmesh_numbers:
    """The library's view of what `numbers` returned. The array has to live as long."""
    return _abi.fairmesh_numbers(_address(array), len(array), _stride(array), _SCALARS[array.dtype], 0)


def indices_view(array: UInt32) -> _abi.fairmesh_indices:
    """The library's view of what `triangles` or `indices` returned. The array has to live as long."""
    return _abi.fairmesh_indices(_address(array), len(array), _stride(array))


def points_out(array: Floats) -> _abi.fairmesh_points_out:
    """The library's view of an array to be written."""
    return _abi.fairmesh_points_out(_address(array), len(array), _stride(array), _SCALARS[array.dtype], 0)


def scalars_out(array: Floats) -> _abi.fairmesh_scalars_out:
    """The library's view of an array to be written."""
    return _abi.fairmesh_scalars_out(_address(array), len(array), _stride(array), _SCALARS[array.dtype], 0)


class Mesh:
    """A mesh given, as the library reads it. Keeps the arrays alive."""

    def __init__(self, vertices: ArrayLike, faces: ArrayLike, coincident: Coincident | None = None) -> None:
        kind, within = _coincident(coincident)
        self.vertices = points(vertices, "vertices")
        self.faces, self.index_type = triangles(faces)
        self.struct = _abi.fairmesh_mesh(
            ctypes.sizeof(_abi.fairmesh_mesh), kind, points_view(self.vertices), indices_view(self.faces), within
        )


def _coincident(given: Coincident | None) -> tuple[int, float]:
    """The kind and the distance."""
    kinds = _abi.fairmesh_coincident
    if given is None or (isinstance(given, str) and given == "join"):
        return kinds.JOIN, 0.0
    if isinstance(given, str) and given == "separate":
        return kinds.SEPARATE, 0.0
    if isinstance(given, (bool, np.bool_)) or not isinstance(given, (int, float, np.integer, np.floating)):
        raise ValueError(f"coincident: {given!r} is neither 'join' nor 'separate' nor a distance")
    return kinds.JOIN, float(given)


def chosen_faces(given: ArrayLike, name: str, count: int) -> UInt32:
    """Indices of faces, from indices or a mask."""
    chosen = mask_or_indices(given, name, count)
    return np.flatnonzero(chosen).astype(np.uint32) if chosen.dtype == np.uint8 else chosen


class Region:
    """Which vertices may move, as the library reads it. Keeps the arrays alive."""

    def __init__(self, mesh: Mesh, free: Selection, fixed: Selection, free_faces: Selection) -> None:
        named = [n for n, v in (("free", free), ("fixed", fixed), ("free_faces", free_faces)) if v is not None]
        if len(named) > 1:
            raise ValueError(f"only one of {' and '.join(named)} can be given")
        kinds = _abi.fairmesh_selection_kind
        self.array: NDArray[Any] = np.empty(0, np.uint8)
        kind = kinds.INTERIOR
        if free is not None:
            self.array = mask_or_indices(free, "free", len(mesh.vertices))
            kind = kinds.FREE_MASK if self.array.dtype == np.uint8 else kinds.FREE_VERTICES
        elif fixed is not None:
            self.array = _fixed_mask(fixed, len(mesh.vertices))
            kind = kinds.FIXED_MASK
        elif free_faces is not None:
            self.array = chosen_faces(free_faces, "free_faces", len(mesh.faces))
            kind = kinds.FACES
        self.struct = _abi.fairmesh_selection(
            ctypes.sizeof(_abi.fairmesh_selection), kind, _address(self.array), len(self.array), _stride(self.array)
        )


def _fixed_mask(fixed: ArrayLike, count: int) -> NDArray[np.uint8]:
    chosen = mask_or_indices(fixed, "fixed", count)
    if chosen.dtype == np.uint8:
        return chosen
    outside = np.flatnonzero(chosen >= count)
    if len(outside):
        index = int(chosen[outside[0]])
        raise InputError(
            Status.SELECTION_OUT_OF_RANGE,
            f"the selection names element {index}, but there are only {count}",
            element_kind=ElementKind.VERTEX,
            element=index,
        )
    mask = np.zeros(count, np.uint8)
    mask[chosen] = 1
    return mask
