#!/usr/bin/env python3
"""Packs a folder into a .tar, .tar.gz or .zip whose bytes depend on the files alone: archive.py FOLDER ARCHIVE.

Entries are sorted and have the time SOURCE_DATE_EPOCH, no owner, and one of two modes. Prints the archive's path.
"""

import gzip
import io
import os
import sys
import tarfile
import time
import zipfile
from pathlib import Path


def is_program(path):
    """Whether it is started, or loaded by the system."""
    return os.access(path, os.X_OK) and path.suffix not in (".a", ".lib", ".h", ".hpp")


def tar(folder, files, seconds):
    """The bytes of a .tar."""
    plain = io.BytesIO()
    with tarfile.open(fileobj=plain, mode="w", format=tarfile.USTAR_FORMAT) as archive:
        for path in files:
            entry = tarfile.TarInfo(str(path.relative_to(folder.parent)))
            entry.mtime = seconds
            if path.is_symlink():
                entry.type, entry.linkname = tarfile.SYMTYPE, os.readlink(path)
                archive.addfile(entry)
                continue
            content = path.read_bytes()
            entry.size, entry.mode = len(content), 0o755 if is_program(path) else 0o644
            archive.addfile(entry, io.BytesIO(content))
    return plain.getvalue()


def tar_gz(folder, files, seconds):
    """The bytes of a .tar.gz."""
    return gzip.compress(tar(folder, files, seconds), compresslevel=9, mtime=seconds)


def zipped(folder, files, seconds):
    """The bytes of a .zip."""
    packed = io.BytesIO()
    with zipfile.ZipFile(packed, "w", zipfile.ZIP_DEFLATED, compresslevel=9) as archive:
        for path in files:
            entry = zipfile.ZipInfo(path.relative_to(folder.parent).as_posix(), time.gmtime(seconds)[:6])
            entry.compress_type, entry.create_system = zipfile.ZIP_DEFLATED, 3
            entry.external_attr = (0o100755 if is_program(path) else 0o100644) << 16
            archive.writestr(entry, path.read_bytes())
    return packed.getvalue()


def main():
    folder, archive = Path(sys.argv[1]), Path(sys.argv[2])
    files = sorted(path for path in folder.rglob("*") if path.is_symlink() or path.is_file())
    pack = {".zip": zipped, ".tar": tar}.get(archive.suffix, tar_gz)
    archive.write_bytes(pack(folder, files, int(os.environ["SOURCE_DATE_EPOCH"])))
    print(archive)


main()
