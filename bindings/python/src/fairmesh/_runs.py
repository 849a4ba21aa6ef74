"""What all functions that fair have in common: options, the region, callbacks, and the result."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from ._arrays import Mesh, Region, Selection
from ._handles import ResultHandle, result_of
from ._options import fairing_options
from ._progress import Relay
from ._seams import seams_told

if TYPE_CHECKING:
    from collections.abc import Mapping


def region_of(mesh: Mesh, free: Selection, keywords: Mapping[str, Any]) -> Region:
    """Which vertices may move."""
    return Region(mesh, free, keywords.get("fixed"), keywords.get("free_faces"))


def watched(keywords: Mapping[str, Any], function: str, *arguments: Any) -> ResultHandle:
    """Calls a function of the library that takes a callback before its result."""
    relay = Relay(keywords.get("progress"), keywords.get("cancel"))
    made: ResultHandle = relay.call(result_of, function, *arguments)
    return made


class Run:
    """A run on a mesh: its options with the callback in them, as the library reads them."""

    def __init__(self, mesh: Mesh, keywords: Mapping[str, Any]) -> None:
        self._mesh = mesh
        self.options = fairing_options(mesh.vertices, keywords)
        self.relay = Relay(keywords.get("progress"), keywords.get("cancel"))
        self.relay.install(self.options)

    def result(self, function: str, *arguments: Any) -> ResultHandle:
        """Calls a function of the library that takes the mesh first, and makes a result."""
        with seams_told(self._mesh), self.relay:
            return result_of(function, self._mesh.struct, *arguments)
