"""Writes docs/rounding.md and its pictures: `rounding.py FAIRMESH`. gallery.sh calls it, with Blender and MeshLib from PyPI."""

import math
import subprocess
import sys
from collections.abc import Callable
from pathlib import Path
from typing import NamedTuple

import bpy
import numpy as np
from manifold3d import CrossSection, Manifold, Mesh
from meshlib import mrmeshnumpy, mrmeshpy
from PIL import Image

ROOT = Path(__file__).resolve().parent.parent
WORK = ROOT / "target/gallery/rounding"
PICTURES = ROOT / "docs/rounding"
# Colours of a picture: half the bytes of all of them, and nobody sees it.
COLOURS = 64
# Segments of a circle.
ROUND = 48
# Edges that bend by less are those of facets, in degrees.
FACETS = 12
# Cells of MeshLib's grid for the width.
CELLS = 6
# Segments of Blender's profile.
SEGMENTS = 8
PROGRAMS = ("fairmesh", "Bevel", "offsets")


class Solid(NamedTuple):
    """A solid: the picture's name, what it is, how it is made, the width of its blends, and how it is looked at."""

    name: str
    title: str
    make: Callable[[], Manifold]
    width: float
    view: str = "0.6,-0.8,0.55"


def block(x: float, y: float, z: float) -> Manifold:
    """A box around the origin."""
    return Manifold.cube((x, y, z), True)


def rod(radius: float, height: float, tilt: float = 0, turn: float = 0, top: float | None = None) -> Manifold:
    """A cylinder or cone around the origin, its axis tilted from the vertical, then turned about it, in degrees."""
    made = Manifold.cylinder(height, radius, radius if top is None else top, ROUND, True)
    return made.rotate((0, tilt, turn))


def ball(radius: float) -> Manifold:
    """A sphere around the origin."""
    return Manifold.sphere(radius, ROUND)


def pillar(corners: int, radius: float, height: float) -> Manifold:
    """A right prism over a regular polygon."""
    return Manifold.cylinder(height, radius, radius, corners, True)


def wedge(angle: float) -> Manifold:
    """A prism over a triangle with two equal sides, and this angle between them."""
    half = math.radians(angle / 2)
    x, y = 2 * math.cos(half), 2 * math.sin(half)
    return Manifold.extrude(CrossSection([[(0, 0), (x, -y), (x, y)]]), 2)


