#!/usr/bin/env python3
"""Copies what the C library is compiled from, and nothing else: rust_sources.py FOLDER.

It is what a source distribution carries. The manifests there name no tests and no crate that is left out, and
Cargo.lock has what is left of it, in the versions that it has here.
"""

from __future__ import annotations

import json
import re
import shutil
import subprocess
import sys
from pathlib import Path

import build_library

# Where each crate lies that the library is linked from.
CRATES = {"fairmesh": "", "fairmesh-linear": "src/linear", "fairmesh-capi": "src/capi"}
LEFT_OUT = re.compile(r"(# .*\n)*\[(dev-dependencies|\[test\]|\[bench\]|profile\.dev)")
LISTS = ("[workspace.dependencies]", "[profile.release.package]")


def copy(folder: Path) -> None:
    """Makes the folder anew, a Cargo workspace."""
    shutil.rmtree(folder, ignore_errors=True)
    for crate, where in CRATES.items():
        source, to = build_library.ROOT / where, folder / where
        for name in _files(crate):
            (to / name).parent.mkdir(parents=True, exist_ok=True)
            shutil.copyfile(source / name, to / name)
        _write(to / "Cargo.toml", _without_tests((source / "Cargo.toml").read_text(encoding="utf-8")))
    shutil.copyfile(build_library.ROOT / "Cargo.lock", folder / "Cargo.lock")
    # Cargo takes out of the lock file what is not needed any more.
    crates = _crates(folder)
    top = folder / "Cargo.toml"
    _write(top, _without_others(top.read_text(encoding="utf-8"), crates))
    if _crates(folder, "--locked") != crates or not crates.issuperset(CRATES):
        raise SystemExit(f"the manifests in {folder} are not those of the library")


def _files(crate: str) -> list[str]:
    """The sources that cargo would publish."""
    command = [build_library.cargo(), "package", "--quiet", "--list", "--allow-dirty", "-p", crate]
    told = subprocess.run(command, cwd=build_library.ROOT, stdout=subprocess.PIPE, check=True, text=True).stdout
    return [name for name in told.splitlines() if name.endswith(".rs")]


def _crates(folder: Path, *options: str) -> set[str]:
    """The names of all crates that this workspace is made of."""
    command = [build_library.cargo(), "metadata", "--quiet", "--format-version", "1", *options]
    told = subprocess.run(command, cwd=folder, stdout=subprocess.PIPE, check=True).stdout
    return {package["name"] for package in json.loads(told)["packages"]}


def _without_tests(manifest: str) -> str:
    """The paragraphs of a manifest that a build of the library needs, with the crates that are here as members."""
    kept = [each for each in manifest.strip().split("\n\n") if not LEFT_OUT.match(each)]
    text = re.sub(r"^default-members = .*\n", "", "\n\n".join(kept), flags=re.M)
    members = json.dumps([where or "." for where in CRATES.values()])
    return re.sub(r"^members = .*", f"members = {members}", text, flags=re.M) + "\n"


def _without_others(manifest: str, crates: set[str]) -> str:
    """Lists of crates, with those alone that are here."""
    paragraphs = manifest.split("\n\n")
    for k, paragraph in enumerate(paragraphs):
        if any(head in paragraph for head in LISTS):
            lines = [line for line in paragraph.splitlines() if _is_for(line, crates)]
            paragraphs[k] = "\n".join(lines)
    return "\n\n".join(each for each in paragraphs if not each.endswith(LISTS)).rstrip() + "\n"


def _is_for(line: str, crates: set[str]) -> bool:
    named = re.match(r'"?([\w-]+)', line)
    return not named or named[1] in crates


def _write(path: Path, text: str) -> None:
    path.write_bytes(text.encode())


def main() -> None:
    """The command line."""
    if len(sys.argv) != 2:
        raise SystemExit(__doc__)
    copy(Path(sys.argv[1]).resolve())


if __name__ == "__main__":
    main()
