"""Callbacks, cancelling, monitors, interrupts."""

import gc
import math
import subprocess
import sys
import threading
import time
import weakref
from pathlib import Path

import numpy as np
import pytest

import fairmesh
from meshes import dented_sphere, sphere_with_hole

VERTICES, FACES, FREE, _ = dented_sphere()
HOLE = sphere_with_hole()
CALLS = {
    "fair": lambda **how: fairmesh.fair(VERTICES, FACES, free=FREE, **how),
    "fill_holes": lambda **how: fairmesh.fill_holes(*HOLE, **how),
    "Solver": lambda **how: fairmesh.Solver(VERTICES, FACES, free=FREE, **how).run(),
}


@pytest.mark.parametrize("call", CALLS.values(), ids=CALLS)
def test_what_a_callback_is_told(call):
    seen = []
    call(progress=seen.append)
    assert len(seen) > 5 and all(isinstance(told, fairmesh.Progress) for told in seen)
    fractions = [told.fraction for told in seen]
    assert fractions == sorted(fractions)
    assert fractions[0] >= 0
    assert fractions[-1] <= 1
    assert all(told.phase for told in seen)
    before = [told for told in seen if told.iteration == 0]
    after = [told for told in seen if told.iteration > 0]
    assert all(math.isnan(told.step_norm) for told in before)
    assert after and all(told.step_norm > 0 for told in after)


WITHOUT_RESULT = {
    "remesh": lambda **how: fairmesh.remesh(VERTICES, FACES, FREE, **how),
    "self_intersections": lambda **how: fairmesh.self_intersections(VERTICES, FACES, **how),
    "carry_over": lambda **how: fairmesh.carry_over(VERTICES, FACES, VERTICES, **how),
    "select_geodesic": lambda **how: fairmesh.select_geodesic(VERTICES, FACES, 0, 1.0, **how),
    "grow": lambda **how: fairmesh.grow(VERTICES, FACES, [0], 2, **how),
}


@pytest.mark.parametrize("call", WITHOUT_RESULT.values(), ids=WITHOUT_RESULT)
def test_what_is_stopped_has_no_result(call):
    seen = []
    call(progress=lambda told: seen.append(told.fraction))
    assert seen == sorted(seen)
    assert seen[-1] == 1
    stop = threading.Event()
    stop.set()
    with pytest.raises(fairmesh.FairmeshError) as why:
        call(cancel=stop)
    assert why.value.status is fairmesh.Status.CANCELLED

    def enough(_):
        raise ZeroDivisionError

    with pytest.raises(ZeroDivisionError):
        call(progress=enough)


def test_callbacks_come_on_the_calling_thread():
    threads = set()
    CALLS["fair"](progress=lambda _: threads.add(threading.get_ident()))
    assert threads == {threading.get_ident()}
    worker = threading.Thread(target=CALLS["fair"], kwargs={"progress": lambda _: threads.add(threading.get_ident())})
    worker.start()
    worker.join()
    assert len(threads) == 2


@pytest.mark.parametrize("answer", [None, True, 1, 0, "", 3.5, np.True_])
def test_only_false_cancels(answer):
    assert CALLS["fair"](progress=lambda _: answer).outcome is fairmesh.Outcome.CONVERGED


@pytest.mark.parametrize("answer", [False, np.False_])
def test_false_cancels(answer):
    calls = []

    def stop(told):
        calls.append(told)
        return answer if told.iteration == 2 else None

    result = CALLS["fair"](progress=stop)
    assert result.outcome is fairmesh.Outcome.CANCELLED and not result.outcome.is_success
    assert calls[-1].iteration == 2 and sum(told.iteration == 2 for told in calls) == 1
    assert np.isfinite(result.vertices).all()
    assert np.array_equal(result.vertices[~FREE], VERTICES[~FREE])


def test_cancelled_filling():
    filled = CALLS["fill_holes"](progress=lambda _: False)
    assert [loop.outcome for loop in filled.loops] in (["left_open"], ["flat"], ["least_bending"])
    assert np.array_equal(filled.vertices[: len(HOLE[0])], HOLE[0])


class Wrong(Exception):
    """What only these tests raise."""


@pytest.mark.parametrize("call", CALLS.values(), ids=CALLS)
@pytest.mark.parametrize("at", [1, 4])
@pytest.mark.parametrize("kind", [Wrong, KeyboardInterrupt, SystemExit, StopIteration])
def test_an_exception_comes_out_of_the_call(call, at, kind, live_handles, capfd):
    inputs = VERTICES.copy(), FACES.copy(), FREE.copy(), HOLE[0].copy()
    raised = kind("from inside")
    calls = []

    def fail(told):
        calls.append(told)
        if len(calls) == at:
            raise raised

    with pytest.raises(kind) as error:
        call(progress=fail)
    assert error.value is raised and len(calls) == at
    assert any(entry.name == "fail" for entry in error.traceback)
    assert all(np.array_equal(a, b) for a, b in zip(inputs, (VERTICES, FACES, FREE, HOLE[0])))
    del error
    raised.__traceback__ = None
    assert live_handles("result") == live_handles("solver") == 0
    assert capfd.readouterr() == ("", "")


