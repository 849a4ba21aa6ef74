"""What the tests share."""

import collections
import gc

import pytest

import fairmesh


@pytest.fixture
def live_handles(monkeypatch):
    """How many handles of a kind ("solver", "result") exist of those that were made during the test."""
    library = fairmesh.load()
    alive = collections.Counter()

    def count(name, kind, step, position):
        original = getattr(library, name)

        def counted(*arguments):
            status = original(*arguments)
            if status == 0 and position(arguments):
                alive[kind] += step
            return status

        monkeypatch.setattr(library, name, counted)

    for name, at in (
        ("fair", -2),
        ("fill_holes", -2),
        ("remesh", -2),
        ("boundary_loops", -2),
        ("solver_result", -2),
        ("suggest_joins", -2),
        ("erase", -2),
        ("trim_boundary", -2),
        ("carry_over", -2),
        ("refill", -2),
        ("rim_roughness", -2),
        ("components", -2),
        ("bridge", -2),
    ):
        count(f"fairmesh_{name}", "result", 1, lambda arguments, at=at: arguments[at] is not None)
    count("fairmesh_solver_new", "solver", 1, lambda _: True)
    count("fairmesh_solver_free", "solver", -1, lambda _: True)
    count("fairmesh_result_free", "result", -1, lambda _: True)

    def live(kind):
        gc.collect()
        return alive[kind]

    return live
