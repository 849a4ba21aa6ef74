"""The command line of fairmesh, FAIRMESH_PROGRAM: with tangent planes (g1), or with curvature (g2)."""

import os
import subprocess
import sys

from fairbench.adapter import Answer, Refused, Task, main
from fairbench.meshes import read_ply

PROGRAM = os.environ["FAIRMESH_PROGRAM"]


def run(task: Task) -> Answer:
    result, list_file = task.scratch / "result.ply", task.scratch / "list.txt"
    if task.kind == "fill":
        words = ["fill", task.path, "--relax-rim", "3"] if "rim" in sys.argv[3:] else ["fill", task.path]
    elif task.kind == "join":
        loops = boundary_numbers(task)
        words = ["fill", task.path, "--join", ",".join(map(str, loops))]
    elif task.kind == "fair":
        list_file.write_text("\n".join(map(str, task.told["free"])))
        words = ["fair", task.path, "--free", list_file]
    elif task.kind == "bump":
        words = ["fair", task.path, "--bump", ",".join(map(repr, task.told["point"]))]
    else:
        raise Refused("not one of its tasks")
    if "g2" in sys.argv[3:]:
        words += ["--continuity", "g2"]
    ran = subprocess.run([PROGRAM, *map(str, words), "-o", str(result), "--threads", "1"], capture_output=True, text=True, check=False)
    if not result.exists():
        raise Refused(ran.stderr.strip()[-300:])
    mesh = read_ply(result)
    return Answer(mesh.vertices, mesh.faces, ran.returncode == 0, ran.stdout.strip().splitlines()[0])


def boundary_numbers(task: Task) -> list[int]:
    """The numbers of the loops through the vertices that are told."""
    import json

    listed = subprocess.run([PROGRAM, "holes", str(task.path), "--json", "-"], capture_output=True, text=True, check=True).stdout
    loops = json.loads(listed)["loops"]
    return [next(k for k, loop in enumerate(loops) if vertex in loop["vertices"]) for vertex in task.told["loops"]]


main(run, subprocess.run([PROGRAM, "--version"], capture_output=True, text=True, check=True).stdout.split()[1])