def gear() -> Manifold:
    """A wheel with ten teeth."""
    teeth = [(0.8 + 0.3 * (k // 2 % 2), math.tau * (k + 0.2 * (-1) ** k) / 40 * 2) for k in range(40)]
    outline = [(radius * math.cos(angle), radius * math.sin(angle)) for radius, angle in teeth]
    return Manifold.extrude(CrossSection([outline]), 0.5) - rod(0.35, 2)


def star() -> Manifold:
    """A star with five points."""
    outline = [((1.2, 0.6)[k % 2] * math.cos(math.pi * k / 5), (1.2, 0.6)[k % 2] * math.sin(math.pi * k / 5)) for k in range(10)]
    return Manifold.extrude(CrossSection([outline]), 0.6)


def bracket() -> Manifold:
    """An angle with a hole in each leg."""
    legs = block(2, 1.2, 0.4).translate((0.8, 0, 0)) + block(0.4, 1.2, 2).translate((0, 0, 0.8))
    return legs - rod(0.3, 2).translate((1.1, 0, 0)) - rod(0.3, 2, 90).translate((0, 0, 1.1))


def leaning_boss() -> Manifold:
    """A plate with a cylinder that leans, and does not reach below."""
    boss = rod(0.5, 2).translate((0, 0, 0.6)).rotate((0, 25, 0)) - block(4, 4, 2).translate((0, 0, -1.2))
    return block(2.6, 2.4, 0.5) + boss


def lattice() -> Manifold:
    """Twelve struts along the edges of a cube."""
    whole = Manifold()
    for turned in ((0, 0), (90, 0), (90, 90)):
        for a in (-1, 1):
            for b in (-1, 1):
                strut = pillar(4, 0.2, 2.3).rotate((0, 0, 45)).translate((a, b, 0))
                whole += strut.rotate((0, *turned))
    return whole


def bores() -> Manifold:
    """A plate with four holes."""
    plate = block(2.4, 1.6, 0.5)
    for x in (-0.7, 0.7):
        for y in (-0.4, 0.4):
            plate -= rod(0.2, 2).translate((x, y, 0))
    return plate


SOLIDS = (
    Solid("cube", "A cube", lambda: block(2, 2, 2), 0.3),
    Solid("prism", "A hexagonal prism", lambda: pillar(6, 1, 1.5), 0.2),
    Solid("wedge-40", "A wedge of 40 degrees", lambda: wedge(40), 0.12),
    Solid("wedge-150", "A wedge of 150 degrees", lambda: wedge(150), 0.12),
    Solid("cone", "A truncated cone", lambda: rod(1, 1.4, top=0.5), 0.2),
    Solid("tee", "A tee of two cylinders", lambda: rod(0.5, 3, 90) + rod(0.4, 1.6).translate((0, 0, 0.8)), 0.15),
    Solid("tilted-tee", "A tee at 50 degrees", lambda: rod(0.5, 3.4, 90) + rod(0.35, 2).translate((0, 0, 1)).rotate((0, 40, 0)), 0.12),
    Solid("cross", "Two cylinders of one radius", lambda: rod(0.5, 3, 90) + rod(0.5, 3, 90, 90), 0.12),
    Solid("cross-60", "Two cylinders at 60 degrees", lambda: rod(0.5, 3.4, 90) + rod(0.4, 3.4, 90, 60), 0.12),
    Solid("axes", "Three cylinders", lambda: rod(0.5, 2.6) + rod(0.45, 2.6, 90) + rod(0.4, 2.6, 90, 90), 0.1),
    Solid("boss", "A boss on a plate", lambda: block(2.4, 2.4, 0.5) + rod(0.6, 1.2).translate((0, 0, 0.6)), 0.15),
    Solid("leaning-boss", "A boss that leans", leaning_boss, 0.12),
    Solid("pocket", "A pocket", lambda: block(2.4, 2, 0.9) - block(1.4, 1, 0.9).translate((0, 0, 0.5)), 0.12),
    Solid("bores", "Four bores", bores, 0.08),
    Solid("bracket", "A bracket", bracket, 0.1, "0.75,-0.8,0.6"),
    Solid("lattice", "A frame of struts", lattice, 0.06),
    Solid("gear", "A wheel with teeth", gear, 0.06),
    Solid("star", "A star", star, 0.1),
    Solid("balls", "A ball on a ball", lambda: ball(1) + ball(0.7).translate((0.5, -0.5, 0.9)), 0.15),
    Solid("bowl", "A cube without a ball", lambda: block(2, 2, 2) - ball(0.9).translate((0.3, -0.4, 1)), 0.12),
)


class Surface(NamedTuple):
    """Vertices and triangles."""

    vertices: np.ndarray
    faces: np.ndarray


def of(solid: Manifold) -> Surface:
    """As it is: booleans leave slivers."""
    mesh: Mesh = solid.to_mesh()
    return Surface(np.asarray(mesh.vert_properties)[:, :3].astype(float), np.asarray(mesh.tri_verts).astype(np.int32))


def write(path: Path, surface: Surface) -> None:
    """As an OFF file."""
    lines = [f"OFF\n{len(surface.vertices)} {len(surface.faces)} 0"]
    lines += [" ".join(map(repr, map(float, vertex))) for vertex in surface.vertices]
    lines += ["3 " + " ".join(map(str, face)) for face in surface.faces]
    path.write_text("\n".join(lines) + "\n")


def bevelled(surface: Surface, width: float) -> Surface:
    """Blender's Bevel of all edges that are none of facets.

    Limited Dissolve makes one face of flat triangles before, as Bevel stops at their edges.
    """
    for old in list(bpy.data.objects):
        bpy.data.objects.remove(old)
    mesh = bpy.data.meshes.new("mesh")
    mesh.from_pydata(surface.vertices.tolist(), [], surface.faces.tolist())
    made = bpy.data.objects.new("mesh", mesh)
    bpy.context.collection.objects.link(made)
    bpy.context.view_layer.objects.active = made
    made.select_set(True)
    bpy.ops.object.mode_set(mode="EDIT")
    bpy.ops.mesh.select_all(action="SELECT")
    bpy.ops.mesh.dissolve_limited(angle_limit=math.radians(1))
    bpy.ops.mesh.select_mode(type="EDGE")
    bpy.ops.mesh.select_all(action="DESELECT")
    bpy.ops.mesh.edges_select_sharp(sharpness=math.radians(FACETS))
    bpy.ops.mesh.bevel(offset=width, segments=SEGMENTS, profile=0.5, clamp_overlap=False)
    bpy.ops.object.mode_set(mode="OBJECT")
    mesh.calc_loop_triangles()
    return Surface(np.array([vertex.co for vertex in mesh.vertices]), np.array([triangle.vertices for triangle in mesh.loop_triangles]))


def offset(surface: Surface, width: float) -> Surface:
    """MeshLib's offsets: in and out, for edges that stand out, then out and in, for folds."""
    mesh = mrmeshnumpy.meshFromFacesVerts(surface.faces, surface.vertices)
    settings = mrmeshpy.OffsetParameters()
    settings.voxelSize = width / CELLS
    for first, second in ((-width, width), (width, -width)):
        mesh = mrmeshpy.doubleOffsetMesh(mesh, first, second, settings)
    return Surface(mrmeshnumpy.getNumpyVerts(mesh).copy(), mrmeshnumpy.getNumpyFaces(mesh.topology).copy())


def crossings(surface: Surface) -> int:
    """Pairs of triangles that intersect, as MeshLib finds them."""
    mesh = mrmeshnumpy.meshFromFacesVerts(surface.faces.astype(np.int32), surface.vertices)
    return len(mrmeshpy.findSelfCollidingTriangles(mrmeshpy.MeshPart(mesh)))


def read(path: Path) -> Surface:
    """An OFF file of triangles."""
    numbers = path.read_text().split()[1:]
    count, faces = int(numbers[0]), int(numbers[1])
    vertices = np.array(numbers[3 : 3 + 3 * count], float).reshape(-1, 3)
    rows = np.array(numbers[3 + 3 * count : 3 + 3 * count + 4 * faces], np.int32)
    return Surface(vertices, rows.reshape(-1, 4)[:, 1:])


class Row(NamedTuple):
    """What a solid became: how many of its creases are rounded, and per program triangles and crossings."""

    solid: Solid
    creases: str
    sizes: list[int]
    crossings: list[int]


def rounded(solid: Solid, program: str) -> Row:
    """By all three programs, with a picture."""

    def run(*words: str) -> str:
        done = subprocess.run([program, *words], cwd=WORK, capture_output=True, text=True, check=False)
        if done.returncode not in (0, 3):
            sys.exit(f"{words}\n{done.stderr}")
        return done.stdout + done.stderr

    surface = of(solid.make())
    write(WORK / "in.off", surface)
    told = run("round", "in.off", "-o", "0.off", "--width", repr(solid.width), "--angle", str(FACETS))
    made = [read(WORK / "0.off"), bevelled(surface, solid.width), offset(surface, solid.width)]
    for number, peer in enumerate(made):
        write(WORK / f"{number}.off", peer)
    captions = [word for caption in PROGRAMS for word in ("--caption", caption)]
    look = [f"--view={solid.view}", "--size", "200x170", "--shade", "flat,reflection"]
    run("render", "0.off", "1.off", "2.off", "-o", "all.png", *captions, *look)
    small = Image.open(WORK / "all.png").convert("RGB").quantize(COLOURS, dither=Image.Dither.NONE)
    small.save(PICTURES / f"{solid.name}.png", optimize=True)
    creases = told.split(" creases")[0]
    return Row(solid, creases, [len(each.faces) for each in made], [crossings(each) for each in made])


PAGE = """# Rounding, beside other programs

Twenty solids as booleans of [manifold3d](https://github.com/elalish/manifold) leave them, rounded by `fairmesh round`, by
Blender's Bevel, and by offsets of MeshLib: in and out for edges that stand out, then out and in for folds. All have the same
width. Bevel gets its best case: flat triangles are dissolved into faces before, as it stops at their edges, and its overlaps
are not clamped, or it would do nothing where a crease has short edges. Offsets are on a grid with {cells} cells for the width.
The lower rows show reflections of rings of light. This page and its pictures are written by

```console
site/gallery.sh
```

Blends of fairmesh are tangent to the faces, which stay where they are to the last bit; offsets make all of the surface anew,
and wear off parts that are thinner than twice the width. Pairs of triangles that intersect are counted by MeshLib.

| | creases rounded | triangles: fairmesh | Bevel | offsets | intersecting pairs: fairmesh | Bevel | offsets |
|---|--:|--:|--:|--:|--:|--:|--:|
{table}

{pictures}
"""


def page(rows: list[Row]) -> str:
    """The page, in Markdown."""
    table = "\n".join(f"| {row.solid.title} | {row.creases} | {' | '.join(map(str, row.sizes + row.crossings))} |" for row in rows)
    shown = (f"## {row.solid.title}\n\n![{row.solid.title}, by fairmesh, Bevel and offsets](rounding/{row.solid.name}.png)" for row in rows)
    return PAGE.format(cells=CELLS, table=table, pictures="\n\n".join(shown))


def main(program: str) -> None:
    """Makes all pictures, and the page."""
    for folder in (WORK, PICTURES):
        folder.mkdir(parents=True, exist_ok=True)
    rows = [rounded(solid, program) for solid in SOLIDS]
    (ROOT / "docs/rounding.md").write_text(page(rows))


if __name__ == "__main__":
    main(sys.argv[1])
