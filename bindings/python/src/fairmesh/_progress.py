"""How far a run is, and stopping it: callbacks, events, monitors."""

from __future__ import annotations

import itertools
import threading
import weakref
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any, Protocol, Union

import numpy as np

from . import _abi
from ._enums import Status
from ._errors import FairmeshError
from ._interrupts import Deferred, InCallback
from ._interrupts import pending as interrupted


@dataclass(frozen=True)
class Progress:
    """How far a run is, as a callback is told."""

    #: What is being done, in a word or two; English.
    phase: str
    #: Nonlinear iterations so far, of the component of the region that is at work.
    iteration: int
    #: Its last step norm, in diagonals of its bounding box; NaN before the first iteration.
    step_norm: float
    #: Between 0 and 1, never falling.
    fraction: float


class Event(Protocol):
    """What can cancel a run: ``threading.Event`` and the like."""

    def is_set(self) -> bool:
        """True: the run is to stop."""


class Monitor:
    """Watches and cancels a run from another thread, without a callback of one's own: give it as ``cancel``.

    All attributes can be read at any time. A monitor may be used for run after run; `reset` takes a cancellation back.
    """

    def __init__(self) -> None:
        self._last = Progress("", 0, float("nan"), 0.0)
        self._cancelled = False

    @property
    def fraction(self) -> float:
        """Between 0 and 1; never falling within a run."""
        return self._last.fraction

    @property
    def iteration(self) -> int:
        """Nonlinear iterations so far."""
        return self._last.iteration

    @property
    def step_norm(self) -> float:
        """The last step norm, in diagonals of the region's bounding box; NaN before the first iteration."""
        return self._last.step_norm

    @property
    def phase(self) -> str:
        """What is being done, in a word or two; English. Empty before the run."""
        return self._last.phase

    @property
    def is_cancelled(self) -> bool:
        """Has `cancel` been called?"""
        return self._cancelled

    def cancel(self) -> None:
        """Asks the run to stop. It ends before its next iteration, with the outcome CANCELLED."""
        self._cancelled = True

    def is_set(self) -> bool:
        """The same as `is_cancelled`, so that a monitor can stand where an event can."""
        return self.is_cancelled

    def reset(self) -> None:
        """As new: nothing cancelled, nothing done."""
        self.__init__()  # type: ignore[misc]

    def _tell(self, told: Progress) -> bool:
        self._last = told
        return self._cancelled


def _is_stopped(why: BaseException) -> bool:
    return isinstance(why, FairmeshError) and why.status is Status.CANCELLED


ProgressCallback = Callable[[Progress], Union[bool, None]]


class Relay:
    """Hands the library's callback on to what the caller gave, and keeps exceptions on this side of the library.

    It has to live as long as the library may call: the library knows it by the number `user_data` only. It is a context
    around each run, which one thread can enter at a time; what a callback threw is raised at its end.
    """

    def __init__(self, progress: ProgressCallback | None, cancel: Event | None) -> None:
        if progress is not None and not callable(progress):
            raise TypeError(f"progress: a callable is needed, not {type(progress).__name__}")
        if cancel is not None and not callable(getattr(cancel, "is_set", None)):
            raise TypeError(f"cancel: an object with is_set() is needed, not {type(cancel).__name__}")
        self._progress = progress
        self._cancel = cancel
        self._thrown: BaseException | None = None
        self._stopped = False
        self._running = threading.Lock()
        self._interrupts = Deferred()
        self._user_data = next(_numbers)
        _relays[self._user_data] = self

    def call(self, function: Callable[..., Any], *arguments: Any) -> Any:
        """Calls what takes the callback, and what it gets, as its last arguments."""
        with self:
            return function(*arguments, _tell, self._user_data)

    def install(self, options: _abi.fairmesh_options | _abi.fairmesh_remesh_options) -> None:
        """Puts the callback into the options."""
        options.progress = _tell
        options.user_data = self._user_data

    def __enter__(self) -> Relay:
        if not self._running.acquire(blocking=False):
            raise FairmeshError(Status.BUSY, "the solver is in use")
        self._thrown = None
        self._stopped = False
        self._interrupts.__enter__()
        return self

    def __exit__(self, kind: Any, why: BaseException | None, trace: Any) -> None:
        thrown, self._thrown = self._thrown, None
        self._running.release()
        try:
            self._interrupts.__exit__()
            # That the call was stopped is no news to who threw.
            if thrown is not None and (why is None or _is_stopped(why)):
                raise thrown from None
        finally:
            # No cycle of the exception and this frame.
            del thrown, why, trace

    def tell(self, progress: _abi.fairmesh_progress) -> int:
        """Called by the library. Not 0 stops the run."""
        # Who has asked to stop is not asked again.
        if not self._stopped:
            try:
                self._stopped = self._ask(progress) or interrupted()
            except BaseException as why:  # an interrupt too: it is raised at the end of the run
                self._thrown = why
                self._stopped = True
        return int(self._stopped)

    def _ask(self, progress: _abi.fairmesh_progress) -> bool:
        stop = False
        phase = (progress.phase or b"").decode("utf-8", "replace")
        told = Progress(phase, progress.iterations, progress.step, progress.fraction)
        if isinstance(self._cancel, Monitor):
            stop = self._cancel._tell(told)
        elif self._cancel is not None:
            with InCallback():
                stop = bool(self._cancel.is_set())
        if self._progress is not None:
            with InCallback():
                answer = self._progress(told)
            # Only False itself: what a progress bar's method happens to return is no wish to stop.
            stop = stop or (isinstance(answer, (bool, np.bool_)) and not answer)
        return stop


# One callback for all runs: user_data is the number of its relay. Weak: a solver that only its own callback still
# refers to can be collected.
_relays: weakref.WeakValueDictionary[int, Relay] = weakref.WeakValueDictionary()
_numbers = itertools.count(1)


def _dispatch(progress: Any, user_data: int) -> int:
    relay = _relays.get(user_data)
    return 1 if relay is None else relay.tell(progress.contents)


_tell = _abi.fairmesh_progress_fn(_dispatch)
