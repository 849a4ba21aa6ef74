"""Damaged files: refused with nothing touched, or a right result, within bounded memory."""

from __future__ import annotations

import random
import shutil
from pathlib import Path

import numpy as np

from cases import DONE, REFUSED, WRITTEN, Place, Result
from checker import Findings
from formats import File, UnreadableError, ending, read, write
from generated import sphere

LIMIT = 10
# Peak memory of a run on a small file: the program itself, and so many bytes for each of the file.
MEMORY, MEMORY_FACTOR = 48 * 1024, 1.0
NUMBERS = [
    b"-1",
    b"0",
    b"7",
    b"65536",
    b"2147483647",
    b"4294967295",
    b"4294967296",
    b"18446744073709551615",
    b"1e999",
    b"nan",
]


def pristine(folder: Path, form: str) -> tuple[Path, int]:
    """A sphere of 42 vertices with a hole, and the number of a vertex that may be free."""
    x, triangles = sphere(1)
    path = folder / f"whole{ending(form)}"
    write(path, form, x, triangles[~(triangles == 0).any(1)])
    file = read(path)
    corners, counts = np.unique(file.triangles(), return_counts=True)
    far = int(corners[np.argmin(file.points[corners] @ x[0])])
    assert counts[far] >= 5
    return path, far


def truncations(data: bytes, step: int) -> list[tuple[str, bytes]]:
    return [(f"cut{k}", data[:k]) for k in range(0, len(data), step)]


def mutate(data: bytes, rng: random.Random) -> bytes:
    """One to three random changes."""
    for _ in range(rng.randint(1, 3)):
        data = rng.choice([flip, cut_out, repeat, line_gone, line_twice, other_number, garbage])(data, rng)
    return data


def flip(data: bytes, rng: random.Random) -> bytes:
    at = rng.randrange(max(len(data), 1))
    return data[:at] + bytes([data[at] ^ (1 << rng.randrange(8))]) + data[at + 1 :] if data else data


def cut_out(data: bytes, rng: random.Random) -> bytes:
    at = rng.randrange(len(data) + 1)
    return data[:at] + data[at + rng.randint(1, 60) :]


def repeat(data: bytes, rng: random.Random) -> bytes:
    at = rng.randrange(len(data) + 1)
    return data[:at] + data[max(0, at - rng.randint(1, 60)) : at] + data[at:]


def line_gone(data: bytes, rng: random.Random) -> bytes:
    rows = data.split(b"\n")
    del rows[rng.randrange(len(rows))]
    return b"\n".join(rows)


def line_twice(data: bytes, rng: random.Random) -> bytes:
    rows = data.split(b"\n")
    at = rng.randrange(len(rows))
    return b"\n".join(rows[: at + 1] + rows[at:])


def other_number(data: bytes, rng: random.Random) -> bytes:
    """In place of a number near the beginning, where the counts are."""
    places = [i for i in range(1, min(len(data), 400)) if data[i : i + 1].isdigit() and data[i - 1 : i].isspace()]
    if not places or rng.random() < 0.2:
        at = min(80, max(len(data) - 4, 0))
        return data[:at] + rng.randbytes(4) + data[at + 4 :]
    at = rng.choice(places)
    end = at
    while data[end : end + 1].isdigit():
        end += 1
    return data[:at] + rng.choice(NUMBERS) + data[end:]


def garbage(data: bytes, rng: random.Random) -> bytes:
    at = rng.randrange(len(data) + 1)
    return data[:at] + rng.randbytes(rng.randint(1, 20)) + data[at:]


def damaged(place: Place, form: str, count: int, step: int) -> list[Result]:
    """All damaged files of one format; truncations are filled in place and faired by turns."""
    folder = place.make(f"mutations_{form}")
    path, free = pristine(folder, form)
    data = path.read_bytes()
    (folder / "free.txt").write_text(f"{free}\n")
    rng = place.rng("mutations", form)
    files = truncations(data, step) + [(f"mutation{k}", mutate(data, rng)) for k in range(count)]
    results = [one(place, folder, form, name, damage, number % 2 == 0) for number, (name, damage) in enumerate(files)]
    if not any(r.findings for r in results):
        shutil.rmtree(folder)
    return results


