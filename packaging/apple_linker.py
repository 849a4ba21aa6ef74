#!/usr/bin/env python3
"""Links a library for macOS on any system: what rustc says to clang, said to Rust's own LLD.

zig, which links the command line, leaves out the list of exported names: the library would show all of Rust's standard library.
APPLE_LLD is the path of ld64.lld, APPLE_LIBRARIES a folder with libSystem.tbd.
"""

import os
import subprocess
import sys

SYSTEM = {"-lc", "-lm", "-lSystem", "-liconv"}


def translated(words):
    """The words for the linker."""
    words = list(words)
    said = []
    while words:
        word = words.pop(0)
        if word.startswith("-Wl,"):
            said += word[4:].split(",")
        elif word == "-dynamiclib":
            said.append("-dylib")
        elif word.startswith("-mmacosx-version-min="):
            version = word.split("=")[1]
            said += ["-platform_version", "macos", version, version]
        elif word.startswith("--target="):
            pass
        elif word == "-nodefaultlibs" or word in SYSTEM:
            pass
        else:
            said.append(word)
    if "-platform_version" not in said:
        version = os.environ["MACOSX_DEPLOYMENT_TARGET"]
        said += ["-platform_version", "macos", version, version]
    return [*said, "-L" + os.environ["APPLE_LIBRARIES"], "-lSystem"]


sys.exit(subprocess.run([os.environ["APPLE_LLD"], *translated(sys.argv[1:])]).returncode)
