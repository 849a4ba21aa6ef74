"""Finds the shared library, checks that it is the right one, and declares its functions."""

from __future__ import annotations

import ctypes
import ctypes.util
import os
import sys
import threading
from pathlib import Path
from typing import Any, Union

from . import _abi

ENVIRONMENT = "FAIRMESH_LIBRARY"

PathLike = Union[str, "os.PathLike[str]"]


class LibraryError(OSError):
    """The shared library was not found, is of another version, or is no fairmesh library. The message has the path."""


class Library:
    """The shared library. ``path`` is where it is, ``version`` its own version, such as "0.1.0".

    Attributes named as the C functions call them; that releases the interpreter lock.
    """

    def __init__(self, path: PathLike) -> None:
        self.path = os.fspath(path)
        try:
            self._cdll = ctypes.CDLL(self.path)
        except OSError as why:
            raise LibraryError(f"cannot load the fairmesh library {self.path}: {why}") from why
        self._check_version()
        for name, (result, parameters) in _abi.FUNCTIONS.items():
            setattr(self, name, self._declare(name, result, parameters))

    def _declare(self, name: str, result: Any, parameters: tuple[Any, ...]) -> Any:
        try:
            function = getattr(self._cdll, name)
        except AttributeError:
            raise LibraryError(f"{self.path} is no fairmesh library: it has no function {name}") from None
        function.restype = result
        function.argtypes = parameters
        return function

    def _check_version(self) -> None:
        number = self._declare("fairmesh_version", *_abi.FUNCTIONS["fairmesh_version"])()
        major, minor, patch = number >> 16, number >> 8 & 0xFF, number & 0xFF
        self.version = f"{major}.{minor}.{patch}"
        # Before 1.0 the minor version may change anything.
        if major != _abi.VERSION_MAJOR or (major == 0 and minor != _abi.VERSION_MINOR):
            wanted = f"{_abi.VERSION_MAJOR}.{_abi.VERSION_MINOR}"
            raise LibraryError(f"the fairmesh library {self.path} has version {self.version}, but {wanted} is needed")

    def __getattr__(self, name: str) -> Any:
        raise AttributeError(name)

    def __repr__(self) -> str:
        return f"<fairmesh library {self.version} at {self.path}>"


def file_name() -> str:
    """What the shared library is called on this system."""
    if sys.platform == "win32":
        return "fairmesh.dll"
    return "libfairmesh.dylib" if sys.platform == "darwin" else "libfairmesh.so"


def _find() -> Library:
    """The library that the environment names; else the one beside this package; else the system's."""
    named = os.environ.get(ENVIRONMENT)
    if named:
        return Library(named)
    beside = Path(__file__).resolve().parent / "lib" / file_name()
    if beside.exists():
        return Library(beside)
    system = ctypes.util.find_library("fairmesh")
    if system:
        return Library(system)
    raise LibraryError(
        f"the fairmesh library was not found: {ENVIRONMENT} is not set, there is no {beside}, "
        "and the system has no library fairmesh"
    )


_lock = threading.Lock()
_loaded: Library | None = None


def load(path: PathLike | None = None) -> Library:
    """Loads the shared library and returns it.

    Without ``path``: the one in use; if there is none yet, the file that ``FAIRMESH_LIBRARY`` names, else the file
    ``lib/libfairmesh.so`` beside this package (``fairmesh.dll``, ``libfairmesh.dylib``), else the system's. With
    ``path``: that file, which is used from now on. It is not necessary to call this: every function does.

    Raises:
        LibraryError: not found, of another version, or no fairmesh library.

    """
    global _loaded
    with _lock:
        if path is not None:
            _loaded = Library(path)
        elif _loaded is None:
            _loaded = _find()
        return _loaded


def version() -> str:
    """The version of the shared library in use, such as "0.1.0"."""
    return load().version
