"""Results that can be pickled and copied: what is still in the library's memory is read first."""

from __future__ import annotations

from functools import cached_property
from typing import Any

from ._handles import ResultHandle


class Picklable:
    """An object that reads out of a `ResultHandle` when it is asked.

    Its pickle has everything that could be read, and no handle. The mesh of the kind given can be made of the copy.
    """

    def __getstate__(self) -> dict[str, Any]:
        """Reads what was not asked for yet."""
        lazy = {name for kind in type(self).__mro__ for name, member in vars(kind).items() if _is_read(name, member)}
        for name in sorted(lazy):
            getattr(self, name)
        return {name: value for name, value in vars(self).items() if not isinstance(value, ResultHandle)}


def _is_read(name: str, member: object) -> bool:
    return name != "mesh" and isinstance(member, cached_property)
