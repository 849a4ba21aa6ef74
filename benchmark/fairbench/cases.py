"""The cases: an input that programs see, and the truth that they do not."""

from __future__ import annotations

import zlib
from collections.abc import Iterator
from pathlib import Path
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from . import blends, parts, scans
from .meshes import Mask, Mesh, Points, loops, rings
from .shape import edge_angles
from .surfaces import Surface, mesh_of, surfaces

#: Edges of exact surfaces, which are about two units wide.
EDGE = 0.1
#: Radius of holes and regions there; those that a program fairs are as wide.
RADIUS = 0.45


class Case(NamedTuple):
    """One problem."""

    name: str
    #: What classes of results are made of: "exact", "stretched", "scan", "sharp", "rim", "tube", "blend".
    family: str
    #: "fill", "fair", "bump", "join" or "round".
    task: str
    #: What a program is given, and what it is told besides; see README.md.
    mesh: Mesh
    told: dict[str, object]
    #: The whole truth, and which of its triangles the program has to find.
    truth: Mesh
    wanted: Mask
    #: Where it is known exactly; vertices of `truth` are on it.
    exact: Surface | None

    def width(self) -> float:
        """The diagonal of what is wanted: errors are told in parts of it."""
        return self.truth.only(self.wanted).diagonal()


def seeded(name: str, seed: int) -> np.random.Generator:
    """Random numbers of a case: the same whatever other cases there are."""
    return np.random.default_rng([seed, zlib.crc32(name.encode())])


def cases(seed: int, data: Path) -> Iterator[Case]:
    """All of them. `data` has Debian's meshes."""
    for surface in surfaces():
        for kind, stretch in (("regular", 1.0), ("irregular", 1.0), ("irregular", 3.0)):
            family = "exact" if stretch == 1.0 else "stretched"
            yield from of_surface(surface, kind, stretch, family, seed)
    for surface in surfaces():
        if surface.name in ("sphere", "torus", "catenoid", "ellipsoid"):
            yield noisy_rim(surface, seed)
        if not any(surface.poles) and surface.name != "torus":
            yield joined(surface, seed)
    for name, mesh in scans.scans(data):
        yield from of_scan(name, mesh, seed)
    for name, mesh in parts.sharp(data):
        yield from of_part(name, mesh, seed)
    yield from rounded(seed)


def around(mesh: Mesh, centre: Points, radius: float) -> Mask:
    """The triangles whose middles are in a ball, and which hang together with the one that is nearest to its centre."""
    far = np.linalg.norm(mesh.corners().mean(axis=1) - centre, axis=1)
    inside = far < radius
    part = np.zeros(len(far), bool)
    part[far.argmin()] = True
    while True:
        more = rings(mesh.faces, part, 1) & inside
        if (more == part).all():
            return part
        part = more


def is_disc(mesh: Mesh, part: Mask) -> bool:
    """Whether some triangles have one loop around them, no vertex twice on it, and are away from the mesh's own boundary."""
    if part.sum() < 8 or part.all():
        return False
    inner, outer = mesh.faces[part], mesh.faces[~part]
    own = set(map(tuple, _boundary(mesh.faces)))
    around_part = loops(inner)
    if len(around_part) != 1 or len(np.unique(around_part[0])) != len(around_part[0]):
        return False
    chi = len(np.unique(inner)) - len(inner) * 3 / 2 - len(around_part[0]) / 2 + len(inner)
    touches = np.isin(around_part[0], np.unique([v for edge in own for v in edge])).any() if own else False
    return chi == 1 and not touches and len(np.unique(outer)) > 0


def _boundary(faces: NDArray[np.int64]) -> list[tuple[int, int]]:
    return [(int(loop[k]), int(loop[(k + 1) % len(loop)])) for loop in loops(faces) for k in range(len(loop))]


def place(mesh: Mesh, radius: float, random: np.random.Generator, centres: Points | None = None) -> Mask | None:
    """A disc of triangles at a random vertex, or at one of some places; none after a hundred trials."""
    some = mesh.vertices[np.unique(mesh.faces)] if centres is None else centres
    for _ in range(100):
        part = around(mesh, random.choice(some), radius)
        if is_disc(mesh, part):
            return part
    return None


def free_vertices(mesh: Mesh, part: Mask) -> NDArray[np.int64]:
    """The vertices whose triangles are all of a part."""
    return np.setdiff1d(np.unique(mesh.faces[part]), np.unique(mesh.faces[~part]))


def hole(name: str, family: str, mesh: Mesh, part: Mask, exact: Surface | None) -> Case:
    """The mesh without a part, which is to be filled; the vertices of its boundary are told, as there may be other holes."""
    used = np.unique(mesh.faces[~part])
    rim = np.searchsorted(used, np.intersect1d(mesh.faces[part], used))
    return Case(f"fill-{name}", family, "fill", mesh.only(~part), {"hole": rim.tolist()}, mesh, part, exact)


def crumpled(name: str, family: str, mesh: Mesh, part: Mask, exact: Surface | None, random: np.random.Generator) -> Case:
    """The mesh with noise on a part, which is to be faired: the truth has its triangles, but vertices may slide."""
    free = free_vertices(mesh, part)
    edge = float(np.sqrt(mesh.areas()[part].mean()) * 1.5)
    vertices = mesh.vertices.copy()
    vertices[free] += random.normal(0, 0.4 * edge, (len(free), 3))
    told: dict[str, object] = {"free": free.tolist()}
    return Case(f"fair-{name}", family, "fair", Mesh(vertices, mesh.faces), told, mesh, np.isin(mesh.faces, free).any(axis=1), exact)