def test_an_exception_keeps_nothing_alive():
    """No cycle of the exception and frames: everything is gone without the garbage collector."""

    class Callback:
        def __call__(self, _):
            raise Wrong

    callback = Callback()
    gone = weakref.ref(callback)
    gc.disable()
    try:
        with pytest.raises(Wrong):
            CALLS["fair"](progress=callback)
        del callback
        # The frame of this test does not hold the exception either.
        sys.exc_info()
        gc.enable()
        gc.collect()
        assert gone() is None
    finally:
        gc.enable()


def test_an_event_that_raises():
    class Event:
        def is_set(self):
            raise Wrong

    with pytest.raises(Wrong):
        CALLS["fair"](cancel=Event())


@pytest.mark.parametrize("call", [CALLS["fair"], CALLS["Solver"]], ids=["fair", "Solver"])
@pytest.mark.parametrize("make", [threading.Event, fairmesh.Monitor])
def test_cancelled_before_it_begins(call, make):
    cancel = make()
    getattr(cancel, "set", getattr(cancel, "cancel", None))()
    run = call(cancel=cancel)
    assert run.outcome is fairmesh.Outcome.CANCELLED


@pytest.mark.parametrize("make", [threading.Event, fairmesh.Monitor])
def test_cancelled_from_another_thread(make):
    cancel = make()
    reached, go_on = threading.Event(), threading.Event()

    def wait(told):
        if told.iteration == 2:
            reached.set()
            assert go_on.wait(30)

    def other():
        assert reached.wait(30)
        getattr(cancel, "set", getattr(cancel, "cancel", None))()
        go_on.set()

    thread = threading.Thread(target=other)
    thread.start()
    result = CALLS["fair"](cancel=cancel, progress=wait)
    thread.join()
    # The event is asked before the callback: it is seen at the next iteration.
    assert result.outcome is fairmesh.Outcome.CANCELLED and result.report.iterations == 3
    assert cancel.is_set()


def test_a_monitor_sees_what_a_callback_sees():
    monitor = fairmesh.Monitor()
    assert (monitor.fraction, monitor.iteration, monitor.phase) == (0, 0, "") and math.isnan(monitor.step_norm)
    pairs = []

    def look(told):
        pairs.append((told, (monitor.phase, monitor.iteration, monitor.step_norm, monitor.fraction)))

    result = CALLS["fair"](cancel=monitor, progress=look)
    assert result.outcome.is_success and not monitor.is_cancelled
    for told, seen in pairs:
        np.testing.assert_equal(seen, (told.phase, told.iteration, told.step_norm, told.fraction))
    assert monitor.iteration == result.report.iterations
    monitor.cancel()
    assert monitor.is_cancelled and monitor.is_set()
    assert CALLS["fair"](cancel=monitor).outcome is fairmesh.Outcome.CANCELLED
    monitor.reset()
    assert not monitor.is_cancelled and monitor.iteration == 0
    assert CALLS["fair"](cancel=monitor).outcome is fairmesh.Outcome.CONVERGED


def test_a_monitor_is_read_from_another_thread():
    monitor = fairmesh.Monitor()
    seen = set()

    def watch(_):
        seen.add(monitor.iteration)
        time.sleep(0.002)

    thread = threading.Thread(target=lambda: CALLS["fair"](cancel=monitor, progress=watch))
    thread.start()
    read = []
    while thread.is_alive():
        read.append((monitor.fraction, monitor.iteration))
        time.sleep(0.0005)
    thread.join()
    assert read == sorted(read) and len(set(read)) > 3


def test_calls_within_callbacks():
    inner = []
    CALLS["fair"](progress=lambda _: inner.append(CALLS["fair"]().vertices))
    plain = CALLS["fair"]().vertices
    assert len(inner) > 3 and all(np.array_equal(vertices, plain) for vertices in inner)


def test_an_interrupt_stops_a_call_without_callback():
    """Ctrl-C during a run of the main thread: the KeyboardInterrupt comes at the next iteration."""
    program = """
import os, signal, threading, sys
sys.path.insert(0, sys.argv[1])
import numpy as np, fairmesh, meshes
signal.signal(signal.SIGINT, signal.default_int_handler)  # commands in the background are started without it
vertices, faces, free, _ = meshes.dented_sphere(side=161, frame=10)
fairmesh.fair(vertices[:], faces, free=free, max_iterations=1)  # loads, warms up
threading.Timer(0.05, os.kill, (os.getpid(), signal.SIGINT)).start()
try:
    while True:
        result = fairmesh.fair(vertices, faces, free=free)
except KeyboardInterrupt:
    print("interrupted")
"""
    command = [sys.executable, "-c", program, str(Path(__file__).parent)]
    run = subprocess.run(command, capture_output=True, text=True, timeout=120)
    assert (run.stdout, run.stderr, run.returncode) == ("interrupted\n", "", 0)
