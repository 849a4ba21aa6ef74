"""Parts with sharp edges, as a machine makes them; and the same with edges rounded."""

from __future__ import annotations

from collections.abc import Iterator
from itertools import pairwise
from pathlib import Path

import manifold3d
import numpy as np

from .blends import Blend
from .meshes import Mesh, Points
from .scans import read_off
from .surfaces import between

#: Edges of parts, which are about two units wide.
EDGE = 0.12
#: Radius of rounded edges.
RADIUS = 0.25


def sharp(data: Path) -> Iterator[tuple[str, Mesh]]:
    """Parts by their names: solids and what two of them have together, and two that came with CGAL."""
    block = manifold3d.Manifold.cube((1.6, 1.4, 1.2), True)
    rod = manifold3d.Manifold.cylinder(2.4, 0.45, circular_segments=48, center=True)
    ball = manifold3d.Manifold.sphere(0.8, 64)
    solids = {
        "block": block,
        "block-with-bore": block - rod,
        "block-with-rod": block + rod,
        "ball-cut": ball - block.translate((0.8, 0.7, 0.6)),
        "prism": manifold3d.Manifold.cylinder(1.4, 0.8, circular_segments=6, center=True),
        "cone": manifold3d.Manifold.cylinder(1.4, 0.8, 0.4, circular_segments=64, center=True),
        "step": block - block.translate((0.8, 0, 0.6)),
        "groove": block - manifold3d.Manifold.cube((0.6, 2, 0.6), True).translate((0, 0, 0.6)),
        "rods-crossed": rod + rod.rotate((90, 0, 0)) + rod.rotate((0, 90, 0)),
    }
    for name, solid in solids.items():
        yield name, _refined(solid)
    for name in ("fandisk", "couplingdown"):
        yield name, read_off(data / f"{name}.off")


def _refined(solid: manifold3d.Manifold) -> Mesh:
    """Its surface with edges of about the same length; what is flat stays flat."""
    made = solid.refine_to_length(EDGE).to_mesh()
    return Mesh(np.asarray(made.vert_properties, float)[:, :3], np.asarray(made.tri_verts, np.int64))


def rounded() -> Iterator[Blend]:
    """A straight edge and a rim, outside and inside: inside is the same surface from its other side."""
    for shape, sweep in (("edge", _extruded), ("rim", _revolved)):
        sharp_mesh, edge = sweep(_profile(0.0))
        round_mesh, _ = sweep(_profile(RADIUS))
        middles = round_mesh.corners().mean(axis=1)
        across = np.hypot(middles[:, 0], middles[:, 1]) - 1 if shape == "rim" else middles[:, 0]
        wanted = (across > -RADIUS) & (middles[:, 2] > -RADIUS)
        for side, turn in (("outside", 1), ("inside", -1)):
            meshes = (Mesh(mesh.vertices, mesh.faces[:, ::turn]) for mesh in (sharp_mesh, round_mesh))
            yield Blend(f"{shape}-{side}", next(meshes), edge, RADIUS, next(meshes), wanted)


def _profile(radius: float) -> Points:
    """Two arms in the plane (x, z), from (-1, 0) and to (0, -1), that meet at right angles in the origin, or in an arc."""
    arm = np.linspace(1, radius, round((1 - radius) / EDGE) + 1)
    angle = np.linspace(0, np.pi / 2, 33 if radius > 0 else 1)
    arc = np.column_stack([radius * np.sin(angle) - radius, radius * np.cos(angle) - radius])
    first, last = np.column_stack([-arm, 0 * arm]), np.column_stack([0 * arm, -arm])[::-1]
    return np.vstack([first[:-1], arc, last[1:]])


def _corner(profile: Points) -> int:
    """The point that is nearest to the origin."""
    return int(np.linalg.norm(profile, axis=1).argmin())


def _extruded(profile: Points) -> tuple[Mesh, list[int]]:
    """The profile moved along y, and the vertices of its corner."""
    along = np.linspace(-1, 1, round(2 / EDGE) + 1)
    n, m = len(profile), len(along)
    vertices = np.array([(x, y, z) for x, z in profile for y in along])
    quads = np.array([(i * m + j, i * m + j + 1, (i + 1) * m + j + 1, (i + 1) * m + j) for i in range(n - 1) for j in range(m - 1)])
    corner = _corner(profile)
    return Mesh(vertices, np.vstack([quads[:, [0, 2, 1]], quads[:, [0, 3, 2]]])), [corner * m + j for j in range(m)]


def _revolved(profile: Points) -> tuple[Mesh, list[int]]:
    """The profile turned about the axis through (-1, 0), which is z, and the vertices of its corner."""
    count = round(2 * np.pi / EDGE)
    vertices, rings = [], []
    for x, z in profile:
        k = 1 if x <= -1 else count
        angle = 2 * np.pi * np.arange(k) / count
        rings.append(np.arange(k) + sum(len(ring) for ring in rings))
        vertices.append(np.column_stack([(x + 1) * np.cos(angle), (x + 1) * np.sin(angle), np.full(k, z)]))
    faces = np.vstack([between(low, high) for low, high in pairwise(rings)])
    return Mesh(np.vstack(vertices), faces[:, ::-1]), rings[_corner(profile)].tolist()
