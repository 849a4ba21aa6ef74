#!/usr/bin/env python3
"""Runs what was built for the system that this runs on, from the archives alone: check_native.py TARGET [PYTHON...].

The command line; programs in C that CMake finds the library for, shared and static, with each compiler that is usual
there; the ten answers, compared with those of linux-x86_64, which check.sh has left in target/packaging/answers; and
for each PYTHON the wheel in a fresh environment. check.sh looks into the same files on Linux.
Needs CMake and a C compiler; on Windows Visual Studio's and MinGW's.
"""

import os
import re
import shutil
import subprocess
import sys
import tarfile
import zipfile
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]
OUT = ROOT / "target/packaging"
DIST = OUT / "dist"
VERSION = re.search(r'^version = "(.*)"', (ROOT / "Cargo.toml").read_text(encoding="utf-8"), re.MULTILINE).group(1)
IS_WINDOWS = os.name == "nt"
END = ".exe" if IS_WINDOWS else ""
EXAMPLE = """
import fairmesh, numpy
x, y = (a.ravel() for a in numpy.meshgrid(numpy.linspace(-1, 1, 21), numpy.linspace(-1, 1, 21)))
free = (abs(x) < 0.55) & (abs(y) < 0.55)
points = numpy.column_stack([x, y, (x * x + y * y) / 2 - 0.2 * free])
corner = numpy.add.outer(21 * numpy.arange(20), numpy.arange(20)).ravel()
faces = numpy.concatenate([corner[:, None] + [0, 1, 22], corner[:, None] + [0, 22, 21]])
result = fairmesh.fair((points, faces), free)
print(fairmesh.__version__, fairmesh.__file__, result.outcome)
assert str(result.outcome).endswith("converged"), result.outcome
"""
ANSWERS = """
cmake_minimum_required(VERSION 3.13)
project(answers C)
find_package(fairmesh REQUIRED)
add_executable(answers answers.c)
set_property(TARGET answers PROPERTY C_STANDARD 99)
target_link_libraries(answers PRIVATE fairmesh::fairmesh)
if(NOT MSVC)
  target_compile_options(answers PRIVATE -ffp-contract=off)
  target_link_libraries(answers PRIVATE m)
endif()
"""


def run(*command, **options):
    """What the program prints; the end of all if it fails."""
    print("+", *command, flush=True)
    done = subprocess.run([str(word) for word in command], stdout=subprocess.PIPE, text=True, **options)
    if done.returncode != 0:
        sys.exit(f"{done.stdout}\n{command[0]} has ended with {done.returncode}")
    return done.stdout


def unpacked(name, work):
    """The tree of an archive."""
    archives = [path for path in (DIST / f"{name}.tar.gz", DIST / f"{name}.zip") if path.exists()]
    if not archives:
        sys.exit(f"{DIST} has no {name}")
    if archives[0].suffix == ".zip":
        with zipfile.ZipFile(archives[0]) as archive:
            archive.extractall(work)
    else:
        with tarfile.open(archives[0]) as archive:
            archive.extractall(work)
    return work / name


def command_line(tree, work):
    """The program fairs the file that README.md begins with."""
    program = tree / f"fairmesh{END}"
    if run(program, "--version").strip() != f"fairmesh {VERSION}":
        sys.exit(f"{program} has another version")
    said = run(program, "fair", ROOT / "docs/dented.ply", "-o", work / "faired.ply", "--selection", "free")
    if "\nconverged" not in f"\n{said}":
        sys.exit(f"the command line has found nothing:\n{said}")


def built(source, name, work, tree, *options):
    """A program in C that was built by CMake."""
    shutil.rmtree(work, ignore_errors=True)
    options = [f"-Dfairmesh_DIR={(tree / 'lib/cmake/fairmesh').as_posix()}", "-DCMAKE_BUILD_TYPE=Release", *options]
    run("cmake", "-S", source, "-B", work, *options)
    run("cmake", "--build", work, "--config", "Release")
    found = [work / name, work / f"{name}.exe", work / "Release" / f"{name}.exe"]
    return next(path for path in found if path.is_file())


def clients(tree, work):
    """The example in C with each compiler; the static library for Windows is for MinGW alone."""
    ways = {"shared": ["-DFAIRMESH_USE_STATIC=OFF"], "static": ["-DFAIRMESH_USE_STATIC=ON"]}
    if IS_WINDOWS:
        ways = {f"mingw-{way}": ["-G", "MinGW Makefiles", *options] for way, options in ways.items()}
        ways["visual-studio"] = ["-DFAIRMESH_USE_STATIC=OFF"]
    for way, options in ways.items():
        said = run(built(ROOT / "examples/c", "smooth_dent", work / way, tree, *options))
        if not said.strip().splitlines()[-1].startswith("converged"):
            sys.exit(f"{way}: the example has failed:\n{said}")
        print(f"{way}: the example has run")


def answers(target, tree, work):
    """What the library answers here, and on linux-x86_64."""
    source = work / "answers"
    source.mkdir(exist_ok=True)
    shutil.copy(ROOT / "packaging/answers.c", source)
    (source / "CMakeLists.txt").write_text(ANSWERS, encoding="utf-8")
    program = built(source, "answers", work / "answers-build", tree)
    here, reference = OUT / "answers" / f"{target}-native", OUT / "answers/linux-x86_64"
    if not reference.is_dir():
        sys.exit(f"{reference} is not there: packaging/check.sh linux-x86_64")
    here.mkdir(parents=True, exist_ok=True)
    for case in range(1, 11):
        (here / str(case)).write_bytes(run(program, case).encode())
    print(run(sys.executable, ROOT / "packaging/compare.py", reference, here), end="")


def wheel(python, work):
    """pip chooses the wheel for this system among all that are there."""
    environment = work / "environment"
    shutil.rmtree(environment, ignore_errors=True)
    run(python, "-m", "venv", environment)
    inside = environment / ("Scripts/python.exe" if IS_WINDOWS else "bin/python")
    install = [inside, "-m", "pip", "install", "-q", "--only-binary", ":all:"]
    run(*install, "numpy")
    run(*install, "--no-index", "--find-links", DIST, f"fairmesh=={VERSION}")
    print(run(inside, "-c", EXAMPLE, cwd=work), end="")


def main():
    target, pythons = sys.argv[1], sys.argv[2:]
    work = OUT / "native" / target
    shutil.rmtree(work, ignore_errors=True)
    work.mkdir(parents=True)
    tree = unpacked(f"fairmesh-{VERSION}-{target}", work)
    # Where Windows looks for a DLL.
    os.environ["PATH"] = f"{tree / 'bin'}{os.pathsep}{os.environ['PATH']}"
    command_line(unpacked(f"fairmesh-cli-{VERSION}-{target}", work), work)
    clients(tree, work)
    answers(target, tree, work)
    for python in pythons:
        wheel(python, work)
    print(f"{target}: passed")


main()
