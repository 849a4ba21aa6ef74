"""Which loops are filled, and which of them together: keyword arguments to the library's options."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _abi, _arrays
from ._options import initial, real, whole

if TYPE_CHECKING:
    from ._keywords import Join, LoopChoice, Place


class Choice:
    """The library's options of hole filling, as far as they say which loops. Keeps the lists alive."""

    def __init__(self, given: LoopChoice, join: Join | None = None) -> None:
        self.struct = initial(_abi.fairmesh_fill_options)
        self._alive: list[NDArray[Any]] = []
        self._join(join)
        self._listed(given.get("loops"))
        edges = given.get("max_edges")
        if edges is not None:
            self.struct.max_edges = whole(edges, "max_edges")
        for name in ("max_length", "max_area", "max_diagonal"):
            bound = given.get(name)
            if bound is not None:
                setattr(self.struct.filter, name, _bound(bound, name))
        but = given.get("except_longest")
        if but is not None:
            self.struct.filter.except_longest = whole(but, "except_longest")
        of = given.get("of_components")
        if of is not None:
            named = _arrays.indices(of, "of_components")
            if len(named) == 0:
                raise ValueError("of_components: no component is named; None takes all holes")
            self.struct.filter.components = self._kept(named)
        within = given.get("within")
        if within is not None:
            self.struct.filter.within = _place(within)

    def _kept(self, indices: NDArray[np.uint32]) -> _abi.fairmesh_indices:
        self._alive.append(indices)
        return _arrays.indices_view(indices)

    def _join(self, join: Join | None) -> None:
        kinds = _abi.fairmesh_join_kind
        if join is None or (isinstance(join, str) and join == "none"):
            return
        if isinstance(join, str):
            if join != "auto":
                raise ValueError(f"join: {join!r} is neither 'none' nor 'auto' nor groups of loops")
            self.struct.join.kind = kinds.AUTO
            return
        if any(np.ndim(group) != 1 for group in join):
            raise ValueError("join: groups of loops are needed, such as [[0, 1], [2, 5]]")
        groups = [_arrays.indices(group, "join") for group in join]
        starts = np.cumsum([0, *(len(group) for group in groups)])[:-1].astype(np.uint32)
        self.struct.join.kind = kinds.GROUPS
        self.struct.join.loops = self._kept(np.concatenate([np.empty(0, np.uint32), *groups]))
        self.struct.join.starts = self._kept(starts)

    def _listed(self, loops: ArrayLike | None) -> None:
        is_grouped = self.struct.join.kind == _abi.fairmesh_join_kind.GROUPS
        if loops is None:
            self.struct.only_listed = int(is_grouped)
            return
        if isinstance(loops, str):
            if loops != "all":
                raise ValueError(f"loops: {loops!r} is neither 'all' nor a list of loops")
            return
        listed = _arrays.indices(loops, "loops")
        if len(listed) == 0 and not is_grouped:
            raise ValueError("loops: no loop is named; None fills all holes")
        self.struct.only_listed = 1
        self.struct.loops = self._kept(listed)


def _bound(given: Any, name: str) -> float:
    """For the library, 0 is no bound; here it is one that nothing meets."""
    bound = real(given, name)
    return bound if bound != 0.0 else float(np.finfo(float).tiny)


def _place(given: Place) -> _abi.fairmesh_place:
    kinds = _abi.fairmesh_place_kind
    if not isinstance(given, (tuple, list)) or len(given) != 2:
        raise ValueError("within: a ball (centre, radius) or a box (low, high) is needed")
    first = _arrays.numbers(given[0], "within", rows=3).astype(float)
    place = _abi.fairmesh_place()
    if np.ndim(given[1]) == 0:
        place.kind, place.centre, place.radius = kinds.BALL, tuple(first), real(given[1], "within")
    else:
        second = _arrays.numbers(given[1], "within", rows=3).astype(float)
        place.kind, place.low, place.high = kinds.BOX, tuple(first), tuple(second)
    return place
