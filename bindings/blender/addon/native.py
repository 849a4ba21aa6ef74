# SPDX-License-Identifier: GPL-3.0-or-later
"""The library inside the add-on: loaded so that its file may be replaced or removed while Blender runs."""

import contextlib
import os
import shutil
import tempfile
import time
from pathlib import Path

from . import fairmesh, platforms

# For tests and developers: another library file.
ENVIRONMENT = "FAIRMESH_LIBRARY"
FOLDER = Path(__file__).resolve().parent / "lib"
PREFIX = "fairmesh-blender-"
DAY = 24 * 3600

_loaded = False


def load():
    """Loads the library, once. Raises `fairmesh.LibraryError` where it cannot be loaded or has another version."""
    global _loaded
    if _loaded:
        return
    if os.environ.get(ENVIRONMENT):
        fairmesh.load(os.environ[ENVIRONMENT])
    else:
        try:
            inside = platforms.library(FOLDER)
        except LookupError as why:
            raise fairmesh.LibraryError(str(why)) from None
        remove_kept(tempfile.gettempdir(), inside.name)
        _load_copy(inside)
    _loaded = True


def _load_copy(inside):
    """Loads a copy that has no name any more.

    An update writes over the installed file, and a process dies when a file that it has mapped is cut short; Windows
    lets nobody write over it, and the update fails. The name is new each time: the loader knows libraries by their
    names, and would hand out the old one after an update.
    """
    try:
        folder = tempfile.mkdtemp(prefix=PREFIX)
        try:
            fairmesh.load(shutil.copy(inside, folder))
        finally:
            # Windows keeps a file that is loaded: see below.
            shutil.rmtree(folder, ignore_errors=True)
    except OSError:
        # No room for a copy, or programs may not be loaded from there.
        fairmesh.load(inside)


def remove_kept(folder, file):
    """Removes the copies that Windows has kept for Blenders that have ended since.

    Not those of today: another Blender may be about to load one. One that is still in use stays.
    """
    for copy in Path(folder).glob(f"{PREFIX}*"):
        with contextlib.suppress(OSError):
            if time.time() - copy.stat().st_mtime > DAY:
                (copy / file).unlink()
                copy.rmdir()
