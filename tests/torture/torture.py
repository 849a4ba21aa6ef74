"""Runs fairmesh on public and on damaged meshes, and judges every result from the files alone.

Prints one line per failure, with the command that repeats it, then a table. Ends with 1 if any run was a false success,
hung or crashed.
"""

from __future__ import annotations

import argparse
import json
import multiprocessing
import sys
import time
from collections import Counter
from dataclasses import asdict
from pathlib import Path

import cases
import meshes
import mutations
from formats import FORMATS
from runner import Runner

ROOT = Path(__file__).resolve().parents[2]
# Of fairings, fillings, and damaged files.
SUCCESS = ("converged", "filled", "done")
place: cases.Place


def start(program: Path, folder: Path, seed: int) -> None:
    global place
    place = cases.Place(program, folder, Runner(), seed)


def work(job: tuple) -> list[cases.Result]:
    kind, *rest = job
    if kind == "mesh":
        return cases.mesh_cases(place, *rest)
    if kind == "damaged":
        return mutations.damaged(place, *rest)
    return [{"slot": cases.slot_case, "hub": cases.hub_case, "far": cases.far_case}[kind](place, *rest)]


def jobs(arguments: argparse.Namespace) -> list[tuple]:
    """Small jobs first: what fails is soon seen."""
    quick = arguments.quick
    files = [p for p in sorted(arguments.cache.iterdir()) if p.suffix in meshes.SUFFIXES]
    files = [p for p in files if not quick or p.stat().st_size < 60_000][: 4 if quick else arguments.meshes]
    listed: list[tuple] = [("far", *f) for f in (cases.FAR[:2] if quick else cases.FAR)]
    listed += [("hub", valence) for valence in ((50,) if quick else (500, 5_000, 20_000))]
    listed += [("slot", *s) for s in (cases.SLOTS[:2] if quick else cases.SLOTS)]
    listed += [("mesh", p) for p in sorted(files, key=lambda p: p.stat().st_size)]
    return listed + [("damaged", form, *((5, 400) if quick else (60, 10))) for form in FORMATS]


def told(result: cases.Result) -> None:
    for kind, text in result.findings:
        print(f"{kind}: {result.group}/{result.name} ({result.outcome}): {text}\n    {result.command}", flush=True)


def summary(results: list[cases.Result], seconds: float) -> dict:
    groups = {}
    for name in dict.fromkeys(r.group for r in results):
        group = [r for r in results if r.group == name]
        groups[name] = {
            "runs": len(group),
            "outcomes": dict(Counter(r.outcome for r in group).most_common()),
            "successes": sum(r.outcome in SUCCESS for r in group),
            "false": sum(r.outcome in SUCCESS and bool(r.findings) for r in group),
            "failed": sum(bool(r.findings) for r in group),
            "findings": dict(Counter(kind for r in group for kind, _ in r.findings).most_common()),
            "cpu": round(sum(r.cpu for r in group), 1),
            "slowest": round(max(r.cpu for r in group), 2),
            "megabytes": round(max(r.kilobytes for r in group) / 1024),
        }
    return {"groups": groups, "clock": round(seconds)}


def table(total: dict) -> None:
    limits = f"fair {cases.FAIR_LIMIT}, fill {cases.FILL_LIMIT}, damaged files {mutations.LIMIT}"
    print(f"\nlimits in CPU seconds: {limits}")
    print(f"{'':10} {'runs':>5} {'success':>7} {'false':>5} {'failed':>6} {'CPU s':>7} {'slowest':>7} {'MB':>5}")
    for name, group in total["groups"].items():
        counts = f"{group['runs']:5} {group['successes']:7} {group['false']:5}"
        figures = counts + f" {group['failed']:6} {group['cpu']:7.1f} {group['slowest']:7.2f} {group['megabytes']:5}"
        print(f"{name:10} {figures}")
        print("           ends:     " + ", ".join(f"{v} {k}" for k, v in group["outcomes"].items()))
        if group["findings"]:
            print("           findings: " + ", ".join(f"{v} {k}" for k, v in group["findings"].items()))
    print(f"{total['clock']} s on the clock")


def parsed() -> argparse.Namespace:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--program", type=Path, default=ROOT / "target/release/fairmesh", help="what is tried")
    parser.add_argument("--seed", type=int, default=0, help="of regions and of mutations")
    parser.add_argument("--meshes", type=int, default=1000, metavar="N", help="at most so many public meshes")
    parser.add_argument(
        "--only", metavar="TEXT", help="only jobs whose description has this text, as in 'mesh' or 'bunny'"
    )
    parser.add_argument("--quick", action="store_true", help="a small part, to test this program itself")
    parser.add_argument("--jobs", type=int, default=2, metavar="N", help="so many runs at a time")
    parser.add_argument("--json", type=Path, metavar="FILE", help="writes every run and the table")
    parser.add_argument(
        "--cache", type=Path, default=ROOT / "target/torture/meshes", help="where the public meshes are"
    )
    parser.add_argument("--work", type=Path, default=ROOT / "target/torture/work", help="where failures stay")
    return parser.parse_args()


def main() -> int:
    arguments = parsed()
    begin = time.monotonic()
    program = arguments.program.resolve(strict=True)
    meshes.fetch(arguments.cache)
    listed = [job for job in jobs(arguments) if not arguments.only or arguments.only in str(job)]
    results = []
    with multiprocessing.Pool(arguments.jobs, start, (program, arguments.work.resolve(), arguments.seed)) as pool:
        for finished in pool.imap_unordered(work, listed):
            for result in finished:
                told(result)
            results += finished
    total = summary(results, time.monotonic() - begin)
    table(total)
    if arguments.json:
        runs = [asdict(r) for r in sorted(results, key=lambda r: (r.group, r.name))]
        arguments.json.write_text(json.dumps({"summary": total, "runs": runs}, indent=1) + "\n")
    return int(any(r.findings for r in results))


if __name__ == "__main__":
    sys.exit(main())
