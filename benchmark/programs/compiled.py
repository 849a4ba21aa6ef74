"""What the adapters of C++ programs have in common: run.sh compiles their main.cpp into BUILT_PROGRAMS, and they read and write OFF."""

import os
import subprocess
from pathlib import Path

import numpy as np

from fairbench.adapter import RefusedError, Task
from fairbench.meshes import Mesh


def write_off(path: Path, vertices, faces) -> None:
    """With the digits that give the same numbers when read."""
    lines = [f"OFF\n{len(vertices)} {len(faces)} 0"]
    lines += [" ".join(map(repr, map(float, p))) for p in vertices]
    lines += [f"3 {a} {b} {c}" for a, b, c in faces]
    path.write_text("\n".join(lines) + "\n")


def read_off(path: Path) -> Mesh:
    """An OFF file of triangles, as C++ programs write it."""
    words = path.read_text().split()
    count, faces = int(words[1]), int(words[2])
    vertices = np.array(words[4 : 4 + 3 * count], float).reshape(-1, 3)
    return Mesh(vertices, np.array(words[4 + 3 * count :], np.int64).reshape(faces, 4)[:, 1:])


def ran(task: Task, name: str, *words: str) -> tuple[Mesh, int]:
    """The result and the exit code of `NAME INPUT.off fill|fair NUMBERS OUTPUT.off WORD...`: 0 for a success, 1 without a result."""
    if task.kind not in ("fill", "fair"):
        raise RefusedError("not one of its tasks")
    given, numbers, result = (task.scratch / each for each in ("given.off", "numbers.txt", "result.off"))
    write_off(given, task.vertices, task.faces)
    numbers.write_text("\n".join(map(str, task.told["hole" if task.kind == "fill" else "free"])))
    command = [Path(os.environ["BUILT_PROGRAMS"]) / name, given, task.kind, numbers, result, *words]
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    if not result.exists():
        raise RefusedError(done.stderr.strip()[-300:] or f"exit code {done.returncode}")
    return read_off(result), done.returncode
