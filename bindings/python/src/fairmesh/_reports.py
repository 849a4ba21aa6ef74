"""How a run went, read from the library."""

from __future__ import annotations

import ctypes
from typing import TYPE_CHECKING, Any

from . import _abi
from ._options import Struct
from ._records import Component, Report, attempt_of, component_of, continuity_of, report_of

if TYPE_CHECKING:
    from collections.abc import Callable


def sized(struct: type[Struct]) -> Struct:
    """A struct that says its size."""
    made = struct()
    made.struct_size = ctypes.sizeof(struct)
    return made


def whole_report(struct: _abi.fairmesh_report, read: Callable[..., None]) -> Report:
    """The library's report; ``read(what, *numbers, struct)`` reads what it tells of components, attempts and loops."""
    components = tuple(_component(read, number) for number in range(struct.component_count))
    return report_of(struct, components=components)


def _component(read: Callable[..., None], number: int) -> Component:
    struct = _read(read, "component", number)
    attempts = (attempt_of(_read(read, "attempt", number, k)) for k in range(struct.attempt_count))
    loops = (continuity_of(_read(read, "continuity", number, k)) for k in range(struct.continuity_count))
    return component_of(struct, attempts=tuple(attempts), continuity=tuple(loops))


def _read(read: Callable[..., None], what: str, *numbers: int) -> Any:
    struct = sized(getattr(_abi, f"fairmesh_{what}"))
    read(what, *numbers, struct)
    return struct