def bumped(name: str, family: str, mesh: Mesh, part: Mask, exact: Surface | None) -> Case:
    """The mesh with a bump on a part, at whose top a point is told."""
    free = free_vertices(mesh, part)
    corners = mesh.vertices[np.unique(mesh.faces[part])]
    centre = mesh.vertices[free][np.linalg.norm(mesh.vertices[free] - corners.mean(axis=0), axis=1).argmin()]
    far = np.linalg.norm(mesh.vertices - centre, axis=1)
    radius = 0.9 * far[np.unique(mesh.faces[~part])].min()
    normal = mesh.normals()[part].sum(axis=0)
    normal /= np.linalg.norm(normal)
    height = np.where(far < radius, 0.35 * radius * np.cos(np.pi / 2 * np.minimum(far / radius, 1)) ** 2, 0)
    vertices = mesh.vertices + height[:, None] * normal
    told: dict[str, object] = {"point": vertices[far.argmin()].tolist()}
    wanted = (height > 0)[mesh.faces].any(axis=1)
    return Case(f"bump-{name}", family, "bump", Mesh(vertices, mesh.faces), told, mesh, wanted, exact)


def of_surface(surface: Surface, kind: str, stretch: float, family: str, seed: int) -> Iterator[Case]:
    """A hole, a region and, on equal triangles that are irregular, a bump."""
    name = f"{surface.name}-{'stretched' if stretch > 1 else kind}"
    random = seeded(name, seed)
    # Stretched triangles are smaller, so that the profile is not cut short.
    mesh = mesh_of(surface, EDGE if stretch == 1.0 else 0.6 * EDGE, kind, random, stretch)
    part = place(mesh, RADIUS, random)
    if part is None:
        return
    yield hole(name, family, mesh, part, surface)
    if kind == "irregular":
        yield crumpled(name, family, mesh, part, surface, random)
    if family == "exact" and kind == "irregular":
        yield bumped(name, family, mesh, part, surface)


def noisy_rim(surface: Surface, seed: int) -> Case:
    """A hole whose boundary vertices are off the surface, as those of scans are."""
    name = f"{surface.name}-rim"
    random = seeded(name, seed)
    mesh = mesh_of(surface, EDGE, "irregular", random)
    part = place(mesh, RADIUS, random)
    assert part is not None, name
    rim = np.intersect1d(mesh.faces[part], mesh.faces[~part])
    case = hole(name, "rim", mesh, part, surface)
    vertices = case.mesh.vertices.copy()
    vertices[case.told["hole"]] += random.normal(0, 0.2 * EDGE, (len(rim), 3))
    return case._replace(mesh=Mesh(vertices, case.mesh.faces))


def joined(surface: Surface, seed: int) -> Case:
    """A band is taken out of a tube; the two parts are to be joined."""
    name = f"{surface.name}-gap"
    mesh = mesh_of(surface, EDGE, "irregular", seeded(name, seed))
    heights = mesh.corners()[:, :, 2].mean(axis=1)
    part = np.abs(heights - heights.mean()) < 0.5
    case = hole(name, "tube", mesh, part, surface)
    middle = heights.mean()
    by_height = sorted(loops(case.mesh.faces), key=lambda loop: abs(case.mesh.vertices[loop, 2].mean() - middle))
    told: dict[str, object] = {"loops": [int(loop[0]) for loop in by_height[:2]]}
    return case._replace(name=f"join-{name}", task="join", told=told)


def of_scan(name: str, mesh: Mesh, seed: int) -> Iterator[Case]:
    """Two holes and a region at random places of a scan, an eighth of it wide."""
    random = seeded(name, seed)
    radius = mesh.diagonal() / 16
    for number in range(2):
        part = place(mesh, radius, random)
        if part is not None:
            yield hole(f"{name}-{number}", "scan", mesh, part, None)
    part = place(mesh, radius, random)
    if part is not None:
        yield crumpled(name, "scan", mesh, part, None, random)


def of_part(name: str, mesh: Mesh, seed: int) -> Iterator[Case]:
    """A hole and a region across sharp edges."""
    random = seeded(name, seed)
    first, second, angles = edge_angles(mesh)
    at_edge = mesh.corners()[np.unique(np.r_[first[angles > 40], second[angles > 40]])].mean(axis=1)
    part = place(mesh, mesh.diagonal() / 10, random, at_edge)
    if part is not None:
        yield hole(name, "sharp", mesh, part, None)
    part = place(mesh, mesh.diagonal() / 10, random, at_edge)
    if part is not None:
        yield crumpled(name, "sharp", mesh, part, None, random)


def rounded(seed: int) -> Iterator[Case]:
    """Edges to be rounded by a ball of a radius: two that are the same whatever the seed, and those of booleans."""
    fixed = parts.rounded() if seed == 1 else iter(())
    for part in (*fixed, *blends.blends(seeded("round", seed))):
        told: dict[str, object] = {"edge": part.edge, "radius": part.radius}
        yield Case(f"round-{part.name}", "blend", "round", part.sharp, told, part.rounded, part.wanted, None)
