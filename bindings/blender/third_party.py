# SPDX-License-Identifier: GPL-3.0-or-later
"""Prints the licences of the crates inside the library: their texts have to go along with it."""

import json
import subprocess
import sys
from pathlib import Path

COMMAND = ["cargo", "metadata", "--format-version", "1", "--locked", "--manifest-path", "src/capi/Cargo.toml"]
PLATFORM = ["--filter-platform", "x86_64-unknown-linux-gnu"]
TEXTS = ("LICENSE", "COPYING", "NOTICE")


def packages(root):
    """What the library is linked from, by name; without what only builds it."""
    metadata = json.loads(subprocess.run([*COMMAND, *PLATFORM], cwd=root, stdout=subprocess.PIPE, check=True).stdout)
    known = {package["id"]: package for package in metadata["packages"]}
    nodes = {node["id"]: node for node in metadata["resolve"]["nodes"]}
    start = next(i for i, package in known.items() if package["name"] == "fairmesh-capi")
    seen, left = set(), [start]
    while left:
        current = left.pop()
        if current in seen or any("proc-macro" in target["kind"] for target in known[current]["targets"]):
            continue
        seen.add(current)
        left += [d["pkg"] for d in nodes[current]["deps"] if any(k["kind"] is None for k in d["dep_kinds"])]
    return sorted((known[i] for i in seen - {start}), key=lambda package: (package["name"], package["version"]))


def main():
    found = packages(Path(__file__).resolve().parents[2])
    print("The library libfairmesh.so contains these Rust crates:\n")
    texts = {}
    for package in found:
        name = f"{package['name']} {package['version']}"
        print(f"{name}: {package['license']}, {', '.join(package['authors']) or package['repository']}")
        for file in sorted(Path(package["manifest_path"]).parent.iterdir()):
            if file.name.upper().startswith(TEXTS) and file.is_file():
                texts.setdefault(file.read_text(encoding="utf-8", errors="replace").strip(), []).append(name)
    for text, names in texts.items():
        print(f"\n{'-' * 80}\n{', '.join(names)}\n\n{text}")
    if len(found) < 10 or not texts:
        sys.exit("cargo metadata has told of no crates")


main()
