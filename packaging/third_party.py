#!/usr/bin/env python3
"""Prints the licences of the crates inside a library or program: their texts have to go along with it.

third_party.py fairmesh-capi|fairmesh-cli TRIPLE
"""

import sys
from pathlib import Path

from linked_crates import linked

TEXTS = ("LICENSE", "LICENCE", "COPYING", "NOTICE", "UNLICENSE")
RUST = """The standard library of Rust is in it, too: MIT OR Apache-2.0, the Rust project, https://www.rust-lang.org;
the texts of its parts are in its COPYRIGHT-library.html, which comes with Rust.
"""


def main():
    crate, platform = sys.argv[1:]
    _, found = linked(crate, platform)
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
    if not texts:
        sys.exit("no crate has a licence")


main()
