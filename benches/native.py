"""How much the program that is published loses against one compiled for this processor alone.

    packaging/build.sh linux-x86_64 && python3 benches/native.py

Builds the program with -C target-cpu=native into target/native, runs both in turn on the same meshes with one thread,
and prints the shortest processor time of each and their ratio. Both have to write the same bytes.
"""

import filecmp
import os
import resource
import subprocess
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]
TARGET = Path(os.environ.get("CARGO_TARGET_DIR", ROOT / "target"))
RUNS = 7
CASES = {
    "cap, 13,000 free": ["sphere-cap", "--vertices", "13000", "--triangulation", "irregular", "--start", "flat"],
    "cap, 100,000 free": ["sphere-cap", "--vertices", "100000", "--triangulation", "irregular", "--start", "flat"],
    "blend, 13,000": ["cylinder-blend", "--vertices", "13308"],
    "revolution, 40,000": ["revolution", "--vertices", "40000", "--triangulation", "irregular", "--start", "flat"],
}


def published() -> Path:
    """The program of packaging/build.sh."""
    found = sorted((TARGET / "packaging" / "stage" / "linux-x86_64").glob("fairmesh-cli-*/fairmesh"))
    if not found:
        sys.exit("no program of packaging/build.sh linux-x86_64")
    return found[-1]


def native() -> Path:
    """The same for this processor."""
    environment = {**os.environ, "RUSTFLAGS": "-C target-cpu=native", "CARGO_TARGET_DIR": str(TARGET / "native")}
    command = ["cargo", "build", "--release", "--locked", "--quiet", "-p", "fairmesh-cli"]
    subprocess.run(command, cwd=ROOT, env=environment, check=True)
    return TARGET / "native" / "release" / "fairmesh"


def seconds(program: Path, arguments: list[str]) -> float:
    """Of the processor, for one run."""
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    # A patch that only nearly fits its boundary ends with another code than 0, for both.
    subprocess.run([program, *arguments], stdout=subprocess.DEVNULL, check=False)
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    return after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime


def main() -> None:
    """Prints the table."""
    programs = [published(), native()]
    folder = TARGET / "native" / "cases"
    folder.mkdir(parents=True, exist_ok=True)
    print(f"{'':20} {'published':>10} {'native':>10}   ratio")
    for name, kind in CASES.items():
        mesh, free, normals = folder / "mesh.ply", folder / "free.txt", folder / "normals.txt"
        made = [programs[1], "generate", *kind, "-o", mesh, "--free", free, "--normals", normals]
        subprocess.run(made, stdout=subprocess.DEVNULL, check=True)
        results = [folder / "published.ply", folder / "native.ply"]
        least = [float("inf")] * 2
        for _ in range(RUNS):
            for k, (program, result) in enumerate(zip(programs, results)):
                asked = ["fair", mesh, "-o", result, "--free", free, "--normals", normals, "--threads", "1", "--quiet"]
                least[k] = min(least[k], seconds(program, asked))
        if not filecmp.cmp(*results, shallow=False):
            sys.exit(f"{name}: the results differ")
        print(f"{name:20} {least[0]:8.3f} s {least[1]:8.3f} s   {least[0] / least[1]:.3f}")


main()
