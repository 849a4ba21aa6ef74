"""The page about all runs: where fairmesh loses first, then each class of cases."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Iterable

from .judge import Row, best_errors, geometric_mean, is_good, spread
from .pictures import Chosen
from .programs import Program

#: Whose losses come first.
OWN = "fairmesh g1"
#: A loss is a result that is farther from the truth than another program's by more than this factor.
LOSS = 1.1

FAMILIES = {
    "exact": "Exact surfaces (sphere, cylinder, cone, torus, ellipsoid, catenoid, unduloid, a band with r dH/ds constant)",
    "stretched": "The same with triangles three times as long as wide",
    "rim": "Holes with noisy rims",
    "tube": "Two ends of a tube to be joined",
    "scan": "Places of scans and sculptures, drawn by lot",
    "sharp": "Holes across sharp edges of parts",
    "blend": "Edges to be rounded",
}


def page(rows: list[Row], programs: list[Program], versions: dict[str, str], seeds: list[int], drawn: dict[Chosen, str]) -> str:
    """In Markdown, with the lines that show pictures."""
    parts = [HEAD.format(cases=len({one.case for one in rows}), runs=len(rows), seeds=", ".join(map(str, seeds)))]
    parts.append(losses(rows))
    by_class: dict[tuple[str, str], list[Row]] = defaultdict(list)
    for one in rows:
        by_class[one.family, one.task].append(one)
    for (family, task), some in by_class.items():
        parts.append(f"## {task.capitalize()}: {FAMILIES[family]}\n\n{table(some)}")
        for each, line in drawn.items():
            if (each.own.family, each.own.task) == (family, task):
                parts.append(f"The {each.label} for fairmesh beside others, {each.own.case}:\n\n{line}\n")
    parts.append(words(rows))
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
    best = best_errors(rows)
    by_program: dict[str, list[Row]] = defaultdict(list)
    for one in rows:
        by_program[one.program].append(one)
    told = []
    for name, some in by_program.items():
        errors = [one.error() for one in some]
        done = [one for one in some if one.rms is not None]
        nearest = sum(one.error() <= best[one.case] * 1.001 and one.rms is not None for one in some)
        times = [one.cpu for one in done if one.cpu is not None]
        told.append(
            (
                geometric_mean(errors),
                [
                    name,
                    f"{100 * geometric_mean(errors):.3g} (by {spread(errors):.2f})",
                    f"{100 * max(errors):.3g}",
                    f"{nearest} of {len(some)}",
                    f"{sum(is_good(one, best[one.case]) for one in some)}",
                    f"{len(some) - len(done)}",
                    f"{max((one.crease or 0) for one in done):.0f}" if done else "",
                    f"{sum((one.folds or 0) > 0 for one in done)}, {sum((one.open_edges or 0) > 0 for one in done)}",
                    f"{geometric_mean(times):.2g}" if times else "",
                ],
            )
        )
    head = ["program", "rms, % of the width", "worst", "nearest", "good", "failed", "largest crease", "folded, open", "CPU s"]
    return lines(head, [row for _, row in sorted(told, key=lambda each: each[0])])


def losses(rows: list[Row]) -> str:
    """Where another program is nearer to the truth."""
    by_case: dict[str, list[Row]] = defaultdict(list)
    for one in rows:
        by_case[one.case].append(one)
    found = []
    for case, some in by_case.items():
        own = next((one for one in some if one.program == OWN), None)
        if own is None:
            continue
        other = min((one for one in some if not one.program.startswith("fairmesh")), key=Row.error, default=None)
        if other is not None and own.error() > LOSS * other.error():
            found.append((own.error() / other.error(), case, own, other))
    told = [
        [case, f"{100 * own.error():.3g}", f"{100 * other.error():.3g}", other.program, f"{ratio:.2g}", own.why or own.ended]
        for ratio, case, own, other in sorted(found, key=lambda each: -each[0])
    ]
    asked = sum(any(one.program == OWN for one in some) and len(some) > 2 for some in by_case.values())
    head = ["case", "fairmesh g1", "nearest other", "which", "times", "how fairmesh ended"]
    return f"## Where fairmesh loses\n\nIn {len(told)} of {asked} cases another program is nearer to the truth by more than a tenth.\n\n" + lines(head, told)


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
        false = sum(not is_good(one, best[one.case]) for one in yes)
        shy = sum(is_good(one, best[one.case]) for one in no)
        told.append([name, f"{len(yes)}", f"{false}", f"{len(no)}", f"{shy}"])
    head = ["program", "says success", "of these not good", "says it is none", "of these good"]
    return "## Whether their word is true\n\nGood is defined above. Programs that say nothing are not listed.\n\n" + lines(head, told)


HEAD = """# Benchmark of hole filling and fairing

Written by `benchmark/run.sh` ([how it works](../benchmark/README.md)): {cases} cases with a truth, {runs} runs, seeds {seeds}. Distances are root mean squares
over the area, from the result to the truth and back, in per cent of the width of the hole or region; of several cases the geometric mean, behind it the
factor by which that may be off (one standard error). A failure counts as 100 %. A result is *good* that is nearer than 1 %, or three times as far as the
nearest one, without folds, open edges, and a crease of 10 degrees beyond the truth's. On exact surfaces triangles themselves are some .05 % off. CPU seconds
are those of the call, of command lines with reading and writing.
"""
