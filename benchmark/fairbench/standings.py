"""How programs stand in a class of cases: over all, and for each seed by itself."""

from __future__ import annotations

from collections import defaultdict
from typing import NamedTuple

from .judge import Row, best_errors, geometric_mean, is_good


class Standing(NamedTuple):
    """A program in a class of cases."""

    program: str
    rows: list[Row]
    #: Geometric mean of its errors: over all, and of each seed.
    mean: float
    of_seeds: list[float]
    #: Its ranks among the programs, 1 for the nearest, seed by seed.
    ranks: list[int]
    #: How many of its results are nearest, and how many good.
    nearest: int
    good: int

    def rank(self) -> str:
        """The ranks over the seeds."""
        low, high = min(self.ranks), max(self.ranks)
        return str(low) if low == high else f"{low} to {high}"


def standings(rows: list[Row]) -> list[Standing]:
    """Of the programs of one class, the nearest first."""
    best = best_errors(rows)
    by_program: dict[str, list[Row]] = defaultdict(list)
    for one in rows:
        by_program[one.program].append(one)
    seeds = sorted({one.seed for one in rows})
    means = {name: [geometric_mean([one.error() for one in some if one.seed == seed]) for seed in seeds] for name, some in by_program.items()}
    found = []
    for name, some in by_program.items():
        ranks = [1 + sum(other[k] < means[name][k] for other in means.values()) for k in range(len(seeds))]
        nearest = sum(one.error() <= best[one.problem()] * 1.001 and one.rms is not None for one in some)
        good = sum(is_good(one, best[one.problem()]) for one in some)
        found.append(Standing(name, some, geometric_mean([one.error() for one in some]), means[name], ranks, nearest, good))
    return sorted(found, key=lambda each: each.mean)


def classes(rows: list[Row]) -> dict[tuple[str, str], list[Row]]:
    """The runs by family and task, in their order."""
    found: dict[tuple[str, str], list[Row]] = defaultdict(list)
    for one in rows:
        found[one.family, one.task].append(one)
    return found
