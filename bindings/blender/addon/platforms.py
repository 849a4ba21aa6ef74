# SPDX-License-Identifier: GPL-3.0-or-later
"""Which of the libraries in `lib/` is for this system. Knows neither Blender nor the library, and is tested without them."""

import platform
import sys
import sysconfig
from pathlib import Path

#: By `sys.platform`: how Blender's names of platforms begin, and what the library is called there.
SYSTEMS = {
    "linux": ("linux", "libfairmesh.so"),
    "darwin": ("macos", "libfairmesh.dylib"),
    "win32": ("windows", "fairmesh.dll"),
}
#: Blender's names of processors, where they are not those of Python.
PROCESSORS = {"x86_64": "x64", "amd64": "x64", "aarch64": "arm64"}
#: For which there is a zip.
PUBLISHED = ("linux-x64", "windows-x64", "macos-x64", "macos-arm64")


def processor():
    """What this Blender was built for. The computer may have another one, and translate: Windows and macOS on arm64 do."""
    built_for = sysconfig.get_platform().rpartition("-")[2]
    return platform.machine() if built_for == "universal2" else built_for


def name(system, machine):
    """Blender's name of a platform, such as "windows-x64"."""
    begin = SYSTEMS[system][0] if system in SYSTEMS else system
    return f"{begin}-{PROCESSORS.get(machine.lower(), machine.lower())}"


def library(folder, system=sys.platform, machine=None):
    """The library for this system in the add-on's folder `lib`. Raises LookupError, one sentence, where there is none."""
    here = name(system, machine or processor())
    file = Path(folder) / here / SYSTEMS.get(system, ("", "libfairmesh.so"))[1]
    if file.exists():
        return file
    inside = sorted(path.name for path in Path(folder).glob("*-*") if path.is_dir())
    if here in inside or not inside:
        raise LookupError(f"the add-on has no library {file}: install it again")
    if here in PUBLISHED:
        advice = f"install the zip whose name ends with {here.replace('-', '_')}"
    else:
        advice = "there is no zip for that, but the variable FAIRMESH_LIBRARY may name a library that you have built"
    raise LookupError(f"this add-on is for {', '.join(inside)}, and Blender runs on {here} here: {advice}")
