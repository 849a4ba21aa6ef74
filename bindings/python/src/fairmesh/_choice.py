"""Which loops are filled, and which of them together: keyword arguments to the library's options."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Literal

import numpy as np

from . import _abi, _arrays
from ._forms import ArrayLike
from ._options import initial, keep, real, whole

if TYPE_CHECKING:
    from ._keywords import Join, LoopChoice, Place


def loop_choice(given: LoopChoice, join: Join | None = None) -> _abi.fairmesh_fill_options:
    """The library's options of hole filling, as far as they say which loops."""
    struct = initial(_abi.fairmesh_fill_options)
    bounds = struct.filter
    _join(struct, join)
    _listed(struct, given.get("loops"))
    edges = given.get("max_edges")
    if edges is not None:
        struct.max_edges = whole(edges, "max_edges")
    for name in ("max_length", "max_area", "max_diagonal"):
        bound = given.get(name)
        if bound is not None:
            setattr(bounds, name, _bound(bound, name))
    but = given.get("except_longest")
    if but is not None:
        bounds.except_longest = whole(but, "except_longest")
    of = given.get("of_components")
    if of is not None:
        named = _arrays.indices(of, "of_components")
        if len(named) == 0:
            raise ValueError("of_components: no component is named; None takes all holes")
        bounds.components = _arrays.indices_view(named)
        keep(struct, named)
    within = given.get("within")
    if within is not None:
        bounds.within = _place(within)
    return struct


def _join(struct: _abi.fairmesh_fill_options, join: Join | None) -> None:
    kinds = _abi.fairmesh_join_kind
    if join is None or (isinstance(join, str) and join == "none"):
        return
    if isinstance(join, str):
        if join != "auto":
            raise ValueError(f"join: {join!r} is neither 'none' nor 'auto' nor groups of loops")
        struct.join.kind = kinds.AUTO
        return
    if any(np.asarray(group).ndim != 1 for group in join):
        raise ValueError("join: groups of loops are needed, such as [[0, 1], [2, 5]]")
    groups = [_arrays.indices(group, "join") for group in join]
    starts = np.cumsum([0, *(len(group) for group in groups)])[:-1].astype(np.uint32)
    loops = np.concatenate([np.empty(0, np.uint32), *groups])
    views = (_arrays.indices_view(loops), _arrays.indices_view(starts))
    struct.join.kind, (struct.join.loops, struct.join.starts) = kinds.GROUPS, views
    keep(struct, loops, starts)


def _listed(struct: _abi.fairmesh_fill_options, loops: ArrayLike | Literal["all"] | None) -> None:
    is_grouped = struct.join.kind == _abi.fairmesh_join_kind.GROUPS
    if loops is None:
        struct.only_listed = int(is_grouped)
        return
    if isinstance(loops, str):
        if loops != "all":
            raise ValueError(f"loops: {loops!r} is neither 'all' nor a list of loops")
        return
    listed = _arrays.indices(loops, "loops")
    if len(listed) == 0 and not is_grouped:
        raise ValueError("loops: no loop is named; None fills all holes")
    struct.only_listed = 1
    struct.loops = _arrays.indices_view(listed)
    keep(struct, listed)


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
    if np.asarray(given[1]).ndim == 0:
        place.kind, place.centre, place.radius = kinds.BALL, tuple(first), real(given[1], "within")
    else:
        second = _arrays.numbers(given[1], "within", rows=3).astype(float)
        place.kind, place.low, place.high = kinds.BOX, tuple(first), tuple(second)
    return place
