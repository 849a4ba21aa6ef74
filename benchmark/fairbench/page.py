"""The page about all runs: where fairmesh loses first, then each class of cases."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Iterable
from typing import NamedTuple

from .judge import Row, best_errors, geometric_mean, is_good, is_sound
from .pictures import Chosen
from .programs import Program
from .standings import Standing, classes, standings

#: Whose losses come first.
OWN = "fairmesh auto"
#: A loss is a result that is farther from the truth than another program's by more than this factor: 127 of 321 are; by half of the excess 131, by double 113.
LOSS = 1.1
#: So many losses are told one by one; results.json has all.
TOLD = 20

FAMILIES = {
    "exact": "Exact surfaces (sphere, cylinder, cone, torus, ellipsoid, catenoid, unduloid, a band with r dH/ds constant)",
    "stretched": "The same with triangles three times as long as wide",
    "rim": "Holes with noisy rims",
    "tube": "Two ends of a tube to be joined",
    "scan": "Places of scans and sculptures, drawn by lot",
    "sharp": "Across sharp edges of parts",
    "blend": "Edges to be rounded: straight, round, and where booleans left them",
}


def page(rows: list[Row], programs: list[Program], versions: dict[str, str], drawn: dict[Chosen, str], plots: list[str]) -> str:
    """In Markdown, with the lines that show pictures and plots."""
    problems = {one.problem() for one in rows}
    seeds = sorted({seed for _, seed in problems})
    parts = [HEAD.format(cases=len(problems), runs=len(rows), seeds=", ".join(map(str, seeds))), losses(rows)]
    parts.append("## All classes\n\n" + "\n\n".join(plots) + "\n")
    for (family, task), some in classes(rows).items():
        parts.append(f"## {task.capitalize()}: {FAMILIES[family]}\n\n{table(some)}")
        for each, line in drawn.items():
            if (each.own.family, each.own.task) == (family, task):
                whose = "for fairmesh beside others" if each.own.program == OWN else f"of {each.own.program}"
                parts.append(f"The {each.label} {whose}, {each.own.case}:\n\n{line}\n")
    parts += [words(rows), failures(rows)]
    parts.append("## Programs\n\n" + lines(["program", "version", "how", "its word of success"], of_programs(programs, versions)))
    return "\n".join(parts)


def of_programs(programs: list[Program], versions: dict[str, str]) -> Iterable[list[str]]:
    """A row for each."""
    for each in programs:
        yield [each.name, versions.get(each.name, ""), each.best, each.says]


def lines(head: list[str], rows: Iterable[list[str]]) -> str:
    """A table."""
    made = ["| " + " | ".join(head) + " |", "|---" * len(head) + "|"]
    return "\n".join([*made, *("| " + " | ".join(row) + " |" for row in rows)]) + "\n"


def table(rows: list[Row]) -> str:
    """The programs of a class, the nearest first."""
    head = ["rank", "program", "rms", "seeds", "worst", "nearest", "good", "failed", "flawed", "moved", "angle", "crease", "jump of H", "CPU s", "MB"]
    return lines(head, map(_of, standings(rows)))


def _of(one: Standing) -> list[str]:
    done = [each for each in one.rows if each.rms is not None]
    return [
        one.rank(),
        one.program,
        f"{100 * one.mean:.3g}",
        f"{100 * min(one.of_seeds):.3g} to {100 * max(one.of_seeds):.3g}",
        f"{100 * max(each.error() for each in one.rows):.3g}",
        f"{one.nearest} of {len(one.rows)}",
        str(one.good),
        str(len(one.rows) - len(done)),
        str(sum(not is_sound(each) for each in done)),
        str(sum((each.moved or 0) > 0 for each in done)),
        _median([each.smallest_angle for each in done], ".2g"),
        _median([each.crease for each in done], ".2g"),
        _median([each.jump for each in done], ".2g"),
        _median([each.cpu for each in done], ".2g"),
        _median([each.peak and each.peak / 1e6 for each in done], ".0f"),
    ]


def _median(values: Iterable[float | None], digits: str) -> str:
    known = sorted(value for value in values if value is not None)
    return format(max(known[len(known) // 2], 0.0), digits) if known else ""


class Loss(NamedTuple):
    """A case in which another program is nearer."""

    times: float
    own: Row
    other: Row


def losses(rows: list[Row]) -> str:
    """Where another program is nearer to the truth, by class and one by one; and what fairmesh does not do."""
    told = []
    found: list[Loss] = []
    for (family, task), some in classes(rows).items():
        lost, asked = _lost(some)
        found += lost
        if not any(one.program == OWN for one in some):
            told.append([f"{task}, {family}", "not done by fairmesh", "", ""])
        elif lost:
            times = [each.times for each in lost]
            told.append([f"{task}, {family}", f"{len(lost)} of {asked}", f"{geometric_mean(times):.2g}", f"{max(times):.2g}"])
    by_class = lines(["task, class", "another is nearer", "times, mean", "times, most"], told)
    one_by_one = [_told(each) for each in sorted(found, key=lambda each: -each.times)[:TOLD]]
    head = ["case, seed", OWN, "nearest other", "which", "times", "fairmesh says"]
    count = sum(_lost(some)[1] for some in classes(rows).values())
    first = f"In {len(found)} of {count} cases another program is nearer to the truth by more than a tenth; the {TOLD} worst are below."
    return f"## Where fairmesh loses\n\n{first}\n\n{by_class}\n{lines(head, one_by_one)}"


def _told(loss: Loss) -> list[str]:
    own, other = loss.own, loss.other
    return [f"{own.case}, {own.seed}", f"{100 * own.error():.3g}", f"{100 * other.error():.3g}", other.program, f"{loss.times:.2g}", _word(own)]


def _word(one: Row) -> str:
    return "success" if one.says_success else "no success" if one.rms is not None else one.ended


def _lost(rows: list[Row]) -> tuple[list[Loss], int]:
    """The losses, and in how many cases fairmesh has others beside it."""
    by_problem: dict[tuple[str, int], list[Row]] = defaultdict(list)
    for one in rows:
        by_problem[one.problem()].append(one)
    found, asked = [], 0
    for some in by_problem.values():
        own = next((one for one in some if one.program == OWN), None)
        other = min((one for one in some if not one.program.startswith("fairmesh")), key=Row.error, default=None)
        if own is None or other is None:
            continue
        asked += 1
        if own.error() > LOSS * other.error():
            found.append(Loss(own.error() / other.error(), own, other))
    return found, asked


def words(rows: list[Row]) -> str:
    """Whether what programs say of their results is true."""
    best = best_errors(rows)
    told = []
    for name in dict.fromkeys(one.program for one in rows):
        some = [one for one in rows if one.program == name and one.rms is not None]
        yes = [one for one in some if one.says_success is True]
        no = [one for one in some if one.says_success is False]
        if not yes and not no:
            continue
        false = sum(not is_good(one, best[one.problem()]) for one in yes)
        shy = sum(is_good(one, best[one.problem()]) for one in no)
        told.append([name, f"{len(yes)}", f"{false}", f"{len(no)}", f"{shy}"])
    head = ["program", "says success", "of these not good", "says it is none", "of these good"]
    return "## Whether their word is true\n\nGood is defined above. Programs that say nothing are not listed.\n\n" + lines(head, told)


def failures(rows: list[Row]) -> str:
    """How runs without a result ended."""
    by_end: dict[tuple[str, str, str], list[Row]] = defaultdict(list)
    for one in rows:
        if one.rms is None:
            by_end[one.program, one.task, one.ended].append(one)
    told = [[*key, str(len(some)), f"{some[0].case}, {some[0].seed}", _plain(some[0].why)] for key, some in sorted(by_end.items())]
    return "## Failures\n\n" + lines(["program", "task", "how it ended", "runs", "the first", "its words"], told)


def _plain(text: str) -> str:
    """On one line of a table."""
    return " ".join(text.replace("|", "/").replace("<", "&lt;").split())


HEAD = """# Benchmark of hole filling and fairing

Written by `benchmark/run.sh` ([how it works](../benchmark/README.md)): {cases} cases with a truth, {runs} runs, seeds {seeds}.

- *rms*: distances from the result to the truth and back, root mean square over the area, in per cent of the width of the hole or region; of several cases
  the geometric mean. A failure counts as 100, what is nearer than .01 as .01. *seeds*: the same of each seed by itself, the least and the largest; the rank
  likewise. Ties have one rank, and are all *nearest*.
- *good*: nearer than 1 %, or three times as far as the nearest one; sound, and with a crease at the rim of at most 10 degrees beyond the truth's.
- *flawed*: folded, crossing itself, with edges of three triangles, or open. A failure has no result. *moved*: old vertices are not where they were, to the bit.
- *angle*: the smallest of the new triangles, degrees, the median.
- *crease*: degrees at the rim beyond the truth's; *jump of H*: of mean curvature there, over the width, beyond the truth's. Both are medians; CPU seconds and
  memory, too, which are of the call, of command lines with reading and writing.

On exact surfaces triangles themselves are some .05 % off.
"""
