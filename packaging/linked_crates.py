"""What a library or program of this workspace is linked from."""

import json
import subprocess
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]
COMMAND = ["cargo", "metadata", "--format-version", "1", "--locked", "--filter-platform"]


def linked(crate, platform):
    """The crate itself, and the crates of others that it is linked from, by name; without this project's own, and without what only builds it."""
    told = subprocess.run([*COMMAND, platform], cwd=ROOT, stdout=subprocess.PIPE, check=True).stdout
    metadata = json.loads(told)
    known = {package["id"]: package for package in metadata["packages"]}
    nodes = {node["id"]: node for node in metadata["resolve"]["nodes"]}
    (own,) = (i for i, package in known.items() if package["name"] == crate)
    seen, left = set(), [own]
    while left:
        current = left.pop()
        if current in seen or any("proc-macro" in target["kind"] for target in known[current]["targets"]):
            continue
        seen.add(current)
        left += [d["pkg"] for d in nodes[current]["deps"] if any(k["kind"] is None for k in d["dep_kinds"])]
    others = sorted((known[i] for i in seen if known[i]["source"]), key=lambda package: (package["name"], package["version"]))
    if len(others) < 10:
        raise SystemExit("cargo metadata has told of no crates")
    return known[own], others
