"""Public meshes of scans and sculptures that Debian's libcgal-demo has."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

import numpy as np

from .meshes import Mesh

#: Closed or nearly so, of triangles, of 1,000 to 24,000 vertices.
SCANS = (
    "hand",
    "bear",
    "blobby",
    "knot1",
    "camel",
    "diplodocus",
    "elephant",
    "homer",
    "lion-head",
    "mannequin-devil",
    "mushroom",
    "retinal",
)


def read_off(path: Path) -> Mesh:
    """An OFF file of triangles, to single precision, as scanners write."""
    words = path.read_text(encoding="utf-8", errors="replace").split()
    count, faces = int(words[1]), int(words[2])
    vertices = np.array(words[4 : 4 + 3 * count], np.float32).astype(float).reshape(-1, 3)
    corners = np.array(words[4 + 3 * count :][: 4 * faces], np.int64).reshape(-1, 4)
    return Mesh(vertices, corners[:, 1:])


def scans(data: Path) -> Iterator[tuple[str, Mesh]]:
    """Their names and meshes."""
    for name in SCANS:
        yield name, read_off(data / f"{name}.off")
