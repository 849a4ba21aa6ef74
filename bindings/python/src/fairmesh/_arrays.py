"""numpy arrays to the library's views and back. Arrays that the library can read where they are, are not copied."""

from __future__ import annotations

import ctypes
from typing import Any, Literal, Union

import numpy as np
from numpy.typing import NDArray

from . import _abi
from ._enums import Status
from ._errors import ElementKind, InputError
from ._forms import ArrayLike
from ._hosts import Host, Pair

Floats = NDArray[Any]
Indices = NDArray[Any]
UInt32 = NDArray[np.uint32]
Float64 = NDArray[np.float64]
#: A mask of bool or of 0 and 1, indices, or the name of a mask that the mesh has.
Selection = Union[ArrayLike, str, None]
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
    "region": ElementKind.TRIANGLE,
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


def points(given: ArrayLike, name: str, *, rows: int | None = None) -> Floats:
    """Points or vectors, (n, 3), float32 or float64; other real numbers become float64."""
    array = _floats(given, name)
    if array.shape == (0,):
        return np.empty((0, 3), array.dtype)
    if array.ndim != 2 or array.shape[1] != 3:
        raise ValueError(f"{name}: the shape has to be (n, 3), not {array.shape}")
    if rows is not None and len(array) != rows:
        raise ValueError(f"{name}: {len(array)} rows, but {rows} are needed")
    return array if _readable(array) else _packed(array)


def _floats(given: ArrayLike | float, name: str) -> Floats:
    """float32 or float64 in native byte order; other real numbers become float64."""
    array = np.asarray(given)
    native = array.dtype.newbyteorder("=")
    if native not in _SCALARS:
        if native.kind not in "iuf":
            raise TypeError(f"{name}: real numbers are needed, not {array.dtype}")
        native = np.dtype(np.float64)
    return array.astype(native, copy=False)


def point(given: ArrayLike | int, name: str) -> NDArray[np.float64]:
    """Three real numbers."""
    array = _floats(given, name)
    if array.shape != (3,):
        raise ValueError(f"{name}: the shape has to be (3,), not {array.shape}")
    return array.astype(np.float64)


def numbers(given: ArrayLike | float, name: str, *, rows: int) -> Floats:
    """Real numbers, (rows,), float32 or float64; others become float64."""
    array = _floats(given, name)
    if array.ndim != 1:
        raise ValueError(f"{name}: the shape has to be (k,), not {array.shape}")
    if len(array) != rows:
        raise ValueError(f"{name}: {len(array)} numbers, but {rows} are needed")
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
    """A mask as uint8, or indices as uint32, each once.

    Integers that are all 0 or 1, as many as a mask has entries, are a mask: as indices they would be given twice.
    """
    array = np.asarray(given)
    if array.dtype == np.bool_:
        if array.shape != (count,):
            raise ValueError(f"{name}: a mask has to have the shape ({count},), not {array.shape}")
        mask = array.view(np.uint8)
        return mask if _readable(mask) else _packed(mask)
    if array.shape == (count,) and count > 2 and array.dtype.kind in "iu" and _is_zero_or_one(array):
        return array.astype(np.uint8)
    if array.dtype.kind in "iu" and array.itemsize == 1:
        raise TypeError(
            f"{name}: {array.dtype} is neither a mask (bool, or {count} times 0 or 1) nor indices (16 bits and more)"
        )
    if array.dtype.kind == "f" and array.size > 0:
        raise TypeError(f"{name}: a mask of bool or indices of integers are needed, not {array.dtype}")
    chosen = indices(array, name)
    if len(chosen) > 2 and int(chosen.max()) <= 1:
        raise ValueError(f"{name}: a mask of 0 and 1 has to have {count} entries, not {len(chosen)}")
    if len(chosen) == count == 2 and sorted(chosen.tolist()) == [0, 1]:
        raise ValueError(f"{name}: {array.tolist()} can be a mask or indices; give a mask as bool")
    _each_once(chosen, name)
    return chosen


def _is_zero_or_one(array: NDArray[Any]) -> bool:
    return bool(((array == 0) | (array == 1)).all())


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


