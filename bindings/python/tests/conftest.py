"""What the tests share."""

import collections
import ctypes
import gc

import pytest

import fairmesh
from fairmesh import _abi


@pytest.fixture
def live_handles(monkeypatch):
    """How many handles of a kind ("solver", "result") exist of those that were made during the test."""
    library = fairmesh.load()
    alive = collections.Counter()

    def count(name, kind, step):
        original = getattr(library, name)

        def counted(*arguments):
            status = original(*arguments)
            # Where a result may be left out, its place is NULL.
            if status == 0 and (step < 0 or arguments[-2] is not None):
                alive[kind] += step
            return status

        monkeypatch.setattr(library, name, counted)

    for name, (_, parameters) in _abi.FUNCTIONS.items():
        if ctypes.POINTER(ctypes.c_void_p) in parameters:
            count(name, "solver" if name == "fairmesh_solver_new" else "result", 1)
    for kind in ("solver", "result"):
        count(f"fairmesh_{kind}_free", kind, -1)

    def live(kind):
        gc.collect()
        return alive[kind]

    return live
