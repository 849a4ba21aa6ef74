"""One run of the program, judged: a fairing or a filling of a mesh in some format."""

from __future__ import annotations

import hashlib
import random
import shutil
from dataclasses import dataclass, field
from pathlib import Path

import numpy as np

from checker import Findings, clean, judge_fair, judge_fill, kinks_before, load_report, success
from formats import FORMATS, ending, read, write
from generated import hub, slot, sphere
from meshes import Surroundings, are_apart, compact, load, regions
from runner import Runner

# CPU seconds after which a run counts as a hang.
FAIR_LIMIT, FILL_LIMIT = 30, 10
# Exit codes: done and sound; refused, nothing written; written, but not what was asked.
DONE, REFUSED, WRITTEN = 0, 2, 3


@dataclass
class Result:
    """What became of one run."""

    group: str
    name: str
    outcome: str
    findings: Findings = field(default_factory=list)
    command: str = ""
    cpu: float = 0.0
    kilobytes: int = 0


@dataclass
class Place:
    """Where runs happen, with what."""

    program: Path
    folder: Path
    runner: Runner
    seed: int

    def rng(self, *what: object) -> random.Random:
        digest = hashlib.sha256(" ".join(str(w) for w in (self.seed, *what)).encode()).digest()
        return random.Random(digest)

    def make(self, name: str) -> Path:
        folder = self.folder / name
        shutil.rmtree(folder, ignore_errors=True)
        folder.mkdir(parents=True)
        return folder

    def call(self, group: str, folder: Path, words: list, limit: int, judge, keep: bool = False) -> Result:
        """Runs and judges; the folder stays if something was found, so that the command can be repeated."""
        command = [self.program, *words, "--json", folder / "report.json", "--threads", "1"]
        run = self.runner.run(command, limit)
        result = Result(group, folder.name, "", cpu=run["cpu"], kilobytes=run["kilobytes"])
        result.command = " ".join(str(word) for word in command)
        result.outcome, result.findings = judged(run, folder, limit, judge)
        if not result.findings and not keep:
            shutil.rmtree(folder)
        return result


def judged(run: dict, folder: Path, limit: int, judge) -> tuple[str, Findings]:
    written = sorted(p.name for p in folder.iterdir() if p.name.startswith(("out", ".fairmesh")))
    if run["hang"]:
        return "hang", [("hang", f"not done after {limit} CPU seconds")]
    if run["code"] not in (DONE, REFUSED, WRITTEN):
        return "crash", [("crash", f"exit code {run['code']}: {run['text'][-200:].strip()}")]
    if run["code"] == REFUSED:
        return "refused", [("refused", f"but wrote {', '.join(written)}")] if written else []
    if len(written) != 1:
        return "written", [("written", f"files left: {', '.join(written)}")]
    report = load_report(folder / "report.json")
    return judge(report, run["code"] == DONE)


def fair(
    place: Place, group: str, name: str, x: np.ndarray, triangles: np.ndarray, free: np.ndarray, how: dict
) -> Result:
    """Fairs a region. `how`: format, out (format), and options by name."""
    folder = place.make(name)
    before, after = folder / f"in{ending(how['format'])}", folder / f"out{ending(how.get('out', how['format']))}"
    write(before, how["format"], x, triangles)
    file = read(before)
    # An STL numbers its vertices by itself.
    numbers = np.full(len(x), -1)
    numbers[triangles.ravel()] = file.triangles().ravel()
    free = np.unique(numbers[free])
    (folder / "free.txt").write_text("".join(f"{v}\n" for v in free))
    options = [
        word
        for key in ("inner-fairness", "normals", "sharp", "continuity")
        if key in how
        for word in (f"--{key}", how[key])
    ]

    def judge(report: dict, done: bool) -> tuple[str, Findings]:
        wrong = [("code", f"exit 0 is {done}, the outcome {report['outcome']}")] if done != success(report) else []
        if "seen" in how:
            how["seen"].update(zip(free.tolist(), read(after).points[free].tolist(), strict=True))
        # An edge that goes on has two normals at its vertices, of which none is the outside's average.
        averaged = how.get("normals") == "averaged" and how.get("sharp") == "off"
        findings = judge_fair(before, after, free, report, how["format"], averaged)
        return report["outcome"], wrong + findings

    words = ["fair", before, "-o", after, "--free", folder / "free.txt", *options]
    return place.call(group, folder, words, FAIR_LIMIT, judge, "seen" in how)


def fill(
    place: Place, group: str, name: str, x: np.ndarray, triangles: np.ndarray, form: str, was: dict | None
) -> Result:
    folder = place.make(name)
    before, after = folder / f"in{ending(form)}", folder / f"out{ending(form)}"
    write(before, form, x, triangles)

    def judge(report: dict, done: bool) -> tuple[str, Findings]:
        wrong = [loop["told"] for loop in report["loops"] if done and not clean(loop)]
        findings = [("code", f"exit 0 with a loop {told}") for told in wrong]
        return "filled" if done else "partly filled", findings + judge_fill(before, after, report, was)

    return place.call(group, folder, ["fill", before, "-o", after], FILL_LIMIT, judge)


