#!/usr/bin/env python3
"""Prints the licences of the crates inside a library or program: their texts have to go along with it.

third_party.py fairmesh-capi|fairmesh-cli TRIPLE
"""

import json
import subprocess
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]
COMMAND = ["cargo", "metadata", "--format-version", "1", "--locked", "--filter-platform"]
TEXTS = ("LICENSE", "LICENCE", "COPYING", "NOTICE", "UNLICENSE")
RUST = """The standard library of Rust is in it, too: MIT OR Apache-2.0, the Rust project, https://www.rust-lang.org;
the texts of its parts are in its COPYRIGHT-library.html, which comes with Rust.
"""


def packages(crate, platform):
    """What the crate is linked from, by name; without this project's own, and without what only builds it."""
    told = subprocess.run([*COMMAND, platform], cwd=ROOT, stdout=subprocess.PIPE, check=True).stdout
    metadata = json.loads(told)
    known = {package["id"]: package for package in metadata["packages"]}
    nodes = {node["id"]: node for node in metadata["resolve"]["nodes"]}
    seen, left = set(), [i for i, package in known.items() if package["name"] == crate]
    while left:
        current = left.pop()
        if current in seen or any("proc-macro" in target["kind"] for target in known[current]["targets"]):
            continue
        seen.add(current)
        left += [d["pkg"] for d in nodes[current]["deps"] if any(k["kind"] is None for k in d["dep_kinds"])]
    others = (known[i] for i in seen if known[i]["source"])
    return sorted(others, key=lambda package: (package["name"], package["version"]))


def main():
    crate, platform = sys.argv[1:]
    found = packages(crate, platform)
    print(f"{crate} for {platform} contains these Rust crates:\n")
    texts = {}
    for package in found:
        name = f"{package['name']} {package['version']}"
        print(f"{name}: {package['license']}, {', '.join(package['authors']) or package['repository']}")
        files = sorted(Path(package["manifest_path"]).parent.iterdir())
        mine = [file for file in files if file.name.upper().startswith(TEXTS) and file.is_file()]
        for file in mine:
            texts.setdefault(file.read_text(encoding="utf-8", errors="replace").strip(), []).append(name)
        if not mine and not package["license"]:
            sys.exit(f"{name} has no licence")
    print(f"\n{RUST}", end="")
    for text, names in texts.items():
        print(f"\n{'-' * 80}\n{', '.join(dict.fromkeys(names))}\n\n{text}")
    if len(found) < 10 or not texts:
        sys.exit("cargo metadata has told of no crates")


main()
