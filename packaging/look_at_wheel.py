#!/usr/bin/env python3
"""Looks at an unpacked wheel: what it says of itself, and whether its library is that of the archive of its target.

look_at_wheel.py FOLDER VERSION PLATFORM ARCHIVE PATH-IN-ARCHIVE
"""

import sys
import tarfile
import zipfile
from email.parser import Parser
from pathlib import Path

FIELDS = {
    "Name": ["fairmesh"],
    "License-Expression": ["MIT OR Apache-2.0"],
    "License-File": ["LICENSE-APACHE", "LICENSE-MIT", "THIRD-PARTY.txt"],
    "Requires-Python": [">=3.9"],
    "Requires-Dist": ["numpy>=1.21"],
    "Description-Content-Type": ["text/markdown"],
}
SYSTEMS = ("MacOS", "Microsoft :: Windows", "POSIX :: Linux")


def from_archive(archive, name):
    """The bytes of one file."""
    if archive.endswith(".zip"):
        with zipfile.ZipFile(archive) as opened:
            return opened.read(name)
    with tarfile.open(archive) as opened:
        return opened.extractfile(name).read()


def expect(what, found, wanted):
    """Ends the program if they differ."""
    if found != wanted:
        sys.exit(f"{what}: {found!r}, not {wanted!r}")


def main():
    folder, version, platform, archive, name = sys.argv[1:]
    (info,) = Path(folder).glob("*.dist-info")
    metadata = Parser().parsestr((info / "METADATA").read_text(encoding="utf-8"))
    for field, wanted in {**FIELDS, "Version": [version]}.items():
        expect(field, metadata.get_all(field), wanted)
    said = metadata.get_all("Classifier")
    expect("systems", [each for each in SYSTEMS if f"Operating System :: {each}" in said], list(SYSTEMS))
    if not metadata.get_all("Project-URL") or len(metadata.get_payload()) < 10_000:
        sys.exit("no link, or no description")
    wheel = Parser().parsestr((info / "WHEEL").read_text(encoding="utf-8"))
    expect("Tag", wheel.get_all("Tag"), [f"py3-none-{platform}"])
    expect("Root-Is-Purelib", wheel.get_all("Root-Is-Purelib"), ["false"])
    for licence in FIELDS["License-File"]:
        expect(f"{licence}, and whether it is there", (info / "licenses" / licence).stat().st_size > 1000, True)
    (library,) = Path(folder, "fairmesh", "lib").iterdir()
    wanted = {"win": "fairmesh.dll", "mac": "libfairmesh.dylib"}.get(platform[:3], "libfairmesh.so")
    expect("the library's name", library.name, wanted)
    expect("the library is that of the archive", library.read_bytes() == from_archive(archive, name), True)


main()
