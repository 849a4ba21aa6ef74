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

HERE = Path(__file__).resolve().parent
# The Rust sources: a source distribution carries them (rust_sources.py).
ROOT = HERE / "rust" if (HERE / "rust").is_dir() else HERE.parents[1]
TARGET = Path(os.environ.get("CARGO_TARGET_DIR", ROOT / "target"))
RUST = (1, 89)
BUILD = ["--release", "--locked", "-p", "fairmesh-capi"]
# The libraries that every Linux has, of the policy manylinux_2_28.
SYSTEM = {
    f"lib{name}" for name in ("c.so.6", "m.so.6", "dl.so.2", "pthread.so.0", "rt.so.1", "util.so.1", "gcc_s.so.1")
}
SYSTEM.add("ld-linux-x86-64.so.2")


def file_name(system: str = sys.platform) -> str:
    """What cargo calls the library on this system, or on one whose name begins as Python's or that of a wheel."""
    if system.startswith("win"):
        return "fairmesh.dll"
    return "libfairmesh.dylib" if system.startswith(("darwin", "macosx")) else "libfairmesh.so"


def cargo() -> str:
    """The path of cargo, of a Rust that is new enough."""
    wanted = f"fairmesh is compiled here, and for that needs Rust {RUST[0]}.{RUST[1]} or newer, see https://rustup.rs"
    usual = Path.home() / ".cargo" / "bin" / ("cargo.exe" if sys.platform == "win32" else "cargo")
    found = shutil.which("cargo") or (str(usual) if usual.exists() else None)
    if not found:
        raise SystemExit(f"cargo was not found: {wanted}")
    told = re.match(r"cargo (\d+)\.(\d+)", _output(found, "--version"))
    if told and tuple(map(int, told.groups())) < RUST:
        raise SystemExit(f"{found} is of Rust {told[1]}.{told[2]}: {wanted}")
    return found


def glibc() -> tuple[int, ...]:
    """The oldest glibc that ready-made libraries are for."""
    return tuple(map(int, _pinned("GLIBC").split(".")))


def _pinned(name: str) -> str:
    """What packaging/tools.sh sets this variable to."""
    text = (ROOT / "packaging" / "tools.sh").read_text(encoding="utf-8")
    (value,) = re.findall(rf'^{name}="?([^"\n]*)"?$', text, re.M)
    return str(value)


def declare() -> None:
    """Makes what is generated of the Rust sources, such as `_abi.py`; a source distribution has it."""
    if not _is_distribution():
        command = [cargo(), "run", "--release", "--locked", "--quiet", "-p", "fairmesh-declarations", "--", "python"]
        subprocess.run([*command, HERE / "src" / "fairmesh"], cwd=ROOT, check=True, stdout=sys.stderr)


def build() -> Path:
    """The library for this machine. In the repository the options are the Makefile's, so that cargo builds it once."""
    _check_root()
    option = "strip='symbols'" if _is_distribution() else "package.fairmesh-capi.debug=2"
    command = [cargo(), "build", *BUILD, "--config", f"profile.release.{option}"]
    subprocess.run(command, cwd=ROOT, check=True, stdout=sys.stderr)
    return _copied(TARGET / "release" / file_name(), "native", strip=True)


def build_portable(*, hooks: bool = False) -> Path:
    """The library for any Linux x86_64 with glibc 2.28; with ``hooks`` the one in which tests let things go wrong.

    Only the linking is special, so that what the library depends on is built once for all programs of the repository.
    """
    check_repository()
    last = ["--crate-type", "cdylib", "--", "-C", f"linker={_linker()}", "-C", "strip=symbols"]
    command = [cargo(), "rustc", *BUILD, *(["--features", "hooks"] if hooks else []), *last]
    subprocess.run(command, cwd=ROOT, check=True, stdout=sys.stderr)
    library = _copied(TARGET / "release" / "libfairmesh.so", "hooks" if hooks else "portable", strip=False)
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
    if not versions or max(versions) > glibc():
        raise SystemExit(f"{library} needs glibc {max(versions, default='of no version')}")
    needed = set(re.findall(r"\(NEEDED\).*\[(.*)\]", _output("readelf", "-dW", library)))
    if not needed <= SYSTEM:
        raise SystemExit(f"{library} needs {', '.join(sorted(needed - SYSTEM))}")
    shown = {line.split()[-1] for line in _output("nm", "-D", "--defined-only", library).splitlines()}
    if not shown or not all(name.startswith("fairmesh_") for name in shown):
        raise SystemExit(f"{library} shows {', '.join(sorted(shown)) or 'nothing'}")
    if ".symtab" in _output("readelf", "-SW", library):
        raise SystemExit(f"{library} is not stripped")


def _linker() -> Path:
    """A program that links for this glibc, as cargo-zigbuild does."""
    home = _zig()
    linker = home / "linker"
    target = f"x86_64-linux-gnu.{_pinned('GLIBC')}"
    zig = f'exec "{home}/bin/cargo-zigbuild" zig cc -- -target {target} "$@"'
    text = f'#!/bin/sh\nPATH="{home}/bin:$PATH"\n{zig}\n'
    if not linker.exists() or linker.read_text() != text:
        linker.write_text(text)
        linker.chmod(0o755)
    return linker


def _zig() -> Path:
    """A virtual environment with zig and cargo-zigbuild."""
    home = TARGET / "python" / "zig"
    stamp = home / "installed"
    tools = _pinned("PINNED").split()
    if not stamp.exists() or stamp.read_text() != "\n".join(tools):
        shutil.rmtree(home, ignore_errors=True)
        subprocess.run([sys.executable, "-m", "venv", home], check=True, stdout=sys.stderr)
        pip = [home / "bin" / "python", "-m", "pip", "--disable-pip-version-check", "install", "-q"]
        subprocess.run([*pip, *tools], check=True, stdout=sys.stderr)
        stamp.write_text("\n".join(tools))
    return home


def _need(*tools: str) -> None:
    missing = [tool for tool in tools if not shutil.which(tool)]
    if missing:
        raise SystemExit(f"{', '.join(missing)} not found: apt-get install binutils")


def _output(*command: str | Path) -> str:
    return subprocess.run(command, check=True, capture_output=True, text=True).stdout


def _is_distribution() -> bool:
    return ROOT.parent == HERE


def check_repository() -> None:
    """Raises SystemExit in a source distribution, which has nothing but what is compiled."""
    if _is_distribution():
        raise SystemExit("that takes the repository of fairmesh: this is its source distribution")


def _check_root() -> None:
    if not (ROOT / "Cargo.toml").exists():
        raise SystemExit(f"no Rust sources in {ROOT}: fairmesh is built from its repository or source distribution")


def main() -> None:
    """The command line."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--portable", action="store_true", help="for glibc 2.28 and newer")
    parser.add_argument("--hooks", action="store_true", help="with --portable: for tests, can be made to fail")
    asked = parser.parse_args()
    print(build_portable(hooks=asked.hooks) if asked.portable else build())


if __name__ == "__main__":
    main()
