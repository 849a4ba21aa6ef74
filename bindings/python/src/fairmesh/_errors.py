"""What is raised when a call was refused."""

from __future__ import annotations

import ctypes
import enum
import re
from typing import Any, NoReturn

from . import _abi
from ._enums import Status
from ._library import Library


class ElementKind(str, enum.Enum):
    """What ``FairmeshError.element`` counts."""

    NONE = "none"
    VERTEX = "vertex"
    TRIANGLE = "triangle"
    #: ``element`` and ``other`` are the edge's vertices, the smaller first.
    EDGE = "edge"
    #: A parameter; ``argument`` is its name.
    ARGUMENT = "argument"
    LOOP = "loop"


class FairmeshError(Exception):
    """The library refused a call. Nothing was written.

    ``status`` says why (`Status`). ``element_kind`` and ``element`` say which vertex, triangle, edge or loop is to
    blame, ``other`` is a second index where the status has one (the vertex that a triangle names wrongly, the other end
    of an edge); both are None where there is none. ``argument`` is the name of the parameter to blame, or None.
    """

    def __init__(
        self,
        status: Status,
        message: str,
        *,
        element_kind: ElementKind = ElementKind.NONE,
        element: int | None = None,
        other: int | None = None,
        argument: str | None = None,
    ) -> None:
        super().__init__(message)
        self.status = status
        self.message = message
        self.element_kind = element_kind
        self.element = element
        self.other = other
        self.argument = argument

    def __reduce__(self) -> tuple[Any, ...]:
        """For pickles: an exception is made of its message alone, and then has what it says else."""
        return _made, (type(self), self.message), vars(self)

    def add_advice(self, advice: str) -> None:
        """Puts more at the end of the message, if there is more to say."""
        if advice:
            self.message = f"{self.message}; {advice}"
            self.args = (self.message,)

    @property
    def option(self) -> str | None:
        """The name of the option that is out of its range, or None."""
        return self.argument if self.status in (Status.BAD_OPTION, Status.BAD_ENUM) else None

    @property
    def remedy(self) -> str:
        """What can be done about it: English, begins in lower case; empty if there is nothing to do."""
        return self.status.remedy


def _made(kind: type[FairmeshError], message: str) -> FairmeshError:
    return kind(Status.INTERNAL, message)


class InputError(FairmeshError, ValueError):
    """The mesh, the selection, a normal or an option is wrong."""


class OutOfMemoryError(FairmeshError, MemoryError):
    """Memory ran out; everything that the call had allocated is free again."""


_KNOWN = {int(member): member for member in Status}
_KINDS = {int(member): ElementKind[member.name] for member in _abi.fairmesh_element}
# C structs and fields that are called otherwise in Python.
_C_ARGUMENT = re.compile(r"^argument \d+(, [\w.]+)?: ")
_NAMES = {"positions": "vertices", "triangles": "faces", "components": "of_components"}


def call(library: Library, name: str, *arguments: Any) -> None:
    """Calls a function of the library that ends with a `fairmesh_error`; raises what it was refused with."""
    why = _abi.fairmesh_error()
    status = getattr(library, name)(*arguments, why)
    if status != Status.OK:
        _refuse(name, status, why)


def error_of(name: str, status: int, why: _abi.fairmesh_error) -> FairmeshError:
    """The exception for a refused call of the function ``name``."""
    known = _KNOWN.get(status, Status.INTERNAL)
    kind = _KINDS.get(why.element_kind, ElementKind.NONE)
    element = None if why.element == _abi.NO_ELEMENT else why.element
    other = None if why.other == _abi.NO_ELEMENT else why.other
    message = why.message.decode("utf-8", "replace")
    if not message:
        message = f"unknown status {status}" if status not in _KNOWN else known.text
    argument = None
    if kind is ElementKind.ARGUMENT and element is not None:
        # Numbers of C arguments and offsets of fields say nothing to Python programs.
        argument = _argument(name, element, other)
        element = other = None
        if argument is not None:
            message = _C_ARGUMENT.sub(f"{argument}: ", message)
    if known is Status.OUT_OF_MEMORY:
        made: type[FairmeshError] = OutOfMemoryError
    else:
        made = InputError if known.is_input_error else FairmeshError
    return made(known, message, element_kind=kind, element=element, other=other, argument=argument)


def _refuse(name: str, status: int, why: _abi.fairmesh_error) -> NoReturn:
    raise error_of(name, status, why)


def _argument(function: str, number: int, offset: int | None) -> str | None:
    """The Python name of a function's argument (from 1), or of the field of its struct at ``offset``."""
    if (function, number) == ("fairmesh_solver_run", 2):
        return "iterations"
    struct = getattr(_abi.FUNCTIONS[function][1][number - 1], "_type_", None)
    if offset is None or not (isinstance(struct, type) and issubclass(struct, ctypes.Structure)):
        return None
    for field in reversed(struct._fields_):
        start = getattr(struct, field[0]).offset
        if start <= offset:
            if field[1] is _abi.fairmesh_loop_filter:
                return _field(field[1], offset - start)
            return _NAMES.get(field[0], field[0])
    return None


def _field(struct: type[ctypes.Structure], offset: int) -> str:
    """The Python name of the field of a struct at ``offset``."""
    names = [field[0] for field in struct._fields_ if getattr(struct, field[0]).offset <= offset]
    return _NAMES.get(names[-1], names[-1])
