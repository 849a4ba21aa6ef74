"""Runs a program on a case, in a process of its own, which sees the input alone; with a limit of time and of memory."""

from __future__ import annotations

import json
import os
import subprocess
import time
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np

from .cases import Case
from .meshes import Mesh, read_ply, write_ply
from .programs import Program

#: Seconds that a run may take. Of 3,562 runs two of CGAL's never end, of others the slowest takes 3.4, so that half or double changes none.
SECONDS = 60.0
#: Bytes that it may hold. The largest of 3,562 runs holds .3 GiB, so that half or double changes none.
MEMORY = 4 << 30
#: A result with coordinates so many times as large as the input's, or that are no numbers, is no mesh. Three of 3,562 are (PMP's, 860 times and more), no other
#: is more than 6 times as large: half and double change none.
FAR = 100.0
#: Between two looks at its memory, in seconds.
LOOK = 0.1


class Run(NamedTuple):
    """What came of it."""

    #: None where there is no result.
    result: Mesh | None
    #: What the adapter says: version, cpu, seconds, peak, success, words, refused.
    said: dict[str, Any]
    #: "done", "refused", "out of time", "out of memory", "crashed" or "no mesh".
    ended: str


def write_task(case: Case, folder: Path) -> None:
    """The input of a case, and nothing of its truth."""
    folder.mkdir(parents=True, exist_ok=True)
    write_ply(folder / "mesh.ply", case.mesh)
    (folder / "task.json").write_text(json.dumps({"task": case.task, "told": case.told}))


def run(program: Program, task: Path, out: Path, python: Path) -> Run:
    """Runs a program on a task that was written, and reads what it leaves in the folder `out`."""
    out.mkdir(parents=True, exist_ok=True)
    for old in out.iterdir():
        old.unlink()
    words = [str(python), str(program.folder / "adapter.py"), str(task), str(out), *program.arguments]
    root = str(Path(__file__).resolve().parent.parent)
    environment = {**os.environ, "PYTHONPATH": root, "OMP_NUM_THREADS": "1", "OPENBLAS_NUM_THREADS": "1"}
    with (out / "log.txt").open("wb") as log:
        process = subprocess.Popen(words, stdout=log, stderr=log, env=environment, start_new_session=True)
        stopped = _watched(process)
    said_file, mesh_file = out / "said.json", out / "mesh.ply"
    said = json.loads(said_file.read_text()) if said_file.exists() else {}
    if stopped or not said:
        return Run(None, said, stopped or "crashed")
    if "refused" in said or not mesh_file.exists():
        return Run(None, said, "refused")
    result = read_ply(mesh_file)
    given = read_ply(task / "mesh.ply")
    if len(result.faces) == 0 or not (np.abs(result.vertices[result.faces]) < FAR * np.abs(given.vertices).max()).all():
        return Run(None, said, "no mesh")
    return Run(result, said, "done")


def _watched(process: subprocess.Popen[bytes]) -> str:
    """Waits for the end; stops the process and those that it has started where a limit is exceeded, and says which."""
    start = time.monotonic()
    while process.poll() is None:
        why = "out of time" if time.monotonic() - start > SECONDS else "out of memory" if _held(process.pid) > MEMORY else ""
        if why:
            os.killpg(process.pid, 9)
            process.wait()
            return why
        time.sleep(LOOK)
    return ""


def _held(group: int) -> int:
    """Bytes that the processes of a group hold."""
    total = 0
    for path in Path("/proc").glob("[0-9]*"):
        try:
            fields = (path / "stat").read_text().rsplit(")", 1)[1].split()
            if int(fields[2]) == group:
                total += int((path / "statm").read_text().split()[1]) * os.sysconf("SC_PAGE_SIZE")
        except (OSError, IndexError, ValueError):
            continue
    return total
