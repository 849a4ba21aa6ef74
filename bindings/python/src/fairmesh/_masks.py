"""Masks of faces that say that they are such."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

if TYPE_CHECKING:
    Mask = np.ndarray[Any, np.dtype[np.bool_]]
else:
    # Not of any numpy an array's type can be named when the program runs.
    Mask = np.ndarray


class FaceMask(Mask):
    """A bool array (m,), one for each face of a mesh, as the functions `select_ball`, ... return it.

    Masks are combined with ``|``, ``&`` and ``~``; where a function takes ``free`` vertices, it takes such a mask as
    ``free_faces``.
    """

    def __array_finalize__(self, _: Any) -> None:
        """What is made of masks is one as well."""

    def __array_wrap__(self, array: Any, context: Any = None, return_scalar: bool = False) -> Any:
        """Sums, comparisons and the like are plain arrays or numbers."""
        del context
        if array.dtype == np.bool_ and array.ndim == 1:
            return array.view(FaceMask)
        return array[()] if return_scalar or array.ndim == 0 else array.view(np.ndarray)
