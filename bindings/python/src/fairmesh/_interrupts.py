"""Ctrl-C during a call of the library."""

from __future__ import annotations

import signal
import threading
from typing import Any


class _State:
    """Of the main thread, the only one that Python runs signal handlers on."""

    pending = False
    in_callback = False


def pending() -> bool:
    """Has Ctrl-C been pressed during this call, which runs on the main thread?"""
    return _State.pending and threading.current_thread() is threading.main_thread()


def _handle(number: int, frame: Any) -> None:
    # In the caller's own code it is raised at once. Elsewhere it would be raised at the first instruction of the
    # function that ctypes calls, outside of any `try`, and ctypes drops what it gets.
    if _State.in_callback:
        signal.default_int_handler(number, frame)
    _State.pending = True


class Deferred:
    """A context in which Ctrl-C is noted, and raised at its end.

    On other threads, and where the program has a handler of its own, it does nothing.
    """

    def __enter__(self) -> Deferred:
        self._active = (
            threading.current_thread() is threading.main_thread()
            and signal.getsignal(signal.SIGINT) is signal.default_int_handler
        )
        if self._active:
            _State.pending = False
            signal.signal(signal.SIGINT, _handle)
        return self

    def __exit__(self, *_: object) -> None:
        if self._active:
            signal.signal(signal.SIGINT, signal.default_int_handler)
            noted, _State.pending = _State.pending, False
            if noted:
                raise KeyboardInterrupt


class InCallback:
    """A context around the caller's own code on the main thread: there, Ctrl-C is raised at once."""

    def __enter__(self) -> None:
        self._main = threading.current_thread() is threading.main_thread()
        if self._main:
            self._outer, _State.in_callback = _State.in_callback, True

    def __exit__(self, *_: object) -> None:
        if self._main:
            _State.in_callback = self._outer
