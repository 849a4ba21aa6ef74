"""Enumerations whose members say what they mean, and what to do."""

from __future__ import annotations

import enum
from typing import Any


class Numbered(enum.IntEnum):
    """Members are the numbers of the C interface."""

    #: What it means: English, begins in lower case, ends without a full stop.
    text: str
    #: What can be done about it, written like the text; empty if there is nothing to do.
    remedy: str

    def __new__(cls, number: int, text: str, remedy: str) -> Any:
        """A number with its texts."""
        made = int.__new__(cls, number)
        made._value_ = number
        made.text = text
        made.remedy = remedy
        return made

    @classmethod
    def of(cls, number: int) -> Any:
        """The member with the library's number; None if this package does not know it."""
        return next((member for member in cls if member == number), None)


class Named(str, enum.Enum):
    """Members are strings: their names in lower case."""

    #: The number in the C interface.
    number: int
    #: What it means: English, begins in lower case, ends without a full stop.
    text: str
    #: What can be done about it, written like the text; empty if there is nothing to do.
    remedy: str

    def __new__(cls, number: int, name: str, text: str, remedy: str) -> Any:
        """A name with its number and texts."""
        made = str.__new__(cls, name)
        made._value_ = name
        made.number = number
        made.text = text
        made.remedy = remedy
        return made

    def __str__(self) -> str:
        return str(self.value)

    @classmethod
    def of(cls, number: int) -> Any:
        """The member with the library's number; OTHER if this package does not know it."""
        for member in cls:
            if member.number == number:
                return member
        return cls["OTHER"]
