"""The forms of options that C takes as structs."""

from __future__ import annotations

from collections import abc
from typing import Any, Literal, Protocol, Union


class ArrayLike(Protocol):
    """What numpy makes an array of: an array of any package, a list, a tuple; no string.

    Where a type checker names numpy's own type of this name, it fills a page.
    """

    def __len__(self) -> int:
        """The number of rows."""

    def __getitem__(self, key: Any, /) -> Any:
        """A row."""

    def __contains__(self, key: object, /) -> bool:
        """Any object may be asked for, which tells it from a string."""


#: "fitted", "averaged", (n, 3) unit vectors with rows of zeros or NaN where none is given, or (indices, (k, 3)).
Normals = Union[Literal["fitted", "averaged"], ArrayLike, tuple[ArrayLike, ArrayLike]]
#: "auto" (g2 where it is certain), "g1", "g2", or a number from 0 (g1) to 1 (g2).
HowFar = Union[Literal["auto", "g1", "g2"], float]
#: "estimated", {index: H}, (indices, (k,)), or (n,) numbers with NaN where none is given.
Curvature = Union[Literal["estimated"], abc.Mapping[int, float], ArrayLike, tuple[ArrayLike, ArrayLike]]
#: {index of a vertex of the loop: "auto", "g1", "g2" or a number}.
LoopContinuity = abc.Mapping[int, HowFar]
#: "auto", "off", or an angle in degrees.
Sharp = Union[Literal["auto", "off"], float]
#: "auto", or a number of rings.
Rings = Union[Literal["auto"], int]
#: "harmonic", "minimal_energy", or a constant in 1 / length^3.
Target = Union[Literal["harmonic", "minimal_energy"], float]
