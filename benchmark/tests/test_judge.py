"""What is said of results that were made up."""

from __future__ import annotations

import pytest

from fairbench.judge import Row, is_good, is_sound
from fairbench.page import failures, losses, words
from fairbench.pictures import chosen
from fairbench.standings import standings


def run(program: str, rms: float | None, case: str = "one", seed: int = 1, **more) -> Row:
    fields = dict.fromkeys(Row._fields) | {"case": case, "seed": seed, "family": "exact", "task": "fill", "program": program, "ended": "done", "why": ""}
    sound = {"folds": 0, "crossings": 0, "tangled": 0, "open_edges": 0} if rms is not None else {}
    return Row(**(fields | sound | {"rms": rms} | more))


def test_ranks_are_told_seed_by_seed():
    rows = [run("a", 0.01), run("b", 0.02), run("a", 0.04, seed=2), run("b", 0.03, seed=2), run("c", None), run("c", None, seed=2)]
    first, second, third = standings(rows)
    assert (first.program, first.rank(), first.nearest) == ("a", "1 to 2", 1)
    assert (second.program, second.rank(), second.nearest) == ("b", "1 to 2", 1)
    assert (third.program, third.rank(), third.mean, third.good) == ("c", "3", 1.0, 0)
    assert first.mean == pytest.approx(0.02) and first.of_seeds == pytest.approx([0.01, 0.04])


@pytest.mark.parametrize("flaw", ["folds", "crossings", "tangled", "open_edges"])
def test_a_flaw_is_not_good_however_near(flaw):
    assert is_good(run("a", 0.0), 0.0)
    assert not is_sound(run("a", 0.0, **{flaw: 1})) and not is_good(run("a", 0.0, **{flaw: 1}), 0.0)
    assert not is_good(run("a", 0.0, crease=11.0), 0.0)
    assert is_good(run("a", 0.029), 0.0099) and not is_good(run("a", 0.031), 0.0101)
    assert not is_good(run("a", None), 1.0)


def test_losses_and_false_words_are_told():
    rows = [
        run("fairmesh auto", 0.02, says_success=True),
        run("b", 0.01),
        run("fairmesh auto", 0.01, case="two", says_success=True),
        run("b", 0.02, case="two"),
    ]
    assert "In 1 of 2 cases" in losses(rows)
    assert "| one, 1 | 2 | 1 | b | 2 | success |" in losses(rows)
    far = [
        run("fairmesh auto", 0.5, says_success=True),
        run("b", 0.02),
        run("fairmesh auto", 0.001, case="two", says_success=False),
        run("b", 0.02, case="two"),
    ]
    assert "| fairmesh auto | 1 | 1 | 1 | 1 |" in words(far)


def test_failures_count_and_are_told_with_their_words():
    rows = [run("a", 0.01), run("b", None, ended="refused", why="no | loop\nhere"), run("b", None, case="two", ended="out of time")]
    assert standings(rows)[1].mean == 1.0
    assert "| b | fill | refused | 1 | one, 1 | no / loop here |" in failures(rows)
    assert "| b | fill | out of time | 1 | two, 1 |  |" in failures(rows)


def test_where_fairmesh_does_not_take_part_others_are_shown():
    rows = [run("a", 0.01), run("b", 0.02), run("a", 0.03, case="two"), run("b", 0.025, case="two")]
    shown = {each.label: each.own for each in chosen(rows, "fairmesh auto")}
    assert (shown["best"].case, shown["best"].program, shown["worst"].case, shown["worst"].program) == ("one", "a", "two", "b")
