"""What the adapter of a program needs: `main(run, version)` in a process of its own, which sees the input alone. Needs numpy only."""

from __future__ import annotations

import json
import resource
import sys
import time
import traceback
from collections.abc import Callable
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np

from .meshes import Faces, Mesh, Points, read_ply, write_ply


class Task(NamedTuple):
    """What is asked; see README.md for what is told of each kind."""

    #: "fill", "fair", "bump", "join" or "round".
    kind: str
    vertices: Points
    faces: Faces
    told: dict[str, Any]
    #: Where the input is, for programs that read files, and where they may write.
    path: Path
    scratch: Path


class Answer(NamedTuple):
    """What a program has made, and whether it says that all is well; None if it has no word for that."""

    vertices: Points
    faces: Faces
    success: bool | None = None
    words: str = ""


class RefusedError(Exception):
    """The program says that it cannot do this."""


def main(run: Callable[[Task], Answer], version: str) -> None:
    """Reads the task, runs the program, writes mesh.ply and said.json."""
    folder, out = Path(sys.argv[1]), Path(sys.argv[2])
    mesh = read_ply(folder / "mesh.ply")
    asked = json.loads((folder / "task.json").read_text())
    task = Task(asked["task"], mesh.vertices, mesh.faces, asked["told"], folder / "mesh.ply", out)
    said: dict[str, object] = {"version": version}
    start, wall = _cpu(), time.perf_counter()
    try:
        answer = run(task)
        said.update(success=answer.success, words=answer.words)
    except RefusedError as why:
        said.update(success=False, refused=str(why))
        answer = None
    except Exception as why:
        said.update(success=False, refused=f"{type(why).__name__}: {why}", trace=traceback.format_exc())
        answer = None
    said.update(cpu=_cpu() - start, seconds=time.perf_counter() - wall, peak=_peak())
    if answer is not None:
        write_ply(out / "mesh.ply", Mesh(np.asarray(answer.vertices, float), np.asarray(answer.faces, np.int64)))
    (out / "said.json").write_text(json.dumps(said, indent=1))


def _cpu() -> float:
    used = [resource.getrusage(of) for of in (resource.RUSAGE_SELF, resource.RUSAGE_CHILDREN)]
    return sum(each.ru_utime + each.ru_stime for each in used)


def _peak() -> int:
    """Bytes, of this process or of a program that it has started. What it inherited does not count."""
    own = next(int(line.split()[1]) for line in Path("/proc/self/status").read_text().splitlines() if line.startswith("VmHWM"))
    return 1024 * max(own, resource.getrusage(resource.RUSAGE_CHILDREN).ru_maxrss)
