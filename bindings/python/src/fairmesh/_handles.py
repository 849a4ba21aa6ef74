"""Results in the library's memory, and reading arrays out of them."""

from __future__ import annotations

import ctypes
import weakref
from typing import Any

import numpy as np
from numpy.typing import NDArray

from . import _abi, _arrays
from ._errors import call
from ._library import Library, load
from ._records import Report
from ._reports import sized, whole_report


class ResultHandle:
    """A `fairmesh_result`, freed with this object. Any number of threads may read it."""

    def __init__(self, library: Library, address: ctypes.c_void_p) -> None:
        self.library = library
        self.address = address
        # Not at the end of the program: the memory goes anyway, and the library may be gone before.
        weakref.finalize(self, library.fairmesh_result_free, address).atexit = False

    def read(self, function: str, *arguments: Any) -> None:
        """Calls a getter."""
        call(self.library, function, self.address, *arguments)

    def info(self) -> _abi.fairmesh_info:
        """The sizes."""
        made = sized(_abi.fairmesh_info)
        self.read("fairmesh_result_info", made)
        return made

    def report(self, index: int = 0) -> Report:
        """The report of the fairing (of the loop with this index)."""
        made = sized(_abi.fairmesh_report)
        self.read("fairmesh_result_report", index, made)
        return whole_report(
            made,
            lambda what, *numbers: self.read(f"fairmesh_result_{what}", index, *numbers),
            lambda: self.list(_abi.fairmesh_list.SHARP_VERTICES, index),
        )

    def positions(self, count: int, dtype: np.dtype[Any]) -> NDArray[Any]:
        """All vertices, (count, 3)."""
        made = np.empty((count, 3), dtype)
        self.positions_into(made)
        return made

    def positions_into(self, out: NDArray[Any]) -> None:
        """All vertices, into an array that `_arrays.points_out` can view."""
        self.read("fairmesh_result_positions", _arrays.points_out(out))

    def triangles(self, count: int, dtype: np.dtype[Any]) -> NDArray[Any]:
        """All triangles, (count, 3)."""
        made = np.empty((count, 3), np.uint32)
        view = _abi.fairmesh_indices_out(made.ctypes.data if count else None, count, 0)
        self.read("fairmesh_result_triangles", view)
        return made.astype(dtype, copy=False)

    def scalars(self, which: _abi.fairmesh_scalars, count: int) -> NDArray[np.float64]:
        """Numbers per vertex, (count,)."""
        made = np.empty(count)
        self.read("fairmesh_result_scalars", which, _arrays.scalars_out(made))
        return made

    def vectors(self, which: _abi.fairmesh_vectors, count: int) -> NDArray[np.float64]:
        """Vectors, (count, 3)."""
        made = np.empty((count, 3))
        self.read("fairmesh_result_vectors", which, _arrays.points_out(made))
        return made

    def list(self, which: _abi.fairmesh_list, index: int = 0) -> NDArray[np.intp]:
        """A list of indices, ready to index numpy arrays."""
        size = ctypes.c_size_t()
        self.read("fairmesh_result_list", which, index, None, 0, size)
        made = np.empty(size.value, np.uint32)
        if size.value:
            self.read("fairmesh_result_list", which, index, made.ctypes.data, size.value, size)
        return made.astype(np.intp)


def result_of(function: str, *arguments: Any) -> ResultHandle:
    """Calls a function of the library that makes a result; without its last argument, which the result is put into."""
    library, address = load(), ctypes.c_void_p()
    call(library, function, *arguments, address)
    return ResultHandle(library, address)