def one(place: Place, parent: Path, form: str, name: str, damage: bytes, filled: bool) -> Result:
    folder = parent / name
    folder.mkdir()
    kept, used = folder / f"damaged{ending(form)}", folder / f"in{ending(form)}"
    kept.write_bytes(damage)
    used.write_bytes(damage)
    words = ["fill", used, "-o", used] if filled else ["fair", used, "-o", used, "--free", parent / "free.txt"]
    command = [place.program, *words, "--threads", "1"]
    run = place.runner.run(command, LIMIT)
    text = f"cp {kept} {used}; " + " ".join(str(w) for w in command)
    result = Result(
        "damaged", f"{form}_{name}", {DONE: "done", REFUSED: "refused", WRITTEN: "written"}.get(run["code"], "crash")
    )
    result.command, result.cpu, result.kilobytes = text, run["cpu"], run["kilobytes"]
    result.findings = judge(run, folder, kept, used, filled)
    if not result.findings:
        shutil.rmtree(folder)
    return result


def judge(run: dict, folder: Path, kept: Path, used: Path, filled: bool) -> Findings:
    left = {p.name for p in folder.iterdir()} - {kept.name, used.name}
    findings: Findings = [("left", f"temporary files: {', '.join(sorted(left))}")] if left else []
    allowed = MEMORY + MEMORY_FACTOR * kept.stat().st_size / 1024
    if run["kilobytes"] > allowed:
        findings.append(("memory", f"{run['kilobytes']} kB for a file of {kept.stat().st_size} bytes"))
    if run["hang"]:
        return [*findings, ("hang", f"not done after {LIMIT} CPU seconds")]
    if run["code"] not in (DONE, REFUSED, WRITTEN):
        return [*findings, ("crash", f"exit code {run['code']}: {run['text'][-200:].strip()}")]
    if run["code"] == REFUSED:
        touched = kept.read_bytes() != used.read_bytes()
        return [*findings, ("touched", "refused, but the file has changed")] if touched else findings
    return findings + still_there(kept, used, filled)


def still_there(kept: Path, used: Path, filled: bool) -> Findings:
    """What the damaged file says must be in the result."""
    try:
        before = read(kept)
    except UnreadableError as error:
        return [("misread", f"the file says nothing ({error}), but was taken")]
    if not before.polygons:
        return [("misread", "the file has no face, but was taken")]
    try:
        after = read(used)
    except UnreadableError as error:
        return [("unreadable", f"the result cannot be read: {error}")]
    count, faces = len(before.points), len(before.polygons)
    if kept.suffix == ".stl":
        return stl_still_there(before, after, filled)
    if after.polygons[:faces] != before.polygons or (not filled and len(after.polygons) != faces):
        return [("misread", "the result has other faces")]
    if len(after.points) < count:
        return [("misread", "the result has fewer vertices")]
    moved = changed(before.points, after.points[:count]).any(1).sum()
    return [("misread", f"{moved} vertices have moved")] if moved > (0 if filled else 1) else []


def changed(a: np.ndarray, b: np.ndarray) -> np.ndarray:
    return (a != b) & ~(np.isnan(a) & np.isnan(b))


def stl_still_there(before: File, after: File, filled: bool) -> Findings:
    corners = [f.points[f.triangles()] for f in (before, after)]
    if len(corners[1]) < len(corners[0]):
        return [("misread", f"{len(corners[0])} facets have become {len(corners[1])}")]
    # A filled STL is written in single precision.
    moved = changed(corners[0].astype(np.float32), corners[1][: len(corners[0])].astype(np.float32)).any(2)
    vertices = len(np.unique(before.triangles()[moved]))
    return [("misread", f"{vertices} vertices have moved")] if vertices > (0 if filled else 1) else []