def mesh_cases(place: Place, path: Path) -> list[Result]:
    """All runs on one public mesh: three regions, one of them twice, two inner fairnesses, its holes and holes made."""
    loaded = load(path)
    if loaded is None:
        return []
    x, triangles = loaded
    rng = place.rng(path.name)
    form = rng.randrange(len(FORMATS))
    results = []
    grown = regions(x, triangles, rng)
    for k, region in enumerate(grown):
        normals = "averaged" if k == 1 else "fitted"
        for weights in ("uniform", "conformal"):
            form = (form + 1) % len(FORMATS)
            how = {"format": FORMATS[form], "inner-fairness": weights, "normals": normals}
            if k == 2 and weights == "conformal":
                how["out"] = FORMATS[(form + 3) % len(FORMATS)]
            results.append(fair(place, "fair", f"{path.stem}_region{k}_{weights}", x, triangles, region, how))
            if k == 1:
                how["sharp"] = "off"
                results.append(fair(place, "fair", f"{path.stem}_smooth{k}_{weights}", x, triangles, region, how))
    for rings, continuity in ((APART, "g1"), (FAR_APART, "auto")):
        if len(grown) == 3 and are_apart(Surroundings(len(x), triangles), grown[0], grown[1], rings):
            name = f"{path.stem}_together_{continuity}"
            results += together(place, name, x, triangles, grown[0], grown[1], continuity)
    results.append(fill(place, "holes", f"{path.stem}_holes", x, triangles, FORMATS[form], None))
    for k, region in enumerate(grown[1:], 1):
        inside = np.isin(triangles, region).any(1)
        was = kinks_before(x, triangles[inside], triangles[~inside])
        form = (form + 1) % len(FORMATS)
        results.append(
            fill(place, "deleted", f"{path.stem}_deleted{k}", *compact(x, triangles[~inside]), FORMATS[form], was)
        )
    return results


# Rings between two regions, so that no normal, fitted to eight, depends on the other region,
APART = 10
# and so that no curvature does, the error of whose estimate is told up to sixteen rings outside.
FAR_APART = 18


def together(
    place: Place, name: str, x: np.ndarray, triangles: np.ndarray, a: np.ndarray, b: np.ndarray, continuity: str
) -> list[Result]:
    """Two regions in one call have the positions that each has alone, to the last bit."""
    alone: dict[int, list] = {}
    both: dict[int, list] = {}
    form = {"format": "ply-binary-double", "continuity": continuity}
    runs = [
        fair(place, "together", f"{name}_{k}", x, triangles, r, form | {"seen": alone}) for k, r in enumerate((a, b))
    ]
    last = fair(place, "together", f"{name}_both", x, triangles, np.union1d(a, b), form | {"seen": both})
    different = [v for v in both if v in alone and alone[v] != both[v]]
    if different:
        told = (
            f"{len(different)} vertices, first {min(different)}, are elsewhere than when their region is faired alone"
        )
        last.findings.append(("component", f"{told} ({', '.join(r.outcome for r in runs)})"))
    else:
        for run in (*runs, last):
            if not run.findings:
                shutil.rmtree(place.folder / run.name)
    return [*runs, last]


def slot_case(place: Place, around_end: int, along: int, ratio: float) -> Result:
    x, triangles = slot(around_end, along, ratio)
    form = FORMATS[(around_end + along) % len(FORMATS)]
    return fill(place, "slots", f"slot_{2 * (around_end + along)}_edges_ratio_{ratio:g}", x, triangles, form, None)


SLOTS = [(a, b, r) for a, b in ((4, 1), (8, 2), (18, 1), (50, 10), (100, 100)) for r in (1.0, 10.0, 100.0, 1e3, 1e4)]


def hub_case(place: Place, valence: int) -> Result:
    how = {"format": "ply-binary-double"}
    return fair(place, "hubs", f"hub_{valence}", *hub(valence), how)


def far_case(place: Place, offset: float, form: str) -> Result:
    """A dented sphere far from the origin: single precision has few digits left there."""
    x, triangles = sphere(4)
    free = np.flatnonzero(x[:, 2] > 0.7)
    x[free, 2] -= 0.1
    return fair(place, "far", f"far_{offset:g}_{form}", x + np.array([offset, 0, 0]), triangles, free, {"format": form})


FAR = [
    (offset, form)
    for offset in (1e2, 1e4, 1e5, 1e6)
    for form in ("ply-binary-float", "ply-ascii-float", "stl-binary", "obj")
]
