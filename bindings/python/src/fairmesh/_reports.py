"""How a run went, read from the library."""

from __future__ import annotations

import ctypes
from typing import TYPE_CHECKING, Any

from . import _abi
from ._options import Struct
from ._records import (
    Component,
    Report,
    SharpEdge,
    attempt_of,
    component_of,
    continuity_of,
    crease_end_of,
    report_of,
    sharp_edge_of,
)

if TYPE_CHECKING:
    from collections.abc import Callable

    import numpy as np
    from numpy.typing import NDArray


def sized(struct: type[Struct]) -> Struct:
    """A struct that says its size."""
    made = struct()
    made.struct_size = ctypes.sizeof(struct)
    return made


def whole_report(
    struct: _abi.fairmesh_report, read: Callable[..., None], sharp_vertices: Callable[[], NDArray[np.intp]]
) -> Report:
    """The library's report; ``read(what, *numbers, struct)`` reads the other structs."""
    components = tuple(_component(read, number) for number in range(struct.component_count))
    along = sharp_vertices()
    edges = (_sharp_edge(read, number, along) for number in range(struct.sharp_edge_count))
    return report_of(struct, components=components, sharp_edges=tuple(edges))


def _component(read: Callable[..., None], number: int) -> Component:
    struct = _read(read, "component", number)
    attempts = (attempt_of(_read(read, "attempt", number, k)) for k in range(struct.attempt_count))
    loops = (continuity_of(_read(read, "continuity", number, k)) for k in range(struct.continuity_count))
    return component_of(struct, attempts=tuple(attempts), continuity=tuple(loops))


def _sharp_edge(read: Callable[..., None], number: int, along: NDArray[np.intp]) -> SharpEdge:
    struct = _read(read, "sharp_edge", number)
    ends = (crease_end_of(_read(read, "crease_end", number, k)) for k in range(struct.end_count))
    vertices = along[struct.first_vertex : struct.first_vertex + struct.vertex_count]
    return sharp_edge_of(struct, ends=tuple(ends), vertices=vertices)


def _read(read: Callable[..., None], what: str, *numbers: int) -> Any:
    struct = sized(getattr(_abi, f"fairmesh_{what}"))
    read(what, *numbers, struct)
    return struct
