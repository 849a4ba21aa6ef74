"""What is said of all runs together."""

from __future__ import annotations

import math
from collections.abc import Iterable
from typing import Any, NamedTuple

from .cases import Case
from .measures import measured
from .programs import Program
from .runner import Run

#: A result is good that is this near, root mean square in widths, or as near as the nearest one times `BESIDE`; and has no flaw besides. Of 3,562 results,
#: of which 1,867 are good, 135 change with half of `NEAR` and 164 with double, 265 and 92 with half and double of `BESIDE`.
NEAR = 0.01
BESIDE = 3.0
#: Degrees of crease at the rim beyond the truth's that a good result may have. 223 of the same change with half, 196 with double.
CREASE = 10.0
#: What is nearer than this (in widths) counts as that near: triangles themselves are no nearer to exact surfaces. Some results on planes are, by rounding,
#: and would outweigh all others in a mean. Only these change with half or double.
EXACT = 1e-4
#: What a failure counts as in means, in widths: as far from the truth as nothing at all.
FAILED = 1.0


class Row(NamedTuple):
    """A run, judged. The measures are None where there is no result."""

    case: str
    seed: int
    family: str
    task: str
    program: str
    ended: str
    says_success: bool | None
    rms: float | None
    mean: float | None
    largest: float | None
    vertices: float | None
    crease: float | None
    jump: float | None
    smallest_angle: float | None
    folds: int | None
    crossings: int | None
    tangled: int | None
    open_edges: int | None
    moved: int | None
    new_triangles: int | None
    cpu: float | None
    peak: int | None
    why: str

    def problem(self) -> tuple[str, int]:
        """The case and its seed."""
        return self.case, self.seed

    def error(self) -> float:
        """Root mean square of the distances; what a failure counts as."""
        return FAILED if self.rms is None else max(self.rms, EXACT)


def row(case: Case, seed: int, program: Program, run: Run) -> Row:
    """Judges a run by its files."""
    found = measured(case, run.result) if run.result is not None else None
    told = {} if found is None else {name: _plain(value) for name, value in found._asdict().items() if name in Row._fields}
    fields: dict[str, Any] = dict.fromkeys(Row._fields)
    fields |= told | {"case": case.name, "seed": seed, "family": case.family, "task": case.task, "program": program.name, "ended": run.ended}
    fields |= {"says_success": run.said.get("success"), "cpu": _plain(run.said.get("cpu")), "peak": run.said.get("peak")}
    return Row(**(fields | {"why": str(run.said.get("refused", ""))[:200]}))


def _plain(value: float | int | None) -> float | int | None:
    """To six digits; None for what is no number."""
    if isinstance(value, float):
        return float(f"{value:.6g}") if math.isfinite(value) else None
    return value


def is_good(one: Row, best: float) -> bool:
    """Whether a result is near to the truth, or nearly as near as the nearest one, and without a flaw that a person sees."""
    if one.rms is None:
        return False
    return is_sound(one) and (one.crease is None or one.crease < CREASE) and one.rms < max(NEAR, BESIDE * best)


def is_sound(one: Row) -> bool:
    """Whether the result is one surface without flaws, whatever its shape."""
    return not (one.folds or one.crossings or one.tangled or one.open_edges)


def best_errors(rows: Iterable[Row]) -> dict[tuple[str, int], float]:
    """The nearest result of each case."""
    best: dict[tuple[str, int], float] = {}
    for one in rows:
        best[one.problem()] = min(best.get(one.problem(), FAILED), one.error())
    return best


def geometric_mean(values: list[float]) -> float:
    """Of positive numbers."""
    return math.exp(sum(map(math.log, values)) / len(values))