def list_view(array: UInt32 | None) -> _abi.fairmesh_indices | None:
    """The library's view of what `indices` returned, if there is a list. The array has to live as long."""
    return None if array is None else indices_view(array)


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
    """A mesh given, as the library reads it. Keeps the arrays alive.

    ``given`` is a host, or vertices that belong to ``faces``.
    """

    def __init__(self, given: Any, faces: Any, coincident: Coincident | None = None) -> None:
        self._coincident = _coincident(coincident)
        self.host: Host = given if isinstance(given, Host) else Pair(given, faces)
        self.vertices = points(self.host.vertices, "vertices")
        self.faces, self.index_type = triangles(self.host.faces)

    @property
    def struct(self) -> _abi.fairmesh_mesh:
        """The library's view of it."""
        kind, within = self._coincident
        views = points_view(self.vertices), indices_view(self.faces)
        return _abi.fairmesh_mesh(ctypes.sizeof(_abi.fairmesh_mesh), kind, *views, within)


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


def chosen_faces(mesh: Mesh, given: Any, name: str) -> UInt32:
    """Indices of faces, from indices, a mask, or the name of a mask that the mesh has."""
    if isinstance(given, str):
        given = _named(mesh, given, name, of_faces=True)
    chosen = mask_or_indices(given, name, len(mesh.faces))
    return np.flatnonzero(chosen).astype(np.uint32) if chosen.dtype == np.uint8 else chosen


def chosen_vertices(mesh: Mesh, given: Any, name: str) -> NDArray[Any]:
    """A mask of vertices as uint8, or indices as uint32, from either, or the name of a mask that the mesh has."""
    if isinstance(given, str):
        given = _named(mesh, given, name, of_faces=False)
    return mask_or_indices(given, name, len(mesh.vertices))


def _named(mesh: Mesh, key: str, name: str, *, of_faces: bool) -> NDArray[Any]:
    """A mask that the mesh has under a name: of bool, or whole numbers, in any type, of which 0 is not chosen."""
    host = mesh.host
    found, where = (
        (host.face_data(key), host.face_data_name) if of_faces else (host.vertex_data(key), host.vertex_data_name)
    )
    if found is None:
        what = f"the {where} of the mesh have no {key!r}" if where else f"arrays have no names such as {key!r}"
        raise ValueError(f"{name}: {what}")
    array = np.asarray(found)
    if array.ndim == 2 and array.shape[1] == 1:
        array = array[:, 0]
    if array.shape == (len(mesh.faces if of_faces else mesh.vertices),):
        if array.dtype == np.bool_ or (array.dtype.kind in "iuf" and _is_zero_or_one(array)):
            return array.astype(bool)
        raise ValueError(f"{name}: {key!r} of the mesh is no mask: it has values that are neither 0 nor 1")
    return array


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
            _no_faces(free, "free", mesh)
            self.array = chosen_vertices(mesh, free, "free")
            kind = kinds.FREE_MASK if self.array.dtype == np.uint8 else kinds.FREE_VERTICES
        elif fixed is not None:
            _no_faces(fixed, "fixed", mesh)
            self.array = _fixed_mask(chosen_vertices(mesh, fixed, "fixed"), len(mesh.vertices))
            kind = kinds.FIXED_MASK
        elif free_faces is not None:
            self.array = chosen_faces(mesh, free_faces, "free_faces")
            kind = kinds.FACES
        self.struct = _abi.fairmesh_selection(
            ctypes.sizeof(_abi.fairmesh_selection), kind, _address(self.array), len(self.array), _stride(self.array)
        )


def _no_faces(given: Any, name: str, mesh: Mesh) -> None:
    """Tells those who give a mask of faces where one of vertices is meant."""
    if getattr(given, "dtype", None) == np.bool_ and np.shape(given) == (len(mesh.faces),) != (len(mesh.vertices),):
        raise ValueError(
            f"{name}: a mask has to have the shape ({len(mesh.vertices)},), not ({len(mesh.faces)},); "
            "a mask of faces is given as free_faces"
        )


def _fixed_mask(chosen: NDArray[Any], count: int) -> NDArray[np.uint8]:
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
