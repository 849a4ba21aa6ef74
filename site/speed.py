"""Writes docs/speed.md: `speed.py FAIRMESH [LARGEST]`. Seconds and memory of whole runs of the program, by size.

Seconds are those of the processor, with one thread: what else runs on the machine changes them little. LARGEST bounds the number of free
vertices; a million takes a minute and 2 GB.
"""

import json
import os
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path
from typing import NamedTuple

ROOT = Path(__file__).resolve().parent.parent
WORK = ROOT / "target/speed"
SIZES = (1_000, 10_000, 100_000, 1_000_000)
# What may be asked for besides, at one size.
VARIANTS = (
    ("as it comes", ""),
    ("`--tolerance 1e-6`", "--tolerance 1e-6"),
    ("`--inner-fairness conformal`", "--inner-fairness conformal"),
    ("`--continuity g1`", "--continuity g1"),
    ("`--continuity g2`", "--continuity g2"),
    ("`--target minimal-energy`", "--target minimal-energy"),
    ("`--intersections skip`", "--intersections skip"),
)
VARIANTS_AT = 100_000


class Run(NamedTuple):
    """One run of the program."""

    report: dict
    seconds: float
    megabytes: float


def run(program: str, *words: str) -> Run:
    """Runs it in the working folder; the seconds are those of the processor."""
    command = [program, *words]
    report = WORK / "report.json"
    if words[0] != "generate":
        command += ["--json", str(report)]
    with subprocess.Popen(command, cwd=WORK, stdout=subprocess.DEVNULL) as process:
        _, status, used = os.wait4(process.pid, 0)
        process.returncode = os.waitstatus_to_exitcode(status)
    if process.returncode != 0:
        sys.exit(f"{' '.join(command)}: exit code {process.returncode}")
    read = json.loads(report.read_text()) if words[0] != "generate" else {}
    return Run(read, used.ru_utime + used.ru_stime, used.ru_maxrss / 1024)


def best(program: str, *words: str) -> Run:
    """The quickest of up to three runs, fewer where one takes long."""
    found = run(program, *words)
    for _ in range(2):
        if found.seconds < 20:
            found = min(found, run(program, *words), key=lambda ran: ran.seconds)
    return found


def number(value: float) -> str:
    """Two digits, or a whole number."""
    return f"{value:.2f}" if value < 1 else f"{value:.1f}" if value < 10 else f"{value:,.0f}"


def cap(program: str, size: int) -> None:
    """A flattened cap of an ellipsoid, irregular: cap.ply and free.txt."""
    shape = ["--vertices", str(size), "--triangulation", "irregular", "--start", "flat"]
    run(program, "generate", "ellipsoid", *shape, "-o", "cap.ply", "--free", "free.txt")


def fairing(program: str, largest: int) -> Iterator[str]:
    """Rows of the first table."""
    for size in (size for size in SIZES if size <= largest):
        cap(program, size)
        words = ("fair", "cap.ply", "-o", "fair.ply", "--free", "free.txt")
        one, every = best(program, *words, "--threads", "1"), run(program, *words)
        free = sum(part["free_vertices"] for part in one.report["components"])
        yield f"| {free:,} | {number(one.seconds)} | {one.seconds / free * 1e6:.0f} | {number(one.megabytes)} | {number(every.megabytes)} |"


def variants(program: str, largest: int) -> Iterator[str]:
    """Rows of the second table."""
    cap(program, min(VARIANTS_AT, largest))
    plain = None
    for name, option in VARIANTS:
        ran = best(program, "fair", "cap.ply", "-o", "fair.ply", "--free", "free.txt", "--threads", "1", *option.split())
        plain = plain or ran.seconds
        iterations = max(part["iterations"] for part in ran.report["components"])
        yield f"| {name} | {number(ran.seconds)} | {ran.seconds / plain:.1f} | {iterations} |"


def filling(program: str, largest: int) -> Iterator[str]:
    """Rows of the third table."""
    for size in (size for size in SIZES if size <= largest):
        shape = ["--vertices", str(size), "--triangulation", "irregular"]
        run(program, "generate", "sphere-hole", *shape, "-o", "open.ply")
        ran = best(program, "fill", "open.ply", "-o", "closed.ply", "--threads", "1")
        new = ran.report["new_vertices"]
        yield f"| {size:,} | {new:,} | {number(ran.seconds)} | {number(ran.megabytes)} |"


def machine() -> str:
    """The processor's name."""
    lines = Path("/proc/cpuinfo").read_text().splitlines()
    names = [line.split(":")[1].strip() for line in lines if line.startswith("model name")]
    return f"{names[0]}, {len(names)} threads" if names else "unknown"


PAGE = """# Speed and memory

How long a mesh of your size takes, and how much memory. Measure your own machine with

```console
site/speed.sh
```

which writes this page. Machine of this run: {machine}. Seconds are CPU seconds of the whole program, with reading and
writing, on one thread. See also [what more threads save](measurements.md#times) and [other programs](peers.md#time). All of these runs
converge.

## Fairing, by size

A flattened cap of an ellipsoid, irregular triangles, only the mesh given. What counts is the number of [free](glossary.md) vertices;
the rest of the mesh is little more than read and written.

| free vertices | seconds | microseconds a vertex | MB, one thread | MB, all threads |
|---|---|---|---|---|
{fairing}

## What makes it longer

The same with {at:,} free vertices and one option more.

| | seconds | times | iterations |
|---|---|---|---|
{variants}

A difficult region is tried in several ways, which takes several times as long. `--max-iterations` bounds it: 500 by default, 64 for a
hole. Ctrl-C leaves the file as it was.

## Filling holes, by size

A sphere with a round hole of 60 degrees half-angle, by size of the mesh. A patch that would have more than 200,000 vertices is coarser
inside (`--max-new-vertices`), as that of the largest mesh here.

| vertices | new vertices | seconds | MB |
|---|---|---|---|
{filling}
"""


def main(program: str, largest: int) -> None:
    """Measures everything and writes the page."""
    WORK.mkdir(parents=True, exist_ok=True)
    tables = {
        "fairing": "\n".join(fairing(program, largest)),
        "variants": "\n".join(variants(program, largest)),
        "filling": "\n".join(filling(program, largest)),
    }
    page = PAGE.format(machine=machine(), at=VARIANTS_AT, **tables)
    (ROOT / "docs/speed.md").write_text(page)


if __name__ == "__main__":
    main(str(Path(sys.argv[1]).resolve()), int(sys.argv[2]) if len(sys.argv) > 2 else SIZES[-1])
