"""The command line of fairmesh, FAIRMESH_PROGRAM: by default, with tangent planes (g1), or with curvature (g2)."""

import json
import os
import subprocess
import sys
from typing import Any

import numpy as np

from fairbench.adapter import Answer, RefusedError, Task, main
from fairbench.meshes import read_ply

#: The cosine of 10 degrees: half of the least bend of an edge that is told, more than that of facets.
SHARP = 0.985
PROGRAM = os.environ["FAIRMESH_PROGRAM"]


def run(task: Task) -> Answer:
    continuity = sys.argv[3:]
    result, list_file = task.scratch / "result.ply", task.scratch / "list.txt"
    if task.kind == "fill":
        words = ["fill", task.path, *hole(task)]
    elif task.kind == "join":
        words = ["fill", task.path, "--join", ",".join(map(str, numbers(task)))]
    elif task.kind == "fair":
        list_file.write_text("\n".join(map(str, task.told["free"])))
        words = ["fair", task.path, "--free", list_file]
    elif task.kind == "bump":
        words = ["fair", task.path, "--bump", ",".join(map(repr, task.told["point"]))]
    elif task.kind == "round":
        words = ["round", task.path, "--radius", task.told["radius"], *edges(task)]
    else:
        raise RefusedError("not one of its tasks")
    if continuity:
        words += ["--continuity", *continuity]
    ran = subprocess.run([PROGRAM, *map(str, words), "-o", str(result), "--threads", "1"], capture_output=True, text=True, check=False)
    if not result.exists():
        raise RefusedError(ran.stderr.strip()[-300:])
    mesh = read_ply(result)
    return Answer(mesh.vertices, mesh.faces, ran.returncode == 0, ran.stdout.strip().splitlines()[0])


def edges(task: Task) -> list[str]:
    """The sharp ones between vertices of the edge that is told."""
    corners = task.vertices[task.faces]
    normals = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    normals /= np.maximum(np.linalg.norm(normals, axis=1, keepdims=True), 1e-300)
    beside: dict[tuple[int, int], int] = {}
    words = []
    told = set(task.told["edge"])
    for face, triangle in enumerate(task.faces.tolist()):
        for a, b in zip(triangle, triangle[1:] + triangle[:1], strict=True):
            if a in told and b in told:
                other = beside.setdefault((min(a, b), max(a, b)), face)
                if normals[face] @ normals[other] < SHARP:
                    words += ["--edges", f"{a},{b}"]
    return words


def holes(task: Task) -> list[dict[str, Any]]:
    """What `fairmesh holes` tells of each loop."""
    listed = subprocess.run([PROGRAM, "holes", str(task.path), "--json", "-"], capture_output=True, text=True, check=True)
    return json.loads(listed.stdout)


def hole(task: Task) -> list[str]:
    """The number of the hole, and the flags that are advised where its boundary is rough, as the documents say."""
    number, told = next((k, each) for k, each in enumerate(holes(task)) if task.told["hole"][0] in each["vertices"])
    advised = (told["roughness"] or {}).get("advice")
    rough = ["--relax-rim", str(advised["relax_rim"]), "--relax-within", repr(advised["relax_within"])] if advised else []
    return ["--loop", str(number), *rough]


def numbers(task: Task) -> list[int]:
    """The numbers of the loops through the vertices that are told."""
    loops = holes(task)
    return [next(k for k, loop in enumerate(loops) if vertex in loop["vertices"]) for vertex in task.told["loops"]]


main(run, subprocess.run([PROGRAM, "--version"], capture_output=True, text=True, check=True).stdout.split()[1])
