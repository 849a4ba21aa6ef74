#!/usr/bin/env python3
"""Builds the shared library with cargo and prints its path: target/python/native or target/python/portable.

By default as the rest of the repository does, for this machine. With --portable: for any Linux x86_64 with glibc 2.28
or newer, with zig as the linker (from PyPI, in a virtual environment under target/), stripped and checked.
"""

from __future__ import annotations

import argparse
import os
import re
import shutil
import subprocess
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
TARGET = Path(os.environ.get("CARGO_TARGET_DIR", ROOT / "target"))
TOOLS = ["ziglang==0.17.0", "cargo-zigbuild==0.24.0"]
TRIPLE = "x86_64-unknown-linux-gnu"
GLIBC = (2, 28)
BUILD = ["--release", "--locked", "-p", "fairmesh-capi"]
# The libraries that every Linux has, of the policy manylinux_2_28.
SYSTEM = {
    f"lib{name}" for name in ("c.so.6", "m.so.6", "dl.so.2", "pthread.so.0", "rt.so.1", "util.so.1", "gcc_s.so.1")
}
SYSTEM.add("ld-linux-x86-64.so.2")


def file_name() -> str:
    """What cargo calls the library on this system."""
    if sys.platform == "win32":
        return "fairmesh.dll"
    return "libfairmesh.dylib" if sys.platform == "darwin" else "libfairmesh.so"


def cargo() -> str:
    """The path of cargo."""
    found = shutil.which("cargo")
    usual = Path.home() / ".cargo" / "bin" / ("cargo.exe" if sys.platform == "win32" else "cargo")
    if not found and not usual.exists():
        raise SystemExit("cargo was not found: fairmesh needs Rust 1.89 or newer, see https://rustup.rs")
    return found or str(usual)


def build() -> Path:
    """The library for this machine. The options are those of the Makefile, so that cargo builds it once."""
    _check_root()
    debug = ["--config", "profile.release.package.fairmesh-capi.debug=2"]
    subprocess.run([cargo(), "build", *BUILD, *debug], cwd=ROOT, check=True, stdout=sys.stderr)
    return _copied(TARGET / "release" / file_name(), "native", strip=True)


def build_portable(*, hooks: bool = False) -> Path:
    """The library for any Linux x86_64 with glibc 2.28; with ``hooks`` the one in which tests let things go wrong."""
    _check_root()
    tools = _zig()
    path = f"{tools / 'bin'}{os.pathsep}{Path(cargo()).parent}{os.pathsep}{os.environ['PATH']}"
    target = f"{TRIPLE}.{GLIBC[0]}.{GLIBC[1]}"
    settings = ["--config", "profile.release.strip=true", "--config", "profile.release.debug=false"]
    command = [
        "cargo-zigbuild",
        "zigbuild",
        *BUILD,
        *(["--features", "hooks"] if hooks else []),
        "--target",
        target,
        *settings,
    ]
    subprocess.run(command, cwd=ROOT, check=True, stdout=sys.stderr, env={**os.environ, "PATH": path})
    library = _copied(TARGET / TRIPLE / "release" / "libfairmesh.so", "hooks" if hooks else "portable", strip=False)
    check_portable(library)
    return library


def _copied(library: Path, kind: str, *, strip: bool) -> Path:
    """A copy in target/python: cargo writes libraries with other features to the same place."""
    copy = TARGET / "python" / kind / library.name
    copy.parent.mkdir(parents=True, exist_ok=True)
    # Written anew, not over: programs may have it loaded.
    copy.unlink(missing_ok=True)
    shutil.copy2(library, copy)
    if strip and sys.platform != "win32" and shutil.which("strip"):
        subprocess.run(["strip", "-x", "-S", copy], check=True)
    return copy


def check_portable(library: Path) -> None:
    """Raises SystemExit if the library does not fit every Linux with this glibc, or shows more than its functions."""
    _need("objdump", "readelf", "nm")
    symbols = _output("objdump", "-T", library)
    versions = {tuple(map(int, number.split("."))) for number in re.findall(r"GLIBC_([0-9.]+)", symbols)}
    if not versions or max(versions) > GLIBC:
        raise SystemExit(f"{library} needs glibc {max(versions, default='of no version')}")
    needed = set(re.findall(r"\(NEEDED\).*\[(.*)\]", _output("readelf", "-dW", library)))
    if not needed <= SYSTEM:
        raise SystemExit(f"{library} needs {', '.join(sorted(needed - SYSTEM))}")
    shown = {line.split()[-1] for line in _output("nm", "-D", "--defined-only", library).splitlines()}
    if not shown or not all(name.startswith("fairmesh_") for name in shown):
        raise SystemExit(f"{library} shows {', '.join(sorted(shown)) or 'nothing'}")
    if ".symtab" in _output("readelf", "-SW", library):
        raise SystemExit(f"{library} is not stripped")


def _zig() -> Path:
    """A virtual environment with zig and cargo-zigbuild."""
    home = TARGET / "python" / "zig"
    stamp = home / "installed"
    if not stamp.exists() or stamp.read_text() != "\n".join(TOOLS):
        shutil.rmtree(home, ignore_errors=True)
        subprocess.run([sys.executable, "-m", "venv", home], check=True, stdout=sys.stderr)
        pip = [home / "bin" / "python", "-m", "pip", "--disable-pip-version-check", "install", "-q"]
        subprocess.run([*pip, *TOOLS], check=True, stdout=sys.stderr)
        stamp.write_text("\n".join(TOOLS))
    return home


def _need(*tools: str) -> None:
    missing = [tool for tool in tools if not shutil.which(tool)]
    if missing:
        raise SystemExit(f"{', '.join(missing)} not found: apt-get install binutils")


def _output(*command: str | Path) -> str:
    return subprocess.run(command, check=True, capture_output=True, text=True).stdout


def _check_root() -> None:
    if not (ROOT / "Cargo.toml").exists():
        raise SystemExit(f"no Rust sources in {ROOT}: fairmesh is built from its repository only")


def main() -> None:
    """The command line."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--portable", action="store_true", help="for glibc 2.28 and newer")
    parser.add_argument("--hooks", action="store_true", help="with --portable: for tests, can be made to fail")
    asked = parser.parse_args()
    print(build_portable(hooks=asked.hooks) if asked.portable else build())


if __name__ == "__main__":
    main()
