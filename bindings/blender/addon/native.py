# SPDX-License-Identifier: GPL-3.0-or-later
"""The library inside the add-on: loaded so that its file may be replaced or removed while Blender runs."""

import os
import shutil
import tempfile
from pathlib import Path

from . import fairmesh

# For tests and developers: another library file.
ENVIRONMENT = "FAIRMESH_LIBRARY"
INSIDE = Path(__file__).resolve().parent / "lib" / "linux-x64" / "libfairmesh.so"

_loaded = False


def load():
    """Loads the library, once. Raises `fairmesh.LibraryError` where it cannot be loaded or has another version."""
    global _loaded
    if _loaded:
        return
    if os.environ.get(ENVIRONMENT):
        fairmesh.load(os.environ[ENVIRONMENT])
    elif not INSIDE.exists():
        raise fairmesh.LibraryError(f"the add-on has no library {INSIDE}: install it again")
    else:
        _load_copy()
    _loaded = True


def _load_copy():
    """Loads a copy that has no name any more.

    An update writes over the installed file, and a process dies when a file that it has mapped is cut short. The name
    is new each time: the loader knows libraries by their names, and would hand out the old one after an update.
    """
    try:
        folder = tempfile.mkdtemp(prefix="fairmesh-")
        try:
            fairmesh.load(shutil.copy(INSIDE, folder))
        finally:
            shutil.rmtree(folder, ignore_errors=True)
    except OSError:
        # No room for a copy, or programs may not be loaded from there.
        fairmesh.load(INSIDE)
