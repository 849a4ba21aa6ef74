"""Writes REPRODUCTION.md, docs/measurements.md, docs/ladder.md or docs/g2.md. `./reproduce.sh` starts this."""

from __future__ import annotations

import argparse
import os
from pathlib import Path

from . import measurements, paper
from .tool import Scan, Tool, renew

ROOT = Path(__file__).resolve().parent.parent


def machine() -> str:
    """What figures in seconds belong to."""
    lines = Path("/proc/cpuinfo").read_text(encoding="utf-8").splitlines()
    names = [line.partition(":")[2].strip() for line in lines if line.startswith("model name")]
    return f"{names[0] if names else 'an unknown processor'}, {len(os.sched_getaffinity(0))} threads"


def main() -> None:
    """The command line."""
    parser = argparse.ArgumentParser(prog="reproduce.sh", description=__doc__)
    parser.add_argument(
        "what",
        nargs="?",
        choices=["paper", "measurements", "continuity", "ladder"],
        default="paper",
    )
    parser.add_argument("--program", type=Path, required=True, help="fairmesh")
    parser.add_argument("--meshes", type=Path, help="whose regions are faired")
    parser.add_argument("--runs", type=int, default=5, help="of each row of the paper's table")
    parser.add_argument(
        "--scan",
        nargs=4,
        action="append",
        default=[],
        metavar=("NAME", "MESH", "FREE-VERTICES", "VIEW"),
    )
    asked = parser.parse_args()
    scans = [Scan(name, Path(mesh), Path(free), view) for name, mesh, free, view in asked.scan]
    pictures = "g2" if asked.what == "continuity" else "reproduction"
    tool = Tool(asked.program, ROOT / "target/reproduction", ROOT / "docs" / pictures)
    if asked.what == "measurements":
        file, parts = "docs/measurements.md", measurements.document(tool, machine())
    elif asked.what == "ladder":
        # Needs the Python package.
        from . import ladder

        file, parts = "docs/ladder.md", ladder.document(asked.meshes)
    elif asked.what == "continuity":
        # So does this.
        from . import continuity

        file, parts = "docs/g2.md", continuity.document(tool, scans, machine())
    else:
        file, parts = "REPRODUCTION.md", paper.document(tool, scans, machine(), asked.runs)
    renew(ROOT / file, parts)


main()
