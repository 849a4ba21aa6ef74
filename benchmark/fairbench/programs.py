"""The programs that take part: each a folder with an adapter, what it needs, and what it can do."""

from __future__ import annotations

from pathlib import Path
from typing import NamedTuple

import tomllib

FOLDER = Path(__file__).resolve().parent.parent / "programs"


class Program(NamedTuple):
    """A program, or one of its ways of working."""

    name: str
    folder: Path
    tasks: tuple[str, ...]
    arguments: tuple[str, ...]
    #: What its own word of success is.
    says: str
    #: What of it is used: its documented best for these tasks.
    best: str
    #: Whether its packages do not go together with the others.
    own_environment: bool


def programs() -> list[Program]:
    """All, in the order of their folders."""
    found = []
    for path in sorted(FOLDER.glob("*/program.toml")):
        told = tomllib.loads(path.read_text())
        for variant, arguments in told.get("variants", {"": []}).items():
            name = f"{told['name']} {variant}".strip()
            own = told.get("own_environment", False)
            found.append(Program(name, path.parent, tuple(told["tasks"]), tuple(arguments), told["says"], told["best"], own))
    return found
