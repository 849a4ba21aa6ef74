"""`python -m fairbench`: makes the cases, runs the programs, and writes the page. `run.sh` starts this."""

from __future__ import annotations

import argparse
import json
import sys
import zlib
from concurrent.futures import ThreadPoolExecutor
from functools import partial
from pathlib import Path

from .cases import Case, cases
from .judge import Row, geometric_mean, row
from .page import OWN, page
from .pictures import chosen, draw
from .plots import plots
from .programs import Program, programs
from .runner import run, write_task

ROOT = Path(__file__).resolve().parents[2]
RESULTS = ROOT / "benchmark/results.json"
PAGE = ROOT / "docs/benchmark.md"
PICTURES = ROOT / "docs/benchmark"
#: With --quick one of so many cases is run, drawn by its name so that all classes are there.
EVERY = 3
#: A class is worse where its mean exceeds the committed one by more than this factor.
WORSE = 1.05


def asked() -> argparse.Namespace:
    """The command line."""
    parser = argparse.ArgumentParser(prog="benchmark/run.sh", description=__doc__)
    parser.add_argument("--data", type=Path, required=True, help=argparse.SUPPRESS)
    parser.add_argument("--environments", type=Path, required=True, help=argparse.SUPPRESS)
    parser.add_argument("--work", type=Path, required=True, help=argparse.SUPPRESS)
    parser.add_argument("--only", default="", help="programs whose folders are these, separated by commas; of others the last results stay")
    parser.add_argument("--quick", action="store_true", help="every third case, compared with the committed results; nothing is written")
    parser.add_argument("--seeds", type=int, default=3, help="so many sets of cases; with --quick it is one")
    parser.add_argument("--page", action="store_true", help="runs nothing: the page of the last results")
    parser.add_argument("--jobs", type=int, default=2, help="runs at a time")
    return parser.parse_args()


def main() -> int:
    """Runs what is asked for."""
    args = asked()
    some = [each for each in programs() if not args.only or each.folder.name in args.only.split(",")]
    if args.page:
        told = json.loads(RESULTS.read_text())
        write_page(args, [Row(**each) for each in told["runs"]], some, told["versions"])
        return 0
    rows, versions = run_all(args, some)
    if args.quick:
        return compared(rows)
    if args.only:
        rows, versions = with_others(rows, versions)
        some = programs()
    RESULTS.write_text(json.dumps({"versions": versions, "runs": [each._asdict() for each in rows]}, indent=1) + "\n")
    write_page(args, rows, some, versions)
    return 0


def run_all(args: argparse.Namespace, some: list[Program]) -> tuple[list[Row], dict[str, str]]:
    """Every program on every case that it can do, judged; and the versions."""
    rows: list[Row] = []
    versions: dict[str, str] = {}
    for seed in range(1, 2 if args.quick else args.seeds + 1):
        made = list(cases(seed, args.data))
        for case in [each for each in made if zlib.crc32(each.name.encode()) % EVERY == 0] if args.quick else made:
            task = args.work / "cases" / f"{case.name}-{seed}"
            write_task(case, task)
            able = [each for each in some if case.task in each.tasks]
            if not able:
                continue
            with ThreadPoolExecutor(args.jobs) as pool:
                for found, version in pool.map(partial(one, args, case, seed), able):
                    rows.append(found)
                    versions[found.program] = version or versions.get(found.program, "")
            print(f"{case.name} {seed}: {', '.join(f'{each.program} {100 * each.error():.2g} %' for each in rows[-len(able) :])}", flush=True)
    return rows, versions


def with_others(rows: list[Row], versions: dict[str, str]) -> tuple[list[Row], dict[str, str]]:
    """These results, and the committed ones of programs that were not run."""
    told = json.loads(RESULTS.read_text())
    now = {(each.problem(), each.program): each for each in rows}
    before = [Row(**each) for each in told["runs"]]
    merged = [now.pop((each.problem(), each.program), each) for each in before]
    return merged + list(now.values()), told["versions"] | versions


def write_page(args: argparse.Namespace, rows: list[Row], some: list[Program], versions: dict[str, str]) -> None:
    """The page, its plots, and its pictures, which are of the first set of cases."""
    PICTURES.mkdir(exist_ok=True)
    first = {case.name: case for case in cases(1, args.data)}
    shown = chosen([each for each in rows if each.seed == 1], OWN)
    drawn = {}
    for each in shown:
        name = each.own.case
        line = draw(first[name], each, args.work / "out" / f"{name}-1", PICTURES)
        if line is not None:
            drawn[each] = line
    for old in PICTURES.glob("*.png"):
        if not any(f"/{old.name})" in line for line in drawn.values()):
            old.unlink()
    PAGE.write_text(page(rows, some, versions, drawn, plots(rows, PICTURES)))


def one(args: argparse.Namespace, case: Case, seed: int, program: Program) -> tuple[Row, str]:
    """A run, judged, and the program's version."""
    environment = program.folder.name if program.own_environment else "common"
    python = args.environments / environment / "bin/python"
    task = args.work / "cases" / f"{case.name}-{seed}"
    out = args.work / "out" / task.name / program.name.replace(" ", "-")
    made = run(program, task, out, python)
    return row(case, seed, program, made), str(made.said.get("version", ""))


def compared(rows: list[Row]) -> int:
    """Fails where a class got worse than the committed results of the same cases."""
    told = [Row(**each) for each in json.loads(RESULTS.read_text())["runs"]]
    before = {(each.problem(), each.program): each for each in told}
    new = sorted(f"{each.case} {each.program}" for each in rows if (each.problem(), each.program) not in before)
    if new:
        print(f"No committed results of {', '.join(new)}: run benchmark/run.sh without --quick.")
        return 1
    classes = sorted({(each.family, each.task, each.program) for each in rows})
    worse = 0
    for family, task, program in classes:
        some = [each for each in rows if (each.family, each.task, each.program) == (family, task, program)]
        now = geometric_mean([each.error() for each in some])
        was = geometric_mean([before[each.problem(), each.program].error() for each in some])
        is_worse = now > WORSE * was
        worse += is_worse
        print(f"{family} {task} {program}: {100 * now:.4g} %, was {100 * was:.4g} %{'  WORSE' if is_worse else ''}")
    return 1 if worse else 0


if __name__ == "__main__":
    sys.exit(main())
