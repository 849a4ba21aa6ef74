#!/usr/bin/env python3
"""Compares what `cargo binstall` is told in src/cli/Cargo.toml with the archives: binstall.py DIST VERSION.

Each entry names an archive of build.sh, and the program's place in it. Archives that are not there are not looked into,
but one has to be.
"""

import re
import sys
import tarfile
import zipfile
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]
# What cargo calls a target, and what its programs end with.
ENDS = {
    "x86_64-unknown-linux-gnu": "",
    "aarch64-unknown-linux-gnu": "",
    "x86_64-pc-windows-msvc": ".exe",
    "x86_64-pc-windows-gnu": ".exe",
    "x86_64-apple-darwin": "",
    "aarch64-apple-darwin": "",
}
FORMATS = {"tgz": ".tar.gz", "zip": ".zip"}


def entries():
    """The tables by target; all their values are strings."""
    text = (ROOT / "src/cli/Cargo.toml").read_text(encoding="utf-8")
    table = r"^\[package\.metadata\.binstall\.overrides\.([^\]]+)\]\n((?:[^\[\n].*\n)+)"
    tables = re.findall(table, text, re.MULTILINE)
    return {target: dict(re.findall(r'^([a-z-]+) = "(.*)"$', lines, re.MULTILINE)) for target, lines in tables}


def filled(template, **values):
    """As cargo-binstall fills in what is in braces."""
    return re.sub(r"\{ ([a-z-]+) \}", lambda name: values[name.group(1).replace("-", "_")], template)


def programs(archive):
    """The names in an archive."""
    if archive.suffix == ".zip":
        with zipfile.ZipFile(archive) as packed:
            return set(packed.namelist())
    with tarfile.open(archive) as packed:
        return set(packed.getnames())


def main():
    dist, version = Path(sys.argv[1]), sys.argv[2]
    told = entries()
    if set(told) != set(ENDS):
        sys.exit(f"src/cli/Cargo.toml has binstall entries for {sorted(told)}")
    seen = 0
    for target, entry in told.items():
        url = filled(entry["pkg-url"], repo="REPOSITORY", version=version)
        place = filled(entry["bin-dir"], version=version, bin="fairmesh", binary_ext=ENDS[target])
        head, _, name = url.rpartition("/")
        if head != f"REPOSITORY/releases/download/v{version}" or not name.endswith(FORMATS[entry["pkg-fmt"]]):
            sys.exit(f"{target}: no release has {url}")
        if not (dist / name).exists():
            print(f"{target}: {name} is not built")
            continue
        if place not in programs(dist / name):
            sys.exit(f"{target}: {name} has no {place}")
        seen += 1
    if not seen:
        sys.exit(f"{dist} has no archive of the command line: packaging/build.sh")
    print(f"cargo binstall finds the program in {seen} of {len(told)} archives")


main()
